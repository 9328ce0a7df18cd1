"""Many balls at once in double-double: blocks of `LANES` balls, as in `block`.

Each lane has the bits of `double_double_loop.march_pairs` for that ball alone.
"""

import numpy as np

from chapsym.generated import gibbs_residual
from chapsym.numbers.loose import Loose

from .block import carry
from .branch import TAKEN
from .double_double_loop import ROWS, D, G, I, K, prepare_pairs, restore_pairs, stage, turned, write
from .double_double_step import correction, small
from .gibbs import newton_round
from .integrals import PERIOD
from .sums import filtered
from .text import Cube, Doubles, Integers, Matrix, Vector, lanes, out_of_line
from .vectors import exact, highs, lows, normalised, pairs_in, put_in, put_pairs_in, square, summed, three_in

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
        u = three_in(P, W, i) if again else three_in(S, A, i)
        u = u if square(u) <= radius else (0.0, 0.0, 0.0)
        k, g, inertia = highs(pairs_in(S, K, i)), highs(pairs_in(S, G, i)), highs(pairs_in(S, I, i))
        r = newton_round(u, k, g, inertia, S[D, i])
        done, c = again & (ok[i] == 1), r.cofactors
        put_in(P, W, i, three_in(P, W, i) if done else r.w)
        put_in(P, DELTA, i, three_in(P, DELTA, i) if done else r.d)
        put_in(P, C, i, three_in(P, C, i) if done else c[0:3])
        put_in(P, C + 3, i, three_in(P, C + 3, i) if done else c[3:6])
        put_in(P, C + 6, i, three_in(P, C + 6, i) if done else c[6:9])
        P[DET, i] = P[DET, i] if done else r.p[0]
        ok[i] = 1 if done | ((radius >= 0.0) & (r.first <= S[ENOUGH, i])) else 0
        bad += 1 - ok[i] if radius >= 0.0 else 0
    return bad


def residuals(S, P):
    """G at every lane's w, in pairs."""
    for i in lanes(LANES):
        w, contact = exact(three_in(P, W, i)), Loose(S[D, i])
        k, g, inertia = pairs_in(S, K, i), pairs_in(S, G, i), pairs_in(S, I, i)
        put_in(P, R, i, highs(normalised(gibbs_residual(*w, *k, *g, *inertia, contact))))


def corrected(S, P, ok):
    """The correction e of every lane; returns how many did not settle."""
    bad = 0
    for i in lanes(LANES):
        c = *three_in(P, C, i), *three_in(P, C + 3, i), *three_in(P, C + 6, i)
        k, inertia = highs(pairs_in(S, K, i)), highs(pairs_in(S, I, i))
        e = correction(P[DET, i], three_in(P, DELTA, i), c, three_in(P, R, i), k, inertia)
        put_in(P, E, i, e)
        ok[i] = 1 if (ok[i] == 1) & small(three_in(P, W, i), e) else 0
        bad += 1 - ok[i]
    return bad


@out_of_line
def mend(S, P, ok, step, taken, status, reach):
    """The stage of `double_double_loop` for the lanes that did not settle; a ball that cannot go on rests."""
    for i in range(LANES):
        if ok[i] == 1:
            continue
        put_in(P, W, i, (0.0, 0.0, 0.0))
        put_in(P, E, i, (0.0, 0.0, 0.0))
        if i < len(status) and status[i] == TAKEN:
            s = S[:, i].copy()
            status[i], reach[i], u = stage(s, Loose(1.0, 0.0), s[RADIUS], s[ENOUGH], s[A:RADIUS].reshape((8, 3)))
            if status[i] == TAKEN:
                put_in(P, W, i, highs(u))
                put_in(P, E, i, lows(u))
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


def all_turned(S, P):
    """Turns k and γ of every lane, and carries the extrapolation on."""
    for i in lanes(LANES):
        w, e = three_in(P, W, i), three_in(P, E, i)
        u = summed(w, e)
        put_pairs_in(S, K, i, turned(u, pairs_in(S, K, i)))
        put_pairs_in(S, G, i, turned(u, pairs_in(S, G, i)))
        extrapolated(S, A, i, w[0] + e[0])
        extrapolated(S, A + 1, i, w[1] + e[1])
        extrapolated(S, A + 2, i, w[2] + e[2])


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
        all_turned(S, P)
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
