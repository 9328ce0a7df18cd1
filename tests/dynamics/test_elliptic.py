"""The invariant curve in Jacobi's functions, the increment on it, and the top that has no error of the step."""

import warnings
from fractions import Fraction
from itertools import permutations

import mpmath
import numpy as np
import pytest
from budget import slow

import chapsym
from benchmarks.trade.frontiers import continuous
from chapsym import (
    BadInput,
    Ball,
    Curve,
    TopMotion,
    exact_top,
    increment,
    rotation_number,
    step_vertical,
    trajectory,
)  # fmt: skip
from chapsym.dynamics import kernels
from chapsym.dynamics.closed import elliptic
from chapsym.dynamics.closed.elliptic import height_of
from chapsym.numbers import Digits

ULP = 2.0**-52
GAMMA = np.array([2 / 7, 3 / 7, 6 / 7])
BALLS = [Ball(J, D) for J in permutations((1.0, 2.0, 4.0)) for D in (0.0, 3.0)]


def verticals(count, seed=7):
    """Unit vectors on both sides of the separatrix."""
    g = np.random.default_rng(seed).normal(size=(count, 3))
    g /= np.sqrt((g * g).sum(axis=-1, keepdims=True))
    return g / np.sqrt((g * g).sum(axis=-1, keepdims=True))


@pytest.mark.parametrize("complement", [1.0, 0.999999, 0.7, 0.5000001, 0.4999999, 0.1, 1e-3, 1e-8, 1e-15])
def test_jacobis_functions_are_those_of_mpmath(complement):
    """Within 3(1 + |u|) ulps of 1, and K within 2: the reduction by K rounds u."""
    modulus = np.sqrt((1 - complement) * (1 + complement))
    quarter = elliptic.quarter_period(complement)
    u = np.concatenate([np.linspace(-2, 2, 41), [1e-9, 1 - 1e-9]]) * quarter
    with mpmath.workdps(60):
        m = 1 - mpmath.mpf(complement) ** 2
        assert abs(quarter / mpmath.ellipk(m) - 1) <= 2 * ULP
        true = [[float(mpmath.ellipfun(f, mpmath.mpf(x), m=m)) for x in u] for f in ("sn", "cn", "dn")]
    error = np.abs(np.array(elliptic.jacobi(u, modulus, complement)) - true).max(axis=0)
    assert (error <= 3 * (1 + np.abs(u)) * ULP).all()


@pytest.mark.parametrize("spread", [(-2, 1, 1), (2, -1, -1), (-1.9, 0, 1.9)])
def test_carlsons_integral_where_its_series_takes_over(spread):
    """Arguments that differ by 2e-3, where the last term of the series is 2 ulps."""
    x, y, z = (np.array([1 + 1e-3 * s]) for s in spread)
    with mpmath.workdps(40):
        true = float(mpmath.elliprf(*(mpmath.mpf(float(a[0])) for a in (x, y, z))))
    assert abs(elliptic.carlson(x, y, z)[0] / true - 1) <= 2 * ULP


def test_on_the_separatrix_they_are_hyperbolic():
    u = np.array([-800.0, -1.0, 0.0, 0.3, 800.0])
    sn, cn, dn = elliptic.jacobi(u, 1.0, 0.0)
    assert elliptic.quarter_period(0.0) == np.inf
    assert np.abs(sn - np.tanh(u)).max() <= ULP
    assert (cn == dn).all()
    assert np.abs(elliptic.argument(sn[1:4], cn[1:4], dn[1:4], np.inf) - u[1:4]).max() <= 2 * ULP


@pytest.mark.parametrize("ball", BALLS)
def test_every_ball_has_its_curve_on_both_sides(ball):
    """5.7, 5.8 as corrected: through γ within 8 ulps, on the sphere and the level, with the flow γ' = V dγ/du."""
    inertia = ball.inertia + ball.D
    sides = set()
    for gamma in verticals(12):
        curve = Curve.through(ball, gamma)
        sides.add(bool(curve.level * np.sort(inertia)[1] > 1))
        u = curve.argument(gamma)
        assert abs(u) <= curve.period / 2
        assert np.abs(curve.point(u) - gamma).max() <= 8 * ULP
        points = curve.point(np.linspace(-0.5, 0.5, 50) * curve.period)
        assert np.abs((points**2).sum(axis=-1) - 1).max() <= 16 * ULP
        assert np.abs((points**2 / inertia).sum(axis=-1) / curve.level - 1).max() <= 16 * ULP
        assert np.abs(curve.point(u + curve.period) - gamma).max() <= 32 * ULP
        slope = (curve.point(u + 1e-5) - curve.point(u - 1e-5)) / 2e-5
        assert np.abs(slope * curve.rate - np.cross(gamma, gamma / inertia)).max() <= 1e-9
        k2 = 1 - curve.complement**2
        assert abs(curve.modulus**2 - k2) <= 8 * ULP
    assert sides == {True, False}


@pytest.mark.parametrize("epsilon", [1e-1, 1e-5, 1e-9, 1e-13])
def test_the_complement_has_full_relative_accuracy_near_the_separatrix(epsilon):
    ball, g = Ball((1, 2, 4), 3), np.array([0.6, 0.7, 0.6 * np.sqrt(1 / 3) * (1 + epsilon)])
    g /= np.linalg.norm(g)
    curve = Curve.through(ball, g)
    with mpmath.workdps(50):
        x, y, z = (mpmath.mpf(float(c)) ** 2 for c in g)
        a, b, c = (
            (mpmath.mpf(9), mpmath.mpf(8), mpmath.mpf(6)) if curve.axes == (0, 1, 2) else map(mpmath.mpf, (6, 8, 9))
        )
        level = (x / 9 + y / 8 + z / 6) / (x + y + z)
        k2 = (a - b) * (1 - c * level) / ((b - c) * (a * level - 1))
        assert abs(curve.complement / mpmath.sqrt(1 - k2) - 1) <= 4 * ULP


@pytest.mark.parametrize("epsilon", [1e-2, 1e-5, 1e-7, 1e-10, 1e-13, 0.0])
def test_near_the_separatrix_and_near_its_ends(epsilon):
    """γ at distance `epsilon` from the separatrix, and from the two stable axes."""
    ball = Ball((1, 2, 4), 3)
    La, Lb, Lc = ball.inertia + ball.D
    x = np.sqrt((Lb - Lc) / Lc) / np.sqrt((La - Lb) / La)
    angle = np.arctan2(x, 1.0) + epsilon
    near = [np.array([np.sin(angle), 0.5, np.cos(angle)])]
    near += [np.array([1.0, epsilon, 2 * epsilon]), np.array([epsilon, epsilon, -1.0])] if epsilon else []
    for gamma in near:
        gamma = gamma / np.linalg.norm(gamma)
        gamma /= np.linalg.norm(gamma)
        curve = Curve.through(ball, gamma)
        assert np.abs(curve.point(curve.argument(gamma)) - gamma).max() <= 8 * ULP
        u = float(curve.argument(gamma))
        moved = curve.argument(step_vertical(ball, 0.5, gamma).gamma)
        assert (
            abs(moved - u - increment(curve, 0.5, u)) <= 64 * ULP / np.abs(np.cross(gamma, gamma / (La, Lb, Lc))).max()
        )


@pytest.mark.parametrize("ball", BALLS)
@pytest.mark.parametrize("height", [0.02, -0.5, 1.5])
def test_the_increment_is_that_of_the_map(ball, height):
    """(5.15) as corrected against G_h itself: within 16 ulps over |dγ/du|."""
    inertia = ball.inertia + ball.D
    for gamma in verticals(8):
        curve = Curve.through(ball, gamma)
        u = float(curve.argument(gamma))
        after = step_vertical(ball, height, gamma).gamma
        moved = curve.argument(after) - u
        miss = np.remainder(moved - increment(curve, height, u) + curve.period / 2, curve.period) - curve.period / 2
        slope = min(np.linalg.norm(np.cross(g, g / inertia)) for g in (gamma, after)) / abs(curve.rate)
        assert abs(miss) <= 16 * ULP * (1 + 1 / slope)


def test_the_derivative_of_the_height_is_its_derivative():
    curve = Curve.through(Ball((1, 2, 4), 3), GAMMA)
    half, u, e = 0.3, 0.2, 1e-5
    above, below = (height_of(curve, half + s, u + half + s)[0] for s in (e, -e))
    slope = height_of(curve, half, u + half)[1]
    assert abs((above - below) / (2 * e) / slope - 1) <= 1e-8


@pytest.mark.parametrize(
    ("call", "sentence"),
    [
        (lambda: Curve.through(Ball((1, 2, 4), 3), (0, 0, 1)), "fixes this gamma"),
        (lambda: Curve.through(Ball((1, 1, 1), 3), GAMMA), "fixes this gamma"),
        (lambda: Curve.through(Ball((1, 2, 4), [3, 0]), GAMMA), "not of a batch"),
        (lambda: Curve.through(BALLS[0], GAMMA).argument((0, 0, 1)), "not on this curve"),
        (lambda: Curve.through(BALLS[0], (1e-9, 1, 0)).argument((0.6, 0, 0.8)), "not on this curve"),
        (lambda: Curve.through(BALLS[0], GAMMA).argument(-GAMMA), "another one"),
        (lambda: increment(Curve.through(BALLS[0], GAMMA), 50.0, 0.0), "take a smaller one"),
        (lambda: increment(Curve.through(BALLS[0], GAMMA), [0.1, 0.2], [1, 2, 3]), "do not broadcast"),
        (lambda: rotation_number(BALLS[0], [0.1, 0.2], GAMMA), "of one height"),
        (lambda: exact_top(BALLS[1], (1, 0, 0), GAMMA), "must be along gamma"),
        (lambda: exact_top(BALLS[0], (0, 0, 0), GAMMA), "must not vanish"),
        (lambda: exact_top(BALLS[0], (50, 20, 30), GAMMA), "shorter time step"),
        (lambda: exact_top(Ball((1, 2, 4), 3), np.multiply(75, GAMMA), GAMMA), "shorter time step"),  # γ has come round
        (lambda: exact_top(BALLS[0], (0, 0, 50), GAMMA), "more than 90"),
        (lambda: exact_top(Ball((1, 2, 4), [0, 0]), GAMMA, GAMMA), "one ball"),
    ],
)
def test_bad_input_is_told(call, sentence):
    with pytest.raises(BadInput, match=sentence):
        call()


@pytest.mark.parametrize(
    ("D", "side", "epsilon"),
    [(0.0, 1, 2.0), (3.0, -1, 2.0), *slow((0.0, 1, 0.5), (3.0, 1, 2.0), (3.0, 1, 0.5), (3.0, -1, 0.5))],
)
def test_the_exact_top_has_no_error_of_the_step(D, side, epsilon):
    """Up to t = 40: 𝒦 and γ within n^(3/2) ulps of the continuous ball; the map itself is off by 5e-3 and more."""
    ball, steps = Ball((1, 2, 4), D), round(40 / epsilon)
    K = side * GAMMA if D else np.array([1.0, -0.5, 0.75])
    top = exact_top(ball, epsilon * K, GAMMA)
    exact = top.restore(trajectory(top.ball, top.momentum, GAMMA, steps, attitude=True))
    times = [Fraction(epsilon) * i for i in range(1, steps + 1)]
    true = continuous(ball, K, GAMMA, None, times, 20)[:, :6].astype(float)
    budget = steps**1.5 * ULP
    assert np.abs(exact.momentum[1:] / epsilon - true[:, :3]).max() <= budget
    assert np.abs(exact.gamma[1:] - true[:, 3:]).max() <= budget
    assert np.abs(kernels.rotate(exact.attitude, exact.gamma) - [0, 0, 1]).max() <= budget
    fixed = kernels.rotate(exact.attitude, exact.momentum)
    assert np.abs(fixed - fixed[0]).max() <= epsilon * budget
    plain = trajectory(ball, epsilon * K, GAMMA, steps)
    assert np.abs(plain.momentum[1:] / epsilon - true[:, :3]).max() > 5e-3
    assert abs(top.twist) > 1e-4


def test_a_rotation_about_a_principal_axis_is_exact():
    ball = Ball((1, 2, 4), 3)
    axis = np.array([0.0, 0.0, 1.0])
    top = exact_top(ball, 2.0 * axis, axis)
    run = top.restore(trajectory(top.ball, top.momentum, axis, 10, attitude=True))
    angle = 10 * 2.0 / (1 + 2)  # I3 = J1 + J2: without rolling about the vertical
    assert np.abs(run.attitude[-1] - [np.cos(angle / 2), 0, 0, np.sin(angle / 2)]).max() <= 32 * ULP


@pytest.mark.parametrize("size", [1e17, 1.46756e18])
def test_a_needle_has_its_curve_and_its_increment(size):
    """Its least moment of inertia was lost beside J₂, and with it the curve: NaN, or an error in a strange name."""
    ball, g, h = Ball((0.480419, size, 1.744017), 6.48e-13), np.array([-0.2717, -0.5594, -0.7831]), -0.01546
    g /= np.linalg.norm(g)
    curve = Curve.through(ball, g)
    u = curve.argument(g)
    there = curve.point(u + increment(curve, h, u))
    truth = chapsym.step(ball, h * g, g, precision=Digits(40))  # float64 cannot resolve the rotation
    assert there == pytest.approx(truth.gamma.astype(float), abs=1e-12)


def test_a_curve_beyond_float64_is_refused():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(BadInput, match="too far apart"):
            Curve.through(Ball((0.0555, 2.0, 3.68e261), 0.0), (0.6, 0, 0.8))


@pytest.mark.parametrize(
    ("J", "D", "gamma"),
    [((1, 2, 4), 0, (3e-8, 1, 1e-7)), ((1, 2, 4), 0, (3e-13, 1, 1e-12)), ((1, 1, 4), 1, (0.6, 0.8, 1e-9))],
)
def test_equal_increments_are_the_rotation_number_near_the_separatrix_too(J, D, gamma):
    ball, gamma = Ball(J, D), np.array(gamma) / np.linalg.norm(gamma)
    exact = TopMotion.vertical(ball, 0.6, gamma).rotation_number
    assert rotation_number(ball, 0.6, gamma) == pytest.approx(exact, rel=1e-14)


def test_the_rotation_number_of_the_shortest_steps_is_that_of_the_rate():
    ball, gamma = Ball((1, 2, 4), 3), (0.48, 0.6, 0.64)
    for height in (1e-12, 1e-20, 1e-300):
        assert rotation_number(ball, height, gamma) / height == pytest.approx(
            1e6 * rotation_number(ball, 1e-6, gamma), rel=1e-10
        )
    with pytest.raises(BadInput, match="too near the separatrix for float64"):
        rotation_number(Ball((1, 2, 4), 1), 0.6, np.array((3e-8, 1, 1e-7)) / np.linalg.norm((3e-8, 1, 1e-7)))
