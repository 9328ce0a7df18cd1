"""The ball: its mass tensor and D = mρ², and the checks that a body can have these values."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from decimal import Decimal
from functools import cached_property
from math import isfinite
from numbers import Number
from typing import TYPE_CHECKING, Any, Self, TypeGuard, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import brief, is_a, plain_text
from chapsym.numbers import is_whole as is_whole
from chapsym.rationals import decimals, exact_fraction

from . import principal_axes
from .errors import BadInput
from .principal_axes import Floats
from .shown import Brief

if TYPE_CHECKING:
    from typing_extensions import TypeIs

#: An array that is None unless it was asked for; whoever asked need not tell the type checker so, hence `Any`.
Asked = Floats | Any

#: A text, or one of few.
Text = TypeVar("Text", bound=str)

FLOAT64 = np.dtype(np.float64)
#: The maximal number of axes that NumPy broadcasts.
MOST_AXES = 32
#: The dimensions of components in results, which are the last of what is given.
COMPONENTS = frozenset({"axis", "quaternion", "plane"})
#: Below this float64 loses digits.
SMALLEST = np.finfo(np.float64).tiny
#: Up to this float64 has all integers.
LARGEST_INTEGER = 2**53
#: Classes that count as numbers but are not real numbers; NumPy counts time differences as integers.
_NO_REALS = (complex, np.complexfloating, np.timedelta64)
#: The largest accepted error of |γ|²: above the rounding of 10⁶ steps, so that the end of a run may start another.
UNIT_TOLERANCE = 1e-12
#: The same for float32 input, which is divided by its length.
SINGLE_TOLERANCE = 1e-6


def numbers(value: ArrayLike, name: str, trailing: int | None = None) -> Floats:
    """`value` as finite float64 numbers, with a last axis of length `trailing` if given.

    Real numbers of any kind are accepted, also `Fraction` and `Decimal`.  Raises BadInput for complex numbers, texts,
    dates and masked entries.
    """
    if trailing == 3 and is_vector(value):
        return value.copy()
    array = _as_float(value, name)
    dims: Any = value.dims if hasattr(type(value), "dims") else ()  # type: ignore[union-attr]
    if trailing and is_a(dims, tuple) and not COMPONENTS.isdisjoint(dims[:-1]):
        shown = ", ".join(map(str, dims))
        raise BadInput(f"{name} must have its components along its last dimension: transpose {shown}")
    if trailing is not None and (array.ndim == 0 or array.shape[-1] != trailing):
        raise BadInput(f"{name} must have {trailing} components along its last axis, not the shape {array.shape}")
    if not np.isfinite(array).all():
        where = np.argwhere(~np.isfinite(array))[0]
        at = f" at index {tuple(map(int, where))}" if array.ndim else ""
        raise BadInput(f"{name} must be finite, but it is {array[tuple(where)]}{at}")
    return array


def is_vector(value: ArrayLike) -> TypeGuard[Floats]:
    """Whether this is one finite float64 vector, which needs no more checks."""
    return (
        type(value) is np.ndarray and value.dtype == FLOAT64 and value.shape == (3,) and isfinite(sum(value.tolist()))
    )


def is_unit(x: float, y: float, z: float) -> bool:
    """Whether this is certainly a unit vector."""
    return abs(x * x + y * y + z * z - 1.0) < 0.5 * UNIT_TOLERANCE


def _as_float(value: ArrayLike, name: str) -> Floats:
    try:
        if _has_mask(value):
            raise _not_numbers(value, name)
        array = np.asarray(value)
    except MemoryError:
        raise
    except Exception:  # rows of different length, lists too deep, and whatever an object raises
        raise _not_numbers(value, name) from None
    if array.dtype.kind not in "iufO":
        raise _not_numbers(value, name)
    if array.ndim > MOST_AXES:
        raise BadInput(f"{name} has {array.ndim} axes, but at most {MOST_AXES} are taken")
    if array.dtype.kind == "O" and not all(is_a(x, Number) and not is_a(x, *_NO_REALS) for x in array.flat):
        raise _not_numbers(value, name)
    try:
        with np.errstate(over="raise", under="ignore"):
            floats = array.astype(np.float64)
    except (OverflowError, FloatingPointError):
        raise BadInput(f"{name} is beyond the range of float64, about 1.8e308") from None
    except MemoryError:
        raise
    except Exception:  # of objects, whatever they raise
        raise _not_numbers(value, name) from None
    if array.dtype != FLOAT64 and ((floats == 0) & (array != 0)).any():
        raise BadInput(f"{name} is below the range of float64, about 2.2e-308; take other units")
    return floats


def beyond_float64(value: ArrayLike) -> bool:
    """Whether float64 may be unable to represent these numbers: objects, integers beyond 2⁵³, long doubles."""
    if (array := np.asarray(value)).dtype == FLOAT64:
        return False
    if array.dtype.kind in "iu":
        return bool((array > LARGEST_INTEGER).any() or (array < -LARGEST_INTEGER).any())
    return array.dtype.kind == "O" or bool((array != array.astype(np.float64)).any())


def exact_array(value: ArrayLike) -> np.ndarray:
    """Numbers as Fractions: exact for Fractions, Decimals, mpmath, SymPy, and for floats as binary numbers."""
    found = np.asarray(value, dtype=object)
    return np.array([exact_fraction(x) for x in found.flat], dtype=object).reshape(found.shape)


def _has_mask(value: object) -> bool:
    """Whether any entry is masked, also in lists of arrays, whose masks NumPy drops."""
    if "numpy.ma" not in sys.modules:  # nothing is masked, and its import takes 10 ms
        return False
    if isinstance(value, list | tuple):
        return any(_has_mask(x) for x in value if isinstance(x, list | tuple | np.ma.MaskedArray))
    return bool(np.ma.is_masked(value))


def _not_numbers(value: object, name: str) -> BadInput:
    return BadInput(f"{name} must be real numbers, not {brief(value)}")


def is_flag(value: object) -> TypeIs[bool | np.bool_]:
    """Whether this is true or false."""
    return type(value) in (bool, np.bool_)


def flag(value: bool, name: str) -> bool:
    """True or false; raises BadInput for anything else."""
    if not is_flag(value):
        raise BadInput(f"{name} must be True or False, not {brief(value)}")
    return bool(value)


def one_of(value: Text, name: str, *choices: Text) -> Text:
    """One of these texts; raises BadInput for anything else."""
    if value is choices[0]:
        return value
    if (text := plain_text(value)) not in choices:
        listed = '" or "'.join(choices)
        raise BadInput(f'{name} must be "{listed}", not {brief(value)}')
    return choices[choices.index(text)]


def callback(progress: object) -> None:
    """Raises BadInput unless `progress` is callable."""
    if not callable(progress):
        raise BadInput(f"progress must be a function, which is called with how far it is, not {brief(progress)}")


class Parameters(Brief):
    """The parameters of a ball in any dimension: balls with equal parameters are equal; a copy is checked again."""

    def _values(self) -> tuple[Asked, ...]:
        return tuple(getattr(self, field.name) for field in fields(self))  # type: ignore[arg-type]

    def __eq__(self, other: object) -> bool:
        if type(other) is not type(self):
            return NotImplemented
        return all(
            a is b or (a is not None and b is not None and np.array_equal(a, b))
            for a, b in zip(self._values(), other._values(), strict=True)
        )

    def __hash__(self) -> int:
        return hash(tuple(None if x is None else (x.shape, *x.ravel().tolist()) for x in self._values()))

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), self._values()


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Ball(Parameters):
    """A ball, or an array of balls, that rolls without slipping; balanced: the centre of mass is the centre.

    `Digits` and `Enclosure` use Fractions, Decimals, integers, long doubles and numbers of mpmath and SymPy without
    rounding to float64.

    Parameters
    ----------
    mass_tensor : array_like
        J = (J1, J2, J3), ∫ xᵢ² dm, shape (..., 3), in kg m²: the diagonal of the second-moment (pseudo-inertia) matrix
        of robotics, not of the inertia tensor.
    D : array_like
        m ρ² in kg m², shape (...); D = 0 is the Euler top.
    radius : array_like, optional
        ρ in m, shape (...); needed only for the contact point.
    axes : array_like, optional
        Unit quaternions, (..., 4), from the principal axes, in which J is given, to the axes of all vectors and
        attitudes, given or returned (`from_inertia` finds them); None where both are the same.

    Raises
    ------
    BadInput
        For a mass moment below 0, a D below 0, a radius that is not positive, or a singular momentum operator.

    References
    ----------
    Sections 4 and 5 of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.Ball(mass_tensor=(1, 2, 4), D=3)
    >>> ball.inertia.tolist()
    [6.0, 5.0, 3.0]
    """

    mass_tensor: Floats
    D: Floats
    radius: Floats | None
    axes: Floats | None

    def __init__(
        self, mass_tensor: ArrayLike, D: ArrayLike, radius: ArrayLike | None = None, axes: ArrayLike | None = None
    ) -> None:
        tensor, contact = numbers(mass_tensor, "mass_tensor", 3), numbers(D, "D")
        rho = None if radius is None else numbers(radius, "radius")
        shapes = [tensor.shape[:-1], contact.shape, *([] if rho is None else [rho.shape])]
        common_shape(shapes, "mass_tensor, D and radius")
        turn = None
        if axes is not None:
            turn = numbers(axes, "axes", 4)
            with np.errstate(over="ignore", under="ignore"):
                square = (turn * turn).sum(axis=-1)
            if (np.abs(square - 1) > UNIT_TOLERANCE).any():
                raise BadInput("axes must be unit quaternions (scalar first); divide by the length")
            shape = common_shape([tensor.shape[:-1], turn.shape[:-1]], "mass_tensor and axes")
            common_shape([*shapes, turn.shape[:-1]], "mass_tensor, D, radius and axes")
            tensor, turn = np.broadcast_to(tensor, (*shape, 3)), np.broadcast_to(turn, (*shape, 4))
        if (tensor < 0).any():
            raise BadInput(
                f"mass_tensor has the negative moment {tensor.min():g}; J = (∫x²dm, ∫y²dm, ∫z²dm) is never negative "
                "(for principal moments of inertia use inertia=, where each is at most the sum of the other two)"
            )
        if (contact < 0).any():
            raise BadInput(f"D = m ρ² must not be negative, but it is {contact.min():g}")
        with np.errstate(over="ignore", under="ignore"):
            moments = inertia_of(tensor) + contact[..., np.newaxis]
        if not np.isfinite(moments).all():
            raise BadInput("the moments of inertia J2 + J3 + D, ... are beyond the range of float64")
        if not (moments > 0).all():
            raise BadInput("the ball has no inertia about one of its axes: at most two of J1, J2, J3 and D may vanish")
        if not (tensor > 0).any(axis=-1).all():
            raise BadInput("mass_tensor must not be (0, 0, 0): such a ball has no inertia about the vertical")
        if rho is not None and not (rho > 0).all():
            raise BadInput(f"radius must be positive, but it is {rho.min():g}")
        keep(self, mass_tensor=tensor, D=contact, radius=rho, axes=turn)
        given = (mass_tensor, D, radius)
        if axes is None and any(beyond_float64(x) for x in given if x is not None):
            object.__setattr__(self, "_given", tuple(None if x is None else exact_array(x) for x in given))

    @classmethod
    def from_inertia(
        cls, inertia: ArrayLike, *, mass: ArrayLike | None = None, radius: ArrayLike | None = None,
        D: ArrayLike | None = None, batch: bool = False,
    ) -> Self:  # fmt: skip
        """A ball with an inertia tensor or principal moments (kg m²), and its mass (kg) and radius (m), or D.

        Parameters
        ----------
        inertia : array_like
            A symmetric tensor (3, 3), or one for each ball, (..., 3, 3): it is diagonalised, its `axes` are kept, and
            all vectors and attitudes are given and returned in its axes.  The off-diagonal entries are -∫xy dm, ...,
            like ixy, ... of URDF, SDF and MJCF; SolidWorks shows both signs, and calls this one negative.  Or principal
            moments I1 = J2 + J3, ..., (3,), or a row for each ball, (..., 3), unless that is symmetric and 3 x 3.  For
            one flat body, a moment J that is negative by the rounding of the given digits is set to 0.
        mass : array_like, optional
            In kg, with the radius in the place of D.
        radius : array_like, optional
            ρ in m.
        D : array_like, optional
            m ρ² in kg m², in the place of the mass.
        batch : bool, optional
            Whether inertia is rows of principal moments, even if it is symmetric and 3 x 3.

        Returns
        -------
        Ball

        Raises
        ------
        BadInput
            For an inertia that no body has, and as for `Ball`.

        Examples
        --------
        >>> import chapsym
        >>> chapsym.Ball.from_inertia((3, 3, 2), mass=2, radius=0.5)
        Ball(mass_tensor=(1.0, 1.0, 2.0), D=0.5, radius=0.5)
        >>> chapsym.Ball.from_inertia([[3, 0.5, 0], [0.5, 4, 0], [0, 0, 5]], mass=2, radius=0.5).inertia.round(6)
        array([2.792893, 4.207107, 5.      ])
        """
        contact, given = contact_term(mass, radius, D), numbers(inertia, "inertia")
        rows = flag(batch, "batch") or not principal_axes.is_tensor(given)
        least = rounded_by(inertia) if given.ndim == (1 if rows else 2) else 0.0  # of one ball
        if rows:
            tensor = mass_tensor_of(given, least)
            if beyond_float64(inertia):
                moments = exact_array(inertia)
                return cls(moments.sum(axis=-1, keepdims=True) / 2 - moments, contact, radius)
            return cls(tensor, contact, radius)
        try:
            tensor, axes = principal_axes.principal(principal_axes.from_inertia_tensor(given), least)
        except BadInput as error:
            if (given < 0).any() or (_rounded_tensor(given) < 0).any():
                raise
            raise BadInput(f"{error}; if each row is the principal moments of a ball, say batch=True") from None
        return cls(tensor, contact, radius, axes)

    @classmethod
    def from_mass_tensor(
        cls, mass_tensor: ArrayLike, *, mass: ArrayLike | None = None, radius: ArrayLike | None = None,
        D: ArrayLike | None = None,
    ) -> Self:  # fmt: skip
        """A ball with the mass tensor J = (J1, J2, J3) (kg m²), and its mass (kg) and radius (m), or D.

        Parameters
        ----------
        mass_tensor : array_like
            J in principal axes, a row for each ball, (..., 3); `from_inertia` accepts a tensor that is not diagonal.
        mass : array_like, optional
            In kg, with the radius in the place of D.
        radius : array_like, optional
            ρ in m.
        D : array_like, optional
            m ρ² in kg m², in the place of the mass.

        Returns
        -------
        Ball

        Raises
        ------
        BadInput
            As `Ball`.

        Examples
        --------
        >>> import chapsym
        >>> chapsym.Ball.from_mass_tensor((1, 2, 4), mass=3, radius=1)
        Ball(mass_tensor=(1.0, 2.0, 4.0), D=3.0, radius=1.0)
        """
        return cls(mass_tensor, contact_term(mass, radius, D), radius)

    @property
    def inertia(self) -> Floats:
        """The principal moments of inertia about the centre, (J2 + J3, J1 + J3, J1 + J2)."""
        return inertia_of(self.mass_tensor)

    @property
    def exact(self) -> tuple[np.ndarray, np.ndarray, Asked]:
        """J, D and the radius as given: arrays of Fractions for exact numbers, else floats."""
        return self.__dict__.get("_given", (self.mass_tensor, self.D, self.radius))

    def _values(self) -> tuple[Asked, ...]:
        return *self.exact, self.axes

    @cached_property
    def is_one(self) -> bool:
        """Whether this is a single ball, not an array of balls."""
        return self.mass_tensor.ndim == 1 and self.D.ndim == 0 and (self.radius is None or self.radius.ndim == 0)

    @cached_property
    def principal(self) -> Ball:
        """The same ball in its principal axes; its vectors are those of `to_principal`."""
        return self if self.axes is None else Ball(self.mass_tensor, self.D, self.radius)

    def to_principal(self, vectors: ArrayLike, *, frames: bool = False) -> Floats:
        """Vectors (momentum, omega, gamma), converted from the axes of the user to principal axes.

        Parameters
        ----------
        vectors : array_like
            In the axes of the user, (..., 3).
        frames : bool, optional
            Whether there is an axis of frames before the last, (balls..., frames, 3).

        Returns
        -------
        numpy.ndarray
            In principal axes, (..., 3); the same vectors for a ball without `axes`.

        Raises
        ------
        BadInput
            If the ball has `axes` and these are not such vectors.

        Examples
        --------
        >>> import chapsym
        >>> ball = chapsym.Ball.from_inertia([[3, 0.5, 0], [0.5, 4, 0], [0, 0, 5]], D=0.5)
        >>> ball.to_principal((1, 0, 0)).round(6).tolist()
        [0.92388, 0.382683, 0.0]
        """
        return self._turned(principal_axes.to_principal, vectors, frames)

    def from_principal(self, vectors: ArrayLike, *, frames: bool = False) -> Floats:
        """Vectors, converted from principal axes to the axes of the user: the inverse of `to_principal`."""
        return self._turned(principal_axes.from_principal, vectors, frames)

    def _turned(self, turn: Callable[[Floats, Floats], Floats], vectors: ArrayLike, frames: bool) -> Floats:
        axes = self.axes
        try:
            array = np.asarray(vectors)
        except Exception:  # rows of different length, and whatever an object raises
            raise _not_numbers(vectors, "vectors") from None
        if axes is None:
            return array.copy()
        axes = axes[..., np.newaxis, :] if flag(frames, "frames") else axes
        array = _as_float(array, "vectors") if array.dtype == object else array
        if array.dtype.kind not in "iuf" or array.shape[-1:] != (3,):
            raise BadInput(f"vectors must be real numbers of the shape (..., 3), not {brief(vectors)}")
        common_shape([axes.shape[:-1], array.shape[:-1]], "the axes of the ball and the vectors")
        return turn(axes, array)


def in_principal_axes(ball: Ball) -> Ball:
    """The ball; raises BadInput for any other object, and for a ball with axes."""
    if not is_a(ball, Ball):
        raise BadInput(f"ball must be a chapsym.Ball, not {type(ball).__name__}")
    if ball.axes is not None:
        raise BadInput(
            "this ball has an inertia tensor with axes of its own, and this function takes principal axes only: "
            "give it ball.principal, vectors as ball.to_principal(vector), and turn its vectors by ball.from_principal"
        )
    return ball


def keep(ball: object, **parameters: Floats | None) -> None:
    """Sets the parameters of a new ball, read-only."""
    for name, values in parameters.items():
        if values is not None:
            values.flags.writeable = False
        object.__setattr__(ball, name, values)


def checked_before(mass_tensor: Floats, D: Floats, radius: Asked = None) -> Ball:
    """Balls in principal axes with the parameters of another ball, which are not checked again."""
    ball = object.__new__(Ball)
    ball.__dict__.update(mass_tensor=mass_tensor, D=D, radius=radius, axes=None)
    return ball


def common_shape(shapes: Sequence[tuple[int, ...]], names: str) -> tuple[int, ...]:
    """The broadcast shape of the leading axes; raises BadInput if they do not broadcast."""
    try:
        return np.broadcast_shapes(*shapes)
    except (ValueError, RuntimeError):  # that of more than 32 axes
        listed = ", ".join(map(str, shapes))
        raise BadInput(f"the leading axes of {names} do not broadcast: {listed}") from None


def over_states(array: Floats, name: str, shape: tuple[int, ...], axes: int = 1) -> Floats:
    """An array (..., *axes) for states with the leading axes `shape`; raises BadInput if it does not broadcast."""
    own = array.ndim - axes
    try:
        return np.broadcast_to(array, (*shape, *array.shape[own:]))
    except ValueError:
        raise BadInput(f"{name} has the leading axes {array.shape[:own]}, the states have {shape}") from None


def inertia_of(tensor: Floats) -> Floats:
    """(J2 + J3, J1 + J3, J1 + J2), (..., 3): as sums, since J1 + J2 + J3 - J1 would cancel for a large J1."""
    return np.stack([tensor[..., i] + tensor[..., j] for i, j in ((1, 2), (0, 2), (0, 1))], axis=-1)


def largest_moment(tensor: Floats, D: Floats) -> Floats:
    """Jᵢ + Jⱼ + D, (...), for the two largest J of (..., n): it may be finite where the sum of all overflows."""
    return np.asarray(np.sort(tensor, axis=-1)[..., -2:].sum(axis=-1) + D)


def mass_tensor_of(inertia: ArrayLike, rounding: float = 0.0) -> Floats:
    """J from the principal moments of inertia; raises BadInput if no body has them.

    rounding: a moment J in [-rounding, 0) is set to 0.
    """
    moments = numbers(inertia, "inertia", 3)
    tensor = _rounded_tensor(moments, rounding)
    bad = ((moments < 0) | (tensor < 0)).any(axis=-1)
    if not bad.any():
        return tensor
    if (moments < 0).any():
        error = BadInput(f"inertia has the negative principal moment {moments.min():g}")
    else:
        error = principal_axes.no_body(moments[bad][0])
    if moments.shape[-2:] != (3, 3) or principal_axes.is_tensor(moments):
        raise error
    off = np.abs(moments - moments.mT).max()
    raise BadInput(f"{error}; if it is a tensor, it must be symmetric, but it differs from its transpose by {off:.3g}")


def _rounded_tensor(moments: Floats, least: float = 0.0) -> Floats:
    """J from principal moments; a J that is negative by a rounding, or by at most `least`, is 0."""
    with np.errstate(over="ignore", under="ignore"):
        tensor = (moments / 2).sum(axis=-1, keepdims=True) - moments
    rounding = np.maximum(4 * np.finfo(np.float64).eps * np.abs(moments).max(axis=-1, keepdims=True), least)
    return np.where(np.abs(tensor) <= rounding, np.maximum(tensor, 0.0), tensor)


def rounded_by(inertia: Any) -> float:
    """A bound of the error in a moment of ∫xxᵀdm from rounding an inertia to its digits; 0 for whole numbers.

    Each entry has an error of half a unit of its last digit.  Then J from principal moments has ¾ of a unit; from a
    tensor, ½ tr I has ¾ and I has 3/2 of a unit.  The unit is that of the largest entry if all entries have equally
    many digits, or the common one if they have equally many decimal places; at most a hundredth of the largest.
    """
    entries = np.array(inertia, dtype=object).ravel().tolist()
    if not all(isinstance(x, float) and isfinite(x) for x in entries):
        return 0.0
    entries = [float(x) for x in entries]  # NumPy's floats have another repr
    if not (broken := [x for x in entries if x != round(x)]):
        return 0.0
    largest = max(map(abs, entries))
    digits = max(len(Decimal(repr(x)).normalize(decimals(17)).as_tuple().digits) for x in broken)
    of_the_largest = min(last_digit(largest), 10.0 ** (Decimal(repr(largest)).adjusted() + 1 - digits))
    unit = max(min(map(last_digit, broken)), of_the_largest)
    return min((0.75 if len(entries) == 3 else 2.25) * unit, 0.01 * largest)


def last_digit(x: float) -> float:
    """A unit of the last digit that is not 0."""
    return 10.0 ** int(Decimal(repr(x)).normalize(decimals(17)).as_tuple().exponent)


def contact_term(mass: ArrayLike | None, radius: ArrayLike | None, D: ArrayLike | None) -> ArrayLike:
    """D itself, or m ρ²."""
    if D is not None and mass is not None:
        raise BadInput("give either D or mass and radius, not both D and mass")
    if D is not None:
        return D
    if mass is None or radius is None:
        raise BadInput("D is missing: give D, or mass and radius")
    m, rho = numbers(mass, "mass"), numbers(radius, "radius")
    if not (m > 0).all() or not (rho > 0).all():
        raise BadInput("mass and radius must be positive")
    common_shape([m.shape, rho.shape], "mass and radius")
    with np.errstate(over="ignore", under="ignore"):
        contact = m * rho * rho
    if (contact < SMALLEST).any():
        raise BadInput("D = m ρ² is below the range of float64, about 2.2e-308; take other units")
    if any(beyond_float64(x) for x in (mass, radius)):
        return exact_array(mass) * exact_array(radius) * exact_array(radius)
    return contact


def in_single(value: ArrayLike) -> bool:
    """Whether an array has the type float32, in any byte order."""
    return np.asarray(value).dtype.newbyteorder("=") == np.float32


def unit_vertical(gamma: ArrayLike, n: int = 3) -> Floats:
    """γ as checked unit vectors, shape (..., n); a float32 array is divided by its lengths."""
    if n == 3 and is_vector(gamma) and is_unit(*gamma.tolist()):
        return gamma.copy()
    array = numbers(gamma, "gamma", n)
    with np.errstate(over="ignore", under="ignore"):  # which is refused
        squared = np.einsum("...i,...i->...", array, array)
    if in_single(gamma) and (np.abs(squared - 1) <= SINGLE_TOLERANCE).all():
        return array / np.sqrt(squared)[..., np.newaxis]
    off = np.abs(squared - 1)
    if array.size and (off > UNIT_TOLERANCE).any():
        worst = np.sqrt(squared.flat[int(off.argmax())])
        right = "divide it by its length" if worst else "it is the vertical, upwards, in the axes of the body"
        raise BadInput(f"gamma must be a unit vector, but its length is {worst:.17g}; {right}")
    return array


def batch(ball: Ball, *vectors: Floats) -> tuple[tuple[int, ...], list[Floats]]:
    """The common leading shape of balls and vectors, and all of them as flat read-only arrays.

    Returns (shape, [vector (n, 3) ..., mass_tensor (n, 3), D (n,)]); raises BadInput for a ball that has axes.
    """
    in_principal_axes(ball)
    if ball.is_one and not [v for v in vectors if v.ndim > 1]:
        return (), [v[None] for v in (*vectors, ball.mass_tensor, ball.D)]
    radius = () if ball.radius is None else ball.radius.shape
    leading = [ball.mass_tensor.shape[:-1], ball.D.shape, radius, *(v.shape[:-1] for v in vectors)]
    shape = common_shape(leading, "ball (mass_tensor, D, radius) and of the vectors")
    flat = [_filled((*shape, 3), v).reshape(-1, 3) for v in (*vectors, ball.mass_tensor)]
    return shape, [*flat, _filled(shape, ball.D).reshape(-1)]


def in_shape(shape: tuple[int, ...], array: Asked) -> Asked:
    """A flat array (n, ...) with the leading axes `shape` in place of n; None stays None."""
    if array is None or not shape:
        return None if array is None else array[0, ...]
    return array.reshape(shape + array.shape[1:])


def is_followed(attitude: bool | ArrayLike) -> bool:
    """Whether the attitude is followed: True, or a first attitude."""
    return not is_flag(attitude) or bool(attitude)


def _filled(shape: tuple[int, ...], value: Floats) -> Floats:
    """`value` broadcast to a shape; unchanged if it has that shape."""
    return np.ascontiguousarray(np.broadcast_to(value, shape))
