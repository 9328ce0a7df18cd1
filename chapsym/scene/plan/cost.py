"""What a plan will cost, beside the model that follows everything: by short runs of both, of the very balls."""

import time as clock
from dataclasses import dataclass, replace

from chapsym.dynamics import Ball

from ..read.outputs import OUTPUTS, columns_for, timed
from .columns import asked_for
from .models import General, Rolling
from .plan import Plan

#: Balls of a pilot run at most; steps, or frames, of the first one; and how many seconds longer the last one takes, so
#: that what its steps cost is more than what a busy machine adds to the overhead.
BALLS, LEAST, ENOUGH = 512, 32, 0.03
#: How many times what the first took tells what the steps take, beside what a run takes at once.
SLOPED = 1.5
#: Nanoseconds that the balls of a pilot run may take at once, and seconds after which it is not repeated.
AT_ONCE, LONG = 2e8, 0.2


@dataclass(frozen=True)
class Cost:
    """seconds: of the processor, all cores together, without the disk.  bytes: of the outputs, uncompressed."""

    seconds: float
    bytes: int


def full(plan: Plan) -> Plan:
    """The plan of the same frames with the model that follows everything: every output that it can give."""
    model = Rolling() if isinstance(plan.members.ball, Ball) else General()
    n, radius = plan.members.dimension, plan.members.ball.radius
    outputs = tuple(
        name
        for name, one in OUTPUTS.items()
        if columns_for((name,), False) <= model.columns
        and (n == 3 or one.dims_n is not None)
        and (radius is not None or not one.radius)
        and (plan.task.timed or not timed(name))
    )
    return replace(plan, model=model, task=replace(plan.task, outputs=outputs), needed=columns_for(outputs, False))


def predicted(plan: Plan) -> Cost:
    """The cost of a plan; of one that asks for an accuracy as the choice expects it."""
    known = plan.model.seconds(plan.members, plan.task, plan.needed)
    return Cost(_extrapolated(plan) if known is None else known, plan.bytes)


def _extrapolated(plan: Plan) -> float:
    """Seconds of the processor for a whole run, from pilot runs, each twice as long as the one before."""
    chunk = slice(0, _balls(plan))
    share = len(plan.members) / (chunk.stop - chunk.start)
    work = plan.task.steps if plan.model.stepwise else plan.frames
    first = part = min(LEAST, work)
    _pilot(plan, chunk, first)  # the first call loads what the others do not
    start = took = _pilot(plan, chunk, first)
    while part < work and took - start < ENOUGH:
        part = min((2 if took > SLOPED * start else 8) * part, work)
        took = _pilot(plan, chunk, part)
    slope = max(took - start, 0.0) / (part - first) if part > first else 0.0
    return (took + slope * (work - part)) * share


def _balls(plan: Plan) -> int:
    """How many balls a pilot run has: fewer where each costs much, whatever its steps."""
    once = plan.model.price(plan.members, replace(plan.task, steps=1, every=1), plan.needed) / len(plan.members)
    return max(1, min(BALLS, len(plan.members), int(AT_ONCE / once)))


def _pilot(plan: Plan, chunk: slice, part: int) -> float:
    """Seconds of some balls for a part of the work: steps, or frames of a model that needs no steps between them.

    The best of three runs, if they are short: the first of a length may load compiled code.
    """
    every = plan.task.every
    steps = part if plan.model.stepwise else part * every
    task = replace(plan.task, steps=steps, every=min(every, max(steps, 1)))
    members = plan.members.of(chunk)
    took = []
    for _ in range(3):
        started = clock.process_time()
        state = plan.model.begin(members, task, plan.needed)
        columns, _ = plan.model.advance(members, task, plan.needed, state, slice(0, task.frames), lambda steps: None)
        asked_for(members, task, columns)
        took.append(clock.process_time() - started)
        if took[-1] > LONG:
            break
    return min(took)
