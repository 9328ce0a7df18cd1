"""Runs in float64 and float32: one ball after the other, or in blocks if compiled; long runs on every core.

float32: state, sums and rotations have that type; each register holds twice as many balls.  As in float64, 𝒦, γ, the
attitude and the contact point have compensated sums, and the integrals are restored.  Two things stay in float64: the
continuation of a step that neither `small-branch` nor `straight-path` proves, whose result is rounded, and the reason
why a step has no rotation.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

import chapsym.dynamics.native as native

from ..ball import Floats, largest_moment
from ..coefficients import substeps
from ..errors import BadInput, Status, explain
from ..loops import block, gibbs, loop, records
from ..loops.guess import stage_weights
from ..loops.records import Moving, Stages, Steps
from .frames import Balls, Count, Frames, cores, parts, share

#: The fewest steps that are worth threads: a few milliseconds.
SHORT_RUN = 50_000
#: Steps of a ball, or of all balls of a block together, between calls of `progress`: about ten milliseconds.
CHUNK = 200_000


@dataclass(frozen=True, eq=False)
class Numbers:
    """A type of numbers for which the loops are compiled.

    lanes, register: of a block.  rests: whether attitude and contact point have compensated sums; blocks have none.
    """

    dtype: Any
    lanes: int
    register: int
    rests: bool

    def loop(self, function: Callable[..., Any]) -> Callable[..., Any]:
        """A function of the loops for these numbers."""
        return native.loop(function, self.dtype)


DOUBLE = Numbers(np.float64, block.LANES, block.REGISTER, False)
SINGLE = Numbers(np.float32, block.SINGLE["LANES"], block.SINGLE["REGISTER"], True)


def run(
    balls: Balls, steps: int, every: int, frames: Frames, order: int, threads: int, progress: Callable[[int], None],
    of: Numbers = DOUBLE,
) -> None:  # fmt: skip
    """Takes `steps` steps of every ball into `frames`; `progress` gets the steps of all balls together.

    order: of the composition, 2 for the map itself.  threads: the number of cores; 0 for all.
    of: the numbers of the balls and of the frames.
    """
    count, n, stages = Count(progress), len(balls.D), staged(order, of)
    if steps == 0 or n == 0:
        return
    workers = threads or cores() if steps * n * len(stages.c) >= SHORT_RUN else 1
    task, width = _run_one, 1
    if n > 1 and not (frames.with_body and of.rests) and native.is_compiled():
        # Several blocks in one call if they take all their steps in it; each core gets four calls or more.
        calls = 4 * workers if workers > 1 else 1
        at_once = max(1, min(CHUNK // (of.lanes * len(stages.c) * steps), -(-n // (of.lanes * calls))))
        task, width = _run_blocks, of.lanes * at_once

    def some(start: int) -> None:
        task(balls, slice(start, min(n, start + width)), Steps(0, steps, every), frames, of, stages, count)

    starts = range(0, n, width)
    share(some, starts, min(workers, len(starts)), count)


def step_all(balls: Balls, of: Numbers = DOUBLE) -> tuple[np.ndarray, ...]:
    """The first step of a run of each ball: (q, 𝒦, γ, status, reach), q0 ≥ 0, NaN where the status is not TAKEN."""
    n = len(balls.D)
    q, status, reach = np.full((n, 4), np.nan, of.dtype), np.zeros(n, np.int64), np.ones(n)
    K, g, J, D = balls.momentum.copy(), balls.gamma.copy(), balls.mass_tensor, balls.D
    advance = of.loop(block.advance_blocks if n > 1 and native.is_compiled() else loop.advance_all)

    def some(start: int) -> None:
        which = slice(start, start + CHUNK // 16)
        advance(K[which], g[which], J[which], D[which], q[which], status[which], reach[which])

    starts = range(0, n, CHUNK // 16)
    share(some, starts, min(cores(), len(starts)) if n >= SHORT_RUN else 1, Count(lambda done: None))
    for i in np.flatnonzero(status):
        status[i] = explained(status[i], K[i], g[i], J[i], D[i])
    K[status != 0], g[status != 0] = np.nan, np.nan
    return q, K, g, status, reach


def _run_one(
    balls: Balls, which: slice, steps: Steps, frames: Frames, of: Numbers, stages: Stages, count: Count
) -> None:
    i, march = which.start, of.loop(loop.march)
    K, g, J, D = balls.momentum[i], balls.gamma[i], balls.mass_tensor[i], balls.D[i]
    state, scale = begun(K, g, J, D, of, stages)
    attitude, spot = (np.zeros(k * (1 + of.rests), of.dtype) for k in (4, 2))
    if frames.with_body:
        attitude[:4] = frames.attitude[i, 0]
    ball, track = Moving(*state, attitude, spot, balls.radius[i]), frames.of(i)
    for some in parts(steps, CHUNK // len(stages.c)):
        went, frames.status[i], frames.reach[i] = march(ball, stages, some, 0, scale, track)
        frames.taken[i] += went
        count.add(some.last - some.first)
        if count.stopped:
            return
        if frames.status[i] != Status.TAKEN:
            frames.status[i] = explained(frames.status[i], scale * ball.state[:3], ball.state[3:6], J, D)
            return


def begun(
    K: Floats, g: Floats, J: Floats, D: float, of: Numbers, stages: Stages
) -> tuple[tuple[Floats, Floats, Floats], float]:
    """The state, the limits and the past of a ball that begins to move, and the scale with 𝒦 = scale·k."""
    state, limits = np.zeros(loop.ROWS, of.dtype), np.zeros((2, len(stages.c)), of.dtype)
    scale = of.loop(loop.prepare)(K, g, J, D, stages.c, state, limits)
    _, places, vectors = stages.weights.shape
    past = np.zeros((places + max(places, vectors), 3), of.dtype)
    return (state, limits, past), of.dtype(scale)


def staged(order: int, of: Numbers) -> Stages:
    """The stages of a composition, in the type of the loops."""
    c = substeps(order).astype(of.dtype)
    return Stages(c, stage_weights(tuple(c.tolist())).astype(of.dtype, copy=False))


def explained(status: int, K: Floats, g: Floats, J: Floats, D: float) -> Status:
    """`explain` of a state of any floats."""
    return explain(status, K.astype(np.float64), g.astype(np.float64), J.astype(np.float64), float(D))


def _run_blocks(
    balls: Balls, which: slice, steps: Steps, frames: Frames, of: Numbers, stages: Stages, count: Count
) -> None:
    n, c = which.stop - which.start, stages.c
    lanes = min(of.lanes, -(-n // of.register) * of.register)
    state, past = np.zeros((loop.ROWS, lanes), of.dtype), np.empty((3 * stages.weights.shape[1], lanes), of.dtype)
    radius, enough = np.empty((2, len(c), lanes), of.dtype)
    kept = block.Block(state, radius, enough, past, np.empty((7, lanes), of.dtype), np.empty(n, of.dtype))
    start = records.Start(*(x[which] for x in (balls.momentum, balls.gamma, balls.mass_tensor, balls.D)))
    some, ends, ended = frames.some(which), frames.ends(which), np.empty((n, 6), of.dtype)
    march, rho, status = of.loop(block.march_blocks), np.ascontiguousarray(balls.radius[which]), ends.status
    for part in parts(steps, CHUNK // (n * len(c))):
        march(kept, stages, part, start, rho, some, ends, ended)
        count.add(n * (part.last - part.first))
        if count.stopped:
            return
        if status.all():  # all balls have stopped
            break
    for i in map(int, np.flatnonzero(status)):
        ball = which.start + i
        status[i] = explained(status[i], ended[i, :3], ended[i, 3:], balls.mass_tensor[ball], balls.D[ball])


#: The exponents of accepted numbers: float32 has 2^-126 to 2^128, and the scaled numbers of a step need a margin.
RANGE = 2.0**-120, 2.0**120
#: The least momentum for Λmax = 1: a smaller rotation is lost in the compensated sums of 𝒦 and γ.
SLOWEST = gibbs.SINGLE["SMALLEST"]


def run_single(
    balls: Balls, steps: int, every: int, frames: Frames, order: int, threads: int, progress: Callable[[int], None]
) -> None:
    """`run` in float32, from the float64 state in `balls`, rounded, with γ and the attitude divided by their length.

    The contact point is summed in units of the radius.  A ball that turns by less than about 2^-36 per step, whose
    checks would underflow, takes each step by the continuation, with the same accuracy.  Raises BadInput for momenta,
    moments of inertia or a path beyond the range of float32, and for a momentum so small that the ball would not move.
    """
    in_single = rounded(balls)
    slowest = SLOWEST * largest_moment(balls.mass_tensor, balls.D)
    slow = balls.momentum.any(axis=1) & (np.abs(balls.momentum).max(axis=1) < slowest)
    if steps > 1 and slow.any():
        first = ", ".join(f"{x:g}" for x in balls.momentum[slow][0])
        raise BadInput(
            f"the momentum ({first}) turns the ball by less than 2^-48 a step, and in float32 it "
            'would stand still; take a longer time step, or precision="double"'
        )
    frames.momentum[:, 0], frames.gamma[:, 0] = in_single.momentum, in_single.gamma
    if frames.with_body:
        frames.attitude[:, 0] = unit(frames.attitude[:, 0])
    with np.errstate(under="ignore", over="ignore"):  # an overflow is refused
        run(in_single, steps, every, frames, order, threads, progress, SINGLE)
        traces = frames.contact
        traces *= balls.radius.astype(np.float32)[:, np.newaxis, np.newaxis]
    if np.isinf(traces).any():
        raise BadInput('the contact point leaves the range of float32, 3.4e38 metres; use precision="double"')


@np.errstate(over="ignore", under="ignore")  # which is refused
def rounded(balls: Balls) -> Balls:
    """The balls in float32, γ divided by its length, with the radius 1; raises BadInput beyond the range of float32."""
    largest = largest_moment(balls.mass_tensor, balls.D)
    for name, size in (("momentum", np.abs(balls.momentum).max(axis=1)), ("moment of inertia", largest)):
        outside = (size > 0.0) & ~((size >= RANGE[0]) & (size <= RANGE[1]))
        if outside.any():
            raise BadInput(
                f"a {name} of {size[outside][0]:g} is beyond what float32 can step with, 1e-36 to 1e36; "
                'take other units, or precision="double"'
            )
    K, J, D = (x.astype(np.float32) for x in (balls.momentum, balls.mass_tensor, balls.D))
    parts: tuple[Any, ...] = (K, unit(balls.gamma), J, D, np.ones(len(D), np.float32))
    return Balls(*parts)


def unit(vectors: Floats) -> np.ndarray:
    """Vectors divided by their length, rounded to float32."""
    wide = vectors.astype(np.float64)
    return (wide / np.linalg.norm(wide, axis=-1, keepdims=True)).astype(np.float32)
