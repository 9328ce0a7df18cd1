"""The map on SO(n) × Sⁿ⁻¹ for every n ≥ 3 (Section 4), in float64, for one ball or a batch.

The state is 𝒦, skew, and γ, a unit vector.  A step finds the rotation Ω with 𝒦(Ω, γ) = 𝒦 (4.13) that is
continued from the identity, and goes to Ωᵀ𝒦Ω and Ωᵀγ (4.11, 4.12).  For n = 3 it is `step`, in matrices.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..ball import Floats
from ..errors import Status, StepNotTaken
from . import so_n
from .ball_n import BallN, flat_states
from .branch_n import small_rotation

#: The Jacobians of the balls that are solved together take about this many numbers: what a cache holds.
BLOCK = 2**15


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


def step_n(ball: BallN, momentum: ArrayLike, gamma: ArrayLike) -> StepN:
    """One step of the map (4.11), (4.12), (4.13) on the small-rotation branch.

    momentum: 𝒦 = ε K of the paper, skew, in kg m², (..., n, n); gamma: unit verticals, (..., n).
    Both broadcast with each other and with the balls.

    One ball (no leading axis) raises StepNotTaken if it has no step; a batch reports `status` instead.
    Raises BadInput for shapes, NaN, infinities, a momentum that is not skew, and a gamma that is not unit.
    """
    shape, (K, g, J, D) = flat_states(ball, momentum, gamma)
    E, status, reach = np.empty_like(K), np.zeros(len(D), dtype=np.int64), np.ones(len(D))
    for block in blocks(len(D), ball.n):
        E[block], status[block], reach[block] = small_rotation(K[block], g[block], J[block], D[block])
    if not shape and status[0] != Status.TAKEN:
        raise StepNotTaken(Status(int(status[0])), float(reach[0]))
    K, g = so_n.carried(K, E), so_n.transported(g, E)
    return StepN(
        (np.eye(ball.n) + E).reshape(*shape, ball.n, ball.n), K.reshape(*shape, ball.n, ball.n),
        g.reshape(*shape, ball.n), status.reshape(shape), reach.reshape(shape),
    )  # fmt: skip


def blocks(balls: int, n: int) -> Iterator[slice]:
    """Slices of a batch whose balls are solved together."""
    size = max(1, BLOCK // (n * n * n * (n - 1) // 2))
    return (slice(first, first + size) for first in range(0, balls, size))
