"""Taylor models in integers: functions on 0 ≤ s ≤ 1, each a polynomial with an error bound; and automatic derivatives.

All proofs rest on one property: if the functions x, y are in X, Y, then x∘y is in X∘Y for ∘ = + - *, and 1/x in 1/X.
As |s| ≤ 1, |polynomial| is at most the sum of its |coefficients|: truncation and rounding errors are added to `off`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import accumulate
from math import ceil
from operator import add, mul
from typing import Any

from .interval import Arithmetic, Interval, Rejected

#: Intervals, models, or duals of these.
Numbers = Sequence[Any]


class Model(Arithmetic):
    """The functions with |x(s) - Σ c_k s^k·2^-bits| ≤ off·2^-bits for 0 ≤ s ≤ 1; `terms`: the integers c_k."""

    __slots__ = ("bits", "off", "size", "terms")

    def __init__(self, terms: Sequence[int], off: int, bits: int):
        self.terms, self.off, self.bits = terms, off, bits
        self.size = sum(map(abs, terms))

    @classmethod
    def constant(cls, x: Fraction, bits: int) -> Model:
        """A constant function, as a polynomial of one term."""
        return cls.enclosing(Interval.about(x, bits))

    @classmethod
    def enclosing(cls, x: Interval) -> Model:
        """The model of one term that contains the numbers of an interval."""
        return cls([x.point().lo], (x.width + 1) >> 1, x.bits)

    @property
    def most(self) -> int:
        """A bound for |x(s)|·2^bits."""
        return self.size + self.off

    def _of(self, other: Model | int) -> Model:
        return Model([other << self.bits], 0, self.bits) if isinstance(other, int) else other

    def _padded(self, length: int) -> list[int]:
        return [*self.terms, *[0] * (length - len(self.terms))]

    def __add__(self, other: Model | int) -> Model:
        other = self._of(other)
        n = max(len(self.terms), len(other.terms))
        return Model(list(map(add, self._padded(n), other._padded(n))), self.off + other.off, self.bits)

    def __mul__(self, other: Model | int) -> Model:
        other = self._of(other)
        n = max(len(self.terms), len(other.terms))
        if min(len(self.terms), len(other.terms)) == 1:
            (one,), many = sorted((self.terms, other.terms), key=len)
            products, cut = [one * x for x in many], 0
        else:
            a, back = self._padded(n), other._padded(n)[::-1]
            products = [sum(map(mul, a[: k + 1], back[n - 1 - k :])) for k in range(n)]
            # The truncated terms: |a_i| times the last i coefficients of the other.
            cut = sum(map(mul, map(abs, a[1:]), accumulate(map(abs, back))))
        cut += self.off * other.most + self.size * other.off
        return Model([x >> self.bits for x in products], n - (-cut >> self.bits), self.bits)

    def __rtruediv__(self, other: int) -> Model:
        """other/x = other·r/(1 - e) for any polynomial r and e = 1 - x·r; 1/x is within |r||e|/(1 - |e|) of r."""
        if not self.terms[0]:
            raise Rejected("a function that is divided by is not proved to differ from 0")
        inverse = [(1 << 2 * self.bits) // self.terms[0]]
        for k in range(1, len(self.terms)):
            inverse.append(-sum(map(mul, self.terms[1 : k + 1], reversed(inverse))) // self.terms[0])
        near = Model(inverse, 0, self.bits)
        e, one = (1 - self * near).most, 1 << self.bits
        if e >= one:
            raise Rejected("a function that is divided by is not proved to differ from 0")
        return Model(inverse, -(-near.size * e // (one - e)), self.bits) * other

    def at(self, s: Interval) -> Interval:
        """An interval of the values at s, 0 ≤ s ≤ 1."""
        found = s._of(0)
        for x in reversed(self.terms):
            found = found * s + Interval(x, x, self.bits)
        return found.wider(self.off)

    def integral(self) -> Model:
        """The integrals from 0 to s."""
        n = len(self.terms)
        return Model([0, *(x // (k + 1) for k, x in enumerate(self.terms))], self.off + n, self.bits)

    def coarser(self, terms: int, bits: int) -> Model:
        """A model that contains the same functions, with fewer terms and bits."""
        less = self.bits - bits
        cut = self.off + sum(map(abs, self.terms[terms:]))
        return Model([x >> less for x in self.terms[:terms]], terms - (-cut >> less), bits)

    def wider(self, units: Fraction) -> Model:
        """All functions within units·2^-bits of these."""
        return Model(self.terms, self.off + ceil(units), self.bits)


class Dual(Arithmetic):
    """A number or a model, with its derivatives along some directions; a constant has no slopes."""

    __slots__ = ("slopes", "value")

    def __init__(self, value: Any, slopes: Numbers = ()):
        self.value, self.slopes = value, slopes

    def _times(self, factor: Any) -> Numbers:
        """The slopes times a factor."""
        return [x * factor for x in self.slopes]

    def __add__(self, other: Any) -> Dual:
        if not isinstance(other, Dual):
            return Dual(self.value + other, self.slopes)
        return Dual(self.value + other.value, _added(self.slopes, other.slopes))

    def __mul__(self, other: Any) -> Dual:
        if not isinstance(other, Dual):
            return Dual(self.value * other, self._times(other))
        return Dual(self.value * other.value, _added(other._times(self.value), self._times(other.value)))

    def inverse(self) -> Dual:
        """The reciprocal."""
        return 1 / self

    def __rtruediv__(self, other: int) -> Dual:
        one = 1 / self.value
        return Dual(one * other, self._times(one * one * -other))


def _added(a: Numbers, b: Numbers) -> Numbers:
    """The sum of two lists of slopes, either of which may be empty, for a constant."""
    return [x + y for x, y in zip(a, b, strict=True)] if a and b else a or b


def derivatives(of: Callable[[Numbers], Numbers], at: Numbers, along: Sequence[Numbers]) -> list[Dual]:
    """The values of a function of several numbers, with their derivatives along some directions."""
    found = of([Dual(x, slopes) for x, slopes in zip(at, zip(*along, strict=True), strict=True)])
    return [x if x.slopes else Dual(x.value, [0 * x.value] * len(along)) for x in found]
