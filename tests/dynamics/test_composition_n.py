"""Compositions in n dimensions: the stages, three dimensions, and where a stage folds.

The coefficients are those of three dimensions, whose order is measured: tests/dynamics/test_composition.py.
"""

import threading

import numpy as np
import pytest
from balls_n import SIZES, UNIT_ROUNDOFF, batch
from crowds import NAMES

from chapsym import BallN, Status, StepNotTaken, step_n, substeps, trajectory_n
from chapsym.dynamics.n import run_n
from chapsym.dynamics.n.near_n import limits

ORDERS = (4, 6, 8)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("n", SIZES)
def test_a_step_is_its_stages(n, order):
    """Each turns 𝒦 and γ by the rotation that `step_n` finds from cᵢ𝒦; both round it by some ulps."""
    ball, K, gamma = batch(n, 4, 0.2)
    run = trajectory_n(ball, K, gamma, 1, order=order, attitude=True)
    momentum, vertical, attitude = K, gamma, run.attitude[:, 0]
    for c in substeps(order):
        rotation = step_n(ball, c * momentum, vertical).rotation
        momentum, vertical = rotation.mT @ momentum @ rotation, (rotation.mT @ vertical[..., None])[..., 0]
        momentum, attitude = (momentum - momentum.mT) / 2, attitude @ rotation
    allowed = 8 * UNIT_ROUNDOFF * len(substeps(order))
    assert np.abs(run.momentum[:, 1] - momentum).max() <= allowed * np.abs(K).max()
    assert np.abs(run.gamma[:, 1] - vertical).max() <= allowed
    assert np.abs(run.attitude[:, 1] - attitude).max() <= allowed


def heavy():
    """A ball whose branch folds at the third step of order 4 from 4.07·K, in one of its stages."""
    ball, K, gamma = batch(4, 1, 1.0, seed=4)
    return BallN(ball.mass_tensor[0], ball.D[0]), K[0], gamma[0]


def test_a_stage_that_folds_stops_one_ball_and_a_batch_goes_on():
    ball, K, gamma = heavy()
    with pytest.raises(StepNotTaken) as caught:
        trajectory_n(ball, 4.07 * K, gamma, 30, order=4, attitude=True)
    error = caught.value
    assert (error.status, error.index, error.trajectory.order) == (Status.FOLDED, 2, 4)
    run = trajectory_n(ball, np.stack([4.07 * K, 0.1 * K]), gamma, 30, order=4)
    assert run.status.tolist() == [Status.FOLDED, Status.TAKEN]
    assert run.taken.tolist() == [2, 30]
    assert np.isnan(run.momentum[0, 3:]).all()
    assert (run.momentum[1] == trajectory_n(ball, 0.1 * K, gamma, 30, order=4).momentum).all()
    assert (error.trajectory.momentum == trajectory_n(ball, 4.07 * K, gamma, 2, order=4).momentum).all()


def test_each_stage_has_the_bound_of_its_own_momentum():
    ball, K, _ = heavy()
    stages = substeps(8)
    K = 3 * K
    near, enough = limits(K[None], ball.mass_tensor[None], ball.D[None], stages)
    for i, c in enumerate(stages):
        one = limits(c * K[None], ball.mass_tensor[None], ball.D[None], np.ones(1))
        assert (near[0, i], enough[0, i]) == (one[0][0, 0], one[1][0, 0])
    assert len(set(near[0])) > 1


def test_threads_share_a_batch_and_its_bits_stay(monkeypatch):
    ball, K, gamma = batch(4, 6, 0.2)
    seen, honest = set(), run_n.advance
    monkeypatch.setattr(run_n, "advance", lambda *a: seen.add(threading.get_ident()) or honest(*a))
    runs = [trajectory_n(ball, K, gamma, 700, order=4, every=50, contact=True, threads=threads) for threads in (1, 3)]
    assert len(seen) > 1
    assert all((getattr(runs[0], name) == getattr(runs[1], name)).all() for name in NAMES)
