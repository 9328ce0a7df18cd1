"""The representation of a polynomial of an ideal by its relations: p = Σ cofactor · relation.

Division by the relations gives the cofactors.  If there is a remainder, the relations are completed towards a Gröbner
basis, each new element with its own cofactors (Buchberger's algorithm), until there is none.  No proof depends on this
search: the checker multiplies out its result.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from operator import sub

import sympy as sp
from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from chapsym.checker.matrices import Quotients
from chapsym.checker.polynomial import FIELD, Quotient

from .trees import Monomial, Terms, Tree, factored


@dataclass(frozen=True)
class Element:
    """A polynomial of the ideal with its cofactors, one for each relation."""

    polynomial: fmpq_mpoly
    cofactors: tuple[fmpq_mpoly, ...]

    @property
    def lead(self) -> Monomial:
        """The exponents of the leading term."""
        return tuple(int(e) for e in self.polynomial.monoms()[0])

    def less(self, factor: fmpq_mpoly, other: "Element") -> "Element":
        """The element self - factor · other."""
        cofactors = tuple(a - factor * b for a, b in zip(self.cofactors, other.cofactors, strict=True))
        return Element(self.polynomial - factor * other.polynomial, cofactors)


class Ideal:
    """The ideal of some relations, {exponents: coefficient}, in a polynomial ring over Q."""

    def __init__(self, names: Sequence[str], relations: Sequence[Terms]) -> None:
        self._context = fmpq_mpoly_ctx.get(tuple(names), Ordering.degrevlex)
        zero, one = self._context.constant(0), self._context.constant(1)
        self._none = Element(zero, (zero,) * len(relations))
        self._basis: list[Element] = []
        self._pairs: list[tuple[Element, Element]] = []
        for i, relation in enumerate(relations):
            if relation:
                ones = tuple(one if i == j else zero for j in range(len(relations)))
                self._extend(Element(self._context.from_dict(dict(relation)), ones))

    def cofactors(self, polynomial: Terms) -> tuple[fmpq_mpoly, ...] | None:
        """The cofactors of a polynomial; None if it is not in the ideal."""
        whole = self._context.from_dict(dict(polynomial))
        while True:
            remainder, quotients = self._divided(whole)
            if remainder == 0:
                total = self._none
                for quotient, element in zip(quotients, self._basis, strict=True):
                    total = total.less(-quotient, element)
                return total.cofactors
            if not self._completed_by_one():
                return None

    def _extend(self, new: Element) -> None:
        """Adds an element and its pairs, except if the leading monomials have no common variable (S-polynomial 0)."""
        self._pairs += [(old, new) for old in self._basis if any(map(min, old.lead, new.lead))]
        self._basis.append(new)

    def _completed_by_one(self) -> bool:
        """Adds the next element of the Gröbner basis; returns whether there was one."""
        while self._pairs:
            found = self._s_polynomial(*self._pairs.pop(0))
            remainder, quotients = self._divided(found.polynomial)
            if remainder != 0:
                for quotient, element in zip(quotients, self._basis, strict=True):
                    found = found.less(quotient, element)
                self._extend(found)
                return True
        return False

    def _s_polynomial(self, a: Element, b: Element) -> Element:
        common = tuple(map(max, a.lead, b.lead))
        left, right = (
            self._context.from_dict({tuple(map(sub, common, one.lead)): sign / one.polynomial.leading_coefficient()})
            for one, sign in ((a, -1), (b, 1))
        )
        return self._none.less(left, a).less(right, b)

    def _divided(self, polynomial: fmpq_mpoly) -> tuple[fmpq_mpoly, list[fmpq_mpoly]]:
        """The remainder, and the quotient for each element: the first element that divides a term is used."""
        remainder, quotients = self._none.polynomial, [self._none.polynomial] * len(self._basis)
        leading = [self._context.from_dict({x.lead: x.polynomial.leading_coefficient()}) for x in self._basis]
        while polynomial != 0:
            made = self._none.polynomial
            for i, term in enumerate(leading):
                quotient, polynomial = divmod(polynomial, term)  # the rest has a term that this one does not divide
                quotients[i] += quotient
                made -= quotient * (self._basis[i].polynomial - term)
            remainder, polynomial = remainder + polynomial, made
        return remainder, quotients


def ideal(of: Quotients) -> Ideal:
    """The ideal of the relations of a ring of the checker."""
    relations = [{m: fmpq(c, r.scale) for m, c in terms(r).items()} for r in of.relations]
    return Ideal(of.ring.variables, relations)


def terms(of: Quotient) -> dict[Monomial, int]:
    """The terms of the numerator that the checker computes."""
    size = len(of.numerator.ring.variables)
    return {tuple(m >> FIELD * i & 0xFFFF for i in range(size)): c for m, c in of.numerator.terms.items()}


def expression(of: Quotient) -> sp.Expr:
    """The numerator as an expression."""
    symbols = [sp.Symbol(name) for name in of.numerator.ring.variables]
    return sp.Add(*(c * sp.Mul(*map(sp.Pow, symbols, m)) for m, c in terms(of).items()))


def trees(ideal: Ideal, difference: Quotient) -> list[Tree] | None:
    """The cofactors of a numerator as trees for the checker; None if it is not in the ideal."""
    cofactors = ideal.cofactors(terms(difference))
    names = difference.numerator.ring.variables
    return None if cofactors is None else [factored(cofactor.to_dict(), names) for cofactor in cofactors]
