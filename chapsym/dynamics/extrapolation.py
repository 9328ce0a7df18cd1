"""The continuous ball to high order: the rotation of a long step is extrapolated from the map with shorter steps.

The map is self-adjoint, so the rotation of n steps of length h/n together is an even power series in h/n.  The
quaternions for c values of n up to 7, weighted by the product of n²/(n² - m²) over the other m, have an error of order
h^(2c+1).  The steps are fitted to steady rotation (`loops.lanes`), which reduces this error.  K and γ are then turned
by *one* rotation: ⟨K,γ⟩, |K|² and |γ|² are kept to rounding, at every order.  Unlike a composition, a step is
self-adjoint and keeps the measure only to the order h^(2c+1).  In double-double there are columns up to n = 14, which
are not fitted.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import pairwise
from math import nan, prod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import chapsym.dynamics.native as native
from chapsym.numbers import Double, DoubleDouble, Pair, Precision

from .attitudes import first_attitudes
from .ball import Asked, Ball, Floats, batch, callback, in_shape, is_flag, is_followed, numbers, unit_vertical
from .errors import BadInput, Status, StepNotTaken
from .levels import double_double
from .levels.dispatch import begun, precision_of
from .levels.frames import Balls, Count, Frames, cores, parts, share
from .loops import loop, records
from .loops.double_double import FIRST
from .loops.guess import guess_weights
from .loops.lanes import CHANGES, DOUBT, EIGHT, LANES, LAST, MOST_COLUMNS, MOVED, ROWS, Weights, march, march_alone
from .loops.records import Steps
from .map import MOST_STEPS, flag, rolling_radius, seconds, whole_number
from .results import in_given_axes
from .shown import Brief

#: Steps of the map between two points at which the run can be interrupted.
CHUNK = 200_000
#: The fewest steps of the map, most of them in lanes, that are worth threads: a few milliseconds.
SHORT_RUN = 150_000
#: From this many balls on, a block of eight is faster than single balls.
FEW = 6
#: The largest and the default number of columns in double-double: more columns amplify roundings more than they gain.
MOST_OF_PAIRS = 12


@dataclass(frozen=True, eq=False, repr=False)
class Extrapolated(Brief):
    """States of the continuous ball after equal time steps, for one ball or a batch (...).

    Attributes
    ----------
    angular_momentum : ndarray
        K in kg m²/s, shape (..., 3).
    gamma : ndarray
        The vertical upwards, shape (..., 3).
    attitude : ndarray or None
        Unit quaternions, body to space, scalar first, shape (..., 4).
    contact : ndarray or None
        The contact point on the plane in m, from (0, 0), shape (..., 2).
    index : ndarray or None
        The step numbers of the frames, shape (frames,); the arrays above are then (..., frames, 3), ...; or None.
    doubt : ndarray
        The sum over the steps of the angle between the rotation and the rotation with one column less, in radians,
        shape (...): the local errors of one column less.  It is no bound, and no estimate if the motion amplifies
        errors, as near an unstable rotation; `roll` has an estimate.
    status : ndarray
        A `Status` for each ball, shape (...); if it is not TAKEN, the numbers above are NaN from that step on.
    taken : ndarray
        The number of steps taken by each ball, shape (...).
    low : Extrapolated or None
        In double-double, the low halves of the numbers above, as a record; else None.

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.Ball((1, 2, 4), 3)
    >>> run = chapsym.extrapolate(ball, (1, -0.5, 0.75), (2/7, 3/7, 6/7), 0.5, 20, every=10)
    >>> run.index.tolist(), run.gamma.shape, int(run.taken)
    ([0, 10, 20], (3, 3), 20)
    """

    angular_momentum: Floats
    gamma: Floats
    attitude: Asked
    doubt: Floats
    status: np.ndarray
    taken: np.ndarray
    contact: Asked = None
    index: np.ndarray | None = None
    low: Extrapolated | None = None


@cache
def weights(columns: int, first: int = 0) -> tuple[Fraction, ...]:
    """The exact weights of the columns n = 8 - columns, ..., 7: Σ w = 1 and Σ w/n^(2j) = 0 for 0 < j < columns.

    first: the n of the first column, if it is another.
    """
    every = range(first, first + columns) if first else range(LAST + 1 - columns, LAST + 1)
    return tuple(prod((Fraction(n * n, n * n - m * m) for m in every if m != n), start=Fraction(1)) for n in every)


@cache
def weights_of_pairs(columns: int) -> Floats:
    """The arguments of `march_long_pairs`: the weights and their changes by the last column, (columns, 4)."""
    whole, fewer = (weights(n, FIRST) for n in (columns, columns - 1))
    pairs = zip(whole, (*fewer, Fraction(0)), strict=True)
    return np.array([[*Pair.of(w).halves(), *Pair.of(w - v).halves()] for w, v in pairs])


def stages_of(columns: int, first: int = 0) -> int:
    """The number of steps of the map in a long step; first: as for `weights`."""
    first = first or LAST + 1 - columns
    return sum(range(first, first + columns))


@in_given_axes
def extrapolate(
    ball: Ball,
    angular_momentum: ArrayLike,
    gamma: ArrayLike,
    time_step: float | Fraction,
    steps: int,
    *,
    columns: int | None = None,
    every: int | None = None,
    attitude: bool | ArrayLike = False,
    contact: bool = False,
    precision: str | Precision = "double",
    threads: int = 0,
    progress: Callable[[int], None] = lambda steps_done: None,
) -> Extrapolated:
    """Follows the continuous ball (2.12, 2.13) for `steps` times `time_step`, to the order 2 `columns`.

    A ball has the same bits alone and in a batch.

    Parameters
    ----------
    ball : Ball
        One ball or a batch, (...).
    angular_momentum : array_like
        K in kg m²/s, shape (..., 3); it broadcasts with γ and the balls.
    gamma : array_like
        Unit verticals upwards, shape (..., 3).
    time_step : float or Fraction
        Seconds, negative for backward in time; a Fraction keeps 106 bits in double-double.
    steps : int
        The number of steps.
    columns : int, optional
        2 to 6, the default.  A step consists of 8 - columns, ..., 6 and 7 steps of the map, in parallel; its error has
        the order time_step^(2 columns), and ⟨K,γ⟩, |K|² and |γ|² are kept to rounding.  In double-double 2 to 12, the
        default, of 3, 4, ..., columns + 2 steps of the map.
    every : int, optional
        If given, the start and every `every`-th state are kept; else only the end.
    attitude : bool or array_like, optional
        True (from the least rotation with R γ = e₃) or unit quaternions, (..., 4), to be followed.
    contact : bool, optional
        Whether to trace the contact point, to the same order; needs `ball.radius`, and implies the attitude.
    precision : str or Precision, optional
        "double" (the default), or "double-double", which divides γ (and an attitude) by its length.
    threads : int, optional
        The number of cores that a batch may use; 0, the default, for all.
    progress : callable, optional
        Called with the steps done so far, of all balls together, at the latest when a ball or a block of eight is
        complete.

    Returns
    -------
    Extrapolated
        The end, or the frames if `every` is given.

    Raises
    ------
    StepNotTaken
        For one ball, if the map has no step of length time_step/n; a batch reports `status`.
    BadInput
        As `step` does, for a time_step that is not a single finite number, and for counts out of range.

    References
    ----------
    Equations (2.12) and (2.13) of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.Ball((1, 2, 4), 3)
    >>> end = chapsym.extrapolate(ball, (1, -0.5, 0.75), (2/7, 3/7, 6/7), 0.5, 20)
    >>> end.gamma.round(9).tolist()
    [0.844567314, -0.535330877, 0.011265216]
    >>> bool(end.doubt < 1e-8)
    True
    """
    if not isinstance(level := precision_of(precision), Double | DoubleDouble):
        raise BadInput('long steps have the precisions "double" and "double-double"')
    of_pairs = isinstance(level, DoubleDouble)
    most = MOST_OF_PAIRS if of_pairs else MOST_COLUMNS
    columns = most if columns is None else whole_number(columns, "columns", 2, most)
    steps, threads = whole_number(steps, "steps", 0, MOST_STEPS), whole_number(threads, "threads", 0)
    callback(progress)
    h = seconds(time_step, positive=False)
    kept = max(steps, 1) if every is None else min(whole_number(every, "every", 1), steps + 1)
    shape, (K, g, J, D) = batch(ball, numbers(angular_momentum, "angular_momentum", 3), unit_vertical(gamma))
    follows = flag(contact, "contact") or is_followed(attitude)
    radius = np.broadcast_to(rolling_radius(ball), shape).reshape(-1).copy() if contact else D
    first = first_attitudes(attitude, g, shape) if follows else None
    balls, count = Balls(K, g, J, D, radius), steps // kept + 1
    frames = begun(level, balls, count, first, is_flag(attitude))
    if of_pairs:
        pair = Pair.of(time_step) if isinstance(time_step, Fraction) else Pair(h)
        doubt = double_double.run_long(balls, pair, steps, kept, frames, weights_of_pairs(columns), threads, progress)
    else:
        given = frames.some(slice(None), contact), records.Balls(J, D, radius), frames.ends(slice(None))
        doubt = _march(given, h, Steps(0, steps, kept), loop_weights(columns), threads, progress)
    if not shape and frames.status[0]:
        raise StepNotTaken(Status(int(frames.status[0])), float(frames.reach[0]), int(frames.taken[0]))

    def shaped(array: Floats) -> Floats:
        return in_shape(shape, array[:, -1] if every is None else array)

    def result(kept_frames: Frames, low: Extrapolated | None = None) -> Extrapolated:
        attitudes = shaped(kept_frames.attitude) if follows else None
        return Extrapolated(
            shaped(kept_frames.momentum), shaped(kept_frames.gamma), attitudes, doubt.reshape(shape),
            frames.status.reshape(shape), frames.taken.reshape(shape), shaped(kept_frames.contact) if contact else None,
            None if every is None else np.arange(count) * kept, low,
        )  # fmt: skip

    return result(frames, None if frames.low is None else result(frames.low))


def _march(
    given: tuple[Any, ...], h: float, steps: Steps, weights: Weights, threads: int, progress: Callable[[int], None]
) -> Floats:
    """Takes all long steps of the balls of the frames, balls and ends that are given; returns doubt, (n,)."""
    n, stages, status = len(given[1].contact), stages_of(weights.sums.shape[1]), given[2].status
    doubt, blocks = np.empty(n), (n + EIGHT - FEW) // EIGHT if native.is_compiled() else 0  # the last has idle lanes

    def task(at: int) -> None:
        """Takes the steps of some balls in parts, between which it can be interrupted."""
        first, width = (EIGHT * at, EIGHT) if at < blocks else (EIGHT * blocks + at - blocks, 1)
        some, kept = slice(first, first + width), np.empty((ROWS + loop.ROWS, LANES * width))
        own, take = [of_some(record, some) for record in given], native.loop(march_alone if width == 1 else march)
        for part in parts(steps, CHUNK // stages) if steps.last else [steps]:
            take(*own, h, part, weights, kept)
            count.add((part.last - part.first) * len(doubt[some]))
            if count.stopped or status[some].all():
                break
        doubt[some] = kept[MOVED + DOUBT, : len(doubt[some])]

    tasks, work = range(blocks + max(0, n - EIGHT * blocks)), steps.last * n * stages
    workers, count = min(threads or cores(), len(tasks)) if work >= SHORT_RUN else 1, Count(progress)
    share(task, tasks, workers, count)
    return np.where(status, nan, doubt)


def of_some(record: Any, some: slice) -> Any:
    """A record of the loops for some balls."""
    return record._make([x[some] if isinstance(x, np.ndarray) else x for x in record])


@cache
def loop_weights(columns: int) -> Weights:
    """The weights of the columns and those of the guesses."""
    padded = ((Fraction(0),) * fewer + weights(columns - fewer) for fewer in range(2 + CHANGES))
    rows = [np.array(row, dtype=float)[:columns] for row in padded]
    changes = [longer - shorter for longer, shorter in pairwise(rows)]
    return Weights(np.array([rows[0], *changes]), *guess_weights(columns))
