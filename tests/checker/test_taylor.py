"""The functions of the checker against exact polynomials: what is true is never left out."""

from fractions import Fraction
from itertools import zip_longest

import pytest
from hypothesis import given
from hypothesis import strategies as st

from chapsym.checker.interval import Interval, Rejected
from chapsym.checker.taylor import Dual, Model, derivative

BITS = 12
ONE = 1 << BITS
TIMES = [Fraction(0), Fraction(2, 7), Fraction(1)]


def value(polynomial, s):
    return sum((x * s**k for k, x in enumerate(polynomial)), Fraction(0))


@st.composite
def functions(draw, first=(-3 * ONE, 3 * ONE), most=40):
    """A model, and a polynomial in it: off by all that is allowed, to either side, or by less."""
    terms = [draw(st.integers(*first)), *draw(st.lists(st.integers(-ONE, ONE), max_size=5))]
    off, share = draw(st.integers(0, most)), draw(st.sampled_from([-1, 0, Fraction(1, 3), 1]))
    return Model(terms, off, BITS), [Fraction(terms[0] + share * off, ONE), *(Fraction(x, ONE) for x in terms[1:])]


def contains(model, true, s):
    return abs(value([Fraction(x, ONE) for x in model.terms], s) - true) * ONE <= model.off


@given(functions(), functions())
def test_sums_and_products_contain_the_true_ones(first, second):
    (x, a), (y, b) = first, second
    for s in TIMES:
        p, q = value(a, s), value(b, s)
        assert contains(x + y, p + q, s)
        assert contains(x - y, p - q, s)
        assert contains(x * y, p * q, s)
        assert contains(2 - x * 3, 2 - p * 3, s)
        assert abs(p) * ONE <= x.most
    assert len((x * y).terms) == max(len(a), len(b))


@given(functions(first=(6 * ONE, 20 * ONE), most=5 * ONE))
def test_an_inverse_contains_the_true_one(one):
    x, a = one
    try:
        inverse = 2 / x
    except Rejected:
        return
    assert all(contains(inverse, 2 / value(a, s), s) for s in TIMES)


def test_an_inverse_is_as_wide_as_that_of_the_smallest_number():
    """1/6 ± 5 units: 1/(6 - 5) is in it."""
    assert contains(1 / Model([6 * ONE], 5 * ONE, BITS), Fraction(1), 0)


def test_a_function_with_a_root_is_not_divided_by():
    for terms in ([-ONE, 2 * ONE], [0, ONE], [ONE, -ONE]):
        with pytest.raises(Rejected, match="differ from 0"):
            1 / Model(terms, 0, BITS)


@given(functions(), st.integers(1, 6), st.integers(4, BITS))
def test_integrals_values_and_coarser_functions_contain_the_true_ones(one, terms, bits):
    x, a = one
    for s in TIMES:
        assert contains(x.integral(), value([Fraction(0), *(c / (k + 1) for k, c in enumerate(a))], s), s)
        at = x.at(Interval.enclosing(s, s, BITS))
        assert at.lo <= value(a, s) * ONE <= at.hi
        less = x.coarser(terms, bits)
        rough = value([Fraction(c, 2**bits) for c in less.terms], s)
        assert abs(rough - value(a, s)) * 2**bits <= less.off
    assert len(less.terms) <= terms


@given(st.fractions(-5, 5))
def test_a_number_is_enclosed(x):
    assert contains(Model.constant(x, BITS), x, Fraction(1, 2))


@given(*[st.fractions(1, 4, max_denominator=9)] * 3)
def test_derivatives_are_those_of_the_rules(x, y, slope):
    """d/dx of (2 - xy)/(y + x) · x - x, by hand."""

    def function(at):
        a, b = at
        return [(2 - a * b) * (1 / (b + a)) * a - a]

    (found,) = derivative(function, [x, y], [slope, Fraction(0)])
    top, bottom = 2 * x - x * x * y, x + y
    assert found == slope * ((2 - 2 * x * y) / bottom - top / bottom**2 - 1)
    assert (1 - Dual(x, slope)).slope == -slope


def test_the_shorter_of_two_is_padded():
    x, y = Model([1 * ONE, 2 * ONE, 3 * ONE], 0, BITS), Model([5 * ONE, 7 * ONE], 0, BITS)
    product = [5, 17, 29, 21]
    for found in (x * y, y * x):
        assert found.terms == [x * ONE for x in product[:3]]
        assert 21 * ONE <= found.off <= 21 * ONE + 3
    assert (x + y).terms == [a + b for a, b in zip_longest(x.terms, y.terms, fillvalue=0)]
