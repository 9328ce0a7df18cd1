"""Certificates: the balls contain the oracle's orbit, the bounds bound, and every digit shown is right."""

import itertools
from dataclasses import replace
from decimal import Decimal, Inexact, localcontext
from fractions import Fraction as F
from functools import partial

import flint
import numpy as np
import pytest
from budget import examples, slow
from hypothesis import assume, given
from hypothesis import strategies as st
from orbits import context, from_quaternion, orbit

import chapsym
from chapsym import BadInput, StepNotTaken, testing
from chapsym.dynamics import certified
from chapsym.dynamics.certified import proved_digits
from chapsym.dynamics.coefficients import COMPOSITIONS
from chapsym.dynamics.levels import balls, proved_root
from chapsym.dynamics.loops import path
from chapsym.dynamics.loops.branch import small_rotation
from chapsym.numbers import Digits, Enclosure

BALL = chapsym.Ball((0.1, 0.5, 1.6), 0.7, radius=0.5)
K = 0.3 * np.array([4, -2, 3]) / np.sqrt(29)
GAMMA = (2 / 7, 3 / 7, 6 / 7)


def length(mp, found, exact):
    return mp.sqrt(sum((mp.mpf(float(x)) - y) ** 2 for x, y in zip(found, exact, strict=True)))


def right(text, exact):
    """Whether the digits of a decimal string are those of an mpf, rounded; it may be a unit in the last place off."""
    value = Decimal(text)
    mpf = exact.context.mpf
    return abs(mpf(text) - exact) <= mpf(10) ** value.as_tuple().exponent * mpf("0.500001")


@pytest.mark.parametrize("order", [2, 4, *slow(6, 8)])
def test_the_bounds_are_the_errors_that_the_oracle_sees(order):
    """With attitude and contact; the bound is not below the error, nor far above it."""
    steps = 12 if order == 2 else 3
    run = chapsym.trajectory(BALL, K, GAMMA, steps, order=order, contact=True)
    proof = chapsym.certify(run)
    exact = orbit(BALL, K, GAMMA, steps, COMPOSITIONS[order].exact, digits=40, attitude=run.attitude[0])
    mp = context(60)
    for k, (momentum, gamma, R, _) in enumerate(exact):
        for name, truth in (("momentum", momentum), ("gamma", gamma)):
            seen = length(mp, getattr(run, name)[k], truth)
            assert seen <= getattr(proof, f"{name}_error")[k] <= seen * (1 + 1e-9)
            assert all(right(text, x) for text, x in zip(proof.digits(name)[k], truth, strict=True))
            assert all(len(text) > 30 for text in proof.digits(name)[k])
        # |R(a) - R(b)| ≤ 2√2|a - b| for unit quaternions.
        off = mp.sqrt(sum(x * x for x in np.ravel(np.array(from_quaternion(mp, run.attitude[k])) - np.array(R))))
        assert off <= 2.83 * proof.attitude_error[k]
    assert proof.momentum_error[0] == 0
    assert proof.gamma_error[-1] > 0
    for name in ("momentum", "gamma", "attitude", "contact"):
        assert (getattr(proof, f"{name}_error") < 1e-15 * 30).all()
    # R γ = e₃ holds to a rounding for the attitude that was given, so the oracle's trace is off by as much.
    assert np.abs(proof.contact_error - [float(length(mp, c, [x / 2 for x in e[3][:2]])) for c, e in zip(
        run.contact, exact, strict=True)]).max() < 1e-15  # fmt: skip


@pytest.mark.parametrize("precision", ["single", "double", "double-double", Digits(20)])
def test_every_precision_is_certified_from_its_own_numbers_and_tells_progress(precision):
    run = chapsym.trajectory(BALL, K, GAMMA, 200, every=50, contact=True, precision=precision)
    seen = []
    proof = chapsym.certify(run, progress=seen.append)
    assert seen[-1] == 200
    unit = {"single": 2.0**-24, "double": 2.0**-53, "double-double": 2.0**-104}.get(precision, 1e-33)
    for name in ("gamma", "attitude"):
        errors = getattr(proof, f"{name}_error")
        assert errors.shape == (5,)
        assert (errors < 2000 * unit).all()
        assert errors[-1] > 0


@given(testing.states(fraction=(0.05, 0.9)), st.sampled_from([2, 4]))
@examples(5, 15)
def test_float_trajectories_of_any_state_are_within_their_bounds(state, order):
    ball, momentum, gamma = state
    try:
        run = chapsym.trajectory(ball, momentum / (1 if order == 2 else 2), gamma, 2, order=order)
    except StepNotTaken:
        assume(False)
    proof = chapsym.certify(run, bits=100)
    exact = orbit(ball, run.momentum[0], gamma, 2, COMPOSITIONS[order].exact, digits=50)
    mp = context(60)
    for k, (K, g, _, _) in enumerate(exact):
        assert length(mp, run.momentum[k], K) <= proof.momentum_error[k]
        assert length(mp, run.gamma[k], g) <= proof.gamma_error[k]
        assert all(right(text, x) for text, x in zip(proof.digits("gamma")[k], g, strict=True))


def test_a_wrong_trajectory_is_told_by_how_much():
    """The control: a frame that is moved is off by what it was moved."""
    run = chapsym.trajectory(BALL, K, GAMMA, 50)
    run.gamma[30, 1] += 1e-9
    proof = chapsym.certify(run)
    assert abs(proof.gamma_error[30] - 1e-9) < 1e-14
    assert proof.gamma_error[29] < 1e-14 > proof.gamma_error[31]


@given(st.floats(-1e6, 1e6), st.floats(0, 1e-3).map(lambda x: x if x > 1e-30 else 0.0))
def test_both_ends_of_a_ball_round_to_what_is_shown(middle, radius):
    with flint.ctx.workprec(300):
        text = proved_digits(flint.arb(middle) + flint.arb(0, radius))
    value, exponent = F(Decimal(text)), Decimal(text).as_tuple().exponent
    half = F(10) ** exponent / 2
    for end in (F(middle) - F(radius), F(middle) + F(radius)):
        assert abs(end - value) <= (half if value else 2 * half)
    if radius == 0:
        assert value == F(middle)
    elif abs(middle) > 100 * radius:
        assert F(10) ** exponent <= 1000 * F(radius)


#: A momentum beyond the bound of small-branch.
BEYOND = 0.6 * np.array([6, -2, 3]) / 7


@pytest.mark.parametrize("order", [2, 4])
def test_beyond_the_bound_of_small_branch_every_step_is_proved(order, monkeypatch):
    monkeypatch.setattr(balls.ArbBall, "_rotation", lambda *_: pytest.fail("the continuation was asked"))
    run = chapsym.trajectory(BALL, BEYOND / (1 if order == 2 else 2), GAMMA, 5, order=order)
    proof = chapsym.certify(run, bits=100)
    assert proof.selected.shape == ()
    assert proof.selected == 0
    exact = orbit(BALL, run.momentum[0], GAMMA, 5, COMPOSITIONS[order].exact, digits=50)
    for k, (K, g, _, _) in enumerate(exact):
        assert all(right(text, x) for text, x in zip(proof.digits("momentum")[k], K, strict=True))
        assert all(right(text, x) for text, x in zip(proof.digits("gamma")[k], g, strict=True))


def test_near_a_fold_the_continuation_selects_and_it_is_told():
    near = 0.999 * chapsym.fold(BALL, BEYOND, GAMMA).reach * BEYOND
    run = chapsym.trajectory(BALL, [near, BEYOND], GAMMA, 1)
    assert run.status.tolist() == [0, 0]
    proof = chapsym.certify(run, bits=100)
    assert proof.selected.tolist() == [1, 0]
    _, (_, g, _, _) = orbit(BALL, near, GAMMA, 1, digits=50)
    assert all(right(text, x) for text, x in zip(proof.digits("gamma")[0, 1], g, strict=True))


def test_a_check_of_the_path_in_balls_is_that_in_floats_where_it_is_certain():
    """On boxes round the root of the branch: yes only where it is yes at corners, too, with a slope that they have."""
    draw, said = np.random.default_rng(6), {True: 0, False: 0}
    inertia, D = BALL.inertia, float(BALL.D)
    spread = np.ptp(inertia) / 2
    for _ in range(150):
        k, g = draw.normal(size=(2, 3))
        g /= np.linalg.norm(g)
        k *= draw.uniform(0.1, 0.7) / np.linalg.norm(k)
        status, _, q0, *q = small_rotation(*2 * k, *g, *BALL.mass_tensor, D)
        if status:
            continue
        u, width = np.array(q) / q0, draw.choice([0.0, 1e-3, 0.03])
        with flint.ctx.workprec(80):
            box = [flint.arb(float(x), float(width)) for x in u]
            slope = proved_root.stretch(box, *(flint.arb(float(x)) for x in (*k, *g, *inertia, D)))
        said[slope is not None] += 1
        for corner in itertools.product((-width, width), repeat=3):
            v = u + corner
            proved, least = path.joined(v, v @ v, k, np.linalg.norm(k), g, inertia, D, spread)
            assert proved or slope is None
            assert slope is None or float(slope) <= least * (1 + 1e-9)
        assert width or (slope is not None) == proved
    assert min(said.values()) > 20


def test_a_batch_with_a_ball_that_stopped():
    ball = chapsym.Ball((1, 2, 4), 3)
    run = chapsym.trajectory(ball, [(0.3, -0.1, 0.2), (3.9, -1.95, 2.925)], GAMMA, 40, every=2)
    assert run.status.tolist() == [0, 1]
    proof = chapsym.certify(run)
    kept = int(run.taken[1]) // 2 + 1
    assert np.isfinite(proof.gamma_error[0]).all()
    assert np.isfinite(proof.gamma_error[1, :kept]).all()
    assert np.isnan(proof.gamma_error[1, kept:]).all()
    assert proof.digits("gamma")[1, -1].tolist() == ["nan"] * 3
    assert proof.selected[0] == 0 < proof.selected[1]
    assert set(proof.write()) == {"index", "selected", "momentum", "momentum_error", "gamma", "gamma_error"}


def test_the_contact_point_starts_at_that_of_the_run():
    run = chapsym.trajectory(chapsym.Ball((1, 2, 4), 3, 1.0), K, GAMMA, 6, contact=True)
    back = chapsym.reverse(run)
    proof = chapsym.certify(back)
    assert [float(x.mid()) for x in proof.contact[0]] == back.contact[0].tolist() != [0, 0]
    assert proof.contact_error.max() < 1e-15


@pytest.mark.parametrize(
    ("frames", "sentence"),
    [
        ({"index": [0, 1, 3]}, "equally far apart"),
        ({"index": [0, 0, 0]}, "equally far apart"),
        ({"index": [], "momentum": np.empty((0, 3)), "gamma": np.empty((0, 3))}, "one frame or more"),
        ({"gamma": [(0, 0, 1), (0, 0, np.inf), (0, 0, 1)]}, "trajectory.gamma has numbers that are not finite"),
        ({"momentum": [(np.nan, 0, 0)] * 3}, "trajectory.momentum has numbers that are not finite"),
        ({"contact": [(0, 0)] * 3}, "trajectory.contact needs the radius"),
    ],
)
def test_frames_that_no_run_has_are_refused(frames, sentence):
    run = chapsym.trajectory(chapsym.Ball((1, 2, 4), 3), (0.1, 0.2, 0.3), (0, 0, 1), 2)
    with pytest.raises(BadInput, match=sentence):
        chapsym.certify(replace(run, **{name: np.array(values) for name, values in frames.items()}))


def test_what_cannot_be_certified_is_refused_in_one_sentence(monkeypatch):
    run = chapsym.trajectory(BALL, K, GAMMA, 5)
    with pytest.raises(BadInput, match="certify takes what"):
        chapsym.certify(run.momentum)
    with pytest.raises(BadInput, match="bits must be"):
        chapsym.certify(run, bits=0)
    with pytest.raises(BadInput, match="bits must be a whole number from 2 to 10000000"):
        chapsym.certify(run, bits=10**9)
    with pytest.raises(BadInput, match="has no 'attitude'"):
        chapsym.certify(run).digits("attitude")
    with pytest.raises(BadInput, match="certify takes orders"):
        chapsym.certify(replace(run, order=0))
    monkeypatch.setattr(balls, "MOST_GUARD", 10)
    monkeypatch.setattr(certified, "Enclosure", partial(Enclosure, guard=10))
    with pytest.raises(BadInput, match="grow too much: after step"):
        chapsym.certify(chapsym.trajectory(BALL, K, GAMMA, 300))


@pytest.mark.parametrize("precision", ["double", "double-double"])
def test_a_run_that_keeps_its_start_only_is_certified_and_so_is_none(precision):
    proved = chapsym.certify(chapsym.trajectory(BALL, K, GAMMA, 3, every=10, precision=precision))
    assert proved.gamma.shape == (1, 3)
    assert float(proved.momentum_error[0]) == 0.0
    none = chapsym.certify(chapsym.trajectory(BALL, np.empty((0, 3)), GAMMA, 3, precision=precision))
    assert (none.momentum.shape, none.gamma_error.shape) == ((0, 4, 3), (0, 4))


def test_what_a_user_has_set_for_other_numbers_changes_nothing():
    """The decimals of Python, the bits of flint, and what NumPy raises."""

    def found():
        rolled = chapsym.roll(chapsym.Ball(BALL.mass_tensor, BALL.D), (1, 2, 3), 0.1, 2, proved=True, attitude=True)
        still = chapsym.certified_motion(chapsym.ExactBall((1, 2, 4), 3), (3, 1, 4), (0, 0, 1), 0, 12)
        with pytest.raises(BadInput, match="no body has the inertia"):
            chapsym.Ball.from_inertia((1.0, 2.0, 3.0012345), D=1)
        return [
            chapsym.certify(chapsym.trajectory(BALL, K, GAMMA, 1)).write(), still.write(),
            [getattr(rolled.proved, name).tolist() for name in ("momentum", "gamma", "attitude")],
            chapsym.rotation_number(chapsym.Ball((1, 2, 4), 3), 0.5, (0.6, 0, 0.8)),
        ]  # fmt: skip

    expected = found()
    with localcontext(prec=3, Emax=5, Emin=-5, traps=[Inexact]), np.errstate(all="raise"), flint.ctx.workprec(5):
        assert found() == expected
