"""The branch in n dimensions: where it goes, where it folds, and Newton's iteration at its edges."""

import warnings

import numpy as np
import pytest
from balls_n import UNIT_ROUNDOFF, offset, proven_branch
from budget import slow

import chapsym
from chapsym import Ball, BallN, Status, skew, step_n
from chapsym.dynamics.n import so_n
from chapsym.dynamics.n.branch_n import _solved, corrected, small_rotation


@pytest.mark.parametrize("heavy", [1.0, 1e7])
def test_in_three_dimensions_the_fold_is_the_same(heavy):
    """With a large D, up to what its roundings are beside the momentum of the fold."""
    rng = np.random.default_rng(3)
    J, D, gamma = rng.uniform(0.1, 2, (60, 3)), heavy * rng.uniform(0, 2, 60), rng.normal(size=(60, 3))
    gamma /= np.linalg.norm(gamma, axis=-1, keepdims=True)
    K = rng.normal(size=(60, 3)) * 10 ** rng.uniform(-1, 1, (60, 1))
    general, special = step_n(BallN(J, D), skew(K), gamma), chapsym.step(Ball(J, D), K, gamma)
    assert 5 < (special.status == Status.TAKEN).sum() < 55
    assert ((general.status == Status.TAKEN) == (special.status == Status.TAKEN)).all()
    assert np.isnan(general.rotation[general.status == Status.FOLDED]).all()
    assert np.abs(general.reach - special.reach).max() <= 64 * UNIT_ROUNDOFF * (1 + heavy)


@pytest.mark.parametrize("n", [4, 5, *slow(3, 8)])
def test_the_branch_is_the_proven_one(n):
    rng = np.random.default_rng(n)
    for i in range(6 if n < 8 else 3):
        J, D, gamma = rng.uniform(0.1, 2, n), np.float64((0.0, 1.0)[i % 2]), rng.normal(size=n)
        J[0] *= i % 3 > 0
        gamma /= np.linalg.norm(gamma)
        K = so_n.from_coordinates(rng.normal(size=n * (n - 1) // 2), n) * 100
        _, _, reach = small_rotation(K[None], gamma[None], J[None], D[None])
        K *= reach[0] * (0.2, 0.6, 0.95)[i % 3]
        assert np.abs(offset((K, gamma, J, D)) - proven_branch(K, gamma, J, D)).max() < 1e-11


@pytest.mark.parametrize("n", [4, *slow(5)])
def test_past_the_fold_no_other_branch_is_taken(n, thorough):
    """Newton alone, whatever its corrections, would find another rotation for some of these."""
    rng, balls = np.random.default_rng(5), 400 if thorough else 150
    J, D, gamma = rng.uniform(0.1, 2, (balls, n)), rng.uniform(0, 2, balls), rng.normal(size=(balls, n))
    gamma /= np.linalg.norm(gamma, axis=-1, keepdims=True)
    J[::3, 0] = 0
    K = so_n.from_coordinates(rng.normal(size=(balls, n * (n - 1) // 2)), n) * 100
    folded = step_n(BallN(J, D), K, gamma)
    assert (folded.status == Status.FOLDED).all()
    past = folded.reach * (1 + 10 ** rng.uniform(-4, -2, balls))
    again = step_n(BallN(J, D), K * past[:, None, None], gamma)
    assert (again.status == Status.FOLDED).all()
    assert np.abs(again.reach * past / folded.reach - 1).max() < 1e-12


def test_one_singular_system_does_not_spoil_the_others():
    matrices = np.stack([np.eye(3), np.zeros((3, 3)), 2 * np.eye(3)])
    assert _solved(matrices, np.ones((3, 3))).tolist() == [[1] * 3, [np.inf] * 3, [0.5] * 3]


def test_from_a_fold_newton_does_not_settle_and_does_not_complain():
    """At a rotation by 90° of a ball with J = 1, D = 0 the Jacobian is exactly singular."""
    quarter = np.eye(4)[[1, 0, 2, 3]] * [[-1], [1], [1], [1]]
    E = np.stack([quarter - np.eye(4), np.zeros((4, 4))])
    state = np.tile(np.eye(4)[0], (2, 1)), np.ones((2, 4)), np.zeros(2)
    assert np.linalg.matrix_rank(so_n.jacobian(E[0], *(x[0] for x in state))) < 6
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        moved, settled = corrected(E, np.full((2, 6), 0.1), *state)
    assert settled.tolist() == [False, True]
    assert np.abs(so_n.momentum(moved[1], *(x[1] for x in state))).max() == pytest.approx(0.1)


def test_a_bifurcation_ends_the_branch_as_a_fold_does():
    """The rotations about e₂ go on, but the Jacobian vanishes on the way: so it is in three dimensions."""
    J, D, gamma = (0.0, 0.0, 1.0), 1.0, np.array([1.0, 0.0, 4.0]) / np.sqrt(17)
    found = []
    for step, momentum in ((chapsym.step, [0, 1.0, 0]), (chapsym.step_n, chapsym.skew([0, 1.0, 0]))):
        ball = chapsym.Ball(J, D) if step is chapsym.step else chapsym.BallN(J, D)
        with pytest.raises(chapsym.StepNotTaken) as caught:
            step(ball, momentum, gamma)
        assert caught.value.status == chapsym.Status.FOLDED
        found.append(caught.value.reach)
    assert found[0] == pytest.approx(16 / 17, rel=1e-7)
    assert found[1] == pytest.approx(16 / 17, rel=1e-7)
