"""The reduced map G_h: it is the full map at 𝒦 = hγ, keeps its integral, and turns back."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import chapsym
from chapsym import BadInput, Ball, Status, StepNotTaken, step_vertical, testing, trajectory_vertical
from chapsym.dynamics.levels import double

ULP = 2.0**-52
GAMMA = np.array([2 / 7, 3 / 7, 6 / 7])
TOP, BALL = Ball((1, 2, 4), 0), Ball((1, 2, 4), 3)


@given(testing.balls(), testing.unit_vectors(), st.floats(-0.5, 0.5))
def test_a_step_is_that_of_the_full_map(ball, gamma, part):
    """h up to half the least moment: below the fold, where both are within a few ulps times the condition."""
    height = part * ball.inertia.min()
    full = chapsym.step(ball, height * gamma, gamma)
    reduced = step_vertical(ball, height, gamma)
    inertia = ball.inertia + ball.D
    condition = inertia.max() / ball.inertia.min()
    assert np.abs(full.gamma - reduced.gamma).max() <= 16 * ULP * condition
    assert np.abs(full.rotation - reduced.rotation).max() <= 16 * ULP * condition
    assert np.abs(reduced.momentum - height * reduced.gamma).max() == 0


@pytest.mark.parametrize("ball", [TOP, BALL], ids=["D=0", "D=3"])
@pytest.mark.parametrize("height", [0.0, 1e-300, 1e-3, 0.3, -0.3, 2.5])
def test_a_trajectory_is_that_of_the_full_map(ball, height):
    """2.5 of the least moment 3: the closed form and the extrapolation are left for corrections, not for the result."""
    reduced = trajectory_vertical(ball, height, GAMMA, 200, every=10)
    full = chapsym.trajectory(ball, height * GAMMA, GAMMA, 200, every=10)
    # Roundings of 200 steps add to the phase as n^(3/2) at worst: 2800 ulps.
    assert np.abs(reduced.gamma - full.gamma).max() <= 1000 * ULP
    assert np.abs(reduced.momentum - full.momentum).max() <= 1000 * ULP * max(abs(height), 1)
    assert (reduced.index == full.index).all()


def test_the_closed_form_needs_no_other_path(monkeypatch):
    """D = 0: every one of 20 000 steps in plain Python, though l has drifted and v with it."""

    def refuse(*args):
        raise AssertionError("another path was taken")

    monkeypatch.setattr(double, "run", refuse)
    whole = trajectory_vertical(TOP, 1.0, GAMMA, 20_000, every=100)
    monkeypatch.setattr(double, "CHUNK", 777)  # steps between which an interrupt is seen
    assert (trajectory_vertical(TOP, 1.0, GAMMA, 20_000, every=100).gamma == whole.gamma).all()


@pytest.mark.parametrize("ball", [TOP, BALL], ids=["D=0", "D=3"])
def test_the_integral_drifts_by_rounding_only(ball):
    """Over n = 10⁵ steps: γ is summed with a compensation, so |γ|² stays within √n/32 ulps, where plain sums give √n/3.

    l moves with the rounding of the rotation: √n/8 ulps, of which 24 of 40 were seen.
    """
    run = trajectory_vertical(ball, 0.3, GAMMA, 100_000, every=1000)
    level = run.level()
    assert np.abs(level / level[0] - 1).max() <= np.sqrt(100_000) / 8 * ULP
    assert np.abs((run.gamma**2).sum(axis=-1) - 1).max() <= np.sqrt(100_000) / 32 * ULP


def test_a_batch_goes_on_for_those_that_can():
    ball = Ball([[1, 2, 4], [1, 2, 4]], [0, 3])
    heights = np.array([[0.3], [20.0]])
    run = trajectory_vertical(ball, heights, GAMMA, 20)
    assert run.gamma.shape == (2, 2, 21, 3)
    assert (run.taken[0] == 20).all()
    assert (run.status[0] == Status.TAKEN).all()
    assert (run.taken[1] == 0).all()
    assert (run.status[1] != Status.TAKEN).all()
    assert np.isnan(run.gamma[1, :, 1:]).all()
    assert not np.isnan(run.gamma[0]).any()
    alone = trajectory_vertical(BALL, 0.3, GAMMA, 20)
    assert (run.gamma[0, 1] == alone.gamma).all()
    steps = step_vertical(ball, heights, GAMMA)
    assert (steps.gamma[0] == run.gamma[0, :, 1]).all()
    assert np.isnan(steps.gamma[1]).all()
    assert np.isnan(steps.rotation[1]).all()


def test_one_ball_that_cannot_step_says_so():
    with pytest.raises(StepNotTaken, match="no rotation of this ball"):
        step_vertical(BALL, 20, GAMMA)
    with pytest.raises(StepNotTaken, match="step 0") as caught:
        trajectory_vertical(BALL, 20, GAMMA, 5)
    assert caught.value.trajectory.gamma.shape == (1, 3)


@pytest.mark.parametrize(
    ("height", "gamma", "sentence"),
    [
        (float("nan"), GAMMA, "height must be finite"),
        (0.1, (1, 1, 0), "unit vector"),
        ([0.1, 0.2, 0.3], [GAMMA, GAMMA], "do not broadcast"),
    ],
)
def test_bad_input_is_told(height, gamma, sentence):
    with pytest.raises(BadInput, match=sentence):
        step_vertical(BALL, height, gamma)


def test_only_what_the_exact_top_was_made_for_is_restored():
    top = chapsym.exact_top(Ball((1, 2, 4), 3), 0.6 * GAMMA, GAMMA)
    for momentum, order in ((top.momentum, 4), (2 * top.momentum, 2)):
        with pytest.raises(BadInput, match="no trajectory of the exact top"):
            top.restore(chapsym.trajectory(top.ball, momentum, GAMMA, 5, order=order))
    with pytest.raises(BadInput, match="does not start at the gamma"):
        top.restore(chapsym.trajectory(top.ball, top.momentum, (0, 0.6, 0.8), 5))
    with pytest.raises(BadInput, match="exact_top with the opposite momentum"):
        chapsym.reverse(top.restore(chapsym.trajectory(top.ball, top.momentum, GAMMA, 5, attitude=True)))
