"""Many balls at once by compositions, in blocks of lanes: what `composed_loop` does to each, with its roundings."""

import numpy as np

from .block import LANES, carry, keep, mend, restored, rolled, solved, turn_at, uncertified, whole
from .composed_loop import place, prepare_composed
from .integrals import PERIOD
from .loop import ENOUGH, RADIUS, ROWS, A, G, K, X
from .text import Cube, Doubles, Integers, Matrix, Vector, lanes

#: In place of a radius²: the ball has stopped.
STOPPED = -3.0


def guess_block(T, past, weights, ok):
    """`composed_loop.guess` of every lane, from the rows of past (3 vectors, lanes); four vectors are read at once."""
    for i in lanes(whole(ok)):
        T[A, i], T[A + 1, i], T[A + 2, i] = 0.0, 0.0, 0.0
    for j in range(0, len(weights), 4):
        a, b, c, d = weights[j], weights[j + 1], weights[j + 2], weights[j + 3]
        x, y, z = 3 * j, 3 * j + 1, 3 * j + 2
        for i in lanes(whole(ok)):
            u1, u2, u3 = T[A, i] + a * past[x, i], T[A + 1, i] + a * past[y, i], T[A + 2, i] + a * past[z, i]
            u1, u2, u3 = u1 + b * past[x + 3, i], u2 + b * past[y + 3, i], u3 + b * past[z + 3, i]
            u1, u2, u3 = u1 + c * past[x + 6, i], u2 + c * past[y + 6, i], u3 + c * past[z + 6, i]
            u1, u2, u3 = u1 + d * past[x + 9, i], u2 + d * past[y + 9, i], u3 + d * past[z + 9, i]
            T[A, i], T[A + 1, i], T[A + 2, i] = u1, u2, u3


def begin_stage(S, T, s, radius, enough, ok):
    """The ball of a stage with the coefficient s: 𝒦 is s times that of the step."""
    for i in lanes(whole(ok)):
        T[K, i], T[K + 1, i], T[K + 2, i] = s * S[K, i], s * S[K + 1, i], s * S[K + 2, i]
        T[G, i], T[G + 1, i], T[G + 2, i] = S[G, i], S[G + 1, i], S[G + 2, i]
        T[RADIUS, i], T[ENOUGH, i] = radius[i], enough[i]


def end_stage(S, P, past, row, ok):
    """Turns 𝒦 and γ of every lane, and remembers the Gibbs vectors in the rows of past from `row` on."""
    for i in lanes(whole(ok)):
        p0, p1, p2, p3 = P[0, i], P[1, i], P[2, i], P[3, i]
        turn_at(p0, p1, p2, p3, S, K, X, i)
        turn_at(p0, p1, p2, p3, S, G, X + 3, i)
        past[row, i], past[row + 1, i], past[row + 2, i] = P[4, i], P[5, i], P[6, i]


def stop(S, T, radius, status, ok):
    """Rests the lanes that `mend` left with no rotation; a ball that stops keeps the momentum of its stage."""
    for i in range(len(ok)):
        if (i >= len(status) or status[i] != 0) and ok[i] == 0 and radius[0, i] != STOPPED:
            for stage in range(len(radius)):
                radius[stage, i] = STOPPED
            for row in range(K, K + 3):
                S[row, i] = T[row, i]


def prepare_composed_block(
    momentum: Matrix, g: Matrix, tensor: Matrix, contact: Vector, c: Vector, state: Matrix, radius: Matrix,
    enough: Matrix, scale: Vector,
):  # fmt: skip
    """`prepare_composed` of each ball of a block; one that is not full repeats its last ball."""
    one, last = np.empty(ROWS, state.dtype), len(contact) - 1
    bounds = np.empty((2, len(c)), state.dtype)
    for lane in range(state.shape[1]):
        i = min(lane, last)
        scale[i] = prepare_composed(momentum[i], g[i], tensor[i], contact[i], c, one, bounds[0], bounds[1])
        for row in range(ROWS):
            state[row, lane] = one[row]
        for stage in range(len(c)):
            radius[stage, lane], enough[stage, lane] = bounds[0, stage], bounds[1, stage]


def march_composed_block(
    state: Matrix, c: Vector, weights: Cube, radius: Matrix, enough: Matrix, past: Matrix, first: int, count: int,
    every: int, scale: Vector, momenta: Cube, verticals: Cube, taken: Integers, status: Integers, reach: Doubles,
    with_body: bool, body: Matrix, attitudes: Cube, traces: Cube,
):  # fmt: skip
    """`march_block`, each step a composition with the stage coefficients c.

    radius, enough: (s, lanes); weights: as of `composed_loop.composed_step`; past: (3 vectors, lanes).
    """
    S, T = np.empty((ROWS, LANES), state.dtype), np.empty((ROWS, LANES), state.dtype)
    P, B = np.empty((9, LANES), state.dtype), np.empty((7, LANES), state.dtype)
    H = np.empty((len(past), LANES), state.dtype)
    width, stages, balls = state.shape[1], len(c), len(status)
    ok, period = np.empty(width, dtype=np.int32), max(1, PERIOD // stages)
    carry(state, S, width)
    carry(state, T, width)
    carry(body, B, width)
    carry(past, H, width)
    last, patience = first + count, 0
    hopeless, beyond = np.empty(stages, dtype=np.int64), np.empty(stages, dtype=np.int64)
    for s in range(stages):
        hopeless[s], beyond[s] = uncertified(radius[s], ok)
    for step in range(first, last):
        at, later = place(step, stages, weights.shape[1])
        for s in range(stages):
            begin_stage(S, T, c[s], radius[s], enough[s], ok)
            guess_block(T, H, weights[later, at + s], ok)
            patience, bad = solved(T, P, ok, hopeless[s], beyond[s], patience)
            if bad != 0:
                mend(T, P, ok, step, taken, status, reach, balls)
                stop(S, T, radius, status, ok)
                for other in range(stages):
                    hopeless[other], beyond[other] = uncertified(radius[other], ok)
            if with_body:
                rolled(T, P, B, ok)
            end_stage(S, P, H, 3 * (at + s), ok)
        if (step + 1) % period == 0:
            restored(S, status)
        if (step + 1) % every == 0:
            keep(S, B, (step + 1) // every, scale, momenta, verticals, status, with_body, attitudes, traces)
    for i in range(balls):
        if status[i] == 0:
            taken[i] = last
    carry(S, state, width)
    carry(B, body, width)
    carry(H, past, width)
