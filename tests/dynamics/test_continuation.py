"""Branches followed, their folds, and the margin of a state."""

import numpy as np
import pytest
from budget import examples, slow
from crowds import seeded
from hypothesis import assume, given

from chapsym import testing
from chapsym.dynamics import BadInput, Ball, Status, branches, fold, follow, kernels, margin, step
from chapsym.dynamics.solutions import continuation

GAMMA = np.array([2.0, 3.0, 6.0]) / 7
BALL = Ball((1, 2, 4), 3)


def det(ball, q, gamma):
    """det T for Λmax = 1."""
    top = ball.inertia.max(axis=-1) + ball.D
    return np.linalg.det(kernels.tangent_jacobian(q, gamma, ball.mass_tensor, ball.D)) / top**3


@pytest.mark.parametrize("D", [0.0, 1e2, *slow(1.0, 1e4)])
def test_a_fold_is_where_the_jacobian_is_singular(D, thorough):
    """To roundoff: the residual of 𝒦(q) = t𝒦 and det T, in units of Λmax; and t."""
    ball, K, gamma = seeded(50 if thorough else 5, D)
    found = fold(ball, K, gamma)
    assert found.settled.all()
    assert np.abs(det(ball, found.rotation, gamma)).max() < 16 * 2.0**-52
    top = (ball.inertia.max(axis=1) + D)[:, np.newaxis]
    gap = kernels.momentum(found.rotation, gamma, ball.mass_tensor, ball.D) - found.reach[:, np.newaxis] * K
    assert np.abs(gap / top).max() < 8 * 2.0**-52
    # A rounding of the residual, Λmax 2^-52, is this fraction of the momentum: so near are the exact counts right.
    rounding = (64 * 2.0**-52 * top / np.linalg.norm(found.reach[:, np.newaxis] * K, axis=1, keepdims=True))[:3]
    few, t = Ball(ball.mass_tensor[:3], ball.D[:3]), found.reach[:3, np.newaxis]
    below, above = (branches(few, t * (1 + s * rounding) * K[:3], gamma[:3]) for s in (-1, 1))
    assert (below.count - above.count == 2).all()


def test_closed_forms():
    """D = 0: about the axis i, 𝒦 = 2(Jj + Jk) q₀q, largest at a right angle; and for equal moments about any axis."""
    for i, most in enumerate((6, 5, 3)):
        found = fold(Ball((1, 2, 4), 0), np.eye(3)[i], GAMMA)
        assert found.settled
        assert found.reach == pytest.approx(most, rel=1e-15)
        assert found.rotation[[0, i + 1]] == pytest.approx(np.sqrt([0.5, 0.5]), rel=1e-15)
    assert margin(Ball((1, 1, 1), 0), 0.5 * GAMMA, (0, 0, 1)) == pytest.approx(3, rel=1e-15)


@examples(8, 20)
@given(testing.states(fraction=(0.01, 1.3)))
def test_the_margin_says_whether_the_step_is_taken(state):
    ball, K, gamma = state
    assume(np.abs(K).max() > 0)
    assume(ball.D < 1e4)  # beyond, a march of thousands of steps may end without an answer
    left = margin(ball, K, gamma)
    assume(abs(left) > 1e-9 * (1 + ball.D / ball.mass_tensor.max()))
    found = step(ball, K[np.newaxis], gamma)
    # A march that comes to 1 - 2^-53 of the way has arrived.
    taken = found.status[0] == Status.TAKEN or found.reach[0] >= 1 - 2.0**-52
    assert taken == (left > 0)


def test_another_branch_folds_too(thorough):
    ball, K, gamma = seeded(10, 50.0)
    found = branches(ball, 0.2 * K, gamma)
    which = np.flatnonzero(found.count >= 4)
    assert len(which) > 5
    for i in which[: None if thorough else 1]:
        one, k, g = Ball(ball.mass_tensor[i], ball.D[i]), 0.2 * K[i], gamma[i]
        for q in found.rotation[i, : found.count[i]]:
            top = fold(one, k, g, rotation=q)
            assert top.settled
            assert top.reach > 1
            assert abs(det(one, top.rotation, g)) < 16 * 2.0**-52
            below, above = (branches(one, top.reach * s * k, g) for s in (1 - 1e-7, 1 + 1e-7))
            assert below.count - above.count == 2
            assert np.linalg.norm(below.rotation - top.rotation, axis=-1)[: below.count].min() < 1e-2


def test_a_path_that_leaves_the_branch_ends_at_the_fold():
    K = np.array([1, -0.5, 0.75])
    top = fold(BALL, K, GAMMA).reach
    path = [0 * K, 0.5 * top * K, 1.5 * top * K, K]
    found = follow(BALL, path, GAMMA)
    assert found.status == Status.FOLDED
    assert found.fold.settled
    assert found.reach == found.fold.reach == pytest.approx(1.5, rel=1e-14)
    assert np.isfinite(found.rotation[:2]).all()
    assert np.isnan(found.rotation[2:]).all()


def test_a_loop_comes_back_and_other_branches_stay_others():
    K = np.array([1, -0.5, 0.75])
    found = branches(BALL, K, GAMMA)
    turn = 0.1 * np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [-1, 0.5, 0]])
    loop = np.concatenate([[K], K + turn, [K]])
    ends = follow(BALL, np.broadcast_to(loop, (4, 6, 3)), GAMMA, found.rotation[:4])
    assert (ends.status == Status.TAKEN).all()
    assert np.abs(ends.rotation[:, -1] - found.rotation[:4]).max() < 1e-13
    assert np.abs(ends.rotation[:, 1] - found.rotation[:4]).max() > 1e-3


def test_tiny_and_large_momenta():
    K = np.array([1.0, -0.5, 0.75])
    here = fold(BALL, K, GAMMA).reach
    assert fold(BALL, 1e-290 * K, GAMMA).reach == pytest.approx(1e290 * here, rel=1e-14)
    assert fold(BALL, 1e290 * K, GAMMA).reach == pytest.approx(1e-290 * here, rel=1e-14)
    assert fold(BALL, 1e-310 * K, GAMMA).reach == np.inf
    for size in (1e3, 1e300):
        assert follow(BALL, [0 * K, size * K], GAMMA).reach * size == pytest.approx(here)
    along = fold(Ball((1, 2, 4), 1e6), GAMMA, GAMMA)  # the momentum about the vertical does not grow with D
    assert along.settled
    assert along.reach < 10


def test_what_cannot_be_followed_is_told():
    assert np.isnan(margin(Ball((0, 0, 1), 3), (0, 0, 1), (0, 0, 1)))
    found = follow(Ball((0, 0, 1), 3), [[0, 0, 0], [0, 0, 1]], (0, 0, 1))
    assert found.status == Status.NOT_CONVERGED
    with pytest.raises(BadInput, match="at least 2 momenta"):
        follow(BALL, [[0, 0, 0]], GAMMA)
    with pytest.raises(BadInput, match="does not have the momentum where the path begins"):
        follow(BALL, [[1, 0, 0], [2, 0, 0]], GAMMA)
    with pytest.raises(BadInput, match="unit Euler parameters"):
        follow(BALL, [[0, 0, 0], [1, 0, 0]], GAMMA, (2, 0, 0, 0))
    with pytest.raises(BadInput, match="leading axes"):
        follow(BALL, [[0, 0, 0], [1, 0, 0]], GAMMA, np.ones((3, 4)) / 2)
    with pytest.raises(BadInput, match="momentum must not be 0"):
        margin(BALL, (0, 0, 0), GAMMA)


def test_a_fold_that_newton_does_not_find_is_not_settled(monkeypatch):
    monkeypatch.setattr(continuation, "MOST_EXTENDED", 0)
    K = (1, -0.5, 0.75)
    found = fold(BALL, K, GAMMA)
    assert not found.settled
    monkeypatch.undo()
    there = fold(BALL, K, GAMMA)
    assert there.settled
    assert 0 < there.reach - found.reach < 1e-4


def test_a_path_may_end_at_rest_and_go_through_it():
    ball, K, g = Ball((1, 2, 4), 3), np.array([1, -0.5, 0.75]), np.array([2, 3, 6]) / 7
    start = step(ball, K / 19, g).rotation
    rest = follow(ball, [K / 19, 0 * K], g, start)
    assert rest.status == 0
    assert (np.abs(rest.rotation[-1]) == [1, 0, 0, 0]).all()
    through = follow(ball, [K / 19, 0 * K, -K / 19], g, start)
    assert through.status == 0
    assert np.abs(through.rotation[-1] - step(ball, -K / 19, g).rotation).max() < 1e-14


def test_a_ball_has_the_same_bits_in_a_batch_and_alone():
    random, count = np.random.default_rng(1), 8
    balls = Ball(np.exp(random.uniform(-2, 2, (count, 3))), np.exp(random.uniform(-2, 2, count)))
    momentum, gamma = 0.1 * random.standard_normal((count, 3)), random.standard_normal((count, 3))
    gamma /= np.linalg.norm(gamma, axis=1, keepdims=True)
    path = momentum[:, np.newaxis] * np.array([[0.0], [1.0], [5.0]])
    together = fold(balls, momentum, gamma), follow(balls, path, gamma)
    for i in range(count):
        ball = Ball(balls.mass_tensor[i], balls.D[i])
        for many, one in zip(
            together, (fold(ball, momentum[i], gamma[i]), follow(ball, path[i], gamma[i])), strict=True
        ):
            assert many.reach[i] == one.reach
            assert np.array_equal(many.rotation[i], one.rotation, equal_nan=True)
