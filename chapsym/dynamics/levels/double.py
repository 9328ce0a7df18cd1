"""Runs many steps of one ball or of many: in plain Python, compiled, or compiled in blocks on every core."""

import threading
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from typing import Any

import numpy as np

from .. import columns
from ..ball import Floats
from ..coefficients import substeps
from ..errors import Status
from ..failure import explain
from ..loops import block, composed_block, composed_loop, loop, single_step
from ..loops.guess import stage_weights
from .frames import Balls, Count, Frames, cores, share

#: A run of so many steps is worth its loop compiled, and so are shorter runs that have come to as many,
SHORT_RUN = 2000
#: or to so many where it is not kept on disk: they take as long in plain Python as compiling it.
COMPILING = 300_000
#: Stages of compositions that are worth their block compiled, where it is not kept on disk: one by one these take
#: about a second.
BLOCKS = 10_000_000
#: Fewer balls than this are slower by columns than one by one.
FEW = 8
#: Steps of a ball, or of all balls of a block together, between two calls of `progress`: about ten milliseconds.
CHUNK = 200_000
#: The loops that are compiled and loaded already, the steps that others took in plain Python, and the lock of both.
_ready: set[Callable] = set()
_plain: Counter[Callable] = Counter()
_loading = threading.Lock()


@dataclass(frozen=True, eq=False)
class Loops:
    """Compiled loops for one number type."""

    loop: Any = loop
    composed_loop: Any = composed_loop
    block: Any = block
    composed_block: Any = composed_block
    columns: Any = columns
    step: Any = single_step
    number: Callable[[Any], Any] = float
    dtype: Any = np.float64
    #: Whether the attitude and the contact point carry the rests of their sums, which blocks do not.
    rests: bool = False


DOUBLE = Loops()


def run(
    balls: Balls, steps: int, every: int, frames: Frames, order: int, threads: int, progress: Callable[[int], None],
    loops: Loops = DOUBLE,
) -> None:  # fmt: skip
    """Takes `steps` steps of every ball into `frames`; `progress` is called with the steps of all balls together.

    order: of the composition, 2 for the map itself.  threads: how many cores to use; 0 for all that there are.
    loops: whose numbers are those of the balls and of the frames.
    """
    count, n, stages = Count(progress), len(balls), substeps(order).astype(loops.dtype)
    if steps == 0 or n == 0:
        return
    work = steps * n * len(stages)
    in_blocks = n > 1 and not (frames.with_body and loops.rests)
    if in_blocks and has_numba():
        blocks = _of_blocks(loops, len(stages))[0]
        in_blocks = pays(blocks, work) if order == 2 else _is_worth(blocks, work)
    elif in_blocks:
        in_blocks = order == 2 and n >= FEW and work >= SHORT_RUN and not frames.with_body
    if in_blocks:
        functions = _of_blocks(loops, len(stages))
        taken_by = load(functions) if has_numba() else list(functions)
    else:
        taken_by = chosen(of_one(loops, len(stages)), work)
    width = (loops.block.LANES if has_numba() else loops.columns.LANES) if in_blocks else 1
    starts = range(0, n, width)

    def task(start: int) -> None:
        with np.errstate(over="ignore", invalid="ignore"):  # compiled loops do not warn either; `status` tells
            if in_blocks:
                which = slice(start, min(n, start + width))
                _run_block(taken_by, balls, which, steps, every, frames, loops, stages, count)
            else:
                _run_one(taken_by, balls, start, steps, every, frames, loops, stages, count)

    share(task, starts, min(threads or cores(), len(starts)) if work >= SHORT_RUN else 1, count)


def step_all(balls: Balls, loops: Loops = DOUBLE) -> tuple[np.ndarray, ...]:
    """The first step of a run of each ball: (q, 𝒦, γ, status, reach), (n, 4), (n, 3), (n, 3), (n,), (n,).

    q: unit Euler parameters with q0 ≥ 0; q, 𝒦 and γ are NaN where the status is not TAKEN.
    """
    n = len(balls)
    q, status, reach = np.full((n, 4), np.nan, loops.dtype), np.zeros(n, np.int64), np.ones(n)
    K, g, J, D = balls.momentum.copy(), balls.gamma.copy(), balls.mass_tensor, balls.D
    (take,) = chosen((loops.step.advance_all,), n)
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        take(K, g, J, D, q, status, reach)
    for i in np.flatnonzero(status):
        status[i] = explained(status[i], K[i], g[i], J[i], D[i])
    K[status != 0], g[status != 0] = np.nan, np.nan
    return q, K, g, status, reach


def chosen(functions: Sequence[Callable], work: int) -> list[Callable]:
    """The functions compiled if that `pays` the first of them, or as they are."""
    return load(functions) if pays(functions[0], work) else list(functions)


def load(functions: Sequence[Callable]) -> list[Callable]:
    """The functions compiled: loaded from disk, or compiled when they are first called."""
    with _loading:
        _ready.add(functions[0])
        compiled = _compiler()
        return [compiled(function) for function in functions]


@cache
def _compiler() -> Callable[[Callable], Callable]:
    """`compiled`, which loads numba."""
    from .compiled import compiled

    return compiled


def pays(function: Callable, work: int) -> bool:
    """Whether `work` steps, with those that the process has taken in plain Python, are worth the compiled function.

    Where they are not, they count as taken.
    """
    if compiles(function, work) or not has_numba():
        return has_numba()
    with _loading:
        _plain[function] += work
    if _plain[function] < SHORT_RUN:
        return False
    from .compiled import is_kept

    return _plain[function] >= COMPILING or is_kept(function)


def compiles(function: Callable, work: int) -> bool:
    """Whether `work` steps alone are worth the compiled function: many are, and any once it is loaded."""
    return has_numba() and (work >= SHORT_RUN or function in _ready)


def _is_worth(block: Callable, work: int) -> bool:
    """Whether so many stages of compositions are to be taken by their block, rather than one by one."""
    if block in _ready or work < SHORT_RUN or work >= BLOCKS:
        return block in _ready or work >= BLOCKS
    from .compiled import is_kept

    return is_kept(block)


@cache
def has_numba() -> bool:
    """Whether loops can be compiled; without numba a batch runs in NumPy, by columns, and a ball in plain Python."""
    return find_spec("numba") is not None


def _of_blocks(loops: Loops, stages: int) -> tuple[Callable, Callable]:
    """(march, prepare) of many balls at once."""
    if not has_numba():
        return loops.columns.march_columns, loops.columns.prepare_columns
    if stages == 1:
        return loops.block.march_block, loops.block.prepare_block
    return loops.composed_block.march_composed_block, loops.composed_block.prepare_composed_block


def of_one(loops: Loops, stages: int) -> tuple[Callable, Callable]:
    """(march, prepare) of one ball."""
    if stages == 1:
        return loops.loop.march, loops.loop.prepare
    return loops.composed_loop.march_composed, loops.composed_loop.prepare_composed


def _run_one(
    taken_by: list[Callable], balls: Balls, i: int, steps: int, every: int, frames: Frames, loops: Loops,
    stages: Floats, count: Count,
) -> None:  # fmt: skip
    march, prepare = taken_by
    K, g, J, D = balls.momentum[i], balls.gamma[i], balls.mass_tensor[i], loops.number(balls.D[i])
    state, scale = begun(prepare, K, g, J, D, loops, stages)
    attitude, spot = (np.zeros(k * (1 + loops.rests), loops.dtype) for k in (4, 2))
    if frames.with_body:
        attitude[:4] = frames.attitude[i, 0]
    chunk = max(1, CHUNK // len(stages))
    for first in range(0, steps, chunk):
        now = min(chunk, steps - first)
        went, frames.status[i], frames.reach[i] = march(
            *state, 0, first, now, every, scale, frames.momentum[i], frames.gamma[i],
            frames.with_body, attitude, spot, loops.number(balls.radius[i]), frames.attitude[i], frames.contact[i],
        )  # fmt: skip
        frames.taken[i] += went
        count.add(now)
        if count.stopped:
            return
        if frames.status[i] != Status.TAKEN:
            frames.status[i] = explained(frames.status[i], scale * state[0][:3], state[0][3:6], J, D)
            return


def begun(
    prepare: Callable, K: Floats, g: Floats, J: Floats, D: float, loops: Loops, stages: Floats
) -> tuple[list[Floats], float]:
    """The state that the loop of one ball takes, and the scale with 𝒦 = scale·k."""
    state = np.zeros(loop.ROWS, loops.dtype)
    if len(stages) == 1:
        return [state], loops.number(prepare(K, g, J, D, state))
    bounds, weights = np.zeros((2, len(stages)), loops.dtype), _weights(stages, loops)
    scale = prepare(K, g, J, D, stages, state, *bounds)
    return [state, stages, weights, *bounds, np.zeros((weights.shape[2], 3), loops.dtype)], loops.number(scale)


def _weights(stages: Floats, loops: Loops) -> Floats:
    """Those of the guesses of a composition, in the type of the loops."""
    return stage_weights(tuple(map(float, stages))).astype(loops.dtype)


def explained(status: int, K: Floats, g: Floats, J: Floats, D: float) -> Status:
    """`explain` of a state of any floats."""
    return explain(status, K.astype(np.float64), g.astype(np.float64), J.astype(np.float64), float(D))


def _run_block(
    taken_by: list[Callable], balls: Balls, which: slice, steps: int, every: int, frames: Frames, loops: Loops,
    stages: Floats, count: Count,
) -> None:  # fmt: skip
    march, prepare = taken_by
    n = which.stop - which.start
    lanes = -(-n // loops.block.REGISTER) * loops.block.REGISTER if has_numba() else n
    state, scale = np.zeros((loop.ROWS, lanes), loops.dtype), np.zeros(n, loops.dtype)
    begin = balls.momentum[which], balls.gamma[which], balls.mass_tensor[which], balls.D[which]
    own: tuple[Floats, ...] = ()  # what only a composition has
    if len(stages) == 1:
        prepare(*begin, state, scale)
    else:
        bounds, weights = np.zeros((2, len(stages), lanes), loops.dtype), _weights(stages, loops)
        prepare(*begin, stages, state, *bounds, scale)
        own = stages, weights, *bounds, np.zeros((3 * weights.shape[2], lanes), loops.dtype)
    status, reach, taken = frames.status[which], frames.reach[which], frames.taken[which]
    bodies = _bodies(balls, which, frames, lanes, loops) if has_numba() else ()
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


def _bodies(balls: Balls, which: slice, frames: Frames, lanes: int, loops: Loops) -> tuple[Any, ...]:
    """What a block takes to follow its bodies: whether it does, where they are, and their frames."""
    body = np.zeros((7, lanes), loops.dtype)
    if frames.with_body:
        balls_of = np.minimum(np.arange(which.start, which.start + lanes), which.stop - 1)
        body[:4], body[6] = frames.attitude[balls_of, 0].T, balls.radius[balls_of]
    return frames.with_body, body, frames.attitude[which], frames.contact[which]
