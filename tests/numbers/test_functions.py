"""sin, cos, sqrt and π in every type of numbers, against mpmath."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from chapsym import Digits, Enclosure
from chapsym.numbers import NAMED, Pair
from chapsym.numbers import functions as of

FUNCTIONS = ("sin", "cos", "sqrt")
PAIRS = NAMED["double-double"]
EXACT = mpmath.MPContext()
EXACT.dps = 80


def exact(x):
    """A number, as one of 80 digits."""
    if isinstance(x, Pair):
        return EXACT.mpf(x.high) + EXACT.mpf(x.low)
    return EXACT.mpf(float(x)) if isinstance(x, np.generic | float) else EXACT.mpf(x)


def worst(name, xs, unit):
    """The largest error in roundings of the result; below the normal numbers none is relative."""
    found = zip(xs, getattr(of, name)(xs) if isinstance(xs, np.ndarray) else map(getattr(of, name), xs), strict=True)
    truths = [(exact(y), getattr(EXACT, name)(exact(x))) for x, y in found]
    return max(abs(y - true) / (abs(true) * unit) for y, true in truths if abs(true) > 1e-30)


RANDOM = np.random.default_rng(7)
SPREAD = np.concatenate([10.0 ** RANDOM.uniform(-6, 5, 600), RANDOM.uniform(0, 7, 600)])


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_roundings_are_as_stated(name):
    """In units 2⁻⁵³, 2⁻²⁴, 2⁻¹⁰⁶: those of the table in the module."""
    most = {"sqrt": (1, 1, 1, 4), "sin": (2, 2, 4, 2), "cos": (2, 2, 4, 2)}[name]
    pairs = [PAIRS.number(Fraction(x) + Fraction(i, 3 << 60)) for i, x in enumerate(SPREAD[::8])]
    given = [(list(map(float, SPREAD)), 53), (SPREAD, 53), (SPREAD.astype(np.float32), 24), (pairs, 106)]
    for (xs, bits), limit in zip(given, most, strict=True):
        assert worst(name, xs, EXACT.mpf(2) ** -bits) <= limit, bits


@given(st.fractions(0, 10**5), st.integers(20, 60))
def test_digits_and_enclosures_agree(x, count):
    digits, balls = Digits(count), Enclosure(64)
    for name in FUNCTIONS:
        many = getattr(of, name)(digits.number(x))
        true = getattr(EXACT, name)(EXACT.mpf(x.numerator) / x.denominator)
        assert abs(exact(many) - true) <= EXACT.mpf(10) ** (6 - count) * max(abs(true), EXACT.mpf(10) ** -10)
        with balls.working():
            ball = getattr(of, name)(balls.number(x))
            assert ball.rad() < 1e-12
            assert abs(EXACT.mpf(ball.str(40, radius=False)) - true) <= 1e-25


def test_pi_and_functions_of_whole_numbers_are_in_the_numbers_of_another():
    digits, balls = Digits(40), Enclosure(100)
    floats = [(0.5, 53), (np.array([0.5]), 53), (np.array([0.5], np.float32), 24)]
    for one, bits in (*floats, (PAIRS.number(Fraction(1, 2)), 106)):
        for made, true in ((of.pi(one), EXACT.pi), (of.sin(3, one), EXACT.sin(3)), (of.sqrt(2, one), EXACT.sqrt(2))):
            value = made[0] if isinstance(made, np.ndarray) else made
            assert abs(exact(value) - true) <= EXACT.mpf(2) ** (1 - bits) * true * 2
            assert isinstance(value, Pair | float | np.float32)
    assert abs(exact(of.pi(digits.number(Fraction(1)))) - EXACT.pi) < EXACT.mpf(10) ** -50
    with balls.working():
        assert of.pi(balls.number(Fraction(1))).overlaps(type(balls.number(Fraction(0))).pi())
        assert of.cos(1, balls.number(Fraction(1))).rad() < 1e-30
    objects = np.array([PAIRS.number(Fraction(1)), 0.5], dtype=object)
    assert [type(x) for x in of.pi(objects)] == [Pair, float]
    assert [type(x) for x in of.sin(objects)] == [Pair, float]
    assert of.pi(np.float32(1)).dtype == of.sin(np.float32(1)).dtype == np.float32


def test_a_whole_number_among_others_is_one_of_these():
    digits, balls, pair = Digits(40), Enclosure(100), PAIRS.number(Fraction(1, 3))
    many = digits.number(Fraction(1, 3))
    assert type(of.sin(1, 2, pair)) is type(of.pi(0.5, pair)) is Pair
    assert abs(exact(of.sin(1, 0.25, many)) - EXACT.sin(1)) < EXACT.mpf(10) ** -50
    with balls.working():
        ball = balls.number(Fraction(1))
        for found, true in (
            (of.sin(1, 0.5, ball), EXACT.sin(1)),
            (of.pi(0.5, ball), EXACT.pi),
            (of.cos(2.0, ball), EXACT.cos(2)),
        ):
            assert abs(EXACT.mpf(found.str(40, radius=False)) - true) < 1e-28
    assert of.sin(np.array([3], np.int8)).dtype == of.pi(np.array([3], np.int8)).dtype == np.float64
    assert of.sin(np.float32(1), np.array([1.0])).dtype == np.float64
    assert of.sin(3, np.inf) == np.sin(3.0)
    assert np.isnan(of.sin(Pair(np.nan)).high)
    objects = of.sin(np.array([1, 2]), np.array([pair, pair], dtype=object))
    assert [type(x) for x in objects] == [Pair, Pair]


def test_what_has_no_such_function_and_the_root_below_0_are_refused():
    for function in (of.sin, of.cos, of.sqrt, of.pi):
        with pytest.raises(TypeError, match="a Fraction has no"):
            function(Fraction(1, 2))
    with pytest.raises(ValueError, match=r"domain|nonnegative"):
        of.sqrt(-1.0)
