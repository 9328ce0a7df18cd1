"""Many balls at once: blocks of `LANES` balls, each number in a row of its own, so that the loops become vector code.

It does to each ball what `loop.march` does, with the same roundings.
"""

import numpy as np

from .gibbs import BEYOND, newton_round, second_round, settle
from .integrals import PERIOD, restore
from .loop import ENOUGH, RADIUS, ROWS, D, G, I, K, X, followed, prepare, safe_rotation, three
from .path import MOST_ROUNDS as PATH_ROUNDS
from .path import improved, proved
from .sums import turned
from .text import Cube, Doubles, Integers, Matrix, Vector, lanes, out_of_line

#: Balls in a block, at most: its rows stay in the first-level cache.
LANES = 40
#: Balls in a block are made a multiple of what the widest register holds.
REGISTER = 8
#: A float32 is half as long.
SINGLE = {"LANES": 80, "REGISTER": 16}
#: After a step that needed the second correction, so many are taken with it at once.
PATIENCE = 64
#: In place of a radius²: the ball has stopped.
STOPPED = -3.0
#: Rows of the rotations: the quaternion p and its Gibbs vector w; whether a lane is on its way along the path, and what
#: is left there; and the guess of the Gibbs vector.
P_ROWS, A = 12, 9
#: Rounds that all lanes take together where more than a few did not settle; those few are mended one by one.
ROUNDS = 4
FEW = 2


def whole(ok):
    """The lanes in use, a multiple of REGISTER: said so, for a loop without a rest that would be narrower."""
    return len(ok) // REGISTER * REGISTER


def predicted(S, P, ok):
    """Every lane's rotation, by a Newton iterate from the extrapolation; returns how many did not settle."""
    for i in lanes(whole(ok)):
        u1, u2, u3 = P[A, i], P[A + 1, i], P[A + 2, i]
        r = newton_round(
            u1, u2, u3, S[K, i], S[K + 1, i], S[K + 2, i], S[G, i], S[G + 1, i], S[G + 2, i],
            S[I, i], S[I + 1, i], S[I + 2, i], S[D, i],
        )  # fmt: skip
        P[0, i], P[1, i], P[2, i], P[3, i], P[4, i], P[5, i], P[6, i] = r.p0, r.p1, r.p2, r.p3, r.w1, r.w2, r.w3
        settled = (u1 * u1 + (u2 * u2 + u3 * u3) <= S[RADIUS, i]) & (r.first <= S[ENOUGH, i])
        ok[i] = 1 if settled else 0
    return unsettled(ok)


def corrected(S, P, ok, again):
    """The same with the second correction where it is needed; `again`, from there for the lanes that did not settle.

    A lane that is not near, outside the ball of the lemma, stays, and begins again from no rotation: `gibbs.search`.
    """
    for i in lanes(whole(ok)):
        radius, enough = S[RADIUS, i], S[ENOUGH, i]
        u1, u2, u3 = (P[4, i], P[5, i], P[6, i]) if again else (P[A, i], P[A + 1, i], P[A + 2, i])
        near = u1 * u1 + (u2 * u2 + u3 * u3) <= radius
        if again:
            u1, u2, u3 = u1 if near else 0.0, u2 if near else 0.0, u3 if near else 0.0
            near = radius >= 0.0
        k1, k2, k3, I1, I2, I3 = S[K, i], S[K + 1, i], S[K + 2, i], S[I, i], S[I + 1, i], S[I + 2, i]
        r = newton_round(u1, u2, u3, k1, k2, k3, S[G, i], S[G + 1, i], S[G + 2, i], I1, I2, I3, S[D, i])
        r1, r2, r3, v1, v2, v3, second = second_round(r, k1, k2, k3, I1, I2, I3)
        p0, first = r.p0, r.first
        once = near & (first <= enough)
        twice = near & (v1 * v1 + (v2 * v2 + v3 * v3) <= radius)
        twice = twice & (9.0 * max(first, second) * second <= enough * enough)
        done = again & (ok[i] == 1)
        p1, p2, p3 = r.p1 if once else r1, r.p2 if once else r2, r.p3 if once else r3
        w1, w2, w3 = r.w1 if once else v1, r.w2 if once else v2, r.w3 if once else v3
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
        r = newton_round(
            P[A, i], P[A + 1, i], P[A + 2, i], S[K, i], S[K + 1, i], S[K + 2, i], S[G, i], S[G + 1, i], S[G + 2, i],
            S[I, i], S[I + 1, i], S[I + 2, i], S[D, i],
        )  # fmt: skip
        P[4, i], P[5, i] = r.w1 if beyond else P[4, i], r.w2 if beyond else P[5, i]
        P[6, i] = r.w3 if beyond else P[6, i]
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
                P[A, i], P[A + 1, i], P[A + 2, i],
                *three(one, K), *three(one, G), *three(one, I), one[D], one[RADIUS], one[ENOUGH],
            )  # fmt: skip
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


def guessed(P, past, at, places, weights, ok):
    """`loop.guessed` of every lane, from the rows of past (3 places, lanes); four vectors are read at once."""
    for i in lanes(whole(ok)):
        P[A, i], P[A + 1, i], P[A + 2, i] = 0.0, 0.0, 0.0
    for j in range(0, len(weights), 4):
        a, b, c, d = weights[j], weights[j + 1], weights[j + 2], weights[j + 3]
        w, x = 3 * ((at + j) % places), 3 * ((at + j + 1) % places)
        y, z = 3 * ((at + j + 2) % places), 3 * ((at + j + 3) % places)
        for i in lanes(whole(ok)):
            u1, u2, u3 = P[A, i] + a * past[w, i], P[A + 1, i] + a * past[w + 1, i], P[A + 2, i] + a * past[w + 2, i]
            u1, u2, u3 = u1 + b * past[x, i], u2 + b * past[x + 1, i], u3 + b * past[x + 2, i]
            u1, u2, u3 = u1 + c * past[y, i], u2 + c * past[y + 1, i], u3 + c * past[y + 2, i]
            u1, u2, u3 = u1 + d * past[z, i], u2 + d * past[z + 1, i], u3 + d * past[z + 2, i]
            P[A, i], P[A + 1, i], P[A + 2, i] = u1, u2, u3


def begin_stage(S, T, s, radius, enough, ok):
    """The ball of a stage with the coefficient s: 𝒦 is s times that of the step."""
    for i in lanes(whole(ok)):
        T[K, i], T[K + 1, i], T[K + 2, i] = s * S[K, i], s * S[K + 1, i], s * S[K + 2, i]
        T[G, i], T[G + 1, i], T[G + 2, i] = S[G, i], S[G + 1, i], S[G + 2, i]
        T[RADIUS, i], T[ENOUGH, i] = radius[i], enough[i]


def end_stage(S, P, past, row, ok):
    """Turns 𝒦 and γ of every lane, with compensation, and keeps the Gibbs vectors in the rows of past from `row` on."""
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


def turn_at(p0, p1, p2, p3, S, at, rest, i):
    """Turns the vector in the rows from `at` on, with the rests of its sums in those from `rest` on, in a lane."""
    v1, v2, v3, x1, x2, x3 = turned(
        p0, p1, p2, p3, S[at, i], S[at + 1, i], S[at + 2, i], S[rest, i], S[rest + 1, i], S[rest + 2, i]
    )
    S[at, i], S[at + 1, i], S[at + 2, i] = v1, v2, v3
    S[rest, i], S[rest + 1, i], S[rest + 2, i] = x1, x2, x3


def carry(numbers, to, width):
    """Copies columns."""
    for row in range(to.shape[0]):
        for i in range(width):
            to[row, i] = numbers[row, i]


def prepare_block(momentum, g, tensor, contact, c, state, radius, enough, past, scale):
    """`loop.prepare` of each ball of a block; one that is not full repeats its last ball."""
    one, last = np.empty(ROWS, state.dtype), len(contact) - 1
    bounds = np.empty((2, len(c)), state.dtype)
    for lane in range(state.shape[1]):
        i = min(lane, last)
        scale[i] = prepare(momentum[i], g[i], tensor[i], contact[i], c, one, bounds[0], bounds[1])
        for row in range(ROWS):
            state[row, lane] = one[row]
        for stage in range(len(c)):
            radius[stage, lane], enough[stage, lane] = bounds[0, stage], bounds[1, stage]
    for row in range(len(past)):
        for lane in range(state.shape[1]):
            past[row, lane] = 0.0


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
    state, c, weights, radius, enough, past, first, count, every, scale, momenta, verticals, taken, status, reach,
    with_body, body, attitudes, traces,
):  # fmt: skip
    """`loop.march` of the balls of a block: state (ROWS, lanes), radius² and enough (s, lanes), past (3 places, lanes).

    lanes: a multiple of REGISTER, LANES at most.
    body: (7, lanes), the attitude, the contact point and the radius, which are touched only when `with_body`.
    scale, taken, status and reach have one entry for each ball; lanes beyond them are idle copies.
    """
    S, W = np.empty((ROWS, LANES), state.dtype), np.empty((ROWS, LANES), state.dtype)
    P, B = np.empty((P_ROWS, LANES), state.dtype), np.empty((7, LANES), state.dtype)
    H = np.empty((len(past), LANES), state.dtype)
    width, stages, places, balls = state.shape[1], len(c), weights.shape[1], len(status)
    ok, period = np.empty(width, dtype=np.int32), max(1, PERIOD // stages)
    hopeless, beyond = np.empty(stages, dtype=np.int64), np.empty(stages, dtype=np.int64)
    carry(state, S, width)
    carry(state, W, width)
    carry(body, B, width)
    carry(past, H, width)
    T = S if stages == 1 else W  # the ball of a stage
    last, patience = first + count, 0
    for s in range(stages):
        hopeless[s], beyond[s] = uncertified(radius[s], ok)
    for step in range(first, last):
        at = step * stages % places
        later = 1 if step * stages >= places else 0
        for s in range(stages):
            if stages > 1:
                begin_stage(S, T, c[s], radius[s], enough[s], ok)
            guessed(P, H, at + s, places, weights[later, at + s], ok)
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


def march_blocks(
    state: Matrix, c: Vector, weights: Cube, radius: Matrix, enough: Matrix, past: Matrix, first: int, count: int,
    every: int, momentum: Matrix, gamma: Matrix, tensor: Matrix, contact: Vector, rho: Vector, scale: Vector,
    ended: Matrix, momenta: Cube, verticals: Cube, taken: Integers, status: Integers, reach: Doubles, with_body: bool,
    body: Matrix, attitudes: Cube, traces: Cube,
):  # fmt: skip
    """`count` steps of balls from the step `first` on, block by block; before the step 0 it prepares each.

    state, radius, enough, past, body: of one block, which one call after the other carries on; more balls than those
    of a block take all their steps in one call.  momentum, gamma, tensor, contact, rho: of each ball at the start,
    (n, 3), (n, 3), (n, 3), (n,), (n,).  ended: receives 𝒦 and γ of balls that stopped, (n, 6).
    """
    width, n = state.shape[1], len(contact)
    for low in range(0, n, width):
        high = min(low + width, n)
        if first == 0:
            prepare_block(
                momentum[low:high], gamma[low:high], tensor[low:high], contact[low:high], c, state, radius, enough,
                past, scale[low:high],
            )  # fmt: skip
            if with_body:
                for lane in range(width):
                    i = min(low + lane, n - 1)
                    for row in range(4):
                        body[row, lane] = attitudes[i, 0, row]
                    body[4, lane], body[5, lane], body[6, lane] = 0.0, 0.0, rho[i]
        march_block(
            state, c, weights, radius, enough, past, first, count, every, scale[low:high],
            momenta[low:high], verticals[low:high], taken[low:high], status[low:high], reach[low:high],
            with_body, body, attitudes[low:high], traces[low:high],
        )  # fmt: skip
        for i in range(low, high):
            if status[i] != 0:
                for row in range(3):
                    ended[i, row], ended[i, 3 + row] = scale[i] * state[K + row, i - low], state[G + row, i - low]
