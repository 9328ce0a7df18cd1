"""The map and its symmetric compositions: single steps, trajectories, steps of exact numbers, and their checks."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import NAMED, Digits, Double, DoubleDouble, Pair, Precision, Single
from chapsym.numbers.precisions import is_whole

from .attitudes import first_attitudes
from .ball import Ball, Floats, brief, callback, flag, in_shape, is_flag, is_followed, numbers
from .coefficients import substeps
from .errors import BadInput, LimitReached
from .levels import dispatch
from .levels.frames import Balls, Frames, given
from .levels.start import exponent_of, fraction
from .results import Bounds, Step, Trajectory, finished, in_given_axes, of_balls

#: The digits of a step of exact numbers that are no floats, before it is rounded to pairs.
BEYOND_DOUBLE_DOUBLE = Digits(40)
#: The largest number of steps; a larger `every` keeps only the first frame.
MOST_STEPS = 2**62


@in_given_axes
def step(
    ball: Ball, momentum: ArrayLike, gamma: ArrayLike, *, precision: str | Precision = "double", proved: bool = False
) -> Step:
    """One step of the map (5.3) on the small-rotation branch, the same bits as the first step of `trajectory`.

    Solves 𝒦(q, γ) = 𝒦 for the rotation Ω (5.2) on the branch continued from the identity, and maps 𝒦 and γ to Ωᵀ𝒦 and
    Ωᵀγ.  𝒦 and γ broadcast with each other and with the balls.  For a ball with `axes` all vectors are in these axes.

    Parameters
    ----------
    ball : Ball
        One ball or a batch, (...).
    momentum : array_like
        𝒦 = ε K of the paper, in kg m², shape (..., 3).
    gamma : array_like
        Unit verticals upwards, shape (..., 3).
    precision : str or Precision, optional
        "single", "double" (the default), "double-double" (31 digits), `Digits(n)` (mpmath) or `Enclosure(bits)` (Arb).
        Floats are taken as exact at every precision; `Digits` and `Enclosure` also take Fractions, Decimals and numbers
        of mpmath and SymPy as exact, also in the ball.  All but "double" divide γ by its length.
    proved : bool, optional
        Whether `Step.proved` bounds the distance of the rotation, 𝒦 and γ from the exact step.  The proof uses only the
        residual at the rotation, with lemma `small-branch` and beyond its bound `straight-path`.  Only for "double" and
        principal axes; a bound is inf if neither lemma applies, as near a fold.

    Returns
    -------
    Step
        The rotation, and 𝒦 and γ after the step.

    Raises
    ------
    StepNotTaken
        If one ball (no leading axis) has no step; a batch reports `status` instead.
    BadInput
        For shapes, NaN, infinities, and a gamma that is not unit.

    References
    ----------
    Equations (5.2) and (5.3) of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.Ball((1, 2, 4), 3)
    >>> chapsym.step(ball, (0.1, 0.05, 0), (0, 0, 1)).gamma.round(9).tolist()
    [-0.006249912, 0.011111155, 0.999918737]
    >>> chapsym.step(ball, [(0.1, 0.05, 0), (100, 0, 0)], (0, 0, 1)).status.tolist()
    [0, 3]
    >>> chapsym.Status(3).name
    'UNREACHABLE'
    """
    level = dispatch.precision_of(precision)
    _only_in_double(flag(proved, "proved"), level)
    return composed(ball, momentum, gamma, 2, level, bool(proved))


def _only_in_double(proved: bool, precision: Precision) -> None:
    if proved and not isinstance(precision, Double):
        raise BadInput(
            'a step is proved in "double"; in "double-double" take trajectory(..., 1, proved=True), '
            "and an Enclosure is proved as it is"
        )


@in_given_axes
def compose_step(ball: Ball, momentum: ArrayLike, gamma: ArrayLike, order: int) -> Step:
    """One step of the composition of order 2, 4, 6 or 8.

    All momentum integrals are kept to rounding: every stage turns 𝒦 and γ by one rotation (lemma
    `momentum-integrals-composed`).

    Parameters
    ----------
    ball : Ball
        One ball or a batch, (...).
    momentum, gamma : array_like
        𝒦 and γ, as for `step`, shape (..., 3).
    order : int
        2, 4, 6 or 8.

    Returns
    -------
    Step
        `rotation` is the product of the rotations of the stages; if a stage is not taken, `reach` is the fraction of
        its momentum that the small-rotation branch attains.

    Raises
    ------
    StepNotTaken, BadInput
        As `step` does, and BadInput for another order.

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.Ball((1, 2, 4), 3)
    >>> after = chapsym.compose_step(ball, (0.1, 0.05, 0), (0, 0, 1), 8)
    >>> after.gamma.round(9).tolist()
    [-0.006249745, 0.011110856, 0.999918741]
    >>> round(float(after.momentum @ after.momentum), 12)
    0.0125
    """
    substeps(order)  # which refuses other orders
    return composed(ball, momentum, gamma, order, NAMED["double"])


@in_given_axes
def trajectory(
    ball: Ball,
    momentum: ArrayLike,
    gamma: ArrayLike,
    steps: int,
    *,
    order: int = 2,
    every: int = 1,
    attitude: bool | ArrayLike = False,
    contact: bool = False,
    time_step: float | None = None,
    precision: str | Precision = "double",
    proved: bool = False,
    threads: int = 0,
    progress: Callable[[int], None] = lambda steps_done: None,
) -> Trajectory:
    """Takes `steps` steps of the map on the small-rotation branch and keeps every `every`-th state.

    For a ball with `axes`, all vectors and attitudes, given and returned, are in these axes.

    Parameters
    ----------
    ball : Ball
        One ball or a batch, (...).
    momentum, gamma : array_like
        𝒦 in kg m² and γ, as for `step`, shape (..., 3); both broadcast with the balls.  A momentum of Fractions keeps
        106 bits in double-double, and all bits at higher precisions, so that εK may be exact.
    steps : int
        The number of steps.
    order : int, optional
        2 (the default), or 4, 6, 8 for a symmetric composition of the map with stages cᵢ𝒦 (`substeps`): 𝒦, γ, the
        attitude and the contact point then converge with that order to those of the continuous ball (2.3), and the
        momentum integrals are kept to rounding.
    every : int, optional
        The number of steps from one frame to the next; by default 1.
    attitude : bool or array_like, optional
        True (from the least rotation with R γ = e₃) or unit quaternions, (..., 4), to be followed.
    contact : bool, optional
        Whether to trace the contact point; it needs `ball.radius`, and implies the attitude.
    time_step : float, optional
        ε in seconds, which `Trajectory.time`, K and ω need.
    precision : str or Precision, optional
        "single", "double" (the default), "double-double" (31 digits), `Digits(n)` (mpmath) or `Enclosure(bits)` (Arb).
        Floats are taken as exact, but "single" rounds all input to float32, and all but "double" divide γ (and an
        attitude) by its length.  The coefficients of the orders 4, 6, 8 are rounded to float32 or float64; at higher
        precisions they are the 40 digits of `coefficients`, and an Enclosure encloses the map composed with these:
        `bits` are correct in every frame, relative to the length of each vector.  Its branch is proved by the lemmas
        `small-branch` and `straight-path`; if neither applies, as near a fold, the float64 continuation selects the
        branch (`Certificate.selected`).
    proved : bool, optional
        Whether `Trajectory.proved` has bounds of the distance of every frame from the exact orbit of the map.  A second
        run, in double-double, carries the proof and takes five to ten times as long as the run in "double".  Only for
        "double" and "double-double", and principal axes.
    threads : int, optional
        The number of cores that a batch may use; 0, the default, for all.  Digits and Enclosure use one.
    progress : callable, optional
        Called with the steps done so far (of all balls together), about every 200 000 steps.

    Returns
    -------
    Trajectory
        The start and every `every`-th state.  In a batch, a ball that cannot take a step stops, the others continue,
        and `status` and `taken` show which balls stopped, and where.

    Raises
    ------
    StepNotTaken
        If one ball cannot take a step, with `index` and the `trajectory` before it.
    BadInput
        As `step` does, and for counts that are not whole numbers.

    References
    ----------
    Equation (5.3) of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.Ball((1, 2, 4), 3)
    >>> run = chapsym.trajectory(ball, (0.1, 0.05, 0), (0, 0, 1), 1000, every=100)
    >>> run
    <Trajectory of 1 ball: 11 frames in 1000 steps; momentum, gamma>
    >>> bool(abs(run.invariants() - (0, 0.0125, 1)).max() < 1e-13)
    True
    """
    steps, every = whole_number(steps, "steps", 0, MOST_STEPS), whole_number(every, "every", 1)
    threads = whole_number(threads, "threads", 0)
    callback(progress)
    every = min(every, steps + 1)
    time_step = step_of_run(time_step, steps)
    precision = dispatch.precision_of(precision)
    shape, g, balls = given(ball, momentum, gamma, precision)
    with_body = flag(contact, "contact") or is_followed(attitude)
    if contact:
        balls = replace(balls, radius=np.broadcast_to(rolling_radius(ball), shape).reshape(-1))
    first = first_attitudes(attitude, g, shape) if with_body else None
    frame = dispatch.begun(precision, balls, steps // every + 1, first, is_flag(attitude))
    bounds = None
    if flag(proved, "proved"):
        bounds = dispatch.run_proved(precision, balls, steps, every, frame, order, threads, progress)
        bounds = Bounds(*(None if x is None else in_shape(shape, x) for x in vars(bounds).values()))  # type: ignore[arg-type]
    else:
        dispatch.run(precision, balls, steps, every, frame, order, threads, progress)

    def run(kept: Frames) -> Trajectory:
        body = kept.attitude if with_body else None, kept.contact if contact else None
        return of_balls(
            shape, ball, np.arange(steps // every + 1) * every, kept.momentum, kept.gamma, *body,
            frame.taken, frame.status, time_step=time_step, order=order, precision=precision,
        )  # fmt: skip

    result = run(frame)
    low = None if frame.low is None else run(frame.low)
    return finished(replace(result, low=low, proved=bounds), frame.reach)


def composed(
    ball: Ball, momentum: ArrayLike, gamma: ArrayLike, order: int, precision: Precision, proved: bool = False
) -> Step:
    """One step of the composition of any order; `proved` only for order 2 in float64."""
    shape, _, balls = given(ball, momentum, gamma, precision)
    return dispatch.step(precision, shape, balls, order, proved)


def exact_step(
    mass_tensor: Sequence[Fraction], D: Fraction, momentum: Sequence[Fraction], gamma: Sequence[Fraction],
    precision: Precision, proved: bool = False,
) -> Step:  # fmt: skip
    """`step` of one ball from exact rational numbers, rounded once; bounds are proved for the rounded numbers.

    Single, Double: to floats.  DoubleDouble: numbers that are no floats are used at 40 digits, and the step is rounded
    to pairs.  Digits and Enclosure: to their working precision, of any size.

    Raises BadInput, also for a gamma that is not unit to the digits of the precision, and StepNotTaken as `step` does.
    """
    _only_in_double(proved, precision)
    unit_exactly(gamma, precision)
    check_body(mass_tensor, D)
    if isinstance(precision, Single | Double | DoubleDouble):
        tensor, vertical, (contact,), floats = (in_float64(x) for x in (mass_tensor, gamma, (D,), momentum))
        if any(x != 0 and y == 0.0 for x, y in zip(momentum, floats, strict=True)):
            raise BadInput(
                "a component of the momentum is below the range of float64; ask for more with --digits or --ball"
            )
        if not isinstance(precision, DoubleDouble) or [*tensor, *vertical, contact] == [*mass_tensor, *gamma, D]:
            K = np.array(momentum, dtype=object)
            return composed(Ball(tensor, contact), K, vertical, 2, precision, proved)
        return _in_pairs(exact_step(mass_tensor, D, momentum, gamma, BEYOND_DOUBLE_DOUBLE), precision)
    K, g, J = (np.array([x], dtype=object) for x in (momentum, gamma, mass_tensor))
    return dispatch.step(precision, (), Balls(K, g, J, np.array([D], dtype=object), np.zeros(1)), 2)


def _in_pairs(step: Step, precision: DoubleDouble) -> Step:
    """A step in mpmath's numbers, rounded to pairs."""
    vectors = step.rotation, step.momentum, step.gamma
    q, K, g = (np.array([Pair.of(fraction(x)).halves() for x in v]).T for v in vectors)
    high, low = (Step(q[i], K[i], g[i], step.status, step.reach, precision) for i in range(2))
    return replace(high, low=low)


def check_body(J: Sequence[Fraction], D: Fraction) -> None:
    """Raises BadInput unless a body has these moments, as `Ball` does, but for numbers of any size."""
    largest = max(map(abs, (*J, D)))
    scale = Fraction(1)
    if largest and not 1e-300 < largest < 1e300:
        scale = Fraction(2) ** -exponent_of(largest)
    # A moment far below the others must not become 0, or the body would have no inertia.
    Ball([_at_least(x * scale) for x in J], _at_least(D * scale))


def check_tensor(rows: Sequence[Sequence[Fraction]], D: Fraction) -> tuple[Any, ...]:
    """A tensor ∫xxᵀdm by rows, or its diagonal if it is diagonal; raises BadInput unless a body has it."""
    if any(rows[i][j] != rows[j][i] for i in range(3) for j in range(i)):
        raise BadInput("mass_tensor must be symmetric: give the two entries of each pair alike")
    diagonal = tuple(rows[i][i] for i in range(3))
    check_body(diagonal, D)
    if not any(rows[i][j] for i in range(3) for j in range(i)):
        return diagonal
    (a, d, e), (_, b, f), (_, _, c) = rows
    whole = a * b * c + 2 * d * e * f - a * f * f - b * e * e - c * d * d
    if min(a * b - d * d, a * c - e * e, b * c - f * f, whole) < 0:
        raise BadInput("no body has this mass_tensor: the second moment of the mass is negative along some axis")
    return tuple(map(tuple, rows))


def _at_least(x: Fraction) -> float:
    return float(x) if not x or abs(x) > 1e-300 else math.copysign(1e-300, x)


def in_float64(*vectors: Sequence[Fraction]) -> list[float]:
    """All components as floats; raises BadInput for one that is too large."""
    try:
        return [float(x) for vector in vectors for x in vector]
    except OverflowError:
        raise BadInput("a number of the input is beyond the range of float64, where every step starts") from None


def unit_exactly(gamma: Sequence[Fraction], precision: Precision) -> None:
    """Raises BadInput unless |γ|² = 1 to the digits of the precision."""
    off = abs(sum((x * x for x in gamma), Fraction(-1)))
    shown = f"{float(off):.2g}" if off < 10**300 else "more than 1e300"
    if off > Fraction(1, 10**precision.digits):
        raise BadInput(
            f"gamma must be a unit vector to {precision.digits} digits, but |gamma|^2 is off 1 by {shown}; "
            "give it exactly, as rationals such as 2/7,3/7,6/7"
        )


def rolling_radius(ball: Any) -> Floats:
    """The radius of a ball whose contact point is traced; raises BadInput if it has none."""
    if ball.radius is None:
        raise BadInput("the contact point needs the radius: give the ball its radius")
    return ball.radius


def whole_number(value: int, name: str, least: int, most: int | None = None) -> int:
    """A count from `least` to `most`, or, without `most`, cut at 2^62; raises BadInput for anything else."""
    if type(value) is int and least <= value < MOST_STEPS and (most is None or value <= most):
        return value
    found = int(value) if is_whole(value) else None
    if found is None or found < least or (most is not None and found > most):
        bounded = most is not None and (most < MOST_STEPS or (found is not None and found > most))
        clause = f"to {most}" if bounded else "on"
        raise BadInput(f"{name} must be a whole number from {least} {clause}, not {brief(value)}")
    return min(found, MOST_STEPS)


def time_limit(value: float) -> float:
    """A limit in seconds; raises BadInput for anything but a positive number."""
    found = int(value) if is_whole(value) else value if type(value) is float else numbers(value, "limit")
    if np.ndim(found) or not found > 0:
        raise BadInput(f"limit must be a positive number of seconds, not {brief(value)}")
    return float(min(found, MOST_STEPS))


def until(limit: float, progress: Callable[[str], None]) -> Callable[[str], None]:
    """`progress`, which after `limit` seconds raises LimitReached with the sentence that it is given."""
    limit = time_limit(limit)
    end = time.monotonic() + limit

    def going(text: str) -> None:
        if time.monotonic() > end:
            raise LimitReached(f"stopped at the limit of {limit:g} s: {text}; ask for less, or raise the limit")
        progress(text)

    return going


def step_numbers(index: ArrayLike) -> np.ndarray:
    """Ascending whole numbers from 0 on as int64, (frames,); raises BadInput for anything else."""
    try:
        given = np.asarray(index)
    except Exception:  # rows of different length, and whatever an object raises
        given = np.empty(0)
    if given.dtype.kind not in "iu" or given.ndim != 1 or not len(given):
        raise BadInput(f"index must be a list of whole numbers, at least one, not {brief(index)}")
    if int(given[0]) < 0 or int(given.max()) > MOST_STEPS or (given[1:] <= given[:-1]).any():
        raise BadInput("index must ascend from 0 or a later step, to 2^62 at most")
    return given.astype(np.int64)


def step_of_run(time_step: float | Fraction | None, steps: int) -> float | None:
    """The time step of a run in seconds, if given; raises BadInput for an invalid one, and for times beyond float64."""
    epsilon = None if time_step is None else seconds(time_step)
    if epsilon is not None and not steps * epsilon < math.inf:
        raise BadInput("steps times time_step is beyond the range of float64, about 1.8e308 s")
    return epsilon


def seconds(value: Any, positive: bool = True) -> float:
    """A time step in seconds; raises BadInput for anything but a single number, positive if `positive`."""
    if type(value) is float and 0.0 < value < math.inf:
        return value
    epsilon = value if type(value) is float and -math.inf < value < math.inf else numbers(value, "time_step")
    if np.ndim(epsilon) or (positive and not epsilon > 0):
        raise BadInput(f"time_step must be one {'positive ' if positive else ''}number of seconds, not {brief(value)}")
    return float(epsilon)
