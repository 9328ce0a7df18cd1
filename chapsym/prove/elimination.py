"""The data that prove a count of solutions (checker/roots.py): a chart and combinations, by linear algebra.

The forms of one degree in the ideal of the equations are the row space of a Macaulay matrix.  Its rows are reduced with
the unwanted monomials first: the lower rows have none of these, and the adjoined columns have the combinations.
"""

import itertools
import random
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from math import gcd, lcm
from typing import Any, NamedTuple

from flint import Ordering, fmpq, fmpq_mat, fmpq_mpoly, fmpq_mpoly_ctx, fmpq_poly

Monomial = tuple[int, ...]
#: A form by its terms; and a hashable form.
Form = Mapping[Monomial, fmpq]
Key = tuple[tuple[Monomial, fmpq], ...]
#: The number of trial charts, and the degrees of the combinations.
CHARTS, MOST_DEGREE = 12, 8


class NotCounted(ArithmeticError):
    """No combinations were found; the message has a possible reason."""


class Elimination(NamedTuple):
    """The chart; the factors of the equations for each combination; y on the curve, and the eliminant, in t."""

    chart: list[list[int]]
    combinations: list[list[dict[Monomial, int]]]
    curve: list[fmpq_poly]
    eliminant: fmpq_poly

    def vanishes_at_none(self, form: Form) -> bool:
        """Whether the form vanishes at no solution, real or complex."""
        return bool(self.eliminant.gcd(self.on_curve(form)).degree() == 0)

    def on_curve(self, form: Form) -> fmpq_poly:
        """A form in the unknowns, at y."""
        unknowns = [sum((x * c for c, x in zip(row, self.curve, strict=True)), fmpq_poly()) for row in self.chart]
        return _value(form, unknowns, fmpq_poly([1]))


@cache
def eliminate(equations: tuple[Key, ...], size: int) -> Elimination:
    """The elimination for homogeneous equations in `size` unknowns; raises NotCounted."""
    ring = fmpq_mpoly_ctx.get(tuple(f"y{i}" for i in range(size)), Ordering.degrevlex)
    for chart in itertools.islice(_charts(size), CHARTS):
        places = [sum((x * c for c, x in zip(row, ring.gens(), strict=True)), ring.constant(0)) for row in chart]
        forms = [_value(dict(e), places, ring.constant(1)) for e in equations]
        if (found := _combinations(forms, size)) is None:
            continue
        rows = [_linear(combination, forms, size) for combination in found[: size - 1]]
        cofactors = _cofactors(rows[:-1])
        eliminant = sum((x * y for x, y in zip(rows[-1], cofactors, strict=True)), fmpq_poly())
        made = Elimination(chart, found, [*cofactors, cofactors[0] * fmpq_poly([0, 1])], eliminant)
        one_each = eliminant and cofactors[0].gcd(eliminant).degree() == 0
        if one_each and not any(made.on_curve(dict(e)) % eliminant for e in equations):
            return made
    raise NotCounted("the solutions cannot be counted so: there are infinitely many, or none, or some touch in a plane")


def _charts(size: int) -> Iterator[list[list[int]]]:
    """The charts: the unknowns, then products of two triangular matrices with small entries."""
    for seed in itertools.count():
        entry = random.Random(seed).randint
        places = [[i == j for j in range(size)] for i in range(size)]
        low, high = ([[int(on) or entry(-1, 1) * bool(seed) for on in row] for row in places] for _ in "LU")
        yield [[sum(low[i][k] * high[k][j] for k in range(min(i, j) + 1)) for j in range(size)] for i in range(size)]


def _value(form: Form, places: Sequence[Any], one: Any) -> Any:
    """The value of a form at other polynomials."""
    total = 0 * one
    for monomial, c in form.items():
        part = one * c
        for place, power in zip(places, monomial, strict=True):
            part *= place**power
        total += part
    return total


def _combinations(forms: Sequence[fmpq_mpoly], size: int) -> list[list[dict[Monomial, int]]] | None:
    """The forms linear in y1, ..., y(n-1), and for each of these a power of it at y0 = 0 and later y = 0."""
    if None in (powers := [_power(forms, i, size) for i in range(size - 1, 0, -1)]):
        return None
    linear: dict[int, list[dict[Monomial, int]]] = {}
    for degree in range(1, MOST_DEGREE + 1):
        # The leading power of t is at y1, ..., y(n-1), and at 1 in the last form.
        leads = [_monomial({i: 1, size - 1: degree - 1}, size) for i in range(1, size - 1)]
        leads.append(_monomial({size - 1: degree}, size))
        unwanted = [m for m in _monomials(size, degree) if sum(m[1:-1]) > 1]
        found = _reduced(forms, unwanted, leads, degree)
        linear |= {i: found[lead] for i, lead in enumerate(leads) if lead in found and i not in linear}
        if len(linear) == size - 1:  # the last form is a power of t at y0 = 0
            return [linear[i] for i in range(size - 1)] + [power for power in powers[1:] if power is not None]
    return None


def _power(forms: Sequence[fmpq_mpoly], i: int, size: int) -> list[dict[Monomial, int]] | None:
    """A combination that is a power of yi at y0 = 0 and later y = 0."""
    highest = 1 + sum(form.total_degree() - 1 for form in forms)  # the degree at which Macaulay's matrix is complete
    for degree in range(1, highest + 1):
        lead = _monomial({i: degree}, size)
        others = [m for m in _monomials(size, degree) if not m[0] and not any(m[i + 1 :]) and m != lead]
        if found := _reduced(forms, others, [lead], degree):
            return found[lead]
    return None


def _reduced(
    forms: Sequence[fmpq_mpoly], unwanted: Sequence[Monomial], leads: Sequence[Monomial], degree: int
) -> dict[Monomial, list[dict[Monomial, int]]]:
    """Combinations of a degree without the unwanted monomials, by the first of the leads that each contains."""
    columns = {m: i for i, m in enumerate([*unwanted, *leads])}
    multiples = [
        (form, m)
        for form in range(len(forms))
        for m in _monomials(len(forms[0].context().gens()), degree - forms[form].total_degree())
    ]
    width = len(columns)
    matrix = fmpq_mat(len(multiples), width + len(multiples))
    for row, (form, m) in enumerate(multiples):
        for monomial, c in forms[form].terms():
            if (product := tuple(a + b for a, b in zip(m, monomial, strict=True))) in columns:
                matrix[row, columns[product]] = c
        matrix[row, width + row] = fmpq(1)
    reduced, rank = matrix.rref()
    found = {}
    for row in range(rank):
        first = next(i for i in range(width + len(multiples)) if reduced[row, i] != 0)
        if len(unwanted) <= first < width:
            factors = [reduced[row, width + i] for i in range(len(multiples))]
            found[leads[first - len(unwanted)]] = _integral(multiples, factors, len(forms))
    return found


def _integral(
    multiples: Sequence[tuple[int, Monomial]], factors: Sequence[fmpq], count: int
) -> list[dict[Monomial, int]]:
    """The factors of each form, without common factors or denominators."""
    whole = lcm(*(int(c.q) for c in factors))
    integers = [int(c.p) * (whole // int(c.q)) for c in factors]
    common = gcd(*integers)
    found: list[dict[Monomial, int]] = [{} for _ in range(count)]
    for (form, monomial), c in zip(multiples, integers, strict=True):
        if c:
            found[form][monomial] = c // common
    return found


def _linear(combination: Sequence[Mapping[Monomial, int]], forms: Sequence[fmpq_mpoly], size: int) -> list[fmpq_poly]:
    """The coefficients of 1, y1, ..., y(n-1), in t, at y0 = 1."""
    context = forms[0].context()
    whole = sum((context.from_dict(dict(c)) * f for c, f in zip(combination, forms, strict=True)), context.constant(0))
    row = [fmpq_poly() for _ in range(size - 1)]
    for monomial, c in whole.terms():
        middle = monomial[1:-1]
        row[middle.index(1) + 1 if any(middle) else 0] += fmpq_poly([0] * monomial[-1] + [c])
    return row


def _cofactors(rows: Sequence[Sequence[fmpq_poly]]) -> list[fmpq_poly]:
    """The cofactors of a row added below these rows, up to a common sign."""
    if not rows:
        return [fmpq_poly([1])]
    found = []
    for i in range(len(rows) + 1):
        minor = [[*row[:i], *row[i + 1 :]] for row in rows]
        last = zip(minor[-1], _cofactors(minor[:-1]), strict=True)
        found.append(sum((x * y for x, y in last), fmpq_poly()) * (-1) ** i)
    return found


def _monomial(powers: Mapping[int, int], size: int) -> Monomial:
    return tuple(powers.get(i, 0) for i in range(size))


def _monomials(size: int, degree: int) -> Iterator[Monomial]:
    """All monomials of a degree; none for a negative degree."""
    for powers in itertools.product(range(degree + 1), repeat=size - 1):
        if sum(powers) <= degree:
            yield (degree - sum(powers), *powers)
