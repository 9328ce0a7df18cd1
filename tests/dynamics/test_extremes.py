"""Numbers as far apart as float64 allows: an answer, a status or one sentence, and no warning."""

import warnings
from contextlib import suppress

import numpy as np
import pytest

import chapsym
from chapsym import BadInput, Ball, StepNotTaken

CALLS = {
    "roll": lambda ball, K, g: chapsym.roll(ball, K, 0.5, 2, gamma=g).kinetic_energy(),
    "trajectory": lambda ball, K, g: chapsym.trajectory(ball, K, g, 1).invariants(),
    "steady_frames": lambda ball, K, g: chapsym.steady_frames(Ball(ball.mass_tensor[[0, 0, 0]], ball.D), K, g, [0, 3]),
    "top_frames": lambda ball, K, g: chapsym.top_frames(Ball(ball.mass_tensor, 0), K, g, [0, 3]),
    "is_top": chapsym.is_top,
    "exact_top": lambda ball, K, g: chapsym.exact_top(Ball(ball.mass_tensor, 0), K, g),
    "step_vertical": lambda ball, K, g: chapsym.step_vertical(ball, K[0], g),
    "branches": chapsym.branches,
    "curve": lambda ball, K, g: chapsym.increment(chapsym.Curve.through(ball, g), K[0], 0.3),
    "extrapolate": lambda ball, K, g: chapsym.extrapolate(ball, K, g, 0.01, 1),
}


def states(count):
    """Balls with a momentum and a vertical, of any magnitudes."""
    rng = np.random.default_rng(1)
    while count:
        scale = 10.0 ** rng.uniform(-300, 300)
        kinds = 10.0 ** rng.uniform(-307, 307, 3), scale * 10.0 ** rng.uniform(-6, 6, 3), 10.0 ** rng.uniform(-2, 2, 3)
        J = kinds[rng.integers(3)]
        D = [10.0 ** rng.uniform(-307, 307), 0.0, 10.0 ** rng.uniform(-20, 120), J.max() / 7][rng.integers(4)]
        sizes = 10.0 ** rng.uniform(-300, 300), J.max() * 10.0 ** rng.uniform(-6, 0), min(D, 1e300)
        K, g = rng.normal(size=3) * min(sizes[rng.integers(3)], 1e307), rng.normal(size=3)
        try:
            yield Ball(J, D), K, g / np.linalg.norm(g)
            count -= 1
        except BadInput:
            pass


@pytest.mark.parametrize("name", CALLS)
def test_no_warning_and_no_other_error(name):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for state in states(4 if name == "branches" else 12):
            with suppress(BadInput, StepNotTaken):
                CALLS[name](*state)
