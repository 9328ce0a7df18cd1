"""The exact data of a motion, and balls that contain them at any precision."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from itertools import islice
from numbers import Rational
from typing import Any, NamedTuple

import numpy as np
from flint import acb_mat, arb

from chapsym import generated
from chapsym.numbers import is_a
from chapsym.rationals import NotANumber, exact_fraction, rational

from ..ball import brief
from ..errors import BadInput, TooWide
from ..levels.balls import exact
from ..levels.proved_root import Vector, unit
from ..levels.start import least
from ..loops.vectors import cross
from ..principal_axes import quaternions
from .path import Path


class Turns(NamedTuple):
    """The number rational + of_pi·π."""

    rational: Fraction
    of_pi: Fraction = Fraction(0)


Number = Fraction | Turns
NO_ROTOR = (Turns(Fraction(0)),) * 3
Balls = Sequence[arb]


def ball(x: Number) -> arb:
    """A ball that contains the number, at the precision that is set."""
    if isinstance(x, Turns):
        found = ball(x.rational)
        return found + ball(x.of_pi) * arb.pi() if x.of_pi else found
    return exact(x)


def balls(v: Sequence[Number]) -> Vector:
    """A vector of such balls."""
    return tuple(map(ball, v))


def exactly(value: Any, name: str) -> Fraction:
    """An exact number: a string, a Decimal, a Fraction, an integer, or a float, taken as its binary value."""
    if is_a(value, str):
        try:
            return rational(value, name)
        except NotANumber as error:
            raise BadInput(str(error)) from None
    try:
        real = is_a(value, Rational, Decimal, float) and not is_a(value, bool, np.timedelta64)
        if real or hasattr(value, "_mpf_"):
            return exact_fraction(value)
        plain = value.item() if getattr(value, "size", None) == 1 and not np.ma.is_masked(value) else value
    except (ValueError, OverflowError):
        raise BadInput(f"{name} must be finite, not {value}") from None
    except Exception:  # whatever an object raises
        plain = value
    if type(value) is not type(plain):
        return exactly(plain, name)
    raise BadInput(f'{name} must be a number, or a text such as "0.1" or "2/7", not {brief(value)}')


def first_of(values: Any, count: int) -> list[Any]:
    """The first of these values, at most `count`: a generator may not end; none of what is no list."""
    try:
        return [] if is_a(values, str) else list(islice(values, count))
    except Exception:  # whatever an object raises
        return []


def vector(values: Any, name: str, count: int = 3, exact: bool = True) -> tuple[Fraction, ...]:
    """A vector of exact numbers with this many components, or with at most this many."""
    listed = first_of(values, count + 1)
    if len(listed) > count or (exact and len(listed) < count):
        raise BadInput(f"{name} must be {'' if exact else 'at most '}{count} numbers, not {brief(values)}")
    return tuple(exactly(x, f"{name} {i}") for i, x in enumerate(listed, start=1))


#: The identity.
NO_TURN: Vector = (arb(1), arb(0), arb(0), arb(0))


class Principal(NamedTuple):
    """Principal moments of ∫xxᵀdm, and the unit quaternion from the principal to the given axes."""

    moments: Vector
    turn: Vector = NO_TURN

    def inward(self, vector: Balls) -> Vector:
        """A vector, converted from the given axes to principal axes."""
        return tuple(vector) if self.turn == NO_TURN else tuple(generated.transport(*self.turn, *vector))

    def given(self, frame: dict[str, Vector]) -> dict[str, Vector]:
        """A frame, converted from principal axes to the given axes."""
        if self.turn == NO_TURN:
            return frame
        found = {name: generated.rotate(*self.turn, *frame[name]) for name in ("gamma", "angular_momentum", "omega")}
        back = self.turn[0], *(-x for x in self.turn[1:])
        return frame | found | {"attitude": unit(generated.compose(*(*frame["attitude"], *back)))}


def principal(tensor: Sequence[Balls]) -> Principal:
    """The principal axes of a symmetric matrix of balls; raises TooWide where its moments may be equal.

    An eigenvector of a simple real eigenvalue is a complex multiple of a real vector, so ratios of its components are
    real.  The third axis is normal to the two others.
    """
    if all(tensor[i][j] == 0 for i in range(3) for j in range(3) if i != j):
        return Principal(tuple(tensor[i][i] for i in range(3)))
    try:
        moments, vectors = acb_mat([list(row) for row in tensor]).eig(right=True)
    except ValueError:
        raise TooWide("the principal moments are not proved to differ") from None
    columns = []
    for j in range(2):
        v = [vectors[i, j] for i in range(3)]
        largest = max(v, key=lambda x: float(abs(x).mid()))
        columns.append(unit([(x / largest).real for x in v]))
    columns.append(cross(*columns))
    turn = tuple(quaternions(np.array(columns, dtype=object).T))
    found = Principal(tuple(x.real for x in moments), turn)
    if not all(x.is_finite() for x in (*found.moments, *found.turn)):
        raise TooWide("the principal moments are not proved to differ")
    return found


def principal_exactly(rows: Sequence[Sequence[Fraction]]) -> Principal:
    """`principal` of a symmetric matrix of rational numbers, of which two moments may be equal."""
    if (round_ := _round(rows)) is None:
        return principal([balls(row) for row in rows])
    twice, once, axis = round_
    least_ = min(range(3), key=lambda i: abs(axis[i]))  # the axis that is farthest from this one
    third = unit(balls(axis))
    first = unit(balls(cross(axis, [Fraction(i == least_) for i in range(3)])))
    turn = tuple(quaternions(np.array([first, cross(third, first), third], dtype=object).T))
    return Principal((ball(twice), ball(twice), ball(once)), turn)


def _round(rows: Sequence[Sequence[Fraction]]) -> tuple[Fraction, Fraction, Sequence[Fraction]] | None:
    """Two equal moments, the third, and a vector along its axis: T is not diagonal, and T - λ is s vvᵀ; or None."""
    a, b, c = rows[0][1], rows[0][2], rows[1][2]
    if a and b and c:
        twice = rows[0][0] - a * b / c  # s v₁²
    elif (a, b, c).count(Fraction(0)) == 2:  # v is normal to one of the given axes
        twice = rows[2][2] if a else rows[1][1] if b else rows[0][0]
    else:
        return None
    left = [[x - twice * (i == j) for j, x in enumerate(row)] for i, row in enumerate(rows)]
    k = max(range(3), key=lambda i: abs(left[i][i]))
    if any(left[i][j] * left[k][k] != left[i][k] * left[j][k] for i in range(3) for j in range(3)):
        return None
    return twice, sum((rows[i][i] for i in range(3)), -2 * twice), left[k]


@dataclass(frozen=True)
class Start:
    """The data of a motion.

    mass_tensor, D: exact.
    axes: for a tensor that is not diagonal in the axes of the body, in place of mass_tensor, a function that gives its
    principal moments and axes in balls at the precision that is set.
    attitude: gives a quaternion of any length, in such balls.  momentum: gives K in principal axes.
    radius: exact, or None.
    position: exact.  rotor: the angular momentum of a rotor, in body axes; it is part of K.
    """

    mass_tensor: Sequence[Fraction]
    D: Fraction
    attitude: Callable[[], Balls]
    momentum: Callable[[Balls, Principal], Balls]
    radius: Fraction | None = None
    position: tuple[Fraction, Fraction] = (Fraction(0), Fraction(0))
    rotor: Sequence[Turns] = NO_ROTOR
    axes: Callable[[], Principal] | None = None

    def path(self, precision: int) -> Path:
        """The motion at the start, at this precision; raises TooWide if this does not separate the axes."""
        axes = Principal(balls(self.mass_tensor)) if self.axes is None else self.axes()
        a = unit(generated.compose(*unit(self.attitude()), *axes.turn))
        radius, rotor = None if self.radius is None else ball(self.radius), axes.inward(balls(self.rotor))
        path = Path(precision, axes.moments, ball(self.D), self.momentum(a, axes), a, radius, rotor)
        path.given = axes.given
        path.contact = (ball(self.position[0]), ball(self.position[1]))
        return path


def upright(gamma: Sequence[Number]) -> Callable[[], Balls]:
    """The least rotation that turns γ, of any length, to the vertical."""
    return lambda: least(*unit(balls(gamma)))


def fixed(momentum: Sequence[Number]) -> Callable[[Balls, Principal], Balls]:
    """The constant K."""
    return lambda attitude, axes: axes.inward(balls(momentum))


def turning(
    omega: Sequence[Number], D: Fraction, space: bool, rotor: Sequence[Number] = NO_ROTOR
) -> Callable[[Balls, Principal], Balls]:
    """K = B(γ)ω + a, with ω in body axes or in space axes, and a of the rotor."""

    def momentum(attitude: Balls, axes: Principal) -> Balls:
        v = generated.transport(*(*attitude, *balls(omega))) if space else axes.inward(balls(omega))
        own = generated.contact_momentum(*(*v, *generated.rotation(*attitude)[6:], *axes.moments, ball(D)))
        return tuple(x + y for x, y in zip(own, axes.inward(balls(rotor)), strict=True))

    return momentum
