"""A run on any rung of the precision ladder: who takes the steps, and the arrays that they fill."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from chapsym.numbers import NAMED, Ball, Digits, Quad, Rung, Single
from chapsym.numbers import rung as named

from ..ball import Floats
from ..coefficients import substeps
from ..errors import BadInput, Status, StepNotTaken
from ..loops import quad_step
from ..map import LowStep, Step
from . import double, quad, single
from .double import Balls, Frames


def rung_of(precision: str | Rung) -> Rung:
    """The rung that a user named; raises BadInput for what is none."""
    try:
        return named(precision)
    except ValueError as error:
        raise BadInput(str(error)) from None


def frames_for(rung: Rung, balls: int, frames: int, body_frames: int, least: bool = False) -> Frames:
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
    return Frames(momenta, verticals, attitudes, traces, taken, status, reach, body_frames > 0, low, least)


def run(
    rung: Rung, balls: Balls, steps: int, every: int, frames: Frames, order: int, threads: int,
    progress: Callable[[int], None],
) -> None:  # fmt: skip
    """`engine.run` on a rung.  Frame 0 is given in float64; other rungs write it anew, γ divided by its length."""
    substeps(order)  # raises BadInput for no order
    if isinstance(rung, Single):
        single.run(balls, steps, every, frames, order, threads, progress)
        return
    if isinstance(rung, Quad):
        quad.run(balls, steps, every, frames, order, threads, progress)
        return
    if isinstance(rung, Digits | Ball):
        from . import high

        high.run(rung, balls, steps, every, frames, order, progress)
        return
    double.run(balls, steps, every, frames, order, threads, progress)


def step(rung: Rung, shape: tuple[int, ...], K: Floats, g: Floats, J: Floats, D: Floats) -> Step:
    """`map.step` on a rung, for flat arrays of balls and the leading axes `shape` of the result.

    One step of a run, with an attitude that starts as the identity, and so ends as the rotation; float32 has its own.
    """
    if isinstance(rung, Single):
        q, moved, vertical, status, reach = single.step_all(K, g, J, D)
        if not shape and status[0] != Status.TAKEN:
            raise StepNotTaken(Status(int(status[0])), float(reach[0]))
        q, moved, vertical = (x.reshape(*shape, x.shape[-1]) for x in (q, moved, vertical))
        return Step(q, moved, vertical, status.reshape(shape), reach.reshape(shape), rung)
    n = len(D)
    beyond = np.array([quad_step.scales(*ball)[1] for ball in zip(K, J, D, strict=True)], dtype=np.int64)
    frames = frames_for(rung, n, 2, 2)
    frames.momentum[:, 0], frames.gamma[:, 0], frames.attitude[:, 0], frames.contact[:, 0] = K, g, [1.0, 0, 0, 0], 0.0
    fine = rung
    if isinstance(rung, Ball) and n:  # an attitude has its digits beside 1; a small rotation needs more
        fine = replace(rung, bits=rung.bits + 200 + int(beyond.max()))
    run(fine, Balls(K, g, J, D, np.zeros(n)), 1, 1, frames, 2, 1, lambda done: None)
    if frames.low is not None:  # where momenta are tiny, they were taken 2^beyond times as large
        for of in (frames, frames.low):
            of.attitude[:, 1, 1:] = np.ldexp(of.attitude[:, 1, 1:], -beyond[:, np.newaxis])
    if not shape and frames.status[0] != Status.TAKEN:
        raise StepNotTaken(Status(int(frames.status[0])), float(frames.reach[0]))
    low = frames.low

    def after(of: Frames) -> list[np.ndarray]:
        return [x[:, 1].reshape(*shape, x.shape[-1]) for x in (of.attitude, of.momentum, of.gamma)]

    rotation, momentum, gamma = after(frames)
    rest = None if low is None else LowStep(*after(low))
    status, reach = frames.status.reshape(shape), frames.reach.reshape(shape)
    return Step(rotation, momentum, gamma, status, reach, rung, rest)
