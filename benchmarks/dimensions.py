"""n dimensions: a trajectory, and the same steps, each continued from the identity, as they are above the bound."""

from collections.abc import Callable
from functools import partial

import numpy as np

import chapsym
from chapsym.dynamics.n import so_n
from chapsym.dynamics.n.branch_n import small_rotation
from chapsym.files import Data

from .harness import NotComparable, Say
from .results import Reached, Result, beside, timed

CONTINUED = "continued"
#: The ball of n dimensions has the first n moments; 𝒦, row by row below the diagonal, and γ are cut likewise.
MASS_TENSOR, D, RADIUS = (1.0, 2.0, 0.5, 3.0, 1.5, 2.5, 0.8, 1.2), 3.0, 0.1
#: |𝒦|, as a matrix.
EPSILON = 0.05
BATCH = 64
#: Steps of a trajectory, and of those one by one.
STEPS, FEW = 3000, 30
#: How far the two may be apart after FEW steps, relative to 𝒦.
ROUNDING = 2.0**-44
#: Microseconds for a step of one ball in four dimensions.
WANTED = 5.0


def start(n: int) -> tuple[chapsym.BallN, np.ndarray, np.ndarray]:
    """A ball in n dimensions, 𝒦 and γ."""
    K = np.tril(np.cos(np.arange(1.0, n * n + 1)).reshape(n, n), -1)
    K, gamma = (x / np.linalg.norm(x) for x in (K - K.T, 2.0 + np.sin(np.arange(n))))
    return chapsym.BallN(MASS_TENSOR[:n], D, radius=RADIUS), EPSILON * K, gamma


def trajectory(n: int, steps: int, balls: int = 1, contact: bool = False) -> np.ndarray:
    """𝒦 at the end of a trajectory, of the first ball."""
    ball, K, gamma = start(n)
    run = chapsym.trajectory_n(ball, np.broadcast_to(K, (balls, n, n)), gamma, steps, every=steps, contact=contact)
    return run.momentum[0, -1]


def continued(n: int, steps: int, balls: int = 1) -> np.ndarray:
    """The same, each step by the continuation."""
    ball, K, gamma = start(n)
    K, gamma = np.broadcast_to(K, (balls, n, n)), np.broadcast_to(gamma, (balls, n))
    J, D = np.broadcast_to(ball.mass_tensor, (balls, n)), np.broadcast_to(ball.D, balls)
    for _ in range(steps):
        E, _, _ = small_rotation(K, gamma, J, D)
        K, gamma = so_n.carried(K, E), so_n.transported(gamma, E)
    return K[0]


def measure(quick: bool, on_round: Say = lambda text: None) -> Result:
    """Times one ball, one with its contact point, and a batch, on one core; the ends are compared before."""
    rounds, rows = 3 if quick else 9, list[Data]()
    steps = STEPS // 10 if quick else STEPS
    for n in (4,) if quick else (3, 4, 5, 6, 8):
        apart = float(np.abs(trajectory(n, FEW) - continued(n, FEW)).max() / EPSILON)
        if not apart <= ROUNDING:
            raise NotComparable(f"n = {n}: the trajectory differs from its steps, continued, by {apart:.1e}")
        for setting, balls, many in (("one ball", 1, 1), (f"{BATCH} balls", BATCH, 10)):
            sides: dict[str, Callable[..., object]] = {setting: partial(trajectory, n, steps // many, balls)}
            if balls == 1:
                sides[f"{setting}, contact"] = partial(trajectory, n, steps, contact=True)
            runs = {name: (run, steps // many * balls) for name, run in sides.items()}
            runs[home := f"{setting}, {CONTINUED}"] = partial(continued, n, FEW // many, balls), FEW // many * balls
            timings = timed(runs, rounds, on_round, f"n = {n}, {setting}")
            rows += beside(timings, home, "µs a ball and step", {"n": n}, apart, CONTINUED)
    four = next(row for row in rows if row["n"] == 4 and row["name"] == "one ball")
    reach = [Reached("n = 4, one ball, µs a step", four["µs a ball and step"], WANTED, False)]
    return Result("n dimensions, one core", rows, reach=reach)
