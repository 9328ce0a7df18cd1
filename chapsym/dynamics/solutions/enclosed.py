"""All rotations with a given momentum, from exact rational input: counted and enclosed, complete by proof.

The rotations are the real common points of three quadrics (5.2).  If these have finitely many common complex points,
`common_points` counts the real ones exactly and gives each as a rational function of an algebraic number, which is
enclosed to any precision; each simple one must also pass the interval Newton test of `proved_root`.

The forms of degree 4 in the ideal are the row space of a Macaulay matrix, and a common point x is a functional on S₄
that it kills.  Let N hold all functionals that it kills, and h be a linear form for which N restricted to h·S₃ has full
rank.  Then no common point has h = 0, so there are finitely many (8 with multiplicity, by Bézout), and x_v/h acts on N
as multiplication in the algebra of the points.  The characteristic polynomial of a form that separates the points, the
*eliminant*, has one root for each point, of its multiplicity, and a real root for each real point; the points are
rational functions of the root (Rouillier's rational univariate representation).  The trace form of the algebra decides
whether the form separates: its rank is the number of points.  Its signature is the number of real points (Hermite),
which must agree with the eliminant.
"""

import itertools
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, cmp_to_key, reduce
from typing import Any

import numpy as np
from flint import arb, fmpq, fmpq_mat, fmpq_poly, fmpz, fmpz_mat, fmpz_poly

from chapsym.numbers import Digits, Enclosure, Precision
from chapsym.numbers.precisions import flint_bits

from ..ball import Asked, Ball
from ..errors import BadInput, StepNotTaken
from ..levels.balls import exact
from ..levels.proved_root import Vector, enclosed, unit
from ..levels.start import fraction
from ..map import in_float64, step, unit_exactly
from .candidates import Quadric, momentum_forms, quadrics

#: A form with rational coefficients, by the ascending indices of the variables of each monomial.
Form = Mapping[tuple[int, ...], fmpq]

VARIABLES = range(4)
#: The degree at which the Macaulay matrix is complete: 3·(2 - 1) + 1.
DEGREE = 4
#: The first bits for the separation of roots, and the bits that a root may lack of the wanted ones.
COARSE, LOST = 64, 16
#: A point of P³ is on at most 3 of the planes (1, k, k², k³), so that one of 25 planes misses 8 points;
#: two points have equal quotients for at most 3 forms, and 8 points are 28 pairs.
PLANES = range(2, 27)
SEPARATING = range(-3, -88, -1)


class NotFinite(ArithmeticError):
    """The forms have infinitely many complex points in common."""


@dataclass(frozen=True)
class Factor:
    """The real points with a common multiplicity and common vanishing coordinates.

    The points are (c₀(t) : c₁(t) : c₂(t) : c₃(t)) for the real roots t of a polynomial without square factors.
    """

    polynomial: fmpz_poly
    coordinates: tuple[fmpz_poly, ...]
    multiplicity: int

    def points(self, bits: int) -> list[Vector]:
        """Arb enclosures of homogeneous coordinates, computed with `bits`; vanishing coordinates are exactly 0."""
        for coarse in (COARSE, bits):
            with flint_bits(coarse):
                roots: Any = self.polynomial.complex_roots()
            real = [self._refined(x.real, bits) for x, _ in roots if x.imag.is_zero()]
            if all(x.rel_accuracy_bits() >= bits - LOST for x in real):
                break
        with flint_bits(bits):
            return [tuple(c(x) for c in self.coordinates) for x in real]

    def _refined(self, root: arb, bits: int) -> arb:
        """The root in an interval, by interval Newton steps while they help, between which it can be interrupted."""
        slope, known = self.polynomial.derivative(), -math.inf
        with flint_bits(bits + self.polynomial.height_bits()):
            while known < root.rel_accuracy_bits() < bits:
                known, middle = root.rel_accuracy_bits(), arb(root.mid())
                root = middle - self.polynomial(middle) / slope(root)
        return root


@dataclass(frozen=True)
class Points:
    """All common points: the number of real points, and the factors of the eliminant."""

    real: int
    factors: tuple[Factor, ...]


def common_points(forms: Sequence[Form]) -> Points:
    """The common points of forms of degree 1 and 2 in (q0, q1, q2, q3), three quadrics among them.

    Raises NotFinite if there are infinitely many, and ArithmeticError if the two counts differ.
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
        raise ArithmeticError("no linear form separates the common points")
    coordinates = _representation(algebra, multiplication, parts)
    factors = tuple(Factor(p, c, m) for part, m in parts for p, c in _split(part, coordinates))
    if (real := sum(len(factor.points(64)) for factor in factors)) != signature:
        raise ArithmeticError("the real roots of the eliminant and the signature of the trace form differ")
    return Points(real, factors)


class _Algebra:
    """The algebra of the common points: the matrices of q0/h, ..., q3/h."""

    def __init__(self, forms: Sequence[Form]) -> None:
        kernel = _killed(forms)
        if (size := kernel.ncols()) > 8:
            raise NotFinite
        below, place = _monomials(DEGREE - 1), _places(DEGREE)
        rows = kernel.tolist()
        by_variable = [fmpz_mat([rows[place[tuple(sorted((*m, v)))]] for m in below]) for v in VARIABLES]
        for k in PLANES:
            plane = sum((c * x for c, x in zip(_powers(k), by_variable, strict=True)), fmpz_mat(len(below), size))
            # The first rows that span all rows.
            reduced, _, rank = plane.transpose().rref()
            chosen = [next(j for j in range(len(below)) if reduced[i, j] != 0) for i in range(rank)]
            if rank == size:
                break
        else:
            raise NotFinite
        inverse, *own = (fmpq_mat(fmpz_mat([x.tolist()[i] for i in chosen])) for x in (plane, *by_variable))
        inverse = inverse.inv()
        self.size = size
        self.basis = [below[i] for i in chosen]
        self.variables = [inverse * x for x in own]
        # All multiplied by one positive number, so that there are no denominators.
        scale = _common(variable.numer_denom()[1] for variable in self.variables)
        self.integral = [(scale * variable).numer_denom()[0] for variable in self.variables]

    def form(self, k: int) -> fmpq_mat:
        """The matrix of (q0 + k q1 + k² q2 + k³ q3)/h."""
        return sum((c * m for c, m in zip(_powers(k), self.variables, strict=True)), fmpq_mat(self.size, self.size))

    def inertia(self) -> tuple[int, int]:
        """Rank and signature of the trace form (a, b) -> tr(ab): the numbers of points, and of real points."""
        # Each multiplied by a positive number, which does not change the inertia.
        elements = [_primitive(reduce(fmpz_mat.__mul__, (self.integral[v] for v in m))) for m in self.basis]
        # All roots are real, so that Descartes' rule is exact.
        polynomial = _traces(elements, elements).charpoly().coeffs()
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
    # Each divided by its content; without this, long coefficients would give 20 times as many digits.
    killed = columns.transpose().tolist()[:nullity]
    return fmpz_mat([_primitive(fmpz_mat([one])).entries() for one in killed]).transpose()


def _primitive(matrix: fmpz_mat) -> fmpz_mat:
    """A matrix divided by its content."""
    common = reduce(fmpz.gcd, matrix.entries(), fmpz(0))
    return fmpz_mat(matrix.nrows(), matrix.ncols(), [x if common == 0 else x // common for x in matrix.entries()])


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
    """The factors of a polynomial at whose roots each coordinate vanishes always (then it is written as 0) or never."""
    pieces = [(part, tuple(coordinates))]
    for v in VARIABLES:
        finer = []
        for piece, c in pieces:
            if (zero := piece.gcd(c[v])).degree() > 0:
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


#: The largest number of bits of a coefficient; float64 input has fewer, and takes some seconds.
MOST_BITS = 10_000
#: The largest number of times that the working precision is doubled.
MOST_PRECISIONS = 14
#: The bits of an enclosure beyond those of the output.
SPARE = 12
#: A bound of the rounding of a float64 step, even for a large D or near a fold.
SAME = 1e-3
#: The float64 step belongs to the nearest rotation if the second nearest is this many times farther away.
CLEARLY = 4.0


@dataclass(frozen=True)
class Branch:
    """One rotation with the given momentum.

    rotation: unit Euler parameters (q0, q1, q2, q3) as Arb balls; q0 ≥ 0, and at q0 = 0 the first of q1, q2, q3
    that is not 0 is positive.  A parameter that is 0 is exactly 0.
    angle: of the rotation, in [0, π].
    multiplicity: as a root of (5.2); 1 means that the tangent Jacobian is regular.
    small_rotation: whether this is the rotation of `step`.
    """

    rotation: Vector
    angle: arb
    multiplicity: int
    small_rotation: bool = False


@dataclass(frozen=True)
class PreciseBranches:
    """All rotations with a momentum, by angle, at a precision; `write` gives the fields of the JSON form.

    complete: whether it is proved that there is no other; if not, `reason` is a sentence.
    """

    precision: Precision
    solutions: tuple[Branch, ...]
    complete: bool
    reason: str | None = None

    def write(self) -> dict[str, Any]:
        """count, complete and the solutions, as floats or decimal strings."""
        with self.precision.working():
            solutions = [_written(self.precision, branch) for branch in self.solutions]
        reason = {} if self.reason is None else {"reason": self.reason}
        return {"count": len(solutions), "complete": self.complete, **reason, "solutions": solutions}


def precise_branches(
    mass_tensor: Sequence[Fraction],
    D: Fraction,
    momentum: Sequence[Fraction],
    gamma: Sequence[Fraction],
    precision: Precision,
) -> PreciseBranches:
    """All rotations Ω with 𝒦(q, γ) = 𝒦 (5.2) of one ball, from exact rational input.

    (q0, q) and (-q0, -q) are one rotation.  The equations are solved as they are given: a γ that is unit to the
    digits of the precision only is taken as it is.  The set is complete unless the complex solutions are infinitely
    many for a reason that is not understood, or the real ones are.

    Raises BadInput as `exact_step` does, and for numbers with more bits than those of float64.
    """
    unit_exactly(gamma, precision)
    J, (contact,), K, g = np.split(np.array(in_float64(mass_tensor, (D,), momentum, gamma)), [3, 4, 7])
    try:
        taken = step(Ball(J, contact), K, g).rotation
    except StepNotTaken:
        taken = None
    given = momentum, gamma, mass_tensor, (D,)
    state = [[fmpq(x.numerator, x.denominator) for x in v] for v in given]
    equations = quadrics(state[0], state[1], state[2], *state[3])
    long = sum(max(max(c.p.bit_length(), c.q.bit_length()) for c in form.values()) for form in equations)
    if long > MOST_BITS:
        raise BadInput(
            f"the numbers are too long to count their rotations: {long} bits in the equations, of {MOST_BITS}"
        )
    try:
        points = common_points([*equations, *_proportional(*state)])
    except NotFinite:
        found = _the_small_one(taken, given, precision)
        return PreciseBranches(precision, found, False, _why_infinite(equations))
    return PreciseBranches(precision, _with_small_rotation(_enclosures(points, precision, given), taken), True)


def _proportional(K: list, g: list, J: list, D: list) -> Iterator[Form]:
    """Linear equations of every rotation if 𝒦(q, γ) is q0 times a linear L(q), as for equal moments.

    Then q0 L(q) = 𝒦 ≠ 0, so that q0 ≠ 0 and 𝒦 × L(q) = 0, while the quadrics have a conic of complex points at q0 = 0.
    """
    forms = momentum_forms(g, J, *D)
    if not any(K) or any(c != 0 for form in forms for (a, _), c in form.items() if a > 0):
        return
    linear = [[form[0, v] for v in range(4)] for form in forms]
    for i, j in ((1, 2), (2, 0), (0, 1)):
        yield {(v,): K[i] * linear[j][v] - K[j] * linear[i][v] for v in range(4)}


def _why_infinite(equations: Sequence[Quadric]) -> str:
    """One sentence for quadrics with a common curve."""

    def common(i: int, j: int) -> bool:
        return all(e[pair] == 0 for e in equations for pair in ((i, i), (i, j), (j, j)))

    planes = [(i, j) for i, j in ((1, 2), (1, 3), (2, 3)) if common(i, j)]
    if len(planes) == 3:
        return "there are infinitely many: every rotation by pi has this momentum, which is 0"
    if planes:
        plane = "the plane of e{} and e{}".format(*planes[0])
        return f"there are infinitely many: every rotation by pi about an axis in {plane} has this momentum, which is 0"
    return "the equations have a curve of complex solutions in common, so that the real ones cannot be counted"


def _enclosures(points: Points, precision: Precision, given: Sequence[Sequence[Fraction]]) -> tuple[Branch, ...]:
    """Disjoint enclosures of the rotations in Arb, each component to the digits of the precision, by angle."""
    wanted = _bits(precision) + SPARE
    bits = 2 * wanted + 64
    for _ in range(MOST_PRECISIONS):
        with flint_bits(bits):
            found = [_branch(c, f.multiplicity) for f in points.factors for c in f.points(bits)]
            # A leading parameter with this many bits has a certain sign.
            precise = all(x.rel_accuracy_bits() >= wanted for b in found for x in (*b.rotation, b.angle))
            if precise and _apart(found) and _confirmed(found, given):
                return tuple(sorted(found, key=cmp_to_key(_order)))
        bits *= 2
    raise ArithmeticError("the rotations could not be enclosed")


def _branch(coordinates: tuple, multiplicity: int) -> Branch:
    """The rotation with these homogeneous coordinates."""
    sign = -1 if next(c for c in coordinates if not c.is_zero()) < 0 else 1
    q = tuple(sign * c for c in unit(coordinates))
    sine = arb(0) if all(c.is_zero() for c in q[1:]) else sum((c * c for c in q[1:]), arb(0)).sqrt()
    return Branch(q, 2 * arb.atan2(sine, q[0]), multiplicity)


def _apart(branches: Sequence[Branch]) -> bool:
    """Whether no two enclosures overlap."""
    return not any(
        all(x.overlaps(y) for x, y in zip(a.rotation, b.rotation, strict=True))
        for i, a in enumerate(branches)
        for b in branches[:i]
    )


def _confirmed(branches: Sequence[Branch], given: Sequence[Sequence[Fraction]]) -> bool:
    """Whether the interval Newton test, with the kernels, confirms every simple root."""
    state = [tuple(map(exact, vector)) for vector in given]
    for branch in branches:
        if branch.multiplicity == 1:
            if (again := enclosed(branch.rotation, *state)) is None:
                return False
            if not all(x.overlaps(y) for x, y in zip(again, branch.rotation, strict=True)):
                raise ArithmeticError("the interval Newton test finds another rotation than the eliminant")
    return True


def _order(a: Branch, b: Branch) -> int:
    """The order by angle; for equal angles by q0, q1, q2, q3, the larger first."""
    if a.angle < b.angle or b.angle < a.angle:
        return -1 if a.angle < b.angle else 1
    for x, y in zip(a.rotation, b.rotation, strict=True):
        if x > y or x < y:
            return -1 if x > y else 1
    return 0


def _with_small_rotation(branches: tuple[Branch, ...], taken: Asked) -> tuple[Branch, ...]:
    """The same, with a mark at the rotation of the float64 step, if it takes one."""
    if taken is None:
        return branches
    places = [np.array([float(x.mid()) for x in branch.rotation]) for branch in branches]
    distances = [min(np.abs(q - taken).max(), np.abs(q + taken).max()) for q in places]
    first, second, *_ = [*sorted(distances), np.inf, np.inf]
    if first > SAME or CLEARLY * first >= second:
        return branches
    return tuple(replace(b, small_rotation=bool(d == first)) for b, d in zip(branches, distances, strict=True))


def _the_small_one(taken: Asked, given: Sequence[Sequence[Fraction]], precision: Precision) -> tuple[Branch, ...]:
    """The small rotation, if the interval Newton test encloses it."""
    if taken is None:
        return ()
    bits = 2 * (_bits(precision) + SPARE) + 64
    with flint_bits(bits):
        state = [tuple(map(exact, vector)) for vector in given]
        found = enclosed(tuple(arb(float(x)) for x in taken), *state)
        return () if found is None else (replace(_branch(found, 1), small_rotation=True),)


def _bits(precision: Precision) -> int:
    if isinstance(precision, Enclosure):
        return precision.bits
    return math.ceil(precision.digits / math.log10(2)) if isinstance(precision, Digits) else 53


def _written(precision: Precision, branch: Branch) -> dict[str, Any]:
    q0, *q = (_number(precision, x) for x in branch.rotation)
    angle = _number(precision, branch.angle)
    return {
        "q0": q0, "q": q, "angle": angle,
        "multiplicity": branch.multiplicity, "small_rotation": branch.small_rotation,
    }  # fmt: skip


def _number(precision: Precision, value: arb) -> Any:
    """An Arb ball for JSON: the ball itself, or its midpoint, accurate to the digits of the output."""
    if isinstance(precision, Enclosure):
        return precision.write(value)
    return precision.write(precision.number(fraction(value)))
