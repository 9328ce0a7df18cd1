"""Identities between rational functions of free parameters: what they decide, and what they refuse."""

from fractions import Fraction

import flint
import pytest
from hypothesis import given
from hypothesis import strategies as st

from chapsym.prove import Identity
from chapsym.prove.polynomials import Ratio, TooLarge, parameters

X, Y = parameters("x y")


def value(ratio, *point):
    """A rational function at rational numbers, as a Fraction; None where it is not defined."""
    exact = [flint.fmpq(x.numerator, x.denominator) for x in map(Fraction, point)]
    below = ratio.denominator(*exact)
    if below == 0:
        return None
    quotient = ratio.numerator(*exact) / below
    return Fraction(int(quotient.p), int(quotient.q))


@pytest.mark.parametrize(
    ("left", "right", "holds"),
    [
        ([1 / X - 1 / Y], [(Y - X) / (X * Y)], True),
        ([1 / X + 1 / Y], [(Y - X) / (X * Y)], False),
        ([(X - Y) ** 2], [X**2 - 2 * X * Y + Y**2], True),
        ([(X - Y) ** 2], [X**2 + 2 * X * Y + Y**2], False),
        ([X, Y], [X, Y], True),
        ([X, Y], [X, X], False),
        ([X - X, 1], [0, Y / Y], True),
        ([X], [X**2], False),  # but at 0 and 1
        ([X**5], [X], False),  # but modulo 5
    ],
)
def test_an_identity_of_rational_functions_is_decided(left, right, holds):
    assert Identity("e", left, right).holds() == holds


def test_a_zero_denominator_is_refused():
    for below in (X - X, (X + Y) ** 2 - X**2 - 2 * X * Y - Y**2, 0 * X):
        with pytest.raises(ZeroDivisionError, match="polynomial 0"):
            1 / below
        with pytest.raises(ZeroDivisionError, match="polynomial 0"):
            Y / below
    with pytest.raises(ZeroDivisionError):
        X / 0
    with pytest.raises(ZeroDivisionError):
        Ratio(X.numerator, X.numerator * 0)


@pytest.mark.parametrize("number", [0.5, Fraction(1, 2), "1", None])
def test_only_integers_and_rational_functions_are_taken(number):
    with pytest.raises(TypeError):
        X + number
    with pytest.raises(TypeError):
        number * X


def test_an_expression_that_fills_the_memory_is_refused():
    dense = (1 + X + Y) ** 80
    with pytest.raises(TooLarge, match="3321 and 3321 terms"):
        dense * (dense + 1)
    assert len((dense * (1 + X)).numerator) == 3402


def test_sides_of_different_length_are_refused():
    with pytest.raises(ValueError, match="1 and 2 entries"):
        Identity("e", [X], [X, X])
    with pytest.raises(ValueError, match="0 and 0 entries"):
        Identity("e", [], [])


def test_the_lowest_terms_of_a_ratio_have_a_monic_denominator():
    ratio = ((X**2 - Y**2) / (2 * X + 2 * Y)).lowest()
    assert (str(ratio.numerator), str(ratio.denominator)) == ("1/2*x - 1/2*y", "1")
    assert ratio == (X - Y) / 2
    assert ratio != X - Y
    assert 1 - X == -(X - 1)
    assert X**0 == 1
    assert X**-2 == 1 / (X * X)
    assert ((X + Y) / X) ** 2 == 1 + 2 * Y / X + Y**2 / X**2


SMALL = st.integers(-3, 3)
OPERATIONS = {"+": lambda a, b: a + b, "-": lambda a, b: a - b, "*": lambda a, b: a * b, "/": lambda a, b: a / b}


@given(st.lists(st.tuples(st.sampled_from("+-*/"), st.sampled_from(["x", "y", -2, 3]), st.booleans()), max_size=8),
       SMALL, SMALL)  # fmt: skip
def test_the_arithmetic_is_that_of_numbers(steps, x, y):
    """The same operations on rational functions and on their values."""
    ratio, number = X + 1, Fraction(x) + 1
    for operation, name, swapped in steps:
        other, exact = {"x": (X, Fraction(x)), "y": (Y, Fraction(y))}.get(name) or (name, Fraction(name))
        try:
            number = OPERATIONS[operation](*((exact, number) if swapped else (number, exact)))
        except ZeroDivisionError:
            return
        ratio = OPERATIONS[operation](*((other, ratio) if swapped else (ratio, other)))
    assert value(ratio, x, y) == number
    assert Identity("it equals itself", [ratio * (X + Y)], [X * ratio + ratio * Y]).holds()
    assert not Identity("and not itself + 1", [ratio], [ratio + 1]).holds()
