"""Steady rotation: every frame at once, against the map in double-double and the full model."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from chapsym import BadInput, Ball, Status, StepNotTaken, is_steady, steady_frames, testing, trajectory
from chapsym.dynamics import kernels

ULP = 2.0**-52
GAMMA = np.array([2 / 7, 3 / 7, 6 / 7])
#: What a frame may be off by: cos, sin, the axis and the turn, in ulps of the vector; no step number is in it.
BUDGET = 6 * ULP


def far_from(run, frames):
    """How far frames are from a double-double run: of |𝒦|, of 1, of 1, and of the length of the path."""
    size = np.sqrt((run.momentum**2).sum(axis=-1)).max() or 1.0
    parts = [np.abs((frames.momentum - run.momentum) - run.low.momentum).max() / size,
             np.abs((frames.gamma - run.gamma) - run.low.gamma).max()]  # fmt: skip
    if run.attitude is not None:
        parts.append(np.abs((frames.attitude - run.attitude) - run.low.attitude).max())
    if run.contact is not None:
        path = np.pi / 2 * float(run.ball.radius) * max(int(run.index[-1]), 1)
        parts.append(np.abs((frames.contact - run.contact) - run.low.contact).max() / path)
    return max(parts)


@st.composite
def steady_states(draw):
    """(ball, 𝒦, γ): equal moments with any 𝒦, γ, or a principal axis; sin θ up to 0.99, units from 1e-100 to 1e100."""
    unit = 10.0 ** draw(st.sampled_from([-100, -3, 0, 0, 0, 2, 100]))
    sine = draw(st.floats(0.0, 0.99))
    if draw(st.booleans()):
        J, D = draw(st.floats(0.05, 4.0)), draw(st.sampled_from([0.0, 0.3, 2.0, 1e3]))
        gamma, axis = draw(testing.unit_vectors()), draw(testing.unit_vectors())
        momentum = sine * ((2 * J + D) * axis - D * (axis @ gamma) * gamma)
        return Ball(unit * np.array([J, J, J]), unit * D, radius=0.5), unit * momentum, gamma
    J = draw(testing.mass_tensors(("generic",)))
    sign = draw(st.sampled_from([-1.0, 1.0]))
    if draw(st.booleans()):  # rolling straight about a level axis
        i, D, angle = int(J.argmin()), draw(st.floats(0.0, 30.0)), draw(st.floats(0.0, 6.3))
        gamma = np.roll([0.0, np.cos(angle), np.sin(angle)], i)
        J[i] = J.max()
        momentum = sign * sine * (J.sum() - J[i] + D) * np.eye(3)[i]
        return Ball(unit * J, unit * D, radius=0.5), unit * momentum, gamma
    i, D = int(np.argsort(J)[draw(st.sampled_from([0, 2]))]), draw(st.sampled_from([0.0, 0.7, 3.0]))
    axis = np.eye(3)[i] * sign
    gamma = axis * draw(st.sampled_from([-1.0, 1.0])) if D else draw(testing.unit_vectors())
    return Ball(unit * J, unit * D, radius=0.5), unit * sine * (J.sum() - J[i]) * axis, gamma


@given(steady_states(), st.integers(1, 400))
def test_every_frame_is_that_of_the_map(state, every):
    ball, momentum, gamma = state
    gamma = np.where(abs(gamma) < 1e-150, 0.0, gamma)  # a half turn about what squares to 0 has no axis
    assert is_steady(ball, momentum, gamma)
    run = trajectory(ball, momentum, gamma, 4 * every, every=every, contact=True, precision="double-double")
    found = steady_frames(ball, momentum, gamma, run.index, contact=True)
    assert far_from(run, found) <= BUDGET
    assert (found.taken, found.status) == (4 * every, Status.TAKEN)


@pytest.mark.parametrize(
    ("J", "D", "momentum", "gamma"),
    [
        ((1, 1, 1), 3.0, (0.5, -1.5, 0.75), GAMMA),
        ((1, 2, 4), 0.0, (-2, 0, 0), GAMMA),
        ((1, 2, 4), 3.0, (0, 0, -2.5), (0, 0, 1)),
    ],
)
def test_after_many_steps_nothing_has_added_up(J, D, momentum, gamma, thorough):
    """The same budget."""
    steps = 10**6 if thorough else 10**5
    ball = Ball(J, D, radius=0.3)
    run = trajectory(ball, momentum, gamma, steps, every=steps // 4, contact=True, precision="double-double")
    found = steady_frames(ball, momentum, gamma, run.index, contact=True)
    assert far_from(run, found) <= BUDGET


def test_from_the_middle_axis_no_rounding_leads_away():
    """As the map in double-double for 20 steps, which a rounding there leaves; and on the axis for ever."""
    ball, momentum = Ball((1, 2, 4), 0.0, radius=0.3), (0.0, -2.0, 0.0)
    run = trajectory(ball, momentum, GAMMA, 20, contact=True, precision="double-double")
    assert far_from(run, steady_frames(ball, momentum, GAMMA, run.index, contact=True)) <= BUDGET
    assert (steady_frames(ball, momentum, GAMMA, [10**6]).momentum == momentum).all()


def test_frames_do_not_know_of_each_other():
    """Step 10¹⁴ is the same alone and among others, and frame 0 is the start to the bit."""
    ball, momentum = Ball((1, 1, 1), 3.0), (0.5, -1.5, 0.75)
    near = steady_frames(ball, momentum, GAMMA, [0, 7, 10**14, 2 * 10**14])
    alone = steady_frames(ball, momentum, GAMMA, [10**14])
    assert (alone.gamma[0] == near.gamma[2]).all()
    assert (near.momentum[0] == momentum).all()
    assert (near.gamma[0] == GAMMA).all()


def test_a_batch_is_its_balls():
    J = np.array([[1.0, 1.0, 1.0], [2.0, 2.0, 2.0], [1.0, 2.0, 4.0], [1.0, 2.0, 4.0]])
    momentum = np.array([[0.5, -0.5, 0.75], [0, 0, 0], [0, 2.0, 0], [3.5, 0, 0]])
    gamma = np.array([GAMMA, -GAMMA, [0, -1, 0], [1, 0, 0]])
    balls, index = Ball(J, 3.0, radius=0.1), [0, 3, 1000]
    whole = steady_frames(balls, momentum, gamma, index, contact=True, time_step=0.5)
    assert whole.time.tolist() == [0.0, 1.5, 500.0]
    for i in range(4):
        one = steady_frames(Ball(J[i], 3.0, radius=0.1), momentum[i], gamma[i], index, contact=True)
        for name in ("momentum", "gamma", "attitude", "contact"):
            assert (getattr(whole, name)[i] == getattr(one, name)).all()
    assert (whole.momentum[1] == 0).all()
    assert (whole.contact[1:] == 0).all()  # at rest, or spinning on the spot
    turned = [np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)]  # about e₃ in space, which R γ = e₃ allows
    other = steady_frames(balls, momentum, gamma, index, attitude=kernels.compose(turned, whole.attitude[:, 0]))
    assert np.abs(other.attitude - kernels.compose(turned, whole.attitude)).max() <= BUDGET


def test_the_fold_is_where_the_map_says():
    """A quarter turn: 2|w| = 1; in a batch the others go on."""
    balls, gamma = Ball([[1, 1, 1], [1, 1, 1], [1, 2, 4]], [3, 3, 3]), np.array([GAMMA, [0, 0, 1], [0, 0, 1]])
    momentum = np.array([GAMMA * 2.0001, [0.0, 0.0, 1.9999], [0.0, 0.0, 3.1]])
    run = steady_frames(balls, momentum, gamma, [0, 5])
    full = trajectory(balls, momentum, gamma, 5)
    assert run.status.tolist() == full.status.tolist()
    assert run.taken.tolist() == [0, 5, 0]
    assert np.isnan(run.gamma[[0, 2], 1]).all()
    assert (run.gamma[:, 0] == gamma).all()
    with pytest.raises(StepNotTaken) as words:
        steady_frames(Ball((1, 1, 1), 3), (3, 0, 0), (1, 0, 0), [0, 5])
    assert words.value.index == 0
    assert words.value.reach == pytest.approx(2 / 3, rel=1e-12)
    assert len(words.value.trajectory.index) == 1


def test_there_is_no_tolerance():
    assert not is_steady(Ball((1, 1, np.nextafter(1, 2)), 3), (0.1, 0.2, 0.1), GAMMA)
    assert not is_steady(Ball((1, 2, 4), 3), (1e-300, 0.2, 0), (0, 1, 0))
    assert not is_steady(Ball((1, 2, 4), 3), (0, 0.2, 0), GAMMA)
    assert is_steady(Ball((1, 2, 4), 3), (0.2, 0, 0), (0, 0.6, 0.8))
    assert not is_steady(Ball((0.1, 0.1, 4), 3), (0.2, 0, 0), (0, 0.6, 0.8))  # √2·3.9 > 0.2 + 4.1
    assert is_steady(Ball((1, 2, 4), [3, 0]), [[0, 0, 0], [0, 1, 0]], GAMMA).tolist() == [True, True]
    for ball, momentum in ((Ball((1, 1, 2), 3), (0.1, 0.2, 0.1)), (Ball((1, 2, 4), 3), (0, 0.2, 0))):
        with pytest.raises(BadInput, match="does not rotate steadily"):
            steady_frames(ball, momentum, GAMMA, [0, 1])


@pytest.mark.parametrize("index", [[], [1.0], [[1]], [[1, 2], [3]], [-1], [1, 1], [2, 1], [2**63 - 1]])
def test_step_numbers_ascend_and_a_contact_point_needs_a_radius(index):
    with pytest.raises(BadInput, match="index must"):
        steady_frames(Ball((1, 1, 1), 3), (0.1, 0.2, 0.1), GAMMA, index)
    with pytest.raises(BadInput, match="radius"):
        steady_frames(Ball((1, 1, 1), 3), (0.1, 0.2, 0.1), GAMMA, [0], contact=True)
    with pytest.raises(StepNotTaken) as words:
        steady_frames(Ball((1, 0, 0), 3), (0.1, 0, 0), (1, 0, 0), [1])  # a rod about itself
    assert words.value.status is Status.NO_INERTIA


@pytest.mark.parametrize("options", [{}, {"attitude": True}, {"contact": True}])
def test_no_balls_have_no_frames(options):
    none = np.zeros((0, 3))
    assert steady_frames(Ball((1, 1, 1), 0, 0.5), none, none, [0, 5], **options).momentum.shape == (0, 2, 3)
