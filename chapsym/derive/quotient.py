"""Exact zero tests for n = 3: rational functions over Q modulo polynomial constraints.

A statement about Euler parameters and a unit vertical is one about a quotient ring: it holds when
its numerator lies in the ideal of |q|² + q₀² = 1, |γ|² = 1 and what else is assumed.  Membership
is decided by division by a Gröbner basis, in exact arithmetic (python-flint behind SymPy's QQ).
"""

from collections.abc import Sequence
from functools import cached_property
from math import prod
from operator import add, ge, sub
from typing import Any

import sympy as sp
from flint import Ordering, fmpq_mpoly, fmpq_mpoly_ctx
from sympy.polys.rings import PolyElement, PolyRing

Monomial = tuple[int, ...]


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
        return self._reduce(sp.sympify(expr, strict=True)).as_expr()

    def is_zero(self, expr: sp.Expr | int) -> bool:
        """True exactly when the rational function vanishes wherever the relations hold and it is defined.

        Exact in one direction for any ideal (a zero remainder proves the identity); a non-zero
        remainder says that the numerator is not in the ideal.
        Raises ZeroDivisionError if the denominator vanishes under the relations.
        """
        numerator, divisors = self._numerator(sp.sympify(expr, strict=True))  # a text is not evaluated
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

    def _numerator(self, expr: sp.Expr) -> tuple[fmpq_mpoly, list[tuple[sp.Expr, fmpq_mpoly]]]:
        """The numerator of a rational function, and each expression that it divides by, with its numerator."""
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

        return of(expr)[0], divisors

    @cached_property
    def _rules(self) -> list[tuple[Monomial, list[tuple[Monomial, Any]]]]:
        """The leading monomial of each polynomial of the basis, and the terms that take its place."""
        leads = [g.leading_expv() for g in self._basis]
        return [
            (lead, [(monomial, -factor / g.LC) for monomial, factor in g.terms() if monomial != lead])
            for lead, g in zip(leads, self._basis, strict=True)
        ]

    def _reduce(self, expr: sp.Expr) -> PolyElement:
        """The normal form of a polynomial."""
        return self._ring.from_dict(self._rest(dict(self._ring.from_expr(expr))))

    def _rest(self, pending: dict[Monomial, Any]) -> dict[Monomial, Any]:
        """The same of its terms, which are replaced in any order: that by a Gröbner basis does not depend on it."""
        zero = self._ring.domain.zero
        settled: dict[Monomial, Any] = {}
        while pending:
            replaced: dict[Monomial, Any] = {}
            for monomial, factor in pending.items():
                found = next((rule for rule in self._rules if all(map(ge, monomial, rule[0]))), None)
                if found is None:
                    settled[monomial] = settled.get(monomial, zero) + factor
                    continue
                lead, terms = found
                rest = tuple(map(sub, monomial, lead))
                for other, times in terms:
                    to = tuple(map(add, rest, other))
                    replaced[to] = replaced.get(to, zero) + factor * times
            pending = {monomial: factor for monomial, factor in replaced.items() if factor}
        return {monomial: factor for monomial, factor in settled.items() if factor}
