"""Numbers as far apart as float64 allows: an answer, a status or one sentence, and no warning."""

import warnings
from contextlib import suppress

import numpy as np
import pytest
from budget import slow

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
    "follow": lambda ball, K, g: chapsym.follow(ball, [0 * K, K, K / 3], g),
    "fold": chapsym.fold,
    "is_steady": chapsym.is_steady,
    "single": lambda ball, K, g: chapsym.step(ball, K, g, precision="single"),
    "double-double": lambda ball, K, g: chapsym.step(ball, K, g, precision="double-double"),
    "extrapolate": lambda ball, K, g: chapsym.extrapolate(ball, K, g, 0.01, 1),
}


#: Those of a search that warned, or ended in another error.
FOUND = [
    (Ball((3.9e307, 4e307, 6.4e307), 6.6), (6.5e-308, 2.2e-307, -9.6e-307), (0.1, 0.99, 0.0)),
    (Ball((8.5e307, 8.4e307, 8.4e307), 0.5), (1.7e-100, -1.3e-99, -5.4e-100), (-0.17, 0.0, -0.98)),
    (Ball((2.8e-307, 7.3e-307, 9e-308), 0.18), (3.2e300, -1e100, -1.1e100), (1.0, 0.0, 0.0)),
    (Ball((5.8e-200, 5.4e-200, 3.3e-200), 4.9), (-2.8, -7.1, 0.97), (0.0, 3.8e-100, -1.0)),
    (Ball((6.8e-300, 5.2e-300, 7.7e-300), 7.6e-200), (-3.1e307, 3.6e107, 5.8e206), (-1.0, 0.0, 1.9e-101)),
    (Ball((7.4e202, 5.0, 7.2), 0.0), (4e-307, -9e-309, 9.7e-308), (2.4e-100, 0.0, 1.0)),
    (Ball((4.6e-320, 3.7, 3.8e-320), 0.0), (-4.7e-101, 0.21, -0.68), (0.0, 0.29, -0.96)),
    (Ball((8.5e307, 8.4e307, 8.4e307), 0.5), (1e307, 2e307, 3e307), (-0.17, 0.0, -0.98)),
]


#: What `branches` counts exactly takes seconds.
SOME = [*((name, FOUND) for name in CALLS if name != "branches"), ("branches", [FOUND[3], FOUND[7]])]


@pytest.mark.parametrize(("name", "states"), [*SOME, *slow(("branches", FOUND[4:7]))])
def test_no_warning_and_no_other_error(name, states):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for ball, K, g in states:
            state = ball, np.array(K), np.array(g) / np.linalg.norm(g)
            with suppress(BadInput, StepNotTaken):
                CALLS[name](*state)


TURNS = chapsym.skew((1e-156, 0, 0))
OTHERS = {
    "a rod of a ball in n dimensions": lambda: chapsym.trajectory_n(
        chapsym.BallN((1e-150, 1e-150, 1e300), 0), TURNS, (0.6, 0, 0.8), 2
    ),
    "axes that are no directions": lambda: Ball((1, 2, 4), 3, axes=(1e300, 0, 0, 0)),
    "long doubles": lambda: Ball(np.array((np.longdouble("1e4000"), 1, 2), object), 1),
    "numbers beyond float64": lambda: chapsym.certified_motion(
        chapsym.ExactBall((1, 2, 4), 3), (10**320, 1, 1), (0, 0, 1), 1, 5, limit=2
    ),
}


@pytest.mark.parametrize("what", OTHERS)
def test_nor_from_what_is_not_a_state(what):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with suppress(BadInput, StepNotTaken):
            OTHERS[what]()
