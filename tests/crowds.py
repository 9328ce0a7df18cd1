"""Balls of every kind, for the loops that take many at once."""

import numpy as np

import chapsym
from chapsym import Ball, Status, StepNotTaken
from chapsym.dynamics.loops import block

NAMES = ("momentum", "gamma", "attitude", "contact")


def balls(n, tiny=1e-310, heavy=1e14):
    """Balls at random, some of each kind: D = 0, at rest, beyond the certificate, folding, tiny, heavy."""
    random = np.random.default_rng(n)
    J, D = random.uniform(0.1, 2.0, (n, 3)), random.uniform(0.0, 2.0, n)
    K, g = random.normal(size=(n, 3)), random.normal(size=(n, 3))
    K *= 0.3 * J.min(axis=1, keepdims=True) * random.uniform(0, 1, (n, 1)) / np.linalg.norm(K, axis=1, keepdims=True)
    for _ in range(2):
        g /= np.linalg.norm(g, axis=1, keepdims=True)
    D[0], K[1] = 0.0, 0.0
    J[2], D[2], K[2], g[2] = (1, 2, 4), 3.0, (4.32, -2.16, 3.24), np.array([2, 3, 6]) / 7  # folds at its fourth step
    J[3], D[3], K[3] = (1, 2, 4), 3.0, (3.1, 0.2, 0.1)  # beyond the certificate
    K[4] = (tiny, 20 * tiny, 0)
    D[5:8], K[8] = (1e2, 1e6, heavy), 1e4 * K[8]  # and more than any rotation has
    J[9], D[9], K[9], g[9] = (1, 0, 0), 1.0, (0, 0, 1), (1, 0, 0)  # no inertia about its vertical
    K[10] = 0.3 * J[10].min() * g[10]  # vertical
    return Ball(J, D), K, g


def seeded(n, D, seed=11):
    """n balls with states at random, and one D."""
    rng = np.random.default_rng(seed)
    J, g, K = rng.uniform(0.1, 2, (n, 3)), rng.normal(size=(n, 3)), rng.normal(size=(n, 3))
    return Ball(J, np.full(n, D)), K, g / np.linalg.norm(g, axis=1, keepdims=True)


def long_steps(n):
    """n balls whose steps need more than one round, up to a little below the bound of the certificate."""
    random = np.random.default_rng(9)
    K, g = random.normal(size=(n, 3)), random.normal(size=(n, 3))
    K *= random.choice([0.25, 0.3, 0.4, 0.45], (n, 1)) / np.linalg.norm(K, axis=1, keepdims=True)
    if n > block.LANES:
        K[3] *= 0.7 / np.linalg.norm(K[3])
    return Ball((0.1, 0.5, 1.6), 0.7), K, g / np.linalg.norm(g, axis=1, keepdims=True)


def beyond(n):
    """n balls beyond the bound of the certificate: most are proved on the path, some in a second round, some fold."""
    random = np.random.default_rng(9)
    K, g = random.normal(size=(n, 3)), random.normal(size=(n, 3))
    K *= random.choice([0.5, 0.6, 0.8, 1.0], (n, 1)) / np.linalg.norm(K, axis=1, keepdims=True)
    return Ball((0.1, 0.5, 1.6), 0.7), K, g / np.linalg.norm(g, axis=1, keepdims=True)


def floats_of(run):
    """All arrays of a run; of pairs both halves."""
    halves = [run] if run.low is None else [run, run.low]
    found = (getattr(half, name) for half in halves for name in NAMES)
    return [array for array in found if array is not None]


def alone(*arguments, **options):
    """A run of one ball up to its end, why it ended there and after how many steps."""
    try:
        run = chapsym.trajectory(*arguments, **options)
    except StepNotTaken as stopped:
        return stopped.trajectory, stopped.status, stopped.index
    return run, Status.TAKEN, run.taken


def same(state, other, frame=None):
    """Whether two have the same state, to the bit; of a trajectory its frame."""
    for name in NAMES:
        a, b = getattr(state, name), getattr(other, name)
        assert (a is None) == (b is None), name
        assert a is None or np.array_equal(a, b if frame is None else b[frame]), name
    return True
