"""Polynomials with integer coefficients, and quotients of them, in expanded form.

A monomial is one integer with 16 bits for the exponent of each variable: a product of monomials is the sum of these
integers.  No degree reaches 2¹⁶, so no exponent overflows into the next.  The denominator of a quotient is a product of
powers of numbered factors of the ring; equal factors get the same number, and nothing else is cancelled.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import gcd, lcm

from .interval import Arithmetic, Rejected

#: The most work for one certificate, counted in products of two terms; the most terms, the greatest degree and the most
#: bits of coefficients of a polynomial.
MOST_WORK, MOST_TERMS, MOST_DEGREE, MOST_BITS = 6_000_000, 200_000, 1_000, 20_000
FIELD = 16


class Work:
    """The remaining work for one certificate, in products of two terms."""

    def __init__(self, left: int = MOST_WORK):
        self.left = left

    def spend(self, products: int) -> None:
        """Subtracts work; raises Rejected if none is left."""
        self.left -= products
        if self.left < 0:
            raise Rejected("the certificate asks for more work than a checker should do")


class Ring:
    """The ring of polynomials in some variables, with a list of the factors of all denominators."""

    def __init__(self, variables: Sequence[str], work: Work):
        self.variables, self.work = tuple(variables), work
        self.factors: list[Polynomial] = []
        self._numbers: dict[frozenset[tuple[int, int]], int] = {}
        self.used: set[int] = set()  # the numbers of the factors divided by since the set was cleared

    def constant(self, n: int) -> Polynomial:
        """The polynomial n."""
        return Polynomial(self, {0: n} if n else {}, 0, n.bit_length())

    def variable(self, i: int) -> Polynomial:
        """The i-th variable."""
        return Polynomial(self, {1 << FIELD * i: 1}, 1, 1)

    def factor(self, polynomial: Polynomial) -> int:
        """The number of a factor of denominators; a new factor is added to the list."""
        key = frozenset(polynomial.terms.items())
        if key not in self._numbers:
            self._numbers[key] = len(self.factors)
            self.factors.append(polynomial)
        self.used.add(self._numbers[key])
        return self._numbers[key]

    def names(self) -> dict[str, Quotient]:
        """The variables as quotients, by name."""
        return {name: Quotient(self.variable(i), 1, {}) for i, name in enumerate(self.variables)}

    def number(self, x: Fraction) -> Quotient:
        """A rational number as a quotient."""
        return Quotient(self.constant(x.numerator), x.denominator, {})


class Polynomial(Arithmetic):
    """A sum of terms: {monomial: coefficient}, none of them 0; `degree` and `bits` are bounds for them."""

    __slots__ = ("bits", "degree", "ring", "terms")

    def __init__(self, ring: Ring, terms: dict[int, int], degree: int, bits: int):
        if bits > MOST_BITS:
            bits = max((c.bit_length() for c in terms.values()), default=0)
        if len(terms) > MOST_TERMS or degree > MOST_DEGREE or bits > MOST_BITS:
            raise Rejected("the certificate has a polynomial too large to be checked")
        self.ring, self.terms, self.degree, self.bits = ring, terms, degree, bits

    def __add__(self, other: Polynomial) -> Polynomial:
        small, large = sorted((self, other), key=lambda p: len(p.terms))
        self.ring.work.spend(len(small.terms) + len(large.terms) * self._length() // 4)  # a copied term is cheaper
        terms = dict(large.terms)
        for monomial, c in small.terms.items():
            total = terms.get(monomial, 0) + c
            if total:
                terms[monomial] = total
            else:
                del terms[monomial]
        return Polynomial(self.ring, terms, max(self.degree, other.degree), max(self.bits, other.bits) + 1)

    def _length(self) -> int:
        """The relative cost of an operation with its coefficients."""
        return 1 + self.bits // 512

    def __mul__(self, other: Polynomial) -> Polynomial:
        less = len(self.terms) <= len(other.terms)
        small, large = (self.terms, other.terms) if less else (other.terms, self.terms)
        # Products of long numbers, and of monomials in many variables, cost more.
        price = 1 + (self.bits + other.bits) // 512 + len(self.ring.variables) // 64
        self.ring.work.spend(1 + len(small) * len(large) * price)
        terms: dict[int, int] = {}
        for shift, c in small.items():
            if not terms:
                terms = {monomial + shift: c * d for monomial, d in large.items()}
                so_far = terms.get
                continue
            for monomial, d in large.items():
                at = monomial + shift
                terms[at] = so_far(at, 0) + c * d
            if len(terms) > MOST_TERMS:
                raise Rejected("the certificate has a polynomial too large to be checked")
        if len(small) > 1:
            terms = {monomial: c for monomial, c in terms.items() if c}
        bits = self.bits + other.bits + len(small).bit_length()
        return Polynomial(self.ring, terms, self.degree + other.degree, bits)

    def __pow__(self, power: int) -> Polynomial:
        found: Polynomial = super().__pow__(power) if power else self.ring.constant(1)
        return found

    def times(self, n: int) -> Polynomial:
        """The polynomial times n ≠ 0."""
        self.ring.work.spend(len(self.terms) * (self._length() + n.bit_length() // 512))
        terms = self.terms if n == 1 else {monomial: n * c for monomial, c in self.terms.items()}
        return Polynomial(self.ring, terms, self.degree, self.bits + n.bit_length())

    def split(self) -> tuple[int, list[Polynomial]]:
        """A factorisation: an integer, the variables that divide the polynomial, and a primitive rest."""
        self.ring.work.spend(len(self.terms) * (1 + len(self.ring.variables) // 8))
        monomials = list(self.terms)
        least = [min(m >> FIELD * i & 0xFFFF for m in monomials) for i in range(len(self.ring.variables))]
        common = sum(e << FIELD * i for i, e in enumerate(least))
        content = gcd(*self.terms.values())
        if self.terms[max(monomials)] < 0:
            content = -content
        rest = {m - common: c // content for m, c in self.terms.items()}
        parts = [self.ring.variable(i) for i, e in enumerate(least) for _ in range(e)]
        return content, parts if rest == {0: 1} else [*parts, Polynomial(self.ring, rest, self.degree, self.bits)]


class Quotient(Arithmetic):
    """numerator / (scale · product of factor^power): scale is a positive integer, factors are numbers of the ring."""

    __slots__ = ("factors", "numerator", "scale")

    def __init__(self, numerator: Polynomial, scale: int, factors: dict[int, int]):
        if scale.bit_length() > MOST_BITS or sum(factors.values()) > MOST_DEGREE:
            raise Rejected("the certificate has a number too large to be checked")
        self.numerator, self.scale, self.factors = numerator, scale, factors

    def _over(self, scale: int, factors: dict[int, int]) -> Polynomial:
        """The numerator over a denominator that is a multiple of its own."""
        known, result = self.numerator.ring.factors, self.numerator.times(scale // self.scale)
        for i, power in factors.items():
            for _ in range(power - self.factors.get(i, 0)):
                result = result * known[i]
        return result

    def __add__(self, other: Quotient) -> Quotient:
        if not isinstance(other, Quotient):  # a matrix of quotients
            return NotImplemented
        if (self.scale, self.factors) == (other.scale, other.factors):
            return Quotient(self.numerator + other.numerator, self.scale, self.factors)
        scale, factors = lcm(self.scale, other.scale), _powers(max, self.factors, other.factors)
        return Quotient(self._over(scale, factors) + other._over(scale, factors), scale, factors)

    def __neg__(self) -> Quotient:
        return Quotient(self.numerator.times(-1), self.scale, self.factors)

    def __mul__(self, other: Quotient) -> Quotient:
        if not isinstance(other, Quotient):
            return NotImplemented
        factors = _powers(int.__add__, self.factors, other.factors)
        return Quotient(self.numerator * other.numerator, self.scale * other.scale, factors)

    def __pow__(self, power: int) -> Quotient:
        if power < 0:
            return self.inverse() ** -power
        return Quotient(self.numerator**power, self.scale**power, {i: e * power for i, e in self.factors.items()})

    def inverse(self) -> Quotient:
        """The reciprocal."""
        if not self.numerator.terms:
            raise Rejected("a statement divides by 0")
        ring, above = self.numerator.ring, self.numerator.ring.constant(self.scale)
        for i, power in self.factors.items():
            above = above * ring.factors[i] ** power
        content, parts = self.numerator.split()
        factors: dict[int, int] = {}
        for part in parts:
            number = ring.factor(part)
            factors[number] = factors.get(number, 0) + 1
        return Quotient(above.times(1 if content > 0 else -1), abs(content), factors)


def _powers(join: Callable[[int, int], int], a: dict[int, int], b: dict[int, int]) -> dict[int, int]:
    """The powers of the factors of two denominators, combined by `join`."""
    if not all((a, b)):
        return a or b
    return {i: join(a.get(i, 0), b.get(i, 0)) for i in (*a, *(i for i in b if i not in a))}
