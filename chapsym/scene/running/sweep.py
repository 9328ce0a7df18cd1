"""Runs a plan unit by unit: into memory, or into a resumable store; on all cores or on a cluster.

A unit is some balls × some frames, from the state after the previous one.  A worker of a cluster gets the text of the
scene and the indices of a unit, makes the plan again, and computes and writes the unit; the first process keeps the
marks.
"""

import threading
import time
from collections.abc import Callable
from contextlib import AbstractContextManager, ExitStack, nullcontext
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

import chapsym
from chapsym import jobs
from chapsym.accuracy import Accurate
from chapsym.dynamics import BadInput, Status
from chapsym.dynamics.labelled import Arrays
from chapsym.dynamics.levels.frames import cores

from ..plan.models import Chosen, State
from ..plan.plan import Plan, asked_for, plan_from
from ..read.errors import Data, SceneError
from ..read.task import Columns
from ..result.dataset import OF_BALLS, arrays, layout, provenance
from .store import Store, check_same, difference

if TYPE_CHECKING:
    from xarray import Dataset

#: Chunks of balls that run side by side at most, one a core: while one is written, another is computed.
ABREAST = 8
OFTEN = 0.1


class NoAnswer(Exception):
    """The balls of a unit cannot be run; others can."""


@dataclass(frozen=True)
class Outcome:
    """failed: balls that stopped early.  lost: why chunks of balls could not be run, by their balls.

    complete: whether all is there; nothing_to_do: whether it was before.  damaged: chunks that were missing or damaged.
    """

    failed: int
    lost: dict[tuple[int, int], str] = field(default_factory=dict)
    nothing_to_do: bool = False
    damaged: tuple[str, ...] = ()

    @property
    def complete(self) -> bool:
        """Whether every unit was run."""
        return not self.lost


@dataclass(frozen=True)
class Progress:
    """steps: of all balls together, taken so far of `of`.  balls: that are done.  failed: balls that stopped early."""

    steps: int
    of: int
    balls: int
    failed: int


Report = Callable[[Progress], None]


class Stopped(Exception):
    """Raised inside a unit of work to stop the run."""


class Tally:
    """Adds up the work of units that run side by side."""

    def __init__(self, plan: Plan, report: Report = lambda progress: None) -> None:
        self.plan, self.report, self.stopped = plan, report, False
        self._lock, self._told = threading.Lock(), 0.0
        self._done: dict[int, int] = {}
        self._failed: dict[int, int] = {}
        self._finished = 0

    def work(self, chunk: int, segments: int) -> int:
        """Steps of the balls of a chunk in its first segments."""
        balls, frames = self.plan.chunks[chunk], self.plan.segments[segments - 1].stop if segments else 0
        return (balls.stop - balls.start) * frames * self.plan.task.every

    def kept(self, chunk: int, segments: int, state: State) -> None:
        """The number of segments of a chunk that are done."""
        with self._lock:
            self._done[chunk] = self.work(chunk, segments)
            self._failed[chunk] = int(np.count_nonzero(state["status"] != Status.TAKEN))
            balls = self.plan.chunks[chunk]
            self._finished += (balls.stop - balls.start) * (segments == len(self.plan.segments))
        self._tell(now=True)

    def within(self, chunk: int, segment: int) -> Callable[[int], None]:
        """The progress of a unit: a function of the steps that its balls have taken; it raises Stopped."""
        before, after = self.work(chunk, segment), self.work(chunk, segment + 1)

        def clause(steps: int) -> None:
            if self.stopped:
                raise Stopped
            self._done[chunk] = min(before + steps, after)
            self._tell()

        return clause

    @property
    def progress(self) -> Progress:
        """The progress of the run."""
        whole = len(self.plan.members) * self.plan.frames * self.plan.task.every
        return Progress(sum(self._done.values()), whole, self._finished, sum(self._failed.values()))

    def _tell(self, now: bool = False) -> None:
        with self._lock:
            if now or time.monotonic() - self._told >= OFTEN:
                self._told = time.monotonic()
                self.report(self.progress)


class Memory:
    """Keeps the columns of all balls and frames; units go here or into a `Store`."""

    def __init__(self, plan: Plan) -> None:
        self.plan, self.variables = plan, layout(plan)
        try:
            self.columns = {name: one.values.copy() for name, one in self.variables.items()}
        except (MemoryError, ValueError):
            raise SceneError(f"{plan.bytes / 1e9:.3g} GB do not fit into memory; write to a .zarr") from None

    def start(self, chunk: int) -> tuple[int, State | None]:
        """Nothing is there yet."""
        return 0, None

    def write(self, chunk: int, segment: int, columns: Columns) -> None:
        """Copies the columns of a unit to their place."""
        where = {"ball": self.plan.chunks[chunk], "frame": self.plan.segments[segment]}
        for name, one in self.variables.items():
            if name in columns:
                self.columns[name][tuple(where.get(dim, slice(None)) for dim in one.dims)] = columns[name]

    def mark(self, chunk: int, segment: int, state: State) -> None:
        """Copies the variables of the state for each ball."""
        self.write(chunk, segment, {name: state[name] for name in OF_BALLS if name in state})


def run_in_memory(plan: Plan, report: Report = lambda progress: None) -> "Dataset":
    """The same as `run`, as a Dataset indexed by time."""
    return run(plan, report).dataset()


def run(plan: Plan, report: Report = lambda progress: None) -> Arrays:
    """Runs a plan on all cores; the result as plain arrays (`dataset.arrays`).

    Balls that stopped early are NaN from there on, with their `status`.
    Raises BadInput if a unit has no answer.
    """
    memory = Memory(plan)
    for why in _missing(plan, memory, Tally(plan, report)).values():
        raise BadInput(why)
    return arrays(plan, memory.columns, memory.columns)


def run_to_store(
    plan: Plan, path: Path, scheduler: str | None = None, fresh: bool = False, report: Report = lambda progress: None
) -> Outcome:
    """Runs a plan into a Zarr store, or goes on with one that was left; the bits do not depend on the interruptions.

    scheduler: the address of a Dask scheduler whose workers see the same disk; without, all cores of this machine.
    fresh: discard what is there.  report: called with the `Progress`, some times a second.
    Raises BadInput if the disk refuses, if the store is of another run or held by another process, and if the cluster
    or its last worker is lost; what was done by then is kept.
    """
    with ExitStack() as held:
        workers = nullcontext() if scheduler is None else jobs.workers(scheduler)
        is_new = fresh or not path.exists()  # then an address where nobody answers leaves all as it was
        crew = held.enter_context(workers) if is_new else None
        store, tally = held.enter_context(Store.of(path, plan, fresh)), Tally(plan, report)
        if store.complete:
            return Outcome(_failed(store.path), nothing_to_do=True)
        lost = _missing(plan, store, tally, crew if is_new else held.enter_context(workers))
        if not lost:
            store.finish()
        of_balls = {(plan.chunks[i].start, plan.chunks[i].stop): lost[i] for i in lost}
        return Outcome(tally.progress.failed, of_balls, damaged=tuple(store.damaged))


def answering(plan: Plan, progress: Callable[[str], None]) -> tuple[Plan, list[Accurate]]:
    """The same plan, and where its run here puts what was chosen for each ball, if it asks for an accuracy."""
    answers: list[Accurate] = []
    return (replace(plan, model=Chosen(answers.append, progress)) if isinstance(plan.model, Chosen) else plan), answers


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


def unit(text: str, about: Data, path: str, chunk: int, segment: int, state: State | None) -> State:
    """Computes and writes one unit on a worker; the state after it.

    text, about: the scene and the provenance of its plan, which the worker's must equal.
    Raises NoAnswer, which is of these balls only; or SceneError, of the disk, the store or the worker.
    """
    try:
        plan = _plan(text)
        if (how := difference(provenance(plan), about)) is not None:
            version = f"chapsym {chapsym.__version__}, and {about['chapsym_version']} here"
            raise SceneError(f"what a worker of the cluster would compute {how} ({version}): give all the same chapsym")
        columns, after = computed(plan, chunk, segment, state)
        check_same(Path(path), plan)  # this worker may be late, and the store may belong to another run
        Store(Path(path), plan).write(chunk, segment, columns)
        return after
    except (NoAnswer, SceneError) as error:
        raise type(error)(str(error)) from None
    except Exception as error:  # of any kind: not all can be sent
        raise NoAnswer(f"{type(error).__name__} on a worker: {error}") from None


#: The plans of a worker.
_plan = lru_cache(maxsize=4)(plan_from)


def _missing(plan: Plan, sink: "Memory | Store", tally: Tally, crew: jobs.Crew | None = None) -> dict[int, str]:
    """Runs what is missing, some chunks abreast on the workers of a scheduler or on all cores; why chunks were lost.

    Raises SceneError for workers where the plan has no scene, one has another chapsym, or the disk refuses.
    """

    def here(chunk: int, segment: int, state: State | None) -> State:
        columns, after = computed(plan, chunk, segment, state, tally.within(chunk, segment))
        sink.write(chunk, segment, columns)
        return after

    def chain(chunk: int) -> jobs.Chain:
        """The segments of a chunk that are missing, one after the other; `lost` gets why one could not be run."""
        done, state = sink.start(chunk)
        if state is not None:
            tally.kept(chunk, done, state)
        for segment in range(done, len(plan.segments)):
            which = chunk, segment, state
            try:
                state = yield jobs.Call(here, which) if sent is None else jobs.Call(unit, (*sent, *which))
            except (NoAnswer, jobs.Lost) as error:
                lost[chunk] = str(error)
                return
            assert state is not None
            sink.mark(chunk, segment, state)
            tally.kept(chunk, segment + 1, state)

    lost: dict[int, str] = {}
    sent: tuple[str, Data, str] | None = None
    team: AbstractContextManager[jobs.Crew]
    if crew is None:  # the higher precisions set the precision of a whole process
        team = jobs.threads(1 if isinstance(plan.model, Chosen) else min(ABREAST, cores()))
    else:
        assert isinstance(sink, Store)
        _plan(plan.scene)
        sent, team = (plan.scene, provenance(plan), str(sink.path)), nullcontext(crew)
    with team as crew:
        try:
            jobs.run((chain(chunk) for chunk in range(len(plan.chunks))), crew)
        except BaseException as error:
            tally.stopped = True
            if sent is None or isinstance(error, BadInput) or not isinstance(error, Exception):
                raise
            raise SceneError(f"a worker of the cluster has not this chapsym: {type(error).__name__}: {error}") from None
    return dict(sorted(lost.items()))


def _failed(path: Path) -> int:
    """Balls that stopped early, in a store that is complete."""
    import zarr

    status: Any = zarr.open_group(path, mode="r")["status"]
    return int(np.count_nonzero(status[:]))
