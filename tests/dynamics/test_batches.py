"""Batches: blocks and threads take the same steps as one ball alone, to the bit."""

import numpy as np
import pytest

import chapsym
from chapsym import Ball, Status
from chapsym.dynamics import block, engine

RNG = np.random.default_rng(4)


def balls(n):
    """n balls at random, some of each kind: D = 0, at rest, beyond the certificate, folding, subnormal."""
    J, D = RNG.uniform(0.1, 2.0, (n, 3)), RNG.uniform(0.0, 2.0, n)
    K, g = RNG.normal(size=(n, 3)), RNG.normal(size=(n, 3))
    K *= 0.3 * J.min(axis=1, keepdims=True) * RNG.uniform(0, 1, (n, 1)) / np.linalg.norm(K, axis=1, keepdims=True)
    for _ in range(2):
        g /= np.linalg.norm(g, axis=1, keepdims=True)
    D[0], K[1] = 0.0, 0.0
    J[2], D[2], K[2], g[2] = (1, 2, 4), 3.0, (4.32, -2.16, 3.24), np.array([2, 3, 6]) / 7  # folds at its fourth step
    J[3], D[3], K[3] = (1, 2, 4), 3.0, (3.1, 0.2, 0.1)  # beyond the certificate
    K[4] = (1e-310, 2e-309, 0)
    return Ball(J, D), K, g


@pytest.mark.parametrize("n", [9, block.LANES, 150])
def test_a_batch_is_its_balls_to_the_bit(n):
    ball, K, g = balls(n)
    run = chapsym.trajectory(ball, K, g, 2100, every=7)
    for i in [*range(8), n - 1]:
        one = Ball(ball.mass_tensor[i], ball.D[i])
        if i == 2:
            assert run.status[i] == Status.FOLDED
            assert run.taken[i] == 3
            assert np.isnan(run.momentum[i, 1:]).all()
            continue
        alone = chapsym.trajectory(one, K[i], g[i], 2100, every=7)
        assert run.status[i] == 0
        assert run.taken[i] == 2100
        assert (alone.momentum == run.momentum[i]).all()
        assert (alone.gamma == run.gamma[i]).all()


def test_without_numba_a_batch_takes_the_same_steps(monkeypatch):
    ball, K, g = balls(40)
    run = chapsym.trajectory(ball, K, g, 200, every=10)
    monkeypatch.setattr(engine, "has_numba", lambda: False)
    plain = chapsym.trajectory(ball, K, g, 200, every=10)
    assert np.array_equal(run.momentum, plain.momentum, equal_nan=True)
    assert np.array_equal(run.gamma, plain.gamma, equal_nan=True)
    for name in ("taken", "status"):
        assert (getattr(run, name) == getattr(plain, name)).all()


def test_threads_change_nothing():
    ball, K, g = balls(300)
    one, two = (chapsym.trajectory(ball, K, g, 100, threads=n) for n in (1, 2))
    assert np.array_equal(one.momentum, two.momentum, equal_nan=True)
    assert (one.taken == two.taken).all()
    assert (one.status == two.status).all()
    one, two = (chapsym.trajectory(ball, K, g, 20, attitude=True, threads=n) for n in (1, 2))
    assert np.array_equal(one.attitude, two.attitude, equal_nan=True)


def test_chunks_change_nothing(monkeypatch):
    ball, K, g = balls(70)
    whole = chapsym.trajectory(ball, K, g, 1300, every=13)
    monkeypatch.setattr(engine, "CHUNK", 97 * block.LANES)
    parts = chapsym.trajectory(ball, K, g, 1300, every=13)
    assert np.array_equal(whole.momentum, parts.momentum, equal_nan=True)
    assert (whole.taken == parts.taken).all()


def test_progress_counts_the_steps_of_all_balls():
    ball, K, g = balls(130)
    seen = []
    chapsym.trajectory(ball, K, g, 50, progress=seen.append)
    assert seen[-1] == 130 * 50
    assert seen == sorted(seen)


@pytest.mark.parametrize("threads", [1, 2])
def test_an_interrupt_ends_the_run(threads):
    ball, K, g = balls(200)

    def interrupt(done):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        chapsym.trajectory(ball, K, g, 100, threads=threads, progress=interrupt)


def test_the_integrals_stay_to_the_last_digit():
    """A million steps: compensated and restored, ⟨𝒦,γ⟩, |𝒦|² and |γ|² move by a few roundings, and do not grow."""
    run = chapsym.trajectory(
        Ball((0.1, 0.5, 1.6), 0.7), (0.03, -0.02, 0.035), np.array([2, 3, 6]) / 7, 10**6, every=1000
    )
    values = run.invariants()
    assert (np.abs(values / values[0] - 1).max(axis=0) <= 8 * 2.0**-53).all()


def test_the_energy_of_the_top_stays():
    """At D = 0 the map keeps the energy; its rounding errors add up like √n: 2e-14 in 10⁸ steps, so 2e-15 in 10⁶."""
    run = chapsym.trajectory(
        Ball((0.1, 0.5, 1.6), 0.0), (0.03, -0.02, 0.035), np.array([2, 3, 6]) / 7, 10**6, every=1000
    )
    u = discrete_energy(run)
    assert np.abs(u / u[0] - 1).max() <= 4e-15


def discrete_energy(run):
    """½⟨K, J⁻¹... ⟩ of the discrete top: the quadratic form of prop-3 for 𝒦 along its own vertical, ⟨𝒦, Λ⁻¹𝒦⟩."""
    return (run.momentum**2 / run.ball.inertia).sum(axis=-1)
