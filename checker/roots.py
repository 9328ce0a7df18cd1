"""Counts: the number of solutions, in projective space, of equations that are homogeneous in their unknowns.

A count has unknowns, equations, and `nonzero`: expressions that must not vanish at any solution; a point has a number
for every other name.  Its proof has

chart         a regular matrix A: the unknowns are A y, y = (y0, ..., yn); t is yn where y0 is 1
combinations  lists of polynomials in y, one for each equation; a list denotes Σ polynomial · equation, which is 0 at
              every solution

1. For i = n, ..., 1 one of the combinations is a non-zero multiple of a power of yi where y0 = 0 and all y after yi are
   0.  So a solution with y0 = 0 would have yn = 0, ..., y1 = 0: there is none, and y0 can be set to 1.
2. The first n combinations are linear in y1, ..., y(n-1): they are M(t)(1, y1, ..., y(n-1)), where M is a matrix of
   polynomials.  So e(t) = det M(t), which is not the zero polynomial, vanishes at every solution.
3. Let Y be the cofactors of the last row of M.  Y0 and e have no common root: at each root of e the common kernel of
   the other rows has dimension 1, so that the root has at most one solution, y = (Y, t Y0).
4. The root has a solution: the equations at that y, polynomials in t, are divisible by e.

So the number of solutions is the number of different roots of e, and the number of real solutions that of real roots,
which Sturm's theorem counts.  By 3 and 4 the local ring of a solution is Q[t]/(e) at its root: their multiplicities are
equal.  The expressions of `nonzero` have, at that y, no common root with e.
"""

from collections.abc import Collection, Mapping, Sequence
from fractions import Fraction
from functools import reduce
from itertools import pairwise
from math import gcd
from operator import add, mul
from typing import Any

from .document import Data, count
from .form import check_shape, once, sized
from .interval import Rejected
from .linear import dot
from .polynomial import FIELD, Polynomial, Quotient, Ring, Work
from .rational import cofactors, determinant
from .trees import Tree, names_in, rational, value

#: The results of a count: different solutions, and solutions with multiplicity.
NUMBERS = ("real", "complex", "real_with_multiplicity", "complex_with_multiplicity")
MOST_UNKNOWNS = 5
#: The integer coefficients of a polynomial in t, from the constant to the leading one, which is not 0.
Dense = list[int]


def check_form(one: Data, algebra: Data, point: Data, made: Collection[str], where: str) -> None:
    """Raises Rejected unless the names and sizes of a count are valid; its relations are checked elsewhere."""
    size = len(one["unknowns"])
    count(size, 2, MOST_UNKNOWNS, f"the number of unknowns of {where}")
    numbers = [name for name, entry in point.items() if not isinstance(entry, list)]
    if algebra["kind"] != "quotient" or not set(algebra["variables"]) <= {*numbers, *one["unknowns"]}:
        raise Rejected(f"{where} must be in a quotient, with a number for every variable that is no unknown")
    once([*numbers, *one["unknowns"], *made], where)
    check_shape(one["chart"], ((rational,) * size,) * size, where)
    for combination in one["combinations"]:
        sized(combination, len(one["equations"]), where)


def solutions(
    one: Data, algebra: Data, point: Mapping[str, Any], values: Mapping[str, Tree], work: Work, where: str
) -> dict[str, Fraction]:
    """The NUMBERS of a count whose form was checked; raises Rejected unless they are proved."""
    size, trees = len(one["unknowns"]), [*one["equations"], *one["nonzero"]]
    ring = Ring([f"y{i}" for i in range(size)], work)
    known = {name: ring.number(x) for name, x in point.items() if isinstance(x, Fraction)}
    for relation in algebra["relations"]:
        if names_in(relation) <= known.keys() and value(relation, known, ring.number).numerator.terms:
            raise Rejected(f"{where} has a point at which a relation fails")
    chart = [[ring.number(Fraction(x)) for x in row] for row in one["chart"]]
    if not determinant(chart, ring.number(Fraction(1))).numerator.terms:
        raise Rejected(f"{where} has a chart that is not regular")

    def forms(y: Sequence[Quotient]) -> list[Quotient]:
        """The equations and the expressions of `nonzero`, for the unknowns A y."""
        names = known | {x: dot(row, y) for x, row in zip(one["unknowns"], chart, strict=True)}
        made = names_in([0, *trees]) & values.keys()
        names |= {name: value(values[name], names, ring.number) for name in made}
        return [value(tree, names, ring.number) for tree in trees]

    y, last = ring.names(), len(one["equations"])
    found = forms([*y.values()])
    if ring.factors:  # 1/(1/x) would become x, which has a root where 1/x has no value
        raise Rejected(f"{where} divides by something that is no number")
    for combination in one["combinations"]:
        factors = [value(tree, y, ring.number) for tree in combination]
        found.append(reduce(add, map(mul, factors, found), ring.number(Fraction(0))))
    if any(f.factors or len({sum(_exponents(m, size)) for m in f.numerator.terms}) > 1 for f in found):
        raise Rejected(f"{where} has an expression that is no homogeneous polynomial")
    combinations = [f.numerator for f in found[len(trees) :]]
    for i in range(1, size):  # each i needs a different one, so there are at least n
        if not any(_is_power_at_infinity(combination, i, size) for combination in combinations):
            raise Rejected(f"{where} may have solutions with y0 = 0: no combination is a power of y{i} there")
    rows = [_row(combination, ring, where) for combination in combinations[: size - 1]]
    last_row = cofactors(rows[:-1], ring.number(Fraction(1)))
    e = _dense(dot(rows[-1], last_row))
    if not e:
        raise Rejected(f"{where} has combinations with the determinant 0")
    on_curve = list(map(_dense, forms([*last_row, last_row[0] * y[f"y{size - 1}"]])))
    if len(_chain(e, _dense(last_row[0]), work)[-1]) > 1:
        raise Rejected(f"{where} may have two solutions for one root")
    if any(_remainder(form, e, work) for form in on_curve[:last]):
        raise Rejected(f"{where} has a root that may be that of no solution")
    if any(len(_chain(e, form, work)[-1]) > 1 for form in on_curve[last:]):
        raise Rejected(f"{where} has a solution at which something vanishes that should not")
    return dict(zip(NUMBERS, map(Fraction, _roots(e, work)), strict=True))


def _exponents(monomial: int, size: int) -> list[int]:
    return [monomial >> FIELD * i & 0xFFFF for i in range(size)]


def _is_power_at_infinity(form: Polynomial, i: int, size: int) -> bool:
    """Whether a form is a non-zero multiple of a power of yi where y0 and all y after yi are 0."""
    left = [e for e in (_exponents(m, size) for m in form.terms) if not e[0] and not any(e[i + 1 :])]
    return len(left) == 1 and sum(left[0]) == left[0][i]


def _row(form: Polynomial, ring: Ring, where: str) -> list[Quotient]:
    """The coefficients of 1, y1, ..., y(n-1) for y0 = 1, polynomials in t."""
    size = len(ring.variables)
    row: list[dict[int, int]] = [{} for _ in range(size - 1)]
    for monomial, c in form.terms.items():
        _, *middle, power = _exponents(monomial, size)
        if sum(middle) > 1:
            raise Rejected(f"{where} has one of the first combinations that is not linear")
        row[middle.index(1) + 1 if any(middle) else 0][power << FIELD * (size - 1)] = c
    return [Quotient(Polynomial(ring, terms, form.degree, form.bits), 1, {}) for terms in row]


def _dense(of: Quotient) -> Dense:
    """The coefficients of a polynomial in t, the last variable, without its denominator."""
    powers = {_exponents(m, len(of.numerator.ring.variables))[-1]: c for m, c in of.numerator.terms.items()}
    return [powers.get(k, 0) for k in range(max(powers, default=-1) + 1)]


def _remainder(a: Dense, b: Dense, work: Work) -> Dense:
    """A positive multiple of the remainder of a by b, without a common factor."""
    while len(a) >= len(b):
        bits = max(map(int.bit_length, a + b))
        work.spend(len(a) * (1 + bits // 512) ** 2)  # both factors are long numbers
        common = gcd(a[-1], b[-1]) * (1 if b[-1] > 0 else -1)
        shifted = [0] * (len(a) - len(b)) + b
        a = [x * (b[-1] // common) - y * (a[-1] // common) for x, y in zip(a, shifted, strict=True)]
        while a and not a[-1]:
            a = a[:-1]
    common = gcd(*a)
    return [x // common for x in a]


def _chain(a: Dense, b: Dense, work: Work) -> list[Dense]:
    """The Sturm chain of a and b: Euclid's algorithm with Sturm's signs; the last is the greatest common divisor."""
    found = [a]
    while b:
        found.append(b)
        a, b = b, [-x for x in _remainder(a, b, work)]
    return found


def _roots(e: Dense, work: Work) -> tuple[int, int, int, int]:
    """The NUMBERS of the roots of e; a root of multiplicity m > 1 is a root of gcd(e, e') of multiplicity m - 1."""
    real, different = [], []
    while len(e) > 1:
        chain = _chain(e, [k * c for k, c in enumerate(e)][1:], work)
        # Sign changes at -∞ minus those at +∞; pairs whose degrees differ by an even number contribute equally to both.
        odd = [p[-1] * q[-1] for p, q in pairwise(chain) if len(p) % 2 != len(q) % 2]
        real.append(sum(1 if product > 0 else -1 for product in odd))
        different.append(len(e) - len(chain[-1]))
        e = chain[-1]
    return sum(real[:1]), sum(different[:1]), sum(real), sum(different)
