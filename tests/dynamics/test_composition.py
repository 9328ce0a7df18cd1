"""Compositions: coefficients against the order conditions, orders against the continuous ball, exact integrals."""

import math
from fractions import Fraction

import numpy as np
import pytest

import chapsym
from benchmarks.trade.frontiers import continuous
from chapsym import BadInput, Ball, Status, StepNotTaken
from chapsym.derive.composition import defects, words
from chapsym.dynamics import kernels
from chapsym.dynamics.coefficients import COMPOSITIONS
from chapsym.dynamics.levels import double
from chapsym.dynamics.loops import double_double, gibbs, loop
from chapsym.dynamics.loops.guess import stage_weights

BALL = Ball((0.1, 0.5, 1.6), 0.7, radius=0.5)
GAMMA = np.array([2, 3, 6]) / 7
K = np.array([0.6, -0.5, 0.6])
ORDERS = (4, 6, 8)


# The coefficients: that they solve the order conditions is the lemma `composition-order`


@pytest.mark.parametrize("order", ORDERS)
def test_a_composition_is_a_palindrome_and_a_step_of_length_one(order):
    exact, stages = COMPOSITIONS[order].exact, chapsym.substeps(order)
    assert exact == exact[::-1]
    assert sum(exact) - 1 == pytest.approx(0, abs=1e-39)
    assert stages.tolist() == [float(c) for c in exact]
    assert len(stages) == {4: 5, 6: 9, 8: 17}[order]


def test_the_order_conditions_are_those_that_are_known():
    """Σc = 1 and Σc³ = 0, which for a palindrome are those of order 4; a word for each sum of odd numbers."""
    c = [Fraction(1, 3), Fraction(-2), Fraction(1, 3)]
    found = defects(c, 4)
    assert found[(1,)] == sum(c) - 1
    assert found[(3,)] == sum(x**3 for x in c)
    assert found[(1, 1)] == (sum(c) ** 2 - 1) / 2
    assert [len(list(words(w))) for w in range(1, 9)] == [1, 1, 2, 3, 5, 8, 13, 21]
    assert set(defects(c, 8)) == {word for w in range(1, 9) for word in words(w)}


@pytest.mark.parametrize("order", [0, 3, True, 4.0, "4", [4]])
def test_other_orders_are_refused(order):
    with pytest.raises(BadInput, match="order must be one of 2, 4, 6, 8"):
        chapsym.substeps(order)
    with pytest.raises(BadInput, match="order must be one of"):
        chapsym.trajectory(BALL, K, GAMMA, 3, order=order)


# The orders


def errors(case, order, counts):
    """The largest error of K/|K| and γ after 5 s, for each number of steps, against the continuous ball."""
    ball, gamma, K = case
    exact = continuous(ball, K, gamma, None, [Fraction(5)], 25)[0, :6].astype(float)
    exact[:3] /= np.abs(K).max()
    for n in counts:
        run = chapsym.trajectory(ball, K * (5 / n), gamma, n, order=order, every=n)
        yield np.abs(np.r_[run.momentum[-1] * (n / 5) / np.abs(K).max(), run.gamma[-1]] - exact).max()


@pytest.mark.parametrize(
    ("order", "steps"),
    [(2, (160, 320, 640, 1280)), (4, (40, 80, 160, 320)), (6, (20, 28, 40, 56, 80)), (8, (17, 20, 24, 28))],
)
@pytest.mark.parametrize(
    "case", [(BALL, GAMMA, K), (Ball((1.0, 0.6, 0.3), 1.5), np.array([-1, 4, 8]) / 9, np.array([0.9, 1.1, -0.7]))]
)
def test_the_order_is_measured(order, steps, case):
    """The error is h^p(a + b h² + ...), and a fit is off p by what b brings; another even order would be off by 2.

    The steps are between those whose error is not yet the first term and those whose error is rounding.
    """
    found = list(errors(case, order, steps))
    assert found[0] < 1e-3
    assert found[-1] > 1e-13
    slope = -np.polyfit(np.log(steps), np.log(found), 1)[0]
    assert abs(slope - order) < 0.2, found


# The loop


@pytest.mark.parametrize("order", ORDERS)
def test_a_step_is_its_stages(order):
    """𝒦 and γ turned by the rotation of each stage, found by `step` from cᵢ𝒦; and the product of the rotations.

    Both round each stage by half an ulp or so: 2⁻⁵³ for each stage and way is allowed.
    """
    allowed = 2 * 2.0**-53 * len(chapsym.substeps(order))
    momentum, gamma, rotation = 0.5 * K, GAMMA, np.array([1.0, 0, 0, 0])
    for c in chapsym.substeps(order):
        stage = chapsym.step(BALL, c * momentum, gamma)
        momentum, gamma = kernels.transport(stage.rotation, momentum), stage.gamma
        rotation = kernels.compose(rotation, stage.rotation)
    whole = chapsym.compose_step(BALL, 0.5 * K, GAMMA, order)
    assert np.abs(whole.momentum - momentum).max() <= allowed * np.abs(momentum).max()
    assert np.abs(whole.gamma - gamma).max() <= allowed
    assert np.abs(whole.rotation - rotation).max() <= allowed


FOLDING = np.array([4.32, -2.16, 3.24])
HEAVY = Ball((1, 2, 4), 3)


def test_a_long_run_goes_in_chunks_and_stops_where_it_failed(monkeypatch):
    """To the bit as in one piece; a ball that failed is not asked again."""
    whole = chapsym.trajectory(BALL, 0.1 * K, GAMMA, 23, order=4, every=3, contact=True)
    monkeypatch.setattr(double, "CHUNK", 34)  # 6 steps of 5 stages, 2 steps of 17
    parts, seen = chapsym.trajectory(BALL, 0.1 * K, GAMMA, 23, order=4, every=3, contact=True), []
    for name in ("momentum", "gamma", "attitude", "contact", "taken"):
        assert (getattr(whole, name) == getattr(parts, name)).all()
    with pytest.raises(StepNotTaken) as caught:
        chapsym.trajectory(HEAVY, 1.5 * FOLDING, GAMMA, 100, order=8, progress=seen.append)
    assert caught.value.index == 4
    assert seen == [2, 4, 6]


def test_a_stage_whose_momentum_no_rotation_has_is_told():
    """The reason is that of the stage's momentum in its own units, not of what the loop makes of it."""
    with pytest.raises(StepNotTaken) as caught:
        chapsym.trajectory(HEAVY, 2.5 * FOLDING, GAMMA, 3, order=6)
    assert caught.value.status is Status.UNREACHABLE
    with pytest.raises(StepNotTaken, match="no rotation of this ball has this momentum"):
        chapsym.compose_step(HEAVY, 2.5 * FOLDING, GAMMA, 6)


def test_the_guess_continues_polynomials_of_degree_7():
    """Exactly, in integers; and not those of degree 8."""
    for degree, exact in ((7, True), (8, False)):
        past = np.zeros((8, 3))
        for n in range(-8, 0):
            double_double.extrapolated(past, (float(n**degree), float((n + 2) ** degree), 1.0))
        assert (past[0] == [0.0, 2.0**degree, 1.0]).all() == exact


@pytest.mark.usefixtures("plain")
@pytest.mark.parametrize("order", [4, 6, 8])
def test_a_stage_is_guessed_from_those_around_it(order, monkeypatch):
    """From the second round on no stage is searched, and the guesses are near: they lack 1e-4 at most."""
    missed, honest = [], loop.settle

    def settle(guess, *rest):
        settled, p, u = honest(guess, *rest)
        missed.append(math.dist(guess, u) / math.hypot(*u) if settled else math.inf)
        return settled, p, u

    monkeypatch.setattr(loop, "settle", settle)
    chapsym.trajectory(BALL, 0.2 * K, GAMMA, 12, order=order)
    later = missed[stage_weights(tuple(map(float, chapsym.substeps(order)))).shape[1] :]
    assert len(later) > 30
    assert max(later) < 1e-4


@pytest.mark.usefixtures("plain")
def test_each_stage_has_the_certificate_of_its_own_momentum(monkeypatch):
    seen, honest = [], loop.settle
    monkeypatch.setattr(loop, "settle", lambda *a: seen.append((a[1], *a[-2:])) or honest(*a))
    safe, searched = loop.safe_rotation, []
    monkeypatch.setattr(
        loop,
        "safe_rotation",
        lambda *a: searched.append((tuple(a[-1][:3]), a[-1][loop.RADIUS], a[-1][loop.ENOUGH])) or safe(*a),
    )
    chapsym.trajectory(BALL, 0.5 * K, GAMMA, 1, order=8)
    assert searched
    inertia = (BALL.mass_tensor.sum() - BALL.mass_tensor) / 4  # Λmax is scaled into [1/2, 1)
    assert len(seen) == 17
    for k, radius, enough in seen + searched:
        assert (radius, enough) == pytest.approx(gibbs.certificate(k, inertia, float(BALL.D) / 4), rel=1e-13)
    assert len({round(radius, 9) for *_, radius, _ in seen}) == 9
