"""Every rotation with a given momentum, from exact rational input: counted and enclosed, complete by proof.

The rotations are the real common points of three quadrics (5.2).  Where these have finitely many complex points in
common, `intersection` counts the real ones exactly and gives each as a rational function of an algebraic number,
which is enclosed to any precision; each simple one must also pass the interval Newton test of `newton`.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cmp_to_key
from typing import Any

import numpy as np
from flint import arb, fmpq

from chapsym.numbers import Digits, Enclosure, Precision
from chapsym.numbers.precisions import flint_bits

from ..ball import Asked, Ball
from ..errors import StepNotTaken
from ..levels.balls import exact
from ..levels.newton import enclosed
from ..levels.start import fraction
from ..map import in_float64, step, unit_exactly
from .candidates import Quadric, momentum_forms, quadrics
from .intersection import Form, NotFinite, Points, common_points

#: Working precisions are doubled at most so often.
MOST_PRECISIONS = 14
#: Bits that an enclosure has beyond those that are written.
SPARE = 12
#: The rounding of a float64 step is below this, even where D is large or a fold is near.
SAME = 1e-3
#: The float64 step belongs to the nearest rotation, if the next one is so many times farther away.
CLEARLY = 4.0


@dataclass(frozen=True)
class Branch:
    """One rotation with the given momentum.

    rotation: unit Euler parameters (q0, q1, q2, q3) as Arb balls; q0 ≥ 0, and at q0 = 0 the first of q1, q2, q3
    that is not 0 is positive.  A parameter that is 0 is exactly 0.
    angle: of the rotation, in [0, π].
    multiplicity: as a root of (5.2); 1 means that the tangent Jacobian is regular.
    small_rotation: whether it is the one that `step` takes.
    """

    rotation: tuple[Any, ...]
    angle: Any
    multiplicity: int
    small_rotation: bool = False


@dataclass(frozen=True)
class PreciseBranches:
    """All rotations with a momentum, by angle, in the numbers of a precision; `write` gives the contract's JSON fields.

    complete: whether it is proved that there is no other; if not, `reason` says why.
    """

    precision: Precision
    solutions: tuple[Branch, ...]
    complete: bool
    reason: str | None = None

    def write(self) -> dict[str, Any]:
        """count, complete and the solutions, as floats or decimal strings."""
        with self.precision.working():
            solutions = [_written(self.precision, branch) for branch in self.solutions]
        reason = {} if self.reason is None else {"reason": self.reason}
        return {"count": len(solutions), "complete": self.complete, **reason, "solutions": solutions}


def precise_branches(
    mass_tensor: Sequence[Fraction],
    D: Fraction,
    momentum: Sequence[Fraction],
    gamma: Sequence[Fraction],
    precision: Precision,
) -> PreciseBranches:
    """Every rotation Ω with 𝒦(q, γ) = 𝒦 (5.2) of one ball, from exact rational input.

    (q0, q) and (-q0, -q) are one rotation.  The equations are solved as they are given: a γ that is unit to the
    digits of the precision only is taken as it is.  The set is complete unless the complex solutions are infinitely
    many for a reason that is not understood, or the real ones are.

    Raises BadInput as `exact_step` does.
    """
    unit_exactly(gamma, precision)
    J, (contact,), K, g = np.split(np.array(in_float64(mass_tensor, (D,), momentum, gamma)), [3, 4, 7])
    try:
        taken = step(Ball(J, contact), K, g).rotation
    except StepNotTaken:
        taken = None
    given = momentum, gamma, mass_tensor, (D,)
    state = [[fmpq(x.numerator, x.denominator) for x in v] for v in given]
    equations = quadrics(state[0], state[1], state[2], *state[3])
    try:
        points = common_points([*equations, *_proportional(*state)])
    except NotFinite:
        found = _the_small_one(taken, given, precision)
        return PreciseBranches(precision, found, False, _why_infinite(equations))
    return PreciseBranches(precision, _with_small_rotation(_enclosures(points, precision, given), taken), True)


def _proportional(K: list, g: list, J: list, D: list) -> Iterator[Form]:
    """Linear equations that every rotation satisfies where 𝒦(q, γ) is q0 times a linear L(q), as for equal moments.

    Then q0 L(q) = 𝒦 ≠ 0, so that q0 ≠ 0 and 𝒦 × L(q) = 0, while the quadrics have a conic of complex points at q0 = 0.
    """
    forms = momentum_forms(g, J, *D)
    if not any(K) or any(c != 0 for form in forms for (a, _), c in form.items() if a > 0):
        return
    linear = [[form[0, v] for v in range(4)] for form in forms]
    for i, j in ((1, 2), (2, 0), (0, 1)):
        yield {(v,): K[i] * linear[j][v] - K[j] * linear[i][v] for v in range(4)}


def _why_infinite(equations: Sequence[Quadric]) -> str:
    """One sentence for quadrics that have a curve in common."""

    def common(i: int, j: int) -> bool:
        return all(e[pair] == 0 for e in equations for pair in ((i, i), (i, j), (j, j)))

    planes = [(i, j) for i, j in ((1, 2), (1, 3), (2, 3)) if common(i, j)]
    if len(planes) == 3:
        return "there are infinitely many: every rotation by pi has this momentum, which is 0"
    if planes:
        plane = "the plane of e{} and e{}".format(*planes[0])
        return f"there are infinitely many: every rotation by pi about an axis in {plane} has this momentum, which is 0"
    return "the equations have a curve of complex solutions in common, so that the real ones cannot be counted"


def _enclosures(points: Points, precision: Precision, given: Sequence[Sequence[Fraction]]) -> tuple[Branch, ...]:
    """The rotations in Arb, apart from each other, each component to the digits of the precision, by angle."""
    wanted = _bits(precision) + SPARE
    bits = 2 * wanted + 64
    for _ in range(MOST_PRECISIONS):
        with flint_bits(bits):
            found = [_branch(c, f.multiplicity) for f in points.factors for c in f.points(bits)]
            if _precise(found, wanted) and _apart(found) and _confirmed(found, given):
                return tuple(sorted(found, key=cmp_to_key(_order)))
        bits *= 2
    raise ArithmeticError("the rotations could not be enclosed")


def _branch(coordinates: tuple, multiplicity: int) -> Branch:
    """The rotation with these homogeneous coordinates."""
    length = sum((c * c for c in coordinates), arb(0)).sqrt()
    leading = next(c for c in coordinates if not c.is_zero())
    sign = -1 if leading < 0 else 1
    q = tuple(arb(0) if c.is_zero() else sign * c / length for c in coordinates)
    sine = arb(0) if all(c.is_zero() for c in q[1:]) else sum((c * c for c in q[1:]), arb(0)).sqrt()
    return Branch(q, 2 * arb.atan2(sine, q[0]), multiplicity)


def _precise(branches: Sequence[Branch], bits: int) -> bool:
    """Whether every number is exact or has so many bits; a leading parameter that has them has a sign."""
    return all(x.rel_accuracy_bits() >= bits for b in branches for x in (*b.rotation, b.angle))


def _apart(branches: Sequence[Branch]) -> bool:
    """Whether no two enclosures overlap."""
    return not any(
        all(x.overlaps(y) for x, y in zip(a.rotation, b.rotation, strict=True))
        for i, a in enumerate(branches)
        for b in branches[:i]
    )


def _confirmed(branches: Sequence[Branch], given: Sequence[Sequence[Fraction]]) -> bool:
    """Whether the interval Newton test, on the kernels, finds every simple root, at the same place."""
    state = [tuple(map(exact, vector)) for vector in given]
    for branch in branches:
        if branch.multiplicity == 1:
            again = enclosed(branch.rotation, *state)
            if again is None:
                return False
            if not all(x.overlaps(y) for x, y in zip(again, branch.rotation, strict=True)):
                raise ArithmeticError("the interval Newton test finds another rotation than the eliminant")
    return True


def _order(a: Branch, b: Branch) -> int:
    """By angle; for equal angles by q0, q1, q2, q3, the larger first."""
    if a.angle < b.angle or b.angle < a.angle:
        return -1 if a.angle < b.angle else 1
    for x, y in zip(a.rotation, b.rotation, strict=True):
        if x > y or x < y:
            return -1 if x > y else 1
    return 0


def _with_small_rotation(branches: tuple[Branch, ...], taken: Asked) -> tuple[Branch, ...]:
    """The same, with the one marked that the float64 step takes, if it takes one."""
    if taken is None:
        return branches
    places = [np.array([float(x.mid()) for x in branch.rotation]) for branch in branches]
    distances = [min(np.abs(q - taken).max(), np.abs(q + taken).max()) for q in places]
    first, second, *_ = [*sorted(distances), np.inf, np.inf]
    if first > SAME or CLEARLY * first >= second:
        return branches
    return tuple(replace(b, small_rotation=bool(d == first)) for b, d in zip(branches, distances, strict=True))


def _the_small_one(taken: Asked, given: Sequence[Sequence[Fraction]], precision: Precision) -> tuple[Branch, ...]:
    """The small rotation, if there is one that the interval Newton test encloses."""
    if taken is None:
        return ()
    bits = 2 * (_bits(precision) + SPARE) + 64
    with flint_bits(bits):
        state = [tuple(map(exact, vector)) for vector in given]
        found = enclosed(tuple(arb(float(x)) for x in taken), *state)
        return () if found is None else (replace(_branch(found, 1), small_rotation=True),)


def _bits(precision: Precision) -> int:
    if isinstance(precision, Enclosure):
        return precision.bits
    return math.ceil(precision.digits / math.log10(2)) if isinstance(precision, Digits) else 53


def _written(precision: Precision, branch: Branch) -> dict[str, Any]:
    q0, *q = (_number(precision, x) for x in branch.rotation)
    angle = _number(precision, branch.angle)
    return {
        "q0": q0, "q": q, "angle": angle,
        "multiplicity": branch.multiplicity, "small_rotation": branch.small_rotation,
    }  # fmt: skip


def _number(precision: Precision, value: arb) -> Any:
    """An Arb ball for JSON: the ball itself, or its midpoint, which is nearer than the digits that are written."""
    if isinstance(precision, Enclosure):
        return precision.write(value)
    return precision.write(precision.number(fraction(value)))
