"""The map on SO(n) × Sⁿ⁻¹, for balls in more than three dimensions."""

import numpy as np

from chapsym.dynamics import BallN, TrajectoryN, trajectory_n

from ...members.members import Members
from ...read.task import Task
from .model import Progress, State
from .stepwise import Stepwise


class General(Stepwise):
    """`trajectory_n`: skew matrices, for every n."""

    name = "map in n dimensions"
    about = "skew matrices 𝒦, and γ, step by step"
    unit_steps = 2**14

    def refuses(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Balls in three dimensions, and what `trajectory_n` does not have."""
        if not isinstance(members.ball, BallN):
            return "the ball is one in three dimensions"
        if task.precision != "double" or task.accuracy is not None:
            return "more than three dimensions have the map and its compositions only, in float64"
        return None

    def attitude(self, members: Members) -> np.ndarray:
        """The least rotation with R γ = eₙ."""
        assert isinstance(members.ball, BallN)
        start = trajectory_n(members.ball, members.momentum, members.gamma, 0, attitude=True).attitude
        assert start is not None
        return start[:, 0]

    def run(self, members: Members, task: Task, state: State, steps: int, progress: Progress) -> TrajectoryN:
        """`chapsym.trajectory_n` of the batch."""
        assert isinstance(members.ball, BallN)
        found = trajectory_n(
            members.ball, state["momentum"], state["gamma"], steps, order=task.order, every=task.every,
            attitude=state.get("attitude", False), contact="contact" in state,
        )  # fmt: skip
        progress(len(members) * steps)
        return found
