"""Steady rotation: homogeneous balls, rotations about principal axes, rest; every frame at once, in closed form."""

import numpy as np

from chapsym.dynamics import Ball, Status, is_steady, steady_frames

from ...members.members import Members
from ...read.task import Columns, Task
from .model import Model, Progress, State, beyond_a_reduction
from .stepwise import FOLLOWED


class Steady(Model):
    """`steady_frames`: no step is taken."""

    name = "steady rotation"
    about = "each step is the same rotation about a fixed axis: every frame in closed form, no step between"
    columns = frozenset(FOLLOWED)
    kernels = {  # noqa: RUF012
        "momentum": ("turn",),
        "gamma": ("turn",),
        "attitude": ("compose",),
        "contact": ("centre_step", "rotate"),
    }
    stepwise = False
    reduction = True

    def refuses(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Balls that do not rotate steadily, and what `steady_frames` does not have."""
        if (reason := beyond_a_reduction(members, task)) is not None:
            return reason
        assert isinstance(members.ball, Ball)
        steady = is_steady(members.ball, members.momentum, members.gamma)
        if not steady.all():
            return f"{members.names[int(np.argmin(steady))]} has unequal moments and is in no steady rotation"
        return None

    def price(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """The frames alone."""
        frame = 75.0 if needed & {"attitude", "contact"} else 40.0
        return 4.5e5 + len(members) * task.frames * frame

    def advance(
        self, members: Members, task: Task, needed: frozenset[str], state: State, segment: slice, progress: Progress
    ) -> tuple[Columns, State]:
        """The frames by their step numbers."""
        assert isinstance(members.ball, Ball)
        index = np.arange(segment.start, segment.stop) * task.every
        given = True if members.attitude is None else members.attitude
        run = steady_frames(
            members.ball, members.momentum, members.gamma, index, contact="contact" in needed,
            attitude=given if needed & {"attitude", "contact"} else False, time_step=task.time_step,
        )  # fmt: skip
        columns = {name: getattr(run, name) for name in FOLLOWED if name in needed}
        if "contact" in needed and members.place is not None:
            columns["contact"] = columns["contact"] + members.place[:, np.newaxis]
        last = task.steps if segment.stop == task.frames else int(index[-1])
        progress(len(members) * last)
        return columns, {"taken": np.where(run.status == Status.TAKEN, last, 0), "status": run.status}
