"""The map in n dimensions at N digits: that of three dimensions by other code, and what it keeps."""

import numpy as np
import pytest
from balls_n import batch
from budget import slow

import chapsym
from chapsym import Ball, BallN, Digits, Enclosure, reverse_n, skew, step_n, trajectory_n
from chapsym.dynamics import BadInput, Status


def distance(a, b):
    return float(np.abs(a - b).max())


@pytest.fixture(params=[3, *slow(4), 5])
def state(request):
    """A ball, 𝒦 and γ of a rotation by some tenths."""
    ball, K, gamma = batch(request.param, 1, 0.2)
    return BallN(ball.mass_tensor[0], ball.D[0], 1.0), K[0], gamma[0]


@pytest.mark.parametrize("order", [2, 6])
def test_in_three_dimensions_it_is_the_map_of_three_dimensions(order):
    J, K, g = (1.0, 2.0, 4.0), np.array([0.5, -0.25, 0.375]), np.array([2.0, 3.0, 6.0]) / 7
    options = {"order": order, "contact": True, "precision": Digits(40)}
    one = chapsym.trajectory(Ball(J, 3.0, 0.5), K, g, 6, **options)
    other = trajectory_n(BallN(J, 3.0, 0.5), skew(K), g, 6, **options)
    vectors = np.stack([other.momentum[..., 2, 1], other.momentum[..., 0, 2], other.momentum[..., 1, 0]], axis=-1)
    assert distance(vectors, one.momentum) < 1e-40
    assert distance(other.gamma, one.gamma) < 1e-40
    # The attitudes start as two float64 rotations, so the paths are turned against each other by a rounding.
    ways = [np.hypot(*np.diff(run.contact.astype(float), axis=0).T) for run in (one, other)]
    assert np.allclose(*ways, rtol=1e-14)


def test_more_digits_agree_and_float64_is_near(state):
    few, many = (trajectory_n(*state, 4, order=4, contact=True, precision=Digits(n)) for n in (30, 60))
    plain = trajectory_n(*state, 4, order=4, contact=True)
    for name in ("momentum", "gamma", "attitude", "contact"):
        assert distance(getattr(few, name), getattr(many, name)) < 1e-30
        assert 0 < distance(getattr(few, name), getattr(plain, name)) < 1e-14
    assert few.momentum.dtype == object
    assert (few.taken, few.status, few.order) == (4, Status.TAKEN, 4)


def test_the_integrals_stay_and_the_attitude_is_a_rotation(state):
    run = trajectory_n(*state, 6, every=3, attitude=True, precision=Digits(50))
    n = state[0].n
    assert distance(run.invariants(), run.invariants()[:1]) < 1e-48
    assert distance(run.attitude @ run.attitude.mT, np.eye(n)) < 1e-48
    assert distance((run.attitude @ run.gamma[..., np.newaxis])[..., :-1, 0], 0) < 1e-14


@pytest.mark.parametrize("exponent", [-600, 600])
def test_units_are_no_matter(state, exponent):
    ball, K, g = state
    moments, D = np.ldexp(ball.mass_tensor, exponent), np.ldexp(ball.D, exponent)
    found = step_n(BallN(moments, D), np.ldexp(K, exponent), g, precision=Digits(30))
    plain = step_n(ball, K, g, precision=Digits(30))
    assert (found.rotation == plain.rotation).all()
    assert distance(found.rotation, step_n(ball, K, g).rotation) < 1e-15


def test_a_ball_that_stops_is_told_as_in_float64(state):
    ball, K, g = state
    both = np.stack([K, 50 * K])
    few, plain = (trajectory_n(ball, both, g, 2, precision=one) for one in (Digits(30), "double"))
    assert few.status.tolist() == plain.status.tolist() == [Status.TAKEN, few.status[1]]
    assert few.taken.tolist() == plain.taken.tolist() == [2, 0]
    assert all(x != x for x in few.momentum[1, 1:].flat)
    with pytest.raises(BadInput, match="a ball of the batch stopped early"):
        few.invariants()
    with pytest.raises(BadInput, match="reverse goes back in float32 or float64 only"):
        reverse_n(trajectory_n(ball, K, g, 1, precision=Digits(30)))
    with pytest.raises(chapsym.StepNotTaken):
        step_n(ball, 50 * K, g, precision=Digits(30))


@pytest.mark.parametrize("precision", ["single", "double-double", Enclosure(100), "none"])
def test_other_precisions_are_refused(state, precision):
    with pytest.raises(BadInput, match="precision"):
        step_n(*state, precision=precision)
