"""Dual numbers over any numbers: a value and its derivative along one direction, exact to the first order."""

from collections.abc import Callable, Sequence
from typing import Any


class Dual:
    """value + slope·δ with δ² = 0."""

    __slots__ = ("slope", "value")

    def __init__(self, value: Any, slope: Any = 0) -> None:
        self.value, self.slope = value, slope

    def __add__(self, other: Any) -> "Dual":
        if not isinstance(other, Dual):
            return Dual(self.value + other, self.slope)
        return Dual(self.value + other.value, self.slope + other.slope)

    def __neg__(self) -> "Dual":
        return Dual(-self.value, -self.slope)

    def __sub__(self, other: Any) -> "Dual":
        other = _dual(other)
        return Dual(self.value - other.value, self.slope - other.slope)

    def __rsub__(self, other: Any) -> "Dual":
        return _dual(other) - self

    def __mul__(self, other: Any) -> "Dual":
        if not isinstance(other, Dual):
            return Dual(self.value * other, self.slope * other)
        return Dual(self.value * other.value, self.value * other.slope + self.slope * other.value)

    def __truediv__(self, other: Any) -> "Dual":
        other = _dual(other)
        quotient = self.value / other.value
        return Dual(quotient, (self.slope - quotient * other.slope) / other.value)

    def __pow__(self, n: int) -> "Dual":
        return Dual(self.value**n, n * self.value ** (n - 1) * self.slope if n else 0 * self.slope)

    def __rtruediv__(self, other: Any) -> "Dual":
        return _dual(other) / self

    __radd__, __rmul__ = __add__, __mul__


def derivative(function: Callable[[Sequence[Any]], Any], at: Sequence[Any], along: Sequence[Any]) -> Any:
    """The derivative of a function along a direction: what it returns, with slopes in the place of numbers."""
    found = function([Dual(x, y) for x, y in zip(at, along, strict=True)])
    return [_dual(x).slope for x in found] if isinstance(found, list | tuple) else _dual(found).slope


def _dual(x: Any) -> Dual:
    return x if isinstance(x, Dual) else Dual(x)
