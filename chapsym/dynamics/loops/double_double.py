"""Double-double: a step, many steps of one ball or of a block of balls, and long steps of the continuous ball.

A step is the float64 root, corrected once by a residual in double-double (pairs).  Let w be a float64 Gibbs vector near
the root of G(u) = B(γ)u + u × Iu - (1 + |u|²)k, found by a Newton correction d, and A the float64 Jacobian before d.
G(w) in pairs is accurate to rounding of its terms, so e = -A⁻¹G(w) is the error of w to a few parts in 2⁵³, except for
the change of the Jacobian: by `gibbs-newton` its effect is exactly 2b(d, e) + b(e, e), b the quadratic part of G, and a
second solution subtracts it.  There remain (c|d|)², below 2⁻⁵³ if d converged (`loops.gibbs`), and the rounding error
of A⁻¹, each times |e|.  So if |e| is a few rounding errors of w, (w, e) has the error of a pair times the condition of
A; otherwise the rotation of w + e is corrected again, in Euler parameters (`polished`).

𝒦, γ, the attitude and the contact point are pairs, and need no compensation; the integrals are restored periodically.
A composition takes its stages one after the other.  A block has `LANES` balls, as in `block`; the bits of each lane are
those of its ball alone.

Long steps extrapolate the attitude and the contact point from n steps of the map.  K and γ are fixed in space: before
each long step the attitude rotates both into the body.  So their integrals are conserved to rounding, for any number of
steps.
"""

from math import frexp, ldexp, sqrt
from typing import NamedTuple

import numpy as np

from chapsym.generated import angular_velocity, centre_step, compose, gibbs_residual, residual, rotate, turn
from chapsym.numbers.loose import Loose, Normal, square_root
from chapsym.numbers.pairs import subtract, two_sum

from .block import carry
from .branch import FOLDED, NOT_CONVERGED, TAKEN, inverse, moments, product, small_rotation
from .gibbs import BEYOND, MOST_ROUNDS, certificate, correction, newton_round
from .integrals import PERIOD, filtered, shares
from .loop import HIGHEST
from .path import search_on_path
from .proved import G_OFF, K_OFF, carried, exact, unit_pairs, write_spread
from .records import Ends, Frames, Moving, Start, Steps, Track
from .text import Integers, Matrix, Vector, lanes, out_of_line
from .vectors import (
    conjugate,
    dot,
    dot_four,
    largest,
    length,
    minus,
    plus,
    put,
    put_in,
    scaled,
    shifted,
    square,
    square_of_four,
    three,
    three_in,
)

#: |e|²/|w|² above which the sum is corrected again: 8 rounding errors of float64.
SMALL = 2.0**-100
#: The most corrections in pairs: at a fold convergence is slow.
MOST_CORRECTIONS = 60
#: Corrections of q, relative to |q|: the rounding error of a pair; and the size below which they may stop decreasing.
ROUNDING, FLOOR = 2.0**-104, 2.0**-60
#: The largest correction at an apparent fold, which rounding may cause near the root; and elsewhere.
BESIDE_FOLD, ANYWHERE = 1e-6, 0.1
#: The substitute for q₀ = 0, a rotation by π, which has no Gibbs vector; its error is less than rounding.
LEAST_COSINE = 2.0**-110
#: Above this fraction of 𝒦 a fold of the float64 continuation may be an effect of rounding.
NEARLY = 1.0 - 2.0**-45
#: Scaled momenta are at least 2^LEAST: no product underflows, and terms nonlinear in 𝒦 are relatively below 2^-200.
LEAST = -200
#: For a moment of inertia below this, at Λmax about 1, the determinant underflows: every step uses `small_rotation`.
SMALLEST = 2.0**-120


def pair(array, at):
    """The pair at `at` of an array, its high half first."""
    return Loose(array[at], array[at + 1])


def put_pair(array, at, x):
    """Writes a pair into an array."""
    array[at], array[at + 1] = x.high, x.low


def three_pairs(array, at):
    """Three pairs of an array, from `at` on."""
    return pair(array, at), pair(array, at + 2), pair(array, at + 4)


def put_pairs(array, at, v):
    """Writes three pairs into an array."""
    put_pair(array, at, v[0])
    put_pair(array, at + 2, v[1])
    put_pair(array, at + 4, v[2])


def pairs_in(S, at, i):
    """Three pairs of a lane, from the row `at` on."""
    return Loose(S[at, i], S[at + 1, i]), Loose(S[at + 2, i], S[at + 3, i]), Loose(S[at + 4, i], S[at + 5, i])


def put_pairs_in(S, at, i, v):
    """Writes three pairs into a lane, from the row `at` on."""
    put_in(S, at, i, (v[0].high, v[0].low, v[1].high))
    put_in(S, at + 3, i, (v[1].low, v[2].high, v[2].low))


def summed(v, w):
    """v + w for vectors of floats, as pairs."""
    return Loose(*two_sum(v[0], w[0])), Loose(*two_sum(v[1], w[1])), Loose(*two_sum(v[2], w[2]))


def highs(v):
    """The high halves of a vector of pairs."""
    return v[0].high, v[1].high, v[2].high


def lows(v):
    """The low halves of a vector of pairs."""
    return v[0].low, v[1].low, v[2].low


def normalised(v):
    """A vector of pairs, normalised: the low halves are rounding errors of the high halves."""
    return v[0].normalised(), v[1].normalised(), v[2].normalised()


def normalised_four(q):
    """Four pairs, normalised."""
    return q[0].normalised(), q[1].normalised(), q[2].normalised(), q[3].normalised()


def of_length_one(q):
    """A quaternion of length near 1, divided by its length: one Newton step."""
    t = (3 - square_of_four(q)) / 2
    return t * q[0], t * q[1], t * q[2], t * q[3]


def scales(momentum, tensor, contact):
    """Exponents (shift, beyond): k = 2^shift 𝒦, exactly, for Λmax about 1; tiny momenta are scaled up by 2^beyond."""
    _, exponent = frexp(max(*moments(three(tensor, 0))) + contact)
    most = largest(three(momentum, 0))
    _, size = frexp(most)
    exponent = max(exponent, size - HIGHEST)  # k does not overflow
    beyond = max(0, LEAST - (size - exponent)) if most > 0.0 else 0
    return beyond - exponent - 1, beyond


def bounds(k, I, D):
    """(radius², enough) by `gibbs.certificate`; radius² = -1 if every step must use `small_rotation`."""
    if min(*I) < SMALLEST:
        return -1.0, 0.0
    return certificate(k, I, D)


def approach(u, k, g, I, D, radius, enough):
    """The last round of Newton's iteration in float64."""
    r = newton_round(u, k, g, I, D)
    for _ in range(MOST_ROUNDS - 1):
        if r.first <= enough or radius < 0.0:
            break
        r = newton_round(r.w if square(r.w) <= radius else (0.0, 0.0, 0.0), k, g, I, D)
    return r


def small(w, e):
    """Whether e is at most 8 rounding errors of w."""
    return square(e) <= SMALL * square(w)


def polished(p, k, g, J, D, near):
    """Newton's iteration in pairs from a float64 rotation near the root: (settled, u as pairs).

    Euler parameters are regular at every rotation.  The residual is computed in pairs after each correction: so heavy
    balls keep their digits, too, where a single correction by a float64 Jacobian loses a factor D/I.  The branch has
    det > 0 up to its fold, and its continuation beyond the fold det < 0: det ≤ 0 or a correction above `near` means
    another branch.
    """
    K, v, floats = sums_normal(plus(k, k)), sums_normal(g), highs(g)
    q, before, settled = (Loose(p[0], 0.0), Loose(p[1], 0.0), Loose(p[2], 0.0), Loose(p[3], 0.0)), near, False
    for _ in range(MOST_CORRECTIONS):
        r = residual(Normal(q[0].high, q[0].low), *sums_normal(q[1:4]), *K, *v, *exact(J), Loose(D))
        det, n = inverse((q[0].high, *highs(q[1:4])), floats, J, D)
        if not det > 0.0:
            break
        w = product(n, (r[0].normalised().high, r[1].normalised().high, r[2].normalised().high))
        q = normalised_four(of_length_one(compose(*q, 1, Loose(-w[0]), Loose(-w[1]), Loose(-w[2]))))
        change, extent = largest(w), largest(highs(q[1:4]))
        if change > near:
            break
        # The last correction is at the rounding level of pairs, or, for bad condition, no longer decreases.
        settled = change <= ROUNDING * extent or (change <= FLOOR * extent and change >= 0.25 * before)
        if settled:
            break
        before = change
    cosine = q[0]
    if cosine.high == 0.0:
        cosine = Loose(LEAST_COSINE, q[0].low)
    return settled, (q[1] / cosine, q[2] / cosine, q[3] / cosine)


def sums_normal(v):
    """A vector of pairs whose sums are normalised."""
    return Normal(v[0].high, v[0].low), Normal(v[1].high, v[1].low), Normal(v[2].high, v[2].low)


def solved(u, k, g, I, J, D, radius, enough):
    """The Gibbs vector of a step, from a guess u, with k, γ and I in pairs: (status, reach, u as pairs)."""
    floats, vertical, inertia, zero = highs(k), highs(g), highs(I), Loose(0.0, 0.0)
    r = approach(u if square(u) <= radius else (0.0, 0.0, 0.0), floats, vertical, inertia, D, radius, enough)
    settled, w, status, reach = radius >= 0.0 and r.first <= enough, r.w, TAKEN, 1.0
    if settled:
        G = gibbs_residual(*exact(w), *k, *g, *I, Loose(D))
        left = G[0].normalised().high, G[1].normalised().high, G[2].normalised().high
        e = correction(r.p[0], r.d, r.cofactors, left, floats, inertia)
        if small(w, e):
            return TAKEN, 1.0, summed(w, e)
        p = rotation_of(plus(w, e))
    else:
        if radius == BEYOND:
            settled, p, w = search_on_path(u, floats, vertical, inertia, D)
        if settled:
            p = rotation_of(w)
        else:
            status, reach, p0, p1, p2, p3 = small_rotation(*scaled(2.0, floats), *vertical, *J, D)
            p = p0, p1, p2, p3
        # So near to 1 only pairs can decide on which side of the fold 𝒦 is.
        if status != TAKEN and not (status == FOLDED and reach > NEARLY):
            return status, reach, (zero, zero, zero)
    settled, found = polished(p, k, g, J, D, BESIDE_FOLD if status == FOLDED else ANYWHERE)
    if settled:
        return TAKEN, 1.0, found
    return FOLDED if status == FOLDED else NOT_CONVERGED, reach, (zero, zero, zero)


def rotation_of(w):
    """The Euler parameters of a Gibbs vector."""
    p0 = 1.0 / sqrt(1.0 + square(w))
    return p0, p0 * w[0], p0 * w[1], p0 * w[2]


#: The rows of the state of a ball: k = 𝒦/2, γ and I as pairs (high, low, high, ...), J, D, and the three integrals as
#: pairs.
K, G, I, J, D, INTEGRALS = 0, 6, 12, 18, 21, 22
ROWS = 28


@out_of_line
def prepare_pairs(
    momentum: Vector, g: Vector, tensor: Vector, contact: float, c: Matrix, state: Vector, limits: Matrix
):
    """Writes the initial state of a ball and the limits of its stages; returns the exponents of `scales`."""
    shift, beyond = scales(momentum, tensor, contact)
    size = beyond - shift - 1
    for i in range(3):
        state[K + 2 * i], state[K + 2 * i + 1] = ldexp(momentum[i], shift), 0.0
        state[J + i] = ldexp(tensor[i], -size)
    state[D] = ldexp(contact, -size)
    put_pairs(state, G, unit_pairs(three(g, 0)))
    state[I], state[I + 1] = two_sum(state[J + 1], state[J + 2])
    state[I + 2], state[I + 3] = two_sum(state[J], state[J + 2])
    state[I + 4], state[I + 5] = two_sum(state[J], state[J + 1])
    remember_pairs(state)
    for i in range(c.shape[0]):
        k, inertia = scaled(c[i, 0], highs(three_pairs(state, K))), highs(three_pairs(state, I))
        limits[0, i], limits[1, i] = bounds(k, inertia, state[D])
    return shift, beyond


def remember_pairs(state):
    """Writes ⟨γ,γ⟩, ⟨k,γ⟩ and ⟨k,k⟩ into the state."""
    k, g = three_pairs(state, K), three_pairs(state, G)
    put_pairs(state, INTEGRALS, normalised((dot(g, g), dot(k, g), dot(k, k))))


@out_of_line
def restore_pairs(state):
    """Corrects k and γ to the three integrals, up to rounding; otherwise these drift by u² at each step.

    Returns the relative changes of γ and k.
    """
    k, g = three_pairs(state, K), three_pairs(state, G)
    h, now = three_pairs(state, INTEGRALS), normalised((dot(g, g), dot(k, g), dot(k, k)))
    unit, _ = subtract(h[0].high, h[0].low, now[0].high, now[0].low)
    height, _ = subtract(h[1].high, h[1].low, now[1].high, now[1].low)
    squared, _ = subtract(h[2].high, h[2].low, now[2].high, now[2].low)
    stretch, along_k, along_gamma = shares(unit, height, squared, h[0].high, h[1].high, h[2].high)
    for i in range(0, 6, 2):
        x, y = pair(state, K + i), pair(state, G + i)
        put_pair(state, K + i, Loose(*two_sum(x.high, x.low + (along_k * x.high + along_gamma * y.high))))
        put_pair(state, G + i, Loose(*two_sum(y.high, y.low + stretch * y.high)))
    return abs(stretch), abs(along_k) + abs(along_gamma) / max(length(highs(k)), 1e-300)


def extrapolated(past, w):
    """Adds the newest Gibbs vector of a stage to its filter (8, 3), whose first row is the next guess."""
    for c, x in ((0, w[0]), (1, w[1]), (2, w[2])):
        (
            past[0, c], past[1, c], past[2, c], past[3, c], past[4, c], past[5, c], past[6, c], past[7, c]
        ) = filtered(past[1, c], past[2, c], past[3, c], past[4, c], past[5, c], past[6, c], past[7, c], x)  # fmt: skip


def stage(state, c, radius, enough, past):
    """The Gibbs vector of a stage with the coefficient c, a pair, as `solved` returns it; updates the filter."""
    k, g, inertia = normalised(scaled(c, three_pairs(state, K))), three_pairs(state, G), three_pairs(state, I)
    status, reach, u = solved(three(past[0], 0), k, g, inertia, three(state, J), state[D], radius, enough)
    if status == TAKEN:
        extrapolated(past, highs(u))
    return status, reach, u


def rolled(u, g, a, x, y, rho):
    """The attitude a and the contact point (x, y), in pairs, after the step by u from the vertical g."""
    q0 = 1.0 / square_root(dot(u, u) + 1.0)
    q = scaled(q0, u)
    d1, d2, _ = rotate(*a, *centre_step(q0, *q, *g))
    turned = normalised_four(of_length_one(compose(*a, q0, *q)))
    return turned, (x + Loose(rho) * d1).normalised(), (y + Loose(rho) * d2).normalised()


def follow_body(u, state, attitude, contact, rho):
    """Moves the attitude (8) and the contact point (4), pairs, by the step with the Gibbs vector u."""
    a = pair(attitude, 0), pair(attitude, 2), pair(attitude, 4), pair(attitude, 6)
    b, x, y = rolled(u, three_pairs(state, G), a, pair(contact, 0), pair(contact, 2), rho)
    put_pair(attitude, 0, b[0])
    put_pairs(attitude, 2, b[1:4])
    put_pair(contact, 0, x)
    put_pair(contact, 2, y)


def turned(u, v):
    """The vector v of pairs, turned by the step with the Gibbs vector u."""
    return normalised(plus(v, turn(1, *u, *v)))


def write(frame, frame_, pairs, at, exponent):
    """Writes 2^exponent times the pairs from `at` on into the high and low halves of a frame."""
    for i in range(frame.shape[0]):
        frame[i], frame_[i] = ldexp(pairs[at + 2 * i], exponent), ldexp(pairs[at + 2 * i + 1], exponent)


class Proof(NamedTuple):
    """The proof of a run: m and radius² of each stage, (s, 2), and the present set of ξ, (`proved.ROWS`).

    spread (frames, 4), or (0, 4) without proof: bounds for the distance of the exact orbit, from `write_spread`.
    """

    slopes: Matrix
    box: Vector
    spread: Matrix


def march_pairs(ball: Moving, c: Matrix, steps: Steps, shift: int, beyond: int, track: Track, low: Track, proof: Proof):
    """`loop.march` in pairs with the stages c, (s, 2); shift and beyond are those of `scales`, low: the low halves.

    The state has ROWS numbers, the attitude 8, the contact point 4; past has 8 rows for each stage.
    """
    state, slopes, box, proves = ball.state, proof.slopes, proof.box, proof.spread.shape[0] > 0
    period = max(1, PERIOD // c.shape[0])
    for step in range(steps.first + 1, steps.last + 1):
        for i in range(c.shape[0]):
            past = ball.past[8 * i : 8 * i + 8]
            status, reach, u = stage(state, Loose(c[i, 0], c[i, 1]), ball.limits[0, i], ball.limits[1, i], past)
            if status != TAKEN:
                return step - 1 - steps.first, status, reach
            if proves:
                k, g, inertia = three_pairs(state, K), three_pairs(state, G), three_pairs(state, I)
                part = normalised(scaled(Loose(c[i, 0], c[i, 1]), k))
                carried(box, u, part, g, inertia, state[D], slopes[i, 0], slopes[i, 1])
            if track.follows:
                follow_body(u, state, ball.attitude, ball.contact, ball.radius)
            put_pairs(state, K, turned(u, three_pairs(state, K)))
            put_pairs(state, G, turned(u, three_pairs(state, G)))
        if step % period == 0:
            stretched, moved = restore_pairs(state)
            if proves:
                box[K_OFF], box[G_OFF] = box[K_OFF] + 2.0 * moved, box[G_OFF] + 2.0 * stretched
        if step % steps.every == 0:
            frame = step // steps.every
            if proves:
                write_spread(proof.spread[frame], box)
            write(track.momenta[frame], low.momenta[frame], state, K, -shift)
            write(track.verticals[frame], low.verticals[frame], state, G, 0)
            if track.follows:
                write(track.attitudes[frame], low.attitudes[frame], ball.attitude, 0, 0)
                write(track.traces[frame], low.traces[frame], ball.contact, 0, -beyond)
    return steps.last - steps.first, TAKEN, 1.0


#: The balls in a block: its rows stay in the first-level cache.
LANES = 16
#: The most float64 iterates that all lanes take together while one of them needs another.
ROUNDS = 4
#: The rows after those of the single ball: the filter of the Gibbs vector, radius² and enough.
A, RADIUS, ENOUGH = ROWS, ROWS + 24, ROWS + 25
ALL_ROWS = ROWS + 26
#: Rows of the workspace: w, the last correction d, det and cofactors before it, the residual, the correction e.
W, DELTA, DET, C, R, E = 0, 3, 6, 7, 16, 19
WORK_ROWS = 22


def approached(S, P, ok, again):
    """A Newton iterate in float64 for every lane, from the guess or, if `again`, from w; returns how many need more."""
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
    """Writes the residual G at every lane's w, computed in pairs."""
    for i in lanes(LANES):
        w, contact = exact(three_in(P, W, i)), Loose(S[D, i])
        k, g, inertia = pairs_in(S, K, i), pairs_in(S, G, i), pairs_in(S, I, i)
        put_in(P, R, i, highs(normalised(gibbs_residual(*w, *k, *g, *inertia, contact))))


def corrected(S, P, ok):
    """Writes the correction e of every lane; returns the number not converged."""
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
def mend(S, P, ok, step, ends):
    """`stage` for the lanes not converged; a ball without a rotation rests from then on."""
    for i in range(LANES):
        if ok[i] == 1:
            continue
        put_in(P, W, i, (0.0, 0.0, 0.0))
        put_in(P, E, i, (0.0, 0.0, 0.0))
        if i < len(ends.status) and ends.status[i] == TAKEN:
            s, one = S[:, i].copy(), Loose(1.0, 0.0)
            ends.status[i], ends.reach[i], u = stage(s, one, s[RADIUS], s[ENOUGH], s[A:RADIUS].reshape((8, 3)))
            if ends.status[i] == TAKEN:
                put_in(P, W, i, highs(u))
                put_in(P, E, i, lows(u))
                continue
            ends.taken[i] = step
        S[RADIUS, i] = -1.0


def extrapolated_in(S, row, i, w):
    """Updates the filter of one component in a lane."""
    (
        S[row, i], S[row + 3, i], S[row + 6, i], S[row + 9, i],
        S[row + 12, i], S[row + 15, i], S[row + 18, i], S[row + 21, i],
    ) = filtered(
        S[row + 3, i], S[row + 6, i], S[row + 9, i], S[row + 12, i], S[row + 15, i], S[row + 18, i], S[row + 21, i], w
    )  # fmt: skip


def all_turned(S, P):
    """Turns k and γ of every lane, and updates the extrapolation."""
    for i in lanes(LANES):
        w, e = three_in(P, W, i), three_in(P, E, i)
        u = summed(w, e)
        put_pairs_in(S, K, i, turned(u, pairs_in(S, K, i)))
        put_pairs_in(S, G, i, turned(u, pairs_in(S, G, i)))
        extrapolated_in(S, A, i, w[0] + e[0])
        extrapolated_in(S, A + 1, i, w[1] + e[1])
        extrapolated_in(S, A + 2, i, w[2] + e[2])


def prepare_pairs_block(start: Start, c: Matrix, state: Matrix, shift: Integers, beyond: Integers):
    """`prepare_pairs` for each ball of a block; spare lanes repeat the last ball."""
    one, limits, last = np.empty(ROWS), np.empty((2, 1)), len(start.contact) - 1
    for lane in range(state.shape[1]):
        i = min(lane, last)
        shift[i], beyond[i] = prepare_pairs(
            start.momentum[i], start.gamma[i], start.tensor[i], start.contact[i], c, one, limits
        )
        for row in range(RADIUS):
            state[row, lane] = one[row] if row < ROWS else 0.0
        state[RADIUS, lane], state[ENOUGH, lane] = limits[0, 0], limits[1, 0]


def march_pairs_block(state: Matrix, steps: Steps, shift: Integers, frames: Frames, low: Frames, ends: Ends):
    """`march_pairs` for a block of balls: state (ALL_ROWS, LANES).

    shift and the ends have one entry for each ball; lanes beyond these are idle copies.
    """
    status = ends.status
    S, P, ok = np.empty((ALL_ROWS, LANES)), np.empty((WORK_ROWS, LANES)), np.empty(LANES, dtype=np.int64)
    carry(state, S, LANES)
    for step in range(steps.first, steps.last):
        bad, rounds = approached(S, P, ok, False), 1
        while bad != 0 and rounds < ROUNDS:
            bad, rounds = approached(S, P, ok, True), rounds + 1
        residuals(S, P)
        if corrected(S, P, ok) != 0:
            mend(S, P, ok, step, ends)
        all_turned(S, P)
        if (step + 1) % PERIOD == 0:
            for i in range(LANES):
                one = S[:ROWS, i].copy()
                restore_pairs(one)
                for row in range(ROWS):
                    S[row, i] = one[row]
        if (step + 1) % steps.every == 0:
            frame = (step + 1) // steps.every
            for i in range(len(status)):
                if status[i] == TAKEN:
                    one = S[:, i].copy()
                    write(frames.momenta[i, frame], low.momenta[i, frame], one, K, -int(shift[i]))
                    write(frames.verticals[i, frame], low.verticals[i, frame], one, G, 0)
    for i in range(len(status)):
        if status[i] == TAKEN:
            ends.taken[i] = steps.last
    carry(S, state, LANES)


#: The n of the first column; the next columns have n + 1, n + 2, ...
FIRST = 3
#: log₂ of the longest step, in units where the momentum and the ball are about 1; longer steps have no rotation.
LONGEST = 100


def rotated(a, v):
    """The vector v of pairs, rotated by the attitude a."""
    return normalised(rotate(*a, *v))


def column(k, g, a, n, state, radius, enough, rho):
    """n steps of the map from k, γ and the attitude a: (status, reach, a, x, y); state: has I, J and D."""
    inertia, tensor, contact = three_pairs(state, I), three(state, J), state[D]
    x, y = Loose(0.0, 0.0), Loose(0.0, 0.0)
    u = angular_velocity(*highs(k), *highs(g), *tensor, contact)
    v, status, reach = u, TAKEN, 1.0  # v: the Gibbs vector of the step before
    for _ in range(n):
        status, reach, w = solved(u, k, g, inertia, tensor, contact, radius, enough)
        if status != TAKEN:
            break
        a, x, y = rolled(w, g, a, x, y, rho)
        k, g = turned(w, k), turned(w, g)
        u, v = minus(scaled(2.0, highs(w)), v), highs(w)
    return status, reach, a, x, y


def with_share(total, weight, x):
    """The pair total + weight · x."""
    return (total + (weight * x).normalised()).normalised()


def with_shares(total, weight, q):
    """total + weight · q for four pairs."""
    return (
        with_share(total[0], weight, q[0]), with_share(total[1], weight, q[1]),
        with_share(total[2], weight, q[2]), with_share(total[3], weight, q[3]),
    )  # fmt: skip


class Still(NamedTuple):
    """A ball at step 0 of long steps: K, γ and the attitude in pairs, (8); J, D and the radius."""

    momentum: Vector
    gamma: Vector
    attitude: Vector
    tensor: Vector
    contact: float
    radius: float


def march_long_pairs(
    ball: Still, h: float, h_: float, weights: Matrix, steps: Steps, body: Vector, track: Track, low: Track
):
    """Takes long steps h, a pair, of a ball.

    body: pairs, the present attitude and contact point (12), updated.  low: the low halves.
    weights: pairs, for the columns n = FIRST, ..., and for the change by the last column, (columns, 4).
    Returns (taken, status, reach, doubt); doubt is the accumulated size of these changes.
    """
    columns, doubt, zero = weights.shape[0], 0.0, Loose(0.0, 0.0)
    state, one, limits = np.zeros(ROWS), np.zeros((1, 2)), np.zeros((2, columns))
    one[0, 0] = 1.0
    # K is scaled to about 1, and the exponent of h is kept separately, to avoid overflow and underflow.
    _, size = frexp(largest(three(ball.momentum, 0)))
    mantissa, exponent = frexp(h)
    k, part = shifted(three(ball.momentum, 0), -size), np.zeros(3)
    put(part, 0, shifted(k, min(size + exponent, 1000)))
    shift, beyond = prepare_pairs(part, ball.gamma, ball.tensor, ball.contact, one, state, limits)
    half = ldexp(mantissa, min(size + exponent + shift, LONGEST))
    half_ = ldexp(ldexp(h_, -exponent), min(size + exponent + shift, LONGEST))
    for j in range(columns):
        limits[0, j], limits[1, j] = bounds(scaled(half / (FIRST + j), k), highs(three_pairs(state, I)), state[D])
    a = pair(ball.attitude, 0), pair(ball.attitude, 2), pair(ball.attitude, 4), pair(ball.attitude, 6)
    K_, g_ = rotated(a, (Loose(k[0], 0.0), Loose(k[1], 0.0), Loose(k[2], 0.0))), rotated(a, three_pairs(state, G))
    a, x, y = (pair(body, 0), pair(body, 2), pair(body, 4), pair(body, 6)), pair(body, 8), pair(body, 10)
    for step in range(steps.first, steps.last):
        sums, changes, x_, y_ = (zero, zero, zero, zero), (zero, zero, zero, zero), zero, zero
        k_body, g_body = rotated(conjugate(a), K_), rotated(conjugate(a), g_)
        for j in range(columns):
            n = FIRST + j
            f = Loose(half, half_) / Loose(n * 1.0)
            status, reach, p, s, t = column(
                normalised(scaled(f, k_body)), g_body, a, n, state, limits[0, j], limits[1, j], ball.radius
            )
            if status != TAKEN:
                return step - steps.first, status, reach, doubt
            weight, change = Loose(weights[j, 0], weights[j, 1]), Loose(weights[j, 2], weights[j, 3])
            sums, x_, y_ = with_shares(sums, weight, p), with_share(x_, weight, s), with_share(y_, weight, t)
            changes = with_shares(changes, change, p)
        length = square_root(dot_four(sums, sums))
        a = sums[0] / length, sums[1] / length, sums[2] / length, sums[3] / length
        x, y = (x + x_).normalised(), (y + y_).normalised()
        put_pair(body, 0, a[0])
        put_pairs(body, 2, a[1:4])
        put_pair(body, 8, x)
        put_pair(body, 10, y)
        doubt = doubt + 2.0 * sqrt(square_of_four((changes[0].high, *highs(changes[1:4]))))
        if (step + 1) % steps.every == 0:
            frame = (step + 1) // steps.every
            put_pairs(state, K, rotated(conjugate(a), K_))
            put_pairs(state, G, rotated(conjugate(a), g_))
            write(track.momenta[frame], low.momenta[frame], state, K, size)
            write(track.verticals[frame], low.verticals[frame], state, G, 0)
            if track.follows:
                write(track.attitudes[frame], low.attitudes[frame], body, 0, 0)
                write(track.traces[frame], low.traces[frame], body, 8, -beyond)
    return steps.last - steps.first, TAKEN, 1.0, doubt
