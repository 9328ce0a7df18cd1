"""The common points of three quadrics in P³, exactly over Q: how many are real, with what multiplicity, and where.

The forms of degree 4 in the ideal are the row space of a Macaulay matrix, and a common point x is a functional on
S₄ that it kills.  Let N hold all functionals that it kills, and h be a linear form for which N restricted to h·S₃
has full rank.  Then no common point has h = 0, so that they are finitely many (8 with multiplicity, by Bézout), and
x_v/h acts on N as multiplication in the algebra of the points.  The characteristic polynomial of a form that
separates the points, the *eliminant*, has one root for each point, of its multiplicity, and a real root for each
real point; the points are rational functions of the root (Rouillier's rational univariate representation).
That the form separates is decided by the trace form of the algebra, whose rank is the number of points; its
signature is the number of the real ones (Hermite), which must be what the eliminant says.
"""

import itertools
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, reduce
from typing import Any

import flint
from flint import fmpq, fmpq_mat, fmpq_poly, fmpz, fmpz_mat, fmpz_poly

#: A form with rational coefficients, each under the ascending indices of the variables of its monomial.
Form = Mapping[tuple[int, ...], fmpq]

VARIABLES = range(4)
#: The degree at which the Macaulay matrix is complete: 3·(2 - 1) + 1.
DEGREE = 4
#: A point of P³ is on at most 3 of the planes (1, k, k², k³), so that one of 25 planes misses 8 points;
#: two points have equal quotients for at most 3 forms, and 8 points are 28 pairs.
PLANES = range(2, 27)
SEPARATING = range(-3, -88, -1)


class NotFinite(ArithmeticError):
    """The forms have infinitely many complex points in common."""


@dataclass(frozen=True)
class Factor:
    """The real points that share a multiplicity and the coordinates that vanish.

    The points are (c₀(t) : c₁(t) : c₂(t) : c₃(t)) for the real roots t of a polynomial without square factors.
    """

    polynomial: fmpz_poly
    coordinates: tuple[fmpz_poly, ...]
    multiplicity: int

    def points(self, bits: int) -> Iterator[tuple[Any, ...]]:
        """Arb enclosures of homogeneous coordinates, computed with `bits`; coordinates that vanish are exactly 0."""
        with flint.ctx.workprec(bits):
            roots: Any = self.polynomial.complex_roots()
            for root, _ in roots:
                if root.imag.is_zero():
                    yield tuple(c(root.real) for c in self.coordinates)


@dataclass(frozen=True)
class Points:
    """All common points: the number of the real ones, and the factors of the eliminant."""

    real: int
    factors: tuple[Factor, ...]


def common_points(forms: Sequence[Form]) -> Points:
    """The common points of forms of degree 1 and 2 in (q0, q1, q2, q3), three quadrics among them.

    Raises NotFinite if they are infinitely many, and ArithmeticError if the two counts differ.
    """
    algebra = _Algebra(forms)
    distinct, signature = algebra.inertia()
    for k in SEPARATING:
        multiplication = algebra.form(k)
        eliminant = multiplication.charpoly().numer()
        parts = [(p, m) for p, m in eliminant.factor_squarefree()[1] if p.degree() > 0]
        if sum(p.degree() for p, _ in parts) == distinct:
            break
    else:
        raise ArithmeticError("no linear form tells the common points apart")
    coordinates = _representation(algebra, multiplication, parts)
    factors = tuple(Factor(p, c, m) for part, m in parts for p, c in _split(part, coordinates))
    real = sum(sum(1 for _ in factor.points(64)) for factor in factors)
    if real != signature:
        raise ArithmeticError("the real roots of the eliminant and the signature of the trace form differ")
    return Points(real, factors)


class _Algebra:
    """The algebra of the common points: the matrices of q0/h, ..., q3/h."""

    def __init__(self, forms: Sequence[Form]) -> None:
        kernel = _killed(forms)
        size = kernel.ncols()
        if size > 8:
            raise NotFinite
        below, place = _monomials(DEGREE - 1), _places(DEGREE)
        rows = kernel.tolist()
        by_variable = [fmpz_mat([rows[place[tuple(sorted((*m, v)))]] for m in below]) for v in VARIABLES]
        for k in PLANES:
            plane = sum((c * x for c, x in zip(_powers(k), by_variable, strict=True)), fmpz_mat(len(below), size))
            # The first rows that span them all.
            reduced, _, rank = plane.transpose().rref()
            chosen = [next(j for j in range(len(below)) if reduced[i, j] != 0) for i in range(rank)]
            if rank == size:
                break
        else:
            raise NotFinite
        own = [fmpq_mat(fmpz_mat([x.tolist()[i] for i in chosen])) for x in (plane, *by_variable)]
        self.size = size
        self.basis = [below[i] for i in chosen]
        self.variables = [own[0].inv() * x for x in own[1:]]
        # Free of denominators: the same positive multiple of each.
        scale = _common(variable.numer_denom()[1] for variable in self.variables)
        self.integral = [(scale * variable).numer_denom()[0] for variable in self.variables]

    def form(self, k: int) -> fmpq_mat:
        """The matrix of (q0 + k q1 + k² q2 + k³ q3)/h."""
        return sum((c * m for c, m in zip(_powers(k), self.variables, strict=True)), fmpq_mat(self.size, self.size))

    def inertia(self) -> tuple[int, int]:
        """Rank and signature of the trace form (a, b) -> tr(ab): the numbers of points, and of real points."""
        # Times a positive number, which the inertia does not see.
        elements = [reduce(fmpz_mat.__mul__, (self.integral[v] for v in m)) for m in self.basis]
        form = _traces(elements, elements)
        # All roots are real, so that Descartes' rule is exact.
        polynomial = form.charpoly().coeffs()
        positive = _sign_changes(polynomial)
        negative = _sign_changes([-c if i % 2 else c for i, c in enumerate(polynomial)])
        return positive + negative, positive - negative


def _killed(forms: Sequence[Form]) -> fmpz_mat:
    """A basis, in columns, of the functionals on S₄ that vanish on the multiples of the forms."""
    place = _places(DEGREE)
    rows = []
    for form in forms:
        denominator = _common(c.q for c in form.values())
        for m in _monomials(DEGREE - len(next(iter(form)))):
            row = [fmpz(0)] * len(place)
            for e, c in form.items():
                row[place[tuple(sorted(e + m))]] = (c * denominator).p
            rows.append(row)
    columns, nullity = fmpz_mat(rows).nullspace()
    return fmpz_mat(len(place), nullity, [columns[i, j] for i in range(len(place)) for j in range(nullity)])


def _representation(algebra: _Algebra, multiplication: fmpq_mat, parts: list) -> list[fmpz_poly]:
    """Polynomials c₀, ..., c₃ with the point of the root t at (c₀(t) : ... : c₃(t)).

    c_v = Σ tr(x_v ℓⁱ) Hᵢ for the powers of the multiplication ℓ and Horner's quotients Hᵢ of the square-free part.
    """
    free = fmpz_poly([1])
    for part, _ in parts:
        free *= part
    numerator, denominator = multiplication.numer_denom()
    traces = _traces(algebra.integral, [numerator**i for i in range(free.degree())])
    ascending = free.coeffs()
    found = []
    for v in VARIABLES:
        terms = (fmpq(traces[v, i], denominator**i) * fmpq_poly(ascending[i + 1 :]) for i in range(free.degree()))
        found.append(sum(terms, fmpq_poly()))
    common = _common(c.denom() for c in found)
    return [(c * common).numer() for c in found]


def _split(part: fmpz_poly, coordinates: Sequence[fmpz_poly]) -> Iterator[tuple[fmpz_poly, tuple[fmpz_poly, ...]]]:
    """The factors of a polynomial at whose roots a coordinate vanishes always, then written as 0, or never."""
    pieces = [(part, tuple(coordinates))]
    for v in VARIABLES:
        finer = []
        for piece, c in pieces:
            zero = piece.gcd(c[v])
            if zero.degree() > 0:
                finer.append((zero, (*c[:v], fmpz_poly(), *c[v + 1 :])))
            if zero.degree() < piece.degree():
                finer.append((piece // zero, c))
        pieces = finer
    yield from pieces


@cache
def _monomials(degree: int) -> list[tuple[int, ...]]:
    return [*itertools.combinations_with_replacement(VARIABLES, degree)][::-1]


@cache
def _places(degree: int) -> dict[tuple[int, ...], int]:
    return {e: i for i, e in enumerate(_monomials(degree))}


def _powers(k: int) -> list[int]:
    return [1, k, k * k, k**3]


def _common(denominators: Iterable[fmpz]) -> fmpz:
    """The least common multiple."""
    return reduce(fmpz.lcm, denominators, fmpz(1))


def _traces(left: Sequence[fmpz_mat], right: Sequence[fmpz_mat]) -> fmpz_mat:
    """tr(a b) for each a and b."""
    rows = fmpz_mat([a.entries() for a in left])
    return rows * fmpz_mat([b.transpose().entries() for b in right]).transpose()


def _sign_changes(coefficients: Sequence[fmpz]) -> int:
    signs = [c > 0 for c in coefficients if c != 0]
    return sum(a != b for a, b in itertools.pairwise(signs))
