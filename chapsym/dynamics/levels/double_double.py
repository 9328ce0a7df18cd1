"""Runs in double-double: one ball at a time, or a batch in blocks; frames are pairs of arrays."""

import math
from collections.abc import Callable
from functools import cache
from itertools import starmap

import numpy as np

import chapsym.dynamics.native as native
from chapsym.numbers import Pair

from ..ball import Floats
from ..coefficients import COMPOSITIONS
from ..errors import Status, explain
from ..loops import double_double as loop
from ..loops import proved as loops_proved
from ..loops.records import Moving, Start, Steps
from . import proved
from .frames import Balls, Count, Frames, cores, parts, share

#: The fewest steps that are worth threads: a few milliseconds.
SHORT_RUN = 20_000
#: Fewer balls than this do not fill a block.
FEW = 4
#: Steps between two calls of `progress`: about ten milliseconds.
CHUNK = 25_000


def run(
    balls: Balls, steps: int, every: int, frames: Frames, order: int, threads: int, progress: Callable[[int], None],
    spread: Floats | None = None,
) -> None:  # fmt: skip
    """`double.run` in double-double.  It rewrites frame 0: γ and the attitude are divided by their lengths.

    spread: (n, frames, 4); `loops.proved` writes bounds of the distance of the exact orbit there.
    """
    stages = coefficients(order)
    count, n = Count(progress), len(balls.D)
    work = steps * n * len(stages)
    in_blocks = n >= FEW and not frames.with_body and order == 2 and native.is_compiled() and spread is None
    width = loop.LANES if in_blocks else 1
    starts = range(0, n, width)

    def task(start: int) -> None:
        if in_blocks:
            _run_block(balls, slice(start, min(n, start + width)), Steps(0, steps, every), frames, stages, count)
        else:
            kept = np.empty((0, 4)) if spread is None else spread[start]
            _run_one(balls, start, Steps(0, steps, every), frames, stages, count, kept)

    share(task, starts, min(threads or cores(), len(starts)) if work >= SHORT_RUN else 1, count)


@cache
def coefficients(order: int) -> Floats:
    """The stage coefficients of the composition of order 2, 4, 6 or 8 as pairs, (stages, 2)."""
    found = np.array([Pair.of(c).halves() for c in COMPOSITIONS[int(order)].exact])
    found.flags.writeable = False
    return found


def normalised(vector: Floats) -> list[Pair]:
    """A float64 vector divided by its length."""
    x = [Pair(float(v)) for v in vector]
    length = sum((v * v for v in x), Pair(0.0)).sqrt()
    return [v / length for v in x]


def least_rotation(x: Pair, y: Pair, z: Pair) -> list[Pair]:
    """`attitude_with` in pairs: the attitude of the least rotation for which the unit vector is vertical."""
    if z > 0:
        p0 = 1 + z
    else:  # 1 + z cancels, so x² + y² = (1 - z)(1 + z); scaled, as that may underflow
        size = math.frexp(max(abs(x.high), abs(y.high)))[1]
        x, y = (Pair(math.ldexp(v.high, -size), math.ldexp(v.low, -size)) for v in (x, y))
        p0 = (x * x + y * y) / (1 - z) * math.ldexp(1.0, size)
    length = (p0 * p0 + x * x + y * y).sqrt()
    return [p0 / length, y / length, -x / length, Pair(0.0)] if length > 0 else list(map(Pair, (0.0, 1.0, 0.0, 0.0)))


@np.errstate(all="ignore")  # of a momentum whose squares overflow: the march refuses it
def _add(rest: Floats, state: Floats, shift: int) -> None:
    """Adds the low half of 𝒦 to the start, and its integrals, to which the state is restored."""
    state[1:6:2] = np.ldexp(rest, shift)
    loop.remember_pairs(state)


def _begin(frames: Frames, i: int, gamma: Floats, rest: Floats | None) -> Floats:
    """Writes frame 0 of a ball with the vertical in pairs, (3, 2); returns the attitude, (4, 2), if it is followed."""
    low, attitude = frames.halves, np.zeros((4, 2))
    frames.gamma[i, 0], low.gamma[i, 0] = gamma.T
    low.momentum[i, 0] = 0.0 if rest is None else rest[i]
    if frames.with_body:
        first = least_rotation(*starmap(Pair, gamma)) if frames.least else normalised(frames.attitude[i, 0])
        attitude[:] = [x.halves() for x in first]
        frames.attitude[i, 0], low.attitude[i, 0] = attitude.T
        low.contact[i, 0] = 0.0
    return attitude


class OneBall:
    """One ball in progress in double-double, with or without proved bounds of the distance of the exact orbit.

    frames: the first one is written; `take` writes its steps into them.
    """

    def __init__(self, balls: Balls, i: int, frames: Frames, stages: Floats, proves: bool = False) -> None:
        self._march, self._stages = native.loop(loop.march_pairs), stages
        K, g, J, D = balls.momentum[i], balls.gamma[i], balls.mass_tensor[i], float(balls.D[i])
        state, limits, past = np.zeros(loop.ROWS), np.zeros((2, len(stages))), np.zeros((8 * len(stages), 3))
        self.scales = self.shift, beyond = native.loop(loop.prepare_pairs)(K, g, J, D, stages, state, limits)
        if balls.rest is not None:
            _add(balls.rest[i], state, self.shift)
        attitude = _begin(frames, i, state[loop.G : loop.I].reshape(3, 2), balls.rest).reshape(-1)
        self.moving = Moving(state, limits, past, attitude, np.zeros(4), float(balls.radius[i]))
        self._tracks = frames.of(i), frames.halves.of(i)
        self._proof = proved.begun(state, stages, beyond) if proves else (np.empty((0, 2)), np.empty(0))

    def lose(self) -> None:
        """Gives up the proof from this step on."""
        self._proof[1][loops_proved.BALL] = np.inf

    def take(self, steps: Steps, spread: Floats) -> tuple[int, int, float]:
        """Takes steps, and keeps the states and their spread."""
        proof = loop.Proof(*self._proof, spread)
        return self._march(self.moving, self._stages, steps, *self.scales, *self._tracks, proof)


def _run_one(balls: Balls, i: int, steps: Steps, frames: Frames, stages: Floats, count: Count, spread: Floats) -> None:
    ball = OneBall(balls, i, frames, stages, len(spread) > 0)
    for part in parts(steps, CHUNK // len(stages)):
        went, frames.status[i], frames.reach[i] = ball.take(part, spread)
        frames.taken[i] += went
        count.add(part.last - part.first)
        if count.stopped:
            return
        if frames.status[i] != Status.TAKEN:
            K, g = np.ldexp(ball.moving.state[:6:2], -ball.shift), ball.moving.state[6:12:2]
            frames.status[i] = explain(frames.status[i], K, g, balls.mass_tensor[i], float(balls.D[i]))
            return


def _run_block(balls: Balls, which: slice, steps: Steps, frames: Frames, stages: Floats, count: Count) -> None:
    march, prepare = native.loop(loop.march_pairs_block), native.loop(loop.prepare_pairs_block)
    n = which.stop - which.start
    state = np.zeros((loop.ALL_ROWS, loop.LANES))
    shift, beyond = np.zeros(n, dtype=np.int64), np.zeros(n, dtype=np.int64)
    start = Start(*(x[which] for x in (balls.momentum, balls.gamma, balls.mass_tensor, balls.D)))
    prepare(start, stages, state, shift, beyond)
    if balls.rest is not None:
        for lane in range(n):
            _add(balls.rest[which.start + lane], state[:, lane], int(shift[lane]))
    some, low, ends = frames.some(which), frames.halves.some(which), frames.ends(which)
    status, gamma = ends.status, state[loop.G : loop.I, :n].T
    some.verticals[:, 0], low.verticals[:, 0] = gamma[:, ::2], gamma[:, 1::2]
    low.momenta[:, 0] = 0.0 if balls.rest is None else balls.rest[which]
    for part in parts(steps, CHUNK // loop.LANES):
        march(state, part, shift, some, low, ends)
        count.add(n * (part.last - part.first))
        if count.stopped:
            return
        if status.all():  # all balls have stopped
            break
    for lane in map(int, np.flatnonzero(status)):
        i = which.start + lane
        K, g = np.ldexp(state[:6:2, lane], -int(shift[lane])), state[6:12:2, lane]
        status[lane] = explain(status[lane], K, g, balls.mass_tensor[i], float(balls.D[i]))


def run_long(
    balls: Balls, h: Pair, steps: int, every: int, frames: Frames, weights: Floats, threads: int,
    progress: Callable[[int], None],
) -> Floats:  # fmt: skip
    """Long steps of h seconds from K; frame 0 is rewritten as by `run`; returns the sum of the doubts, (n,)."""
    doubt, count = np.zeros(len(balls.D)), Count(progress)
    march = native.loop(loop.march_long_pairs)

    def task(i: int) -> None:
        g, body = normalised(balls.gamma[i]), np.zeros((6, 2))
        body[:4] = _begin(frames, i, np.array([x.halves() for x in g]), None)
        if not frames.with_body:
            body[:4] = [x.halves() for x in least_rotation(*g)]
        start = balls.momentum[i], balls.gamma[i], body[:4].reshape(-1).copy(), balls.mass_tensor[i]
        ball = loop.Still(*start, float(balls.D[i]), float(balls.radius[i]))
        tracks = frames.of(i), frames.halves.of(i)
        for part in parts(Steps(0, steps, every), CHUNK // (len(weights) * loop.FIRST * 4)):
            ends = march(ball, *h.halves(), weights, part, body.reshape(-1), *tracks)
            went, frames.status[i], frames.reach[i], more = ends
            doubt[i] += more
            frames.taken[i] += went
            count.add(part.last - part.first)
            if frames.status[i] != Status.TAKEN:
                doubt[i] = math.nan
            if count.stopped or frames.status[i] != Status.TAKEN:
                return

    work = steps * len(balls.D) * sum(range(loop.FIRST, loop.FIRST + len(weights)))
    share(task, range(len(balls.D)), threads or cores() if work >= SHORT_RUN else 1, count)
    return doubt
