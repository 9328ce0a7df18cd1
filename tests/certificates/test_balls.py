"""The numbers of a certificate: rounded to what every number of a ball rounds to, or refused."""

from fractions import Fraction

import pytest
from flint import arb, ctx
from hypothesis import given
from hypothesis import strategies as st

from chapsym.certificates.balls import NotProved, decimal, decimals, rounded, shortest
from chapsym.dynamics.levels.balls import exact
from chapsym.dynamics.levels.start import decade

fractions = st.fractions(max_denominator=10**9).filter(lambda x: abs(x) < 10**6)


@given(fractions, st.fractions(0, 1, max_denominator=10**6), st.integers(0, 12))
def test_every_number_of_a_ball_rounds_to_its_decimals(centre, radius, digits):
    radius /= 10**7
    with ctx.workprec(120):
        x = exact(centre) + arb(0, exact(radius).abs_upper())
        try:
            text = rounded(x, digits)
        except NotProved:
            off = radius + Fraction(1, 2**90)  # only where an end is on another side of a tie
            assert round((centre - off) * 10**digits) != round((centre + off) * 10**digits)
            return
    for number in (centre - radius, centre, centre + radius):
        assert abs(number - Fraction(text)) <= Fraction(1, 2 * 10**digits)
    assert len(text.partition(".")[2]) == digits
    assert not text.startswith("-") or Fraction(text) != 0


def test_a_ball_across_a_tie_is_refused_and_texts_are_the_shortest():
    with ctx.workprec(60):
        tie = exact(Fraction(15, 100)) + arb(0, 1e-9)
        with pytest.raises(NotProved):
            rounded(tie, 1)
        assert rounded(tie, 2) == "0.15"
    texts = ["12/5", "1/3", "1e-40", "0.25", "-3", "0", "1"]
    assert [shortest(Fraction(x)) for x in texts] == ["2.4", "1/3", "1e-40", "0.25", "-3", "0", "1"]
    assert decimals(Fraction(1, 3)) is None


@given(st.integers(-(10**9), 10**9), st.integers(0, 12))
def test_decimals_are_exact(scaled, digits):
    x = Fraction(scaled, 10**digits)
    assert Fraction(decimal(x, digits)) == x
    assert Fraction(shortest(x)) == x
    assert decimals(x) <= digits


@given(fractions.filter(lambda x: x > 0))
def test_decade(x):
    assert Fraction(10) ** decade(x) <= x < Fraction(10) ** (decade(x) + 1)
