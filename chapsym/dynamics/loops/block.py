"""Many balls at once: blocks of `LANES` balls, each number in a row of its own, so that the loops become vector code.

It does to each ball what `loop.march` does, with the same roundings; for numba only, as plain Python would crawl.
"""

import numpy as np

from .gibbs import BEYOND, newton_round, second_round, settle
from .integrals import PERIOD, restore
from .loop import ENOUGH, RADIUS, ROWS, A, D, G, I, K, X, followed, prepare, safe_rotation, three
from .path import MOST_ROUNDS as PATH_ROUNDS
from .path import improved, proved
from .sums import filtered, turned
from .text import Cube, Doubles, Integers, Matrix, Vector, lanes, out_of_line

#: Balls in a block, at most: its rows stay in the first-level cache.
LANES = 40
#: Balls in a block are made a multiple of what the widest register holds.
REGISTER = 8
#: A float32 is half as long.
SINGLE = {"LANES": 80, "REGISTER": 16}
#: After a step that needed the second correction, so many are taken with it at once.
PATIENCE = 64
#: Rounds that all lanes take together where more than a few did not settle; those few are mended one by one.
ROUNDS = 4
FEW = 2


def whole(ok):
    """The lanes in use, a multiple of REGISTER: said so, for a loop without a rest that would be narrower."""
    return len(ok) // REGISTER * REGISTER


def predicted(S, P, ok):
    """Every lane's rotation, by a Newton iterate from the extrapolation; returns how many did not settle."""
    for i in lanes(whole(ok)):
        u1, u2, u3 = S[A, i], S[A + 1, i], S[A + 2, i]
        p0, p1, p2, p3, w1, w2, w3, first, _, _, _, _, _, _, _, _, _, _, _, _ = newton_round(
            u1, u2, u3, S[K, i], S[K + 1, i], S[K + 2, i], S[G, i], S[G + 1, i], S[G + 2, i],
            S[I, i], S[I + 1, i], S[I + 2, i], S[D, i],
        )  # fmt: skip
        P[0, i], P[1, i], P[2, i], P[3, i], P[4, i], P[5, i], P[6, i] = p0, p1, p2, p3, w1, w2, w3
        settled = (u1 * u1 + (u2 * u2 + u3 * u3) <= S[RADIUS, i]) & (first <= S[ENOUGH, i])
        ok[i] = 1 if settled else 0
    return unsettled(ok)


def corrected(S, P, ok, again):
    """The same with the second correction where it is needed; `again`, from there for the lanes that did not settle.

    A lane that is not near, outside the ball of the lemma, stays, and begins again from no rotation: `gibbs.search`.
    """
    for i in lanes(whole(ok)):
        radius, enough = S[RADIUS, i], S[ENOUGH, i]
        u1, u2, u3 = (P[4, i], P[5, i], P[6, i]) if again else (S[A, i], S[A + 1, i], S[A + 2, i])
        near = u1 * u1 + (u2 * u2 + u3 * u3) <= radius
        if again:
            u1, u2, u3 = u1 if near else 0.0, u2 if near else 0.0, u3 if near else 0.0
            near = radius >= 0.0
        k1, k2, k3, I1, I2, I3 = S[K, i], S[K + 1, i], S[K + 2, i], S[I, i], S[I + 1, i], S[I + 2, i]
        p0, p1, p2, p3, w1, w2, w3, first, d1, d2, d3, c11, c12, c13, c21, c22, c23, c31, c32, c33 = newton_round(
            u1, u2, u3, k1, k2, k3, S[G, i], S[G + 1, i], S[G + 2, i], I1, I2, I3, S[D, i]
        )  # fmt: skip
        r1, r2, r3, v1, v2, v3, second = second_round(
            p0, p1, p2, p3, k1, k2, k3, d1, d2, d3, c11, c12, c13, c21, c22, c23, c31, c32, c33, I1, I2, I3
        )  # fmt: skip
        once = near & (first <= enough)
        twice = near & (v1 * v1 + (v2 * v2 + v3 * v3) <= radius)
        twice = twice & (9.0 * max(first, second) * second <= enough * enough)
        done = again & (ok[i] == 1)
        p1, p2, p3 = p1 if once else r1, p2 if once else r2, p3 if once else r3
        w1, w2, w3 = w1 if once else v1, w2 if once else v2, w3 if once else v3
        w1, w2, w3 = w1 if near else u1, w2 if near else u2, w3 if near else u3
        P[0, i], P[1, i] = P[0, i] if done else p0, P[1, i] if done else p1
        P[2, i], P[3, i] = P[2, i] if done else p2, P[3, i] if done else p3
        P[4, i], P[5, i], P[6, i] = P[4, i] if done else w1, P[5, i] if done else w2, P[6, i] if done else w3
        ok[i] = 1 if done | once | twice else 0
    return unsettled(ok)


def approached(S, P, ok):
    """The lanes beyond the bound by a Newton iterate from the extrapolation, as `path.search_on_path` begins."""
    for i in lanes(whole(ok)):
        beyond = S[RADIUS, i] == BEYOND
        _, _, _, _, w1, w2, w3, _, _, _, _, _, _, _, _, _, _, _, _, _ = newton_round(
            S[A, i], S[A + 1, i], S[A + 2, i], S[K, i], S[K + 1, i], S[K + 2, i], S[G, i], S[G + 1, i], S[G + 2, i],
            S[I, i], S[I + 1, i], S[I + 2, i], S[D, i],
        )  # fmt: skip
        P[4, i], P[5, i], P[6, i] = w1 if beyond else P[4, i], w2 if beyond else P[5, i], w3 if beyond else P[6, i]
        P[7, i] = 1.0 if beyond else 0.0
        ok[i] = 0 if beyond else ok[i]


def nearer(S, P, ok):
    """A round of corrections for the lanes on the path that are not near; returns how many are left for another."""
    for i in lanes(whole(ok)):
        going = P[7, i] == 1.0
        p0, p1, p2, p3, w1, w2, w3, left, near, found = improved(
            P[4, i], P[5, i], P[6, i], S[K, i], S[K + 1, i], S[K + 2, i], S[G, i], S[G + 1, i], S[G + 2, i],
            S[I, i], S[I + 1, i], S[I + 2, i], S[D, i],
        )  # fmt: skip
        P[0, i], P[1, i] = p0 if going else P[0, i], p1 if going else P[1, i]
        P[2, i], P[3, i] = p2 if going else P[2, i], p3 if going else P[3, i]
        P[4, i], P[5, i], P[6, i] = w1 if going else P[4, i], w2 if going else P[5, i], w3 if going else P[6, i]
        P[7, i], P[8, i] = 0.0 if near | found else P[7, i], left if going else P[8, i]
    left = 0.0
    for i in lanes(whole(ok)):
        left += P[7, i]
    return left


def on_path(S, P, ok):
    """Settles the lanes beyond the bound whose root is proved to be that of the branch; returns how many are left.

    The others go the way of one ball, `mend`, from the beginning.
    """
    for i in lanes(whole(ok)):
        settled = (S[RADIUS, i] == BEYOND) & proved(
            P[4, i], P[5, i], P[6, i], P[8, i], S[K, i], S[K + 1, i], S[K + 2, i], S[G, i], S[G + 1, i], S[G + 2, i],
            S[I, i], S[I + 1, i], S[I + 2, i], S[D, i],
        )  # fmt: skip
        ok[i] = 1 if settled else ok[i]
    return unsettled(ok)


def unsettled(ok):
    """How many lanes did not settle: counted apart, as a wide counter would narrow the registers of the others."""
    bad = 0
    for i in lanes(whole(ok)):
        bad += 1 - ok[i]
    return bad


def uncertified(radius, ok):
    """How many lanes no round by the lemma can settle, and how many of them are beyond its bound."""
    count, beyond = 0, 0
    for i in range(len(ok)):
        count += 0 if radius[i] >= 0.0 else 1
        beyond += 1 if radius[i] == BEYOND else 0
    return count, beyond


def solved(S, P, ok, hopeless, beyond, patience):
    """Every lane's rotation; returns the patience that is left, and how many lanes are to be mended.

    hopeless, beyond: of `uncertified`.
    """
    bad = hopeless + 1 if beyond < len(ok) else hopeless
    if patience == 0 and beyond < len(ok):
        bad = predicted(S, P, ok)
    if bad > hopeless:
        patience = PATIENCE if patience == 0 else patience - 1
        bad, rounds = corrected(S, P, ok, False), 1
        while bad > hopeless + FEW and rounds < ROUNDS:
            bad, rounds = corrected(S, P, ok, True), rounds + 1
    if beyond != 0:
        approached(S, P, ok)
        left, rounds = nearer(S, P, ok), 1
        while left > 0 and rounds < PATH_ROUNDS:
            left, rounds = nearer(S, P, ok), rounds + 1
        bad = on_path(S, P, ok)
    return patience, bad


@out_of_line
def mend(S, P, ok, step, taken, status, reach, balls):
    """The step of `loop.march` for the lanes that did not settle; a ball that cannot go on rests from then on."""
    for i in range(len(ok)):
        if ok[i] == 1:
            continue
        if i < balls and status[i] == 0:
            one = S[:, i].copy()
            _, _, _, _, _, u1, u2, u3 = settle(  # type: ignore[call-arg]
                *three(one, A), *three(one, K), *three(one, G), *three(one, I), one[D], one[RADIUS], one[ENOUGH]
            )
            status[i], reach[i], p0, p1, p2, p3, w1, w2, w3 = safe_rotation(u1, u2, u3, one)
            if status[i] == 0:
                P[0, i], P[1, i], P[2, i], P[3, i], P[4, i], P[5, i], P[6, i] = p0, p1, p2, p3, w1, w2, w3
                continue
            taken[i] = step
        S[RADIUS, i] = -1.0
        P[0, i], P[1, i], P[2, i], P[3, i], P[4, i], P[5, i], P[6, i] = 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0


def rolled(S, P, B, ok):
    """Moves the attitude and the contact point of every lane by the step that begins at its γ."""
    for i in lanes(whole(ok)):
        B[0, i], B[1, i], B[2, i], B[3, i], B[4, i], B[5, i] = followed(
            P[0, i], P[1, i], P[2, i], P[3, i], S[G, i], S[G + 1, i], S[G + 2, i],
            B[0, i], B[1, i], B[2, i], B[3, i], B[4, i], B[5, i], B[6, i],
        )  # fmt: skip


def moved(S, P, ok):
    """Turns k and γ of every lane, with compensation, and carries the extrapolation on."""
    for i in lanes(whole(ok)):
        p0, p1, p2, p3, w1, w2, w3 = P[0, i], P[1, i], P[2, i], P[3, i], P[4, i], P[5, i], P[6, i]
        turn_at(p0, p1, p2, p3, S, K, X, i)
        turn_at(p0, p1, p2, p3, S, G, X + 3, i)
        extrapolated(S, A, i, w1)
        extrapolated(S, A + 1, i, w2)
        extrapolated(S, A + 2, i, w3)


def turn_at(p0, p1, p2, p3, S, at, rest, i):
    """Turns the vector in the rows from `at` on, with the rests of its sums in those from `rest` on, in a lane."""
    v1, v2, v3, x1, x2, x3 = turned(
        p0, p1, p2, p3, S[at, i], S[at + 1, i], S[at + 2, i], S[rest, i], S[rest + 1, i], S[rest + 2, i]
    )
    S[at, i], S[at + 1, i], S[at + 2, i] = v1, v2, v3
    S[rest, i], S[rest + 1, i], S[rest + 2, i] = x1, x2, x3


def extrapolated(S, row, i, w):
    """The filter of one component in a lane."""
    (
        S[row, i], S[row + 3, i], S[row + 6, i], S[row + 9, i],
        S[row + 12, i], S[row + 15, i], S[row + 18, i], S[row + 21, i],
    ) = filtered(
        S[row + 3, i], S[row + 6, i], S[row + 9, i], S[row + 12, i], S[row + 15, i], S[row + 18, i], S[row + 21, i], w
    )  # fmt: skip


def prepare_block(momentum: Matrix, g: Matrix, tensor: Matrix, contact: Vector, state: Matrix, scale: Vector):
    """`loop.prepare` of each ball of a block; one that is not full repeats its last ball."""
    one, last = np.empty(ROWS, state.dtype), len(contact) - 1
    for lane in range(state.shape[1]):
        i = min(lane, last)
        scale[i] = prepare(momentum[i], g[i], tensor[i], contact[i], one)
        for row in range(ROWS):
            state[row, lane] = one[row]


def carry(numbers, to, width):
    """Copies columns; an assignment of slices takes seconds to compile."""
    for row in range(to.shape[0]):
        for i in range(width):
            to[row, i] = numbers[row, i]


@out_of_line
def restored(S, status):
    """`integrals.restore` of each ball that has not stopped."""
    for i in range(len(status)):
        if status[i] == 0:
            one = S[:, i].copy()
            restore(one)
            for row in range(X, X + 6):
                S[row, i] = one[row]


def keep(S, B, frame, scale, momenta, verticals, status, with_body, attitudes, traces):
    """Writes a frame of each ball that has not stopped."""
    for i in range(len(status)):
        if status[i] == 0:
            for c in range(3):
                momenta[i, frame, c], verticals[i, frame, c] = scale[i] * S[K + c, i], S[G + c, i]
            if with_body:
                for c in range(4):
                    attitudes[i, frame, c] = B[c, i]
                traces[i, frame, 0], traces[i, frame, 1] = B[4, i], B[5, i]


def march_block(
    state: Matrix, first: int, count: int, every: int, scale: Vector, momenta: Cube, verticals: Cube, taken: Integers,
    status: Integers, reach: Doubles, with_body: bool, body: Matrix, attitudes: Cube, traces: Cube,
):  # fmt: skip
    """`count` steps of the balls of a block from the step `first` on: state (ROWS, lanes), the rest as in `march`.

    lanes: a multiple of REGISTER, LANES at most.
    body: (7, lanes), the attitude, the contact point and the radius, which are touched only when `with_body`.
    scale, taken, status and reach have one entry for each ball; lanes beyond them are idle copies.
    """
    S = np.empty((ROWS, LANES), state.dtype)
    P, B = np.empty((9, LANES), state.dtype), np.empty((7, LANES), state.dtype)
    width = state.shape[1]
    ok = np.empty(width, dtype=np.int32)
    carry(state, S, width)
    carry(body, B, width)
    balls = len(status)
    step, last, patience = first, first + count, 0
    hopeless, beyond = uncertified(S[RADIUS], ok)
    while step < last:
        stop = min(last, step + every - step % every, step + PERIOD - step % PERIOD)
        while step < stop:
            patience, bad = solved(S, P, ok, hopeless, beyond, patience)
            if bad != 0:
                mend(S, P, ok, step, taken, status, reach, balls)
                hopeless, beyond = uncertified(S[RADIUS], ok)
            if with_body:
                rolled(S, P, B, ok)
            moved(S, P, ok)
            step += 1
        if step % PERIOD == 0:
            restored(S, status)
        if step % every == 0:
            keep(S, B, step // every, scale, momenta, verticals, status, with_body, attitudes, traces)
    for i in range(balls):
        if status[i] == 0:
            taken[i] = last
    carry(S, state, width)
    carry(B, body, width)
