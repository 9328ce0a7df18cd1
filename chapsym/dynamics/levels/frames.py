"""The start of a run, its frames, and the sharing of its work among threads."""

import os
import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed, wait
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import Digits, Enclosure, Precision

from ..ball import Ball, Floats, batch, beyond_float64, exact_array, numbers, unit_vertical
from ..loops import records
from ..loops.records import Steps

#: The number of parts of the work of each thread, so that none is idle for long at the end.
SHARES = 16
#: Seconds between two checks of work in a thread of its own.
OFTEN = 0.1


@dataclass(frozen=True, eq=False)
class Balls:
    """The balls of a run: momentum 𝒦 and γ at the start, (n, 3); J, (n, 3); D and the radius, (n,).

    Floats, or for Digits and Enclosure exact fractions of any size.
    rest: the low half of 𝒦, (n, 3), for the precisions that can hold it; or None.
    """

    momentum: Floats
    gamma: Floats
    mass_tensor: Floats
    D: Floats
    radius: Floats
    rest: Floats | None = None


def exactly(given: ArrayLike, floats: Floats, shape: tuple[int, ...]) -> np.ndarray:
    """The given numbers, as Fractions in the shape of the floats, if they are exact; else the floats."""
    if not beyond_float64(given):
        return floats
    return np.broadcast_to(exact_array(given), (*shape, *floats.shape[1:])).reshape(floats.shape)


def given(
    ball: Ball, momentum: ArrayLike, gamma: ArrayLike, precision: Precision
) -> tuple[tuple[int, ...], Floats, Balls]:
    """The leading axes of the states, γ in float64, and the balls of a run: for Digits and Enclosure as given."""
    shape, floats = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
    rest, state = None, tuple[np.ndarray, ...](floats)
    if isinstance(precision, Digits | Enclosure):
        state = tuple(exactly(x, y, shape) for x, y in zip((momentum, gamma, *ball.exact[:2]), floats, strict=True))
    elif beyond_float64(momentum):
        exact = exact_array(momentum)
        beyond = np.array([float(x - Fraction(float(x))) for x in exact.flat]).reshape(exact.shape)
        rest = np.broadcast_to(beyond, (*shape, 3)).reshape(-1, 3)
    K, g, J, D = state
    return shape, floats[1], Balls(K, g, J, D, np.zeros(len(D)), rest)


@dataclass(frozen=True, eq=False)
class Frames:
    """The frames of a run: arrays (n, frames, ...) whose frame 0 is given, and the outcome of each ball, (n,).

    attitude and contact have no frames unless `with_body`.  The arrays have the numbers of the precision: float32,
    float64, or objects; `low` has the low halves of double-double numbers.  least: the first attitudes are the least
    rotations with R γ = e₃, which other precisions compute to more digits than frame 0 has.
    """

    momentum: np.ndarray
    gamma: np.ndarray
    attitude: np.ndarray
    contact: np.ndarray
    taken: np.ndarray
    status: np.ndarray
    reach: Floats
    with_body: bool
    low: "Frames | None" = None
    least: bool = False

    @property
    def halves(self) -> "Frames":
        """The low halves of double-double numbers."""
        assert self.low is not None
        return self.low

    def of(self, i: int) -> records.Track:
        """The frames of one ball, for the loops."""
        return records.Track(self.momentum[i], self.gamma[i], self.attitude[i], self.contact[i], self.with_body)

    def some(self, which: slice, traced: bool = True) -> records.Frames:
        """The frames of some balls, for the loops; traced: whether the contact points are, of bodies with attitudes."""
        kept = self.momentum[which], self.gamma[which], self.attitude[which], self.contact[which]
        return records.Frames(*kept, self.with_body, self.with_body and traced)

    def ends(self, which: slice) -> records.Ends:
        """The outcomes of some balls, for the loops."""
        return records.Ends(self.taken[which], self.status[which], self.reach[which])


def untaken(n: int) -> records.Ends:
    """The ends of balls before their first step."""
    return records.Ends(np.zeros(n, np.int64), np.zeros(n, np.int64), np.ones(n))


def parts(steps: Steps, size: int) -> Iterator[Steps]:
    """The steps of a run in parts of `size`, between which it can be interrupted."""
    size = max(1, size)
    for first in range(steps.first, steps.last, size):
        yield Steps(first, min(steps.last, first + size), steps.every)


class Count:
    """Adds up the steps of the threads, which end when `stopped` is set."""

    def __init__(self, progress: Callable[[int], None]) -> None:
        self._progress, self._lock, self._done = progress, threading.Lock(), 0
        self.stopped = False

    def add(self, steps: int) -> None:
        """Adds a number of steps."""
        with self._lock:
            self._done += steps
            self._progress(self._done)


def after(before: int, progress: Callable[[int], None]) -> Callable[[int], None]:
    """The progress of a part that begins when `before` are done."""
    return lambda done: progress(before + done)


def cores() -> int:
    """The cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def share(task: Callable[[int], None], starts: range, workers: int, count: Count) -> None:
    """Runs the tasks in threads, several tasks at a time; an interrupt stops each thread at its next chunk."""
    if workers < 2:
        for start in starts:
            task(start)
        return
    several = max(1, len(starts) // (workers * SHARES))

    def group(at: int) -> None:
        for start in starts[at : at + several]:
            if not count.stopped:
                task(start)

    with ThreadPoolExecutor(workers) as pool:
        futures = [pool.submit(group, at) for at in range(0, len(starts), several)]
        try:
            for done in as_completed(futures):
                done.result()
        except BaseException:
            count.stopped = True
            pool.shutdown(wait=True, cancel_futures=True)
            raise


def watched(work: Callable[[], None], look: Callable[[], None], stop: Callable[[], None]) -> None:
    """Does `work` in a thread of its own, so that an interrupt takes effect while compiled code runs.

    look: called every `OFTEN` seconds; an exception ends the work.  stop: asks the work to end; called until it ends.
    """
    with ThreadPoolExecutor(1) as pool:
        future = pool.submit(work)
        try:
            while wait([future], OFTEN).not_done:
                look()
        except BaseException:
            while not future.done():
                stop()
                wait([future], OFTEN)
            raise
        future.result()
