"""The continuous ball to high order: the rotation of a long step, extrapolated from the map with shorter steps.

The map is self-adjoint, so the rotation that n steps of length h/n make together is an even power series in h/n.
Its quaternions for c values of n up to 7, with the weights n²/(n² - m²) multiplied over the other m, leave an error of
order h^(2c+1).  The steps are fitted to steady rotation (`loops.fitted`), which leaves less of it.  K and γ are then
turned by *one* rotation: ⟨K,γ⟩, |K|² and |γ|² are kept to rounding, at every order.  A step is no longer exactly
self-adjoint, as compositions are, nor is the measure kept: both to the order h^(2c+1).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import pairwise
from math import isfinite, prod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import chapsym.dynamics.native as native

from .attitudes import initial_attitude
from .ball import Asked, Ball, Floats, batch, is_followed, numbers, unit_vertical
from .errors import BadInput, Status, StepNotTaken
from .levels import double
from .levels.dispatch import no_room
from .levels.frames import Count, cores, share
from .loops.guess import guess_weights
from .loops.lanes import EIGHT, MOST_COLUMNS
from .loops.long_run import march_eight, march_one
from .loops.long_step import CHANGES, LAST
from .results import in_given_axes
from .trajectories import flag, rolling_radius, whole_number

#: From so many balls on a block of eight is faster than one after another.
FEW = 6


@dataclass(frozen=True, eq=False)
class Extrapolated:
    """States of the continuous ball after a number of equal times, for one ball or a batch (...).

    angular_momentum: K in kg m²/s, shape (..., 3); gamma: the vertical upwards, (..., 3).
    attitude: unit quaternions, body to space, scalar first, (..., 4), or None.
    contact: the contact point on the plane in m, from (0, 0), (..., 2), or None.
    index: None; or the steps after which the frames are, (frames,), and those above are (..., frames, 3), ...
    doubt: the sum over the steps of the angle between the rotation and the one with a column less, in radians,
    (...): an estimate of the error that one column less would have made, so a large one of the error.
    status: a `Status` for each ball, (...); from where it is not TAKEN on the numbers above are NaN.
    taken: the steps of each ball before that, (...).
    """

    angular_momentum: Floats
    gamma: Floats
    attitude: Asked
    doubt: Floats
    status: np.ndarray
    taken: np.ndarray
    contact: Asked = None
    index: np.ndarray | None = None


@cache
def weights(columns: int) -> tuple[Fraction, ...]:
    """The exact weights of the columns n = 8 - columns, ..., 7: Σ w = 1 and Σ w/n^(2j) = 0 for 0 < j < columns."""
    every = range(LAST + 1 - columns, LAST + 1)
    return tuple(prod((Fraction(n * n, n * n - m * m) for m in every if m != n), start=Fraction(1)) for n in every)


def stages_of(columns: int) -> int:
    """How many steps of the map a long step is."""
    return sum(range(LAST + 1 - columns, LAST + 1))


@in_given_axes
def extrapolate(
    ball: Ball,
    angular_momentum: ArrayLike,
    gamma: ArrayLike,
    time_step: float,
    steps: int,
    *,
    columns: int = 6,
    every: int | None = None,
    attitude: bool | ArrayLike = False,
    contact: bool = False,
    threads: int = 0,
    progress: Callable[[int], None] = lambda steps_done: None,
) -> Extrapolated:
    """Follows the continuous ball (2.12, 2.13) for `steps` times `time_step`, to the order 2 `columns`.

    angular_momentum: K in kg m²/s, shape (..., 3); gamma: unit verticals upwards, (..., 3).  Both broadcast with
    each other and with the balls.  time_step: seconds, negative for back in time.
    columns: 2 to 6.  A step is 8 - columns, ..., 6 and 7 steps of the map beside each other; its error is of the order
    time_step^(2 columns), ⟨K,γ⟩, |K|² and |γ|² are kept to rounding.
    every: without it only the end is kept; with it the start and every `every`-th state.
    attitude: True (from the least rotation with R γ = e₃) or unit quaternions, (..., 4), to be followed.
    contact: whether to trace the contact point, to the same order; it needs `ball.radius`, and implies the attitude.
    threads: how many cores a batch may use; 0 for all.
    progress: called with the steps done so far, of all balls together, whenever one ball or eight have all of theirs.

    A ball has the same bits alone and in a batch, whatever ran before.
    One ball raises StepNotTaken where the map has no step of length time_step/n; a batch reports `status`.
    Raises BadInput as `step` does, for a time_step that is not one finite number, and for counts out of range.
    """
    steps, columns = whole_number(steps, "steps", 0), whole_number(columns, "columns", 2, MOST_COLUMNS)
    kept = max(steps, 1) if every is None else min(whole_number(every, "every", 1), steps + 1)
    threads, h = whole_number(threads, "threads", 0), _seconds(time_step)
    shape, (K, g, J, D) = batch(ball, numbers(angular_momentum, "angular_momentum", 3), unit_vertical(gamma))
    follows = flag(contact, "contact") or is_followed(attitude)
    n, count = len(D), steps // kept + 1
    body = count if follows else 0
    try:
        momenta, verticals = _frames(K, count), _frames(g, count)
        attitudes, spots = np.empty((n, body, 4)), np.empty((n, body, 2))
    except (MemoryError, ValueError):
        raise no_room(count, n) from None
    if follows:
        first = initial_attitude(attitude, g.reshape(*shape, 3))
        attitudes[:, 0], spots[:, 0] = np.broadcast_to(first, (*shape, 4)).reshape(-1, 4), 0.0
    radius = np.broadcast_to(rolling_radius(ball), shape).reshape(-1).copy() if contact else D
    frames = momenta, verticals, attitudes, spots, J, D, radius
    how = h, steps, kept, follows, contact
    doubt, taken, status = _march(frames, how, columns, threads, not shape, progress)

    def shaped(array: Floats) -> Floats:
        array = array[:, -1] if every is None else array
        return array.reshape(shape + array.shape[1:]) if shape else array[0]

    return Extrapolated(
        shaped(momenta), shaped(verticals), shaped(attitudes) if follows else None, doubt.reshape(shape),
        status.reshape(shape), taken.reshape(shape), shaped(spots) if contact else None,
        None if every is None else np.arange(count) * kept,
    )  # fmt: skip


def _frames(first: Floats, count: int) -> Floats:
    """Room for frames, (n, count, 3), of which the first is there; it is `first` itself where there is no other."""
    if count == 1:
        return first.reshape(-1, 1, 3)
    frames = np.empty((len(first), count, 3))
    frames[:, 0] = first
    return frames


def _seconds(time_step: float) -> float:
    """One finite number; raises BadInput for anything else."""
    if type(time_step) is float and isfinite(time_step):
        return time_step
    h = numbers(time_step, "time_step")
    if h.ndim:
        raise BadInput(f"time_step must be one number of seconds, not {time_step!r}")
    return float(h)


def _march(
    frames: tuple[Floats, ...], how: tuple[Any, ...], columns: int, threads: int, alone: bool,
    progress: Callable[[int], None],
) -> tuple[Floats, np.ndarray, np.ndarray]:  # fmt: skip
    """Takes all long steps; returns doubt, taken and status, (n,).

    frames, how: the first arguments of `march_lanes`.  alone: one ball that stops raises StepNotTaken.
    """
    n, steps = len(frames[0]), how[1]
    work = steps * n * stages_of(columns)
    weights, doubt, reach = loop_weights(columns), np.empty(n), np.empty(n)
    taken, status = np.zeros(n, dtype=np.int64), np.zeros(n, dtype=np.int64)
    ends = doubt, taken, status, reach
    if alone:
        native.loop(march_one)(*frames, *how, *weights, *ends)
        if status[0]:
            raise StepNotTaken(Status(int(status[0])), float(reach[0]), int(taken[0]))
        progress(steps)
        return doubt, taken, status
    blocks = (n + EIGHT - FEW) // EIGHT if native.is_compiled() else 0  # the last may have idle lanes
    march, each = native.loop(march_eight), native.loop(march_one)

    def task(part: int) -> None:
        first = EIGHT * part if part < blocks else EIGHT * blocks + part - blocks
        some = slice(first, first + (EIGHT if part < blocks else 1))
        loop = march if part < blocks else each
        loop(*(x[some] for x in frames), *how, *weights, *(x[some] for x in ends))
        count.add(steps * len(doubt[some]))

    parts = range(blocks + max(0, n - EIGHT * blocks))
    workers, count = min(threads or cores(), len(parts)) if work >= double.SHORT_RUN else 1, Count(progress)
    share(task, parts, workers, count)
    return doubt, taken, status


@cache
def loop_weights(columns: int) -> tuple[Floats, Floats, Floats]:
    """What the loops take: the weights of the columns, as of `march_lanes`, and those of the guesses."""
    rows = [
        np.array((Fraction(0),) * fewer + weights(columns - fewer), dtype=float)[:columns]
        for fewer in range(2 + CHANGES)
    ]
    changes = [longer - shorter for longer, shorter in pairwise(rows)]
    return np.array([rows[0], *changes]), *guess_weights(columns)
