"""The continuous motion to an accuracy: rung, order and step are chosen for each ball, and the result is verified."""

import numpy as np

from chapsym.accuracy import accurate
from chapsym.dynamics import Ball
from chapsym.dynamics.ball_n import BallN

from ..members import Members
from ..task import Columns, Task
from .model import Model, Progress, State


class Chosen(Model):
    """`chapsym.accuracy.accurate`, ball by ball."""

    name = "chosen for the accuracy"
    about = "the cheapest rung, order and step that meet the accuracy, verified on the run"
    columns = frozenset({"momentum", "gamma", "attitude", "contact"})
    whole = True

    def refuses(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Runs of given steps, and more than three dimensions."""
        if task.accuracy is None:
            return "the steps are given"
        if isinstance(members.ball, BallN):
            return "an accuracy can be asked for in three dimensions only"
        if "contact" in needed and task.of != "contact":
            return 'the contact point is followed to an accuracy of the contact point: of = "contact"'
        return None

    def advance(
        self, members: Members, task: Task, needed: frozenset[str], state: State, segment: slice, progress: Progress
    ) -> tuple[Columns, State]:
        """Each ball for itself; the momentum is K = 𝒦/ε."""
        assert isinstance(members.ball, Ball)
        assert task.accuracy is not None
        assert task.time is not None
        runs = [self._one(members, i, task, needed) for i in range(len(members))]
        columns = {name: np.stack([run[name] for run, _ in runs]) for name in sorted(needed)}
        progress(task.steps * len(members))
        return columns, state | {"taken": state["taken"] + task.steps, "error": np.array([error for _, error in runs])}

    @staticmethod
    def _one(members: Members, i: int, task: Task, needed: frozenset[str]) -> tuple[Columns, float]:
        """The columns of one ball, and the bound of its error by comparison."""
        whole = members.ball
        ball = Ball(whole.mass_tensor[i], whole.D[i], None if whole.radius is None else whole.radius[i])
        given = None if members.attitude is None else members.attitude[i]
        with_body = "attitude" in needed or (given is not None and "contact" in needed)
        answer = accurate(
            ball, members.momentum[i], members.gamma[i], task.time, task.accuracy,  # type: ignore[arg-type]
            of=task.of, frames=task.frames - 1, attitude=(True if given is None else given) if with_body else False,
            limit=task.limit,
        )  # fmt: skip
        run = answer.trajectory
        columns = {name: np.asarray(getattr(run, name), dtype=np.float64) for name in needed if name != "momentum"}
        if "momentum" in needed:
            columns["momentum"] = np.asarray(run.angular_momentum(), dtype=np.float64)
        if "contact" in needed and members.place is not None:
            columns["contact"] = columns["contact"] + members.place[i]
        return columns, answer.estimate
