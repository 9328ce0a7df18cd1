"""One step: `step`, `compose_step` of order 2 and the first step of `trajectory` are one, and refuse the same."""

import json
import warnings
from fractions import Fraction as F

import numpy as np
import pytest
from budget import slow

import chapsym
from chapsym import BadInput, Ball, Status, StepNotTaken
from chapsym.cli.step import step as command
from chapsym.dynamics import compose_step
from chapsym.dynamics.loops import branch
from chapsym.dynamics.map import exact_step
from chapsym.numbers import NAMED, Digits, Enclosure

LEVELS = ["single", "double", "double-double", Digits(20), Enclosure(60)]
GAMMA = np.array([2, 3, 6]) / 7


def bits(vector):
    """A vector as text that tells all bits of its numbers."""

    def text(x):
        if hasattr(x, "mid"):
            return f"{x.mid().man_exp()} {x.rad().man_exp()}"
        return str(x._mpf_) if hasattr(x, "_mpf_") else float(x).hex()

    return [text(x) for x in np.ravel(vector)]


def first(make):
    """What a step or a trajectory of one step gives, to the bit, or why there is none."""
    try:
        found = make()
    except StepNotTaken as stopped:
        return stopped.status, stopped.reach
    except BadInput as refused:
        return str(refused)
    whole = [found] if found.low is None else [found, found.low]
    vectors = [getattr(x, name) for x in whole for name in ("momentum", "gamma")]
    return [bits(v[-1] if isinstance(found, chapsym.Trajectory) else v) for v in vectors]


def agree(ball, K, g, precision):
    """Takes the step all ways, warnings being errors, and says how it ended."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        one = first(lambda: chapsym.step(ball, K, g, precision=precision))
        assert one == first(lambda: chapsym.trajectory(ball, K, g, 1, precision=precision))
        if precision == "double":
            assert one == first(lambda: compose_step(ball, K, g, 2))
    if isinstance(one, list) and isinstance(precision, str):
        rotation = chapsym.step(ball, K, g, precision=precision).rotation.astype(float)
        assert rotation @ rotation == pytest.approx(1.0, rel=1e-6)
    return "taken" if isinstance(one, list) else one[0] if isinstance(one, tuple) else "no input"


@pytest.mark.parametrize("precision", LEVELS, ids=str)
def test_a_step_is_the_first_of_a_trajectory_to_the_bit(precision):
    rng = np.random.default_rng(12)
    ends = set()
    for _ in range(60 if isinstance(precision, str) else 1):
        J, D, g = rng.uniform(0.05, 3, 3), rng.uniform(0, 4), rng.normal(size=3)
        K = rng.normal(size=3) * rng.choice([1e-9, 0.1, 0.5, 2, 5, 25])
        ends.add(agree(Ball(J, D), K, g / np.linalg.norm(g), precision))
    assert len(ends) >= (3 if isinstance(precision, str) else 1)


def extreme(rng):
    """A ball and a momentum of any magnitudes that float64 has."""
    kind, size = rng.integers(0, 3, 2)
    scale = 10.0 ** rng.uniform(-300, 300)
    J = [10.0 ** rng.uniform(-307, 307, 3), scale * 10.0 ** rng.uniform(-8, 8, 3), 10.0 ** rng.uniform(-2, 2, 3)][kind]
    D = [10.0 ** rng.uniform(-307, 308), min(scale * 10.0 ** rng.uniform(-5, 100), 1e308), 10.0 ** rng.uniform(0, 120)]
    top = [J.max(), D[kind], 10.0 ** rng.uniform(-300, 308)][size]
    return Ball(J, D[kind]), rng.normal(size=3) * min(top * 10.0 ** rng.uniform(-3, 1), 1e307)


@pytest.mark.parametrize("precision", LEVELS, ids=str)
def test_the_same_is_refused_at_any_magnitude(precision):
    rng = np.random.default_rng(4)
    ends = {agree(*extreme(rng), GAMMA, precision) for _ in range(60 if isinstance(precision, str) else 1)}
    assert not isinstance(precision, str) or "taken" in ends


@pytest.mark.parametrize("exponent", range(10, 110, 10))
def test_a_step_that_is_taken_turns_whatever_the_ball_weighs(exponent):
    """From D/J = 10⁷⁶ on it was TAKEN with the rotation 0 or NaN: the Jacobian of an unscaled ball overflows."""
    for precision in ("single", "double", "double-double"):
        agree(Ball((1, 2, 4), 10.0**exponent), (1e-3, 2e-3, -1e-3), GAMMA, precision)


@pytest.mark.parametrize(
    ("J", "D", "K"),
    [
        ((1e-16, 1.7e308, 9.5e18), 0.00028, (-0.0398, 0.0446, -0.0723)),
        ((1e-130, 2e-130, 1e-131), 1e-32, (-9e278, 0, 9e278)),
        ((4e281, 1e279, 1e277), 1e308, (2e-253, 0, -8e-253)),
    ],
)
@pytest.mark.parametrize("order", [2, 4])
def test_magnitudes_that_overflow_are_refused_with_a_status(J, D, K, order):
    with pytest.raises(StepNotTaken):
        compose_step(Ball(J, D), K, GAMMA, order)
    with pytest.raises(StepNotTaken):
        chapsym.trajectory(Ball(J, D), K, GAMMA, 1, order=order)


def test_a_batch_steps_as_its_trajectories_do():
    """One by one, and in blocks; those that are refused, too; at every order."""
    rng = np.random.default_rng(8)
    J, D, K, g = rng.uniform(0.05, 3, (40, 3)), rng.uniform(0, 9, 40), *rng.normal(size=(2, 40, 3))
    J[0], D[0], K[0] = (1, 2, 4), 1e90, 1e-3
    J[1], D[1], K[1] = (1e300, 1e307, 1e308), 1e-9, 1e-290
    g /= np.linalg.norm(g, axis=1)[:, np.newaxis]
    for precision, order in (("single", 2), ("double", 2), ("double", 4), ("double", 6), ("double", 8)):
        which = slice(2, None) if precision == "single" else slice(None)
        state = Ball(J[which], D[which]), K[which], g[which]
        step = chapsym.step(*state, precision=precision) if order == 2 else compose_step(*state, order)
        run = chapsym.trajectory(*state, 1, precision=precision, order=order)
        assert {Status.TAKEN, Status.UNREACHABLE} < set(step.status.tolist())
        assert np.array_equal(step.status, run.status)
        assert np.array_equal(step.reach, np.where(step.status == 0, 1.0, step.reach))
        for name in ("momentum", "gamma"):
            assert np.array_equal(getattr(step, name), getattr(run, name)[:, 1], equal_nan=True)


@pytest.mark.parametrize("precision", LEVELS, ids=str)
def test_exact_numbers_that_are_floats_are_stepped_as_floats(precision):
    precision = NAMED[precision] if isinstance(precision, str) else precision
    J, D, K, g = (F(1), F(2), F(9, 4)), F(3), (F(1), F(-1, 2), F(3, 4)), (F(0), F(0), F(1))
    floats = [float(x) for x in K], [float(x) for x in g]
    exact, plain = exact_step(J, D, K, g, precision), chapsym.step(Ball((1, 2, 2.25), 3), *floats, precision=precision)
    for name in ("rotation", "momentum", "gamma"):
        assert bits(getattr(exact, name)) == bits(getattr(plain, name))
        assert exact.low is plain.low is None or bits(getattr(exact.low, name)) == bits(getattr(plain.low, name))


def test_exact_numbers_are_rounded_once():
    """1/3 at 60 digits is not the 1/3 of float64; and pairs hold the step at 40 digits to their last bit or two."""
    J, D, K, g = (F(1), F(2), F(1, 3)), F(3), (F(1), F(-1, 2), F(3, 4)), (F(2, 7), F(3, 7), F(6, 7))
    truth = exact_step(J, D, K, g, Digits(60))
    pairs = exact_step(J, D, K, g, NAMED["double-double"])
    for name in ("rotation", "momentum", "gamma"):
        for exact, high, low in zip(getattr(truth, name), getattr(pairs, name), getattr(pairs.low, name), strict=True):
            assert abs(exact - exact.context.mpf(high) - exact.context.mpf(low)) <= 2.0**-105 * abs(exact)
    assert abs(truth.rotation[1] - chapsym.step(Ball((1, 2, 1 / 3), 3), (1, -0.5, 0.75), GAMMA).rotation[1]) > 1e-19


@pytest.mark.parametrize("size", [1e-30, 1e-102])
def test_a_small_rotation_is_enclosed_beside_itself(size):
    """Beside 1 a run's attitude has its 60 bits; so small a rotation had 20 of them, or none."""
    ball, K = Ball((1e-3, 2e-7, 4e5), 1e6), np.array([3.0, -1.0, 2.0]) * size
    _, *q = chapsym.step(ball, K, GAMMA, precision=Enclosure(60)).rotation
    assert max(x.rad() for x in q) <= max(abs(x.mid()) for x in q) * 2.0**-56


@pytest.mark.parametrize("precision", [Digits(1), *slow(Enclosure(60))], ids=str)
def test_a_fold_far_from_the_momentum_is_found_in_few_steps(precision, monkeypatch):
    """On a thousand digits it was sought to the last of them, for 5 to 17 seconds."""
    monkeypatch.setattr(branch, "MOST_STEPS", 400)
    with pytest.raises(StepNotTaken) as stopped:
        chapsym.step(Ball((1e-296, 2e-296, 1e-296), 3), (1e-3, 0.2, 0.3), GAMMA, precision=precision)
    assert stopped.value.status is Status.FOLDED


def test_more_bits_than_the_condition_costs_are_tried():
    """D/J = 10²⁵⁹ costs some 860 bits at each of three products."""
    J, K = (1e-130, 1e-130, 1e-129), (1e-130, -1e-130, 1e-130)
    found, truth = (chapsym.step(Ball(J, 1e130), K, GAMMA, precision=p).rotation for p in (Enclosure(60), Digits(20)))
    assert [float(x.mid()) for x in found] == pytest.approx(list(map(float, truth)), abs=1e-15)
    assert max(x.rad() for x in found) < 2.0**-55


def test_a_slow_ball_takes_one_step_in_float32_and_no_run():
    ball, K = Ball((0.1, 0.5, 1.6), 0.7), (1e-16, 2e-16, 1e-17)
    assert agree(ball, K, GAMMA, "single") == "taken"
    with pytest.raises(BadInput, match="would stand still"):
        chapsym.trajectory(ball, K, GAMMA, 2, precision="single")


@pytest.mark.parametrize(
    ("options", "precision"),
    [({"precision": "single"}, "single"), ({}, "double"),
     ({"precision": "double-double"}, "double-double"), ({"digits": 20}, Digits(20)),
     ({"ball": 60}, Enclosure(60))],
)  # fmt: skip
def test_the_command_prints_the_step_of_the_library(options, precision, capsys):
    command("1,-1/2,3/4", "0,0,1", mass_tensor="1,2,2.25", contact="3", **options, as_json=True)
    found = chapsym.step(Ball((1, 2, 2.25), 3), (1, -0.5, 0.75), (0, 0, 1), precision=precision)
    assert json.loads(capsys.readouterr().out) == found.write()


def test_a_float32_is_written_with_the_digits_that_it_has():
    written = chapsym.step(Ball((1, 2, 4), 3), (1, -0.5, 0.75), GAMMA, precision="single").write()
    for number in (written["q0"], *written["q"], *written["momentum"], *written["gamma"]):
        assert len(str(number).strip("-0.").replace(".", "")) <= 9
        assert float(np.float32(number)) == pytest.approx(number, rel=2.0**-24)
