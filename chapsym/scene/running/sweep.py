"""Runs a plan unit by unit: into memory, or into a store that can be gone on with; on all cores or on a cluster."""

from collections.abc import Callable
from concurrent.futures import FIRST_EXCEPTION, ThreadPoolExecutor, wait
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from chapsym.dynamics import BadInput
from chapsym.dynamics.levels.double import cores

from ..plan.models import State
from ..plan.plan import Plan
from ..read.scene import SceneError
from ..result.dataset import layout, sizes
from . import segments
from .tally import Report, Stopped, Tally, silent
from .task import Columns

if TYPE_CHECKING:
    from xarray import Dataset

#: Chunks of balls that run side by side at most, one a core: while one is written, another is computed.
ABREAST = 8


@dataclass(frozen=True)
class Outcome:
    """failed: balls that stopped early.  lost: why chunks of balls could not be run, by their balls.

    complete: whether all is there; nothing_to_do: whether it was before.
    """

    failed: int
    lost: dict[tuple[int, int], str] = field(default_factory=dict)
    nothing_to_do: bool = False

    @property
    def complete(self) -> bool:
        """Whether every unit was run."""
        return not self.lost


class Sink(Protocol):
    """Where units go."""

    def start(self, chunk: int) -> tuple[int, State | None]:
        """How many segments of a chunk are done, and the state after them."""

    def keep(self, chunk: int, segment: int, columns: Columns, state: State) -> None:
        """Takes the values of a unit and the state after it."""


class Memory:
    """Keeps the columns of all balls and frames."""

    def __init__(self, plan: Plan) -> None:
        self.plan, length = plan, sizes(plan)
        self.variables = layout(plan)
        try:
            self.columns = {
                name: np.full([length[dim] for dim in one.dims], one.missing) for name, one in self.variables.items()
            }
        except (MemoryError, ValueError):
            raise SceneError(f"{plan.bytes / 1e9:.3g} GB do not fit into memory; write to a .zarr") from None

    def start(self, chunk: int) -> tuple[int, State | None]:
        """Nothing is there yet."""
        return 0, None

    def keep(self, chunk: int, segment: int, columns: Columns, state: State) -> None:
        """Copies a unit to its place."""
        where = {"ball": self.plan.chunks[chunk], "frame": self.plan.segments[segment]}
        for name, one in self.variables.items():
            place = tuple(where.get(dim, slice(None)) for dim in one.dims)
            self.columns[name][place] = columns[name] if name in columns else state[name]


def run_in_memory(plan: Plan, report: Report = silent) -> "Dataset":
    """Runs a plan on all cores; the result as a Dataset (`dataset.build`).

    Balls that stopped early are NaN from there on, with their `status`.  Raises BadInput where a unit has no answer.
    """
    from ..result.dataset import build

    memory = Memory(plan)
    for why in locally(plan, memory, Tally(plan, report)).values():
        raise BadInput(why)
    return build(plan, memory.columns, memory.columns)


def run_to_store(
    plan: Plan, path: Path, scheduler: str | None = None, fresh: bool = False, report: Report = silent
) -> Outcome:
    """Runs a plan into a Zarr store, or goes on with one that was left; the bits do not depend on the interruptions.

    scheduler: the address of a Dask scheduler whose workers see the same disk; without, all cores of this machine.
    fresh: discard what is there.  report: called with the `Progress`, some times a second.
    Raises SceneError if the disk refuses, if the store is of another run or held by another process.
    """
    from .store import Store

    with Store.of(path, plan, fresh) as store:
        tally = Tally(plan, report)
        if store.complete:
            return Outcome(_failed(store.path), nothing_to_do=True)
        if scheduler is None:
            lost = locally(plan, store, tally)
        else:
            from .cluster import on_cluster

            lost = on_cluster(plan, store, tally, scheduler)
        if not lost:
            store.finish()
        return Outcome(tally.progress.failed, {(plan.chunks[i].start, plan.chunks[i].stop): lost[i] for i in lost})


def locally(plan: Plan, sink: Sink, tally: Tally) -> dict[int, str]:
    """Runs what is missing on all cores, some chunks abreast; returns why chunks have no answer."""
    lost: dict[int, str] = {}

    def chain(chunk: int) -> None:
        if not tally.stopped:
            try:
                _run_chunk(plan, chunk, sink, tally)
            except NoAnswer as error:
                lost[chunk] = str(error)

    # The higher rungs set the precision of a whole process.
    abreast = min(ABREAST, cores()) if plan.task.accuracy is None else 1
    with ThreadPoolExecutor(abreast) as pool:
        try:
            running = [pool.submit(chain, chunk) for chunk in range(len(plan.chunks))]
            done, _ = wait(running, return_when=FIRST_EXCEPTION)
            for future in done:
                future.result()
        except BaseException:
            tally.stopped = True
            pool.shutdown(wait=True, cancel_futures=True)
            raise
    return dict(sorted(lost.items()))


class NoAnswer(Exception):
    """A unit whose balls cannot be run; the others can."""


def _run_chunk(plan: Plan, chunk: int, sink: Sink, tally: Tally) -> None:
    """The segments of a chunk that are missing, one after the other."""
    done, state = sink.start(chunk)
    if state is None:
        state = segments.begin(plan, plan.chunks[chunk])
    else:
        tally.kept(chunk, done, state)
    for segment in range(done, len(plan.segments)):
        columns, state = computed(plan, chunk, segment, state, tally.within(chunk, segment))
        sink.keep(chunk, segment, columns, state)
        tally.kept(chunk, segment + 1, state)


def computed(
    plan: Plan, chunk: int, segment: int, state: State, progress: Callable[[int], None] = lambda steps: None
) -> tuple[Columns, State]:
    """The values of a unit and the state after it; raises NoAnswer where its balls have none."""
    try:
        columns, after = segments.advance(plan, plan.chunks[chunk], state, plan.segments[segment], progress)
    except Stopped:
        raise
    except (BadInput, ArithmeticError, MemoryError) as error:
        raise NoAnswer(str(error) or type(error).__name__) from error
    missing = set(layout(plan)) - set(columns) - set(after)
    assert not missing, f"{plan.model.name} left out {missing}"
    return columns, after


def _failed(path: Path) -> int:
    """Balls that stopped early, in a store that is complete."""
    import zarr

    status: Any = zarr.open_group(path, mode="r")["status"]
    return int(np.count_nonzero(status[:]))
