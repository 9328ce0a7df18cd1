"""The reduced map on (𝒦, γ), step by step, with the attitude and the contact point where they are asked for."""

import numpy as np

from chapsym.dynamics import Ball, Trajectory, substeps, trajectory
from chapsym.dynamics.attitudes import attitude_with

from ...members.members import Members
from ...read.task import Task
from .model import Progress, State
from .stepwise import Stepwise

#: From so many balls on a batch runs in vector lanes.
BATCH = 16


class Rolling(Stepwise):
    """The map (4.12), (4.13) itself: it serves every ball in three dimensions."""

    name = "reduced map"
    about = "𝒦 and γ step by step; attitude and contact point only if asked for"
    kernels = {  # noqa: RUF012
        "momentum": ("gibbs_newton", "gibbs_second", "turn"),
        "attitude": ("compose",),
        "contact": ("compose", "centre_step", "rotate"),
    }

    def refuses(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Balls in more dimensions, and steps that are to be chosen."""
        if task.accuracy is not None:
            return "the motion of the ball is asked for; map = true takes the map as it is"
        return None if isinstance(members.ball, Ball) else f"the ball is one in {members.dimension} dimensions"

    def price(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """Vector lanes for batches."""
        alone, in_lanes = (40.0, 14.0) if needed & {"attitude", "contact"} else (27.0, 8.0)
        step = in_lanes if len(members) >= BATCH and task.order == 2 else alone
        return 3e4 + len(members) * (task.steps * len(substeps(task.order)) * step + task.frames * 10.0)

    def attitude(self, members: Members) -> np.ndarray:
        """The least rotation with R γ = e₃."""
        return attitude_with(members.gamma)

    def run(self, members: Members, task: Task, state: State, steps: int, progress: Progress) -> Trajectory:
        """`chapsym.trajectory` of the batch."""
        assert isinstance(members.ball, Ball)
        attitude = state.get("attitude", False)
        if "attitude" in state and members.attitude is None and task.precision == "double-double":
            attitude = True  # in 31 digits, as γ; such a run has one segment
        return trajectory(
            members.ball, state["momentum"], state["gamma"], steps, every=task.every, order=task.order,
            attitude=attitude, contact="contact" in state,
            precision=task.precision, time_step=task.time_step, progress=progress,
        )  # fmt: skip
