"""Lyapunov exponents, phase volume, and averages that tell order from chaos, by the derivative of the map on orbits."""

from typing import Any

import numpy as np

from chapsym.dynamics import native
from chapsym.dynamics.loops.gibbs import HEAVY
from chapsym.dynamics.loops.tangent import follow_all

#: The columns of `follow_all`, in its order.
COLUMNS = (
    "taken", "growth1", "growth2", "growth3", "volume_first", "volume_second", "energy_first", "energy_second",
    "energy_low", "energy_high",
)  # fmt: skip


def follow_orbits(ball: Any, momenta: np.ndarray, gammas: np.ndarray, steps: int) -> dict[str, np.ndarray]:
    """The `COLUMNS` of each orbit of a ball, from the starts (n, 3) and (n, 3); NaN where an orbit met a fold.

    Raises ValueError for a heavy ball: its Gibbs vector needs another kernel.
    """
    if (HEAVY * ball.inertia.min() < ball.D).any():
        raise ValueError("the derivative of the step is computed for balls with D ≤ 32 I_min only")
    rows = np.empty((len(momenta), len(COLUMNS)))
    follow = native.loop(follow_all)
    follow(np.ascontiguousarray(momenta), np.ascontiguousarray(gammas), ball.mass_tensor, float(ball.D), steps, rows)
    rows[rows[:, 0] < 2 * (steps // 2), 1:] = np.nan
    return dict(zip(COLUMNS, rows.T, strict=True))
