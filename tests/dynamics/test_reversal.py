"""The way back: it retraces states, attitude and contact point within what rounding and the flow's shear allow."""

import pickle
from dataclasses import replace

import numpy as np
import pytest
from budget import examples
from hypothesis import given
from small_branch import certified

import chapsym
from chapsym import BadInput, Ball, NotRetraced
from chapsym.dynamics import kernels
from chapsym.dynamics.loops.branch import small_rotation

BALL = Ball((0.1, 0.5, 1.6), 0.7, radius=0.5)
GAMMA = np.array([2, 3, 6]) / 7
K = np.array([0.6, -0.5, 0.6])
ORDERS = (2, 4, 6, 8)
ROUNDOFF = 2.0**-53


def rolled(order, ball=BALL, momentum=0.1 * K, gamma=GAMMA, steps=200, **options):
    return chapsym.trajectory(ball, momentum, gamma, steps, order=order, **options)


def growth(order, ball, momentum, gamma, steps):
    """By how much the run stretches a small change of its start, by six nudges of 1e-7: its condition."""
    nudge, size = 1e-7, np.abs(momentum).max()
    ends = [rolled(order, ball, momentum, gamma, steps, every=steps)]
    for axis in np.eye(3):
        ends.append(rolled(order, ball, momentum + nudge * size * axis, gamma, steps, every=steps))
        turned = gamma + nudge * np.cross(axis, gamma)
        ends.append(rolled(order, ball, momentum, turned / np.sqrt(turned @ turned), steps, every=steps))
    states = [np.concatenate([end.momentum[-1] / size, end.gamma[-1]]) for end in ends]
    return max(np.abs(state - states[0]).max() for state in states[1:]) / nudge


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("steps", [100, 1000])
@pytest.mark.parametrize("case", range(4))
def test_the_way_back_is_within_the_roundoff_budget(order, steps, case):
    """Each stage, there and back, rounds by about 2⁻⁵³, as a random walk, and the flow stretches that by `growth`.

    So the budget is 2⁻⁵³·√(2·stages)·(1 + growth), times 2 for the worst of ten components; 0.4 of it was measured.
    """
    rng = np.random.default_rng(case)
    ball, momentum, gamma = BALL, 0.2 * K, GAMMA
    if case:
        ball, momentum = Ball(rng.uniform(0.1, 2, 3), [0.0, 0.5, 3.0][case - 1]), 0.2 * rng.normal(size=3)
        gamma = rng.normal(size=3)
        gamma /= np.sqrt(gamma @ gamma)
    run = rolled(order, ball, momentum, gamma, steps, attitude=True, every=steps // 10)
    back = chapsym.reverse(run)
    stages = steps * len(chapsym.substeps(order))
    budget = 2 * ROUNDOFF * np.sqrt(2 * stages) * (1 + growth(order, ball, momentum, gamma, steps))
    error = chapsym.retrace_error(run, back)
    assert error[-1] <= ROUNDOFF * 4  # where it turns there is the rounding of one renormalisation
    assert error.max() <= budget
    assert error.max() > 0


@pytest.mark.parametrize("order", ORDERS)
def test_what_comes_back_is_a_motion_with_the_opposite_momentum(order):
    run = rolled(order, contact=True, every=20, time_step=0.05)
    back = chapsym.reverse(run)
    assert type(back) is type(run)
    assert getattr(back, "order", 2) == order
    assert back.index.tolist() == run.index.tolist()
    assert back.time[-1] == run.time[-1] == pytest.approx(10)
    assert (back.momentum[0] == -run.momentum[-1]).all()
    assert (back.gamma[0] == run.gamma[-1]).all()
    assert back.momentum[::-1] == pytest.approx(-run.momentum, abs=1e-12)
    assert back.gamma[::-1] == pytest.approx(run.gamma, abs=1e-12)
    assert back.attitude[::-1] == pytest.approx(run.attitude, abs=1e-12)
    assert back.contact[::-1] == pytest.approx(run.contact, abs=1e-12)
    assert (back.contact[0] == run.contact[-1]).all()
    # It is a run of the map: the step from each frame is the one that `rolled` takes.
    again = rolled(order, momentum=back.momentum[0], gamma=back.gamma[0], every=20)
    assert (again.gamma == back.gamma).all()
    assert back.kinetic_energy()[::-1] == pytest.approx(run.kinetic_energy(), rel=1e-11)


def test_it_starts_from_the_last_frame_that_is_there():
    run = rolled(2, steps=103, every=10)
    back = chapsym.reverse(run)
    assert back.index.tolist() == list(range(0, 101, 10))
    assert back.momentum[-1] == pytest.approx(-run.momentum[0], abs=1e-13)
    assert back.attitude is None
    assert back.contact is None


@given(certified((0.05, 0.9)))
@examples(40)
def test_below_the_bound_of_small_branch_the_step_back_is_the_conjugate(state):
    """What `self-adjoint` says of the small-rotation branch, for every ball, degenerate ones too."""
    ball, momentum, gamma = state
    there = chapsym.step(ball, momentum, gamma)
    back = chapsym.step(ball, -there.momentum, there.gamma)
    # D/J is up to 1e5 here, and costs as many digits.
    assert back.rotation == pytest.approx(there.rotation * [1, -1, -1, -1], abs=1e-9)


#: A step at 0.99 of the momentum at which the branch folds.
AT_FOLD = Ball((0.01, 0.50138051, 1.10781774), 2.0), np.array([-1.12794321, 0.23309294, 1.16232201])
VERTICAL = np.array([0.62552509, 0.58911308, -0.51153118])
VERTICAL /= np.sqrt(VERTICAL @ VERTICAL)


def test_a_step_back_on_another_branch_is_told():
    """Both rotations solve the step back, and the small branch leads to the other one: see lemma `self-adjoint`."""
    ball, momentum = AT_FOLD
    there = chapsym.step(ball, momentum, VERTICAL)
    parameters = (*ball.mass_tensor, float(ball.D))
    conjugate = there.rotation * [1, -1, -1, -1]
    assert kernels.momentum(conjugate, there.gamma, ball.mass_tensor, ball.D) == pytest.approx(
        -there.momentum, abs=1e-14
    )
    status, _, *small = small_rotation(*-there.momentum, *there.gamma, *parameters)
    assert status == 0
    assert np.abs(small - conjugate).max() > 1e-3
    run = chapsym.trajectory(ball, momentum, VERTICAL, 1)
    with pytest.raises(NotRetraced, match="does not undo the step 0: it is so near a fold") as caught:
        chapsym.reverse(run)
    assert caught.value.index == 0
    assert caught.value.balls == [()]
    assert len(caught.value.trajectory.momentum) == 2
    again = pickle.loads(pickle.dumps(caught.value))
    assert (again.index, again.balls, str(again)) == (0, [()], str(caught.value))


def test_a_batch_tells_which_balls_do_not_come_back():
    ball, momentum = AT_FOLD
    run = chapsym.trajectory(ball, [0.1 * momentum, momentum, 0.2 * momentum], VERTICAL, 1)
    with pytest.raises(NotRetraced, match=r"undo the step 0 \(of the first of the balls \(1,\)\): ") as caught:
        chapsym.reverse(run)
    assert caught.value.balls == [(1,)]
    assert chapsym.retrace_error(run, caught.value.trajectory)[[0, 2], 0].max() < 1e-14


@pytest.mark.parametrize("order", [2, 4])
def test_what_rounding_does_to_an_unstable_rotation_is_no_other_branch(order):
    """About the middle axis a rounding grows exponentially: the way back is another one, but each step is right."""
    run = rolled(order, Ball((0.1, 0.5, 1.6), 0), np.array([1e-9, 0.3, 1e-9]), GAMMA, 600, every=30)
    back = chapsym.reverse(run)
    error = chapsym.retrace_error(run, back)
    assert error.max() > 1e-4
    assert error[-2] < 1e-12


def test_what_cannot_be_reversed():
    with pytest.raises(BadInput, match="no frame besides its first"):
        chapsym.reverse(rolled(2, steps=0))
    with pytest.raises(BadInput, match="run must be a Trajectory, not Step"):
        chapsym.reverse(chapsym.step(BALL, 0.1 * K, GAMMA))
    heavy, far = Ball((1, 2, 4), 3), np.array([4.32, -2.16, 3.24])
    with pytest.raises(BadInput, match="stopped early"):
        chapsym.reverse(chapsym.trajectory(heavy, [far, 0.1 * far], GAMMA, 10))


def test_the_error_is_that_of_each_part():
    """An error of 0.25 in one component of one part, beside the frame that it belongs to."""
    run = rolled(2, steps=5, attitude=True)
    back = chapsym.reverse(run)
    size = np.abs(run.momentum).max()
    for name, scale in (("momentum", size), ("gamma", 1), ("attitude", 1)):
        changed = getattr(back, name).copy()
        changed[4, 1] += 0.25 * scale
        error = chapsym.retrace_error(run, replace(back, **{name: changed}))
        assert error[1] == pytest.approx(0.25, abs=1e-14)
        assert error[[0, 2, 3, 4, 5]].max() < 1e-14


def test_a_ball_at_rest_comes_back():
    run = rolled(2, momentum=0 * K)
    assert (chapsym.retrace_error(run, chapsym.reverse(run)) == 0).all()
