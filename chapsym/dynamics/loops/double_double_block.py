"""Many balls at once in double-double: blocks of `LANES` balls, as in `block`.

Each lane has the bits of `double_double_loop.march_pairs` for that ball alone.
"""

import numpy as np

from chapsym.generated.double_double import gibbs_residual_pairs, turn_pairs
from chapsym.numbers.pairs import two_sum

from .block import carry
from .branch import TAKEN
from .double_double_loop import ROWS, D, G, I, K, prepare_pairs, restore_pairs, stage, write
from .double_double_step import correction, small
from .gibbs import Round, newton_round
from .integrals import PERIOD
from .sums import filtered
from .text import Cube, Doubles, Integers, Matrix, Vector, lanes, out_of_line

#: Balls in a block: its rows stay in the first-level cache.
LANES = 16
#: Iterates in float64 that all lanes take together, where one of them wants another.
ROUNDS = 4
#: The filter of the Gibbs vector, radius² and enough follow the rows of the single ball.
A, RADIUS, ENOUGH = ROWS, ROWS + 24, ROWS + 25
ALL_ROWS = ROWS + 26
#: Rows of the work space: w, the last correction d, det and cofactors before it, the residual, the correction e.
W, DELTA, DET, C, R, E = 0, 3, 6, 7, 16, 19
WORK_ROWS = 22


def approached(S, P, ok, again):
    """A Newton iterate in float64 for every lane, from the guess or `again` from itself; how many want another."""
    bad = 0
    for i in lanes(LANES):
        radius = S[RADIUS, i]
        u1, u2, u3 = (P[W, i], P[W + 1, i], P[W + 2, i]) if again else (S[A, i], S[A + 1, i], S[A + 2, i])
        near = u1 * u1 + (u2 * u2 + u3 * u3) <= radius
        u1, u2, u3 = u1 if near else 0.0, u2 if near else 0.0, u3 if near else 0.0
        r = newton_round(
            u1, u2, u3, S[K, i], S[K + 2, i], S[K + 4, i], S[G, i], S[G + 2, i], S[G + 4, i],
            S[I, i], S[I + 2, i], S[I + 4, i], S[D, i],
        )  # fmt: skip
        done = again & (ok[i] == 1)
        for row, x in (
            (W, r.w1), (W + 1, r.w2), (W + 2, r.w3), (DELTA, r.d1), (DELTA + 1, r.d2), (DELTA + 2, r.d3), (DET, r.p0),
            (C, r.c11), (C + 1, r.c12), (C + 2, r.c13), (C + 3, r.c21), (C + 4, r.c22), (C + 5, r.c23),
            (C + 6, r.c31), (C + 7, r.c32), (C + 8, r.c33),
        ):  # fmt: skip
            P[row, i] = P[row, i] if done else x
        ok[i] = 1 if done | ((radius >= 0.0) & (r.first <= S[ENOUGH, i])) else 0
        bad += 1 - ok[i] if radius >= 0.0 else 0
    return bad


def residuals(S, P):
    """G at every lane's w, in pairs."""
    for i in lanes(LANES):
        P[R, i], _, P[R + 1, i], _, P[R + 2, i], _ = gibbs_residual_pairs(
            P[W, i], P[W + 1, i], P[W + 2, i],
            S[K, i], S[K + 1, i], S[K + 2, i], S[K + 3, i], S[K + 4, i], S[K + 5, i],
            S[G, i], S[G + 1, i], S[G + 2, i], S[G + 3, i], S[G + 4, i], S[G + 5, i],
            S[I, i], S[I + 1, i], S[I + 2, i], S[I + 3, i], S[I + 4, i], S[I + 5, i], S[D, i],
        )  # fmt: skip


def corrected(S, P, ok):
    """The correction e of every lane; returns how many did not settle."""
    bad = 0
    for i in lanes(LANES):
        w1, w2, w3 = P[W, i], P[W + 1, i], P[W + 2, i]
        r = Round(
            P[DET, i], 0.0, 0.0, 0.0, w1, w2, w3, 0.0, P[DELTA, i], P[DELTA + 1, i], P[DELTA + 2, i], P[C, i],
            P[C + 1, i], P[C + 2, i], P[C + 3, i], P[C + 4, i], P[C + 5, i], P[C + 6, i], P[C + 7, i], P[C + 8, i],
        )  # fmt: skip
        e1, e2, e3 = correction(
            r, P[R, i], P[R + 1, i], P[R + 2, i], S[K, i], S[K + 2, i], S[K + 4, i], S[I, i], S[I + 2, i], S[I + 4, i]
        )
        P[E, i], P[E + 1, i], P[E + 2, i] = e1, e2, e3
        ok[i] = 1 if (ok[i] == 1) & small(w1, w2, w3, e1, e2, e3) else 0
        bad += 1 - ok[i]
    return bad


@out_of_line
def mend(S, P, ok, step, taken, status, reach):
    """The stage of `double_double_loop` for the lanes that did not settle; a ball that cannot go on rests."""
    for i in range(LANES):
        if ok[i] == 1:
            continue
        P[W, i], P[W + 1, i], P[W + 2, i], P[E, i], P[E + 1, i], P[E + 2, i] = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        if i < len(status) and status[i] == TAKEN:
            s = S[:, i].copy()
            status[i], reach[i], u1, u1_, u2, u2_, u3, u3_ = stage(
                s, 1.0, 0.0, s[RADIUS], s[ENOUGH], s[A:RADIUS].reshape((8, 3))
            )
            if status[i] == TAKEN:
                P[W, i], P[W + 1, i], P[W + 2, i], P[E, i], P[E + 1, i], P[E + 2, i] = u1, u2, u3, u1_, u2_, u3_
                continue
            taken[i] = step
        S[RADIUS, i] = -1.0


def extrapolated(S, row, i, w):
    """The filter of one component in a lane."""
    (
        S[row, i], S[row + 3, i], S[row + 6, i], S[row + 9, i],
        S[row + 12, i], S[row + 15, i], S[row + 18, i], S[row + 21, i],
    ) = filtered(
        S[row + 3, i], S[row + 6, i], S[row + 9, i], S[row + 12, i], S[row + 15, i], S[row + 18, i], S[row + 21, i], w
    )  # fmt: skip


def turned(S, P):
    """Turns k and γ of every lane, and carries the extrapolation on."""
    for i in lanes(LANES):
        (
            S[0, i], S[1, i], S[2, i], S[3, i], S[4, i], S[5, i],
            S[6, i], S[7, i], S[8, i], S[9, i], S[10, i], S[11, i],
        ) = turn_pairs(  # type: ignore[call-arg]
            *two_sum(P[W, i], P[E, i]), *two_sum(P[W + 1, i], P[E + 1, i]), *two_sum(P[W + 2, i], P[E + 2, i]),
            S[0, i], S[1, i], S[2, i], S[3, i], S[4, i], S[5, i],
            S[6, i], S[7, i], S[8, i], S[9, i], S[10, i], S[11, i],
        )  # fmt: skip
        extrapolated(S, A, i, P[W, i] + P[E, i])
        extrapolated(S, A + 1, i, P[W + 1, i] + P[E + 1, i])
        extrapolated(S, A + 2, i, P[W + 2, i] + P[E + 2, i])


def prepare_pairs_block(
    momentum: Matrix, g: Matrix, tensor: Matrix, contact: Vector, c: Matrix, state: Matrix, shift: Integers,
    beyond: Integers,
):  # fmt: skip
    """`prepare_pairs` of each ball of a block; one that is not full repeats its last ball."""
    one, radius, enough, last = np.empty(ROWS), np.empty(1), np.empty(1), len(contact) - 1
    for lane in range(state.shape[1]):
        i = min(lane, last)
        shift[i], beyond[i] = prepare_pairs(momentum[i], g[i], tensor[i], contact[i], c, one, radius, enough)
        for row in range(RADIUS):
            state[row, lane] = one[row] if row < ROWS else 0.0
        state[RADIUS, lane], state[ENOUGH, lane] = radius[0], enough[0]


def march_pairs_block(
    state: Matrix, first: int, count: int, every: int, shift: Integers, momenta: Cube, momenta_: Cube, verticals: Cube,
    verticals_: Cube, taken: Integers, status: Integers, reach: Doubles,
):  # fmt: skip
    """`count` steps of a block from the step `first` on, as of `double_double_loop`: state (ALL_ROWS, LANES).

    shift, taken, status and reach have one entry for each ball; lanes beyond them are idle copies.
    """
    S, P, ok = np.empty((ALL_ROWS, LANES)), np.empty((WORK_ROWS, LANES)), np.empty(LANES, dtype=np.int64)
    carry(state, S, LANES)
    for step in range(first, first + count):
        bad, rounds = approached(S, P, ok, False), 1
        while bad != 0 and rounds < ROUNDS:
            bad, rounds = approached(S, P, ok, True), rounds + 1
        residuals(S, P)
        if corrected(S, P, ok) != 0:
            mend(S, P, ok, step, taken, status, reach)
        turned(S, P)
        if (step + 1) % PERIOD == 0:
            for i in range(LANES):
                one = S[:ROWS, i].copy()
                restore_pairs(one)
                for row in range(ROWS):
                    S[row, i] = one[row]
        if (step + 1) % every == 0:
            frame = (step + 1) // every
            for i in range(len(status)):
                if status[i] == TAKEN:
                    one = S[:, i].copy()
                    write(momenta[i, frame], momenta_[i, frame], one, K, -int(shift[i]))
                    write(verticals[i, frame], verticals_[i, frame], one, G, 0)
    for i in range(len(status)):
        if status[i] == TAKEN:
            taken[i] = first + count
    carry(S, state, LANES)
