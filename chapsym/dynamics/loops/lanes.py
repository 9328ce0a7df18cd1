"""Long steps of the continuous ball by extrapolation, with parallel columns, for one or eight balls, as vector code.

Lane i first computes the column n = 7 - i, and then the column i, if it exists: so the columns 2 to 7 are 7, 6, 5 + 2
and 4 + 3 steps of the map, in 7 slots of four.  A lane without a column repeats one, with weight 0.  Each variable has
a row, in which lane i of ball b of B is at i B + b.  The computation in a lane depends on its ball alone; a converged
lane waits for the others unchanged.  So a ball has the same bits alone, in a block, and in plain Python.

The steps are as long as the error permits, mostly longer than the bound of lemma `small-branch`; so each is verified.
Let d be the Newton correction of u, e the second one, A⁻¹ = C/det the inverse of the Jacobian at u, and
c = ½(I_max - I_min) + |k|, which bounds the quadratic part of G.  If |A⁻¹| c |d| ≤ 1/8, then by the Newton-Kantorovich
theorem there is a root within 1.2|d| of u, |A⁻¹| grows by less than 1.42 on the way to it, and u + d + e is at most
1.42 · 3 |A⁻¹| c max(|d|,|e|)|e| from the root.  Where the lemma holds, the root is on the small-rotation branch; beyond
it, the root is the one that Newton's method finds from the rates of the other steps.

The safe way (`long_step`) uses rotations of the small-rotation branch, proved or continued from the identity.

Steps of the map are fitted: in steady rotation the ball turns by the same angle as the continuous ball.  By lemmas
`steady` and `steady-branch` a step of length s turns it by θ with sin θ = s|ω|.  So the step for the time h has the
length s = sin(h|ω|)/|ω|, which is h times an even function of h: the rotation of n steps is still an even series.  In
lemma `modified-field` this removes the term 2|ω|²ω of 12ω₃, up to the change of |ω| in the long step.
"""

from math import frexp, ldexp, nan, sqrt
from typing import NamedTuple

import numpy as np

from chapsym.generated import angular_velocity, centre_step, compose, gibbs_newton, gibbs_newton_heavy, rotate, turn

from . import loop
from .block import carry
from .branch import NOT_CONVERGED
from .gibbs import LEFT, LIGHTEST, bound, certificate, is_heavy, round_from, second_round, settle
from .records import Balls, Ends, Frames, Steps
from .text import Cube, Matrix, lanes, out_of_line
from .vectors import (
    conjugate,
    cross,
    dot,
    four,
    four_in,
    largest,
    length,
    minus,
    mixed,
    plus,
    plus_four,
    put,
    put_four,
    put_four_in,
    put_in,
    scaled,
    scaled_four,
    shifted,
    square,
    square_of_four,
    three,
    three_in,
)  # fmt: skip

#: The last column; the first is LAST + 1 - columns: more columns are better than longer steps of the map.
LAST = 7
#: log₂ of the longest step, in units where the momentum and the ball are about 1; longer steps have no rotation.
LONGEST = 100
#: The number of changes: the weights have a row for the columns, and then three for the changes by the last columns.
CHANGES = 3
#: The layout of the state of a ball: K, γ, the attitude, the contact point, and the accumulated doubt.  Of the last
#: step: the changes of the rotation by the last three columns, as vectors in the axes at its end; and the change of the
#: contact point by the last one, in radii.
MOMENTUM, GAMMA, ATTITUDE, SPOT, DOUBT, TWIST, SLIP = 0, 3, 6, 10, 12, 13, 22
MOVING = 24
#: 1.5²: steps that would turn the ball by nearly a right angle, where the branch has a fold, are not fitted.
MOST_TURN = 2.25
#: The parallel columns, and the balls in a block.
LANES, EIGHT = 4, 8
#: The most columns: 2, ..., 7.
MOST_COLUMNS = 6
#: A guess has weights for ω and two derivatives, and for the last three Gibbs vectors of its column.
DERIVATIVES = 3
TERMS = DERIVATIVES + 3
#: The guess for the first step of a second column has weights for ω, its derivatives, and the first steps of the
#: others.
FIRST_TERMS = DERIVATIVES + LANES + 1
#: All numbers are in one array, so that compilers see no aliasing.  Rows of the lanes: k, γ, u, the two Gibbs vectors
#: before it, the quaternion and the path of the centre so far, half the step, its inverse, c², the lemma's radius²,
#: (the permitted error of u / 4.26)², I and D, K and γ, ω and its derivatives at the start, (h|ω|)², the weights of the
#: guess, a quaternion of the step, whether it is open (not converged), and whether its ball is lost (left to the safe
#: way).
K, G, U, V, X, Q, Y, HALF, INVERSE, SLOPE, WITHIN, LEAST = 0, 3, 6, 9, 12, 15, 19, 22, 23, 24, 25, 26
BALL, START, VERTICAL, OMEGA, RATE, CURVE, TURNED, WEIGHT, P, OPEN, LOST = 27, 31, 34, 37, 40, 43, 46, 47, 53, 57, 58
#: Constant rows of the lanes: half an unfitted step of the first column, its inverse, its |k|, the lemma's radius²,
#: LEAST and 1/n²; the same of the second column; the weights of both in the sum and in the changes by the last three
#: columns, and those of the first guess; and ½(I_max - I_min).
FIRSTS, SECONDS, FULL, CHANGE, GUESS, SPREAD, TANGENT = 59, 65, 71, 73, 79, 82, 83
#: The rate of each lane's first step, the quaternion and the path of its first finished column, and sums.
KEPT, DONE, SUMS = 84, 87, 94
#: Rows of the balls, one number for each ball: `lanes.MOVING`, half a long step, the radius, J and D, whether it rests,
#: and the rate of the first step of the largest second column.
MOVED = SUMS + 11
LENGTH, RADIUS, TENSOR = MOVED + MOVING, MOVED + MOVING + 1, MOVED + MOVING + 2
CONTACT, RESTS, LATER = MOVED + MOVING + 5, MOVED + MOVING + 6, MOVED + MOVING + 7
#: The row that marks the lanes of heavy balls (`gibbs.is_heavy`).
HEAVY = MOVED + MOVING + 10
ROWS = HEAVY + 1
#: The largest (|A⁻¹| c |d|)²: the Kantorovich number 2|A⁻¹|c|d| is then at most 1/4.
KANTOROVICH = 1.0 / 64.0
#: The most rounds of a slot before the long step is left to the safe way.
MOST_ROUNDS = 6
#: The value of radius² where the lemma has none: no condition.
ANYWHERE = 2.0**1000
#: (1.42 · 3)².
BEHIND = 18.2


class Weights(NamedTuple):
    """Weights: of the columns and of the changes by the last three, (1 + CHANGES, columns); of guesses (`guess`)."""

    sums: Matrix
    following: Cube
    beginning: Matrix


def iterate(u, k, g, I, D, heavy, one_is_heavy):
    """A Newton iterate from u, with the stable determinant if the ball is heavy."""
    found = gibbs_newton(*u, *k, *g, *I, D)
    det = found[0]
    if one_is_heavy:
        stable = gibbs_newton_heavy(*u, *k, *g, *I, D)
        det = stable[0] if heavy else det
    return round_from(u, (det, *found[1:13]))


def checked(S, B, again, one_is_heavy):
    """Two Newton iterates (one if `again`) and a second correction in every open lane; returns how many stay open."""
    for i in lanes(LANES * B):
        u, k, g = three_in(S, U, i), three_in(S, K, i), three_in(S, G, i)
        inertia, contact, heavy = three_in(S, BALL, i), S[BALL + 3, i], S[HEAVY, i] != 0.0
        if not again:
            r = iterate(u, k, g, inertia, contact, heavy, one_is_heavy)
            u = r.w
        r = iterate(u, k, g, inertia, contact, heavy, one_is_heavy)
        p, w, second = second_round(r, k, inertia)
        c = r.cofactors
        squares = dot(c[0:3], c[0:3]) + dot(c[3:6], c[3:6])
        p0, first = p[0], r.first
        bent = S[SLOPE, i] * (squares + dot(c[6:9], c[6:9]))  # (p0 c |A⁻¹|)²
        settled = (p0 > 0.0) & (square(w) <= S[WITHIN, i])
        settled = settled & (bent * first <= KANTOROVICH * (p0 * p0))
        settled = settled & (bent * (max(first, second) * second) <= S[LEAST, i] * (p0 * p0))
        closed = again & (S[OPEN, i] == 0.0)
        put_four_in(S, P, i, four_in(S, P, i) if closed else p)
        put_in(S, U, i, three_in(S, U, i) if closed else w)
        S[OPEN, i] = 0.0 if closed | settled | (S[LOST, i] != 0.0) else 1.0
    left = 0
    for i in lanes(LANES * B):
        left += 1 if S[OPEN, i] != 0.0 else 0
    return left


def looked_for(S, B, again, one_is_heavy):
    """`checked`, with a cheaper loop if no ball is heavy."""
    if one_is_heavy:
        return checked(S, B, again, True)
    return checked(S, B, again, False)


def moved(S, B, traced):
    """Turns k and γ of every lane, updates its quaternion, and its centre if `traced`, and guesses the next u."""
    for i in lanes(LANES * B):
        p, q, w, k, g = four_in(S, P, i), four_in(S, Q, i), three_in(S, U, i), three_in(S, K, i), three_in(S, G, i)
        if traced:
            s = scaled(1.0 / (1.0 + square(w)), centre_step(1.0, *w, *g))
            put_in(S, Y, i, plus(three_in(S, Y, i), plus(s, turn(*conjugate(q), *s))))
        put_in(S, K, i, plus(k, turn(*p, *k)))
        put_in(S, G, i, plus(g, turn(*p, *g)))
        put_four_in(S, Q, i, compose(*q, 1.0, *w))
        v, x = three_in(S, V, i), three_in(S, X, i)
        put_in(S, V, i, w)
        put_in(S, X, i, v)
        d, e, f = three_in(S, WEIGHT, i)
        a, b, c = three_in(S, WEIGHT + 3, i)
        y = scaled(S[TANGENT, i], expanded(S, i, d, e, f))
        put_in(S, U, i, plus(plus(scaled(a, w), scaled(b, v)), plus(scaled(c, x), y)))


def expanded(S, i, a, b, c):
    """The combination of ω and its derivatives at the start with these weights."""
    return plus(
        plus(scaled(a, three_in(S, OMEGA, i)), scaled(b, three_in(S, RATE, i))), scaled(c, three_in(S, CURVE, i))
    )


def begin(S, B):
    """Starts the first column of every lane, with the first guess."""
    for i in lanes(LANES * B):
        start(S, i, FIRSTS)
        put_in(S, U, i, scaled(S[TANGENT, i], expanded(S, i, *three_in(S, GUESS, i))))


def begin_second(S, B, lane, weights):
    """Starts the second column of a lane of every ball."""
    for b in lanes(B):
        start(S, lane * B + b, SECONDS)
    w0, w1, w2, w3 = four(weights[lane], 0)
    w4, w5, w6, w7 = four(weights[lane], 4)
    for b in lanes(B):  # no loop over components: compilers would unroll the eight balls, and not vectorise
        omega, rate, curve = three_in(S, OMEGA, b), three_in(S, RATE, b), three_in(S, CURVE, b)
        first, second, later = three_in(S, KEPT, b), three_in(S, KEPT, B + b), three_in(S, LATER, b)
        third, fourth = three_in(S, KEPT, 2 * B + b), three_in(S, KEPT, 3 * B + b)
        x = plus(plus(scaled(w0, omega), scaled(w1, rate)), plus(scaled(w2, curve), scaled(w3, first)))
        y = plus(plus(scaled(w4, second), scaled(w5, third)), plus(scaled(w6, fourth), scaled(w7, later)))
        put_in(S, U, lane * B + b, scaled(S[TANGENT, lane * B + b], plus(x, y)))


def start(S, i, at):
    """Sets a lane to the start of the column in the rows from `at` on, and fits its step."""
    scale = fitted(S[TURNED, i] * S[at + 5, i])
    half, slope = S[at, i] * scale, S[SPREAD, i] + S[at + 2, i] * scale
    bend = half_angle(S[TURNED, i] * S[at + 5, i])
    S[TANGENT, i] = half / bend
    S[HALF, i], S[INVERSE, i], S[SLOPE, i] = half, S[at + 1, i] * bend / scale, slope * slope
    S[WITHIN, i], S[LEAST, i] = S[at + 3, i], S[at + 4, i] * (scale * scale)
    put_in(S, K, i, scaled(half, three_in(S, START, i)))
    put_in(S, G, i, three_in(S, VERTICAL, i))
    put_in(S, V, i, (0.0, 0.0, 0.0))
    put_in(S, X, i, (0.0, 0.0, 0.0))
    put_four_in(S, Q, i, (1.0, 0.0, 0.0, 0.0))
    put_in(S, Y, i, (0.0, 0.0, 0.0))


def finish(S, i):
    """Stores the quaternion and the path of the first column of a lane."""
    put_four_in(S, DONE, i, four_in(S, Q, i))
    put_in(S, DONE + 4, i, three_in(S, Y, i))


def gather(S, B):
    """Turns every ball that is not lost by the weighted sum of its columns."""
    for i in lanes(LANES * B):
        a, b = four_in(S, DONE, i), four_in(S, Q, i)
        one, two = 1.0 / sqrt(square_of_four(a)), 1.0 / sqrt(square_of_four(b))
        w, v = S[FULL, i], S[FULL + 1, i]
        put_four_in(S, SUMS, i, mixed(w * one, a, v * two, b))
        put_four_in(S, SUMS + 4, i, mixed(S[CHANGE, i] * one, a, S[CHANGE + 1, i] * two, b))
        put_in(S, SUMS + 8, i, plus(scaled(w, three_in(S, DONE + 4, i)), scaled(v, three_in(S, Y, i))))
    for c in range(11):
        for b in lanes(B):
            S[SUMS + c, b] = (S[SUMS + c, b] + S[SUMS + c, B + b]) + (S[SUMS + c, 2 * B + b] + S[SUMS + c, 3 * B + b])
    for b in lanes(B):
        rests = S[LOST, b] != 0.0
        k, g, a = three_in(S, MOVED, b), three_in(S, MOVED + 3, b), four_in(S, MOVED + 6, b)
        x, y = S[MOVED + 10, b], S[MOVED + 11, b]
        more = 2.0 * sqrt(square_of_four(four_in(S, SUMS + 4, b)))
        l, h, c, v, w = moved_body(k, g, a, x, y, four_in(S, SUMS, b), three_in(S, SUMS + 8, b), S[RADIUS, b])
        put_in(S, MOVED, b, k if rests else l)
        put_in(S, MOVED + 3, b, g if rests else h)
        put_four_in(S, MOVED + 6, b, a if rests else c)
        S[MOVED + 10, b], S[MOVED + 11, b] = x if rests else v, y if rests else w
        S[MOVED + DOUBT, b] += 0.0 if rests else more


def rates(S, B, first):
    """Writes K, γ, ω and two derivatives in units of the long step, (2.12) and (2.13), into all lanes of each ball."""
    for b in lanes(B):
        K, g, J, contact = three_in(S, MOVED, b), three_in(S, MOVED + 3, b), three_in(S, TENSOR, b), S[CONTACT, b]
        w = angular_velocity(*K, *g, *J, contact)
        # From K = Λω - D⟨γ,ω⟩γ, K̇ = K × ω, γ̇ = γ × ω: B(γ)ω̇ = (K + D⟨γ,ω⟩γ) × ω.
        m = plus(K, scaled(contact * dot(g, w), g))
        a = angular_velocity(*cross(m, w), *g, *J, contact)
        # B(γ)ω̈ = Λω̇ × ω + Λω × ω̇ + D(⟨γ̇,ω̇⟩γ + ⟨γ,ω̇⟩γ̇).
        d = cross(g, w)
        n = (S[BALL, b] + contact) * a[0], (S[BALL + 1, b] + contact) * a[1], (S[BALL + 2, b] + contact) * a[2]
        x = plus(scaled(contact * dot(d, a), g), scaled(contact * dot(g, a), d))
        x = angular_velocity(*plus(plus(cross(n, w), cross(m, a)), x), *g, *J, contact)
        whole = 2.0 * S[LENGTH, b]
        put_in(S, START, b, K)
        put_in(S, VERTICAL, b, g)
        put_in(S, OMEGA, b, w)
        put_in(S, RATE, b, scaled(whole, a))
        put_in(S, CURVE, b, scaled(whole * whole, x))
        S[TURNED, b] = turn_square(whole, first, w)
        put_in(S, LATER, b, (0.0, 0.0, 0.0))
        S[LOST, b] = S[RESTS, b]
    for row in range(START, TURNED + 1):
        for b in lanes(B):
            one = S[row, b]
            S[row, B + b], S[row, 2 * B + b], S[row, 3 * B + b] = one, one, one
    for b in lanes(B):
        one = S[LOST, b]
        S[LOST, B + b], S[LOST, 2 * B + b], S[LOST, 3 * B + b] = one, one, one


def side_by_side(S, B, traced, weights):
    """One long step of every ball, in place, except those that are lost; returns whether one is lost."""
    columns = weights.sums.shape[1]
    first, second = LAST + 1 - columns, LAST - LANES  # the largest of the second columns
    rates(S, B, first)
    begin(S, B)
    lost, one_is_heavy = False, False
    for b in range(B):
        one_is_heavy = one_is_heavy or S[HEAVY, b] != 0.0
    for slot in range(LAST):
        lane = LAST - slot
        if lane < LANES:  # the lane has finished its first column, n = slot
            for b in lanes(B):
                finish(S, lane * B + b)
        if lane == 3 and first <= 3:
            begin_second(S, B, 3, weights.beginning)
        elif lane == 2 and first <= 2:
            begin_second(S, B, 2, weights.beginning)
        for j in range(TERMS):
            for c in range(LANES):
                weight = weights.following[slot, j, c]
                for b in lanes(B):
                    S[WEIGHT + j, c * B + b] = weight
        left, rounds = looked_for(S, B, False, one_is_heavy), 0
        while left > 0 and rounds < MOST_ROUNDS:
            left, rounds = looked_for(S, B, True, one_is_heavy), rounds + 1
        if left > 0:
            lost = True
            lose(S, B)
            if B == 1:
                return True
        if traced:  # two loops, as a single one would always compute the centre
            moved(S, B, True)
        else:
            moved(S, B, False)
        if slot == 0:
            for i in lanes(LANES * B):
                put_in(S, KEPT, i, scaled(S[INVERSE, i], three_in(S, V, i)))
        elif lane == second and lane < LANES:
            for b in lanes(B):
                i = lane * B + b
                put_in(S, LATER, b, scaled(S[INVERSE, i], three_in(S, V, i)))
    for b in lanes(B):
        finish(S, b)
    gather(S, B)
    return lost


def lose(S, B):
    """Marks all lanes of every ball with an open lane as lost."""
    for b in lanes(B):
        is_open = (S[OPEN, b] + S[OPEN, B + b]) + (S[OPEN, 2 * B + b] + S[OPEN, 3 * B + b]) != 0.0
        for lane in range(LANES):
            S[LOST, lane * B + b] = 1.0 if is_open else S[LOST, lane * B + b]


def turn_square(h, first, w):
    """(h|ω|)² for a long step h, or 0 if its steps, the longest of which is h/`first`, are not fitted."""
    turned = h * h * square(w)
    return turned if turned <= MOST_TURN * (first * first) else 0.0


def fitted(square):
    """(sin x)/x by its Taylor polynomial up to x¹²: the error is 3e-10 at x = 1.5, and rounding for x ≤ 0.5."""
    fourth = square * square
    last = (1.0 / 362880.0 - square * (1.0 / 39916800.0)) + fourth * (1.0 / 6227020800.0)
    return ((1.0 - square * (1.0 / 6.0)) + fourth * (1.0 / 120.0 - square * (1.0 / 5040.0))) + fourth * fourth * last


def half_angle(square):
    """cos²(x/2) by its Taylor polynomial up to x⁸: x (sin x)/x over twice this is tan(x/2)."""
    fourth = square * square
    return (1.0 - square * 0.25) + fourth * ((1.0 / 48.0 - square * (1.0 / 1440.0)) + fourth * (1.0 / 80640.0))


def begun(body, J0, D0, h, state):
    """Scales K of `body` to about 1, and writes the ball into `state`: (half a long step there, K's exponent)."""
    none = np.zeros(3)
    _, size = frexp(loop.entered(none, none, J0, D0, state))
    _, exponent = frexp(largest(three(body, 0)))
    put(body, 0, shifted(three(body, 0), -exponent))
    mantissa, shift = frexp(0.5 * h)
    return ldexp(mantissa, min(shift + exponent - (size - 2), LONGEST)), exponent


def column(body, half, n, square, state):
    """The unit quaternion of n fitted steps of the map from K and γ of `body`.

    Each step has 𝒦 = (2 half K/n) · `fitted`(`turn_square`/n²).
    state (`loop.ROWS`) has J, I and D; the rest is workspace.  Returns (status, reach, q, y), y the path of the centre
    in radii, in the axes of the body at the start.
    """
    k = scaled(half / n * fitted(square * (1.0 / (n * n))), three(body, MOMENTUM))
    g, inertia, contact = three(body, GAMMA), three(state, loop.I), state[loop.D]
    state[loop.RADIUS], state[loop.ENOUGH] = certificate(k, inertia, contact)
    u = angular_velocity(*k, *g, *three(state, loop.J), contact)
    v = u  # the Gibbs vector of the step before
    q, y = (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for _ in range(n):
        settled, p, w = settle(u, k, g, inertia, contact, state[loop.RADIUS], state[loop.ENOUGH])
        if not settled:
            put(state, loop.K, k)
            put(state, loop.G, g)
            status, reach, p, w = loop.safe_rotation(w, state)
            if status != 0:
                return status, reach, q, y
        size = square_of_four(p)
        if not size > 0.0:
            return NOT_CONVERGED, 0.0, q, y
        unit = scaled_four(1.0 / sqrt(size), p)
        y = plus(y, rotate(*q, *centre_step(*unit, *g)))
        k, g = plus(k, turn(*p, *k)), plus(g, turn(*p, *g))
        q = compose(*q, *unit)
        u, v = minus(scaled(2.0, w), v), w
    return 0, 1.0, q, y


def long_step(body, half, radius, sums, state):
    """One long step of `body` (MOVING) in place: (status, reach); nothing is written unless the status is 0."""
    q, y, z = (0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    changes = np.zeros((CHANGES, 4))
    w = angular_velocity(*three(body, MOMENTUM), *three(body, GAMMA), *three(state, loop.J), state[loop.D])
    first = LAST + 1 - sums.shape[1]
    square = turn_square(2.0 * half, first, w)
    for i in range(sums.shape[1]):
        status, reach, p, s = column(body, half, first + i, square, state)
        if status != 0:
            return status, reach
        q, y = plus_four(q, scaled_four(sums[0, i], p)), plus(y, scaled(sums[0, i], s))
        z = plus(z, scaled(sums[1, i], s))
        for c in range(CHANGES):
            put_four(changes[c], 0, plus_four(four(changes[c], 0), scaled_four(sums[1 + c, i], p)))
    body[SLIP], body[SLIP + 1], _ = rotate(*four(body, ATTITUDE), *z)
    k, g, a, body[SPOT], body[SPOT + 1] = moved_body(
        three(body, MOMENTUM), three(body, GAMMA), four(body, ATTITUDE), body[SPOT], body[SPOT + 1], q, y, radius
    )
    put(body, MOMENTUM, k)
    put(body, GAMMA, g)
    put_four(body, ATTITUDE, a)
    for c in range(CHANGES):
        d = four(changes[c], 0)
        if c == 0:
            body[DOUBT] += 2.0 * sqrt(square_of_four(d))
        put(body, TWIST + 3 * c, twist(q, d))
    return 0, 1.0


def twist(q, d):
    """The small rotation vector, in the axes at the end, of a change d of a unit quaternion q."""
    return scaled(2.0, compose(*conjugate(q), *d)[1:4])


def moved_body(k, g, a, x, y, q, s, radius):
    """K and γ turned by the quaternion q of any length, the attitude a ∘ q, and the contact point moved by s."""
    d1, d2, _ = rotate(*a, *s)
    b = compose(*a, *q)
    b = scaled_four(1.0 / sqrt(square_of_four(b)), b)
    return plus(k, turn(*q, *k)), plus(g, turn(*q, *g)), b, x + radius * d1, y + radius * d2


def placed(body, i, frames):
    """Writes the state of the ball i at frame 0 into `body`."""
    body[:] = 0.0
    put(body, 0, three(frames.momenta[i, 0], 0))
    put(body, 3, three(frames.verticals[i, 0], 0))
    body[ATTITUDE] = 1.0
    if frames.follows:
        put_four(body, ATTITUDE, four(frames.attitudes[i, 0], 0))
    if frames.traced:
        body[SPOT], body[SPOT + 1] = frames.traces[i, 0, 0], frames.traces[i, 0, 1]


def shown(body, exponent, i, frame, frames):
    """Writes the state of a ball, with K scaled by 2^exponent, into a frame."""
    put(frames.momenta[i, frame], 0, shifted(three(body, 0), int(exponent)))
    put(frames.verticals[i, frame], 0, three(body, 3))
    if frames.follows:
        put_four(frames.attitudes[i, frame], 0, four(body, ATTITUDE))
    if frames.traced:
        frames.traces[i, frame, 0], frames.traces[i, frame, 1] = body[SPOT], body[SPOT + 1]


def stopped_at(i, frame, frames):
    """Writes NaN into the frames of a ball from `frame` on."""
    frames.momenta[i, frame:] = nan
    frames.verticals[i, frame:] = nan
    if frames.follows:
        frames.attitudes[i, frame:] = nan
    if frames.traced:
        frames.traces[i, frame:] = nan


def taken_out(S, b, body):
    """Copies the present state of a ball from its column of S."""
    for c in range(MOVING):
        body[c] = S[MOVED + c, b]


def put_back(S, b, body):
    """Copies the state of a ball into its column of S."""
    for c in range(MOVING):
        S[MOVED + c, b] = body[c]


@out_of_line
def enter(S, B, b, half, radius, weights, body, state):
    """Puts a ball into the column b of S, `begun` with the half step."""
    put_back(S, b, body)
    S[LENGTH, b], S[RADIUS, b], S[CONTACT, b], S[RESTS, b] = half, radius, state[loop.D], 0.0
    put_in(S, TENSOR, b, three(state, loop.J))
    columns = weights.sums.shape[1]
    least = LAST + 1 - columns
    for lane in range(LANES):
        j, first = lane * B + b, max(LAST - lane, least)
        put_in(S, BALL, j, three(state, loop.I))
        S[BALL + 3, j] = state[loop.D]
        S[HEAVY, j] = 1.0 if is_heavy(three(state, loop.I), state[loop.D]) else 0.0
        one, two = LAST - lane >= least, lane >= least
        for c in range(DERIVATIVES):
            S[GUESS + c, j] = weights.beginning[first, c]
        for c in range(1 + CHANGES):
            S[FULL + 2 * c, j] = weights.sums[c, first - least] if one else 0.0
            S[FULL + 2 * c + 1, j] = weights.sums[c, lane - least] if two else 0.0
    resized(S, B, b, columns, half, body, state)


def resized(S, B, b, columns, half, body, state):
    """Changes the long step of a ball; half: half its length in the unit of S."""
    S[LENGTH, b], least = half, LAST + 1 - columns
    for lane in range(LANES):
        entered(S, FIRSTS, lane * B + b, body, half, max(LAST - lane, least), state)
        entered(S, SECONDS, lane * B + b, body, half, max(lane, least), state)


def entered(S, at, i, body, half, n, state):
    """Writes half a step of a lane and its constants (`FIRSTS`).

    The lemma's radius for the unfitted step is also valid for the fitted one, which is shorter: its root is nearer to
    0, and G is monotone on the same ball.
    """
    part = half / n
    inertia, contact = three(state, loop.I), state[loop.D]
    spread = 0.5 * (max(*inertia) - min(*inertia))
    k = scaled(part, three(body, 0))
    size = length(k)
    within, _ = bound(k, inertia, contact)
    least = LEFT * size / (max(*inertia) + contact + spread)
    # A heavy ball uses the safe way if products would underflow.
    light = is_heavy(inertia, contact) and not (min(*inertia) >= LIGHTEST and size >= LIGHTEST)
    S[at, i], S[at + 1, i], S[at + 2, i], S[SPREAD, i] = part, 1.0 / part if part != 0.0 else 0.0, size, spread
    S[at + 3, i], S[at + 4, i] = -1.0 if light else within if within >= 0.0 else ANYWHERE, least * least / BEHIND
    S[at + 5, i] = 1.0 / (n * n)


@out_of_line
def safely(S, b, sums, state):
    """A long step of one ball by the safe way; returns (status, reach)."""
    body = np.empty(MOVING)
    taken_out(S, b, body)
    status, reach = long_step(body, S[LENGTH, b], S[RADIUS, b], sums, state)
    put_back(S, b, body)
    return status, reach


def march_lanes(B, frames, balls, ends, h, steps, weights, kept):
    """Takes long steps h of at most B balls from their frames 0; kept: the complete state between calls."""
    S, count = np.zeros((ROWS, LANES * B)), ends.status.shape[0]
    states, exponents, body = np.zeros((B, loop.ROWS)), np.zeros(B, dtype=np.int64), np.zeros(MOVING)
    for b in range(B):
        i = min(b, count - 1)  # lanes beyond the balls repeat the last
        placed(body, i, frames)
        half, exponents[b] = begun(body, balls.tensor[i], balls.contact[i], h, states[b])
        enter(S, B, b, half, balls.radius[i], weights, body, states[b])
    if steps.first > 0:
        carry(kept, S, LANES * B)
        for b in range(B):
            for row in range(loop.ROWS):
                states[b, row] = kept[ROWS + row, b]
    for step in range(steps.first, steps.last):
        if side_by_side(S, B, frames.traced, weights):
            for b in range(B):
                if S[LOST, b] != 0.0 and S[RESTS, b] == 0.0:
                    stopped, reached = safely(S, b, weights.sums, states[b])
                    if stopped != 0:
                        S[RESTS, b] = 1.0
                        if b < count:
                            ends.status[b], ends.reach[b], ends.taken[b] = stopped, reached, step
                            stopped_at(b, step // steps.every + 1, frames)
        if (step + 1) % steps.every == 0:
            for b in range(count):
                if ends.status[b] == 0:
                    taken_out(S, b, body)
                    shown(body, exponents[b], b, (step + 1) // steps.every, frames)
    carry(S, kept[:ROWS], LANES * B)
    for b in range(B):
        for row in range(loop.ROWS):
            kept[ROWS + row, b] = states[b, row]
    for b in range(count):
        if ends.status[b] == 0:
            ends.taken[b], ends.reach[b] = steps.last, 1.0


def march(frames: Frames, balls: Balls, ends: Ends, h: float, steps: Steps, weights: Weights, kept: Matrix):
    """`march_lanes` for eight balls or fewer."""
    march_lanes(EIGHT, frames, balls, ends, h, steps, weights, kept)


def march_alone(frames: Frames, balls: Balls, ends: Ends, h: float, steps: Steps, weights: Weights, kept: Matrix):
    """`march_lanes` for one ball."""
    march_lanes(1, frames, balls, ends, h, steps, weights, kept)
