"""The lemma on the order of the compositions: what a wrong coefficient or a wrong claim does to it."""

from dataclasses import replace
from fractions import Fraction

import pytest

from chapsym.derive import composition
from chapsym.proofs.map import order
from chapsym.prove import load
from chapsym.prove.runner import judge

ID = "composition-order"


def verdict():
    return judge(load(lemmas=True)[ID]).verdict.value


@pytest.mark.parametrize(("wanted", "place", "digit"), [(4, 0, 39), (4, 2, 38), (6, 1, 38), (8, 0, 30), (8, 8, 38)])
def test_a_wrong_digit_is_seen(wanted, place, digit, monkeypatch):
    one = order.COMPOSITIONS[wanted]
    half = [*one.half]
    half[place] = half[place][: digit - 42] + str((int(half[place][digit - 42]) + 5) % 10) + half[place][digit - 41 :]
    monkeypatch.setitem(order.COMPOSITIONS, wanted, replace(one, half=tuple(half)))
    assert verdict() != "holds"


def test_a_composition_of_too_low_an_order_is_seen(monkeypatch):
    """Kahan and Li's of order 6 in the place of that of order 8."""
    monkeypatch.setitem(order.COMPOSITIONS, 8, replace(order.COMPOSITIONS[6], order=8))
    assert verdict() != "holds"


def test_a_condition_that_is_left_out_is_seen(monkeypatch):
    honest = composition.lyndon
    monkeypatch.setattr(composition, "lyndon", lambda order: honest(order)[:-1])
    assert verdict() != "holds"


def test_the_brackets_are_lie_elements():
    """[1, 3] = 13 - 31, and [1, [1, 3]] = 113 - 2·131 + 311; their coefficients on a shuffle add up to 0."""
    assert {(1, 3): 1, (3, 1): -1} in composition.brackets(4)
    assert {(1, 1, 3): 1, (1, 3, 1): -2, (3, 1, 1): 1} in composition.brackets(5)


def test_an_interval_that_holds_no_solution_is_refused():
    half = order.COMPOSITIONS[6].exact[:5]
    with order.ctx.workprec(order.BITS):
        assert order.isolated(half, 6) is not None
        assert order.isolated([*half[:4], half[4] + 3 * order.OFF], 6) is None
        assert order.isolated([Fraction(1, 5)] * 5, 6) is None
