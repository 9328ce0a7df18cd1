"""The roundings of a kernel, counted on its text, bound what any rounding of its operations makes of it."""

import random
from fractions import Fraction as F
from math import inf

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


class Off:
    """A number each of whose operations is off by a part of it, at random or up."""

    part = F(1, 2**40)

    def __init__(self, value, sign):
        self.value, self.sign = F(value), sign

    def _made(self, value):
        return Off(value * (1 + self.part * self.sign()), self.sign)

    @staticmethod
    def _of(other):
        return other.value if isinstance(other, Off) else F(other)

    def __add__(self, other):
        return self._made(self.value + self._of(other))

    def __sub__(self, other):
        return self._made(self.value - self._of(other))

    def __rsub__(self, other):
        return self._made(self._of(other) - self.value)

    def __mul__(self, other):
        exact = self._of(other) in (2, 4) and not isinstance(other, Off)
        return Off(self.value * self._of(other), self.sign) if exact else self._made(self.value * self._of(other))

    def __truediv__(self, other):
        exact = self._of(other) in (2, 4) and not isinstance(other, Off)
        return Off(self.value / self._of(other), self.sign) if exact else self._made(self.value / self._of(other))

    def __rtruediv__(self, other):
        return self._made(self._of(other) / self.value)

    def __neg__(self):
        return Off(-self.value, self.sign)

    __radd__, __rmul__ = __add__, __mul__


@pytest.mark.parametrize("kernel", KERNELS, ids=lambda kernel: kernel.name)
def test_no_rounding_is_beyond_the_count(kernel):
    """Of operations that are off by 2⁻⁴⁰, up, down or at random: below n 2⁻⁴⁰ of the terms, and not far."""
    function, rng, most = getattr(kernels, kernel.name), random.Random(7), 0.0
    for i in range(15):
        sizes = rng.sample(range(1, 101), len(kernel.inputs))
        given = [  # moments are positive
            F(x, 101) if name.name[0] in "DIJL" else F(x * rng.choice((-1, 1)), 101)
            for x, name in zip(sizes, kernel.inputs, strict=True)
        ]
        sign = [lambda: 1, lambda: -1, lambda: rng.choice((-1, 1))][i % 3]
        counted = function(*numbers(*given))
        moved = function(*(Off(x, sign) for x in given))
        pairs = zip(*(x if isinstance(x, tuple) else (x,) for x in (counted, moved)), strict=True)
        for one, other in pairs:
            one, other = (x if isinstance(x, Rounded | Off) else Off(x, sign) for x in (one, other))
            if isinstance(one, Off):  # a number of the text
                continue
            if one.steep >= F(1, 2**10) and one.terms:
                off = abs(other.value - one.value) / (Off.part * one.terms)
                assert off <= one.count * MOST
                most = max(most, float(off / max(one.count, 1)))
    assert most > 0.15, kernel.name


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
