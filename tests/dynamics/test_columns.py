"""Balls in columns, by NumPy alone: the same steps as `march`, to the bit, whatever the others of the batch do."""

import numpy as np

from chapsym.dynamics import columns
from chapsym.dynamics.loops import loop
from chapsym.dynamics.loops.loop import ENOUGH, RADIUS, ROWS, A


def mixture(balls):
    """Balls with |𝒦| from 1e-9 to half of the bound."""
    random = np.random.default_rng(6)
    rows = []
    for _ in range(balls):
        J, D = random.uniform(0.05, 2.0, 3), random.uniform(0.0, 3.0)
        K, g = random.normal(size=3), random.normal(size=3)
        least = J.sum() - J.max()
        K *= least * random.choice([1e-9, 1e-3, 0.05, 0.2, 0.5]) / np.linalg.norm(K)
        rows.append((K, g / np.linalg.norm(g), J, D))
    return rows


def run_columns(balls, steps):
    """The states after so many steps."""
    n = len(balls)
    state, scale = np.empty((ROWS, n)), np.empty(n)
    for i, ball in enumerate(balls):
        scale[i] = loop.prepare(*ball, state[:, i])
    frames, ends = np.full((n, 2, 3), np.nan), (np.zeros(n, dtype=np.int64), np.zeros(n, dtype=np.int64), np.ones(n))
    columns.march_columns(state, 0, steps, steps, scale, frames, frames.copy(), *ends)
    return state


def test_only_balls_without_a_certificate_take_the_safe_way_once_a_batch_rolls(monkeypatch):
    calls = []
    monkeypatch.setattr(columns, "safe_rotation", lambda *ball: calls.append(ball) or loop.safe_rotation(*ball))
    rolling = [ball for ball in mixture(20) if np.abs(ball[0]).max() < 0.1]
    assert len(rolling) >= 8
    run_columns(rolling, 12)
    begun = len(calls)
    run_columns(rolling, 40)
    assert 0 < begun == len(calls) - begun  # the first steps have nothing to extrapolate; after those, none


def chunk_of(balls, steps):
    state = run_columns(balls, steps)
    n = len(balls)
    with np.errstate(all="ignore"):
        chunk = columns.Chunk(state, np.zeros(n, dtype=np.int64), np.zeros(n, dtype=np.int64), np.ones(n))
    return chunk, n


def slow_balls(n):
    return [ball for ball in mixture(n) if np.abs(ball[0]).max() < 0.02]


def test_the_bound_for_a_whole_chunk_is_the_least_of_a_lane():
    """One lane short of it by itself is over it in sum with the others: then each lane is looked at."""
    chunk, n = chunk_of(slow_balls(120), 100)
    assert chunk.predicted()
    assert chunk.enough == chunk.S[ENOUGH, :n].min() > 0.0
    chunk.settled[:] = False
    chunk.enough = chunk.change.dot(chunk.change)
    assert chunk.predicted()
    assert not chunk.settled.any()  # the sum was enough
    chunk.enough *= 1 - 2.0**-50
    assert chunk.predicted()
    assert chunk.settled.all()  # each lane was


def test_a_worse_prediction_is_seen():
    """One lane, off by a little: the chunk's bound fails and the lane's own test names it; so does one out of reach."""
    chunk, n = chunk_of(slow_balls(120), 100)
    assert chunk.predicted()
    size = np.abs(chunk.P[4, n // 2])
    chunk.S[A, n // 2] += 1e-4 * size
    assert not chunk.predicted()
    assert np.flatnonzero(~chunk.settled).tolist() == [n // 2]
    assert chunk.corrected()
    chunk.S[RADIUS, n // 2] = 0.5 * chunk.checks[0, n // 2]
    assert not chunk.corrected()
    assert np.flatnonzero(~chunk.settled).tolist() == [n // 2]


def test_a_root_beyond_the_radius_is_seen():
    chunk, n = chunk_of(slow_balls(120), 100)
    assert chunk.predicted()
    chunk.S[RADIUS, n // 2] = 0.5 * chunk.checks[0, n // 2]
    assert not chunk.predicted()
    assert chunk.change.dot(chunk.change) <= chunk.enough
    assert np.flatnonzero(~chunk.settled).tolist() == [n // 2]


def test_a_second_correction_that_leaves_the_radius_is_seen():
    chunk, n = chunk_of(slow_balls(120), 100)
    assert chunk.predicted()
    lane = n // 2
    root = chunk.P[4:, lane].copy()
    chunk.S[A : A + 3, lane] = (1 - 1e-4) * root
    chunk.S[RADIUS, lane] = (1 - 0.5e-4) ** 2 * (root @ root)
    assert not chunk.corrected()
    assert chunk.near.all()
    chunk.S[RADIUS, lane] = (1 + 0.5e-4) ** 2 * (root @ root)
    assert chunk.corrected()


def test_a_second_correction_is_made_for_a_while():
    """Whether to try the first alone is asked again after PATIENCE steps; what comes out does not depend on it."""
    chunk, _ = chunk_of(slow_balls(120), 100)
    counted = []
    corrected = chunk.corrected
    chunk.corrected = lambda: counted.append(1) or corrected()
    chunk.step(0)
    assert not counted
    chunk.S[A] *= 1 + 1e-4
    for now in range(2 * columns.PATIENCE):
        chunk.step(now)
    assert columns.PATIENCE < len(counted) < 2 * columns.PATIENCE


def test_a_lane_that_one_correction_settled_keeps_its_rotation():
    """Its last digits differ from those of the second correction, which others of the chunk need."""
    random = np.random.default_rng(8)
    g = random.normal(size=(300, 3))
    g /= np.linalg.norm(g, axis=1, keepdims=True)
    balls = [(np.array([0.13, -0.06, 0.04]), v, np.array([0.1, 0.5, 1.6]), 0.7) for v in g]
    chunk, n = chunk_of(balls, 100)
    assert not chunk.predicted()
    once, before = chunk.settled[:n].copy(), chunk.P[:, :n].copy()
    assert chunk.corrected()
    assert 0 < once.sum() < n
    assert (chunk.P[:, :n] == before)[:, once].all()
    assert (chunk.P[:, :n] != before)[:, ~once].any(axis=0).mean() > 0.5
