"""Certificates: Arb balls that contain the true orbit of a float trajectory, and proved bounds of its errors."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np

from chapsym.numbers import Enclosure
from chapsym.numbers.precisions import MOST_BITS, flint_bits, is_a, plain_text

from .ball import Asked, Floats, batch, brief, callback, in_shape
from .coefficients import COMPOSITIONS
from .errors import BadInput, Status
from .levels import dispatch
from .levels.frames import Balls, Frames
from .levels.frames import exactly as exact_numbers
from .levels.start import decade, fraction
from .map import whole_number
from .results import Trajectory
from .shown import Brief

#: The quantities that a certificate bounds; `contact` in metres.
NAMES = ("momentum", "gamma", "attitude", "contact")


@dataclass(frozen=True, eq=False, repr=False)
class Certificate(Brief):
    """Balls that contain the true orbit at the frames of a trajectory, and bounds of the errors of the trajectory.

    The true orbit is the orbit of the map on the small-rotation branch, without rounding.  It starts at the numbers of
    frame 0, with γ and the attitude divided by their lengths; for `roll`, too, at the 𝒦 of frame 0.  The orders 4, 6
    and 8 have the stage coefficients of `coefficients`, to their 40 digits.

    Attributes
    ----------
    trajectory : Trajectory
        The certified trajectory.
    momentum, gamma, attitude, contact : numpy.ndarray or None
        Arb's balls, in the shapes of the trajectory; None if the trajectory has no such array.
    momentum_error, gamma_error, attitude_error, contact_error : numpy.ndarray or None
        Upper bounds, (..., frames), of the distance between the trajectory and the true orbit, in the unit of the
        array.  NaN after the last step.
    selected : numpy.ndarray
        The number of rotations (one per step for order 2), (...), that the float64 continuation selects: each is proved
        to be a root and the only one near by, but is not proved to be the small rotation.  0: the whole orbit is
        proved.

    Examples
    --------
    >>> import chapsym
    >>> run = chapsym.trajectory(chapsym.Ball((1, 2, 4), 3), (0.1, 0, 0), (0, 0, 1), 1)
    >>> proved = chapsym.certify(run)
    >>> bool(proved.gamma_error.max() < 1e-16), proved.gamma.shape
    (True, (2, 3))
    """

    trajectory: Trajectory
    momentum: np.ndarray
    gamma: np.ndarray
    attitude: Asked
    contact: Asked
    momentum_error: Floats
    gamma_error: Floats
    attitude_error: Asked
    contact_error: Asked
    selected: np.ndarray

    def digits(self, name: str) -> np.ndarray:
        """The true values as decimal strings, each rounded to the digits that its ball proves.

        Parameters
        ----------
        name : str
            "momentum", "gamma", "attitude" or "contact".

        Returns
        -------
        numpy.ndarray
            Strings, in the shape of the array.  A value that may be 0 is "0E-n": it is below 10^-n.

        Raises
        ------
        BadInput
            For another name, and for an array that the trajectory does not have.

        Examples
        --------
        >>> import chapsym
        >>> run = chapsym.trajectory(chapsym.Ball((1, 2, 4), 3), (0.1, 0, 0), (0, 0, 1), 1)
        >>> chapsym.certify(run).digits("gamma")[1, 2][:30]
        '0.9999382696996232792980030216'
        """
        text = plain_text(name)
        values = getattr(self, text) if text in NAMES else None
        if values is None:
            raise BadInput(f"the certificate has no {brief(name)}; it has {', '.join(self._names())}")
        return np.array([proved_digits(x) for x in values.flat], dtype=object).reshape(values.shape)

    def write(self) -> dict[str, Any]:
        """For JSON: the step numbers, `selected`, and the digits and the bounds of the errors of every array."""
        found: dict[str, Any] = {"index": self.trajectory.index.tolist(), "selected": self.selected.tolist()}
        for name in self._names():
            found[name] = self.digits(name).tolist()
            found[f"{name}_error"] = getattr(self, f"{name}_error").tolist()
        return found

    def _names(self) -> list[str]:
        return [name for name in NAMES if getattr(self, name) is not None]


def certify(
    trajectory: Trajectory, *, bits: int = 128, progress: Callable[[int], None] = lambda steps_done: None
) -> Certificate:
    """Encloses the true orbit of a trajectory and bounds the errors of the trajectory, rigorously.

    The branch is proved by lemma `small-branch` if |𝒦| is within its bound, and otherwise step by step by lemma
    `straight-path`.  If neither applies, as near a fold, the float64 continuation selects the root, which is proved
    only to be a root and the only one near by: `selected` counts such steps.

    Parameters
    ----------
    trajectory : Trajectory
        At any precision, of one ball or a batch, of the order 2, 4, 6 or 8, with its attitude and contact.
    bits : int, optional
        The number of correct bits of the balls; the run is repeated with more working bits until these are left.
    progress : callable, optional
        Called with the steps done so far (of all balls together); a run that is repeated counts again.

    Returns
    -------
    Certificate

    Raises
    ------
    BadInput
        For anything that is no such trajectory, and if the true orbit cannot be followed to the end: the balls grow too
        much, or the true orbit does not have a step.

    Examples
    --------
    >>> import chapsym
    >>> run = chapsym.trajectory(chapsym.Ball((1, 2, 4), 3), (0.1, 0, 0), (0, 0, 1), 5)
    >>> proved = chapsym.certify(run)
    >>> bool(proved.momentum_error.max() < 1e-16), int(proved.selected)
    (True, 0)
    """
    if not is_a(trajectory, Trajectory):
        raise BadInput(f"certify takes what `trajectory` and `roll` return, not {type(trajectory).__name__}")
    if trajectory.order not in COMPOSITIONS:
        raise BadInput(f"certify takes orders {', '.join(map(str, COMPOSITIONS))}: this is no orbit of the map")
    bits = whole_number(bits, "bits", 2, MOST_BITS)
    callback(progress)
    given = {name: None if getattr(trajectory, name) is None else exactly(trajectory, name) for name in NAMES}
    _check_frames(trajectory, given)
    enclosed, selected = _orbit(trajectory, given, bits, progress)
    errors = {name: None if array is None else errors_of(array, given[name], bits) for name, array in enclosed.items()}
    return Certificate(trajectory, *enclosed.values(), *errors.values(), selected)  # type: ignore[arg-type, call-arg]


def _check_frames(trajectory: Trajectory, given: Mapping[str, np.ndarray | None]) -> None:
    """Raises BadInput for frames that no run has, as a trajectory may be put together by hand."""
    index, apart = trajectory.index, np.diff(trajectory.index)
    if not len(index) or (apart < 1).any() or (apart != apart[:1]).any():
        raise BadInput("trajectory.index must be the steps of one frame or more, equally far apart, as those of a run")
    if given["contact"] is not None and trajectory.ball.radius is None:
        raise BadInput("trajectory.contact needs the radius: give its ball mass and radius")
    reached = index - index[0] <= trajectory.taken[..., np.newaxis]
    for name, array in given.items():
        if array is not None and any(x is None for x in array[reached].flat):
            raise BadInput(f"trajectory.{name} has numbers that are not finite in frames that were reached")


@np.errstate(invalid="ignore")  # inf - inf
def exactly(trajectory: Trajectory, name: str) -> np.ndarray:
    """An array of a trajectory as exact fractions, the midpoints of balls; None where numbers are not finite."""
    array = getattr(trajectory, name)
    rest = None if trajectory.low is None else getattr(trajectory.low, name)
    lows = [0.0] * array.size if rest is None else rest.flat
    values = [None if x - x != 0 else fraction(x) + fraction(y) for x, y in zip(array.flat, lows, strict=True)]
    return np.array(values, dtype=object).reshape(array.shape)


def _orbit(
    trajectory: Trajectory, given: dict[str, Any], bits: int, progress: Callable[[int], None]
) -> tuple[dict[str, np.ndarray | None], np.ndarray]:
    """The frames of the true orbit, and the number of selected rotations of each ball."""
    from .levels.balls import exact, run  # 40 ms, with mpmath and flint

    index, count = trajectory.index, len(trajectory.index)
    every = int(index[1] - index[0]) if count > 1 else 1
    start = [np.asarray(getattr(trajectory, name)[..., 0, :], dtype=float) for name in ("momentum", "gamma")]
    shape, (_, _, J, D) = batch(trajectory.ball, *start)
    if trajectory.momentum.dtype == object:  # of Digits or Enclosure: its ball is the given one
        J, D = (exact_numbers(x, y, shape) for x, y in zip(trajectory.ball.exact[:2], (J, D), strict=True))
    first: dict[str, Any] = {
        name: None if array is None else array[..., 0, :].reshape(len(D), array.shape[-1])
        for name, array in given.items()
    }
    radius = np.zeros(len(D))
    if trajectory.contact is not None:
        assert trajectory.ball.radius is not None
        radius = np.broadcast_to(trajectory.ball.radius, shape).reshape(-1)
    precision = Enclosure(bits)
    every_ball = Balls(first["momentum"], first["gamma"], J, D, radius)
    frames = dispatch.begun(precision, every_ball, count, first["attitude"])
    arrays = frames.momentum, frames.gamma, frames.attitude, frames.contact
    ends = frames.taken, frames.status, frames.reach
    selected = []
    for i, taken in enumerate(trajectory.taken.reshape(-1)):
        one, kept = slice(i, i + 1), min(count, int(taken) // every + 1)
        balls = Balls(*(x[one] for x in vars(every_ball).values() if x is not None))
        ours: Any = *(x[one, :kept] for x in arrays), *(x[one] for x in ends), frames.with_body
        part = Frames(*ours)
        selected += run(precision, balls, (kept - 1) * every, every, part, trajectory.order, progress)
        if part.status[0] != Status.TAKEN:
            raise BadInput(
                f"the true orbit{f' of ball {i}' if shape else ''} does not take step {int(part.taken[0])}:"
                f" {Status(int(part.status[0])).sentence}"
            )
        if first["contact"] is not None and any(first["contact"][i]):
            with flint_bits(2 * bits + 128):  # the run starts at (0, 0)
                part.contact[0] += [exact(x) for x in first["contact"][i]]
    found = {name: None if first[name] is None else in_shape(shape, x) for name, x in zip(NAMES, arrays, strict=True)}
    return found, np.array(selected, dtype=np.int64).reshape(shape)


def errors_of(balls: np.ndarray, given: Any, bits: int) -> Floats:
    """Upper bounds of |given - ball| for each frame, (..., frames); NaN where there is no frame."""
    from .levels.balls import exact
    from .levels.proved_root import upper

    def bound(frame: np.ndarray, ours: np.ndarray) -> float:
        if any(x is None for x in ours) or any(not hasattr(x, "rad") for x in frame):
            return math.nan
        length = upper(x - exact(y) for x, y in zip(frame, ours, strict=True))
        return math.nextafter(float(length), math.inf) if length > 0 else 0.0

    width = balls.shape[-1]
    with flint_bits(2 * bits + 128):
        rows = zip(balls.reshape(-1, width), given.reshape(-1, width), strict=True)
        return np.array([bound(x, y) for x, y in rows]).reshape(balls.shape[:-1])


def proved_digits(x: object) -> str:
    """A decimal number to which every number of the ball rounds; "nan" for a ball without numbers."""
    if not hasattr(x, "rad"):
        return "nan"
    middle, radius = fraction(x), fraction(x.rad())
    low, high = middle - radius, middle + radius
    if low <= 0 <= high:
        return "0" if radius == 0 else f"0E{decade(max(-low, high)) + 1}"
    # Without a radius: the place of the last digit of a dyadic fraction, which has finitely many.
    least = decade(radius) if radius else -(middle.denominator.bit_length() - 1)
    # At a tie the two ends differ for some digits more.
    for place in range(least, decade(middle) + 2):
        unit = Fraction(10) ** place
        rounded = round(low / unit)
        if rounded == round(high / unit) and rounded:
            return str(Decimal(f"{rounded}e{place}"))
    return f"0E{decade(max(abs(low), abs(high))) + 1}"
