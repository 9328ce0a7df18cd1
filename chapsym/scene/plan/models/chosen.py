"""The continuous motion to an accuracy: precision, order and step chosen for each ball, the result verified."""

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np

from chapsym.accuracy import Accurate, accurate, foreseen
from chapsym.accuracy.motion import FINEST
from chapsym.accuracy.request import exact_values
from chapsym.dynamics import Ball
from chapsym.dynamics.n.ball_n import BallN

from ...members.members import Members, one_ball
from ...read.task import Columns, Task
from .model import Model, Progress, State
from .rolling import Rolling


class Chosen(Model):
    """`chapsym.accuracy.accurate`, ball by ball.

    tell: called with each answer.  progress: with what it is about to do.
    """

    def __init__(
        self, tell: Callable[[Accurate], object] = lambda answer: None,
        progress: Callable[[str], None] = lambda text: None,
    ) -> None:  # fmt: skip
        self.tell, self.progress = tell, progress

    name = "chosen for the accuracy"
    title = "automatic, accuracy-driven"
    about = "the cheapest precision, order and step that meet the accuracy, verified on the run"
    columns = frozenset({"momentum", "gamma", "attitude", "contact"})
    kernels = Rolling.kernels
    whole = True

    def refuses(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Runs of given steps, and more than three dimensions."""
        if task.accuracy is None or not task.searched:
            return "no accuracy is asked for"
        if not task.chosen:
            return "it takes a time and frames, without time_step"
        if len(members) > 1 and task.accuracy >= FINEST:
            return "it follows each ball for itself"
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
        columns = {name: np.stack([run[name] for run, _ in runs]) for name in sorted(runs[0][0])}
        progress(task.steps * len(members))
        return columns, state | {"taken": state["taken"] + task.steps, "error": np.array([error for _, error in runs])}

    def seconds(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """What the choice for the first ball is expected to take, for all."""
        ball, start, options = self._request(members, 0, task, needed)
        return foreseen(ball, *start, **options).seconds * len(members)

    @staticmethod
    def _request(members: Members, i: int, task: Task, needed: frozenset[str]) -> tuple[Ball, Any, dict[str, Any]]:
        """The arguments of `accurate` for one ball."""
        ball = one_ball(members, i)
        given = None if members.attitude is None else members.attitude[i]
        with_body = "attitude" in needed or (given is not None and "contact" in needed)
        start = members.momentum[i], members.gamma[i], task.time, task.accuracy
        body = (True if given is None else given) if with_body else False
        return ball, start, {"of": task.of, "frames": task.frames - 1, "attitude": body, "limit": task.limit}

    def _one(self, members: Members, i: int, task: Task, needed: frozenset[str]) -> tuple[Columns, float]:
        """The columns of one ball, and the bound of its error by comparison."""
        ball, start, options = self._request(members, i, task, needed)
        answer = accurate(ball, *start, **options, progress=self.progress)
        self.tell(answer)
        run = answer.trajectory
        columns = {name: np.asarray(getattr(run, name), dtype=np.float64) for name in needed if name != "momentum"}
        if "momentum" in needed:
            columns["momentum"] = np.asarray(run.angular_momentum(), dtype=np.float64)
        if task.doubled and members.axes is None:
            for name in sorted(needed):
                columns |= _halves(name, exact_values(answer.request, run, name), members.place, i)
        elif "contact" in needed and members.place is not None:
            columns["contact"] = columns["contact"] + members.place[i]
        return columns, answer.estimate


def _halves(name: str, exact: np.ndarray, place: np.ndarray | None, i: int) -> Columns:
    """Numbers beyond float64 as their nearest floats and what these leave."""
    exact = np.vectorize(Fraction, otypes=[object])(exact)
    if name == "contact" and place is not None:
        exact = exact + np.vectorize(Fraction, otypes=[object])(place[i])
    high = exact.astype(np.float64)
    rest = exact - np.vectorize(Fraction, otypes=[object])(high)
    return {name: high, f"{name}_low": rest.astype(np.float64)}
