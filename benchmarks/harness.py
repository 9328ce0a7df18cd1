"""Measuring: all sides in one process, in rounds that interleave them, so that a drifting clock hits each alike."""

import gc
import os
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

import numpy as np

#: A call that is timed, and what is called with sentences on the progress.
Run = Callable[[], object]
Say = Callable[[str], None]


class NotComparable(ArithmeticError):
    """The sides do not compute the same thing, so their times say nothing; the message says which and how far apart."""


@dataclass(frozen=True)
class Contender:
    """One side of a comparison: `run` does `work` units (steps, or balls times steps) of it.

    clock: the time of the processor, which other programs on the machine do not lengthen, is right for one core only;
    for more it must be that of the wall, `time.perf_counter`.
    """

    name: str
    run: Run
    work: int
    clock: Callable[[], float] = time.process_time


@dataclass(frozen=True)
class Timing:
    """Seconds a unit of work in each round, (rounds,)."""

    name: str
    seconds: np.ndarray

    @property
    def median(self) -> float:
        """The median time of a unit in seconds."""
        return float(np.median(self.seconds))

    def ratio_to(self, other: "Timing") -> tuple[float, float, float]:
        """The median and the quartiles of the ratio, taken round by round: (median, lower, upper)."""
        lower, middle, upper = np.quantile(self.seconds / other.seconds, [0.25, 0.5, 0.75])
        return float(middle), float(lower), float(upper)


def interleaved(
    contenders: Sequence[Contender], rounds: int, on_round: Callable[[int], None] = lambda done: None
) -> dict[str, Timing]:
    """Times every contender once a round, beginning with another one each round; by name.

    Each runs once before, unmeasured, so that compiling and first touches of memory are not in it.
    """
    for contender in contenders:
        contender.run()
    seconds = {contender.name: np.empty(rounds) for contender in contenders}
    for i in range(rounds):
        first = i % len(contenders)
        for contender in (*contenders[first:], *contenders[:first]):
            seconds[contender.name][i] = _seconds(contender) / contender.work
        on_round(i + 1)
    return {name: Timing(name, values) for name, values in seconds.items()}


def _seconds(contender: Contender) -> float:
    collecting = gc.isenabled()
    gc.disable()
    try:
        start, runs, spent = contender.clock(), 0, 0.0
        while not spent:  # some clocks are too coarse for one run
            contender.run()
            runs, spent = runs + 1, contender.clock() - start
        return spent / runs
    finally:
        if collecting:
            gc.enable()


@contextmanager
def cores(count: int) -> Iterator[None]:
    """Keeps every thread of this process to `count` cores, where the system can do that."""
    before = os.sched_getaffinity(0) if hasattr(os, "sched_getaffinity") else None
    if before:
        _pin(sorted(before)[:count])
    try:
        yield
    finally:
        if before:
            _pin(before)


def _pin(wanted: Sequence[int] | set[int]) -> None:
    """Affinity belongs to a thread, so it is set for each that exists; new ones inherit it."""
    tasks = Path("/proc/self/task")
    for thread in [int(p.name) for p in tasks.iterdir()] if tasks.is_dir() else [0]:
        try:
            os.sched_setaffinity(thread, wanted)
        except ProcessLookupError:  # it has ended since
            continue


def installed(package: str) -> str | None:
    """None if an optional peer can be imported, otherwise the sentence that says why not."""
    return None if find_spec(package) else f"{package} is not installed (pip install 'chapsym[bench]')"
