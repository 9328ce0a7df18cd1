"""Trajectories in n dimensions: integrals, the way back, attitude and contact, stages, and what they refuse.

The coefficients of the stages are those of three dimensions, whose order is measured: test_composition.py.
"""

import threading

import numpy as np
import pytest
from balls_n import SIZES, UNIT_ROUNDOFF, batch, invariant_scales
from crowds import NAMES

from chapsym import (
    BadInput,
    BallN,
    axial,
    certify,
    invariants_n,
    retrace_error,
    reverse_n,
    skew,
    step_n,
    substeps,
    trajectory_n,
)
from chapsym.dynamics.n import run_n, so_n
from chapsym.dynamics.n.near_n import limits


@pytest.mark.parametrize("size", [0.05, 0.3])
@pytest.mark.parametrize("n", SIZES)
def test_the_integrals_drift_like_roundings(n, size):
    """Roundings that add up at random: 0.3 to 0.5 units · √steps, root mean square, were measured; six times that."""
    steps = 1200
    ball, K, gamma = batch(n, 6, size)
    run = trajectory_n(ball, K, gamma, steps, every=100)
    assert (run.taken == steps).all()
    values = run.invariants()
    assert values.shape == (6, 13, n // 2 + (n - 1) // 2 + 1)
    drift = np.abs(values - values[:, :1]) / invariant_scales(K)[:, np.newaxis]
    assert drift.max() <= 3 * UNIT_ROUNDOFF * np.sqrt(steps)
    assert (run.momentum == -run.momentum.mT).all()


@pytest.mark.parametrize("n", SIZES)
def test_the_invariants_are_those_of_the_matrix(n):
    _, K, gamma = batch(n, 2, 1.0)
    eigenvalues = np.linalg.eigvals(K[0])
    values = invariants_n(K, gamma)[0]
    powers = range(2, n + 1, 2)
    assert np.allclose(values[: n // 2], [(eigenvalues**p).sum().real for p in powers])
    weights = [gamma[0] @ np.linalg.matrix_power(K[0], p) @ gamma[0] for p in powers if p < n]
    assert np.allclose(values[n // 2 : -1], weights)
    assert values[-1] == pytest.approx(1)


def test_a_run_in_many_dimensions_can_be_interrupted_between_few_stages(monkeypatch):
    ball, K, gamma = batch(5, 1, 0.2)
    whole, seen = trajectory_n(ball, K, gamma, 6, order=4), []
    monkeypatch.setattr(run_n, "WORK", 2 * 10**3)  # of ten equations
    parts = trajectory_n(ball, K, gamma, 6, order=4, progress=seen.append)
    assert seen == sorted(seen)
    assert len(seen) >= 6
    assert (parts.momentum == whole.momentum).all()
    with pytest.raises(BadInput, match="the ball has n = 65, but n must be at most 64"):
        trajectory_n(BallN(np.ones(65), 1), np.zeros((65, 65)), np.eye(65)[0], 1)


@pytest.mark.parametrize("n", SIZES)
def test_the_body_turns_and_rolls_with_the_steps(n):
    """R' = RΩ, R γ = eₙ, R𝒦Rᵀ constant, and Δr = ρ/2 (Ω̄ - Ω̄ᵀ)eₙ with Ω̄ = R'Rᵀ, in the plane (4.9)."""
    ball, K, gamma = batch(n, 3, 0.2)
    run = trajectory_n(ball, K, gamma, 40, contact=True)
    R, r = run.attitude, np.concatenate([run.contact, np.zeros((3, 41, 1))], axis=-1)
    space = R[:, 1:] @ R[:, :-1].mT
    # The entries of R are rounded, and so is the product that checks them.
    assert np.abs(R @ R.mT - np.eye(n)).max() <= 2 * (n + 1) * UNIT_ROUNDOFF
    assert np.abs((R @ run.gamma[..., None])[..., 0] - np.eye(n)[-1]).max() <= 64 * UNIT_ROUNDOFF
    fixed = R @ run.momentum @ R.mT
    assert np.abs(fixed - fixed[:, :1]).max() <= 64 * UNIT_ROUNDOFF
    stride = ball.radius[:, None, None] / 2 * (space - space.mT)[..., -1]
    assert np.abs(np.diff(r, axis=1) - stride).max() <= 64 * UNIT_ROUNDOFF
    assert np.abs(stride).max() > 0.01


@pytest.mark.parametrize("order", [4, 6, 8])
@pytest.mark.parametrize("n", SIZES)
def test_a_step_is_its_stages(n, order):
    """Each turns 𝒦 and γ by the rotation that `step_n` finds from cᵢ𝒦; both round it by some ulps."""
    ball, K, gamma = batch(n, 4, 0.2)
    run = trajectory_n(ball, K, gamma, 1, order=order, attitude=True)
    momentum, vertical, attitude = K, gamma, run.attitude[:, 0]
    for c in substeps(order):
        rotation = step_n(ball, c * momentum, vertical).rotation
        momentum, vertical = rotation.mT @ momentum @ rotation, (rotation.mT @ vertical[..., None])[..., 0]
        momentum, attitude = (momentum - momentum.mT) / 2, attitude @ rotation
    allowed = 8 * UNIT_ROUNDOFF * len(substeps(order))
    assert np.abs(run.momentum[:, 1] - momentum).max() <= allowed * np.abs(K).max()
    assert np.abs(run.gamma[:, 1] - vertical).max() <= allowed
    assert np.abs(run.attitude[:, 1] - attitude).max() <= allowed


def test_each_stage_has_the_bound_of_its_own_momentum():
    ball, K, _ = batch(4, 1, 3.0, seed=4)
    stages = substeps(8)
    near, enough = limits(K, ball.mass_tensor, ball.D, stages)
    for i, c in enumerate(stages):
        one = limits(c * K, ball.mass_tensor, ball.D, np.ones(1))
        assert (near[0, i], enough[0, i]) == (one[0][0, 0], one[1][0, 0])
    assert len(set(near[0])) > 1


def test_threads_share_a_batch_and_its_bits_stay(monkeypatch):
    ball, K, gamma = batch(4, 6, 0.2)
    seen, honest = set(), run_n.advance
    monkeypatch.setattr(run_n, "advance", lambda *a: seen.add(threading.get_ident()) or honest(*a))
    runs = [trajectory_n(ball, K, gamma, 700, order=4, every=50, contact=True, threads=threads) for threads in (1, 3)]
    assert len(seen) > 1
    assert all((getattr(runs[0], name) == getattr(runs[1], name)).all() for name in NAMES)


@pytest.mark.parametrize("n", SIZES)
@pytest.mark.parametrize(
    ("tilt", "last"),
    [(np.sqrt((1 - x) * (1 + x)), x) for x in (1.0, 0.5, 0.0, -0.5, -1 + 1e-10, -1 + 1e-15, -1.0)]
    + [(tilt, -1.0) for tilt in (1e-300, 1e-20, 1e-9)],
)
def test_the_first_attitude_makes_gamma_vertical(n, tilt, last):
    """Almost upside down 1 + γₙ is 0 or has no digits, but γ has them."""
    gamma, across = np.zeros((2, n))
    gamma[:2], across[:2] = (0.6 * tilt, 0.8 * tilt), (-0.8, 0.6)
    gamma[-1] = last
    R = trajectory_n(BallN(np.ones(n), 1), np.zeros((n, n)), gamma, 0, attitude=True).attitude[0]
    assert np.abs(R @ R.T - np.eye(n)).max() <= 16 * UNIT_ROUNDOFF
    assert np.linalg.det(R) == pytest.approx(1)
    assert np.abs(R @ gamma - np.eye(n)[-1]).max() <= 16 * UNIT_ROUNDOFF
    if last > -1:  # the least rotation leaves alone what is normal to both
        assert np.abs(R @ across - across).max() <= 16 * UNIT_ROUNDOFF
        assert (R[2:-1, 2:-1] == np.eye(n)[2:-1, 2:-1]).all()


def test_a_given_attitude_is_followed():
    ball, K, gamma = batch(4, 3, 0.1)
    turn = np.eye(4)[[1, 2, 0, 3]]
    plain = trajectory_n(ball, K, gamma, 10, contact=True)
    turned = trajectory_n(ball, K, gamma, 10, contact=True, attitude=turn @ plain.attitude[:, 0])
    assert np.abs(turned.attitude - turn @ plain.attitude).max() <= 64 * UNIT_ROUNDOFF
    assert np.abs(turned.contact - plain.contact @ turn[:3, :3].T).max() <= 64 * UNIT_ROUNDOFF


def growth(ball, K, gamma, steps):
    """How much a change of 1e-7 of 𝒦 grows, relative to 𝒦, at the worst."""
    n = ball.n
    off = so_n.from_coordinates(np.linspace(1, 2, n * (n - 1) // 2), n)
    off = off * 1e-7 * np.linalg.norm(K, axis=(-2, -1), keepdims=True) / np.linalg.norm(off)
    here, there = (trajectory_n(ball, k, gamma, steps) for k in (K, K + off))
    changes = np.abs(here.momentum - there.momentum).max() / np.abs(K).max(), np.abs(here.gamma - there.gamma).max()
    return max(1.0, *(change / 1e-7 for change in changes))


@pytest.mark.parametrize(("n", "order"), [*((n, 2) for n in SIZES), (3, 6), (5, 6)])
def test_the_way_back_leads_to_the_start(n, order):
    """Each stage of the 2·steps steps adds a few roundings, which the motion magnifies by what is measured."""
    steps = 150
    ball, K, gamma = batch(n, 5, 0.1)
    run = trajectory_n(ball, K, gamma, steps, contact=True, every=30, order=order)
    back = reverse_n(run)
    assert back.order == order
    budget = 4 * UNIT_ROUNDOFF * 2 * steps * len(substeps(order)) * growth(ball, K, gamma, steps)
    assert budget < 1e-10
    assert np.abs(back.momentum[:, ::-1] + run.momentum).max() <= budget * np.abs(K).max()
    assert np.abs(back.gamma[:, ::-1] - run.gamma).max() <= budget
    assert np.abs(back.attitude[:, ::-1] - run.attitude).max() <= budget
    length = np.abs(run.contact).max()
    assert length > 0.3
    assert np.abs(back.contact[:, ::-1] - run.contact).max() <= budget * length
    assert back.index.tolist() == run.index.tolist()
    assert retrace_error(run, back).shape == (5, 6)
    assert retrace_error(run, back).max() <= budget


def test_an_empty_batch_has_empty_frames():
    run = trajectory_n(BallN(np.ones(5), 1), np.zeros((0, 5, 5)), np.eye(5)[0], 3, attitude=True)
    assert run.momentum.shape == (0, 4, 5, 5)
    assert run.attitude.shape == (0, 4, 5, 5)
    assert run.invariants().shape == (0, 4, 5)
    assert reverse_n(run).momentum.shape == (0, 4, 5, 5)


@pytest.mark.parametrize(
    ("kwargs", "sentence"),
    [
        ({"steps": -1}, "steps must be a whole number from 0 on, not -1"),
        ({"contact": True}, "the contact point needs the radius"),
        ({"attitude": np.eye(3)}, r"attitude must be rotations of the shape \(..., 4, 4\), not \(3, 3\)"),
        ({"attitude": np.zeros((2, 4, 4))}, r"attitude has the leading axes \(2,\), the states have \(\)"),
        ({"attitude": 2 * np.eye(4)}, "attitude must be rotations"),
        ({"attitude": np.diag([-1, 1, 1, 1])}, "attitude must be rotations"),
        ({"attitude": np.diag([1, 1, -1, -1])}, "attitude and gamma disagree"),
        ({"steps": 10**15}, "do not fit into memory"),
    ],
)
def test_input_without_an_answer_is_refused(kwargs, sentence):
    given = {"ball": BallN((1, 2, 0.5, 3), 3), "momentum": skew4(0.1), "gamma": (0, 0, 0, 1), "steps": 2}
    with pytest.raises(BadInput, match=sentence):
        trajectory_n(**{**given, **kwargs})


def skew4(size):
    return so_n.from_coordinates(size * np.linspace(-1, 1, 6), 4)


def test_what_does_not_fit_or_is_of_three_dimensions_only_is_refused():
    run = trajectory_n(BallN(np.ones(4), 1), np.zeros((4, 4)), np.eye(4)[0], 3)
    for call, sentence in (
        (lambda: run.at(1.5), "in three dimensions only"),
        (lambda: run.omega, "has no time step"),
        (lambda: certify(run), "must be a chapsym.Ball, not BallN"),
        (lambda: invariants_n(1e300 * skew((0, 0, 1)), (0, 0, 1)), "beyond the range of float64"),
        (lambda: axial(np.zeros((4, 4))), r"matrix must be skew matrices of the shape \(..., 3, 3\)"),
        (lambda: invariants_n(np.zeros((4, 4)), (0, 0, 1)), "gamma must have 4 components"),
    ):
        with pytest.raises(BadInput, match=sentence):
            call()
