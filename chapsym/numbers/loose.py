"""Numbers of the loops in double-double: floats that count as exact, and pairs of them, by the loose operations.

The generated kernels run on them as on floats: a product of two floats is an exact pair, and a float with a pair saves
half of the work.  Compiled, each operation is the function of `numbers.pairs` that it calls here, to the same bits.
"""

from collections.abc import Callable

import numpy as np

from . import pairs

#: A float, or an array of floats.
Half = float | np.ndarray


class Loose:
    """A float64 that counts as exact, or the sum of two, of arrays, too: what operations give is not normalised."""

    __slots__ = ("high", "low")
    __array_ufunc__ = None  # an array leaves its operations with a number to it

    def __init__(self, high: Half, low: Half | None = None) -> None:
        self.high, self.low = high, low

    def _with(self, other: "Loose | Half", forms: tuple[Callable, Callable, Callable]) -> "Loose":
        """The sum or the product with another number, by the form for two floats, a pair and a float, or two pairs."""
        a, b = self, other if isinstance(other, Loose) else Loose(other)
        of = Normal if isinstance(a, Normal) or isinstance(b, Normal) else Loose
        if a.low is None and b.low is None:
            return of(*forms[0](a.high, b.high))
        if b.low is None:
            return of(*forms[1](a.high, a.low, b.high))
        if a.low is None:
            return of(*forms[1](b.high, b.low, a.high))
        return of(*forms[2](a.high, a.low, b.high, b.low))

    def _added(self, total: "Loose") -> "Loose":
        return total.normalised() if isinstance(total, Normal) else total

    def _scaled(self, factor: float) -> "Loose":
        return type(self)(self.high * factor, None if self.low is None else self.low * factor)

    def normalised(self) -> "Loose":
        """The same pair, with its low half at most half an ulp of the high one."""
        return self if self.low is None else type(self)(*pairs.two_sum(self.high, self.low))

    def __neg__(self) -> "Loose":
        return type(self)(-self.high, None if self.low is None else -self.low)

    def __add__(self, other: "Loose | Half") -> "Loose":
        return self._added(self._with(other, (pairs.two_sum, pairs.loose_add_float, pairs.loose_add)))

    __radd__ = __add__

    def __sub__(self, other: "Loose | Half") -> "Loose":
        b = other if isinstance(other, Loose) else Loose(other)
        if self.low is None or b.low is None:
            return self + -b
        return self._added(self._with(b, (pairs.two_sum, pairs.loose_add_float, pairs.loose_subtract)))

    def __rsub__(self, other: "Loose | Half") -> "Loose":
        return -self + other

    def __mul__(self, other: "Loose | Half") -> "Loose":
        if isinstance(other, int) and other in (1, 2):
            return self if other == 1 else self._scaled(2.0)
        return self._with(other, (pairs.two_product, pairs.loose_multiply_float, pairs.loose_multiply))

    __rmul__ = __mul__

    def __truediv__(self, other: "Loose | Half") -> "Loose":
        if isinstance(other, int) and other == 2:
            return self._scaled(0.5)
        b = other if isinstance(other, Loose) else Loose(other)
        b = Loose(b.high, 0.0) if b.low is None else b.normalised()
        return type(self)(*pairs.divide(self.high, 0.0 if self.low is None else self.low, b.high, b.low))

    def __rtruediv__(self, other: Half) -> "Loose":
        return Loose(other) / self


class Normal(Loose):
    """A pair of which every sum is normalised: the halves of one that cancels overlap, which costs a product digits."""

    __slots__ = ()


def square_root(x: Loose) -> Loose:
    """√x of a pair."""
    x = x.normalised()
    return Loose(*pairs.root(x.high, x.low))
