"""The numbers of a certificate: exact rationals, Arb's balls, and decimals that are rounded outwards."""

import math
from fractions import Fraction
from typing import Any

from flint import arb

from chapsym.dynamics.precise_ball import exact
from chapsym.dynamics.precise_start import fraction

#: An enclosure in a file is this much wider than what was computed, so that a checker need not be as sharp; and by
#: 2^(SLACK - bits), so that it need not round as well.
WIDER, SLACK = 2, 10
#: Digits of a radius in a file.
RADIUS_DIGITS = 3


def ball(centre: Fraction, radius: Fraction = Fraction(0)) -> Any:
    """An Arb ball that contains centre ± radius."""
    return exact(centre) + arb(0, exact(radius).abs_upper())


def places(bits: int) -> int:
    """Decimal places that `bits` binary ones are worth, rounded down."""
    return math.floor(bits * math.log10(2))


def rounded(x: Any, digits: int) -> Fraction:
    """The middle of a ball, rounded to a multiple of 10^-digits."""
    return Fraction(round(fraction(x) * 10**digits), 10**digits)


def decimal(x: Fraction, digits: int) -> str:
    """A multiple of 10^-digits as a decimal without exponent."""
    scaled = x * 10**digits
    assert scaled.denominator == 1, "not rounded"
    whole = str(abs(scaled.numerator)).rjust(digits + 1, "0")
    text = f"{whole[:-digits]}.{whole[-digits:]}" if digits else whole
    return f"-{text}" if x < 0 else text


def shortest(x: Fraction) -> str:
    """An exact text of a number: 1e-40 for a power of 10 below 1, a decimal, else a fraction."""
    digits = 0
    while (x * 10**digits).denominator != 1 and digits < x.denominator.bit_length():
        digits += 1
    if (x * 10**digits).denominator != 1:
        return str(x)
    return f"1e-{digits}" if digits and x * 10**digits == 1 else decimal(x, digits)


def radius_text(x: Fraction) -> str:
    """An upper bound of x ≥ 0 with few digits, such as 2.31e-29."""
    if x == 0:
        return "0"
    exponent = _decade(x)
    more = RADIUS_DIGITS - 1
    return f"{decimal(Fraction(math.ceil(x * Fraction(10) ** (more - exponent)), 10**more), more)}e{exponent}"


def outwards(x: Any, bits: int) -> list[str]:
    """[centre, radius] of an interval around a ball, as the file has it: wider by WIDER and SLACK."""
    middle, radius = fraction(x), WIDER * fraction(x.rad()) + Fraction(2) ** (SLACK - bits)
    digits = max(0, -_decade(radius) + RADIUS_DIGITS - 1)
    centre = rounded(x, digits)
    return [decimal(centre, digits), radius_text(radius + abs(centre - middle))]


def inside(pair: list[str]) -> Any:
    """The Arb ball of what `outwards` wrote."""
    return ball(*map(Fraction, pair))


def _decade(x: Fraction) -> int:
    """The exponent n with about 10ⁿ ≤ x < 10ⁿ⁺¹."""
    return math.floor(math.log10(x.numerator) - math.log10(x.denominator))
