"""The Gibbs vector of a step in Arb's numbers, to any number of bits: float64, then corrections.

Only midpoints count: what is found is a point, of which nothing is proved here.  Where lemma `small-branch` holds, the
root is one in a convex region on which G is monotone, so any iteration that settles there has found it.
"""

import math
from collections.abc import Sequence
from typing import Any

from flint import arb, ctx

from chapsym.generated import gibbs_newton, gibbs_residual

from ..loops.gibbs import newton_round
from ..loops.integrals import WEIGHTS

#: Up to so many bits, corrections by the float64 Jacobian; beyond, Newton's, each with twice the bits of the last.
CHORD_BITS = 300
#: Numbers of so many bits below 1 are in the range of float64.
FLOAT_BITS = 1000
#: What the first correction by the float64 Jacobian is taken to leave.
GAIN = 2.0**-40
#: Bits that Newton's iterates are short of twice those before.
SHORT = 12
MOST_ROUNDS = 100
#: The most rounds in float64, and the relative correction that is the last one: without a guess, and with one.  The
#: inverse is that of the last but one, so that each correction with it gains the digits of the last.
COLD, WARM = (100, 1e-7), (3, 1e-12)

Vector = tuple[Any, ...]


class NotSettled(ArithmeticError):
    """The corrections did not become small."""


def extrapolated(past: Sequence[Vector]) -> Vector:
    """The next Gibbs vector by the polynomial through the last eight, newest first; 0 where there are fewer."""
    if len(past) < len(WEIGHTS):
        return 0.0, 0.0, 0.0
    u1 = u2 = u3 = 0.0
    for weight, (v1, v2, v3) in zip(WEIGHTS, past, strict=True):
        u1, u2, u3 = u1 + weight * v1, u2 + weight * v2, u3 + weight * v3
    return u1, u2, u3


def root(guess: Vector, state: Vector, bits: int, lost: int, unit: Any) -> tuple[Vector, Vector]:
    """The Gibbs vector with so many bits, from a guess in float64; returns it, exact numbers, and its float64 value.

    state: k, γ, I and D, the largest moment about 1; unit: a power of two about |k|.  lost: the bits that the
    conditioning costs.  Raises NotSettled, or another ArithmeticError, where it does not settle.
    """
    before, precisions = ctx.prec, [bits]
    while precisions[-1] > CHORD_BITS + 4 * lost:
        precisions.append(precisions[-1] // 2 + SHORT + lost)
    try:
        start, inverse = _in_float64(guess, tuple(map(float, state)))
        ctx.prec = precisions.pop()
        u = _chord(start, _rounded(state) if precisions else state, inverse, lost, unit)
        while precisions:
            u = _newton(u, state, precisions.pop())
    finally:
        ctx.prec = before
    if not all(x.is_finite() for x in u):
        raise NotSettled
    return u, start


def _rounded(state: Vector) -> Vector:
    """The state with the bits of the working precision."""
    return tuple(+x for x in state)


def _in_float64(guess: Vector, state: Vector) -> tuple[Vector, list[float]]:
    """A Gibbs vector by Newton's iteration in float64, and (∂G/∂u)⁻¹, column by column."""
    u, (k, g, inertia, D) = guess, (state[:3], state[3:6], state[6:9], state[9])
    rounds, enough = COLD if guess == (0.0, 0.0, 0.0) else WARM
    for _ in range(rounds):
        r = newton_round(u, k, g, inertia, D)
        u = r.w
        if max(map(abs, r.d)) <= enough * max(map(abs, u)):
            break
    scale = 1.0 / r.p[0]
    inverse = [c * scale for c in r.cofactors]
    if not all(map(math.isfinite, (*u, *inverse))):
        raise NotSettled
    return u, inverse


def _chord(start: Vector, state: Vector, inverse: Sequence[float], lost: int, unit: Any) -> Vector:
    """Corrections with one approximate inverse until the next would be below a unit, or below `lost` bits.

    The corrections are floats, in that unit.  Raises NotSettled if they do not shrink.
    """
    if ctx.prec > FLOAT_BITS:
        raise NotSettled
    u1, u2, u3 = map(arb, start)
    c11, c12, c13, c21, c22, c23, c31, c32, c33 = inverse
    large, least, before = 1 / unit, 2.0**-ctx.prec, 0.0
    for _ in range(MOST_ROUNDS):
        r1, r2, r3 = gibbs_residual(u1, u2, u3, *state)
        r1, r2, r3 = float(r1 * large), float(r2 * large), float(r3 * large)
        d1 = c11 * r1 + c21 * r2 + c31 * r3
        d2 = c12 * r1 + c22 * r2 + c32 * r3
        d3 = c13 * r1 + c23 * r2 + c33 * r3
        u1, u2, u3 = u1 - d1 * unit, u2 - d2 * unit, u3 - d3 * unit
        change = max(abs(d1), abs(d2), abs(d3))
        # The next correction is taken to shrink by the same factor.
        gain = change / before if before else GAIN
        if change * gain <= least or change <= 4 * 2.0**lost * least:
            return u1.mid(), u2.mid(), u3.mid()
        if not gain < 1:
            break
        before = change
    raise NotSettled


def _newton(u: Vector, state: Vector, bits: int) -> Vector:
    """One correction of u to so many bits, with ∂G/∂u at the bits of the working precision, which becomes `bits`."""
    det, _, _, _, c11, c12, c13, c21, c22, c23, c31, c32, c33 = gibbs_newton(*u, *_rounded(state))
    half, ctx.prec = ctx.prec, bits
    residual = gibbs_residual(*u, *_rounded(state))
    ctx.prec = half
    r1, r2, r3 = (x.mid() / det for x in residual)
    d = c11 * r1 + c21 * r2 + c31 * r3, c12 * r1 + c22 * r2 + c32 * r3, c13 * r1 + c23 * r2 + c33 * r3
    ctx.prec = bits
    return tuple((x - y).mid() for x, y in zip(u, d, strict=True))
