"""The continuous motion to an accuracy, in double precision: order and steps chosen for alike balls, and verified."""

import numpy as np

from chapsym.accuracy.motion import FINEST, moved, nominal
from chapsym.accuracy.problem import PARTS, Problem
from chapsym.dynamics import Ball
from chapsym.dynamics.attitudes import attitude_with

from ...members.members import Members
from ...read.task import Columns, Task
from .model import Model, Progress, State
from .rolling import Rolling


class Moving(Model):
    """`chapsym.accuracy.motion.moved` of all balls of a unit together."""

    name = "motion of the ball"
    about = "the order and the steps that meet the accuracy, chosen for alike balls and verified on the run"
    columns = frozenset({"momentum", "gamma", "attitude", "contact"})
    kernels = Rolling.kernels
    whole = True

    def refuses(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """The map, more than three dimensions, and more digits than float64 has."""
        if task.accuracy is None:
            return "the map was asked for, or a start in its momentum"
        if not isinstance(members.ball, Ball):
            return "the motion is known in three dimensions only"
        if task.accuracy < FINEST:
            return f"double precision has no accuracy below {FINEST:g}: ask for one ball by time, without time_step"
        return None

    def price(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """More than a search for one ball, which has higher precisions, too."""
        return 2.0

    def seconds(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """Nominal, by the steps that the law says."""
        return nominal(self._problem(members, task, needed))

    def advance(
        self, members: Members, task: Task, needed: frozenset[str], state: State, segment: slice, progress: Progress
    ) -> tuple[Columns, State]:
        """All frames; the momentum is 𝒦 = εK, or K where there is no ε."""
        problem = self._problem(members, task, needed)
        found = moved(problem, lambda balls: progress(int(balls * task.steps)))
        columns = {
            "momentum": found.angular_momentum * task.scale, "gamma": found.gamma, "attitude": found.attitude,
            "contact": found.contact,
        }  # fmt: skip
        if found.contact is not None and members.place is not None:
            columns["contact"] = found.contact + members.place[:, np.newaxis]
        at_end = found.reached == problem.frames
        return {name: columns[name] for name in needed}, state | {
            "taken": np.where(at_end, task.steps, found.reached * task.every), "status": found.status,
            "error": found.error, "order": found.order, "substeps": found.steps,
        }  # fmt: skip

    @staticmethod
    def _problem(members: Members, task: Task, needed: frozenset[str]) -> Problem:
        assert isinstance(members.ball, Ball)
        assert task.accuracy is not None
        attitude, metres = None, task.of == "contact"
        if metres or needed & {"attitude", "contact"}:
            attitude = attitude_with(members.gamma) if members.attitude is None else members.attitude
        parts = _parts(task.outputs) | ({"contact"} if metres else frozenset())
        return Problem(
            members.ball, members.momentum / task.scale, members.gamma, task.interval, task.frames - 1, task.accuracy,
            attitude, metres or "contact" in needed, metres, parts,
        )  # fmt: skip


def _parts(outputs: tuple[str, ...]) -> frozenset[str]:
    """What of the motion is kept, and so has the accuracy."""
    made = {"momentum", "gamma"} if any(name not in PARTS for name in outputs) else set()
    return PARTS & (made | set(outputs))
