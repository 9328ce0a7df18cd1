"""Balls in columns, by NumPy alone: the same steps as `march`, to the bit, whatever the others of the batch do."""

import numpy as np
import pytest

from chapsym.dynamics import columns
from chapsym.dynamics.errors import Status
from chapsym.dynamics.loops import loop
from chapsym.dynamics.loops.loop import ENOUGH, RADIUS, ROWS, A

#: A step of this ball folds: the fourth.
FOLDING = ((4.32, -2.16, 3.24), (2 / 7, 3 / 7, 6 / 7), (1, 2, 4), 3)
#: Beyond the bound of lemma `small-branch`: every step takes the safe way.
UNCERTIFIED = ((1.5, -1.0, 1.2), (2 / 7, 3 / 7, 6 / 7), (0.2, 2, 4), 3)
STILL = ((0.0, 0.0, 0.0), (0.0, 0.6, 0.8), (1, 2, 4), 3)
VERTICAL = ((0.31 * 2 / 7, 0.31 * 3 / 7, 0.31 * 6 / 7), (2 / 7, 3 / 7, 6 / 7), (1, 2, 4), 3)
NO_CONTACT = ((0.2, -0.1, 0.15), (2 / 7, 3 / 7, 6 / 7), (1, 2, 4), 0)
#: No inertia about its axis: the first step cannot be taken.
NEEDLE = ((0.1, 0.0, 0.0), (0.6, 0.0, 0.8), (0, 0, 1), 0)
SUBNORMAL = ((1e-310, 2e-309, 0.0), (2 / 7, 3 / 7, 6 / 7), (1, 2, 4), 3)
SPECIAL = [FOLDING, UNCERTIFIED, STILL, VERTICAL, NO_CONTACT, NEEDLE, SUBNORMAL]


def mixture(balls, seed=5):
    """The special balls among others with |𝒦| from 1e-9 to half of the bound, shuffled."""
    random = np.random.default_rng(seed)
    rows = list(SPECIAL)
    while len(rows) < balls:
        J, D = random.uniform(0.05, 2.0, 3), random.uniform(0.0, 3.0)
        K, g = random.normal(size=3), random.normal(size=3)
        least = J.sum() - J.max()
        K *= least * random.choice([1e-9, 1e-3, 0.05, 0.2, 0.5]) / np.linalg.norm(K)
        rows.append((K, g / np.linalg.norm(g), J, D))
    order = random.permutation(len(rows))
    return [tuple(np.array(x, dtype=float) for x in rows[i]) for i in order], order


def run_columns(balls, counts, every):
    """The frames and the ends of `march_columns`, called once for each of `counts`."""
    n, frames = len(balls), sum(counts) // every + 1
    state, scale = np.empty((ROWS, n)), np.empty(n)
    for i, ball in enumerate(balls):
        scale[i] = loop.prepare(*ball, state[:, i])
    momenta, verticals = (np.full((n, frames, 3), np.nan) for _ in "Kg")
    taken, status, reach = np.zeros(n, dtype=np.int64), np.zeros(n, dtype=np.int64), np.ones(n)
    first = 0
    for count in counts:
        columns.march_columns(state, first, count, every, scale, momenta, verticals, taken, status, reach)
        first += count
    return state, momenta, verticals, taken, status, reach


def run_march(ball, steps, every):
    """The same of one ball by `march`."""
    state = np.zeros(ROWS)
    scale = loop.prepare(*ball, state)
    momenta, verticals = (np.full((steps // every + 1, 3), np.nan) for _ in "Kg")
    ends = loop.march(
        state, 0, steps, every, scale, momenta, verticals,
        False, np.zeros(4), np.zeros(2), 0.0, np.zeros((0, 4)), np.zeros((0, 2)),
    )  # fmt: skip
    return state, momenta, verticals, ends


def compare(balls, found, steps, every):
    state, momenta, verticals, taken, status, reach = found
    for i, ball in enumerate(balls):
        end, frames, others, (went, why, part) = run_march(ball, steps, every)
        assert (taken[i], status[i]) == (went, why), i
        assert reach[i] == part, i
        assert np.array_equal(momenta[i], frames, equal_nan=True), i
        assert np.array_equal(verticals[i], others, equal_nan=True), i
        assert np.array_equal(state[:, i], end), i


@pytest.mark.parametrize(("counts", "every"), [((40,), 1), ((17, 26), 5), ((3,), 7), ((70, 30), 100)])
def test_columns_take_the_steps_of_march_to_the_bit(counts, every, monkeypatch):
    """Also where a ball rests, for a later call, and where a frame falls between two calls."""
    monkeypatch.setattr(columns, "LANES", 10)  # 27 balls: chunks of 9, each with lanes to spare
    balls, order = mixture(27)
    with np.errstate(all="ignore"):
        found = run_columns(balls, counts, every)
        compare(balls, found, sum(counts), every)
    stopped = {SPECIAL.index(NEEDLE): (0, Status.NO_INERTIA)}
    if sum(counts) > 3:
        stopped[SPECIAL.index(FOLDING)] = 3, Status.FOLDED
    for i, taken, status in zip(order, *found[3:5], strict=True):
        assert (taken, status) == stopped.get(i, (sum(counts), Status.TAKEN))


def test_the_restored_integrals_are_those_of_march_to_the_bit():
    """A still ball has none to restore; one with a vertical momentum has its own way."""
    balls = [STILL, VERTICAL, NO_CONTACT]
    balls = [tuple(np.array(x, dtype=float) for x in ball) for ball in balls]
    compare(balls, run_columns(balls, (1030, 1030), 206), 2060, 206)


def test_only_balls_without_a_certificate_take_the_safe_way_once_a_batch_rolls(monkeypatch):
    balls, order = mixture(20)
    calls = []

    def counted(*arguments):
        calls.append(arguments)
        return loop.safe_rotation(*arguments)

    run = run_columns(balls, (100,), 100)
    keep = (run[4] == 0) & ~np.isin(order, [SPECIAL.index(UNCERTIFIED), SPECIAL.index(SUBNORMAL)])
    monkeypatch.setattr(columns, "safe_rotation", counted)
    rolling = [ball for ball, going in zip(balls, keep, strict=True) if going and np.abs(ball[0]).max() < 0.1]
    assert len(rolling) >= 8
    run_columns(rolling, (12,), 12)
    begun = len(calls)
    run_columns(rolling, (40,), 40)
    assert 0 < begun == len(calls) - begun  # the first steps have nothing to extrapolate; after those, none


def chunk_of(balls, steps):
    state, *_ = run_columns(balls, (steps,), steps)
    n = len(balls)
    with np.errstate(all="ignore"):
        chunk = columns.Chunk(state, np.zeros(n, dtype=np.int64), np.zeros(n, dtype=np.int64), np.ones(n))
    return chunk, n


def slow_balls(n):
    balls, _ = mixture(n)
    return [ball for ball in balls if 1e-300 < np.abs(ball[0]).max() < 0.02]


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


def test_columns_beyond_the_balls_stay():
    balls, _ = mixture(7)
    state, *rest = run_columns(balls, (5,), 5)
    wide = np.full((ROWS, 9), 7.0)
    for i, ball in enumerate(balls):
        loop.prepare(*ball, wide[:, i])
    momenta, verticals = (np.full((7, 2, 3), np.nan) for _ in "Kg")
    ends = np.zeros(7, dtype=np.int64), np.zeros(7, dtype=np.int64), np.ones(7)
    columns.march_columns(wide, 0, 5, 5, np.ones(7), momenta, verticals, *ends)
    assert np.array_equal(wide[:, :7], state)
    assert (wide[:, 7:] == 7.0).all()
    assert np.array_equal(ends[0], rest[2])


def test_no_balls_and_no_steps_are_nothing():
    state = np.zeros((ROWS, 0))
    none, nothing = np.zeros((0, 1, 3)), np.zeros(0, dtype=np.int64)
    columns.march_columns(state, 0, 5, 1, np.zeros(0), none, none, nothing, nothing, np.zeros(0))
    balls, _ = mixture(7)
    found = run_columns(balls, (0,), 1)
    compare(balls, found, 0, 1)
