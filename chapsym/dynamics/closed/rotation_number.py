"""The rotation number of the reduced map G_h on its curve: turns a step, in the mean."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..ball import Ball, Floats
from ..errors import BadInput
from .elliptic import Curve, increment
from .vertical import step_vertical, trajectory_vertical

#: Turns that are averaged over, and the least and most steps for them.
TURNS, LEAST, MOST = 100, 2**11, 2**18


def phases(curve: Curve, height: float, gamma: ArrayLike) -> Floats:
    """u of successive γ of G_h, (steps + 1, 3), going on from turn to turn, (steps + 1,).

    The increments vary with u, by less than a turn: each is taken nearest to that of the first step, which is the
    branch's (`increment`).
    """
    u = curve.argument(gamma)
    period, first = curve.period, float(increment(curve, height, u[0]))
    steps = np.diff(u)
    steps += period * np.round((first - steps) / period)
    return np.concatenate([u[:1], u[0] + np.cumsum(steps)])


def rotation_number(ball: Ball, height: float, gamma: ArrayLike) -> float:
    """Turns around the curve of γ a step of G_h with 𝒦 = hγ, in the mean over infinitely many; negative against u.

    height: h in kg m²; gamma: (3,).  A mean with weights exp(-1/t(1-t)) over some hundred turns, whose error falls
    faster than any power of their number (Das and Yorke's weighted Birkhoff average): to about 1e-12 turns for a curve
    that is not next to the separatrix.  For D = 0 every increment is the same, and this is one of them.
    Raises BadInput for a batch, a γ that the map fixes and a curve on the separatrix, and StepNotTaken.
    """
    curve = Curve.through(ball, gamma)
    if curve.complement == 0.0:
        raise BadInput("on the separatrix there is no turn, so no rotation number")
    start = float(curve.argument(gamma))
    step_vertical(ball, height, gamma)  # raises where there is none
    turn = abs(float(increment(curve, height, start))) / curve.period
    steps = LEAST if turn * LEAST >= TURNS else min(int(TURNS / turn), MOST) if turn * MOST > TURNS else MOST
    u = phases(curve, height, trajectory_vertical(ball, height, gamma, steps).gamma)
    t = np.arange(1, steps + 1) / (steps + 1)
    weights = np.exp(-1.0 / (t * (1.0 - t)))
    return float(weights @ np.diff(u) / weights.sum() / curve.period)
