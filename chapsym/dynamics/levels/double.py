"""Runs many steps of one ball or of many: one by one, or in blocks on every core where the loops are compiled."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from .. import native
from ..ball import Floats
from ..coefficients import substeps
from ..errors import Status
from ..failure import explain
from ..loops import block, composed_block, composed_loop, loop, single_step
from ..loops.guess import stage_weights
from .frames import Balls, Count, Frames, cores, share

#: Shorter runs than this are not shared out to cores.
SHORT_RUN = 2000
#: Steps of a ball, or of all balls of a block together, between two calls of `progress`: about ten milliseconds.
CHUNK = 200_000


@dataclass(frozen=True, eq=False)
class Numbers:
    """A type of numbers that the loops are compiled for.

    lanes, register: of a block.  rests: whether the attitude and the contact point carry the rests of their sums, which
    blocks do not.
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
    """Takes `steps` steps of every ball into `frames`; `progress` is called with the steps of all balls together.

    order: of the composition, 2 for the map itself.  threads: how many cores to use; 0 for all that there are.
    of: the numbers of the balls and of the frames.
    """
    count, n, stages = Count(progress), len(balls), substeps(order).astype(of.dtype)
    if steps == 0 or n == 0:
        return
    in_blocks = n > 1 and not (frames.with_body and of.rests) and native.is_compiled()
    starts = range(0, n, of.lanes if in_blocks else 1)

    def task(start: int) -> None:
        if in_blocks:
            _run_block(balls, slice(start, min(n, start + of.lanes)), steps, every, frames, of, stages, count)
        else:
            _run_one(balls, start, steps, every, frames, of, stages, count)

    many = steps * n * len(stages) >= SHORT_RUN
    share(task, starts, min(threads or cores(), len(starts)) if many else 1, count)


def step_all(balls: Balls, of: Numbers = DOUBLE) -> tuple[np.ndarray, ...]:
    """The first step of a run of each ball: (q, 𝒦, γ, status, reach), (n, 4), (n, 3), (n, 3), (n,), (n,).

    q: unit Euler parameters with q0 ≥ 0; q, 𝒦 and γ are NaN where the status is not TAKEN.
    """
    n = len(balls)
    q, status, reach = np.full((n, 4), np.nan, of.dtype), np.zeros(n, np.int64), np.ones(n)
    K, g, J, D = balls.momentum.copy(), balls.gamma.copy(), balls.mass_tensor, balls.D
    of.loop(single_step.advance_all)(K, g, J, D, q, status, reach)
    for i in np.flatnonzero(status):
        status[i] = explained(status[i], K[i], g[i], J[i], D[i])
    K[status != 0], g[status != 0] = np.nan, np.nan
    return q, K, g, status, reach


def of_one(of: Numbers, stages: int) -> tuple[Callable, Callable]:
    """(march, prepare) of one ball."""
    if stages == 1:
        return of.loop(loop.march), of.loop(loop.prepare)
    return of.loop(composed_loop.march_composed), of.loop(composed_loop.prepare_composed)


def _run_one(
    balls: Balls, i: int, steps: int, every: int, frames: Frames, of: Numbers, stages: Floats, count: Count
) -> None:
    march, prepare = of_one(of, len(stages))
    K, g, J, D = balls.momentum[i], balls.gamma[i], balls.mass_tensor[i], balls.D[i]
    state, scale = begun(prepare, K, g, J, D, of, stages)
    attitude, spot = (np.zeros(k * (1 + of.rests), of.dtype) for k in (4, 2))
    if frames.with_body:
        attitude[:4] = frames.attitude[i, 0]
    chunk = max(1, CHUNK // len(stages))
    for first in range(0, steps, chunk):
        now = min(chunk, steps - first)
        went, frames.status[i], frames.reach[i] = march(
            *state, 0, first, now, every, scale, frames.momentum[i], frames.gamma[i],
            frames.with_body, attitude, spot, balls.radius[i], frames.attitude[i], frames.contact[i],
        )  # fmt: skip
        frames.taken[i] += went
        count.add(now)
        if count.stopped:
            return
        if frames.status[i] != Status.TAKEN:
            frames.status[i] = explained(frames.status[i], scale * state[0][:3], state[0][3:6], J, D)
            return


def begun(
    prepare: Callable, K: Floats, g: Floats, J: Floats, D: float, of: Numbers, stages: Floats
) -> tuple[list[Floats], float]:
    """The state that the loop of one ball takes, and the scale with 𝒦 = scale·k."""
    state = np.zeros(loop.ROWS, of.dtype)
    if len(stages) == 1:
        return [state], of.dtype(prepare(K, g, J, D, state))
    bounds, weights = np.zeros((2, len(stages)), of.dtype), _weights(stages, of)
    scale = prepare(K, g, J, D, stages, state, *bounds)
    return [state, stages, weights, *bounds, np.zeros((weights.shape[2], 3), of.dtype)], of.dtype(scale)


def _weights(stages: Floats, of: Numbers) -> Floats:
    """Those of the guesses of a composition, in the type of the loops."""
    return stage_weights(tuple(map(float, stages))).astype(of.dtype)


def explained(status: int, K: Floats, g: Floats, J: Floats, D: float) -> Status:
    """`explain` of a state of any floats."""
    return explain(status, K.astype(np.float64), g.astype(np.float64), J.astype(np.float64), float(D))


def _of_blocks(of: Numbers, stages: int) -> tuple[Callable, Callable]:
    """(march, prepare) of many balls at once."""
    if stages == 1:
        return of.loop(block.march_block), of.loop(block.prepare_block)
    return of.loop(composed_block.march_composed_block), of.loop(composed_block.prepare_composed_block)


def _run_block(
    balls: Balls, which: slice, steps: int, every: int, frames: Frames, of: Numbers, stages: Floats, count: Count
) -> None:
    march, prepare = _of_blocks(of, len(stages))
    n = which.stop - which.start
    lanes = -(-n // of.register) * of.register
    state, scale = np.zeros((loop.ROWS, lanes), of.dtype), np.zeros(n, of.dtype)
    begin = balls.momentum[which], balls.gamma[which], balls.mass_tensor[which], balls.D[which]
    own: tuple[Floats, ...] = ()  # what only a composition has
    if len(stages) == 1:
        prepare(*begin, state, scale)
    else:
        bounds, weights = np.zeros((2, len(stages), lanes), of.dtype), _weights(stages, of)
        prepare(*begin, stages, state, *bounds, scale)
        own = stages, weights, *bounds, np.zeros((3 * weights.shape[2], lanes), of.dtype)
    status, reach, taken = frames.status[which], frames.reach[which], frames.taken[which]
    bodies = _bodies(balls, which, frames, lanes, of)
    chunk = max(1, CHUNK // (lanes * len(stages)))
    for first in range(0, steps, chunk):
        now = min(chunk, steps - first)
        march(
            state, *own, first, now, every, scale, frames.momentum[which], frames.gamma[which], taken, status, reach,
            *bodies,
        )  # fmt: skip
        count.add(now * n)
        if count.stopped:
            return
    for lane in map(int, np.flatnonzero(status)):
        i = which.start + lane
        K, g = scale[lane] * state[:3, lane], state[3:6, lane]
        status[lane] = explained(status[lane], K, g, balls.mass_tensor[i], balls.D[i])


def _bodies(balls: Balls, which: slice, frames: Frames, lanes: int, of: Numbers) -> tuple[Any, ...]:
    """What a block takes to follow its bodies: whether it does, where they are, and their frames."""
    body = np.zeros((7, lanes), of.dtype)
    if frames.with_body:
        balls_of = np.minimum(np.arange(which.start, which.start + lanes), which.stop - 1)
        body[:4], body[6] = frames.attitude[balls_of, 0].T, balls.radius[balls_of]
    return frames.with_body, body, frames.attitude[which], frames.contact[which]
