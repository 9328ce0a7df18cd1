"""The units of work of a plan: balls × frames, each from the state that the one before it left."""

from collections.abc import Callable

from ..plan.columns import asked_for
from ..plan.models import State
from ..plan.plan import Plan
from .task import Columns


def begin(plan: Plan, chunk: slice) -> State:
    """The state of some balls at the start: arrays by name, of which `taken` and `status` are always there."""
    return plan.model.begin(plan.members.of(chunk), plan.task, plan.needed)


def advance(
    plan: Plan, chunk: slice, state: State, segment: slice, progress: Callable[[int], None] = lambda steps: None
) -> tuple[Columns, State]:
    """The outputs of some balls in some frames, (balls, frames, ...), in the axes given, and the state after them.

    progress: called with the steps done so far in this unit, of all its balls together.
    Frames that a ball did not reach are NaN; the state's `taken` and `status` say so.
    """
    members = plan.members.of(chunk)
    columns, after = plan.model.advance(members, plan.task, plan.needed, state, segment, progress)
    return asked_for(members, plan.task, columns), after
