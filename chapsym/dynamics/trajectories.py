"""Trajectories: many steps of one ball or a batch, with attitude and contact point only when asked for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import inf
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import Precision

from .attitudes import first_attitudes
from .ball import Ball, Floats, in_shape, is_followed, numbers
from .errors import BadInput
from .levels import dispatch
from .levels.frames import Frames, given
from .results import Bounds, Trajectory, finished, in_given_axes, of_balls

#: Whoever asks for more steps than this, or for every this many, will not see the end of it.
MOST_STEPS = 2**62


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

    momentum, gamma: as for `step`; both broadcast with the balls.  A momentum of Fractions keeps 106 bits in
    double-double and at higher precisions, so that εK may be exact there.
    order: 2, or 4, 6, 8 for a symmetric composition of the map with stages cᵢ𝒦 (`substeps`): 𝒦, γ, the attitude and
    the contact point then converge with that order to those of the continuous ball (2.3), and the momentum integrals
    stay exact.
    attitude: True (from the least rotation with R γ = e₃) or unit quaternions, (..., 4), to be followed.
    contact: whether to trace the contact point; it needs `ball.radius`, and implies the attitude.
    precision: "single", "double", "double-double" (31 digits), `Digits(n)` (mpmath) or `Enclosure(bits)` (Arb).
    Floats that are given are taken as exact, but γ (and an attitude) is divided by its length on all but "double", and
    "single" rounds all to float32.  The coefficients of the orders 4, 6, 8 are rounded to float32 or float64; at higher
    precisions they are the 40 digits of `coefficients`, and the map composed with those is what an Enclosure
    encloses: `bits` are correct in every frame, beside the length of each vector.  Its branch is proved by the lemmas
    `small-branch` and `straight-path`; where neither reaches, as near a fold, the float64 continuation selects it
    (`Certificate.selected`).
    proved: whether `Trajectory.proved` shall have bounds of what every frame is off by from the exact orbit of the map:
    a proof that a second run, in double-double, carries along.  It takes some ten times as long as the run in "double";
    it is of "double" and "double-double", and of principal axes.
    threads: how many cores a batch may use; 0 for all.  Digits and Enclosure use one.
    progress: called with the steps done so far (of all balls together), every 200 000 steps or so.

    One ball that cannot take a step raises StepNotTaken with `index` and the `trajectory` before it.
    In a batch the others go on, and `status` and `taken` say which stopped, where.
    Of a ball with axes, momentum, γ and attitude, and what is returned, are in these.
    Raises BadInput as `step` does, and for counts that are not positive integers.
    """
    steps, every = whole_number(steps, "steps", 0), whole_number(every, "every", 1)
    threads = whole_number(threads, "threads", 0)
    every = min(every, steps + 1)
    time_step = None if time_step is None else seconds(time_step)
    precision = dispatch.precision_of(precision)
    shape, g, balls = given(ball, momentum, gamma, precision)
    with_body = flag(contact, "contact") or is_followed(attitude)
    if contact:
        balls = replace(balls, radius=np.broadcast_to(rolling_radius(ball), shape).reshape(-1))
    first = first_attitudes(attitude, g, shape) if with_body else None
    frame = dispatch.begun(precision, balls, steps // every + 1, first, isinstance(attitude, bool | np.bool_))
    bounds = None
    if flag(proved, "proved"):
        dispatch.provable(precision)
        bounds = dispatch.run_proved(precision, balls, steps, every, frame, order, threads, progress)
        bounds = Bounds(*(None if x is None else in_shape(shape, x) for x in vars(bounds).values()))  # type: ignore[arg-type]
    else:
        dispatch.run(precision, balls, steps, every, frame, order, threads, progress)

    def run(kept: Frames) -> Trajectory:
        body = kept.attitude if with_body else None, kept.contact if contact else None
        return of_balls(
            Trajectory, shape, ball, np.arange(steps // every + 1) * every, kept.momentum, kept.gamma, *body,
            frame.taken, frame.status, time_step=time_step, order=order, precision=precision,
        )  # fmt: skip

    result = run(frame)
    low = None if frame.low is None else run(frame.low)
    return finished(replace(result, low=low, proved=bounds), frame.reach)


def rolling_radius(ball: Any) -> Floats:
    """The radius of a ball whose contact point is traced; raises BadInput if it has none."""
    if ball.radius is None:
        raise BadInput("the contact point needs the radius: give the ball its radius")
    radius: Floats = ball.radius
    return radius


def whole_number(value: int, name: str, least: int, most: int | None = None) -> int:
    """A count from `least` to `most`, or without it 2^62 for all that is larger; raises BadInput for anything else."""
    if type(value) is int and least <= value < MOST_STEPS and (most is None or value <= most):
        return value
    number = isinstance(value, int | np.integer) and not isinstance(value, bool)
    if not number or value < least or (most is not None and value > most):
        told = "on" if most is None else f"to {most}"
        raise BadInput(f"{name} must be a whole number from {least} {told}, not {value!r}")
    return min(int(value), MOST_STEPS)


def flag(value: bool, name: str) -> bool:
    """True or False; raises BadInput for anything else."""
    if not isinstance(value, bool | np.bool_):
        raise BadInput(f"{name} must be True or False, not {value!r:.60}")
    return bool(value)


def step_numbers(index: ArrayLike) -> np.ndarray:
    """Ascending whole numbers from 0 on as int64, (frames,); raises BadInput for anything else."""
    try:
        given = np.asarray(index)
    except ValueError:  # rows of different length
        given = np.empty(0)
    if given.dtype.kind not in "iu" or given.ndim != 1 or not len(given):
        raise BadInput(f"index must be a list of whole numbers, at least one, not {index!r:.60}")
    if int(given[0]) < 0 or int(given.max()) > MOST_STEPS or (given[1:] <= given[:-1]).any():
        raise BadInput("index must ascend from 0 or a later step, to 2^62 at most")
    return given.astype(np.int64)


def seconds(value: Any, positive: bool = True) -> float:
    """A time step in seconds; raises BadInput for what is not one number, or not a positive one."""
    epsilon = value if isinstance(value, float) and -inf < value < inf else numbers(value, "time_step")
    if np.ndim(epsilon) or (positive and not epsilon > 0):
        raise BadInput(f"time_step must be one {'positive ' if positive else ''}number of seconds, not {value!r}")
    return float(epsilon)
