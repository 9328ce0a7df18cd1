"""The step back, from the paper's formulas in `fractions`."""

from fractions import Fraction as F

import numpy as np
from budget import examples
from hypothesis import given
from reference import axial, momentum, rotation

from chapsym import testing


@given(testing.rational_rotations(), testing.rational_unit_vectors(), testing.rational_balls())
@examples(40)
def test_the_step_back_with_fractions_alone(q, gamma, ball):
    J, D = ball
    turn, gamma = np.array(rotation(*q)), np.array(gamma)
    there = np.array(momentum(turn, gamma, J, D))
    arrived, vertical = turn.T @ there @ turn, turn.T @ gamma
    back = np.array(momentum(turn.T, vertical, J, D))
    assert (back == -arrived).all()
    assert (axial(back) == -turn.T @ axial(there)).all()
    assert (turn @ arrived @ turn.T == there).all()
    assert (turn @ vertical == gamma).all()


def test_the_mean_of_both_ends_is_what_makes_it_so():
    """With Γ at the start alone the contact term has no such symmetry: an exact counterexample."""
    turn, gamma = np.array(rotation(F(4, 5), F(2, 5), F(1, 5), F(2, 5))), np.array([F(2, 7), F(3, 7), F(6, 7)])

    def lopsided(turn, gamma):
        half = turn @ (np.diag([1, 2, 4]) + 3 * np.outer(gamma, gamma))
        return half - half.T

    back = lopsided(turn.T, turn.T @ gamma)
    assert (back != -turn.T @ lopsided(turn, gamma) @ turn).any()
