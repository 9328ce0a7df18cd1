"""Interval arithmetic with integers: [lo, hi]·2^-bits, every result rounded outward.

All proofs rest on one property: if x lies in X and y in Y, then x∘y lies in X∘Y for ∘ = + - * /, and √x in √X.
Sums are exact; a product, a quotient or a root is rounded down at the lower end and up at the upper end, by integer
arithmetic alone (`>>` and `//` round down, also for negative numbers).  There is no floating-point number.
"""

from __future__ import annotations

from fractions import Fraction
from functools import reduce
from math import isqrt
from operator import mul
from typing import Any


class Rejected(Exception):
    """The certificate is rejected; the message gives the reason in one sentence."""


class Arithmetic:
    """Operations derived from + and *: the negative, differences, powers, integers on the left."""

    __slots__ = ()

    def __neg__(self: Any) -> Any:
        return self * -1

    def __sub__(self: Any, other: Any) -> Any:
        return self + -other

    def __rsub__(self: Any, other: Any) -> Any:
        return -self + other

    def __radd__(self: Any, other: Any) -> Any:
        return self + other

    def __rmul__(self: Any, other: Any) -> Any:
        return self * other

    def __pow__(self: Any, power: int) -> Any:
        """The power, for an exponent other than 0."""
        return reduce(mul, [self if power > 0 else self.inverse()] * abs(power))


class Interval(Arithmetic):
    """The real numbers from lo·2^-bits to hi·2^-bits; `lo`, `hi`, `bits` are integers."""

    __slots__ = ("bits", "hi", "lo")

    def __init__(self, lo: int, hi: int, bits: int):
        self.lo, self.hi, self.bits = lo, hi, bits

    @classmethod
    def enclosing(cls, lo: Fraction, hi: Fraction, bits: int) -> Interval:
        """The smallest interval with this many bits that contains [lo, hi]."""
        return cls((lo.numerator << bits) // lo.denominator, -((-hi.numerator << bits) // hi.denominator), bits)

    @classmethod
    def about(cls, x: Fraction, bits: int, radius: Fraction | int = 0) -> Interval:
        """The interval of numbers within a radius of x."""
        return cls.enclosing(x - radius, x + radius, bits)

    def rescaled(self, bits: int) -> Interval:
        """The smallest interval with this many bits that contains this one."""
        return Interval.enclosing(Fraction(self.lo, 2**self.bits), Fraction(self.hi, 2**self.bits), bits)

    def _of(self, other: Interval | int) -> Interval:
        """An integer as an interval, exactly; an interval as it is, if the scales agree."""
        if isinstance(other, int):
            return Interval(other << self.bits, other << self.bits, self.bits)
        if other.bits != self.bits:
            raise TypeError("intervals of different scales")
        return other

    def __add__(self, other: Interval | int) -> Interval:
        if isinstance(other, int) or other.bits != self.bits:
            other = self._of(other)
        return Interval(self.lo + other.lo, self.hi + other.hi, self.bits)

    def __sub__(self, other: Interval | int) -> Interval:
        if isinstance(other, int) or other.bits != self.bits:
            other = self._of(other)
        return Interval(self.lo - other.hi, self.hi - other.lo, self.bits)

    def __mul__(self, other: Interval | int) -> Interval:
        if isinstance(other, int):  # exact
            low, high = (self.lo, self.hi) if other >= 0 else (self.hi, self.lo)
            return Interval(low * other, high * other, self.bits)
        a, b, c, d, bits = self.lo, self.hi, other.lo, other.hi, self._of(other).bits
        if a < 0 <= c:
            a, b, c, d = c, d, a, b
        if a >= 0:
            return Interval((a if c >= 0 else b) * c >> bits, -((b if d >= 0 else a) * -d >> bits), bits)
        if b <= 0:  # and c < 0
            return Interval((a if d >= 0 else b) * d >> bits, -(-a * c >> bits), bits)
        return Interval(min(a * d, b * c) >> bits, -(-max(a * c, b * d) >> bits), bits)

    def __truediv__(self, other: Interval | int) -> Interval:
        other = self._of(other)
        if other.hi < 0:
            return -self / -other
        if other.lo <= 0:
            raise Rejected("a number that is divided by is not proved to differ from 0")
        low, high = ((x << self.bits) // (other.hi if x >= 0 else other.lo) for x in (self.lo, -self.hi))
        return Interval(low, -high, self.bits)

    def __rtruediv__(self, other: int) -> Interval:
        return self._of(other) / self

    def sqrt(self) -> Interval:
        """The square roots of an interval of positive numbers."""
        if self.lo <= 0:
            raise Rejected("a number under a root is not proved to be positive")
        below, above = isqrt(self.lo << self.bits), self.hi << self.bits
        return Interval(below, isqrt(above - 1) + 1, self.bits)

    def __lt__(self, other: Interval | int) -> bool:
        """Whether every number here is less than every number there (so neither x < y nor y < x may hold)."""
        return self.hi < self._of(other).lo

    def __gt__(self, other: Interval | int) -> bool:
        """Whether every number here is greater than every number there."""
        return self.lo > self._of(other).hi

    @property
    def sign(self) -> int:
        """1 or -1 if all numbers have this sign, else 0 (undecided)."""
        return (self.lo > 0) - (self.hi < 0)

    @property
    def least(self) -> int:
        """The least |x|·2^bits in the interval, for the choice of a pivot."""
        return max(self.lo, -self.hi, 0)

    @property
    def most(self) -> int:
        """The greatest |x|·2^bits in the interval."""
        return max(-self.lo, self.hi)

    @property
    def width(self) -> int:
        """(hi - lo)·2^bits."""
        return self.hi - self.lo

    def point(self) -> Interval:
        """One number near the middle."""
        middle = (self.lo + self.hi) >> 1
        return Interval(middle, middle, self.bits)

    def wider(self, units: int) -> Interval:
        """Both ends moved outward by units·2^-bits."""
        return Interval(self.lo - units, self.hi + units, self.bits)

    def inside(self, other: Interval) -> bool:
        """Whether this interval lies in the interior of the other."""
        return other.lo < self.lo and self.hi < other.hi

    def within(self, centre: Fraction, radius: Fraction) -> bool:
        """Whether all x here have |x - centre| ≤ radius."""
        return (centre - radius) * 2**self.bits <= self.lo and self.hi <= (centre + radius) * 2**self.bits

    def hull(self, other: Interval) -> Interval:
        """The smallest interval that contains both."""
        return Interval(min(self.lo, other.lo), max(self.hi, other.hi), self.bits)

    def rounds_to(self, number: Fraction, digits: int) -> bool:
        """Whether all x here have |x - number| < ½·10^-digits: `number` is x rounded to that many decimals."""
        half = Fraction(1, 2 * 10**digits)
        return (number - half) * 2**self.bits < self.lo and self.hi < (number + half) * 2**self.bits
