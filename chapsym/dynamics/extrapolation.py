"""The continuous ball to high order: the rotation of a long step, extrapolated from the map with shorter steps.

The map is self-adjoint, so the rotation that n steps of length h/n make together is an even power series in h/n.
Its quaternions for c values of n, with the weights n²/(n² - m²) multiplied over the other m, leave an error of order
h^(2c+1).  K and γ are then turned by *one* rotation: ⟨K,γ⟩, |K|² and |γ|² are kept to rounding, at every order.
A step is no longer exactly self-adjoint, as compositions are, nor is the measure kept: both to the order h^(2c+1).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from math import frexp, ldexp, prod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from .attitudes import initial_attitude, is_followed
from .axes import in_given_axes
from .ball import Asked, Ball, Floats, batch, numbers, unit_vertical
from .errors import BadInput, Status, StepNotTaken
from .levels.double import chosen, compiles
from .loops import loop
from .loops.lanes import MOST_COLUMNS, long_steps_in_lanes
from .loops.long_step import FIRST, long_steps
from .trajectories import whole_number

#: Longer steps than 2^LONGEST, in units where the momentum and the ball are about 1, have no rotation anyway.
LONGEST = 100


@dataclass(frozen=True, eq=False)
class Extrapolated:
    """States of the continuous ball after a number of equal times, for one ball or a batch (...).

    angular_momentum: K in kg m²/s, shape (..., 3); gamma: the vertical upwards, (..., 3).
    attitude: unit quaternions, body to space, scalar first, (..., 4), or None.
    doubt: the sum over the steps of the angle between the rotation and the one with a column less, in radians,
    (...): an estimate of the error that one column less would have made, so a large one of the error.
    status: a `Status` for each ball, (...); where it is not TAKEN the numbers above are NaN.
    """

    angular_momentum: Floats
    gamma: Floats
    attitude: Asked
    doubt: Floats
    status: np.ndarray


@cache
def weights(columns: int) -> tuple[Fraction, ...]:
    """The exact weights of the columns n = 2, ..., columns + 1: Σ w = 1 and Σ w/n^(2j) = 0 for 0 < j < columns."""
    every = range(FIRST, FIRST + columns)
    return tuple(prod((Fraction(n * n, n * n - m * m) for m in every if m != n), start=Fraction(1)) for n in every)


@in_given_axes
@np.errstate(all="ignore")  # as compiled: `status` tells
def extrapolate(
    ball: Ball,
    angular_momentum: ArrayLike,
    gamma: ArrayLike,
    time_step: float,
    steps: int,
    *,
    columns: int = 6,
    attitude: bool | ArrayLike = False,
) -> Extrapolated:
    """Follows the continuous ball (2.12, 2.13) for `steps` times `time_step`, to the order 2 `columns`.

    angular_momentum: K in kg m²/s, shape (..., 3); gamma: unit verticals upwards, (..., 3).  Both broadcast with
    each other and with the balls.  time_step: seconds, negative for back in time.
    columns: 2 to 6.  A step is columns(columns + 3)/2 steps of the map; its error is of the order
    time_step^(2 columns), ⟨K,γ⟩, |K|² and |γ|² are kept to rounding.
    attitude: True (from the least rotation with R γ = e₃) or unit quaternions, (..., 4), to be followed.

    A ball in a batch may differ from the same ball alone by roundings: short runs take another loop.
    One ball raises StepNotTaken where the map has no step of length time_step/n; a batch reports `status`.
    Raises BadInput as `step` does, for a time_step that is not one finite number, and for counts out of range.
    """
    steps, columns = whole_number(steps, "steps", 0), whole_number(columns, "columns", 2, MOST_COLUMNS)
    h = numbers(time_step, "time_step")
    if h.ndim:
        raise BadInput(f"time_step must be one number of seconds, not {time_step!r}")
    shape, (K, g, J, D) = batch(ball, numbers(angular_momentum, "angular_momentum", 3), unit_vertical(gamma))
    followed = is_followed(attitude)
    attitudes = np.tile([1.0, 0.0, 0.0, 0.0], (len(D), 1))
    if followed:
        attitudes[:] = np.broadcast_to(initial_attitude(attitude, g.reshape(*shape, 3)), (*shape, 4)).reshape(-1, 4)
    march = _march(columns, steps * len(D) * columns * (columns + 3) // 2)
    doubt, status = np.zeros(len(D)), np.zeros(len(D), dtype=np.int64)
    for i in range(len(D)):
        state, half, exponent = _scaled(K[i], J[i], float(D[i]), float(h))
        taken, status[i], reach, doubt[i] = march(K[i], g[i], attitudes[i], half, state, steps)
        K[i] = np.ldexp(K[i], exponent)
        if status[i] != Status.TAKEN:
            if not shape:
                raise StepNotTaken(Status(int(status[i])), reach, taken)
            K[i], g[i], attitudes[i], doubt[i] = np.nan, np.nan, np.nan, np.nan
    return Extrapolated(
        K.reshape(*shape, 3), g.reshape(*shape, 3), attitudes.reshape(*shape, 4) if followed else None,
        doubt.reshape(shape), status.reshape(shape),
    )  # fmt: skip


def _march(columns: int, work: int) -> Callable[..., Any]:
    """What takes the long steps: (K, g, attitude, half, state, steps) -> (taken, status, reach, doubt)."""
    full = np.array(weights(columns), dtype=float)
    short = np.array([*weights(columns - 1), 0], dtype=float)
    if not compiles(long_steps_in_lanes, work):
        return lambda K, g, a, half, state, steps: long_steps(K, g, a, half, full, short, state, steps)
    from .loops.guess import guess_weights

    (lanes,), guesses = chosen((long_steps_in_lanes,), work), guess_weights(columns)
    return lambda K, g, a, half, state, steps: lanes(K, g, a, half, full, short, *guesses, state, steps)


def _scaled(K: Floats, J: Floats, D: float, h: float) -> tuple[Floats, float, int]:
    """Scales K by a power of two in place, exactly, so that it is about 1, and the ball likewise.

    Returns (state, half, exponent): the state with J, I and D, half a long step in these units, and K's exponent.
    """
    state = np.empty(loop.ROWS)
    _, size = frexp(loop.scaled((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), J, D, state))
    _, exponent = frexp(float(np.abs(K).max()))
    K[:] = np.ldexp(K, -exponent)
    mantissa, shift = frexp(0.5 * h)
    return state, ldexp(mantissa, min(shift + exponent - (size - 2), LONGEST)), exponent
