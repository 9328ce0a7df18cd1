"""Double-double numbers with operators, so that the generated kernels run on them as on floats."""

from collections.abc import Callable
from fractions import Fraction
from functools import total_ordering

from . import pairs

Operator = Callable[["Pair", "Pair | float"], "Pair"]


def _operator(function: Callable[..., tuple[float, float]], swapped: bool = False) -> Operator:
    """An operator of `Pair` by an operation on halves."""

    def operate(self: "Pair", other: "Pair | float") -> "Pair":
        a, b = self, self._pair(other)
        if swapped:
            a, b = b, a
        return Pair(*function(a.high, a.low, b.high, b.low))

    return operate


@total_ordering
class Pair:
    """The number high + low, normalised: |low| is at most half an ulp of high.  It mixes with int and float exactly."""

    __slots__ = ("high", "low")

    def __init__(self, high: float, low: float = 0.0) -> None:
        self.high, self.low = pairs.two_sum(float(high), float(low))

    @classmethod
    def of(cls, value: "Fraction | int") -> "Pair":
        """The pair nearest to a rational number, within 2^-106 of it; raises OverflowError beyond float64."""
        high = float(value)
        return cls(high, float(value - Fraction(high)))

    def exactly(self) -> Fraction:
        """The number as a fraction; raises ValueError or OverflowError for NaN and infinities."""
        return Fraction(self.high) + Fraction(self.low)

    def halves(self) -> tuple[float, float]:
        """(high, low)."""
        return self.high, self.low

    def sqrt(self) -> "Pair":
        """The square root; raises ValueError below 0."""
        return Pair(*pairs.root(self.high, self.low))

    def _pair(self, other: "Pair | float") -> "Pair":
        if isinstance(other, Pair):
            return other
        return Pair.of(other) if isinstance(other, int) else Pair(other)

    __add__ = __radd__ = _operator(pairs.add)
    __sub__, __rsub__ = _operator(pairs.subtract), _operator(pairs.subtract, swapped=True)
    __mul__ = __rmul__ = _operator(pairs.multiply)
    __truediv__, __rtruediv__ = _operator(pairs.divide), _operator(pairs.divide, swapped=True)

    def __neg__(self) -> "Pair":
        return Pair(-self.high, -self.low)

    def __abs__(self) -> "Pair":
        return -self if self.high < 0.0 else self

    def __float__(self) -> float:
        return self.high

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Pair | int | float):
            return NotImplemented
        b = self._pair(other)
        return self.high == b.high and self.low == b.low

    def __lt__(self, other: "Pair | float") -> bool:
        b = self._pair(other)
        return self.high < b.high or (self.high == b.high and self.low < b.low)

    def __hash__(self) -> int:
        return hash((self.high, self.low)) if self.low else hash(self.high)

    def __repr__(self) -> str:
        return f"Pair({self.high!r}, {self.low!r})"
