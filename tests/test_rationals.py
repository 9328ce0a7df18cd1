"""Numbers typed by a user."""

from decimal import Decimal
from fractions import Fraction

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from chapsym.rationals import NotANumber, exact_fraction, mass_tensor_from, rational, rationals


@given(st.fractions())
def test_every_fraction_is_read_back(value):
    assert rational(str(value), "x") == value


@pytest.mark.parametrize(
    ("text", "value"), [("1e-3", Fraction(1, 1000)), (" .5 ", Fraction(1, 2)), ("-2.", Fraction(-2))]
)
def test_decimals_are_exact(text, value):
    assert rational(text, "x") == value


@given(st.text())
def test_any_other_text_is_refused_in_one_sentence(text):
    try:
        rational(text, "x")
    except NotANumber as error:
        assert "\n" not in str(error)  # noqa: PT017
        assert str(error).startswith("x: ")  # noqa: PT017


def test_the_count_is_checked_and_the_mass_tensor_is_exact():
    with pytest.raises(NotANumber, match="--gamma takes 3 numbers"):
        rationals("1,2", "--gamma", 3)
    assert mass_tensor_from((Fraction(6), Fraction(5), Fraction(3))) == (1, 2, 4)


@pytest.mark.parametrize("made", [mpmath.mpf, Decimal, float])
@pytest.mark.parametrize("text", ["inf", "-inf", "nan"])
def test_what_is_not_finite_is_no_fraction(made, text):
    with pytest.raises((ValueError, OverflowError)):
        exact_fraction(made(text))


@pytest.mark.parametrize("made", [mpmath.mpf, Decimal])
@pytest.mark.parametrize("text", ["1e999999999", "-1e-999999999"])
def test_an_exponent_that_fills_the_memory_is_refused(made, text):
    with pytest.raises(OverflowError, match="an exponent is"):
        exact_fraction(made(text))
    assert exact_fraction(made("-0.5")) == Fraction(-1, 2)
    assert exact_fraction(made("0")) == 0
