"""The number of roundings in the results of a kernel, counted in its text: a bound of its error in float64.

The terms of a formula are its value with absolute sums: |x| for a number x, terms(a) + terms(b) for a ± b, terms(a)
terms(b) for ab, terms(a) terms(b)/b² for a/b.  A result whose formula has n successive roundings has an error of at
most n 2⁻⁵³ (1 + 2⁻¹⁰) of its terms (lemma `rounding`), if nothing over- or underflows and no divisor is below 2⁻²⁵ of
its own terms: see `MOST` and `DIVISOR`.  Products by a power of 2 are exact.  Nothing overflows if no terms are above
`LARGEST`.  An underflow has the error 2⁻¹⁰⁷⁵, at most 2⁻¹⁰⁶ of terms that are not below `SMALLEST`: the part 2⁻¹⁰
covers this, too.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import inf, isfinite, nextafter
from typing import Any

from .kernels import Kernel

#: Half an ulp of 1, the factor for products of roundings, and the least divisor relative to its terms.
UNIT, MOST, DIVISOR = Fraction(1, 2**53), 1 + Fraction(1, 2**10), Fraction(1, 2**25)
#: The range of the terms of products and quotients, unless they are 0; the terms of sums are below the greater one.
SMALLEST, LARGEST = Fraction(1, 2**969), Fraction(2**1023)
#: The largest number of successive roundings and operations in the lemma.
DEEPEST = 256


@dataclass(frozen=True)
class Rounded:
    """An exact number of a kernel, with its terms and its number of successive roundings.

    steep: the least ratio of a divisor to its terms so far; 0 if something may over- or underflow.
    """

    value: Fraction
    terms: Fraction
    count: int = 0
    steep: Fraction = Fraction(1)

    def __add__(self, other: "Number") -> "Rounded":
        other = _number(other)
        count = max(self.count, other.count) + 1
        value, terms = self.value + other.value, self.terms + other.terms
        return _made(value, terms, count, min(self.steep, other.steep), terms <= LARGEST)

    def __neg__(self) -> "Rounded":
        return Rounded(-self.value, self.terms, self.count, self.steep)

    def __sub__(self, other: "Number") -> "Rounded":
        return self + -_number(other)

    def __rsub__(self, other: "Number") -> "Rounded":
        return -self + other

    def __mul__(self, other: "Number") -> "Rounded":
        other = _number(other)
        exact = any(x.count == 0 and _is_power_of_two(x.value) for x in (self, other))
        count = self.count + other.count + (not exact)
        value, terms = self.value * other.value, self.terms * other.terms
        return _made(value, terms, count, min(self.steep, other.steep), _in_range(terms))

    def __truediv__(self, other: "Number") -> "Rounded":
        other = _number(other)
        if other.count == 0 and _is_power_of_two(other.value):
            return self * (1 / other.value)
        count = self.count + other.count + 1
        if not other.value:
            return Rounded(Fraction(0), Fraction(0), count, Fraction(0))
        steep = min(self.steep, other.steep, abs(other.value) / other.terms)
        terms = self.terms * other.terms / other.value**2
        return _made(self.value / other.value, terms, count, steep, _in_range(terms))

    def __rtruediv__(self, other: "Number") -> "Rounded":
        return _number(other) / self

    __radd__, __rmul__ = __add__, __mul__


Number = Rounded | int | Fraction


def _made(value: Fraction, terms: Fraction, count: int, steep: Fraction, in_range: bool) -> Rounded:
    return Rounded(value, terms, count, steep if in_range else Fraction(0))


def _in_range(terms: Fraction) -> bool:
    """Whether the terms of a product or a quotient are in range."""
    return not terms or SMALLEST <= terms <= LARGEST


def _number(x: Number) -> Rounded:
    """An integer of a text, which is rounded, too, if it has more than 53 bits."""
    if isinstance(x, Rounded):
        return x
    value = Fraction(x)
    in_range = abs(value) <= LARGEST
    return _made(value, abs(value), int(in_range and Fraction(float(value)) != value), Fraction(1), in_range)


def _is_power_of_two(x: Fraction) -> bool:
    """Whether x = ±2^k, k of any sign: for constants of a text, as arguments are unknown."""
    n = abs(x.numerator) * x.denominator
    return n > 0 and n & (n - 1) == 0


def count(kernel: Kernel, function: Callable[..., Any], point: Sequence[Fraction]) -> int | None:
    """The largest number of roundings of a result in the text of a kernel.

    None if it calls functions, whose roundings are unknown, or if there are more roundings than in the lemma.
    point: any arguments that are no powers of 2, at which nothing is divided by 0.
    """
    if kernel.letters:
        return None
    results = function(*(Rounded(x, abs(x)) for x in point))
    found = max(_number(x).count for x in (results if isinstance(results, tuple) else (results,)))
    return found if found <= DEEPEST else None


def bounds(function: Callable[..., Any], *arguments: float) -> list[float]:
    """Upper bounds of the error of each result of a kernel in float64, for these arguments.

    Parameters
    ----------
    function : callable
        A kernel of `chapsym.generated`, or of another register, that calls no functions.
    *arguments : float
        The arguments of the kernel, one number each.

    Returns
    -------
    list of float
        A bound for each result; inf if a divisor is too near to 0 for the lemma, if something may over- or underflow,
        or for more than 256 roundings.

    Raises
    ------
    ValueError
        For an argument that is not finite.

    Examples
    --------
    >>> from chapsym.codegen.rounding import bounds
    >>> from chapsym.generated import rotate
    >>> max(bounds(rotate, 0.5, 0.5, 0.5, 0.5, 0.1, 0.2, 0.3)) < 1e-15
    True
    """
    if strange := [x for x in arguments if not isfinite(x)]:
        raise ValueError(f"an argument is {strange[0]}; bounds are of finite numbers")
    given = [_number(Fraction(float(x))) for x in arguments]
    results = function(*given)
    numbers = [_number(x) for x in (results if isinstance(results, tuple) else (results,))]
    parts = [x.count * UNIT * MOST * x.terms if x.steep >= DIVISOR and x.count <= DEEPEST else inf for x in numbers]
    return [nextafter(float(part), inf) if part else 0.0 for part in parts]
