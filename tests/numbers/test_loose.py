"""The numbers of the loops in double-double: the kernels on them, against the class `Pair`, and the forms they take."""

from fractions import Fraction as F
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from chapsym import generated as kernels
from chapsym.numbers import Pair, loose, pairs
from chapsym.numbers.loose import Loose, Normal, square_root

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
    found = kernels.gibbs_residual(*map(Loose, u), *map(of, (*values, *I)), Loose(D))
    control = kernels.gibbs_residual(*map(Pair, u), *map(Pair.of, (*values, *I)), Pair(D))
    assert gap(found, control) <= 2000


@given(st.lists(numbers, min_size=9, max_size=9))
def test_turns_against_the_kernel_on_pairs(values):
    u, k, g = values[:3], values[3:6], values[6:]
    for v in (k, g):
        found = kernels.turn(1, *map(of, (*u, *v)))
        assert gap(found, kernels.turn(Pair(1.0), *map(Pair.of, (*u, *v)))) <= 400


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
    exact = {"+": x + y, "-": x - y, "*": x * y, "/": x / y, "neg": -x, "2": 2 * x, "half": x / 2}
    found = {"+": a + b, "-": a - b, "*": a * b, "/": a / b, "neg": -a, "2": 2 * a, "half": a / 2}
    for name, value in exact.items():
        size = max(abs(x), abs(y), abs(x * y), abs(x / y))
        assert abs(F(found[name].high) + F(found[name].low) - value) <= 40 * U2 * size
    assert square_root(a * a).high == pytest.approx(abs(float(x)), rel=1e-15)
