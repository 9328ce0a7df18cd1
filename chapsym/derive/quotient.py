"""Exact zero tests for n = 3: rational functions over Q modulo polynomial constraints.

A statement about Euler parameters and a unit vertical is one about a quotient ring: it holds when
its numerator lies in the ideal of |q|² + q₀² = 1, |γ|² = 1 and what else is assumed.  Membership
is decided by division by a Gröbner basis, in exact arithmetic (python-flint behind SymPy's QQ).
"""

from collections.abc import Sequence
from functools import cached_property
from math import prod
from typing import Any

import sympy as sp
from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx
from sympy.polys.rings import PolyElement, PolyRing

Monomial = tuple[int, ...]
Terms = dict[Monomial, Any]
#: The bits for an exponent, where a monomial is one integer.
WIDE = 16


class Quotient:
    """Q[symbols] modulo the ideal of `relations` (polynomials that vanish by hypothesis).

    Raises ValueError for a symbol whose name is not in ASCII: certificates have no other.
    """

    def __init__(self, symbols: Sequence[sp.Symbol], relations: Sequence[sp.Expr] = ()) -> None:
        self.symbols = tuple(symbols)
        if strange := [x for x in self.symbols if not str(x).isascii()]:
            raise ValueError(f"the symbol {strange[0]} must have a name in ASCII, such as beta")
        self.relations = tuple(relations)

    @cached_property
    def _ring(self) -> PolyRing:
        return PolyRing(self.symbols, sp.QQ, sp.grevlex)

    @cached_property
    def _basis(self) -> list[PolyElement]:
        if not self.relations:
            return []
        basis = sp.groebner(self.relations, *self.symbols, order="grevlex", domain="QQ")
        return [self._ring.from_expr(g) for g in basis.exprs]

    def normal(self, expr: sp.Expr | int) -> sp.Expr:
        """The normal form of a polynomial modulo the relations."""
        return self._shown(self._ring.from_expr(sp.sympify(expr, strict=True)))

    def reduced(self, expr: sp.Expr) -> sp.Expr:
        """A rational function as a quotient of normal forms, the one below with integers that have no common factor."""
        above, below = map(self._shown, self._fraction(sp.sympify(expr, strict=True))[0])
        content, below = below.as_content_primitive()
        return sp.expand(above / content) / below

    def is_zero(self, expr: sp.Expr | int) -> bool:
        """True exactly when the rational function vanishes wherever the relations hold and it is defined.

        Exact in one direction for any ideal (a zero remainder proves the identity); a non-zero
        remainder says that the numerator is not in the ideal.
        Raises ZeroDivisionError if the denominator vanishes under the relations.
        """
        (numerator, _), divisors = self._fraction(sp.sympify(expr, strict=True))  # a text is not evaluated
        for written, divisor in divisors:
            if not self._rest(divisor.to_dict()):
                raise ZeroDivisionError(f"the denominator {written} is zero under the hypotheses")
        return not self._rest(numerator.to_dict())

    @cached_property
    def _known(self) -> dict[sp.Expr, tuple[fmpq_mpoly, fmpq_mpoly]]:
        """1 and the symbols as fractions."""
        context = fmpq_mpoly_ctx.get(tuple(f"x{i}" for i in range(len(self.symbols))), Ordering.degrevlex)
        one = context.constant(1)
        known = {x: (gen, one) for x, gen in zip(self.symbols, context.gens(), strict=True)}
        return {sp.S.One: (one, one), **known}

    def _fraction(self, expr: sp.Expr) -> tuple[tuple[fmpq_mpoly, fmpq_mpoly], list[tuple[sp.Expr, fmpq_mpoly]]]:
        """Numerator and denominator of a rational function; what it divides by, with the numerators of that."""
        known, divisors = dict(self._known), []
        one = known[sp.S.One][0]

        def of(expr: sp.Expr) -> tuple[fmpq_mpoly, fmpq_mpoly]:
            if expr not in known:
                known[expr] = made(expr)
            return known[expr]

        def made(expr: sp.Expr) -> tuple[fmpq_mpoly, fmpq_mpoly]:
            if isinstance(expr, sp.Rational):
                return one * expr.p, one * expr.q
            if isinstance(expr, sp.Pow) and isinstance(expr.exp, sp.Integer):
                (above, below), power = of(expr.base), int(expr.exp)
                if power > 0:
                    return above**power, below**power
                divisors.append((expr.base, above))
                return below**-power, above**-power
            parts = [of(part) for part in expr.args]
            if isinstance(expr, sp.Mul):
                above, below = prod((a for a, _ in parts), start=one), prod((b for _, b in parts), start=one)
                common = above.gcd(below)
                return above / common, below / common
            if not isinstance(expr, sp.Add):
                raise ValueError(f"{expr} is not a rational function of {self.symbols}")
            above, below = parts[0]
            for a, b in parts[1:]:
                common = below.gcd(b)
                mine, its = below / common, b / common
                above, below = above * its + a * mine, below * its
            return above, below

        return of(expr), divisors

    @cached_property
    def _division(self) -> "Division":
        return Division([g.to_dict() for g in self._basis], [g.leading_expv() for g in self._basis], len(self.symbols))

    def _shown(self, polynomial: PolyElement | fmpq_mpoly) -> sp.Expr:
        """The normal form of a polynomial."""
        rest = self._rest(polynomial.to_dict())
        return self._ring.from_dict({m: sp.QQ(int(c.p), int(c.q)) for m, c in rest.items()}).as_expr()

    def _rest(self, polynomial: Terms) -> Terms:
        """The same of its terms; that by a Gröbner basis does not depend on their order."""
        return self._division.divided(polynomial)[0]


class Division:
    """Division by polynomials {exponents: coefficient}, of each term by the first whose leading term divides it."""

    def __init__(self, by: Sequence[Terms], leads: Sequence[Monomial], size: int) -> None:
        self._size = size
        self._borrows = sum(1 << WIDE * i + WIDE - 1 for i in range(size))  # no exponent has this bit
        self._rules = []
        for terms, lead in zip(by, leads, strict=True):
            inverse, at = 1 / _rational(terms[lead]), _packed(lead)
            rest = [(_packed(m) - at, -_rational(c) * inverse) for m, c in terms.items() if m != lead]
            self._rules.append((at, inverse, rest))

    def divided(self, polynomial: Terms) -> tuple[Terms, list[Terms]]:
        """The remainder, and the quotient for each polynomial."""
        quotients: list[dict[int, fmpq]] = [{} for _ in self._rules]
        pending, settled = {_packed(m): _rational(c) for m, c in polynomial.items()}, dict[int, fmpq]()
        while pending:
            replaced: dict[int, fmpq] = {}
            for monomial, factor in pending.items():
                for (lead, inverse, terms), quotient in zip(self._rules, quotients, strict=True):
                    if ((monomial | self._borrows) - lead) & self._borrows == self._borrows:
                        quotient[monomial - lead] = quotient.get(monomial - lead, 0) + factor * inverse
                        for offset, times in terms:
                            replaced[monomial + offset] = replaced.get(monomial + offset, 0) + factor * times
                        break
                else:
                    settled[monomial] = settled.get(monomial, 0) + factor
            pending = {monomial: factor for monomial, factor in replaced.items() if factor != 0}
        return self._terms(settled), list(map(self._terms, quotients))

    def _terms(self, packed: dict[int, fmpq]) -> Terms:
        one = (1 << WIDE) - 1
        return {tuple(m >> WIDE * i & one for i in range(self._size)): c for m, c in packed.items() if c != 0}


def _packed(monomial: Monomial) -> int:
    return sum(int(e) << WIDE * i for i, e in enumerate(monomial))


def _rational(c: Any) -> fmpq:
    """A rational number of SymPy's domain, or one of python-flint."""
    return c if isinstance(c, fmpq) else fmpq(int(c.numerator), int(c.denominator))
