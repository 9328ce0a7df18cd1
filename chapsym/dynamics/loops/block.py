"""Many balls at once: blocks of up to `LANES` balls, with one row for each variable, so that the loops vectorise.

The computation for each ball is that of `loop.march`, with the same rounding errors.
"""

from math import ldexp
from typing import NamedTuple

import numpy as np

from chapsym.generated import turn

from .branch import moments
from .gibbs import BEYOND, newton_round, second_round, settle
from .integrals import PERIOD, integrals, restore, turned
from .loop import ENOUGH, INTEGRALS, RADIUS, ROWS, D, G, I, J, K, X, followed, limits, safe_rotation, scaling, times
from .path import MOST_ROUNDS as PATH_ROUNDS
from .path import improved, proved
from .records import Ends, Frames, Stages, Start, Steps
from .text import Doubles, Integers, Matrix, Vector, lanes, out_of_line
from .vectors import four, four_in, plus, put, put_four, put_four_in, put_in, scaled, square, three, three_in, unit

#: The most balls in a block: its rows stay in the first-level cache.
LANES = 40
#: The number of lanes of a block is a multiple of the length of the widest register.
REGISTER = 8
#: The values for float32, which is half as long.
SINGLE = {"LANES": 80, "REGISTER": 16}
#: After a step that needed the second correction, the number of steps that compute it without a test.
PATIENCE = 64
#: The value of radius² for a ball that has stopped.
STOPPED = -3.0
#: Rows of the rotations: the quaternion p and its Gibbs vector, from W on; whether a lane is still open in the search
#: on the path, and its residual there; and the guess of the Gibbs vector, from A on.
P_ROWS, W, A = 12, 4, 9
#: The most rounds for all lanes together if more than FEW did not converge; up to FEW are treated one by one.
ROUNDS = 4
FEW = 2


class Block(NamedTuple):
    """A block of balls as they move: `records.Moving` with a lane for each ball, and the scale of each ball.

    state (ROWS, lanes); radius² and enough, (stages, lanes); past (3 places, lanes); body (7, lanes): the attitude, the
    contact point and the radius, used only if followed.
    """

    state: Matrix
    radius: Matrix
    enough: Matrix
    past: Matrix
    body: Matrix
    scale: Vector


def whole(ok):
    """The lanes in use, which are a multiple of REGISTER: so compilers need no scalar remainder loop."""
    return len(ok) // REGISTER * REGISTER


def registers(balls):
    """The lanes of whole registers for some balls."""
    return (balls + REGISTER - 1) // REGISTER * REGISTER


def body_in(S, i):
    """The k, γ, I and D of a lane."""
    return three_in(S, K, i), three_in(S, G, i), three_in(S, I, i), S[D, i]


def predicted(S, P, ok):
    """Every lane's rotation, by one Newton iterate from the extrapolation; returns the number not converged."""
    for i in lanes(whole(ok)):
        u = three_in(P, A, i)
        r = newton_round(u, *body_in(S, i))
        put_four_in(P, 0, i, r.p)
        put_in(P, W, i, r.w)
        ok[i] = 1 if (square(u) <= S[RADIUS, i]) & (r.first <= S[ENOUGH, i]) else 0
    return unsettled(ok)


def corrected(S, P, ok, again):
    """`predicted` with the second correction where needed; `again`: a further round for the lanes not converged.

    A lane outside the ball of the lemma is left as it is, and starts again from the identity: `gibbs.search`.
    """
    for i in lanes(whole(ok)):
        radius, enough = S[RADIUS, i], S[ENOUGH, i]
        u = three_in(P, W, i) if again else three_in(P, A, i)
        near = square(u) <= radius
        if again:
            u = u if near else (0.0, 0.0, 0.0)
            near = radius >= 0.0
        k, g, inertia, contact = body_in(S, i)
        r = newton_round(u, k, g, inertia, contact)
        p, v, second = second_round(r, k, inertia)
        once = near & (r.first <= enough)
        twice = near & (square(v) <= radius)
        twice = twice & (9.0 * max(r.first, second) * second <= enough * enough)
        done = again & (ok[i] == 1)
        p = r.p if once else p
        w = r.w if once else v
        w = w if near else u
        put_four_in(P, 0, i, four_in(P, 0, i) if done else p)
        put_in(P, W, i, three_in(P, W, i) if done else w)
        ok[i] = 1 if done | once | twice else 0
    return unsettled(ok)


def approached(S, P, ok):
    """A Newton iterate from the extrapolation for the lanes beyond the bound: the start of `path.search_on_path`."""
    for i in lanes(whole(ok)):
        beyond = S[RADIUS, i] == BEYOND
        r = newton_round(three_in(P, A, i), *body_in(S, i))
        put_in(P, W, i, r.w if beyond else three_in(P, W, i))
        P[7, i] = 1.0 if beyond else 0.0
        ok[i] = 0 if beyond else ok[i]


def nearer(S, P, ok):
    """A round of corrections for the open lanes on the path; returns the number that need another round."""
    for i in lanes(whole(ok)):
        going = P[7, i] == 1.0
        p, w, left, near, found = improved(three_in(P, W, i), *body_in(S, i))
        put_four_in(P, 0, i, p if going else four_in(P, 0, i))
        put_in(P, W, i, w if going else three_in(P, W, i))
        P[7, i], P[8, i] = 0.0 if near | found else P[7, i], left if going else P[8, i]
    left = 0.0
    for i in lanes(whole(ok)):
        left += P[7, i]
    return left


def on_path(S, P, ok):
    """Accepts the lanes whose root is proved to be on the branch; returns the number not converged.

    The other lanes are computed again as single balls by `mend`.
    """
    for i in lanes(whole(ok)):
        settled = proved(three_in(P, W, i), P[8, i], *body_in(S, i))
        ok[i] = 1 if (S[RADIUS, i] == BEYOND) & (P[7, i] == 0.0) & settled else ok[i]
    return unsettled(ok)


def unsettled(ok):
    """The number of lanes not converged; a separate loop, as a wide counter would halve the vector length."""
    bad = 0
    for i in lanes(whole(ok)):
        bad += 1 - ok[i]
    return bad


def uncertified(radius, ok):
    """The number of lanes to which the lemma does not apply, and the number of those beyond its bound."""
    count, beyond = 0, 0
    for i in range(len(ok)):
        count += 0 if radius[i] >= 0.0 else 1
        beyond += 1 if radius[i] == BEYOND else 0
    return count, beyond


def solved(S, P, ok, hopeless, beyond, patience):
    """Every lane's rotation; returns the patience left, and how many lanes to mend; hopeless, beyond: `uncertified`."""
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
def mend(S, P, ok, step, ends):
    """The step of `loop.march` for the lanes not converged; a ball without a rotation rests from then on."""
    for i in range(len(ok)):
        if ok[i] == 1:
            continue
        if i < len(ends.status) and ends.status[i] == 0:
            one = S[:, i].copy()
            k, g, inertia = three(one, K), three(one, G), three(one, I)
            _, _, u = settle(three_in(P, A, i), k, g, inertia, one[D], one[RADIUS], one[ENOUGH])
            ends.status[i], ends.reach[i], p, w = safe_rotation(u, one)
            if ends.status[i] == 0:
                put_four_in(P, 0, i, p)
                put_in(P, W, i, w)
                continue
            ends.taken[i] = step
        S[RADIUS, i] = -1.0
        put_four_in(P, 0, i, (1.0, 0.0, 0.0, 0.0))
        put_in(P, W, i, (0.0, 0.0, 0.0))


def rolled(S, P, B, ok):
    """Moves the attitude and the contact point of every lane by the step that begins at its γ."""
    for i in lanes(whole(ok)):
        a, x, y = followed(four_in(P, 0, i), three_in(S, G, i), four_in(B, 0, i), B[4, i], B[5, i], B[6, i])
        put_four_in(B, 0, i, a)
        B[4, i], B[5, i] = x, y


def guessed(P, past, at, places, weights, ok):
    """`loop.guessed` for every lane, from the rows of past (3 places, lanes); four vectors are read at once."""
    for i in lanes(whole(ok)):
        put_in(P, A, i, (0.0, 0.0, 0.0))
    for j in range(0, len(weights), 4):
        a, b, c, d = weights[j], weights[j + 1], weights[j + 2], weights[j + 3]
        w, x = 3 * ((at + j) % places), 3 * ((at + j + 1) % places)
        y, z = 3 * ((at + j + 2) % places), 3 * ((at + j + 3) % places)
        for i in lanes(whole(ok)):
            u = plus(three_in(P, A, i), scaled(a, three_in(past, w, i)))
            u = plus(u, scaled(b, three_in(past, x, i)))
            u = plus(u, scaled(c, three_in(past, y, i)))
            put_in(P, A, i, plus(u, scaled(d, three_in(past, z, i))))


def begin_stage(S, T, s, radius, enough, ok):
    """Writes the ball of a stage with the coefficient s into T: 𝒦 is s times that of the step."""
    for i in lanes(whole(ok)):
        put_in(T, K, i, scaled(s, three_in(S, K, i)))
        put_in(T, G, i, three_in(S, G, i))
        T[RADIUS, i], T[ENOUGH, i] = radius[i], enough[i]


def end_stage(S, P, past, row, ok):
    """Turns 𝒦 and γ of every lane, with compensation; stores the Gibbs vectors in past from `row` on."""
    for i in lanes(whole(ok)):
        p = four_in(P, 0, i)
        turn_in(p, S, K, X, i)
        turn_in(p, S, G, X + 3, i)
        put_in(past, row, i, three_in(P, W, i))


def stop(S, T, radius, status, ok):
    """Stops the lanes for which `mend` found no rotation; a stopped ball keeps the momentum of its stage."""
    for i in range(len(ok)):
        if (i >= len(status) or status[i] != 0) and ok[i] == 0 and radius[0, i] != STOPPED:
            for stage in range(len(radius)):
                radius[stage, i] = STOPPED
            put_in(S, K, i, three_in(T, K, i))


def turn_in(p, S, at, rest, i):
    """Turns the vector of a lane in the rows from `at` on, with its compensations in those from `rest` on."""
    v, x = turned(p, three_in(S, at, i), three_in(S, rest, i))
    put_in(S, at, i, v)
    put_in(S, rest, i, x)


def carry(numbers, to, width):
    """Copies `width` columns of an array into another."""
    for row in range(to.shape[0]):
        for i in range(width):
            to[row, i] = numbers[row, i]


@out_of_line
def enter(start, low, factor, S, scale, ok):
    """`loop.entered` without `loop.limits`, with `factor` times 𝒦, for balls from `low` on; spare lanes repeat one.

    Until `limited` the row of radius² has 1 for a ball whose momentum is tiny, and 0 for others.
    """
    for lane in range(len(ok)):
        i = low + min(lane, len(scale) - 1)
        m, tensor = scaled(factor, three(start.momentum[i], 0)), three(start.tensor[i], 0)
        exponent, tiny = scaling(m, tensor, start.contact[i])
        put_in(S, K, lane, times(m, -exponent - 1))
        put_in(S, G, lane, three(start.gamma[i], 0))
        put_in(S, J, lane, times(tensor, -exponent))
        S[D, lane], _, _ = times((start.contact[i], 0.0, 0.0), -exponent)
        S[RADIUS, lane] = 1.0 if tiny else 0.0
        scale[i - low] = ldexp(1.0, exponent + 1)


def limited(S, radius, enough, ok):
    """`loop.limits` of every lane."""
    for i in lanes(whole(ok)):
        inertia = moments(three_in(S, J, i))
        put_in(S, I, i, inertia)
        radius[i], enough[i] = limits(three_in(S, K, i), inertia, S[D, i], S[RADIUS, i] != 0.0)


def remembered(S, ok):
    """`integrals.remember` of every lane, without compensations."""
    for i in lanes(whole(ok)):
        put_in(S, X, i, (0.0, 0.0, 0.0))
        put_in(S, X + 3, i, (0.0, 0.0, 0.0))
        one, height, squared = integrals(three_in(S, K, i), three_in(S, G, i))
        put_four_in(S, INTEGRALS, i, (one[0], one[1], height[0], height[1]))
        S[INTEGRALS + 4, i], S[INTEGRALS + 5, i] = squared


def prepare_block(start, low, c, block, ok):
    """`loop.prepare` for each ball of a block, the first of which is `low`."""
    S = block.state
    for s in range(len(c)):
        enter(start, low, c[s], S, block.scale, ok)
        limited(S, block.radius[s], block.enough[s], ok)
    if len(c) > 1:  # a single stage is the step
        enter(start, low, 1.0, S, block.scale, ok)
    limited(S, S[RADIUS], S[ENOUGH], ok)
    remembered(S, ok)
    block.past[:] = 0.0


@out_of_line
def restored(S, status):
    """`integrals.restore` for each ball that has not stopped."""
    for i in range(len(status)):
        if status[i] == 0:
            one = S[:, i].copy()
            restore(one)
            for row in range(X, X + 6):
                S[row, i] = one[row]


def keep(block, low, frame, frames, status):
    """Writes a frame of each ball that has not stopped; low: the first ball."""
    S, B = block.state, block.body
    for i in range(len(status)):
        if status[i] == 0:
            put(frames.momenta[low + i, frame], 0, scaled(block.scale[i], three_in(S, K, i)))
            put(frames.verticals[low + i, frame], 0, three_in(S, G, i))
            if frames.follows:
                put_four(frames.attitudes[low + i, frame], 0, four_in(B, 0, i))
                frames.traces[low + i, frame, 0], frames.traces[low + i, frame, 1] = B[4, i], B[5, i]


def march_block(block, low, stages, steps, frames, ends, ok):
    """`loop.march` for a block of balls, whose frames are from the ball `low` on.

    ok: one entry for each lane in use, a multiple of REGISTER, LANES at most.  The scale and the ends have one entry
    for each ball; lanes beyond these are idle copies.
    """
    S, H, radius, enough = block.state, block.past, block.radius, block.enough
    other, P = np.empty((ROWS, LANES), S.dtype), np.empty((P_ROWS, LANES), S.dtype)
    c, weights, status = stages.c, stages.weights, ends.status
    count, places = len(c), weights.shape[1]
    period = max(1, PERIOD // count)
    hopeless, beyond = np.empty(count, dtype=np.int64), np.empty(count, dtype=np.int64)
    if count > 1:
        carry(S, other, len(ok))
    T = S if count == 1 else other  # the ball of a stage
    patience = 0
    for s in range(count):
        hopeless[s], beyond[s] = uncertified(radius[s], ok)
    for step in range(steps.first, steps.last):
        at = step * count % places
        later = 1 if step * count >= places else 0
        for s in range(count):
            if count > 1:
                begin_stage(S, T, c[s], radius[s], enough[s], ok)
            guessed(P, H, at + s, places, weights[later, at + s], ok)
            patience, bad = solved(T, P, ok, hopeless[s], beyond[s], patience)
            if bad != 0:
                mend(T, P, ok, step, ends)
                stop(S, T, radius, status, ok)
                for n in range(count):
                    hopeless[n], beyond[n] = uncertified(radius[n], ok)
            if frames.follows:
                rolled(T, P, block.body, ok)
            end_stage(S, P, H, 3 * (at + s), ok)
        if (step + 1) % period == 0:
            restored(S, status)
        if (step + 1) % steps.every == 0:
            keep(block, low, (step + 1) // steps.every, frames, status)
    for i in range(len(status)):
        if status[i] == 0:
            ends.taken[i] = steps.last


def march_blocks(
    kept: Block, stages: Stages, steps: Steps, start: Start, rho: Vector, frames: Frames, ends: Ends, ended: Matrix
):
    """Takes the steps of balls, block by block; before step 0 it prepares each block.

    kept: of a single block, which successive calls continue; more balls than fit in a block take all their steps in one
    call.  start, rho: of each ball.  ended: receives 𝒦 and γ of balls that stopped, (n, 6).
    """
    S, B = np.empty((ROWS, LANES), kept.state.dtype), np.empty((7, LANES), kept.state.dtype)
    H = np.empty((len(kept.past), LANES), kept.state.dtype)
    width, n = kept.state.shape[1], len(rho)
    all_lanes = np.empty(width, dtype=np.int32)
    for low in range(0, n, width):
        high = min(low + width, n)
        ok = all_lanes[: registers(high - low)]
        block = Block(S, kept.radius, kept.enough, H, B, kept.scale[low:high])
        outcome = Ends(ends.taken[low:high], ends.status[low:high], ends.reach[low:high])
        if steps.first == 0:
            prepare_block(start, low, stages.c, block, ok)
            if frames.follows:
                for lane in range(len(ok)):
                    i = min(low + lane, n - 1)
                    put_four_in(B, 0, lane, four(frames.attitudes[i, 0], 0))
                    B[4, lane], B[5, lane], B[6, lane] = 0.0, 0.0, rho[i]
        else:
            carry(kept.state, S, width)
            carry(kept.body, B, width)
            carry(kept.past, H, width)
        march_block(block, low, stages, steps, frames, outcome, ok)
        for i in range(high - low):
            if outcome.status[i] != 0:
                put(ended[low + i], 0, scaled(block.scale[i], three_in(S, K, i)))
                put(ended[low + i], 3, three_in(S, G, i))
    if n <= width:
        carry(S, kept.state, width)
        carry(H, kept.past, width)
        if frames.follows:
            carry(B, kept.body, width)


def advance_blocks(
    momenta: Matrix, verticals: Matrix, tensors: Matrix, contacts: Vector, q: Matrix, status: Integers, reach: Doubles
):
    """`loop.advance_all` in blocks."""
    S, P = np.empty((ROWS, LANES), momenta.dtype), np.empty((P_ROWS, LANES), momenta.dtype)
    scale, all_lanes = np.empty(LANES, momenta.dtype), np.empty(LANES, dtype=np.int32)
    taken, n = np.zeros(LANES, dtype=np.int64), len(contacts)
    start = Start(momenta, verticals, tensors, contacts)
    for low in range(0, n, LANES):
        high = min(low + LANES, n)
        ok = all_lanes[: registers(high - low)]
        enter(start, low, 1.0, S, scale[: high - low], ok)
        limited(S, S[RADIUS], S[ENOUGH], ok)
        for i in lanes(whole(ok)):
            put_in(P, A, i, (0.0, 0.0, 0.0))
        hopeless, beyond = uncertified(S[RADIUS], ok)
        _, bad = solved(S, P, ok, hopeless, beyond, PATIENCE)
        if bad != 0:
            ends = Ends(taken, status[low:high], reach[low:high])
            mend(S, P, ok, 0, ends)
        for i in lanes(whole(ok)):
            p, k, g = four_in(P, 0, i), three_in(S, K, i), three_in(S, G, i)
            put_in(S, K, i, plus(k, turn(*p, *k)))
            put_in(S, G, i, plus(g, turn(*p, *g)))
            put_four_in(P, 0, i, unit(p))
        for i in range(low, high):
            if status[i] == 0:
                put(momenta[i], 0, scaled(scale[i - low], three_in(S, K, i - low)))
                put(verticals[i], 0, three_in(S, G, i - low))
                put_four(q[i], 0, four_in(P, 0, i - low))
