"""The motion between the frames of a run: its order, its frames, and what it refuses."""

from dataclasses import replace

import numpy as np
import pytest

import chapsym
from chapsym.dynamics import kernels
from chapsym.numbers import Digits, Enclosure

BALL = chapsym.Ball.from_inertia((0.006, 0.007, 0.009), mass=2.0, radius=0.1)
FINEST = 768


def rolled(frames):
    """Two seconds of the continuous ball, to rounding, in so many frames."""
    return chapsym.roll(
        BALL, (6.0, -4.0, 2.0), 2.0 / FINEST / 4, 4 * FINEST, every=4 * FINEST // frames, gamma=(2 / 7, 3 / 7, 6 / 7),
        order=8, attitude=True, contact=True,
    )  # fmt: skip


def errors(found, true):
    """The largest error of γ, ω, attitude (up to its sign) and contact point in radii."""
    omega = kernels.angular_velocity(true.angular_momentum(), true.gamma, BALL.mass_tensor, BALL.D)
    sign = np.sign((found.attitude * true.attitude).sum(axis=-1, keepdims=True))
    pairs = (found.gamma, true.gamma), (found.omega, omega), (found.attitude * sign, true.attitude)
    far = (found.contact - true.contact) / BALL.radius
    return np.array([np.abs(a - b).max() for a, b in pairs] + [np.abs(far).max()])


def test_between_the_frames_the_error_falls_by_two_to_the_sixth_where_the_time_between_them_is_halved():
    true = rolled(FINEST)
    found = np.array([errors(rolled(n).at(true.time), true) for n in (24, 48, 96)])
    turn = 2.0 / 24 * np.sqrt(62.0)
    assert found[0, [0, 2, 3]].max() < turn**6 / 46080
    orders = np.log2(found[:-1] / found[1:])
    assert orders[-1] == pytest.approx(6.0, abs=0.2)
    assert (np.abs(orders - 6.0) < 0.4).all()


def test_at_the_frames_it_is_the_run_and_one_time_has_no_axis():
    run = rolled(48)
    found = run.at(run.time)
    assert (found.contact == run.contact).all()
    assert found.momentum == pytest.approx(run.momentum, rel=1e-15)
    assert found.gamma == pytest.approx(run.gamma, rel=1e-15)
    one = run.at(0.123)
    assert one.gamma.shape == one.omega.shape == (3,)
    assert one.attitude @ one.attitude == pytest.approx(1.0, abs=1e-15)
    assert kernels.rotate(one.attitude, one.gamma) == pytest.approx([0.0, 0.0, 1.0], abs=1e-6)
    assert run.at([]).gamma.shape == (0, 3)


def test_steps_are_the_clock_of_a_run_without_time():
    run = chapsym.trajectory(BALL, (4e-4, -3e-4, 2e-4), (2 / 7, 3 / 7, 6 / 7), 40, attitude=True)
    found = run.at([0.0, 0.5, 40.0])
    assert found.momentum[-1] == pytest.approx(run.momentum[-1], rel=1e-15)
    assert found.contact is None
    assert found.omega[0] == pytest.approx(
        kernels.angular_velocity(run.momentum[0], run.gamma[0], BALL.mass_tensor, BALL.D)
    )


def test_a_ball_of_a_batch_that_stopped_is_nan_behind_its_last_frame_and_the_others_go_on():
    ball, gamma = chapsym.Ball((0.1, 0.5, 1.6), 0.7, 0.1), (2 / 7, 3 / 7, 6 / 7)
    run = chapsym.trajectory(ball, [(0.5, 0.3, 0.2), (1.44, 0.96, 0.3)], gamma, 300, contact=True)
    last = int(run.taken[1])
    found = run.at([last - 0.5, last, last + 0.5, 300.0])
    for array in (found.momentum, found.gamma, found.omega, found.attitude, found.contact):
        assert np.isfinite(array[0]).all()
        assert (np.isfinite(array[1]).all(axis=-1) == [True, True, False, False]).all()


def test_without_the_attitude_the_points_of_contact_of_a_batch_are_nearly_those_with_it():
    """The momentum fixes the directions in the plane up to one angle, and the run that angle: 2.4e-9 m were seen."""
    ball = chapsym.Ball.from_inertia([(0.006, 0.007, 0.009)] * 2, mass=[2.0] * 2, radius=[0.1] * 2, batch=True)
    run = chapsym.roll(ball, [(3, -2, 1), (1, 2, 3)], 0.1, 10, contact=True)
    found = replace(run, attitude=None).at([0.05, 0.33])
    assert np.abs(found.contact - run.at([0.05, 0.33]).contact).max() < 1e-8


@pytest.mark.parametrize(
    ("mass", "length", "time"),
    [(2.0**600, 1.0, 1.0), (2.0**-100, 2.0**-150, 2.0**300), (2.0**-600, 2.0**100, 2.0**-350)],
)
@pytest.mark.parametrize("outputs", [{}, {"attitude": None}])
def test_no_unit_changes_a_bit(mass, length, time, outputs):
    """Powers of two, in which products of the numbers of the run are beyond float64."""
    run, moment = replace(rolled(48), **outputs), mass * length**2
    ball = chapsym.Ball(BALL.mass_tensor * moment, BALL.D * moment, BALL.radius * length)
    step = run.time_step * time
    other = replace(run, ball=ball, momentum=run.momentum * moment, time_step=step, contact=run.contact * length)
    found, there = run.at([0.1, 1.23]), other.at(np.array([0.1, 1.23]) * time)
    assert (there.momentum == found.momentum * moment).all()
    assert (there.omega == found.omega / time).all()
    assert (there.gamma == found.gamma).all()
    assert (there.contact == found.contact * length).all()
    energy, known = (one.to_xarray().energy.values for one in (other, run))
    assert (energy == known * moment / time**2).all()


@pytest.mark.parametrize("times", [-0.1, [0.0, 2.1], np.nan, "soon", [[0.0]]])
def test_a_time_that_is_none_of_the_run_is_refused(times):
    with pytest.raises(chapsym.BadInput, match="times must"):
        rolled(48).at(times)


def test_a_run_of_no_frames_has_nothing_between_them():
    run = rolled(48)
    none = {name: getattr(run, name)[:0] for name in ("index", "momentum", "gamma", "attitude", "contact")}
    with pytest.raises(chapsym.BadInput, match="the run has none"):
        replace(run, **none).at(0.0)


def test_the_last_time_in_decimals_is_that_of_the_last_frame():
    run = chapsym.roll(BALL, (3, -2, 1), 0.35, 3)
    assert run.time[-1] < 1.05  # 3 times 0.35 in float64
    assert (run.at(1.05).gamma == run.at(run.time[-1]).gamma).all()


def test_frames_too_far_apart_tell_nothing_of_what_is_between():
    with pytest.raises(chapsym.BadInput, match=r"up to 1\.96 radians of turning apart.*at most 1\.5.*smaller `every`"):
        rolled(8).at(1.0)


@pytest.mark.parametrize("precision", ["single", Digits(20), Enclosure(80)])
def test_every_precision_is_read_in_float64(precision):
    run = chapsym.roll(BALL, (6.0, -4.0, 2.0), 0.01, 20, contact=True, precision=precision)
    found = run.at(0.105)
    assert found.contact.dtype == np.float64
    assert found.contact == pytest.approx(run.at(run.time).contact[10:12].mean(axis=0), abs=1e-5)
