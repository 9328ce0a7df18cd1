"""One continuous motion in progress: a step finds polynomials, corrects them to rounding, and proves them.

How they are found is not proved: only the bounds that `deviation` proves of them are used.

Each correction gains more bits than the last.  Neighbours of the motion have ξ' = Aξ (see `deviation`).  With Φ' = AΦ,
Φ(0) = 1 and Ψ = Φ⁻¹ ξ = -½Φ∫Ψ(B⁻¹κ + ε) removes the defects e and κ of p and w to the first order: a correction gains
as many bits as Φ has.  Φ is corrected in the same way, by -Φ∫Ψ(Φ' - AΦ), which doubles its bits.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from fractions import Fraction
from typing import NamedTuple

import numpy as np
from flint import arb, arb_poly, arb_series

from chapsym import generated
from chapsym.numbers.precisions import flint_bits, flint_terms

from ..errors import TooWide
from ..levels.balls import Spread, log2_of, point, unit
from ..levels.balls import exact as ball
from ..levels.proved_root import MATRIX_BITS, Vector, highest, upper
from ..levels.start import exponent_of
from ..loops.branch import moments
from ..loops.vectors import cross, dot
from .deviation import Body, Defects, Polynomials, bound, defects, deviation, exact
from .series import LONG, TERMS, Series, linear, long_float, motion

Row = Sequence[arb_series]
Rows = Sequence[Row]


class Neighbours:
    """Φ and Ψ of a step, exact polynomials; call its methods at the precision of the gained bits.

    tick: called within these, as that of a `Path`.
    """

    def __init__(self, series: Series, body: Body, tick: Callable[[], None]) -> None:
        back = linear(-np.transpose(series.A, (0, 2, 1)), np.zeros((len(series.A) - 1, 3, 3)), np.eye(3))
        self.tick, self.body, self.phi, self.psi = tick, body, _rows(series.Phi), _rows(np.transpose(back, (0, 2, 1)))

    def mend(self, p: Polynomials, w: Polynomials, terms: int) -> None:
        """Doubles the bits of Φ and Ψ, if p and w have that many."""
        with flint_terms(terms):
            gamma, omega, phi, psi = generated.rotation(*_series(p))[6:], _series(w), *map(_all, (self.phi, self.psi))
            off = []
            for column in zip(*phi, strict=True):
                turned = self._solved(self.body.bent(omega, column), gamma)
                off.append([x.derivative() - y for x, y in zip(column, turned, strict=True)])
            mixed = self._product(psi, list(zip(*off, strict=True)))
            less = self._product(phi, [[x.integral() for x in row] for row in mixed])
            phi = _all([[x - y for x, y in zip(*rows, strict=True)] for rows in zip(phi, less, strict=True)])
            one = self._product(phi, psi)
            twice = [[2 * (i == j) - x for j, x in enumerate(row)] for i, row in enumerate(one)]
            self.phi, self.psi = ([_exact(row) for row in x] for x in (phi, self._product(psi, twice)))

    def correction(self, p: Polynomials, w: Polynomials, found: Defects, terms: int) -> tuple[Polynomials, Polynomials]:
        """The correction that removes the defects of p and w to the first order when it is added."""
        with flint_terms(terms):
            a, omega = _series(p), _series(w)
            e, kappa, (off,) = map(_series, (found.e, found.kappa, [found.off]))
            gamma = generated.rotation(*a)[6:]
            # κ has |p|²R in place of R; the corrections remove this error, too.
            central = generated.contact_momentum(*(*omega, *gamma, *self.body.J, -self.body.D))
            whole = [x + y for x, y in zip(central, self.body.rotor, strict=True)]
            b = self._solved([x + off * y for x, y in zip(kappa, whole, strict=True)], gamma)
            away = generated.compose(a[0], -a[1], -a[2], -a[3], *e)
            rest = self._product(_all(self.psi), [[x + 2 * y] for x, y in zip(b, away[1:], strict=True)])
            xi = [arb(-0.5) * x for (x,) in self._product(_all(self.phi), [[x.integral()] for (x,) in rest])]
            move = generated.compose(*(*a, -away[0].integral(), *xi))  # the scalar brings |p| to 1
            turn = cross(omega, xi)
            change = [2 * (x + y + z.derivative()) for x, y, z in zip(turn, away[1:], xi, strict=True)]
            return _exact(move), _exact(change)

    def _solved(self, v: Row, gamma: Row) -> Row:
        """B⁻¹v."""
        self.tick()
        return generated.angular_velocity(*(*v, *gamma, *self.body.J, self.body.D))

    def _product(self, left: Rows, right: Rows) -> Rows:
        """The product of two matrices."""
        self.tick()
        columns = list(zip(*right, strict=True))
        return [[sum(x * y for x, y in zip(row, column, strict=True)) for column in columns] for row in left]


def _series(polynomials: Iterable[arb_poly | arb_series]) -> list[arb_series]:
    """The rounded midpoints, as series."""
    return [arb_series(exact(exact(x) * arb(1))) for x in polynomials]


def _all(rows: Iterable[Polynomials | Row]) -> Rows:
    return [_series(row) for row in rows]


def _exact(series: Row) -> list[arb_poly]:
    return [exact(x) for x in series]


def _rows(matrices: np.ndarray) -> Sequence[Polynomials]:
    """A matrix of polynomials, from the matrices of their coefficients."""
    return [[arb_poly(matrices[:, i, j].tolist()) for j in range(3)] for i in range(3)]


#: The length of a step, as a part of the radius of convergence (least cost per unit of time), and in radians.
PART, RADIANS = 1 / math.e, 2.0
#: The largest ratio of the step to the unit of time of the series, and the number of trials for it.
ALIKE, LOOKS = 1.5, 4
#: The number of times that a step without a proof is halved.
HALVINGS = 5
#: The bits that a correction in float64 is assumed to gain, and the bits that are carried beyond the known ones.
GAIN, BEYOND = 48, 66
#: The number of bits by which the error after the last correction exceeds the rounding.
LEFT = 11
#: Φ gets more bits while more than this many times the gain is missing; and the bits that its correction loses.
FAR, LOST = 4, 12
#: The number of ineffective corrections that is allowed, and the factor of the number of terms that is tried then.
STUCK, MORE_TERMS = 1, 1.25


class Path:
    """A motion in balls of `precision` bits; call every method with that precision set.

    attitude: a quaternion; K: the momentum; rotor: the momentum of a rotor, in body axes; all in balls.
    time: exact, since the start.  steps: taken so far.  tick: called within a step; an exception that it raises ends
    the step.
    given: converts a frame from the axes of the tensor to other axes.
    """

    def __init__(
        self, precision: int, J: Vector, D: arb, K: Sequence[arb], attitude: Sequence[arb], radius: arb | None,
        rotor: Sequence[arb | int] = (0, 0, 0),
    ) -> None:  # fmt: skip
        self.precision, self.time, self.steps = precision, Fraction(0), 0
        self.tick: Callable[[], None] = lambda: None
        self.given: Callable[[dict[str, Vector]], dict[str, Vector]] = lambda frame: frame
        self.scale = arb(2) ** log2_of(highest(*moments(J)) + D)
        self.body = Body(tuple(x / self.scale for x in J), D / self.scale, tuple(x / self.scale for x in rotor))
        self.k = generated.rotate(*(*unit(attitude), *(x / self.scale for x in K)))
        self.p, far = point(unit(attitude))
        self.spread = Spread()
        self.radius = radius
        self.contact: Vector = (arb(0), arb(0))
        self.rough = 0.0
        self.last: Last | None = None
        with flint_bits(MATRIX_BITS):
            self.spread.restart(far)

    @property
    def width(self) -> float:
        """The logarithm to base 2 of a bound of the error of the attitude."""
        return log2_of(self.spread.size)

    def advance(self, end: Fraction) -> None:
        """Advances to a later time, or a part of the way; raises TooWide if the balls allow no proof."""
        for halved in range(HALVINGS + 1):
            series, length = self._series(end - self.time, 0.5**halved)
            k = tuple(ball(length) * x for x in self.k)
            body = self.body.during(ball(length))
            p, w, found = self._mended(series, k, body)
            try:
                with flint_bits(MATRIX_BITS):
                    proved = deviation(series, w, upper(k), found, body, self.spread.size)
                break
            except TooWide:
                if halved == HALVINGS:
                    raise
        moved = None if self.radius is None else _rolled(self.radius, w, found, proved.slip)
        self.last = Last(self.time, length, p, proved.within, self.contact, moved)
        if moved is not None:
            self.contact = self.last.place(arb(1))
        self.p, far = point(unit(sum(x.coeffs(), arb(0)) for x in p))
        with flint_bits(MATRIX_BITS):
            # p∘(1, ε)∘(1, ξ) is p∘(1, ξ'), |ξ' - ξ| ≤ |ε|(1 + |ξ| + |ξ|²)/(1 - |ε||ξ|) ≤ 2|ε|.
            self.spread.moved(proved.M, proved.more + 2 * far)
        self.time, self.steps = self.time + length, self.steps + 1

    def _series(self, left: Fraction, part: float) -> tuple[Series, Fraction]:
        """The series in float64 in units of the next step, and the length of the step: `part` of the best length."""
        a, k, J, s = (np.array([long_float(x) for x in v]) for v in (self.p, self.k, self.body.J, self.body.rotor))
        D = long_float(self.body.D)
        whole = float(left)
        unit_of_time = min(self.rough or _turn(a, k, J, D, s) or whole, whole)
        for _ in range(LOOKS):
            with np.errstate(all="ignore"):  # a series that overflows has no reach
                found = motion(a, unit_of_time * k, J, D, unit_of_time * s)
            rate = float(np.linalg.norm(found.w[:, 0])) / unit_of_time
            most = part * min(PART * unit_of_time * found.reach(), RADIANS / rate if rate else math.inf)
            if not most > 0:
                raise TooWide
            # Rounding grows with the powers of the length, so the unit is about the length.
            if min(most, whole) < ALIKE * unit_of_time:
                break
            unit_of_time = min(most, whole)
        self.rough = unit_of_time
        count = math.ceil(whole / most) if whole > most else 1
        length = left if count == 1 else _short(left / count)
        return found.scaled(LONG(float(length)) / LONG(unit_of_time)), length

    def _degree(self, series: Series) -> int:
        """The number of terms that makes the truncation error less than the rounding."""
        small = series.sizes() < 2.0**-self.precision
        if small[-2:].all():
            return max(int(np.flatnonzero(~small)[-1]), 1) + 3
        reach = series.reach()
        bits = math.log2(reach) if reach > 1 else 0.5
        return max(math.ceil(self.precision / bits), 2) + 4

    def _mended(self, series: Series, k: Vector, body: Body) -> tuple[Polynomials, Polynomials, Defects]:
        """Exact polynomials p and w, and their defects at the whole precision; k and `body` are those of the step."""
        degree = self._degree(series)
        terms = min(degree + 1, TERMS)
        p = [x - x(0) + y for x, y in zip(_polys(series.a[:, :terms]), self.p, strict=True)]
        p, w = [exact(x) for x in p], [exact(x) for x in _polys(series.w[:, :terms])]
        bits, stuck, size, gain = GAIN, 0, math.inf, GAIN
        neighbours = Neighbours(series, body, self.tick)
        while True:
            self.tick()
            bits = min(bits + BEYOND, self.precision)
            with flint_bits(bits):
                found = defects(p, w, k, body, self._terms(degree, bits) - 1)
                before, size = size, log2_of(bound([*found.e, *found.kappa]))
            if bits == self.precision:
                stuck += size > before - 2
                if size <= LEFT - self.precision or stuck > STUCK:
                    return p, w, found
                if stuck:
                    degree = math.ceil(MORE_TERMS * degree)
            known = math.floor(min(max(bits - BEYOND, -size), self.precision))
            further = min(2 * gain, known) - LOST
            if further > gain and self.precision - known > FAR * gain:
                gain = further
                with flint_bits(gain + BEYOND):
                    neighbours.mend(p, w, self._terms(degree, gain + BEYOND))
            with flint_bits(gain + BEYOND):
                change = neighbours.correction(p, w, found, self._terms(degree, known + gain + BEYOND))
            p, w = ([exact(x + y) for x, y in zip(*pair, strict=True)] for pair in zip((p, w), change, strict=True))
            bits = known + gain

    def _terms(self, degree: int, bits: int) -> int:
        """The number of terms that this many bits need."""
        return max(TERMS, min(degree, degree * bits // self.precision)) + 1

    def frame(self, time: Fraction) -> dict[str, Vector]:
        """The attitude, γ, K, ω and the contact point, if any, at the end of the last step or within it."""
        p, within, contact = self.p, self.spread.size, self.contact
        if time != self.time:
            assert self.last is not None
            tau = ball((time - self.last.time) / self.last.length)
            p, within, contact = tuple(x(tau) for x in self.last.p), self.last.within, self.last.place(tau)
        off = arb(0, within)
        a = unit(generated.compose(*(*p, 1, off, off, off)))
        R = generated.rotation(*a)
        gamma = unit(R[6:])
        k = tuple(sum((R[3 * i + j] * self.k[i] for i in range(3)), arb(0)) for j in range(3))
        relative = [x - y for x, y in zip(k, self.body.rotor, strict=True)]
        omega = generated.angular_velocity(*(*relative, *gamma, *self.body.J, self.body.D))
        found = {"gamma": gamma, "angular_momentum": tuple(x * self.scale for x in k), "omega": omega, "attitude": a}
        return self.given(found if self.radius is None else found | {"contact": contact})


class Last(NamedTuple):
    """A step: its start, its length, p, a bound of |ξ| on it, the contact point and its path."""

    time: Fraction
    length: Fraction
    p: Polynomials
    within: arb
    contact: Vector
    moved: Polynomials | None

    def place(self, tau: arb) -> Vector:
        """The contact point at a part of the step; where it began for a ball without a radius."""
        if self.moved is None:
            return self.contact
        return tuple(x + by(tau) for x, by in zip(self.contact, self.moved, strict=True))


def _rolled(radius: arb, w: Polynomials, found: Defects, slip: arb) -> Polynomials:
    """Polynomials of the way of the contact point: ρ(y₂, -y₁), y the turn in space, ϖ within `slip` of w."""
    x, y = (dot(found.R[i : i + 3], w) * found.unit + arb(0, slip) for i in (3, 0))
    return radius * x.integral(), -radius * y.integral()


def _polys(rows: np.ndarray) -> list[arb_poly]:
    """Polynomials of long floats."""
    high = rows.astype(float)
    rest = (rows - high).astype(float)
    return [arb_poly(x.tolist()) + arb_poly(y.tolist()) for x, y in zip(high, rest, strict=True)]


def _turn(a: np.ndarray, k: np.ndarray, J: np.ndarray, D: float, rotor: np.ndarray) -> float:
    """The time of about a radian, of the ball or of one that the rotor alone turns; 0 at rest."""
    R = np.reshape(generated.rotation(*a), (3, 3))
    with np.errstate(all="ignore"):  # numbers that are too far apart are refused
        turns = [generated.angular_velocity(*(*x, *R[2], *J, D)) for x in (k @ R - rotor, rotor)]
        rate = max(math.sqrt(sum(x * x for x in omega)) for omega in turns)
    return 1 / rate if rate else 0.0


def _short(x: Fraction) -> Fraction:
    """A time a little less, with few digits."""
    unit = Fraction(2) ** (exponent_of(x) - 12)
    return (x // unit) * unit
