"""The equations (5.2) for q, one step of a rational state, and the count of solutions that others are compared with."""

import groebner_count
import pytest
import sympy as sp
from budget import examples
from hypothesis import given
from hypothesis import strategies as st

from chapsym.derive import solutions
from chapsym.derive.three import q, q0
from chapsym.derive.words import unfolded

GAMMA = ("2/7", "3/7", "6/7")


def test_the_equations_of_the_derivation_are_the_quadrics():
    for derived, written in zip(solutions.equations(), solutions.quadrics(), strict=True):
        assert sp.expand(unfolded(derived) - 2 * written) == 0


def test_no_momentum_leaves_the_identity_and_three_half_turns():
    found = groebner_count.count(groebner_count.at((1, 2, 4), 3, GAMMA, (0, 0, 0)))
    assert found[:3] == (4, 8, 8)


def test_a_homogeneous_ball_has_a_curve_of_complex_solutions():
    with pytest.raises(groebner_count.NotFinite, match="infinitely many"):
        groebner_count.count(groebner_count.at((1, 1, 1), 0, GAMMA, (0, 0, 1)))


@examples(8, 20)
@given(st.lists(st.integers(-3, 3), min_size=3, max_size=3), st.integers(0, 20))
def test_the_momentum_of_a_rotation_has_that_rotation(u, contact):
    """A rational Ω ~ (4, u) is one of the solutions for its own momentum."""
    turn = (4, *u)
    momentum, vertical = solutions.after((1, 2, 4), contact, GAMMA, turn)
    # after() moves the state by its own rotation; Ωγ and Ω𝒦 are the state before, seen from there
    length = sp.Integer(sum(c * c for c in turn))
    rotation = sp.Matrix(solutions.three.rotation()).subs(dict(zip((q0, *q), turn, strict=True))) / length
    before = [list(rotation * sp.Matrix(x)) for x in (momentum, vertical)]
    equations = groebner_count.at((1, 2, 4), contact, before[1], before[0])
    assert all(e.subs(dict(zip((q0, *q), turn, strict=True))) == 0 for e in equations)


def test_the_two_counts_must_agree(monkeypatch):
    monkeypatch.setattr(groebner_count._Algebra, "inertia", lambda self: (8, 2))
    with pytest.raises(ArithmeticError, match="differ"):
        groebner_count.count(groebner_count.at((1, 2, 4), 3, GAMMA, (0, 0, 0)))
