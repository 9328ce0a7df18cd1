"""Trajectories in double-double: against the matrix oracle, against 60 digits, to the bit among themselves."""

from fractions import Fraction as F

import mpmath
import numpy as np
import pytest

import chapsym
from chapsym import generated
from chapsym.dynamics import kernels
from chapsym.dynamics.attitudes import attitude_with
from chapsym.dynamics.errors import StepNotTaken
from chapsym.dynamics.levels import double_double
from chapsym.dynamics.map import step
from chapsym.dynamics.oracle import Oracle
from chapsym.numbers import Digits, DoubleDouble, Pair
from chapsym.studies import check

#: One unit of double-double is the square of one of float64, 2⁻⁵²; the roundoff u² is a quarter of it.
ULP = 2.0**-104
U2 = 2.0**-106
J, D, RADIUS = (0.1, 0.5, 1.6), 0.7, 0.1
K, GAMMA = (0.03, -0.02, 0.035), (2 / 7, 3 / 7, 6 / 7)
BALL = chapsym.Ball(J, D, RADIUS)
START = attitude_with(np.array(GAMMA))
HIGH = mpmath.MPContext()
HIGH.dps = 70


def whole(high, low):
    """A vector of pairs as exact fractions."""
    return [F(float(a)) + F(float(b)) for a, b in zip(high, low, strict=True)]


def in_both(*arguments, **options):
    """A run in pairs and the same in 60 digits."""
    return [chapsym.trajectory(*arguments, precision=p, **options) for p in ("double-double", Digits(60))]


def each(run, truth, name):
    """A vector of both, frame by frame: exact fractions, and mpf."""
    frames = zip(getattr(run, name), getattr(run.low, name), getattr(truth, name), strict=True)
    return [(whole(high, low), list(map(HIGH.mpf, exact))) for high, low, exact in frames]


def off(found, truth, size=1.0):
    """The largest error in units of u², relative to size."""
    return max(float(abs(HIGH.mpf(x.numerator) / x.denominator - t)) for x, t in zip(found, truth, strict=True)) / (
        size * U2
    )


def condition(state):
    q = step(chapsym.Ball(state.J, state.D), state.K, state.g).rotation
    size, extent = np.abs(state.K).max(), np.abs(q[1:]).max()
    top = (state.J.sum() - state.J).max() + state.D
    inverse = np.linalg.inv(kernels.tangent_jacobian(q, state.g, state.J, state.D))
    return extent, float(np.linalg.norm(inverse, 2) * (size / extent + 2 * top))


@pytest.mark.parametrize("stratum", check.STRATA)
def test_steps_keep_the_promise_of_float64_squared(stratum):
    """𝒦 and γ within 4(1 + |q|κ) units of the matrix equation's, as `chapsym check` has it, the units squared."""
    rng = np.random.default_rng([31, list(check.STRATA).index(stratum)])
    for _ in range(2):
        state = check.STRATA[stratum](rng)
        run = chapsym.trajectory(chapsym.Ball(state.J, state.D), state.K, state.g, 1, precision="double-double")
        g = [HIGH.mpf(float(x)) for x in state.g]
        length = HIGH.sqrt(sum(x * x for x in g))
        assert off(whole(run.gamma[0], run.low.gamma[0]), [x / length for x in g]) <= 8
        truth = Oracle([*state.J], state.D, [x / length for x in g], 45).step([*map(float, state.K)])
        extent, kappa = condition(state)
        promise = check.BUDGET * (1 + extent * kappa) * ULP / U2
        assert off(whole(run.momentum[1], run.low.momentum[1]), truth.momentum, np.abs(state.K).max()) <= promise
        assert off(whole(run.gamma[1], run.low.gamma[1]), truth.gamma) <= promise


@pytest.mark.parametrize(
    ("order", "steps", "budget", "up", "start"),
    [
        (2, 1, 8, -1, True), (2, 30, 40, 1, START), (2, 1000, 1000, 1, True), (4, 12, 200, -1, True),
        (6, 12, 200, 1, START), (8, 12, 200, 1, True),
    ],
)  # fmt: skip
def test_a_run_against_60_digits(order, steps, budget, up, start):
    """An error of some u² at each step, which the motion carries on linearly."""
    options = {"every": steps, "order": order, "attitude": start, "contact": True}
    run, truth = in_both(BALL, K, up * np.array(GAMMA), steps, **options)
    for name, size in (("momentum", 0.05), ("gamma", 1.0), ("attitude", 1.0), ("contact", RADIUS)):
        assert max(off(*vector, size) for vector in each(run, truth, name)) <= budget
    assert abs(sum(x * x for x in whole(run.attitude[-1], run.low.attitude[-1])) - 1) <= 8 * U2
    assert type(run.precision) is DoubleDouble


@pytest.mark.parametrize("size", [1e-5, 1e-40, 1e-150, 1e-300, 5e-324])
def test_tiny_momenta(size):
    """To the last bits that the halves can hold: the low ones are subnormal where 𝒦 is below 1e-290."""
    momentum = np.array([size, 0.0, -3 * size])
    run, truth = in_both(BALL, momentum, GAMMA, 3, attitude=START, contact=True)
    assert off(*each(run, truth, "gamma")[-1]) <= 16
    for name, extent in (("momentum", 3 * size), ("contact", RADIUS * size)):
        for x, y in zip(*each(run, truth, name)[-1], strict=True):
            assert abs(HIGH.mpf(x.numerator) / x.denominator - y) <= max(32 * U2 * extent, 5e-324)
    again = chapsym.trajectory(BALL, np.tile(momentum, (5, 1)), GAMMA, 600, every=3, precision="double-double")
    for a, b in ((again, run), (again.low, run.low)):
        np.testing.assert_array_equal(a.gamma[3, 1], b.gamma[-1])
        np.testing.assert_array_equal(a.momentum[3, 1], b.momentum[-1])


def test_integrals_do_not_walk():
    """Restored every 1024 steps they stay within what that many add up to, 32u² and some; else 10⁶ make 1000u²."""
    steps = 1_000_000
    run = chapsym.trajectory(BALL, K, GAMMA, steps, every=steps // 10, precision="double-double")

    def values(i):
        k, g = whole(run.momentum[i], run.low.momentum[i]), whole(run.gamma[i], run.low.gamma[i])
        return [sum(x * y for x, y in zip(a, b, strict=True)) for a, b in ((k, k), (g, g), (k, g))]

    start = values(0)
    for i in range(1, len(run.index)):
        assert all(abs(a / b - 1) <= 120 * U2 for a, b in zip(values(i), start, strict=True))


@pytest.mark.parametrize("D", [1e3, 1e6, 1e10, 1e14])
def test_a_heavy_ball_keeps_its_digits(D):
    """One correction by a float64 Jacobian would leave 31 - log₁₀(D/I) digits, sums that are not normalised as well."""
    ball, K, g = chapsym.Ball((0.1, 0.5, 1.6), D), (0.03, -0.02, 0.035), np.array((2, 3, 6)) / 7
    run, truth = in_both(ball, K, g, 20, every=20)
    for name, size in (("momentum", 0.035), ("gamma", 1.0)):
        # 20 steps, each with a few roundings u² of its own: 4(1 + |q|κ) of them is the promise, and κ is about 10.
        assert off(*each(run, truth, name)[-1], size) <= 20 * 4 * 4


@pytest.mark.parametrize("x", [0.48, 1e-9, 1e-170, 5e-324, 0.0])
@pytest.mark.parametrize("sign", [1, -1])
def test_the_least_rotation(x, sign):
    """It turns γ to e₃ and has no part about e₃; upside down it is a half turn about e₁."""
    y = Pair(0.6 if x == 0.48 else 3 * x)
    z = sign * (1 - Pair(x) * x - y * y).sqrt()
    a = double_double.least_rotation(Pair(x), y, z)
    exact = [v.exactly() for v in a]
    gamma = [v.exactly() for v in (Pair(x), y, z)]
    turned = generated.rotate(*exact, *gamma)
    assert abs(turned[0]) + abs(turned[1]) + abs(turned[2] - 1) <= 100 * U2
    assert a[3] == 0
    if x == 0 and sign < 0:
        assert a[:3] == [0, 1, 0]
    if sign < 0 and x < 1e-150:  # float64's squares vanish, and it takes the half turn about e₁
        return
    np.testing.assert_allclose([float(v) for v in a], attitude_with(np.array(gamma, dtype=float)), atol=3e-16)


def takes(ball, momentum, gamma, precision):
    try:
        chapsym.step(ball, momentum, gamma, precision=precision)
    except StepNotTaken:
        return False
    return True


def test_beside_a_fold_pairs_say_what_forty_digits_say(thorough):
    """float64's continuation ends some roundings before a fold or behind it; pairs see on which side 𝒦 is."""
    rng, taken, balls = np.random.default_rng(5), 0, 12 if thorough else 3
    for _ in range(balls):
        (tensor, contact), gamma = check._ball(rng), check._unit(rng)
        ball, fold = chapsym.Ball(tensor, contact), check._at_reach(rng, tensor, contact, gamma, 1.0).K
        for beyond in (3e-16, 4e-15):
            found = takes(ball, fold * (1 + beyond), gamma, "double-double")
            assert found == takes(ball, fold * (1 + beyond), gamma, Digits(40))
            taken += found
    assert 0 < taken < 2 * balls
