"""The map on SO(n) × Sⁿ⁻¹ for every n ≥ 3 (Section 4), in float64, for one ball or a batch.

The state is 𝒦, skew, and γ, a unit vector.  A step finds the rotation Ω with 𝒦(Ω, γ) = 𝒦 (4.13) that is
continued from the identity, and goes to Ωᵀ𝒦Ω and Ωᵀγ (4.11, 4.12).  For n = 3 it is `step`, in matrices.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import Precision

from ..ball import Floats
from ..errors import Status, StepNotTaken
from .ball_n import BallN, flat_states
from .run_n import stepped


@dataclass(frozen=True, eq=False)
class StepN:
    """The outcome of one step, for one ball or a batch with the leading axes (...).

    rotation: Ω of the step in the body, (..., n, n).
    momentum, gamma: 𝒦 (..., n, n), in kg m², and γ (..., n) after the step.
    status: a `Status` for each ball, (...); where it is not TAKEN the numbers above are NaN.
    reach: the fraction of the momentum that the small-rotation branch attains, (...).
    """

    rotation: Floats
    momentum: Floats
    gamma: Floats
    status: np.ndarray
    reach: Floats


def step_n(ball: BallN, momentum: ArrayLike, gamma: ArrayLike, *, precision: str | Precision = "double") -> StepN:
    """One step of the map (4.11), (4.12), (4.13) on the small-rotation branch: the first step of `trajectory_n`.

    momentum: 𝒦 = ε K of the paper, skew, in kg m², (..., n, n); gamma: unit verticals, (..., n).
    Both broadcast with each other and with the balls.
    precision: "double", or `Digits(N)` for N digits in mpmath's numbers, from the floats that are given.

    One ball (no leading axis) raises StepNotTaken if it has no step; a batch reports `status` instead.
    Raises BadInput for shapes, NaN, infinities, a momentum that is not skew, and a gamma that is not unit.
    """
    shape, (K, g, J, D) = flat_states(ball, momentum, gamma)
    turn = np.broadcast_to(np.eye(ball.n), K.shape)
    state = {"momentum": K, "gamma": g, "mass_tensor": J, "D": D, "attitude": turn}
    frames, _, status, reach = stepped(precision, state, 2, 1, 1)
    if not shape and status[0] != Status.TAKEN:
        raise StepNotTaken(Status(int(status[0])), float(reach[0]))
    momentum, gamma, rotation = (x[:, 1].reshape(*shape, *x.shape[2:]) for x in frames.values())
    return StepN(rotation, momentum, gamma, status.reshape(shape), reach.reshape(shape))
