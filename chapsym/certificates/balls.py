"""The numbers of a certificate: exact rationals, Arb's balls and vectors of them, and decimals to which they round."""

import itertools
from collections.abc import Iterable, Sequence
from decimal import Decimal
from fractions import Fraction

from flint import arb, ctx

from chapsym.dynamics.levels.proved_root import Vector, upper
from chapsym.dynamics.levels.start import fraction
from chapsym.generated import gibbs_newton

MOST_CORRECTIONS = 64


class NotProved(ArithmeticError):
    """The balls are too wide for the proof."""


def near_root(k: Sequence[arb], g: Sequence[arb], I: Vector, D: arb, near: Vector | None = None) -> Vector:
    """The Gibbs vector with k = 𝒦/2 and γ, unproved: Newton's iteration from 0 or `near`, at the midpoints of balls."""
    given = *_middles(k), *_middles(g), *_middles(I), D.mid()
    u: Vector = (arb(0), arb(0), arb(0)) if near is None else _middles(near)
    enough = arb(2) ** -(ctx.prec // 2 + 4)
    for _ in range(MOST_CORRECTIONS):
        det, *products = gibbs_newton(*(*u, *given))[:4]
        before, u = u, _middles(x / det for x in products)
        if upper(x - y for x, y in zip(u, before, strict=True)) < enough:
            return u
    raise NotProved("Newton's iteration did not settle")


def _middles(v: Iterable[arb]) -> Vector:
    return tuple(x.mid() for x in v)


def rounded(x: arb, digits: int) -> str:
    """The common rounding of the numbers of a ball to decimals; raises NotProved if they round differently."""
    middle, off = fraction(x), fraction(x.rad())
    found = round(middle - off, digits)
    if found != round(middle + off, digits):
        raise NotProved(f"a number does not round to {digits} decimals alike in the whole box")
    return decimal(found, digits)


def decimal(x: Fraction, digits: int) -> str:
    """A multiple of 10^-digits with this many decimals."""
    scaled = x * 10**digits
    assert scaled.denominator == 1, "not rounded"
    return f"{Decimal(f'{scaled}e-{digits}'):f}"


def decimals(x: Fraction) -> int | None:
    """The number of decimals of a number; None for infinitely many."""
    most = x.denominator.bit_length()
    return next((n for n in range(most + 1) if 10**n % x.denominator == 0), None)


def simplest(low: Fraction, high: Fraction) -> Fraction:
    """The number with the fewest decimals in the middle half of an interval, nearest to its middle."""
    middle, off = (low + high) / 2, (high - low) / 4
    candidates = (round(middle, digits) for digits in itertools.count())
    return next(x for x in candidates if abs(x - middle) <= off)


def shortest(x: Fraction) -> str:
    """A number as an exact string: 1e-40 for a power of 10 below 1, a decimal, else a fraction."""
    if (digits := decimals(x)) is None:
        return str(x)
    return f"1e-{digits}" if digits and x * 10**digits == 1 else decimal(x, digits)
