"""Identities between rational functions of free parameters, decided without an ideal.

If rational functions of free parameters solve the constraints of a claim (rotations, unit vectors, a vertical
momentum), both sides of an identity are quotients of polynomials, and the identity holds exactly when the numerator of
the difference is the polynomial 0.  The arithmetic is that of python-flint's multivariate polynomials.  It shares
nothing with the rewriting of words or with division by a Gröbner basis, so that it is an independent second decision.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import prod
from typing import Any

from flint import Ordering, fmpq_mpoly, fmpq_mpoly_ctx

from chapsym.checker.interval import Arithmetic

#: The largest number of products of terms in one multiplication; the proofs need a third of it.
LIMIT = 10_000_000


class TooLarge(ArithmeticError):
    """An expression becomes too large, for example by a wrong definition, after which nothing cancels."""


#: The origin of a rational function: a parameter, an integer, an operation with its operands (the last one of ^ is a
#: power), or None for its lowest terms.
Made = str | int | tuple[Any, ...] | None


class Ratio(Arithmetic):
    """A rational function over Q with its origin; its denominator is monic and not 0.

    Sums and products are not brought to lowest terms: their greatest common divisors would take most of the time.
    """

    __slots__ = ("denominator", "made", "numerator")

    def __init__(self, numerator: fmpq_mpoly, denominator: fmpq_mpoly, made: Made = None) -> None:
        if denominator == 0:
            raise ZeroDivisionError("the denominator is the polynomial 0")
        common = numerator.gcd(denominator) * denominator.leading_coefficient()
        self.numerator, self.denominator, self.made = numerator / common, denominator / common, made

    def __eq__(self, other: object) -> bool:
        if (known := self._coerced(other)) is None:
            return NotImplemented
        return bool((self - known).numerator == 0)

    __hash__ = None  # type: ignore[assignment]  # as python-flint's polynomials have none

    def __add__(self, other: object) -> "Ratio":
        if (other := self._coerced(other)) is None:
            return NotImplemented
        if self.made == 0 or other.made == 0:  # for matrices with many zeros
            return other if self.made == 0 else self
        if self.denominator == other.denominator:
            return Ratio._of(self.numerator + other.numerator, self.denominator, ("+", self, other))
        common = self.denominator.gcd(other.denominator)
        mine, its = self.denominator / common, other.denominator / common
        above = _product(self.numerator, its) + _product(other.numerator, mine)
        return Ratio._of(above, _product(self.denominator, its), ("+", self, other))

    def __mul__(self, other: object) -> "Ratio":
        if (other := self._coerced(other)) is None:
            return NotImplemented
        for one, another in ((self, other), (other, self)):
            if one.made in (0, 1):
                return one if one.made == 0 else another
        above, below = _product(self.numerator, other.numerator), _product(self.denominator, other.denominator)
        return Ratio._of(above, below, ("*", self, other))

    def __truediv__(self, other: object) -> "Ratio":
        if (other := self._coerced(other)) is None:
            return NotImplemented
        return self * other._inverse()

    def __rtruediv__(self, other: int) -> "Ratio":
        return other * self._inverse()

    def __pow__(self, power: int) -> "Ratio":
        base = self if power >= 0 else self._inverse()
        result = prod([base] * abs(power), start=self._one())
        return Ratio._of(result.numerator, result.denominator, ("^", self, power) if power else 1)

    def lowest(self) -> "Ratio":
        """The function in lowest terms, as which it is exported, without its origin."""
        return Ratio(self.numerator, self.denominator)

    @classmethod
    def _of(cls, numerator: fmpq_mpoly, denominator: fmpq_mpoly, made: Made) -> "Ratio":
        """The quotient of two polynomials, the second monic, as it is."""
        ratio = object.__new__(cls)
        ratio.numerator, ratio.denominator, ratio.made = numerator, denominator, made
        return ratio

    def _inverse(self) -> "Ratio":
        """The reciprocal."""
        return Ratio(self.denominator, self.numerator, ("^", self, -1))

    def _coerced(self, other: object) -> "Ratio | None":
        """The other operand as a rational function of the same parameters; None if this is impossible."""
        if isinstance(other, Ratio):
            return other
        return self._one(other) if isinstance(other, int) else None

    def _one(self, times: int = 1) -> "Ratio":
        """The constant 1, or a multiple of it."""
        context = self.denominator.context()
        return Ratio._of(context.constant(times), context.constant(1), times)


def _product(a: fmpq_mpoly, b: fmpq_mpoly) -> fmpq_mpoly:
    """The product of two polynomials; raises TooLarge rather than fill the memory."""
    if len(a) * len(b) > LIMIT:
        raise TooLarge(f"a product of polynomials of {len(a)} and {len(b)} terms")
    return a * b


def parameters(names: str) -> list[Ratio]:
    """Free parameters, one for each name."""
    context = fmpq_mpoly_ctx.get(tuple(names.split()), Ordering.degrevlex)
    return [Ratio._of(x, context.constant(1), str(x)) for x in context.gens()]


@dataclass(frozen=True)
class Identity:
    """left = right, entry by entry, for all values of the free parameters for which both sides are defined.

    Parameters
    ----------
    text : str
        The statement in words or signs.
    left, right : sequence of Ratio or int
        The entries of the sides, rational functions of parameters.

    Raises
    ------
    ValueError
        If the sides do not have the same number of entries, or have none.

    Examples
    --------
    >>> from chapsym.prove import Identity
    >>> s, t = parameters("s t")
    >>> Identity("a square", [(s + t) ** 2], [s * s + 2 * s * t + t * t]).holds()
    True
    """

    text: str
    left: Sequence[Ratio | int]
    right: Sequence[Ratio | int]

    def __post_init__(self) -> None:
        if len(self.left) != len(self.right) or not len(self.left):
            raise ValueError(f"the two sides of «{self.text}» have {len(self.left)} and {len(self.right)} entries")

    @property
    def method(self) -> str:
        """How the statement is decided."""
        return "python-flint polynomials, rational parameterisation"

    @property
    def parameters(self) -> list[str]:
        """The names of the free parameters."""
        [names] = {x.denominator.context().names() for x in (*self.left, *self.right) if isinstance(x, Ratio)}
        return list(names)

    def holds(self) -> bool:
        """True exactly when the numerator of every left - right is the polynomial 0."""
        return all(a - b == 0 for a, b in zip(self.left, self.right, strict=True))
