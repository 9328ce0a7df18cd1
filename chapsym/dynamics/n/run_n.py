"""Runs in n dimensions: below the bound of `near_n` from guesses by the last rotations, else by the continuation."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import Digits, Double, Precision

from ..ball import Floats, common_shape, is_followed, unit_vertical
from ..coefficients import COMPOSITIONS, substeps
from ..errors import BadInput
from ..levels.dispatch import precision_of
from ..trajectories import rolling_radius
from . import warm_n
from .ball_n import BallN, initial_attitudes, skew_matrices
from .near_n import limits
from .steps_n import continued, some_balls

#: The Jacobians of the balls that are solved together take about this many numbers: what a cache holds.
BLOCK = 2**15
#: What moves, of which frames may be kept.
MOVING = ("momentum", "gamma", "attitude", "contact")


def start(
    ball: BallN, momentum: ArrayLike, gamma: ArrayLike, attitude: bool | ArrayLike = False, contact: bool = False
) -> tuple[tuple[int, ...], dict[str, Floats]]:
    """The common leading shape, and the state that `run` takes, arrays to read, checked; raises BadInput."""
    if not isinstance(ball, BallN):
        raise BadInput(f"ball must be a chapsym.BallN, not {type(ball).__name__}")
    K, g = skew_matrices(momentum, ball.n), unit_vertical(gamma, ball.n)
    radius = () if ball.radius is None else ball.radius.shape
    leading = [ball.mass_tensor.shape[:-1], ball.D.shape, radius, K.shape[:-2], g.shape[:-1]]
    shape = common_shape(leading, "ball (mass_tensor, D, radius), momentum and gamma")
    given = {"momentum": (K, 2), "gamma": (g, 1), "mass_tensor": (ball.mass_tensor, 1), "D": (ball.D, 0)}
    if contact:
        given["radius"] = rolling_radius(ball), 0
    count, state = int(np.prod(shape, dtype=np.int64)), {}
    for name, (x, axes) in given.items():
        own = x.shape[x.ndim - axes :]
        state[name] = np.broadcast_to(x, (*shape, *own)).reshape(count, *own)
    if contact or is_followed(attitude):
        state["attitude"] = initial_attitudes(attitude, state["gamma"], shape)
    if contact:
        state["contact"] = np.zeros((count, ball.n - 1))
    return shape, state


def rows(state: dict[str, Floats], count: int, dtype: np.dtype) -> dict[str, Floats]:
    """Room for so many frames of what moves of each ball, (b, count, ...); raises BadInput if there is not so much."""
    try:
        return {
            name: np.full((len(x), count, *x.shape[1:]), np.nan, dtype) for name, x in state.items() if name in MOVING
        }
    except (MemoryError, ValueError):
        balls = len(state["gamma"])
        raise BadInput(f"{count} frames of {balls} balls do not fit into memory; keep fewer with every=") from None


def stepped(
    precision: str | Precision, state: dict[str, Floats], order: int, steps: int, every: int, threads: int = 1
) -> tuple[dict[str, Floats], np.ndarray, np.ndarray, Floats]:
    """The frames of a run from its start on, (b, frames, ...), and (taken, status, reach), (b,).

    Raises BadInput for a precision that is neither "double" nor Digits, and for frames that do not fit into memory.
    """
    chosen, stages = precision_of(precision), substeps(order)
    if not isinstance(chosen, Double | Digits):
        raise BadInput(f'in n dimensions precision is "double" or chapsym.Digits(N), not {precision!r}')
    frames = rows(state, steps // every + 1, chosen.dtype)
    if isinstance(chosen, Double):
        return frames, *run(state, frames, stages, steps, every, threads)
    from . import precise_n  # mpmath takes 40 ms

    return frames, *precise_n.run(chosen, state, frames, COMPOSITIONS[order].exact, steps, every)


def run(
    state: dict[str, Floats], frames: dict[str, Floats], stages: Floats, steps: int, every: int, threads: int = 1
) -> tuple[np.ndarray, np.ndarray, Floats]:
    """Takes `steps` steps of each ball into the frames from 1 on, of which every `every`-th is kept.

    state: momentum (b, n, n), gamma (b, n), mass_tensor (b, n) and D (b,); to be followed, attitude (b, n, n),
    contact (b, n-1) and radius (b,).  frames: of what moves, (b, frames, ...); the first is written here.
    stages: cᵢ of the composition, (s,).  threads: how many cores compiled steps may use.
    Returns (taken, status, reach), (b,).
    """
    for name, array in frames.items():
        array[:, 0] = state[name]
    balls, n = state["gamma"].shape
    taken, status, reach = np.zeros(balls, dtype=np.int64), np.zeros(balls, dtype=np.int64), np.ones(balls)
    near, enough = limits(state["momentum"], state["mass_tensor"], state["D"], stages)
    below = (near > 0).all(axis=-1)
    known, other = np.flatnonzero(below), np.flatnonzero(~below)
    for at in blocks(known, n):
        bounds = near[at], enough[at]
        warm_n.march(some_balls(state, at), frames, bounds, stages, steps, every, taken, status, reach, at, threads)
    for at in blocks(other, n):
        continued(some_balls(state, at), frames, stages, steps, every, taken, status, reach, at)
    return taken, status, reach


def blocks(balls: np.ndarray, n: int) -> Iterator[np.ndarray]:
    """The numbers of the balls of a batch, of those together that are solved together."""
    size = max(1, BLOCK // (n * n * n * (n - 1) // 2))
    return (balls[first : first + size] for first in range(0, len(balls), size))
