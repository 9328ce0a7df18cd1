"""Many steps: frames, attitude, contact point, batches, folds."""

import pickle
from functools import partial

import numpy as np
import pytest

import chapsym
from chapsym import BadInput, Ball, Status, StepNotTaken
from chapsym.dynamics import kernels
from chapsym.dynamics.attitudes import attitude_with

BALL = Ball((1, 2, 4), 3, radius=0.5)
GAMMA = np.array([2, 3, 6]) / 7
K = np.array([0.2, -0.1, 0.15])


@pytest.mark.parametrize(
    "gamma", [(0, 0, 1), (0, 0, -1), (1, 0, 0), (0, 1e-9, -1), (3e-5, -4e-5, -np.sqrt(1 - 25e-10))]
)
def test_the_least_attitude_turns_gamma_up(gamma):
    gamma = np.array(gamma, dtype=float)
    quaternion = attitude_with(gamma)
    assert abs(quaternion @ quaternion - 1) < 4e-16
    assert np.abs(kernels.rotate(quaternion, gamma) - [0, 0, 1]).max() < 4e-16


@pytest.mark.parametrize(
    ("kwargs", "sentence"),
    [
        ({"steps": -1}, "steps must be a whole number from 0 on"),
        ({"steps": True}, "steps must be a whole number"),
        ({"time_step": 0.0}, "time_step must be one positive number"),
        ({"time_step": np.nan}, "time_step must be finite"),
        ({"steps": 10**13}, "do not fit into memory"),
        ({"attitude": np.ones((2, 4)) / 2}, r"attitude has the leading axes \(2,\), the states have \(\)"),
        ({"every": 0}, "every must be a whole number from 1 on"),
        ({"attitude": (1, 0, 0, 0)}, "attitude and gamma disagree"),
        ({"attitude": (1, 1, 0, 0)}, "attitude must be unit quaternions"),
        ({"ball": Ball((1, 2, 4), 3), "contact": True}, "needs the radius"),
    ],
)
def test_a_run_without_an_answer_is_refused(kwargs, sentence):
    with pytest.raises(BadInput, match=sentence):
        chapsym.trajectory(**{"ball": BALL, "momentum": K, "gamma": GAMMA, "steps": 5, **kwargs})


def test_a_step_that_was_not_taken_can_be_pickled():
    error = StepNotTaken(Status.FOLDED, 0.5, 3)
    again = pickle.loads(pickle.dumps(error))  # as a process pool does with an error of ours
    assert (str(again), again.status, again.reach, again.index) == (str(error), error.status, 0.5, 3)


def test_more_steps_than_can_be_counted_or_timed_are_refused_and_others_are_only_large():
    asked = Ball((1, 2, 4), 3), (0.1, 0.2, 0.3), (0, 0, 1)
    many = "steps must be a whole number from 0 to 4611686018427387904, not 10000000000000000000000000"
    for takes in (
        partial(chapsym.trajectory, *asked),
        partial(chapsym.roll, *asked[:2], 1e-25),
        partial(chapsym.extrapolate, *asked, 1e-25),
    ):
        with pytest.raises(BadInput, match=many):
            takes(steps=10**25, every=10**24)
    with pytest.raises(BadInput, match="steps times time_step is beyond the range of float64"):
        chapsym.trajectory(*asked, 5, time_step=1e308)
    with pytest.raises(StepNotTaken):
        chapsym.trajectory(BALL, 9 * K / abs(K).max(), GAMMA, 2**62, every=10**30)
    assert chapsym.trajectory(BALL, K, GAMMA, 3, order=np.int64(4), every=10**30).taken == 3
    with pytest.raises(StepNotTaken, match="rounding hides the rotation"):  # which is no missing inertia
        chapsym.step(Ball((1, 2, 4), 1e100), K, GAMMA)


def test_progress_is_told():
    seen = []
    chapsym.trajectory(BALL, K, GAMMA, 450_000, every=1000, progress=seen.append)
    assert seen == [200_000, 400_000, 450_000]


def test_progress_of_a_proved_run_begins_before_the_proof_does():
    def progress(done):
        if not done:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        chapsym.trajectory(BALL, K, GAMMA, 10, proved=True, progress=progress)


@pytest.mark.usefixtures("plain")
def test_a_momentum_beyond_squares_stops_without_a_warning(recwarn):
    run = chapsym.trajectory(chapsym.Ball((1, 2, 4), 3), [(1e200, 0, 0)] * 2, (2 / 7, 3 / 7, 6 / 7), 5)
    assert (run.status != chapsym.Status.TAKEN).all()
    assert not recwarn.list


@pytest.mark.parametrize("precision", ["double", "double-double"])
@pytest.mark.parametrize(("moment", "momentum"), [(1e-200, 1e200), (1e-308, 1.7e308)])
def test_a_momentum_beyond_every_range_beside_the_ball_has_no_rotation(moment, momentum, precision):
    """One ball, and nine in a block: 𝒦/Λ is beyond float64."""
    tensor = moment * np.array([1, 1, 1.1])
    with pytest.raises(StepNotTaken, match="no rotation of this ball"):
        chapsym.trajectory(Ball(tensor, 0), momentum * GAMMA, GAMMA, 5, precision=precision)
    run = chapsym.trajectory(Ball([tensor] * 9, 0), [momentum * GAMMA] * 9, GAMMA, 300, precision=precision)
    assert (run.status == Status.UNREACHABLE).all()
    assert (run.taken == 0).all()


@pytest.mark.parametrize("name", ["float32", np.float32, np.dtype(np.float32)])
def test_numpys_names_of_the_precisions_are_taken(name):
    run = chapsym.trajectory(Ball((1, 2, 4), 3), (0.1, 0.2, 0.3), (0, 0, 1), 3, time_step=0.5, precision=name)
    assert run.momentum.dtype == np.float32
    for none in (np.float16, "triple"):
        with pytest.raises(BadInput, match="precision must be"):
            chapsym.step(Ball((1, 2, 4), 3), (0.1, 0.2, 0.3), (0, 0, 1), precision=none)


def test_a_trajectory_is_shown_in_a_line():
    run = chapsym.trajectory(Ball((1, 2, 4), 3), (0.1, 0.2, 0.3), (0, 0, 1), 3, time_step=0.5)
    assert repr(run) == "<Trajectory of 1 ball: 4 frames in 3 steps of 0.5 s; momentum, gamma>"
    assert run.t.tolist() == [0.0, 0.5, 1.0, 1.5]
    with pytest.raises(BadInput, match="no time step"):
        _ = chapsym.trajectory(BALL, K, GAMMA, 1).time
