"""A run on any rung of the precision ladder: who takes the steps, and the arrays that they fill."""

from collections.abc import Callable

import numpy as np

from chapsym.numbers import NAMED, Ball, Digits, Quad, Rung, Single
from chapsym.numbers import rung as named

from . import engine, quad, single
from .engine import Balls, Frames
from .errors import BadInput


def rung_of(precision: str | Rung) -> Rung:
    """The rung that a user named; raises BadInput for what is none."""
    try:
        return named(precision)
    except ValueError as error:
        raise BadInput(str(error)) from None


def frames_for(rung: Rung, balls: int, frames: int, body_frames: int) -> Frames:
    """Empty frames in the numbers of the rung; raises BadInput if they do not fit into memory."""
    objects = isinstance(rung, Digits | Ball)
    dtype = np.dtype(object if objects else np.float32 if isinstance(rung, Single) else np.float64)
    try:
        low = frames_for(NAMED["double"], balls, frames, body_frames) if isinstance(rung, Quad) else None
        momenta, verticals = (np.full((balls, frames, 3), np.nan, dtype) for _ in "Kg")
        attitudes, traces = (np.full((balls, body_frames, n), np.nan, dtype) for n in (4, 2))
    except (MemoryError, ValueError):
        raise BadInput(f"{frames} frames of {balls} balls do not fit into memory; keep fewer with every=") from None
    taken, status, reach = np.zeros(balls, dtype=np.int64), np.zeros(balls, dtype=np.int64), np.ones(balls)
    return Frames(momenta, verticals, attitudes, traces, taken, status, reach, body_frames > 0, low)


def run(
    rung: Rung, balls: Balls, steps: int, every: int, frames: Frames, order: int, threads: int,
    progress: Callable[[int], None],
) -> None:  # fmt: skip
    """`engine.run` on a rung.  Frame 0 is given in float64; other rungs write it anew, γ divided by its length."""
    if isinstance(rung, Single):
        single.run(balls, steps, every, frames, order, threads, progress)
        return
    if isinstance(rung, Quad):
        quad.run(balls, steps, every, frames, order, threads, progress)
        return
    engine.run(balls, steps, every, frames, order, threads, progress)
