"""Exact zero tests for n = 3: rational functions over Q modulo polynomial constraints.

An identity between functions of Euler parameters and a unit vertical holds if its numerator is in the ideal of
|q|² + q₀² = 1, |γ|² = 1 and the other assumptions.  Membership is decided by division by a Gröbner basis, in exact
arithmetic (python-flint).
"""

from collections.abc import Iterable, Sequence
from contextlib import suppress
from functools import cache, cached_property
from math import prod
from numbers import Number

import sympy as sp
from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx, fmpz
from sympy.polys.rings import PolyRing


def in_sympy(value: object) -> sp.Basic | sp.MatrixBase:
    """A value of SymPy as it is, a number as one of SymPy's; raises TypeError for anything else.

    `sympify`, even if it is strict, evaluates as code the texts in a tuple, a set or a mapping; so nothing that holds
    others gets there.
    """
    kind = type(value)
    if issubclass(kind, sp.Basic | sp.MatrixBase):
        return value
    if issubclass(kind, Number | fmpq | fmpz) and not issubclass(kind, Iterable):
        with suppress(sp.SympifyError):
            return sp.sympify(value, strict=True)
    raise TypeError(f"{kind.__name__} is neither an expression of SymPy nor a number")


class Quotient:
    """Q[symbols] modulo the ideal of `relations` (polynomials that vanish by hypothesis).

    Raises ValueError for a symbol whose name is not ASCII: certificates have only ASCII names.
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
    def _context(self) -> fmpq_mpoly_ctx:
        return fmpq_mpoly_ctx.get(tuple(f"x{i}" for i in range(len(self.symbols))), Ordering.degrevlex)

    @cached_property
    def _basis(self) -> list[fmpq_mpoly]:
        return list(map(self._read, _groebner(self.relations, self.symbols))) if self.relations else []

    def _read(self, expr: sp.Expr) -> fmpq_mpoly:
        """A SymPy polynomial as one of python-flint."""
        terms = self._ring.from_expr(expr).to_dict()
        return self._context.from_dict({m: fmpq(int(c.numerator), int(c.denominator)) for m, c in terms.items()})

    def normal(self, expr: sp.Expr | int) -> sp.Expr:
        """The normal form of a polynomial modulo the relations."""
        return self._shown(self._read(in_sympy(expr)))

    def reduced(self, expr: sp.Expr) -> sp.Expr:
        """A rational function as a quotient of normal forms; the denominator has coprime integer coefficients."""
        above, below = map(self._shown, self._fraction(in_sympy(expr))[0])
        content, below = below.as_content_primitive()
        return sp.expand(above / content) / below

    def is_zero(self, expr: sp.Expr | int) -> bool:
        """Whether the numerator of a rational function is in the ideal of the relations.

        If so, the function vanishes wherever the relations hold and it is defined.  If not, the numerator is not in the
        ideal; it may still vanish there if the ideal is not radical.
        Raises ZeroDivisionError if a denominator vanishes under the relations.
        """
        (numerator, _), divisors = self._fraction(in_sympy(expr))
        for written, divisor in divisors:
            if self._rest(divisor) == 0:
                raise ZeroDivisionError(f"the denominator {written} is zero under the hypotheses")
        return bool(self._rest(numerator) == 0)

    @cached_property
    def _known(self) -> dict[sp.Expr, tuple[fmpq_mpoly, fmpq_mpoly]]:
        """The fractions of 1 and the symbols."""
        one = self._context.constant(1)
        known = {x: (gen, one) for x, gen in zip(self.symbols, self._context.gens(), strict=True)}
        return {sp.S.One: (one, one), **known}

    def _fraction(self, expr: sp.Expr) -> tuple[tuple[fmpq_mpoly, fmpq_mpoly], list[tuple[sp.Expr, fmpq_mpoly]]]:
        """The numerator and denominator of a rational function; its divisors, each with its numerator."""
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

    def _shown(self, polynomial: fmpq_mpoly) -> sp.Expr:
        """The normal form of a polynomial, in SymPy."""
        rest = self._rest(polynomial).to_dict()
        terms = {tuple(map(int, m)): sp.QQ(int(c.p), int(c.q)) for m, c in rest.items()}  # SymPy may not know flint's
        return self._ring.from_dict(terms).as_expr()

    def _rest(self, polynomial: fmpq_mpoly) -> fmpq_mpoly:
        """The remainder of the division by the Gröbner basis, which does not depend on the order of its elements."""
        before = None
        while before != polynomial:
            before = polynomial
            for element in self._basis:
                polynomial = divmod(polynomial, element)[1]
        return polynomial


@cache
def _groebner(relations: tuple[sp.Expr, ...], symbols: tuple[sp.Symbol, ...]) -> list[sp.Expr]:
    """The Gröbner basis of relations, which the rings of several proofs have."""
    return sp.groebner(relations, *symbols, order="grevlex", domain="QQ").exprs
