"""The units of work of a plan: balls × frames, each from the state that the one before it left."""

from collections.abc import Callable

from chapsym.dynamics import BadInput

from ..plan.columns import asked_for
from ..plan.models import State
from ..plan.plan import Plan
from ..read.task import Columns
from ..result.dataset import layout
from .tally import Stopped


class NoAnswer(Exception):
    """A unit whose balls cannot be run; the others can."""


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


def computed(
    plan: Plan, chunk: int, segment: int, state: State | None, progress: Callable[[int], None] = lambda steps: None
) -> tuple[Columns, State]:
    """The values of a unit and the state after it, from the one before (None: the start).

    Raises NoAnswer where its balls have none.
    """
    try:
        state = begin(plan, plan.chunks[chunk]) if state is None else state
        columns, after = advance(plan, plan.chunks[chunk], state, plan.segments[segment], progress)
    except Stopped:
        raise
    except (BadInput, ArithmeticError, MemoryError) as error:
        raise NoAnswer(str(error) or type(error).__name__) from error
    missing = set(layout(plan)) - set(columns) - set(after)
    assert not missing, f"{plan.model.name} left out {missing}"
    return columns, after
