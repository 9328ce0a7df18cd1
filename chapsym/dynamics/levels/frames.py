"""The start of a run, its frames, and how its work is shared among threads."""

import os
import threading
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor, as_completed, wait
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import Digits, Enclosure, Precision

from ..ball import Ball, Floats, batch, beyond_float64, exact_array, numbers, unit_vertical

#: The work of each thread comes in about this many parts, so that none is idle for long at the end.
SHARES = 16
#: Seconds between two looks at work that runs in a thread of its own.
OFTEN = 0.1


@dataclass(frozen=True, eq=False)
class Balls:
    """The balls of a run: momentum 𝒦 and γ at the start, (n, 3); J, (n, 3); D and the radius, (n,).

    Floats, or on Digits and Enclosure exact fractions of any size.
    rest: what 𝒦 has beyond float64, (n, 3), for the precisions that can hold it; None for nothing.
    """

    momentum: Floats
    gamma: Floats
    mass_tensor: Floats
    D: Floats
    radius: Floats
    rest: Floats | None = None


def exactly(given: ArrayLike, floats: Floats, shape: tuple[int, ...]) -> Any:
    """The given numbers, as Fractions in the shape of the floats, where they are exact; else the floats."""
    if not beyond_float64(given):
        return floats
    return np.broadcast_to(exact_array(given), (*shape, *floats.shape[1:])).reshape(floats.shape)


def given(
    ball: Ball, momentum: ArrayLike, gamma: ArrayLike, precision: Precision
) -> tuple[tuple[int, ...], Floats, Balls]:
    """The leading axes of the states, γ in float64, and the balls of a run: on Digits and Enclosure as given."""
    shape, floats = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
    rest, state = None, tuple[Any, ...](floats)
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
    """The frames of a run: (n, frames, ...) arrays whose frame 0 is given, and how each ball ended, (n,).

    attitude and contact have no frames unless `with_body`.  The arrays are of the numbers of the precision: float32,
    float64, or objects; `low` has the second halves of double-double numbers.  least: the attitudes start as the least
    rotations with R γ = e₃, which have more digits at other precisions than in frame 0.
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


class Count:
    """Adds up the steps that the threads have taken; they end where `stopped` is set."""

    def __init__(self, progress: Callable[[int], None]) -> None:
        self._progress, self._lock, self._done = progress, threading.Lock(), 0
        self.stopped = False

    def add(self, steps: int) -> None:
        """This many steps more."""
        with self._lock:
            self._done += steps
            self._progress(self._done)


def cores() -> int:
    """The cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def share(task: Callable[[int], None], starts: range, workers: int, count: Count) -> None:
    """Runs the tasks in threads, some at a time for each; an interrupt stops each at its next chunk."""
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
    """Does `work` in a thread of its own, so that an interrupt is heard while compiled code runs.

    look: called every `OFTEN` seconds; what it raises ends the work.  stop: asks the work to end; called until it has.
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
