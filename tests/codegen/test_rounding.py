"""The roundings of a kernel, counted on its text, bound what any rounding of its operations makes of it."""

import random
from fractions import Fraction as F
from math import inf

import numpy as np
import pytest

import chapsym.generated as kernels
from chapsym.codegen.rounding import DIVISOR, MOST, Rounded, bounds, count
from chapsym.proofs.kernels import KERNELS


def numbers(*values):
    return [Rounded(F(x), abs(F(x))) for x in values]


@pytest.mark.parametrize(("formula", "count", "terms"), [
    (lambda a, b, c: a * b, 1, 15), (lambda a, b, c: a * b * c, 2, 105), (lambda a, b, c: a + b + c, 2, 15),
    (lambda a, b, c: 2 * a, 0, 6), (lambda a, b, c: 3 * a, 1, 9), (lambda a, b, c: a / 4, 0, F(3, 4)),
    (lambda a, b, c: 1 / a, 1, F(1, 3)), (lambda a, b, c: 1 - a, 1, 4), (lambda a, b, c: -a, 0, 3),
    (lambda a, b, c: a * b - (a * c + b * c), 3, 15 + 21 + 35), (lambda a, b, c: (a + b) / (b - c), 3, F(8 * 12, 4)),
    (lambda a, b, c: (a * b) / (a * b), 3, 1), (lambda a, b, c: a * (b / 2), 1, F(15, 2)),
])  # fmt: skip
def test_what_is_counted(formula, count, terms):
    found = formula(*numbers(3, 5, 7))
    assert (found.count, found.terms) == (count, terms)
    assert found.value == formula(F(3), F(5), F(7))


@pytest.mark.parametrize("kernel", KERNELS, ids=lambda kernel: kernel.name)
def test_no_rounding_is_beyond_the_count(kernel):
    """In float32, of numbers that it has."""
    function, rng = getattr(kernels, kernel.name), random.Random(7)
    for _ in range(15):
        given = [  # moments are positive
            F(rng.randint(1, 128), 128) * (1 if name.name[0] in "DIJL" else rng.choice((-1, 1)))
            for name in kernel.inputs
        ]
        counted, found = function(*numbers(*given)), function(*(np.float32(x) for x in given))
        for one, x in zip(*(x if isinstance(x, tuple) else (x,) for x in (counted, found)), strict=True):
            if isinstance(one, Rounded) and one.steep >= F(1, 2**10):
                assert abs(F(float(x)) - one.value) <= one.count * MOST * F(1, 2**24) * one.terms


def test_the_bounds_of_a_kernel_contain_its_errors():
    rng = random.Random(5)
    for _ in range(50):
        given = [rng.uniform(-1, 1) for _ in range(9)] + [rng.uniform(0.1, 1) for _ in range(4)]
        exact, found = kernels.gibbs_newton_heavy(*map(F, given)), kernels.gibbs_newton_heavy(*given)
        for bound, x, y in zip(bounds(kernels.gibbs_newton_heavy, *given), exact, found, strict=True):
            assert abs(F(y) - x) <= F(bound)
            assert bound < 1e-12


def test_a_divisor_that_cancels_has_no_bound():
    def quotient(a, b):
        return 1 / (a - b), a

    assert bounds(quotient, 1.0, 1.0 - 2.0**-26) == [inf, 0.0]
    assert bounds(quotient, 1.0, 0.5)[0] < inf
    assert bounds(quotient, 1.0, 1.0) == [inf, 0.0]
    assert float(DIVISOR) == 2.0**-25


def test_a_number_of_more_bits_than_float64_is_rounded_too():
    def product(x):
        return (2**53 + 3) * x

    for x in (1.0 + 2.0**-52, 1.3, 1.7, 1.9):
        assert abs(F(product(x)) - product(F(x))) <= F(bounds(product, x)[0])
    assert Rounded(F(1, 3), F(1, 3)).__mul__(2**53 + 1).count == 2


@pytest.mark.parametrize(("formula", "x"), [
    (lambda x: x * x, 1e200), (lambda x: x * x, 1e-200), (lambda x: x + x, 1.7e308), (lambda x: x / 2, 5e-324),
    (lambda x: 1 / x, 1e308), (lambda x: 10**400 * x, 1.0), (lambda x: sum([x * x] * 257), 0.3),
    (lambda x: 1 / x + 1, 0.0), (lambda x: 0 / x + 1 / (x - x), 0.0),
])  # fmt: skip
def test_what_the_lemma_is_not_of_has_no_bound(formula, x):
    assert bounds(formula, x) == [inf]


def test_an_argument_that_is_not_finite_is_refused():
    with pytest.raises(ValueError, match="an argument is nan; bounds are of finite numbers"):
        bounds(lambda x: x, float("nan"))


def test_a_kernel_of_more_roundings_than_the_lemma_has_no_count():
    assert count(KERNELS[0], lambda *x: sum([x[0]] * 256), [F(1, 3)]) == 256  # the first sum is with 0
    assert count(KERNELS[0], lambda *x: sum([x[0]] * 257), [F(1, 3)]) is None
