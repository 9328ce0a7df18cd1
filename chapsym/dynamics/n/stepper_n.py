"""One ball in n dimensions under way: prepared once, so that a call costs microseconds beside its steps."""

from __future__ import annotations

from copy import deepcopy
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from ..ball import Floats, is_followed
from ..coefficients import substeps
from ..errors import BadInput, Status
from ..levels.frames import Count
from ..stepper import UnderWay
from . import warm_n
from .ball_n import BallN, skew_matrices
from .near_n import limits
from .run_n import MOVING, start
from .steps_n import continued
from .trajectory_n import TrajectoryN

#: Nobody counts the steps of a call.
UNCOUNTED = Count(lambda done: None)


class StepperN(UnderWay[TrajectoryN]):
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
        self._follows, self._traced = bool(contact) or is_followed(attitude), bool(contact)
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
        self._state, self._one = state, warm_n.begun(state, bounds, self._stages).ball(0)
        self._ends = {name: np.repeat(state[name], 2, axis=0) for name in MOVING if name in state}

    def _frames(self, count: int) -> dict[str, Floats]:
        return {name: np.empty((count, *array.shape[1:])) for name, array in self._ends.items()}

    def _run(self, index: np.ndarray, frames: dict[str, Floats], taken: np.ndarray, status: np.ndarray) -> TrajectoryN:
        return TrajectoryN(
            self.ball, index, frames["momentum"], frames["gamma"], frames.get("attitude"), frames.get("contact"), taken,
            status, self.order,
        )  # fmt: skip

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
            return warm_n.advance(self._one, frames, steps, every, UNCOUNTED)
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
