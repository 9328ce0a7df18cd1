"""Double-double: its operations within their proved bounds, and the numbers of the loops, which choose among them."""

from fractions import Fraction as F
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, target
from hypothesis import strategies as st

from chapsym import generated
from chapsym.numbers import Digits, DoubleDouble, Pair, loose, named, pairs
from chapsym.numbers.loose import Loose, Normal, square_root

U = F(1, 2**53)
#: Mantissas with many or few bits, and exponents that neither overflow nor underflow in a product's error.
floats = st.builds(
    lambda bits, exponent, sign: sign * float(bits) * 2.0**exponent,
    st.integers(2**52, 2**53 - 1) | st.integers(1, 8) | st.sampled_from([2**53 - 1, 2**52 + 1, 2**27 + 1]),
    st.integers(-160, 160) | st.integers(-56, -50),
    st.sampled_from([1.0, -1.0]),
)
#: Low halves of every size up to half an ulp of the high one.
pair = st.builds(
    lambda high, part, shift: pairs.two_sum(high, high * part * 2.0 ** -(53 + shift)),
    floats, st.floats(-1, 1).filter(lambda x: abs(x) > 1e-3) | st.sampled_from([0.0, 0.5, -0.5, 1.0]),
    st.integers(0, 60) | st.just(0),
)  # fmt: skip


def exact(x):
    return F(x[0]) + F(x[1])


def within(found, truth, bound, what):
    """The error, in units of u² of the truth, is at most the bound; Hypothesis looks for the worst."""
    if truth == 0:
        assert exact(found) == 0
        return
    error = abs(exact(found) / truth - 1) / U**2
    target(float(error), label=what)
    assert error <= bound
    assert found[0] == float(exact(found)), "normalised"


@given(floats, floats)
def test_sums_and_products_are_exact(a, b):
    assert exact(pairs.two_sum(a, b)) == F(a) + F(b)
    assert exact(pairs.two_product(a, b)) == F(a) * F(b)
    big, small = (a, b) if abs(a) >= abs(b) else (b, a)
    assert exact(pairs.quick_two_sum(big, small)) == F(a) + F(b)


@given(pair, pair)
def test_sums_products_and_quotients(x, y):
    """Of sums that cancel, of the nearest neighbours of -x, the bound is relative to what is left."""
    near = pairs.two_sum(-x[0], -x[1] * (1 + 2.0**-40))
    within(pairs.add(*x, *y), exact(x) + exact(y), 3 + 13 * U, "add")
    within(pairs.add(*x, *near), exact(x) + exact(near), 3 + 13 * U, "cancel")
    within(pairs.subtract(*x, *y), exact(x) - exact(y), 3 + 13 * U, "subtract")
    within(pairs.multiply(*x, *y), exact(x) * exact(y), 5, "multiply")
    within(pairs.multiply_float(*x, y[0]), exact(x) * F(y[0]), F(3, 2) + 4 * U, "multiply_float")
    within(pairs.divide(*x, *y), exact(x) / exact(y), 15 + 56 * U, "divide")


@given(pair)
def test_roots(x):
    """Of x², bracketed: (1 ± bound)²x contains the square of the root."""
    x = x if x[0] > 0 else (-x[0], -x[1])
    found, bound = pairs.root(*x), F(25, 8) * U**2
    assert (1 - bound) ** 2 * exact(x) <= exact(found) ** 2 <= (1 + bound) ** 2 * exact(x)
    assert pairs.root(0.0, 0.0) == (0.0, 0.0)


@given(pair, pair)
def test_loose_operations_err_by_some_u2_of_the_terms(x, y):
    """Their own roundings: two of the low half of a sum, four of that of a product and the a_·b_ that is left out."""
    a, b = exact(x), exact(y)
    terms = abs(a) + abs(b)
    for found, truth in [
        (pairs.loose_add(*x, *y), a + b),
        (pairs.loose_subtract(*x, *y), a - b),
        (pairs.loose_add_float(*x, y[0]), a + F(y[0])),
    ]:
        assert abs(exact(found) - truth) <= F(7, 2) * U**2 * terms
    assert abs(exact(pairs.loose_multiply(*x, *y)) - a * b) <= 8 * U**2 * abs(a * b)
    assert abs(exact(pairs.loose_multiply_float(*x, y[0])) - a * F(y[0])) <= 4 * U**2 * abs(a * F(y[0]))


@given(pair, pair, st.integers(-9, 9))
def test_the_class_does_the_same(x, y, n):
    a, b = Pair(*x), Pair(*y)
    for found, expected in [
        (a + b, pairs.add(*x, *y)), (a - b, pairs.subtract(*x, *y)), (a * b, pairs.multiply(*x, *y)),
        (a / b, pairs.divide(*x, *y)), (n * a, pairs.multiply(float(n), 0.0, *x)), (n - a, (-(a - n)).halves()),
        (1 / b, pairs.divide(1.0, 0.0, *y)), (abs(a), x if x[0] > 0 else (-x[0], -x[1])),
    ]:  # fmt: skip
        assert found.halves() == tuple(expected)
    assert ((a < b), (a == b)) == ((exact(x) < exact(y)), (exact(x) == exact(y)))
    assert {2, Pair(*x)} == {Pair(2.0), Pair(*x)}
    assert Pair(2.0) != "2"


@given(st.fractions(max_denominator=10**30).filter(lambda x: x == 0 or abs(x) > F(1, 10**40)))
def test_the_double_double_numbers(value):
    double_double = named("double-double")
    assert type(double_double) is DoubleDouble
    number = double_double.number(value)
    assert abs(number.exactly() - value) <= U**2 * abs(value)
    assert abs(F(double_double.write(number)) - number.exactly()) <= abs(value) * F(1, 10**31)
    squared = abs(number).sqrt().exactly() ** 2
    assert abs(squared - abs(number.exactly())) <= 7 * U**2 * abs(number.exactly())


def test_a_kernel_runs_on_pairs():
    """The residual at a rational point, where it does not cancel: no worse than u² by the operations of a product."""
    point = [F(3 + 2 * i, 7 + i) for i in range(14)]
    found = generated.residual(*map(Pair.of, point))
    for x, truth in zip(found, generated.residual(*point), strict=True):
        assert abs(x.exactly() - truth) <= 2000 * U**2
    assert Digits(32).write(Digits(32).number(found[0].exactly())) == named("double-double").write(found[0])


# -- the numbers of the loops


U2 = 2.0**-106
numbers = st.fractions(F(-2), F(2), max_denominator=10**40).filter(lambda x: abs(x) > F(1, 10**6))


def of(x, kind=Loose):
    return kind(*Pair.of(x).halves())


def gap(found, control):
    """The largest difference between loose pairs and Pairs, in units of u²."""
    return max(abs(float(F(a.high) + F(a.low) - x.exactly())) for a, x in zip(found, control, strict=True)) / U2


@given(st.lists(numbers, min_size=6, max_size=6), st.lists(st.floats(-2, 2), min_size=3, max_size=3))
def test_the_residual_against_the_kernel_on_pairs(values, u):
    """Products of up to five factors in [-2, 2]: the terms add up to 200 at most, and each errs by some u²."""
    I, D = (F(1, 3), F(2, 3), F(5, 7)), 0.7
    found = generated.gibbs_residual(*map(Loose, u), *map(of, (*values, *I)), Loose(D))
    control = generated.gibbs_residual(*map(Pair, u), *map(Pair.of, (*values, *I)), Pair(D))
    assert gap(found, control) <= 2000


def test_the_form_follows_from_the_operands(monkeypatch):
    """A float with a pair saves half of the work; a divisor is normalised, and each sum of `Normal`."""
    called = []

    def seen(name):
        honest = getattr(pairs, name)
        return lambda *a: called.append(name) or honest(*a)

    names = (
        "two_sum", "two_product", "loose_add", "loose_add_float", "loose_multiply", "loose_multiply_float", "divide",
        "loose_subtract",
    )  # fmt: skip
    monkeypatch.setattr(loose, "pairs", SimpleNamespace(**{name: seen(name) for name in names}))
    x, y, a = Loose(0.3, 1e-18), Loose(0.7, -1e-18), Loose(0.1)
    for what, expected in (
        (lambda: a * a, ["two_product"]), (lambda: a - 3, ["two_sum"]), (lambda: x * a, ["loose_multiply_float"]),
        (lambda: a + x, ["loose_add_float"]), (lambda: 0.5 * x, ["loose_multiply_float"]), (lambda: 2 * x / 2, []),
        (lambda: 1 * x, []), (lambda: x - y, ["loose_subtract"]), (lambda: x * y, ["loose_multiply"]),
        (lambda: 1 / x, ["two_sum", "divide"]), (lambda: Normal(x.high, x.low) * y, ["loose_multiply"]),
        (lambda: y - Normal(x.high, x.low), ["loose_subtract", "two_sum"]),
    ):  # fmt: skip
        called.clear()
        what()
        assert called == expected


def test_halves_may_be_arrays():
    """Of a column each number has the bits that it has alone, whichever side the array is on."""
    x, y, factor = np.array([0.3, -0.7, 1.1]), np.array([1e-18, 2e-17, -1e-17]), np.array([0.1, 0.2, 0.3])
    for of in (lambda f, p: f * p, lambda f, p: p - f, lambda f, p: f - p, lambda f, p: f / p):
        together = of(factor, Loose(x, y))
        for i in range(3):
            alone = of(float(factor[i]), Loose(float(x[i]), float(y[i])))
            assert (together.high[i], together.low[i]) == (alone.high, alone.low)


@given(numbers, numbers)
def test_each_operation_is_right(x, y):
    a, b = of(x), of(y)
    exact = {"+": x + y, "-": x - y, "*": x * y, "/": x / y, "neg": -x, "2": 2 * x, "half": x / 2, "1 -": 1 - x}
    found = {"+": a + b, "-": a - b, "*": a * b, "/": a / b, "neg": -a, "2": 2 * a, "half": a / 2, "1 -": 1 - a}
    for name, value in exact.items():
        size = max(abs(x), abs(y), abs(x * y), abs(x / y), 1 if name == "1 -" else 0)
        assert abs(F(found[name].high) + F(found[name].low) - value) <= 40 * U2 * size
    assert square_root(a * a).high == pytest.approx(abs(float(x)), rel=1e-15)
