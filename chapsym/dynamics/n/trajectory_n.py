"""The map on SO(n) × Sⁿ⁻¹ for every n ≥ 3 (Section 4): steps and trajectories of one ball or a batch.

The state is 𝒦, skew, and γ, a unit vector.  A step finds the rotation Ω with 𝒦(Ω, γ) = 𝒦 (4.13) that is
continued from the identity, and goes to Ωᵀ𝒦Ω and Ωᵀγ (4.11, 4.12).  For n = 3 it is `step`, in matrices.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import Precision

from ..ball import Asked, Floats, numbers
from ..errors import BadInput, Status, StepNotTaken
from ..results import finished
from ..reversal import way_back
from ..trajectories import whole_number
from .ball_n import BallN, skew_matrices
from .run_n import start, stepped


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
    shape, state = start(ball, momentum, gamma)
    state["attitude"] = np.broadcast_to(np.eye(ball.n), state["momentum"].shape)
    frames, _, status, reach = stepped(precision, state, 2, 1, 1)
    if not shape and status[0] != Status.TAKEN:
        raise StepNotTaken(Status(int(status[0])), float(reach[0]))
    momentum, gamma, rotation = (x[:, 1].reshape(*shape, *x.shape[2:]) for x in frames.values())
    return StepN(rotation, momentum, gamma, status.reshape(shape), reach.reshape(shape))


@dataclass(frozen=True, eq=False)
class TrajectoryN:
    """States of one ball, shape (frames, ...), or of a batch, shape (balls..., frames, ...).

    index: the step number of each frame, (frames,).
    momentum, gamma: 𝒦 (..., frames, n, n), in kg m², and γ (..., frames, n); with Digits(N), here and below, mpmath's
    numbers, in arrays of objects.
    attitude: R from the body to space, R γ = eₙ, (..., frames, n, n), or None.
    contact: the contact point on the hyperplane in metres, from 0, (..., frames, n-1), or None.
    taken: the number of steps that were taken, (...); frames after it are NaN.
    status: why a ball stopped, a `Status`, (...).
    order: of the composition that made the steps; 2 for the map itself.
    """

    ball: BallN
    index: np.ndarray
    momentum: Floats
    gamma: Floats
    attitude: Asked
    contact: Asked
    taken: np.ndarray
    status: np.ndarray
    order: int = 2

    def invariants(self) -> Floats:
        """`invariants_n` of each frame, (..., frames, m); raises BadInput if a ball stopped early."""
        if (self.taken < self.index[-1]).any():
            raise BadInput("a ball of the batch stopped early; choose the frames up to `taken` first")
        return _invariants(self.momentum, self.gamma)


def trajectory_n(
    ball: BallN,
    momentum: ArrayLike,
    gamma: ArrayLike,
    steps: int,
    *,
    order: int = 2,
    every: int = 1,
    attitude: bool | ArrayLike = False,
    contact: bool = False,
    threads: int = 0,
    precision: str | Precision = "double",
) -> TrajectoryN:
    """Takes `steps` steps of the map on the small-rotation branch and keeps every `every`-th state.

    momentum, gamma: as for `step_n`.
    order: 2, or 4, 6, 8 for a symmetric composition of the map with stages cᵢ𝒦 (`substeps`), as for `trajectory`.
    attitude: True (from the least rotation with R γ = eₙ) or rotations, (..., n, n), to be followed.
    contact: whether to trace the contact point; it needs `ball.radius`, and implies the attitude.
    threads: how many cores a batch may use where its steps are compiled; 0 for all.
    precision: "double", or `Digits(N)` for N digits in mpmath's numbers, at milliseconds a step.  That starts from the
    floats that are given, γ divided by its length, and the attitude from the rotation nearest to that of float64.

    A ball below the bound of `near_n` begins each step at a guess by the last ones, compiled;
    one above it is continued from the identity at each step.
    One ball that cannot take a step raises StepNotTaken with `index` and the `trajectory` before it.
    In a batch the others go on, and `status` and `taken` say which stopped, where.
    Raises BadInput as `step_n` does, and for counts that are not whole numbers.
    """
    steps, every = whole_number(steps, "steps", 0), whole_number(every, "every", 1)
    threads = whole_number(threads, "threads", 0)
    every = min(every, steps + 1)
    shape, state = start(ball, momentum, gamma, attitude, contact)
    frames, taken, status, reach = stepped(precision, state, order, steps, every, threads)
    shaped = {name: array.reshape(*shape, *array.shape[1:]) for name, array in frames.items()}
    result = TrajectoryN(
        ball, np.arange(0, steps + 1, every), shaped["momentum"], shaped["gamma"], shaped.get("attitude"),
        shaped.get("contact"), taken.reshape(shape), status.reshape(shape), int(order),
    )  # fmt: skip
    return finished(result, reach)


def reverse_n(trajectory: TrajectoryN) -> TrajectoryN:
    """The trajectory back from the last frame: from (-𝒦, γ) the map takes the same steps with Ωᵀ.

    Its frame j is the time reversal of the frame -1 - j: 𝒦 has the other sign, γ, attitude and contact are
    the same, up to rounding.  Raises BadInput if a ball stopped early, StepNotTaken as `trajectory_n` does
    (only for a step so large that the way back leaves the small-rotation branch).
    """
    if not isinstance(trajectory, TrajectoryN):
        raise BadInput(f"reverse_n takes a TrajectoryN, not {type(trajectory).__name__}")
    if trajectory.momentum.dtype == object:
        raise BadInput("reverse_n takes trajectories in double precision: a run at N digits starts from floats")
    if (trajectory.status != Status.TAKEN).any():
        raise BadInput("a ball of the batch stopped early; reverse the balls that did not")
    steps, every = int(trajectory.index[-1]), int((*trajectory.index, 1)[1])
    return cast(TrajectoryN, way_back(trajectory_n, trajectory, steps, every))


def invariants_n(momentum: ArrayLike, gamma: ArrayLike) -> Floats:
    """What the map keeps on every branch (prop-2): functions of 𝒦 and γ that no rotation of both changes.

    momentum: skew, (..., n, n); gamma: (..., n).  Returns (..., m): tr 𝒦²ʲ for j = 1, ..., ⌊n/2⌋, then
    γᵀ𝒦²ʲγ for j = 1, ..., ⌊(n-1)/2⌋, then |γ|²: as many as are independent.
    Raises BadInput as `step_n` does.
    """
    K = numbers(momentum, "momentum")
    K = skew_matrices(K, K.shape[-1] if K.ndim else 3)
    return _invariants(K, numbers(gamma, "gamma", K.shape[-1]))


def _invariants(K: Floats, gamma: Floats) -> Floats:
    """The same of what was checked, floats or other numbers."""
    n, g = K.shape[-1], gamma[..., np.newaxis]
    square, power, moved = K @ K, np.eye(n), g
    traces, weights = [], []
    for j in range(1, n // 2 + 1):
        power, moved = power @ square, square @ moved
        traces.append(np.trace(power, axis1=-2, axis2=-1))
        weights += [(g.mT @ moved)[..., 0, 0]] if j <= (n - 1) // 2 else []
    return np.stack(np.broadcast_arrays(*traces, *weights, (g.mT @ g)[..., 0, 0]), axis=-1)
