"""How a polynomial of an ideal is made from the relations: p = Σ cofactor · relation.

Division by the relations gives the cofactors.  Where it leaves a remainder, the relations are completed towards a
Gröbner basis, each new element with its own cofactors (Buchberger's algorithm), until it leaves none.
Nothing rests on it: the checker multiplies out what is found here.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from operator import add, ge, sub
from typing import Any

import sympy as sp
from sympy.polys.rings import PolyElement, PolyRing

from chapsym.checker.matrices import Quotients
from chapsym.checker.polynomial import FIELD, Quotient

from .trees import factored

Monomial = tuple[int, ...]
Terms = dict[Monomial, Any]


@dataclass(frozen=True)
class Element:
    """A polynomial of the ideal with its cofactors, one for each relation."""

    polynomial: PolyElement
    cofactors: tuple[PolyElement, ...]

    def less(self, factor: PolyElement, other: "Element") -> "Element":
        """self - factor · other."""
        cofactors = tuple(a - factor * b for a, b in zip(self.cofactors, other.cofactors, strict=True))
        return Element(self.polynomial - factor * other.polynomial, cofactors)


class Ideal:
    """The ideal of some relations in a polynomial ring over Q."""

    def __init__(self, ring: PolyRing, relations: Sequence[PolyElement]) -> None:
        self.ring = ring
        self._none = Element(ring.zero, (ring.zero,) * len(relations))
        self._basis: list[Element] = []
        self._pairs: list[tuple[Element, Element]] = []
        for i, relation in enumerate(relations):
            if relation:
                ones = (ring.one if i == j else ring.zero for j in range(len(relations)))
                self._extend(Element(relation, tuple(ones)))

    def cofactors(self, polynomial: Terms) -> tuple[PolyElement, ...] | None:
        """Those of a polynomial, given as {exponents: coefficient}; None if it is not in the ideal."""
        while True:
            remainder, quotients = self._divided(polynomial)
            if not remainder:
                total = self._none
                for quotient, element in zip(quotients, self._basis, strict=True):
                    total = total.less(-quotient, element)
                return total.cofactors
            if not self._completed_by_one():
                return None

    def _extend(self, new: Element) -> None:
        """With the pairs that matter: where leading monomials share no variable, the S-polynomial reduces to 0."""
        lead = new.polynomial.leading_expv()
        self._pairs += [(old, new) for old in self._basis if any(map(min, old.polynomial.leading_expv(), lead))]
        self._basis.append(new)

    def _completed_by_one(self) -> bool:
        """Adds the next element of the Gröbner basis; whether there was one."""
        while self._pairs:
            found = self._s_polynomial(*self._pairs.pop(0))
            remainder, quotients = self._divided(dict(found.polynomial))
            if remainder:
                for quotient, element in zip(quotients, self._basis, strict=True):
                    found = found.less(quotient, element)
                self._extend(found)
                return True
        return False

    def _s_polynomial(self, a: Element, b: Element) -> Element:
        one, two = a.polynomial.leading_expv(), b.polynomial.leading_expv()
        common = tuple(map(max, one, two))
        left = self.ring.from_dict({tuple(map(sub, common, one)): -1 / a.polynomial.LC})
        right = self.ring.from_dict({tuple(map(sub, common, two)): 1 / b.polynomial.LC})
        return self._none.less(left, a).less(right, b)

    def _divided(self, polynomial: Terms) -> tuple[Terms, list[PolyElement]]:
        """The remainder, and the quotient for each element of the basis."""
        rules = [(e.polynomial.leading_expv(), e.polynomial.LC, e.polynomial.terms()) for e in self._basis]
        quotients: list[Terms] = [{} for _ in rules]
        pending, settled = dict(polynomial), dict[Monomial, Any]()
        while pending:
            replaced: Terms = {}
            for monomial, factor in pending.items():
                found = next((i for i, rule in enumerate(rules) if all(map(ge, monomial, rule[0]))), None)
                if found is None:
                    settled[monomial] = settled.get(monomial, 0) + factor
                    continue
                lead, coefficient, terms = rules[found]
                rest, factor = tuple(map(sub, monomial, lead)), factor / coefficient
                quotients[found][rest] = quotients[found].get(rest, 0) + factor
                for other, times in terms:
                    if other != lead:
                        to = tuple(map(add, rest, other))
                        replaced[to] = replaced.get(to, 0) - factor * times
            pending = {monomial: factor for monomial, factor in replaced.items() if factor}
        remainder = {monomial: factor for monomial, factor in settled.items() if factor}
        return remainder, [self.ring.from_dict({m: c for m, c in q.items() if c}) for q in quotients]


def ideal(of: Quotients) -> Ideal:
    """The ideal of the relations of a ring of the checker."""
    ring = PolyRing([sp.Symbol(name) for name in of.ring.variables], sp.QQ, sp.grevlex)
    relations = [{m: c / r.scale for m, c in terms(r).items()} for r in of.relations]
    return Ideal(ring, [ring.from_dict(r) for r in relations])


def terms(of: Quotient) -> Terms:
    """The numerator that the checker forms."""
    shifts = [FIELD * i for i in range(len(of.numerator.ring.variables))]
    return {tuple(m >> s & 0xFFFF for s in shifts): sp.QQ(c) for m, c in of.numerator.terms.items()}


def expression(of: Quotient) -> sp.Expr:
    """The numerator as an expression."""
    symbols = [sp.Symbol(name) for name in of.numerator.ring.variables]
    return sp.Add(
        *(
            sp.Rational(int(c.numerator), int(c.denominator)) * sp.Mul(*map(sp.Pow, symbols, m))
            for m, c in terms(of).items()
        )
    )


def trees(ideal: Ideal, difference: Quotient) -> list[Any] | None:
    """The cofactors of a numerator as the checker reads them; None if it is not in the ideal."""
    cofactors = ideal.cofactors(terms(difference))
    names = difference.numerator.ring.variables
    return None if cofactors is None else [factored(cofactor, names) for cofactor in cofactors]
