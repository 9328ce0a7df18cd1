"""The map on SO(n) × Sⁿ⁻¹ for every n ≥ 3 (Section 4): steps and trajectories, and one ball under way.

The state is 𝒦, skew, and γ, a unit vector.  A step finds the rotation Ω with 𝒦(Ω, γ) = 𝒦 (4.13) that is
continued from the identity, and goes to Ωᵀ𝒦Ω and Ωᵀγ (4.11, 4.12).  For n = 3 it is `step`, in matrices.
"""

from __future__ import annotations

from copy import deepcopy
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import Digits, Double, Precision

from ..ball import Floats, in_shape, is_followed
from ..coefficients import COMPOSITIONS, substeps
from ..errors import BadInput, Status, StepNotTaken
from ..levels.dispatch import no_room, precision_of
from ..levels.frames import Count
from ..results import Step, Trajectory, finished, of_balls
from ..stepper import UnderWay
from ..trajectories import flag, whole_number
from .ball_n import BallN, skew_matrices
from .near_n import limits
from .run_n import MOVING, advance, begun, continued, run, start

#: Nobody counts the steps of a call.
UNCOUNTED = Count(lambda done: None)


def _stepped(
    precision: str | Precision, state: dict[str, Floats], order: int, steps: int, every: int, threads: int = 1
) -> tuple[dict[str, Floats], np.ndarray, np.ndarray, Floats]:
    """The frames of a run from its start on, (b, frames, ...), and (taken, status, reach), (b,); or BadInput."""
    chosen, stages, count = precision_of(precision), substeps(order), steps // every + 1
    if not isinstance(chosen, Double | Digits):
        raise BadInput(f'in n dimensions precision is "double" or chapsym.Digits(N), not {precision!r}')
    moving = {name: state[name] for name in MOVING if name in state}
    try:
        frames = {name: np.full((len(x), count, *x.shape[1:]), np.nan, chosen.dtype) for name, x in moving.items()}
    except (MemoryError, ValueError):
        raise no_room(count, len(state["gamma"])) from None
    if isinstance(chosen, Double):
        return frames, *run(state, frames, stages, steps, every, threads)
    from . import precise_n  # mpmath takes 40 ms

    return frames, *precise_n.run(chosen, state, frames, COMPOSITIONS[order].exact, steps, every)


#: What `step_n` and `trajectory_n` return.
StepN, TrajectoryN = Step, Trajectory


def step_n(ball: BallN, momentum: ArrayLike, gamma: ArrayLike, *, precision: str | Precision = "double") -> Step:
    """One step of the map (4.11), (4.12), (4.13) on the small-rotation branch: the first step of `trajectory_n`.

    momentum: 𝒦 = ε K of the paper, skew, in kg m², (..., n, n); gamma: unit verticals, (..., n).
    Both broadcast with each other and with the balls.
    precision: "double", or `Digits(N)` for N digits in mpmath's numbers, from the floats that are given.

    One ball (no leading axis) raises StepNotTaken if it has no step; a batch reports `status` instead.
    Raises BadInput for shapes, NaN, infinities, a momentum that is not skew, and a gamma that is not unit.
    """
    shape, state = start(ball, momentum, gamma)
    state["attitude"] = np.broadcast_to(np.eye(ball.n), state["momentum"].shape)
    frames, _, status, reach = _stepped(precision, state, 2, 1, 1)
    if not shape and status[0] != Status.TAKEN:
        raise StepNotTaken(Status(int(status[0])), float(reach[0]))
    momentum, gamma, rotation = (in_shape(shape, x[:, 1]) for x in frames.values())
    return Step(rotation, momentum, gamma, status.reshape(shape), reach.reshape(shape), precision_of(precision))


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
) -> Trajectory:
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
    frames, taken, status, reach = _stepped(precision, state, order, steps, every, threads)
    flat = (*(frames.get(name) for name in MOVING), taken, status)
    result = of_balls(
        Trajectory, shape, ball, np.arange(0, steps + 1, every), *flat, order=int(order),
        precision=precision_of(precision),
    )  # fmt: skip
    return finished(result, reach)


class StepperN(UnderWay):
    """One ball in n dimensions under way, as `Stepper` in three: steps of the map without the price of a call.

    ball, momentum, gamma, order, attitude, contact: as for `trajectory_n`, of one ball.  All is checked here.

    The states are those of `trajectory_n` from the same start, to the bit, however the steps are shared out to calls.

    Objects share nothing that changes: each may run in a thread of its own.  `copy.copy` makes another that goes on
    from the same state.  Raises BadInput as `trajectory_n` does, and for a batch.
    """

    def __init__(
        self, ball: BallN, momentum: ArrayLike, gamma: ArrayLike, *, order: int = 2, attitude: bool | ArrayLike = False,
        contact: bool = False,
    ) -> None:  # fmt: skip
        self.ball, self.order, self._stages = ball, order, substeps(order)
        self._traced = flag(contact, "contact")
        self._follows = self._traced or is_followed(attitude)
        self.restart(momentum, gamma, attitude)

    def restart(self, momentum: ArrayLike, gamma: ArrayLike, attitude: bool | ArrayLike = True) -> None:
        """Starts anew from 𝒦 (n, n), γ (n,) and, where they are followed, an attitude (n, n) and the contact point 0.

        attitude: True for the least rotation with R γ = eₙ.  Raises BadInput; then the state is as before.
        """
        shape, state = start(self.ball, momentum, gamma, attitude if self._follows else False, self._traced)
        if shape:
            raise BadInput(f"a StepperN takes one ball, not a batch with the leading axes {shape}")
        self._begin(state)

    def _go_on(self, momentum: ArrayLike) -> None:
        K = skew_matrices(momentum, self.ball.n)
        if K.ndim > 2:
            raise BadInput(f"momentum must be one skew matrix, not of the shape {K.shape}")
        now = {name: array[1:].copy() for name, array in self._ends.items()}
        self._begin(self._state | now | {"momentum": K[np.newaxis]})

    def __copy__(self) -> Self:
        return deepcopy(self)

    def _begin(self, state: dict[str, Floats]) -> None:
        bounds = limits(state["momentum"], state["mass_tensor"], state["D"], self._stages)
        self._below, self._taken = bool((bounds[0] > 0).all()), 0
        #: The state that moves: above the bound, and below it.
        self._state, self._one = state, begun(state, bounds, self._stages).ball(0)
        self._ends = {name: np.repeat(state[name], 2, axis=0) for name in MOVING if name in state}

    def _frames(self, count: int) -> dict[str, Floats]:
        return {name: np.empty((count, *array.shape[1:])) for name, array in self._ends.items()}

    def _take(self, steps: int, every: int, frames: dict[str, Floats]) -> tuple[int, int, float]:
        in_parts = self.order > 2 or not self._below
        before = self._state, self._one.copy() if in_parts else self._one
        taken, status, reach = self._march(steps, every, frames)
        if status != Status.TAKEN and in_parts:  # some stages of the last step were
            self._state, self._one = before
            self._march(taken, every, frames)
        if frames is not self._ends or taken < steps:
            self._show()
        self._taken += taken
        return taken, status, reach

    def _march(self, steps: int, every: int, frames: dict[str, Floats]) -> tuple[int, int, float]:
        if self._below:
            return advance(self._one, frames, steps, every, UNCOUNTED)
        taken, status, reach = np.zeros(1, dtype=np.int64), np.zeros(1, dtype=np.int64), np.ones(1)
        batch = {name: array[np.newaxis] for name, array in frames.items()}
        at = np.zeros(1, dtype=np.int64)
        self._state = continued(self._state, batch, self._stages, steps, every, taken, status, reach, at)
        return int(taken[0]), int(status[0]), float(reach[0])

    def _show(self) -> None:
        """Makes the state that moves in the loop the present one."""
        if self._below:
            self._one.keep(self._ends, 1)
        else:
            for name, array in self._ends.items():
                array[1] = self._state[name][0]
