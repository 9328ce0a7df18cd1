"""The Gibbs vector of a step on fixed-point integers, to any number of bits: float64, then corrections.

The numbers are Python integers, or what behaves like them (gmpy2's mpz, flint's fmpz), of which 2^P is one.
Where lemma `small-branch` holds the root is one in a convex region on which G is monotone, so any iteration that
settles there has found it.
"""

import math
from collections.abc import Callable, Sequence
from math import ldexp
from typing import Any

from chapsym.generated.fixed import cofactors_fixed, residual_fixed

from ..loops.gibbs import newton_round
from ..loops.sums import WEIGHTS

#: A mantissa that float64's exponents can hold.
FLOAT_BITS = 900
#: Up to so many bits, corrections by the float64 Jacobian; beyond, Newton's, each with twice the bits of the last.
CHORD_BITS = 220
#: The bits that the first correction by the float64 Jacobian is taken to gain.
GAIN = 40
#: Bits that Newton's iterates are short of twice those before.
SHORT = 12
MOST_ROUNDS = 100
#: The bits after the point of an inverse from float64.
INVERSE_BITS = 60

Vector = tuple[Any, ...]


class NotSettled(ArithmeticError):
    """The corrections did not become small."""


def to_float(x: Any, P: int) -> float:
    """A fixed-point integer as a float; one that is too large, which no rotation has for its momentum, as 1e150."""
    shift = P - FLOAT_BITS
    try:
        return ldexp(int(x), -P) if shift <= 0 else ldexp(int(x >> shift), -FLOAT_BITS)
    except OverflowError:
        return math.copysign(1e150, int(x > 0) - 0.5)


def from_float(x: float, P: int) -> int:
    """A float as a fixed-point integer, rounded down."""
    if P <= FLOAT_BITS and abs(x) < 2.0**100:
        return math.floor(ldexp(x, P))
    numerator, denominator = x.as_integer_ratio()
    return (numerator << P) // denominator


def extrapolated(past: Sequence[Vector]) -> Vector:
    """The next Gibbs vector by the polynomial through the last eight, newest first; 0 where there are fewer."""
    if len(past) < len(WEIGHTS):
        return 0.0, 0.0, 0.0
    u1 = u2 = u3 = 0.0
    for weight, (v1, v2, v3) in zip(WEIGHTS, past, strict=True):
        u1, u2, u3 = u1 + weight * v1, u2 + weight * v2, u3 + weight * v3
    return u1, u2, u3


def float_root(guess: Vector, k: Vector, g: Vector, I: Vector, D: float, rounds: int) -> tuple[Vector, list[float]]:
    """A Gibbs vector by Newton's iteration in float64 from a guess, and (∂G/∂u)⁻¹ row by row."""
    u1, u2, u3 = guess
    for _ in range(rounds):
        det, _, _, _, u1, u2, u3, _, d1, d2, d3, *cofactors = newton_round(*(u1, u2, u3, *k, *g, *I, D))
        if max(abs(d1), abs(d2), abs(d3)) <= 1e-7 * max(abs(u1), abs(u2), abs(u3)):
            break
    scale = 1.0 / det
    c11, c12, c13, c21, c22, c23, c31, c32, c33 = cofactors
    return (u1, u2, u3), [c * scale for c in (c11, c21, c31, c12, c22, c32, c13, c23, c33)]


def chord(u: Vector, k: Vector, g: Vector, I: Vector, D: Any, inverse: Sequence[Any], P: int, lost: int) -> Vector:
    """Corrections of u with one approximate inverse until the next would be below a unit, or below `lost` bits.

    Raises NotSettled if they do not shrink.
    """
    u1, u2, u3 = u
    i11, i12, i13, i21, i22, i23, i31, i32, i33 = inverse
    before = 0
    for _ in range(MOST_ROUNDS):
        r1, r2, r3 = residual_fixed(*(u1, u2, u3, *k, *g, *I, D, P))
        d1 = (i11 * r1 + i12 * r2 + i13 * r3) >> INVERSE_BITS
        d2 = (i21 * r1 + i22 * r2 + i23 * r3) >> INVERSE_BITS
        d3 = (i31 * r1 + i32 * r2 + i33 * r3) >> INVERSE_BITS
        u1, u2, u3 = u1 - d1, u2 - d2, u3 - d3
        change = int(max(abs(d1), abs(d2), abs(d3)))
        # Bit lengths are logarithms; the next correction is smaller by what this one was, beside the last.
        gain = before.bit_length() - change.bit_length() if before else GAIN
        if change.bit_length() <= max(gain, lost + 2):
            return u1, u2, u3
        if before and gain < 1:
            break
        before = change
    raise NotSettled


def newton(u: Vector, k: Vector, g: Vector, I: Vector, D: Any, P: int, half: int) -> Vector:
    """One correction of u with ∂G/∂u at `half` of the bits P."""
    cut = P - half
    cofactors = cofactors_fixed(*(*(x >> cut for x in (*u, *k, *g, *I, D)), half))
    det, c11, c12, c13, c21, c22, c23, c31, c32, c33 = cofactors
    r1, r2, r3 = residual_fixed(*(*u, *k, *g, *I, D, P))
    # The residual is small: its integers have about P - half bits.
    d1 = (c11 * r1 + c21 * r2 + c31 * r3) // det
    d2 = (c12 * r1 + c22 * r2 + c32 * r3) // det
    d3 = (c13 * r1 + c23 * r2 + c33 * r3) // det
    return u[0] - d1, u[1] - d2, u[2] - d3


def root(
    guess: Vector, k: Vector, g: Vector, I: Vector, D: Any, floats: tuple[Vector, float], P: int,
    number: Callable[[int], Any], lost: int,
) -> tuple[Vector, Vector]:  # fmt: skip
    """The Gibbs vector with P bits, from a guess in float64; returns it, and its float64 value.

    floats: I and D in float64.  number: makes an integer one of the kind that k, g, I and D are.  lost: the bits that
    the conditioning costs.  Raises NotSettled where it does not settle.
    """
    kf = (to_float(k[0], P), to_float(k[1], P), to_float(k[2], P))
    gf = (to_float(g[0], P), to_float(g[1], P), to_float(g[2], P))
    rounds = MOST_ROUNDS if guess == (0.0, 0.0, 0.0) else 2
    start, inverse = float_root(guess, kf, gf, *floats, rounds)
    if not all(map(math.isfinite, (*start, *inverse))):
        raise NotSettled
    levels = [P]
    while levels[-1] > CHORD_BITS + 4 * lost:
        levels.append(levels[-1] // 2 + SHORT + lost)
    p = levels.pop()
    fixed = [number(from_float(x, INVERSE_BITS)) for x in inverse]
    u = tuple(number(from_float(x, p)) for x in start)
    cut = P - p
    k_p, g_p, I_p = (tuple(x >> cut for x in vector) for vector in (k, g, I))
    u = chord(u, k_p, g_p, I_p, D >> cut, fixed, p, lost)
    while levels:
        half, p = p, levels.pop()
        cut = P - p
        k_p, g_p, I_p = (tuple(x >> cut for x in vector) for vector in (k, g, I))
        u = newton(tuple(x << (p - half) for x in u), k_p, g_p, I_p, D >> cut, p, half)
    return u, start
