"""What the models have in common that take every step: a segment goes on from the last frame of the one before."""

from abc import abstractmethod
from typing import Any

import numpy as np

from chapsym.dynamics import Status
from chapsym.numbers.pairs import add

from ...members.members import Members
from ...read.task import Columns, Task
from .model import Model, Progress, State

FOLLOWED = ("momentum", "gamma", "attitude", "contact")


class Stepwise(Model):
    """A model whose state is the last frame."""

    columns = frozenset(FOLLOWED)

    @abstractmethod
    def run(self, members: Members, task: Task, state: State, steps: int, progress: Progress) -> Any:
        """A trajectory of so many steps from a state, of all the balls; its contact point starts at the origin."""

    @abstractmethod
    def attitude(self, members: Members) -> np.ndarray:
        """The attitude at the start where none was given."""

    def begin(self, members: Members, task: Task, needed: frozenset[str]) -> State:
        """𝒦, γ, and the attitude and the contact point if they are needed."""
        state = super().begin(members, task, needed) | {"momentum": members.momentum, "gamma": members.gamma}
        if needed & {"attitude", "contact"}:
            state["attitude"] = self.attitude(members) if members.attitude is None else members.attitude
        if "contact" in needed:
            origin = np.zeros((len(members), members.dimension - 1))
            state["contact"] = origin if members.place is None else members.place
        return state

    def advance(
        self, members: Members, task: Task, needed: frozenset[str], state: State, segment: slice, progress: Progress
    ) -> tuple[Columns, State]:
        """The frames of a segment; the last one takes the steps beyond the last frame, too."""
        n, frames, after = len(members), segment.stop - segment.start, int(segment.start > 0)
        first = max(segment.start - 1, 0) * task.every
        last = task.steps if segment.stop == task.frames else (segment.stop - 1) * task.every
        followed = [name for name in FOLLOWED if name in state]
        columns = {name: np.full((n, frames, *state[name].shape[1:]), np.nan) for name in followed}
        ends = {name: array.copy() for name, array in state.items()}
        going = np.flatnonzero(state["status"] == Status.TAKEN)
        if len(going):
            here = {name: array[going] for name, array in state.items()}
            run = self.run(members.of(going) if len(going) < n else members, task, here, last - first, progress)
            for name in followed:
                values = np.asarray(getattr(run, name), dtype=np.float64)
                low = None if getattr(run, "low", None) is None else getattr(run.low, name)
                if name == "contact" and low is not None:
                    values, low = add(values, low, here[name][:, np.newaxis], 0.0)
                elif name == "contact":
                    values = values + here[name][:, np.newaxis]
                columns[name][going], ends[name][going] = values[:, after:], values[:, -1]
                if low is not None:
                    columns.setdefault(f"{name}_low", np.full_like(columns[name], np.nan))
                    columns[f"{name}_low"][going] = low[:, after:]
            ends["taken"][going], ends["status"][going] = first + run.taken, run.status
        return {name: array for name, array in columns.items() if name.removesuffix("_low") in needed}, ends
