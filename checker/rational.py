"""Rational functions of the variables of a ring: values, substitution, derivatives, and linear systems."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction

from .interval import Rejected
from .linear import dot
from .polynomial import FIELD, Polynomial, Quotient
from .trees import bounded, rational

#: The most rows of a linear system.
MOST_ROWS = 4


def number_at(x: Quotient, point: Mapping[str, Fraction], where: str) -> Fraction:
    """The value of a rational function at a point; raises Rejected at a pole, or if a variable has no value."""
    ring = x.numerator.ring

    def number(of: Polynomial) -> Fraction:
        result = Fraction(0)
        for monomial, c in of.terms.items():
            term = Fraction(c)
            for i, name in enumerate(ring.variables):
                if power := monomial >> FIELD * i & 0xFFFF:
                    if name not in point:
                        raise Rejected(f"{where} has no point at which its relations hold: no value for {name}")
                    term *= point[name] ** power
            result += bounded(term)
        return result

    below = Fraction(x.scale)
    for i, power in x.factors.items():
        below *= number(ring.factors[i]) ** power
    if below == 0:
        raise Rejected(f"{where} divides by 0 at its point")
    return number(x.numerator) / below


def placed(x: Quotient, places: Mapping[str, Quotient]) -> Quotient:
    """A rational function with others substituted for variables."""
    ring, own = x.numerator.ring, x.numerator.ring.names()

    def image(of: Polynomial) -> Quotient:
        return with_powers(of, lambda name, power: places.get(name, own[name]) ** power)

    below = ring.number(rational(x.scale, "a denominator"))
    for i, power in x.factors.items():
        below = below * image(ring.factors[i]) ** power
    return image(x.numerator) * below**-1


def with_powers(of: Polynomial, power: Callable[[str, int], Quotient]) -> Quotient:
    """A polynomial with `power(name, exponent)` substituted for each power of a variable."""
    ring = of.ring
    result = ring.number(Fraction(0))
    for monomial, c in of.terms.items():
        term = ring.number(rational(c, "a coefficient"))
        for i, name in enumerate(ring.variables):
            if exponent := monomial >> FIELD * i & 0xFFFF:
                term = term * power(name, exponent)
        result = result + term
    return result


def rate(x: Quotient, move: Mapping[str, Quotient]) -> Quotient:
    """The derivative of a rational function for these rates of the variables."""
    ring = x.numerator.ring

    def derivative(of: Polynomial) -> Quotient:
        result = ring.number(Fraction(0))
        for i, name in enumerate(ring.variables):
            if name in move:
                one = 1 << FIELD * i
                terms = {m - one: c * e for m, c in of.terms.items() if (e := m >> FIELD * i & 0xFFFF)}
                bits = of.bits + FIELD
                result = result + Quotient(Polynomial(ring, terms, of.degree, bits), 1, {}) * move[name]
        return result

    result = derivative(x.numerator) * Quotient(ring.constant(1), x.scale, x.factors)
    for i, power in x.factors.items():
        factor = Quotient(ring.factors[i], 1, {})
        result = result - x * ring.number(rational(power, "a power")) * derivative(ring.factors[i]) * factor**-1
    return result


def solved(matrix: Sequence[Quotient], right: Sequence[Quotient], where: str) -> list[Quotient]:
    """The solution of a linear system, by Cramer's rule."""
    n = len(right)
    if not 1 <= n <= MOST_ROWS or len(matrix) != n * n:
        raise Rejected(f"{where} solves a system that is not of one to {MOST_ROWS} rows, as many as there are columns")
    rows = [list(matrix[n * i : n * i + n]) for i in range(n)]
    one = matrix[0].numerator.ring.number(Fraction(1))
    whole = determinant(rows, one)
    if not whole.numerator.terms:
        raise Rejected(f"{where} solves a system whose determinant is 0")
    found = []
    for j in range(n):
        with_right = [[*row[:j], b, *row[j + 1 :]] for row, b in zip(rows, right, strict=True)]
        found.append(determinant(with_right, one) * whole**-1)
    return found


def determinant(rows: Sequence[Sequence[Quotient]], one: Quotient) -> Quotient:
    """The determinant, up to a sign that depends on the size alone."""
    found: Quotient = dot(rows[-1], cofactors(rows[:-1], one)) if rows else one
    return found


def cofactors(rows: Sequence[Sequence[Quotient]], one: Quotient) -> list[Quotient]:
    """The cofactors of a row added below these rows, up to a common sign."""
    left_out = [[[*row[:i], *row[i + 1 :]] for row in rows] for i in range(len(rows) + 1)]
    minors = [determinant(minor, one) for minor in left_out]
    return [-x if i % 2 else x for i, x in enumerate(minors)]
