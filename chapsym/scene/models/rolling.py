"""The reduced map on (𝒦, γ), step by step, with the attitude and the contact point where they are asked for."""

import numpy as np

from chapsym.dynamics import Ball, Trajectory, trajectory
from chapsym.dynamics.trajectories import attitude_with

from ..members import Members
from ..task import Task
from .model import Progress, State
from .stepwise import Stepwise


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
        """Only balls in more dimensions."""
        return None if isinstance(members.ball, Ball) else f"the ball is one in {members.dimension} dimensions"

    def attitude(self, members: Members) -> np.ndarray:
        """The least rotation with R γ = e₃."""
        return attitude_with(members.gamma)

    def run(self, members: Members, task: Task, state: State, steps: int, progress: Progress) -> Trajectory:
        """`chapsym.trajectory` of the batch."""
        assert isinstance(members.ball, Ball)
        return trajectory(
            members.ball, state["momentum"], state["gamma"], steps, every=task.every, order=task.order,
            attitude=state.get("attitude", False), contact="contact" in state,
            precision=task.precision, time_step=task.time_step, progress=progress,
        )  # fmt: skip
