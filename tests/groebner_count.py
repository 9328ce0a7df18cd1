"""How many solutions (5.2) has, by a Gröbner basis over Q and in two ways: beside what others count."""

import itertools
from collections.abc import Sequence
from typing import NamedTuple

import sympy as sp
from sympy.polys.matrices import DomainMatrix
from sympy.polys.rings import PolyElement, PolyRing

from chapsym.derive.solutions import quadrics
from chapsym.derive.three import J1, J2, J3, K1, K2, K3, D, g1, g2, g3, q, q0

#: The chart ⟨CHART, (q₀, q)⟩ = 1 and the linear form that tells the points apart: in general position.
CHART = (7, 2, -3, 5)
APART = (3, -5, 1, 11)

#: q₀ in the chart.
FIRST = (1 - sum(c * x for c, x in zip(CHART[1:], q, strict=True))) / sp.Integer(CHART[0])


class NotFinite(ValueError):
    """The quadrics have a curve in common: there are infinitely many solutions."""


class Count(NamedTuple):
    """The solutions of three quadrics: real and complex ones without multiplicity, and their eliminant."""

    real: int
    distinct: int
    degree: int
    eliminant: sp.Poly


def at(
    mass_tensor: Sequence[int | str], contact: int | str, gamma: Sequence[int | str], momentum: Sequence[int | str]
) -> list[sp.Expr]:
    """The three quadrics of a ball at a rational state (J, D, γ, 𝒦)."""
    symbols = (J1, J2, J3, D, g1, g2, g3, K1, K2, K3)
    values = map(sp.Rational, (*mass_tensor, contact, *gamma, *momentum))
    exact = dict(zip(symbols, values, strict=True))
    return [sp.expand(e.subs(exact, simultaneous=True)) for e in quadrics()]


def count(equations: Sequence[sp.Expr]) -> Count:
    """The common points of three quadrics with rational coefficients, counted exactly, in two ways.

    The eliminant is the characteristic polynomial of a linear form, in general position, on the algebra
    of the common points.  Where its square-free part has as many roots as there are points, a real root
    belongs to one point, which is its own conjugate: the real roots are the real points (Sturm).
    The signature of the trace form of that algebra counts the real points again (Hermite).
    Raises NotFinite if the points are infinitely many, ArithmeticError if a point is outside the chart, if
    two points have the same value, or if the two counts differ.
    """
    algebra = _Algebra(equations)
    eliminant = algebra.eliminant()
    free = eliminant.sqf_part()
    distinct, signature = algebra.inertia()
    if eliminant.degree() != 8:
        raise ArithmeticError("a common point lies outside the chart")
    if free.degree() != distinct:
        raise ArithmeticError("two points have the same value: the form is not in general position")
    real = free.count_roots()
    if real != signature:
        raise ArithmeticError("the real roots of the eliminant and the signature of the trace form differ")
    return Count(real, distinct, eliminant.degree(), eliminant)


class _Algebra:
    """Q[q] modulo three quadrics in the chart: multiplication matrices in the basis of standard monomials."""

    def __init__(self, equations: Sequence[sp.Expr]) -> None:
        basis = _groebner(equations)
        if not basis.is_zero_dimensional:
            raise NotFinite("the three quadrics have infinitely many points in common")
        self.ring = PolyRing(tuple(q), sp.QQ, sp.grevlex)
        self.basis = [self.ring.from_expr(g) for g in basis.exprs]
        leading = [g.leading_expv() for g in self.basis]
        exponents = itertools.product(range(9), repeat=3)
        self.standard = [e for e in exponents if not any(self.ring.monomial_div(e, lead) for lead in leading)]
        self.by_variable = [self._matrix(x) for x in self.ring.gens]

    def eliminant(self) -> sp.Poly:
        """The characteristic polynomial of multiplication by the form APART."""
        element = self.ring.from_expr(sp.expand(APART[0] * FIRST + sum(map(sp.Mul, APART[1:], q))))
        return sp.Poly.from_list(self._matrix(element).charpoly(), sp.Symbol("t"))

    def inertia(self) -> tuple[int, int]:
        """Rank and signature of the trace form (x, y) -> tr(multiplication by x y)."""
        size = len(self.standard)
        identity = DomainMatrix.eye(size, sp.QQ)
        powers = [self._product(e, identity) for e in self.standard]
        form = [[(a * b).diagonal() for b in powers] for a in powers]
        traces = DomainMatrix([[sum(d, sp.QQ(0)) for d in row] for row in form], (size, size), sp.QQ)
        polynomial = traces.charpoly()  # all its roots are real, so that Descartes' rule is exact
        positive = _sign_changes(polynomial)
        negative = _sign_changes([c * (-1) ** i for i, c in enumerate(polynomial)])
        return positive + negative, positive - negative

    def _product(self, exponents: tuple[int, ...], identity: DomainMatrix) -> DomainMatrix:
        matrix = identity
        for factor, power in zip(self.by_variable, exponents, strict=True):
            for _ in range(power):
                matrix = matrix * factor
        return matrix

    def _matrix(self, element: PolyElement) -> DomainMatrix:
        columns = [(self.ring({e: sp.QQ(1)}) * element).rem(self.basis) for e in self.standard]
        rows = [[column.get(e, sp.QQ(0)) for column in columns] for e in self.standard]
        return DomainMatrix(rows, (len(rows), len(rows)), sp.QQ)


def _sign_changes(coefficients: Sequence[sp.Rational]) -> int:
    signs = [c > 0 for c in coefficients if c]
    return sum(a != b for a, b in itertools.pairwise(signs))


def multiplicity(found: Count) -> int:
    """The number of real solutions, each with its multiplicity."""
    return sum(factor.count_roots() * power for factor, power in found.eliminant.sqf_list()[1])


def _groebner(equations: Sequence[sp.Expr]) -> sp.GroebnerBasis:
    """The ideal of the forms in the chart."""
    return sp.groebner([sp.expand(e.subs(q0, FIRST)) for e in equations], *q, order="grevlex", domain="QQ")
