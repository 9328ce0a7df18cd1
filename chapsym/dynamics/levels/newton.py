"""One step at any precision: the float64 root, refined by the same kernels on other numbers."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import flint

import chapsym.generated as generated
from chapsym.numbers import Ball as ArbBall
from chapsym.numbers import Double, Pair, Quad, Rung, Single

from ..ball import Ball
from ..errors import BadInput, Status, StepNotTaken
from ..loops.branch import inverse, inverse_of
from ..map import step
from .start import Exact, exponent_of, start

#: Refinement must stay this near to the float64 root, else another branch may have been met.
NEAR = 1e-6
MOST_REFINEMENTS = 60
MOST_INFLATIONS = 12
MOST_GUARDS = 4


@dataclass(frozen=True)
class PreciseStep:
    """A step in the numbers of a rung; `write` gives the contract's JSON fields."""

    rung: Rung
    rotation: tuple[Any, ...]
    momentum: tuple[Any, ...]
    gamma: tuple[Any, ...]

    def write(self) -> dict[str, Any]:
        """q0, q, momentum and gamma after the step, as floats or decimal strings."""
        with self.rung.precision():
            q0, *q = map(self.rung.write, self.rotation)
            return {
                "q0": q0,
                "q": q,
                "momentum": list(map(self.rung.write, self.momentum)),
                "gamma": list(map(self.rung.write, self.gamma)),
            }


def precise_step(
    mass_tensor: Sequence[Fraction],
    D: Fraction,
    momentum: Sequence[Fraction],
    gamma: Sequence[Fraction],
    rung: Rung,
) -> PreciseStep:
    """One step of one ball from exact rational input (5.3), on the small-rotation branch.

    Single, Double: as `step`.  Quad, Digits(n): Newton in those numbers from the root that the continuation finds.
    Ball(bits): Arb enclosures, the root proved to exist and to be unique near that one by the interval Newton test.
    The continuation is that of float64 where it can, else the same with more digits (`precise_start`); it is what says
    that this is the small-rotation branch.

    Raises BadInput, and StepNotTaken as `step` does.
    """
    unit_exactly(gamma, rung)
    check_body(mass_tensor, D)
    if isinstance(rung, Double | Single):
        return _rounded(rung, mass_tensor, D, momentum, gamma)
    if isinstance(rung, Quad):
        return _in_pairs(rung, mass_tensor, D, momentum, gamma)
    return _settled(rung, mass_tensor, D, momentum, gamma)


def _settled(rung: Rung, J: Exact, D: Fraction, K: Exact, g: Exact) -> PreciseStep:
    """The step from where the continuation ends, with as many guard digits as it takes."""
    near = start(K, g, J, D)
    for attempt in range(MOST_GUARDS):
        lost = _digits_lost(near, J, D, g) << attempt
        found = _taken(rung.guarded(lost), near, (K, g, J, (D,)))
        if found is not None:
            return found
    raise StepNotTaken(Status.NOT_CONVERGED, 1.0)


def _in_pairs(rung: Quad, J: Exact, D: Fraction, K: Exact, g: Exact) -> PreciseStep:
    """The step in units in which the ball is about 1: products of pairs underflow long before their halves do."""
    in_float64(J, (D,), K)
    exponent = exponent_of(max(J[1] + J[2], J[0] + J[2], J[0] + J[1]) + D)
    unit = Fraction(2) ** exponent
    if any(0 < abs(x) <= rung.smallest * max(Fraction(1), unit) for x in K):
        told = "a component of the momentum is below the range of double-double numbers"
        raise BadInput(f"{told}; ask for more with --digits or --ball")
    found = _settled(rung, [x / unit for x in J], D / unit, [x / unit for x in K], g)
    momentum = (Pair(*(math.ldexp(half, exponent) for half in x.halves())) for x in found.momentum)
    return replace(found, momentum=tuple(momentum))


def check_body(J: Sequence[Fraction], D: Fraction) -> None:
    """Raises BadInput unless a body has these moments; as `Ball` does, but of any size."""
    largest = max(map(abs, (*J, D)))
    scale = Fraction(1)
    if largest and not 1e-300 < largest < 1e300:
        scale = Fraction(2) ** -exponent_of(largest)
    # What is far smaller than the rest must not become 0: it is the difference between a body and none.
    Ball([_at_least(x * scale) for x in J], _at_least(D * scale))


def _at_least(x: Fraction) -> float:
    return float(x) if not x or abs(x) > 1e-300 else math.copysign(1e-300, x)


def _rounded(
    rung: Rung, J: Sequence[Fraction], D: Fraction, K: Sequence[Fraction], g: Sequence[Fraction]
) -> PreciseStep:
    """The step of the nearest floats."""
    numbers = in_float64(J, (D,), K, g)
    if any(x != 0 and float(x) == 0.0 for x in K):
        raise BadInput(
            "a component of the momentum is below the range of float64; ask for more with --digits or --ball"
        )
    found = step(Ball(numbers[:3], numbers[3]), numbers[4:7], numbers[7:], precision=rung)
    return PreciseStep(rung, *(tuple(map(float, x)) for x in (found.rotation, found.momentum, found.gamma)))


def _digits_lost(q: Sequence[Fraction], J: Sequence[Fraction], D: Fraction, g: Sequence[Fraction]) -> int:
    """How many digits the conditioning of the state can cost: log₁₀ of |T⁻¹|·2Λmax, and a few."""
    top = max(J[1] + J[2], J[0] + J[2], J[0] + J[1]) + D
    det, *entries = inverse(*(*q, *g, *(x / top for x in J), D / top))
    stretch = 2 * max(map(abs, entries)) if det else 10**300
    return 5 + max(0, math.ceil(exponent_of(Fraction(stretch)) * math.log10(2)))


def _taken(rung: Rung, near: Sequence[Fraction], given: Sequence[Sequence[Fraction]]) -> PreciseStep | None:
    """The step in the numbers of the rung; None if they do not settle, or if a ball is too large."""
    with rung.precision():
        exact = [tuple(map(rung.number, x)) for x in given]
        first = tuple(map(rung.number, near))
        q = enclosed(rung, first, *exact) if isinstance(rung, ArbBall) else refined(rung, first, *exact)
        if q is None:
            return None
        found = PreciseStep(rung, q, generated.transport(*q, *exact[0]), generated.transport(*q, *exact[1]))
        return found if not isinstance(rung, ArbBall) or _small_enough(rung, found) else None


def _small_enough(rung: ArbBall, found: PreciseStep) -> bool:
    """Whether every ball has `bits` correct bits, relative to the largest component of its vector."""
    unit = flint.arb(2) ** (3 - rung.bits)
    for vector in (found.rotation, found.rotation[1:], found.momentum, found.gamma):
        largest = max(abs(x.mid()) for x in vector)
        if any(x.rad() > largest * unit for x in vector):
            return False
    return True


def in_float64(*vectors: Sequence[Fraction]) -> list[float]:
    """All components as floats; raises BadInput for one that is too large."""
    try:
        return [float(x) for vector in vectors for x in vector]
    except OverflowError:
        raise BadInput("a number of the input is beyond the range of float64, where every step starts") from None


def unit_exactly(gamma: Sequence[Fraction], rung: Rung) -> None:
    """Raises BadInput unless |γ|² = 1 to the digits of the rung."""
    off = abs(sum((x * x for x in gamma), Fraction(-1)))
    shown = f"{float(off):.2g}" if off < 10**300 else "more than 1e300"
    if off > Fraction(1, 10**rung.digits):
        raise BadInput(
            f"gamma must be a unit vector to {rung.digits} digits, but |gamma|^2 is off 1 by {shown}; "
            "give it exactly, as rationals such as 2/7,3/7,6/7"
        )


def refined(rung: Rung, q: tuple, K: tuple, g: tuple, J: tuple, D: tuple) -> tuple | None:
    """Newton's iteration in the numbers of the rung, until a correction is below the square root of what is asked.

    Newton squares the correction, up to the digits that the conditioning costs, which the guard covers.
    """
    q = normalised(rung, q)
    settled = rung.number(rung.settled)
    for _ in range(MOST_REFINEMENTS):
        w = _correction(q, K, g, J, D)
        change = max(abs(x) for x in w)
        if change > NEAR:
            return None
        q = normalised(rung, generated.compose(*(*q, 1, *w)))
        if change <= settled * max(abs(x) for x in q[1:]):
            return q
    return None


def _correction(q: tuple, K: tuple, g: tuple, J: tuple, D: tuple) -> tuple:
    """The Newton correction w for unit q: q becomes q ∘ (1, w)."""
    r = generated.residual(*q, *K, *g, *J, *D)
    _, *i = inverse(*q, *g, *J, *D)
    return tuple(-(i[3 * n] * r[0] + i[3 * n + 1] * r[1] + i[3 * n + 2] * r[2]) for n in range(3))


def normalised(rung: Rung, p: tuple) -> tuple:
    """p divided by its length."""
    length = rung.sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3])
    return tuple(x / length for x in p)


def enclosed(rung: ArbBall, q: tuple, K: tuple, g: tuple, J: tuple, D: tuple) -> tuple | None:
    """Unit Euler parameters as balls that contain the one root near the float64 root."""
    q = tuple(x.mid() for x in normalised(rung, q))
    for _ in range(MOST_REFINEMENTS):
        w = tuple(x.mid() for x in _correction(q, K, g, J, D))
        change = max(abs(x) for x in w)
        if not change < NEAR:
            return None
        q = tuple(x.mid() for x in normalised(rung, generated.compose(*(*q, flint.arb(1), *w))))
        if change <= max(abs(x) for x in q[1:]) * flint.arb(2) ** (-(rung.bits + rung.guard) // 2 - 2):
            break
    # F(w) = 𝒦(q ∘ (1, w)) - |q|²(1 + |w|²)𝒦 vanishes exactly at the root; q is a point that is nearly unit.
    norm = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
    value = generated.residual(*q, *(norm * x for x in K), *g, *J, *D)
    tangent = generated.tangent_jacobian(*q, *g, *J, *D)
    hessian = generated.tangent_hessian(*q, *g, *J, *D)
    # At rest the value is exactly 0, so the box needs a size of its own.
    least = flint.arb(2) ** -(rung.bits + rung.guard)
    largest = max(abs(x).upper() for x in _apply(inverse_of(*tangent)[1:], value))
    radius = 4 * largest if largest > 0 else least
    for _ in range(MOST_INFLATIONS):
        box = tuple(flint.arb(0, radius) for _ in range(3))
        slope = _slope(tangent, hessian, tuple(norm * x for x in K), box)
        det, *inverse_slope = inverse_of(*slope)
        if det > 0 or det < 0:
            image = tuple(-x for x in _apply(inverse_slope, value))
            if all(b.contains_interior(x) for b, x in zip(box, image, strict=True)):
                return normalised(rung, generated.compose(*(*q, flint.arb(1), *image)))
        radius = radius * 4
    return None


def _apply(matrix: Sequence, vector: Sequence) -> tuple:
    """A 3×3 matrix, row by row, times a vector."""
    return tuple(sum(matrix[3 * i + j] * vector[j] for j in range(3)) for i in range(3))


def _slope(tangent: tuple, hessian: tuple, K: tuple, box: tuple) -> list:
    """F'(w) for every w in the box, row by row: T + H w - 2|q|²𝒦 wᵀ."""
    place = {(0, 0): 0, (1, 1): 1, (2, 2): 2, (1, 2): 3, (0, 2): 4, (0, 1): 5}
    rows = []
    for i in range(3):
        for j in range(3):
            bent = sum(hessian[3 * place[min(j, k), max(j, k)] + i] * box[k] for k in range(3))
            rows.append(tangent[3 * i + j] + bent - 2 * K[i] * box[j])
    return rows
