"""The discrete top at any step at once: against the map in double-double, against the full model, and its own parts."""

from fractions import Fraction
from math import isqrt

import numpy as np
import pytest
from budget import slow
from hypothesis import assume, given
from hypothesis import strategies as st

from chapsym import BadInput, Ball, Status, StepNotTaken, TopMotion, is_top, testing, top_frames, trajectory

ULP = 2.0**-52
GAMMA = np.array([2 / 7, 3 / 7, 6 / 7])
TOP, TINY = Ball((1, 2, 4), 0.0), 2.0**-500


def upright(height, gamma):
    """𝒦 = hγ/|γ| as fractions, of which double-double keeps 106 bits: the rounding of hγ turns by an ulp a step."""
    g = [Fraction(float(x)) for x in gamma]
    square = sum(x * x for x in g)
    length = Fraction(isqrt(int(square * 4**160)), 2**160)
    return [Fraction(float(height)) * x / length for x in g]


def far_from(run, found):
    """How far frames are from a double-double run: of |𝒦|, and of 1 for γ and the attitude (up to its sign)."""
    size = np.abs(run.momentum).max()
    sign = np.sign((run.attitude * found.attitude).sum(axis=-1, keepdims=True))
    parts = [((found.momentum - run.momentum) - run.low.momentum) / size,
             (found.gamma - run.gamma) - run.low.gamma,
             sign * found.attitude - run.attitude - run.low.attitude]  # fmt: skip
    first, *others = (np.abs(part).max() for part in parts)
    return np.array([first, max(others)])


def budget(motion):
    """8 ulps, and what an ulp of u is, for every k: a period is 4K, and |dγ/du| ≤ 1.

    The body turns about 𝒦 by 1/(Λmin V) at most while u moves by 1; and 2/k' for b near the unstable axis.
    """
    curve = motion.curve
    momentum = 8 + 4 * curve.period
    turns = 1 / (min(curve.inertia) * abs(curve.rate))
    return np.array([momentum, momentum * max(1, turns) + 2 / curve.complement]) * ULP


@st.composite
def free_tops(draw):
    """(ball, 𝒦, γ) with D = 0, 𝒦 up to 0.9 of the least moment, units from 1e-100 to 1e100."""
    unit = 10.0 ** draw(st.sampled_from([-100, -3, 0, 0, 0, 2, 100]))
    J = draw(testing.mass_tensors(("generic", "generic", "degenerate")).filter(lambda J: np.ptp(J) > 1e-6))
    moments = J.sum() - J
    off_axes = draw(st.tuples(*[st.floats(0.01, 1)] * 3)) * np.array(draw(st.tuples(*[st.sampled_from([1, -1])] * 3)))
    momentum = draw(st.floats(1e-6, 0.9)) * moments.min() * off_axes / np.linalg.norm(off_axes)
    return Ball(unit * J, 0.0), unit * momentum, draw(testing.unit_vectors())


@given(free_tops(), st.integers(1, 300))
def test_every_frame_of_a_free_top_is_that_of_the_map(state, every):
    ball, momentum, gamma = state
    assert is_top(ball, momentum, gamma)
    motion = TopMotion.free(ball, momentum)
    assume(motion.curve.complement > 1e-4)
    run = trajectory(ball, momentum, gamma, 4 * every, every=every, attitude=True, precision="double-double")
    found = top_frames(ball, momentum, gamma, run.index, attitude=True)
    assert (far_from(run, found) <= budget(motion)).all()
    assert (found.taken, found.status) == (4 * every, Status.TAKEN)


@st.composite
def symmetric_balls(draw):
    """(ball, h, γ): two J equal, the third not; h up to 0.9 of the least moment; γ off the axis and its plane."""
    axis, other = draw(st.integers(0, 2)), draw(st.floats(0.1, 4))
    J = np.full(3, other)
    J[axis] *= 1 + draw(st.floats(-0.9, -1e-6) | st.floats(1e-6, 9.0))
    ball = Ball(J, draw(st.floats(0, 50)))
    tilt, turn = draw(st.floats(0.01, 1.56)), draw(st.floats(0.01, 6.27))
    gamma = np.roll([np.cos(tilt), np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn)], axis)
    part = draw(st.floats(1e-6, 0.9)) * draw(st.sampled_from([1, -1]))
    return ball, part * ball.inertia.min(), gamma / np.linalg.norm(gamma)


@given(symmetric_balls(), st.integers(1, 300))
def test_vertical_momentum_on_a_ball_with_two_equal_moments(state, every):
    ball, height, gamma = state
    assume(is_top(ball, height * gamma, gamma))  # one in 200 is an ulp more off the vertical than it takes
    run = trajectory(
        ball, upright(height, gamma), gamma, 4 * every, every=every, attitude=True, precision="double-double"
    )
    motion = TopMotion.vertical(ball, height, gamma)
    assert np.abs(motion.directions(run.index) - run.gamma).max() <= budget(motion)[0]
    found = top_frames(ball, height * gamma, gamma, run.index, attitude=True)
    assert (far_from(run, found) <= budget(motion) + 8 * run.index[-1] * ULP).all()  # the rounding of hγ


@pytest.mark.parametrize(
    ("ball", "momentum"),
    [
        (TOP, (0.1, 2, 0.06)),  # the other side of the separatrix is 0.05
        (TOP, (0.1, 2, 0.04)),
        (TOP, (1, 1e-30, 2e-30)),
        (Ball((1, 1 + 1e-15, 4), 0), (1, -0.5, 0.75)),
        (Ball((1e100, 2e100, 5e99), 0), (0, 7.5e99, 4e92)),
        # Units as small and as large as those of the map.
        (Ball(TINY * np.array([1, 1 + 2.0**-52, 4]), 0), TINY * np.array([0.3, -0.2, 0.5])),
        (Ball(np.array([1, 1 + 2.0**-52, 1 + 2.0**-50]) / TINY, 0), np.array([0.3, -0.2, 0.5]) / TINY),
        *slow((TOP, (1, -0.5, 0.75)), (Ball((1, 1, 4), 0), (1, -0.5, 0.75))),
        *slow((Ball((1e100, 2e100, 4e100), 0), (1e100, -5e99, 7e99))),
        *slow((TOP, (-0.01, -0.005, 0.0075)), (TOP, (1e-200, -5e-201, 7e-201)), (Ball((1, 4, 4), 0), (-1, -0.5, 0.75))),
    ],
)
@pytest.mark.parametrize("gamma", [GAMMA, pytest.param(-GAMMA, marks=pytest.mark.thorough)])
def test_after_many_steps_nothing_has_added_up(ball, momentum, gamma, thorough):
    steps = 10**6 if thorough else 10**5
    run = trajectory(ball, momentum, gamma, steps, every=steps // 4, attitude=True, precision="double-double")
    found = top_frames(ball, momentum, gamma, run.index, attitude=True)
    assert (far_from(run, found) <= budget(TopMotion.free(ball, momentum))).all()


def test_the_phase_and_the_rotation_number():
    motion = TopMotion.free(TOP, (1, -0.5, 0.75))
    run = trajectory(TOP, (1, -0.5, 0.75), GAMMA, 1000)
    u = np.unwrap(motion.curve.argument(run.momentum / np.sqrt(21 / 16 + 0.5)), period=motion.curve.period)
    assert (u[-1] - u[0]) / motion.curve.period / 1000 == pytest.approx(motion.rotation_number, abs=1e-15)
    there = np.remainder(motion.phase(np.arange(1001)) - u + 1, motion.curve.period) - 1
    assert np.abs(there).max() <= 1000**1.5 * ULP
    back = TopMotion.vertical(TOP, -0.4, GAMMA)
    assert back.rotation_number == -TopMotion.vertical(TOP, 0.4, GAMMA).rotation_number


def test_a_batch_is_its_balls():
    J, D = np.array([[1, 2, 4], [1, 1, 4], [1, 2, 4]]), np.array([0.0, 3.0, 0.0])
    momentum = np.array([[0.5, -0.5, 0.75], 0.5 * GAMMA, [3, 4, 4]])
    whole = top_frames(Ball(J, D), momentum, GAMMA, [0, 9, 10**6], attitude=True, time_step=0.5)
    assert whole.status.tolist() == trajectory(Ball(J, D), momentum, GAMMA, 1).status.tolist() == [0, 0, 3]
    assert whole.taken.tolist() == [10**6, 10**6, 0]
    assert np.isnan(whole.attitude[2, 1:]).all()
    assert np.isfinite(whole.attitude[2, 0]).all()
    assert (whole.momentum[:, 0] == momentum).all()
    assert (whole.gamma[:, 0] == GAMMA).all()
    for i in range(2):
        one = top_frames(Ball(J[i], D[i]), momentum[i], GAMMA, [0, 9, 10**6], attitude=whole.attitude[i, 0])
        for name in ("momentum", "gamma", "attitude"):
            assert (getattr(whole, name)[i] == getattr(one, name)).all()
    plain = top_frames(Ball(J, D), momentum, GAMMA, [0, 9, 10**6])
    assert plain.attitude is None
    assert np.array_equal(plain.gamma, whole.gamma, equal_nan=True)
    with pytest.raises(StepNotTaken) as words:
        top_frames(Ball(J[2], D[2]), momentum[2], GAMMA, [0, 9])
    assert (words.value.status, words.value.index) == (Status.UNREACHABLE, 0)
    assert len(words.value.trajectory.index) == 1


def test_which_states_are_tops():
    assert not is_top(Ball((1, 2, 4), 1e-300), 0.5 * GAMMA, GAMMA)
    assert not is_top(Ball((1, np.nextafter(1, 2), 4), 3), 0.5 * GAMMA, GAMMA)
    assert not is_top(Ball((1, 1, 4), 3), 0.5 * GAMMA + [1e-15, 0, 0], GAMMA)
    assert not is_top(Ball((1, 1, 1), [0, 3]), 0.5 * GAMMA, GAMMA).any()  # they are steady
    assert not is_top(TOP, [[0, 0, 0], [0, 1, 0]], GAMMA).any()
    assert is_top(Ball((1, 1, 4), 3), -0.5 * GAMMA, GAMMA)
    assert is_top(TOP, (1e-300, 2e-300, 1e-300), GAMMA)
    assert not is_top(TOP, (1e-41, 1, 0), GAMMA)


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: top_frames(Ball((1, 2, 4), 3), 0.5 * GAMMA, GAMMA, [1]), "no top whose frames"),
        (lambda: TopMotion.free(Ball((1, 2, 4), 3), GAMMA), "no free top"),
        (lambda: TopMotion.free(TOP, (0, 0, 0)), "must not vanish"),
        (lambda: TopMotion.free(TOP, (0, 1, 0)), "fixes this direction"),
        (lambda: TopMotion.free(TOP, (0, 1, 1e-45)), "nearly so"),
        (lambda: TopMotion.free(TOP, [GAMMA, GAMMA]), "not of a batch"),
        (lambda: TopMotion.free(TOP, (0.1, 2, 0.05)), "separatrix"),
        (lambda: TopMotion.vertical(Ball((1, 2, 4), 3), 0.5, GAMMA), "two J are equal"),
        (lambda: TopMotion.vertical(TOP, 0.0, GAMMA), "not 0"),
    ],
)
def test_bad_input_is_told(call, sentence):
    with pytest.raises(BadInput, match=sentence):
        call()


@pytest.mark.parametrize("apart", [1e-15, 1e-13, -1e-11, 1e-8])
def test_next_to_the_separatrix_the_curve_is_that_of_the_momentum(apart):
    """k'² is as small as the roundings of 𝒦/|𝒦|: those must not be of the curve."""
    ball = Ball((0.3, 1.3, 0.05), 0.0)
    moments = ball.inertia
    a, b, c = np.argsort(-moments)
    momentum = np.empty(3)
    momentum[c] = np.sqrt((ball.mass_tensor[b] - ball.mass_tensor[a]) / moments[a])
    momentum[a] = np.sqrt((ball.mass_tensor[c] - ball.mass_tensor[b]) / moments[c]) * (1 + apart)
    momentum[b] = 0.1
    momentum *= 1e-3
    run = trajectory(ball, momentum, (0, 0, 1), 3000, every=500, precision="double-double")
    motion = TopMotion.free(ball, momentum)
    assert motion.curve.complement < 2 * np.sqrt(abs(apart)) + 1e-7
    far = np.abs(motion.momenta(run.index) - run.momentum).max() / np.abs(momentum).max()
    assert far <= budget(motion)[0]
