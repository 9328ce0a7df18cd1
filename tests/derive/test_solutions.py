"""Exact counts of the solutions of (5.2)."""

import pytest
import sympy as sp
from budget import examples
from hypothesis import given
from hypothesis import strategies as st

from chapsym.derive import solutions
from chapsym.derive.three import q, q0

GAMMA = ("2/7", "3/7", "6/7")


def test_no_momentum_leaves_the_identity_and_three_half_turns():
    found = solutions.count(solutions.at((1, 2, 4), 3, GAMMA, (0, 0, 0)))
    assert found[:3] == (4, 8, 8)


def test_a_homogeneous_ball_has_a_curve_of_complex_solutions():
    with pytest.raises(solutions.NotFinite, match="infinitely many"):
        solutions.count(solutions.at((1, 1, 1), 0, GAMMA, (0, 0, 1)))


@examples(20)
@given(st.lists(st.integers(-3, 3), min_size=3, max_size=3), st.integers(0, 20))
def test_the_momentum_of_a_rotation_has_that_rotation(u, contact):
    """A rational Ω ~ (4, u) is one of the solutions for its own momentum."""
    turn = (4, *u)
    momentum, vertical = solutions.after((1, 2, 4), contact, GAMMA, turn)
    # after() moves the state by its own rotation; Ωγ and Ω𝒦 are the state before, seen from there
    length = sp.Integer(sum(c * c for c in turn))
    rotation = sp.Matrix(solutions.three.rotation()).subs(dict(zip((q0, *q), turn, strict=True))) / length
    before = [list(rotation * sp.Matrix(x)) for x in (momentum, vertical)]
    equations = solutions.at((1, 2, 4), contact, before[1], before[0])
    assert all(e.subs(dict(zip((q0, *q), turn, strict=True))) == 0 for e in equations)
    assert solutions.have_common_point([*equations, *(c * q0 - 4 * x for c, x in zip(u, q, strict=True))])


def test_common_points_are_found():
    x, y, z = q
    assert solutions.have_common_point([x - y, y - z, q0 - x])
    assert not solutions.have_common_point([x, y, z, q0])
    assert not solutions.have_common_point([x**2 + y**2 + z**2 + q0**2, x - y, y - z, z - q0])


def test_the_two_counts_must_agree(monkeypatch):
    monkeypatch.setattr(solutions._Algebra, "inertia", lambda self: (8, 2))
    with pytest.raises(ArithmeticError, match="differ"):
        solutions.count(solutions.at((1, 2, 4), 3, GAMMA, (0, 0, 0)))
