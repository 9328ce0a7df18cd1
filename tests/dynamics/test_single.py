"""The float32 precision: float32 throughout, within the promise of the check, no drift, and batches are their balls."""

import warnings

import numpy as np
import pytest

import chapsym
from chapsym import BadInput, Ball
from chapsym.dynamics import kernels
from chapsym.dynamics.levels import double
from chapsym.dynamics.loops import gibbs, twins
from chapsym.dynamics.oracle import Oracle
from chapsym.studies import check

ULP = 2.0**-23
BALL, K, G = Ball((0.1, 0.5, 1.6), 0.7, radius=0.1), (0.03, -0.02, 0.035), (2 / 7, 3 / 7, 6 / 7)
#: The strata of the check that float32 can hold.
STRATA = [name for name in check.STRATA if not name.startswith("tiny")]


def rounded(ball, momentum, gamma):
    """The same ball and state after their rounding to float32, as float64."""
    J, D, k = (np.asarray(x, np.float32).astype(float) for x in (ball.mass_tensor, ball.D, momentum))
    g = double.unit(np.asarray(gamma, float)).astype(float)
    return Ball(J, D, ball.radius), k, g / np.linalg.norm(g, axis=-1, keepdims=True)


@pytest.mark.parametrize("stratum", STRATA)
def test_a_step_keeps_the_promise_of_the_check(stratum, thorough):
    """The state is rounded first; the oracle then steps from float32's own numbers."""
    rng = np.random.default_rng(32)
    for _ in range(8 if thorough else 2):
        state = check.STRATA[stratum](rng)
        ball, k, g = rounded(Ball(state.J, state.D), state.K, state.g)
        found = chapsym.step(Ball(state.J, state.D), [state.K], state.g, precision="single")
        wide = chapsym.step(ball, [k], g)
        assert found.status == wide.status
        if found.status[0]:  # the rounding took the state over the fold
            assert "before the fold" in stratum
            continue
        truth = Oracle([*ball.mass_tensor], float(ball.D), [*g], 34).step([*k])
        q = wide.rotation[0]
        size, extent = np.abs(k).max(), np.abs(q[1:]).max()
        inverse = np.linalg.inv(kernels.tangent_jacobian(q, g, ball.mass_tensor, ball.D))
        kappa = np.linalg.norm(inverse, 2) * (size / extent + 2 * (ball.inertia.max() + ball.D))

        def ulps(values, exact, scale):
            return max(abs(float(e) - float(v)) / scale for v, e in zip(values[0], exact, strict=True)) / ULP

        assert ulps(found.rotation[:, 1:], truth.q, extent) <= check.BUDGET * kappa
        assert ulps(found.momentum, truth.momentum, size) <= check.BUDGET * (1 + extent * kappa)
        assert ulps(found.gamma, truth.gamma, 1.0) <= check.BUDGET * (1 + extent * kappa)


@pytest.mark.parametrize("size", [1e-3, 1e-7, 1e-11, 1e-20, 1e-29])
def test_a_slow_step_has_all_its_digits(size):
    _, k, g = rounded(BALL, np.array(K) * size, G)
    found, exact = (chapsym.step(BALL, k, g, precision=p).rotation[1:] for p in ("single", "double"))
    assert np.abs(found / exact - 1).max() <= 4 * ULP
    assert found.dtype == np.float32


@pytest.mark.parametrize("moments", [(1.0, 1.0, 1.0), (1.0, 0.9, 0.2), (1.0, 1.0, 1e-3), (1.0, 1.0, 1e-9)])
def test_no_bound_underflows(moments):
    """What is compared with the square of a bound is compared in normal numbers; what has none takes the safe way."""
    bound = twins.single(gibbs.certificate)
    I = np.array(moments, np.float32)
    found = [bound(np.array([10.0**-e, 0, 0], np.float32), I, np.float32(0)) for e in range(1, 38)]
    kept = [np.float32(enough) ** 2 for radius, enough in found if radius >= 0]
    assert all(square >= np.finfo(np.float32).tiny for square in kept)
    assert kept or min(moments) < 1e-6
    assert found[-1] == (-1.0, 0.0)


@pytest.mark.parametrize("order", [2, 4, 6, 8])
def test_a_run_is_that_of_float64_from_the_rounded_state(order):
    """Each step errs by an ulp of its rotation, and they add up like √n: 100 steps by 5 ulps, at κ up to 10."""
    run = chapsym.trajectory(BALL, K, G, 100, order=order, contact=True, precision="single")
    ball, k, g = rounded(BALL, K, G)
    exact = chapsym.trajectory(ball, k, g, 100, order=order, contact=True)
    for name, size in (("momentum", 0.035), ("gamma", 1.0), ("attitude", 1.0), ("contact", 0.5)):
        assert np.abs(getattr(run, name) - getattr(exact, name)).max() < 50 * ULP * size
        assert getattr(run, name).dtype == np.float32


@pytest.mark.parametrize("order", [2, 8])
def test_a_million_steps_keep_the_integrals(order):
    """Restored every 1024 steps, they move by the rounding of 𝒦 and γ as they are given out: 2 ulps of a square."""
    steps = 10**6 if order == 2 else 10**5
    run = chapsym.trajectory(BALL, K, G, steps, every=997, order=order, attitude=True, precision="single")
    values = kernels.invariants(run.momentum.astype(float), run.gamma.astype(float))
    moved = np.abs(values / values[0] - 1).max(axis=0) / ULP
    assert (moved <= [3, 2, 2]).all()
    attitude = run.attitude.astype(float)
    # One ulp as the four numbers are rounded, 1.5 of the |a|² by which the length is kept.
    assert np.abs((attitude**2).sum(axis=-1) - 1).max() <= 2.5 * ULP
    vertical = kernels.rotate(attitude, run.gamma.astype(float))
    # The turns of γ and of the attitude are rounded each for itself: √n · |q| ulps, |q| = 0.025 and κ below 10.
    assert np.abs(vertical - [0, 0, 1]).max() <= 10 * 0.025 * np.sqrt(steps) * ULP


def test_a_slow_ball_does_not_stand_still():
    """Each step turns and rolls it by less than the distance to the next float32."""
    slow = np.array(K) * 1e-6
    run = chapsym.trajectory(BALL, slow, G, 200_000, every=200_000, contact=True, precision="single")
    ball, k, g = rounded(BALL, slow, G)
    exact = chapsym.trajectory(ball, k, g, 200_000, every=200_000, contact=True)
    turned = np.abs(exact.gamma[1] - exact.gamma[0]).max()
    assert turned > 1e-3
    assert np.abs(run.gamma[1] - exact.gamma[1]).max() <= 2 * ULP
    assert np.abs(run.attitude[1] - exact.attitude[1]).max() <= 2 * ULP
    assert np.abs(run.contact[1] - exact.contact[1]).max() <= 2 * ULP * np.abs(exact.contact[1]).max()


def test_what_float32_cannot_hold_is_refused():
    cases = [
        (BALL, np.array(K) * 1e-38, "is beyond what float32"),
        (BALL, np.array(K) * 1e-310, "is beyond what float32"),
        (BALL, np.array(K) * 1e40, "is beyond what float32"),
        (Ball((1e-50, 2e-50, 3e-50), 0), (0, 0, 0), "moment of inertia of 5e-50"),
        (Ball((1, 2, 3), 1e60), K, "moment of inertia of 1e\\+60"),
        (BALL, np.array(K) * 1e-15, "stand still"),
    ]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for ball, k, words in cases:
            with pytest.raises(BadInput, match=words):
                chapsym.trajectory(ball, k, G, 10, precision="single")
        far = Ball((0.1, 0.5, 1.6), 0.7, radius=1e38)
        with pytest.raises(BadInput, match="contact point leaves the range"):
            chapsym.trajectory(far, np.array(K) * 10, G, 100, contact=True, precision="single")


def test_a_ball_of_any_units_takes_the_same_steps():
    """A power of two in the units changes nothing but 𝒦 by it."""
    run = chapsym.trajectory(BALL, K, G, 50, precision="single")
    for exponent in (-100, 90):
        scale = 2.0**exponent
        other = Ball(BALL.mass_tensor * scale, 0.7 * scale)
        scaled = chapsym.trajectory(other, np.array(K) * scale, G, 50, precision="single")
        assert (scaled.gamma == run.gamma).all()
        assert (scaled.momentum == run.momentum * np.float32(scale)).all()


def test_a_run_goes_on_from_its_end_and_back():
    run = chapsym.trajectory(BALL, K, G, 300, contact=True, precision="single")
    on = chapsym.trajectory(BALL, run.momentum[-1], run.gamma[-1], 5, attitude=run.attitude[-1], precision="single")
    assert np.abs(on.gamma[0] - run.gamma[-1]).max() <= ULP
    assert chapsym.step(BALL, run.momentum[-1], run.gamma[-1]).status == 0
    back = chapsym.reverse(run)
    assert back.momentum.dtype == np.float32
    assert np.abs(back.contact[-1]).max() < 100 * ULP
    assert chapsym.retrace_error(run, back).max() < 100 * ULP
