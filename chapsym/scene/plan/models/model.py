"""What a model is: a way to follow the balls of a scene, and when it serves."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from typing import ClassVar

import numpy as np

from chapsym.dynamics import Ball

from ...members.members import Members
from ...read.task import Columns, Task

#: What the next segment needs: arrays by name, each (balls, ...); `taken` and `status` are always there.
State = dict[str, np.ndarray]
Progress = Callable[[int], None]


class Model(ABC):
    """A way to follow balls; its name says all that the values depend on.

    name: as the plan tells it.  about: what it leaves out or knows, one clause.
    columns: what it can follow.  kernels: the generated ones in its loops, for each column that it follows.
    stepwise: whether its cost grows with the steps (else with the frames).
    whole: whether it must run in one segment, as its state has more than float64 arrays.
    reduction: whether it is less than the model that serves every such ball; a plan tells why it does not serve.
    unit_steps: steps of all balls in one unit of work: a second or two, which is what a killed run loses at most.
    """

    name: ClassVar[str]
    title: ClassVar[str] = ""
    about: ClassVar[str]
    columns: ClassVar[frozenset[str]]
    kernels: ClassVar[Mapping[str, tuple[str, ...]]] = {}
    stepwise: ClassVar[bool] = True
    whole: ClassVar[bool] = False
    unit_steps: ClassVar[int] = 2**27
    reduction: ClassVar[bool] = False

    @classmethod
    def in_words(cls) -> str:
        """What a reader sees; `name` is what results and JSON have."""
        return cls.title or cls.name

    @abstractmethod
    def refuses(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Why this model does not serve these balls and columns, in a clause; None if it does."""

    def unfit(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """The same, by a look at each ball that may take as long as its run: asked of the cheapest models only."""
        return None

    def begin(self, members: Members, task: Task, needed: frozenset[str]) -> State:
        """The state at the start."""
        n = len(members)
        return {"taken": np.zeros(n, dtype=np.int64), "status": np.zeros(n, dtype=np.int64)}

    def price(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """What it costs in nanoseconds of one core: nominal, so that a plan does not depend on the machine.

        The prices are those of `chapsym bench plans`; the default is of models that serve where no other does.
        """
        return 1.0

    def seconds(self, members: Members, task: Task, needed: frozenset[str]) -> float | None:
        """What a run is expected to take, where the model knows it without a pilot run."""
        return None

    @abstractmethod
    def advance(
        self, members: Members, task: Task, needed: frozenset[str], state: State, segment: slice, progress: Progress
    ) -> tuple[Columns, State]:
        """The frames of a segment, (balls, frames, ...) of each column, in principal axes, and the state after it.

        Frames of a ball after its `taken` are NaN.  The state that is given is left as it is.
        """


def beyond_a_reduction(members: Members, task: Task) -> str | None:
    """Why no reduction serves: they are of the map itself, in three dimensions and float64."""
    if not isinstance(members.ball, Ball):
        return "it is for balls in three dimensions"
    if task.accuracy is not None:
        return "it is of the map, and the motion of the ball is asked for"
    if task.order != 2 or task.precision != "double":
        return "it has order 2 and float64 only"
    return None
