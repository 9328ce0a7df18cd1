"""How far a run is, and how it is told to stop."""

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from chapsym.dynamics import Status

from ..plan.models import State
from ..plan.plan import Plan

#: Seconds between two reports.
OFTEN = 0.1


@dataclass(frozen=True)
class Progress:
    """steps: of all balls together, taken so far of `of`.  balls: that are done.  failed: balls that stopped early."""

    steps: int
    of: int
    balls: int
    failed: int


Report = Callable[[Progress], None]


class Stopped(Exception):
    """Raised inside a unit of work when the run is to stop."""


def silent(progress: Progress) -> None:
    """Reports nothing."""


class Tally:
    """Adds up the work of units that run side by side."""

    def __init__(self, plan: Plan, report: Report = silent) -> None:
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
        """So many segments of a chunk are done."""
        with self._lock:
            self._done[chunk] = self.work(chunk, segments)
            self._failed[chunk] = int(np.count_nonzero(state["status"] != Status.TAKEN))
            balls = self.plan.chunks[chunk]
            self._finished += (balls.stop - balls.start) * (segments == len(self.plan.segments))
        self._tell(now=True)

    def within(self, chunk: int, segment: int) -> Callable[[int], None]:
        """The progress of a unit: a function of the steps that its balls have taken; it raises Stopped."""
        before, after = self.work(chunk, segment), self.work(chunk, segment + 1)

        def told(steps: int) -> None:
            if self.stopped:
                raise Stopped
            self._done[chunk] = min(before + steps, after)
            self._tell()

        return told

    @property
    def progress(self) -> Progress:
        """How far the run is."""
        whole = len(self.plan.members) * self.plan.frames * self.plan.task.every
        return Progress(sum(self._done.values()), whole, self._finished, sum(self._failed.values()))

    def _tell(self, now: bool = False) -> None:
        with self._lock:
            if now or time.monotonic() - self._told >= OFTEN:
                self._told = time.monotonic()
                self.report(self.progress)
