"""The precisions as columns of the matrix: what an ulp is on each, and its numbers as exact ones."""

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import flint
import mpmath

from chapsym.numbers import Digits, Double, DoubleDouble, Enclosure, Pair, Precision, Single

#: Everything that is compared is compared with so many digits.
mp = mpmath.MPContext()
mp.dps = 140
#: The truth is known to this, relatively, and better.
KNOWN = mp.mpf(10) ** -80


@dataclass(frozen=True)
class Level:
    """A precision, one column.

    unit: an ulp relative to the size of a vector; least: the smallest number, below which nothing is resolved.
    guarded: whether guard digits absorb the condition number, so that the promise does not know it.
    """

    name: str
    precision: Precision
    unit: Fraction
    least: Fraction
    guarded: bool = False

    def spacing(self, size: Any) -> Any:
        """An ulp of numbers of this size, as an mpf."""
        return max(number(self.unit) * abs(size), number(self.least))


LEVELS = (
    Level("single", Single(), Fraction(1, 2**23), Fraction(1, 2**149)),
    Level("double", Double(), Fraction(1, 2**52), Fraction(1, 2**1074)),
    Level("quad", DoubleDouble(), Fraction(1, 2**104), Fraction(1, 2**1074)),
    Level("Digits(50)", Digits(50), Fraction(1, 10**49), Fraction(0), guarded=True),
    Level("Ball(200)", Enclosure(200), Fraction(1, 2**199), Fraction(0), guarded=True),
)
NAMES = tuple(level.name for level in LEVELS)


def level(name: str) -> Level:
    """The column with this name."""
    return LEVELS[NAMES.index(name)]


def number(value: Any) -> Any:
    """The exact value of a number of any precision, as an mpf; of a ball its centre."""
    if isinstance(value, Fraction):
        return mp.mpf(value.numerator) / value.denominator
    if isinstance(value, flint.arb):
        mantissa, exponent = value.mid().man_exp()
        return mp.ldexp(mp.mpf(int(mantissa)), int(exponent))
    if isinstance(value, Pair):
        return mp.mpf(value.high) + value.low
    return mp.mpf(float(value)) if not hasattr(value, "_mpf_") else mp.make_mpf(value._mpf_)


def radius(value: Any) -> Any:
    """How far the number may be from the truth, by its own account: 0 unless it is a ball."""
    return number(value.rad()) if isinstance(value, flint.arb) else mp.zero


def finite(values: Iterable[Any]) -> bool:
    """Whether all are numbers: no NaN, no infinity, no ball without bounds."""
    return all(x.is_finite() if isinstance(x, flint.arb) else bool(mp.isfinite(number(x))) for x in values)
