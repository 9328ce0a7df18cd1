"""The arithmetic of the checker against exact numbers: what is true is never left out, and little more is let in."""

import operator
from fractions import Fraction
from itertools import combinations_with_replacement, product, zip_longest

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from chapsym.checker.interval import Interval, Rejected
from chapsym.checker.linear import newton, solve
from chapsym.checker.taylor import Dual, Model, derivatives

BITS = 12
ends = st.integers(-(2**20), 2**20)


@st.composite
def intervals(draw, bits=BITS, ends=ends):
    lo, hi = sorted((draw(ends), draw(ends)))
    return Interval(lo, hi if draw(st.booleans()) else lo, bits)


@st.composite
def with_points(draw):
    """An interval and a rational number in it, often an end."""
    x = draw(intervals())
    share = draw(st.sampled_from([Fraction(0), Fraction(1), Fraction(1, 3)]))
    return x, (x.lo + share * (x.hi - x.lo)) / 2**BITS


def contains(x, number):
    return x.lo <= number * 2**x.bits <= x.hi


@given(with_points(), st.integers(-50, 50))
def test_integers_are_exact_on_both_sides(pair, n):
    x, a = pair
    assert contains(x + n, a + n)
    assert contains(n + x, a + n)
    assert contains(n - x, n - a)
    assert contains(x - n, a - n)
    assert contains(n * x, a * n)
    if x.sign:
        assert contains(n / x, n / a)


def hull(numbers):
    """The ends that outward rounding gives to the exact hull."""
    scaled = [n * 2**BITS for n in numbers]
    return min(scaled).__floor__(), max(scaled).__ceil__()


def is_least(x, y, operation):
    """Whether the operation gives the least interval that contains all results."""
    corners = [(Fraction(a, 2**BITS), Fraction(b, 2**BITS)) for a in (x.lo, x.hi) for b in (y.lo, y.hi)]
    found = operation(x, y)
    return (found.lo, found.hi) == hull([operation(a, b) for a, b in corners])


@given(intervals(), intervals(), st.sampled_from([operator.add, operator.sub, operator.mul, operator.truediv]))
def test_an_operation_gives_the_least_interval_that_contains_all_results(x, y, operation):
    assume(operation is not operator.truediv or y.sign)
    assert is_least(x, y, operation)
    assert ((-x).lo, (-x).hi) == (-x.hi, -x.lo)


def test_so_do_products_and_quotients_with_all_signs_of_the_ends():
    pairs = list(combinations_with_replacement(range(-3, 4), 2))
    for x, y in product([Interval(*ends, BITS) for ends in pairs], repeat=2):
        assert is_least(x, y, operator.mul)
        assert not y.sign or is_least(x, y, operator.truediv)


@given(intervals(ends=st.integers(1, 2**20)))
def test_a_root_is_the_tightest(x):
    root = x.sqrt()
    assert root.lo**2 <= x.lo << BITS < (root.lo + 1) ** 2
    assert (root.hi - 1) ** 2 < x.hi << BITS <= root.hi**2


@given(st.fractions(), st.fractions())
def test_a_rational_number_is_enclosed_as_closely_as_can_be(a, b):
    x = Interval.enclosing(min(a, b), max(a, b), BITS)
    assert (x.lo, x.hi) == hull([a, b])


@given(with_points(), with_points())
def test_an_order_or_a_sign_is_never_claimed_wrongly(first, second):
    (x, a), (y, b) = first, second
    assert not x < y or a < b
    assert not x > y or a > b
    assert x.sign in (0, (a > 0) - (a < 0))


@given(with_points(), st.integers(0, 4))
def test_what_rounds_to_a_decimal_is_less_than_half_a_unit_from_it(pair, digits):
    x, a = pair
    number = Fraction(round(a * 10**digits), 10**digits)
    if x.rounds_to(number, digits):
        assert abs(a - number) < Fraction(1, 2 * 10**digits)
        assert not x.rounds_to(number + Fraction(1, 10**digits), digits)


def test_a_tie_rounds_to_neither_side_and_the_interior_is_without_the_ends():
    half = Interval(1 << (BITS - 1), 1 << (BITS - 1), BITS)
    assert not half.rounds_to(Fraction(0), 0)
    assert not half.rounds_to(Fraction(1), 0)
    x = Interval(0, 4, BITS)
    assert Interval(1, 3, BITS).inside(x)
    assert not any(Interval(*ends, BITS).inside(x) for ends in ((0, 4), (0, 3), (1, 4), (-1, 3)))


@given(st.lists(st.integers(-(2**14), 2**14), min_size=12, max_size=12), st.integers(0, 40))
def test_the_solution_of_every_system_in_the_intervals_is_enclosed(numbers, width):
    a, b = numbers[:9], numbers[9:]
    columns = [a[:3], a[3:6], a[6:]]
    det = _det(columns)
    assume(det)
    try:
        found = solve([[Interval(c[i] - width, c[i] + width, BITS) for c in columns] for i in range(3)],
                      [[Interval(x, x, BITS)] for x in b])  # fmt: skip
    except Rejected:
        return
    for i, (x,) in enumerate(found):
        assert contains(x, Fraction(_det([b if i == j else c for j, c in enumerate(columns)]), det))


def _det(c):
    return sum(c[0][i] * (c[1][i - 2] * c[2][i - 1] - c[1][i - 1] * c[2][i - 2]) for i in range(3))


@pytest.mark.parametrize("ends", [(0, 1), (-1, 0), (0, 0), (-1, 1)])
def test_what_may_be_zero_is_neither_divided_by_nor_under_a_root(ends):
    x = Interval(*ends, BITS)
    with pytest.raises(Rejected, match="differ from 0"):
        1 / x
    with pytest.raises(Rejected, match="positive"):
        x.sqrt()


@pytest.mark.parametrize("bits", [60, 600])
def test_newtons_test_encloses_the_root_of_two_to_the_last_bits(bits):
    """From 4 decimals; a derivative at the middle only would give boxes that are narrower than their error."""
    centre = Interval.enclosing(Fraction("1.4142"), Fraction("1.4142"), bits).point()
    (x,) = newton(lambda v: [v[0] * v[0] - 2], lambda v: [[2 * v[0]]], [centre])
    assert x.lo**2 < 2 << (2 * bits) < x.hi**2
    assert x.width < 16


def test_newtons_test_refuses_a_box_that_the_root_may_have_left():
    """f(0) = 1 with f′(0) = 4 says -1/4, but a slope of 1 elsewhere may put the root at -1, outside the box tried."""
    one, zero = 1 << 60, Interval(0, 0, 60)
    with pytest.raises(Rejected, match="Newton"):
        newton(lambda v: [zero + 1], lambda v: [[Interval(one if v[0].width else 4 * one, 4 * one, 60)]], [zero])


def test_newtons_test_refuses_a_double_root_and_none_and_a_matrix_may_not_be_singular():
    with pytest.raises(Rejected):
        newton(lambda v: [v[0] * v[0]], lambda v: [[2 * v[0]]], [Interval(5, 5, 60)])
    with pytest.raises(Rejected):
        newton(lambda v: [v[0] * v[0] + 1], lambda v: [[2 * v[0]]], [Interval(1 << 58, 1 << 58, 60)])
    one, wide = Interval(1 << BITS, 1 << BITS, BITS), Interval(0, 2 << BITS, BITS)
    with pytest.raises(Rejected, match="may be singular"):
        solve([[one, one], [one, wide]], [[one], [one]])


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


def holds(model, true, s):
    return abs(value([Fraction(x, ONE) for x in model.terms], s) - true) * ONE <= model.off


@given(functions(), functions())
def test_sums_and_products_contain_the_true_ones(first, second):
    (x, a), (y, b) = first, second
    for s in TIMES:
        p, q = value(a, s), value(b, s)
        assert holds(x + y, p + q, s)
        assert holds(x - y, p - q, s)
        assert holds(x * y, p * q, s)
        assert holds(2 - x * 3, 2 - p * 3, s)
        assert abs(p) * ONE <= x.most
    assert len((x * y).terms) == max(len(a), len(b))


@given(functions(first=(6 * ONE, 20 * ONE), most=5 * ONE))
def test_an_inverse_contains_the_true_one(one):
    x, a = one
    try:
        inverse = 2 / x
    except Rejected:
        return
    assert all(holds(inverse, 2 / value(a, s), s) for s in TIMES)


def test_a_function_with_a_root_is_not_divided_by_and_an_inverse_is_as_wide_as_that_of_the_smallest():
    for terms in ([-ONE, 2 * ONE], [0, ONE], [ONE, -ONE]):
        with pytest.raises(Rejected, match="differ from 0"):
            1 / Model(terms, 0, BITS)
    assert holds(1 / Model([6 * ONE], 5 * ONE, BITS), Fraction(1), 0)


@given(functions(), st.integers(1, 6), st.integers(4, BITS))
def test_integrals_values_and_coarser_functions_contain_the_true_ones(one, terms, bits):
    x, a = one
    for s in TIMES:
        assert holds(x.integral(), value([Fraction(0), *(c / (k + 1) for k, c in enumerate(a))], s), s)
        at = x.at(Interval.enclosing(s, s, BITS))
        assert at.lo <= value(a, s) * ONE <= at.hi
        less = x.coarser(terms, bits)
        rough = value([Fraction(c, 2**bits) for c in less.terms], s)
        assert abs(rough - value(a, s)) * 2**bits <= less.off
    assert len(less.terms) <= terms


@given(st.fractions(-5, 5))
def test_a_number_is_enclosed(x):
    assert holds(Model.constant(x, BITS), x, Fraction(1, 2))


@given(*[st.fractions(1, 4, max_denominator=9)] * 3)
def test_derivatives_are_those_of_the_rules(x, y, slope):
    """d/dx of (2 - xy)/(y + x) · x - x, by hand."""

    def function(at):
        a, b = at
        return [(2 - a * b) * (1 / (b + a)) * a - a]

    (found,) = derivatives(function, [x, y], [[slope, Fraction(0)], [Fraction(0), slope]])
    top, bottom = 2 * x - x * x * y, x + y
    assert found.value == function([x, y])[0]
    assert found.slopes == [
        slope * ((2 - 2 * x * y) / bottom - top / bottom**2 - 1),
        slope * (-x * x / bottom - top / bottom**2),
    ]
    assert (1 - Dual(x, [slope])).slopes == [-slope]


def test_the_shorter_of_two_is_padded():
    x, y = Model([1 * ONE, 2 * ONE, 3 * ONE], 0, BITS), Model([5 * ONE, 7 * ONE], 0, BITS)
    product = [5, 17, 29, 21]
    for found in (x * y, y * x):
        assert found.terms == [x * ONE for x in product[:3]]
        assert 21 * ONE <= found.off <= 21 * ONE + 3
    assert (x + y).terms == [a + b for a, b in zip_longest(x.terms, y.terms, fillvalue=0)]
