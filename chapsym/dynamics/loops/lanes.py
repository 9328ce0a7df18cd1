"""Long steps of the continuous ball, columns side by side, of one ball or of eight: vector code.

Lane i first takes the column n = 7 - i, and then the column i where there is one; so the columns 2 to 7 are 7, 6,
5 + 2 and 4 + 3 steps of the map, 7 slots of four.  A lane without a column repeats one, with no weight.  Each number
has a row of its own, in which the lane i of the ball b of B is the i B + b th.  What a lane does depends on its own
ball alone: a settled lane waits for the others unchanged.  So a ball has the same bits alone, in a block, and in plain
Python.

The steps are as long as the error allows, mostly longer than lemma `small-branch` proves; so each is checked on the
spot.  With d the Newton correction of u, e the second one, A⁻¹ = C/det the inverse of the Jacobian at u and
c = ½(I_max - I_min) + |k|, which bounds the quadratic part of G: if |A⁻¹| c |d| ≤ 1/8 the theorem of Newton and
Kantorovich has a root within 1.2|d| of u, |A⁻¹| grows by less than 1.42 on the way to it, and u + d + e is at most
1.42 · 3 |A⁻¹| c max(|d|,|e|)|e| from the root.  Where the lemma holds, the root is that of the small-rotation branch;
beyond, it is the one that Newton's method finds from the rates of the other steps.
"""

from math import sqrt

from chapsym.generated import angular_velocity, centre_step, compose, turn

from .fitted import fitted, half_angle, turn_square
from .gibbs import newton_round, second_round
from .long_step import DOUBT, LAST, MOVING, moved_body
from .text import lanes

#: Columns side by side, and balls in a block.
LANES, EIGHT = 4, 8
#: The most columns that fit: 2, ..., 7.
MOST_COLUMNS = 6
#: A guess has weights for ω and two derivatives, and for the last three Gibbs vectors of its column ...
DERIVATIVES = 3
TERMS = DERIVATIVES + 3
#: ... and that of the first step of a lane's second column for ω, its derivatives, and the first steps of the others.
FIRST_TERMS = DERIVATIVES + LANES + 1
#: All numbers are in one array, so that the loops see that nothing overlaps.  Rows of the lanes: k, γ, u, the two
#: before it, the quaternion and the way of the centre so far, half the step, its inverse, c², the lemma's radius²,
#: (what may be left of u / 4.26)², I and D, K and γ, ω and its derivatives at the beginning, (h|ω|)²,
#: the weights of the guess, a quaternion of the step, whether it is open, and whether its ball is lost: the safe way
#: takes it.
K, G, U, V, X, Q, Y, HALF, INVERSE, SLOPE, WITHIN, LEAST = 0, 3, 6, 9, 12, 15, 19, 22, 23, 24, 25, 26
BALL, START, VERTICAL, OMEGA, RATE, CURVE, TURNED, WEIGHT, P, OPEN, LOST = 27, 31, 34, 37, 40, 43, 46, 47, 53, 57, 58
#: Rows of the lanes that a run does not change: half a step of the first column that is not fitted, its inverse, its
#: |k|, the lemma's radius², LEAST and 1/n²; the same of the second; the weights of both in the sum and in the
#: differences that the last three columns make, and those of the first guess; and ½(I_max - I_min).
FIRSTS, SECONDS, FULL, CHANGE, GUESS, SPREAD, TANGENT = 59, 65, 71, 73, 79, 82, 83
#: The rate of each lane's first step, the quaternion and the way of the column that it has finished first, and sums.
KEPT, DONE, SUMS = 84, 87, 94
#: Rows of the balls, one number each: `long_step.MOVING`, half a long step, the radius, J and D, whether it rests, and
#: the rate of the first step of the largest second column.
MOVED = SUMS + 11
LENGTH, RADIUS, TENSOR = MOVED + MOVING, MOVED + MOVING + 1, MOVED + MOVING + 2
CONTACT, RESTS, LATER = MOVED + MOVING + 5, MOVED + MOVING + 6, MOVED + MOVING + 7
ROWS = MOVED + MOVING + 10
#: (|A⁻¹| c |d|)² may be this: Kantorovich's number, 2|A⁻¹|c|d|, is then at most 1/4.
KANTOROVICH = 1.0 / 64.0
#: Rounds of a slot that are tried before the long step is left to the safe way.
MOST_ROUNDS = 6


def checked(S, B, again):
    """Two Newton iterates, or one `again`, and a second correction in every lane; returns how many are open.

    A lane that has settled before stays as it is.
    """
    for i in lanes(LANES * B):
        k1, k2, k3, g1, g2, g3 = S[K, i], S[K + 1, i], S[K + 2, i], S[G, i], S[G + 1, i], S[G + 2, i]
        u1, u2, u3 = S[U, i], S[U + 1, i], S[U + 2, i]
        I1, I2, I3, contact = S[BALL, i], S[BALL + 1, i], S[BALL + 2, i], S[BALL + 3, i]
        if not again:
            r = newton_round(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, contact)
            u1, u2, u3 = r.w1, r.w2, r.w3
        r = newton_round(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, contact)
        p1, p2, p3, w1, w2, w3, second = second_round(r, k1, k2, k3, I1, I2, I3)
        squares = (r.c11 * r.c11 + r.c12 * r.c12 + r.c13 * r.c13) + (r.c21 * r.c21 + r.c22 * r.c22 + r.c23 * r.c23)
        p0, first = r.p0, r.first
        bent = S[SLOPE, i] * (squares + (r.c31 * r.c31 + r.c32 * r.c32 + r.c33 * r.c33))  # (p0 c |A⁻¹|)²
        settled = (p0 > 0.0) & (w1 * w1 + (w2 * w2 + w3 * w3) <= S[WITHIN, i])
        settled = settled & (bent * first <= KANTOROVICH * (p0 * p0))
        settled = settled & (bent * (max(first, second) * second) <= S[LEAST, i] * (p0 * p0))
        closed = again & (S[OPEN, i] == 0.0)
        S[P, i], S[P + 1, i] = S[P, i] if closed else p0, S[P + 1, i] if closed else p1
        S[P + 2, i], S[P + 3, i] = S[P + 2, i] if closed else p2, S[P + 3, i] if closed else p3
        S[U, i], S[U + 1, i] = S[U, i] if closed else w1, S[U + 1, i] if closed else w2
        S[U + 2, i] = S[U + 2, i] if closed else w3
        S[OPEN, i] = 0.0 if closed | settled | (S[LOST, i] != 0.0) else 1.0
    left = 0
    for i in lanes(LANES * B):
        left += 1 if S[OPEN, i] != 0.0 else 0
    return left


def moved(S, B, traced):
    """Turns k and γ of every lane, carries its quaternion on by (1, u), and guesses the next u.

    traced: whether its centre moves, too, in the axes of the body at the beginning of the long step.
    """
    for i in lanes(LANES * B):
        p0, p1, p2, p3 = S[P, i], S[P + 1, i], S[P + 2, i], S[P + 3, i]
        w1, w2, w3 = S[U, i], S[U + 1, i], S[U + 2, i]
        if traced:
            scale = 1.0 / (1.0 + (w1 * w1 + (w2 * w2 + w3 * w3)))
            s1, s2, s3 = centre_step(1.0, w1, w2, w3, S[G, i], S[G + 1, i], S[G + 2, i])
            s1, s2, s3 = scale * s1, scale * s2, scale * s3
            x1, x2, x3 = turn(S[Q, i], -S[Q + 1, i], -S[Q + 2, i], -S[Q + 3, i], s1, s2, s3)
            S[Y, i] += s1 + x1
            S[Y + 1, i] += s2 + x2
            S[Y + 2, i] += s3 + x3
        x1, x2, x3 = turn(p0, p1, p2, p3, S[K, i], S[K + 1, i], S[K + 2, i])
        S[K, i] += x1
        S[K + 1, i] += x2
        S[K + 2, i] += x3
        x1, x2, x3 = turn(p0, p1, p2, p3, S[G, i], S[G + 1, i], S[G + 2, i])
        S[G, i] += x1
        S[G + 1, i] += x2
        S[G + 2, i] += x3
        S[Q, i], S[Q + 1, i], S[Q + 2, i], S[Q + 3, i] = compose(
            S[Q, i], S[Q + 1, i], S[Q + 2, i], S[Q + 3, i], 1.0, w1, w2, w3
        )
        v1, v2, v3, x1, x2, x3 = S[V, i], S[V + 1, i], S[V + 2, i], S[X, i], S[X + 1, i], S[X + 2, i]
        S[V, i], S[V + 1, i], S[V + 2, i], S[X, i], S[X + 1, i], S[X + 2, i] = w1, w2, w3, v1, v2, v3
        d, e, f = S[WEIGHT, i], S[WEIGHT + 1, i], S[WEIGHT + 2, i]
        a, b, c = S[WEIGHT + 3, i], S[WEIGHT + 4, i], S[WEIGHT + 5, i]
        tangent = S[TANGENT, i]
        y1 = (d * S[OMEGA, i] + e * S[RATE, i]) + f * S[CURVE, i]
        y2 = (d * S[OMEGA + 1, i] + e * S[RATE + 1, i]) + f * S[CURVE + 1, i]
        y3 = (d * S[OMEGA + 2, i] + e * S[RATE + 2, i]) + f * S[CURVE + 2, i]
        S[U, i] = (a * w1 + b * v1) + (c * x1 + tangent * y1)
        S[U + 1, i] = (a * w2 + b * v2) + (c * x2 + tangent * y2)
        S[U + 2, i] = (a * w3 + b * v3) + (c * x3 + tangent * y3)


def begin(S, B):
    """Puts its first column into every lane, with the first guess."""
    for i in lanes(LANES * B):
        start(S, i, FIRSTS)
        tangent, a, b, c = S[TANGENT, i], S[GUESS, i], S[GUESS + 1, i], S[GUESS + 2, i]
        S[U, i] = tangent * ((a * S[OMEGA, i] + b * S[RATE, i]) + c * S[CURVE, i])
        S[U + 1, i] = tangent * ((a * S[OMEGA + 1, i] + b * S[RATE + 1, i]) + c * S[CURVE + 1, i])
        S[U + 2, i] = tangent * ((a * S[OMEGA + 2, i] + b * S[RATE + 2, i]) + c * S[CURVE + 2, i])


def begin_second(S, B, lane, weights):
    """Puts its second column into a lane of every ball."""
    for b in lanes(B):
        start(S, lane * B + b, SECONDS)
    w0, w1, w2, w3, w4, w5, w6, w7 = (
        weights[lane, 0], weights[lane, 1], weights[lane, 2], weights[lane, 3],
        weights[lane, 4], weights[lane, 5], weights[lane, 6], weights[lane, 7],
    )  # fmt: skip
    for b in lanes(B):  # not a loop of the components: eight balls would be unrolled, and not become vector code
        i, j, k, m = b, B + b, 2 * B + b, 3 * B + b
        tangent = S[TANGENT, lane * B + b]
        x1 = (w0 * S[OMEGA, i] + w1 * S[RATE, i]) + (w2 * S[CURVE, i] + w3 * S[KEPT, i])
        x2 = (w0 * S[OMEGA + 1, i] + w1 * S[RATE + 1, i]) + (w2 * S[CURVE + 1, i] + w3 * S[KEPT + 1, i])
        x3 = (w0 * S[OMEGA + 2, i] + w1 * S[RATE + 2, i]) + (w2 * S[CURVE + 2, i] + w3 * S[KEPT + 2, i])
        x1 += (w4 * S[KEPT, j] + w5 * S[KEPT, k]) + (w6 * S[KEPT, m] + w7 * S[LATER, i])
        x2 += (w4 * S[KEPT + 1, j] + w5 * S[KEPT + 1, k]) + (w6 * S[KEPT + 1, m] + w7 * S[LATER + 1, i])
        x3 += (w4 * S[KEPT + 2, j] + w5 * S[KEPT + 2, k]) + (w6 * S[KEPT + 2, m] + w7 * S[LATER + 2, i])
        S[U, lane * B + b], S[U + 1, lane * B + b], S[U + 2, lane * B + b] = tangent * x1, tangent * x2, tangent * x3


def start(S, i, at):
    """Puts a lane to the start of a column, of which the rows from `at` have the numbers, and fits its step."""
    scale = fitted(S[TURNED, i] * S[at + 5, i])
    half, slope = S[at, i] * scale, S[SPREAD, i] + S[at + 2, i] * scale
    bend = half_angle(S[TURNED, i] * S[at + 5, i])
    S[TANGENT, i] = half / bend
    S[HALF, i], S[INVERSE, i], S[SLOPE, i] = half, S[at + 1, i] * bend / scale, slope * slope
    S[WITHIN, i], S[LEAST, i] = S[at + 3, i], S[at + 4, i] * (scale * scale)
    S[K, i], S[K + 1, i], S[K + 2, i] = half * S[START, i], half * S[START + 1, i], half * S[START + 2, i]
    S[G, i], S[G + 1, i], S[G + 2, i] = S[VERTICAL, i], S[VERTICAL + 1, i], S[VERTICAL + 2, i]
    S[V, i], S[V + 1, i], S[V + 2, i], S[X, i], S[X + 1, i], S[X + 2, i] = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    S[Q, i], S[Q + 1, i], S[Q + 2, i], S[Q + 3, i] = 1.0, 0.0, 0.0, 0.0
    S[Y, i], S[Y + 1, i], S[Y + 2, i] = 0.0, 0.0, 0.0


def finish(S, i):
    """Keeps the quaternion and the way of the first column of a lane."""
    S[DONE, i], S[DONE + 1, i], S[DONE + 2, i], S[DONE + 3, i] = S[Q, i], S[Q + 1, i], S[Q + 2, i], S[Q + 3, i]
    S[DONE + 4, i], S[DONE + 5, i], S[DONE + 6, i] = S[Y, i], S[Y + 1, i], S[Y + 2, i]


def gather(S, B):
    """Turns every ball by the weighted sum of the columns, but those that are lost."""
    for i in lanes(LANES * B):
        a0, a1, a2, a3 = S[DONE, i], S[DONE + 1, i], S[DONE + 2, i], S[DONE + 3, i]
        b0, b1, b2, b3 = S[Q, i], S[Q + 1, i], S[Q + 2, i], S[Q + 3, i]
        one = 1.0 / sqrt((a0 * a0 + a1 * a1) + (a2 * a2 + a3 * a3))
        two = 1.0 / sqrt((b0 * b0 + b1 * b1) + (b2 * b2 + b3 * b3))
        w, v = S[FULL, i] * one, S[FULL + 1, i] * two
        S[SUMS, i], S[SUMS + 1, i] = w * a0 + v * b0, w * a1 + v * b1
        S[SUMS + 2, i], S[SUMS + 3, i] = w * a2 + v * b2, w * a3 + v * b3
        w, v = S[CHANGE, i] * one, S[CHANGE + 1, i] * two
        S[SUMS + 4, i], S[SUMS + 5, i] = w * a0 + v * b0, w * a1 + v * b1
        S[SUMS + 6, i], S[SUMS + 7, i] = w * a2 + v * b2, w * a3 + v * b3
        w, v = S[FULL, i], S[FULL + 1, i]
        S[SUMS + 8, i] = w * S[DONE + 4, i] + v * S[Y, i]
        S[SUMS + 9, i] = w * S[DONE + 5, i] + v * S[Y + 1, i]
        S[SUMS + 10, i] = w * S[DONE + 6, i] + v * S[Y + 2, i]
    for c in range(11):
        for b in lanes(B):
            S[SUMS + c, b] = (S[SUMS + c, b] + S[SUMS + c, B + b]) + (S[SUMS + c, 2 * B + b] + S[SUMS + c, 3 * B + b])
    for b in lanes(B):
        rests = S[LOST, b] != 0.0
        k1, k2, k3, g1, g2, g3 = (
            S[MOVED, b],
            S[MOVED + 1, b],
            S[MOVED + 2, b],
            S[MOVED + 3, b],
            S[MOVED + 4, b],
            S[MOVED + 5, b],
        )
        a0, a1, a2, a3, x, y = (
            S[MOVED + 6, b],
            S[MOVED + 7, b],
            S[MOVED + 8, b],
            S[MOVED + 9, b],
            S[MOVED + 10, b],
            S[MOVED + 11, b],
        )
        d0, d1, d2, d3 = S[SUMS + 4, b], S[SUMS + 5, b], S[SUMS + 6, b], S[SUMS + 7, b]
        more = 2.0 * sqrt((d0 * d0 + d1 * d1) + (d2 * d2 + d3 * d3))
        l1, l2, l3, h1, h2, h3, b0, b1, b2, b3, v, w = moved_body(
            k1, k2, k3, g1, g2, g3, a0, a1, a2, a3, x, y, S[SUMS, b], S[SUMS + 1, b], S[SUMS + 2, b], S[SUMS + 3, b],
            S[SUMS + 8, b], S[SUMS + 9, b], S[SUMS + 10, b], S[RADIUS, b],
        )  # fmt: skip
        S[MOVED, b], S[MOVED + 1, b], S[MOVED + 2, b] = k1 if rests else l1, k2 if rests else l2, k3 if rests else l3
        S[MOVED + 3, b], S[MOVED + 4, b] = g1 if rests else h1, g2 if rests else h2
        S[MOVED + 5, b] = g3 if rests else h3
        S[MOVED + 6, b], S[MOVED + 7, b] = a0 if rests else b0, a1 if rests else b1
        S[MOVED + 8, b], S[MOVED + 9, b] = a2 if rests else b2, a3 if rests else b3
        S[MOVED + 10, b], S[MOVED + 11, b] = x if rests else v, y if rests else w
        S[MOVED + DOUBT, b] += 0.0 if rests else more


def rates(S, B, first):
    """K, γ, ω and two derivatives in units of the long step, (2.12) and (2.13), of every ball in all its lanes."""
    for b in lanes(B):
        K1, K2, K3, g1, g2, g3 = (
            S[MOVED, b],
            S[MOVED + 1, b],
            S[MOVED + 2, b],
            S[MOVED + 3, b],
            S[MOVED + 4, b],
            S[MOVED + 5, b],
        )
        J1, J2, J3, contact = S[TENSOR, b], S[TENSOR + 1, b], S[TENSOR + 2, b], S[CONTACT, b]
        w1, w2, w3 = angular_velocity(K1, K2, K3, g1, g2, g3, J1, J2, J3, contact)
        # K = Λω - D⟨γ,ω⟩γ turns, and so does γ: B(γ)ω̇ = (K + D⟨γ,ω⟩γ) × ω.
        height = contact * (g1 * w1 + g2 * w2 + g3 * w3)
        m1, m2, m3 = K1 + height * g1, K2 + height * g2, K3 + height * g3
        x1, x2, x3 = m2 * w3 - m3 * w2, m3 * w1 - m1 * w3, m1 * w2 - m2 * w1
        a1, a2, a3 = angular_velocity(x1, x2, x3, g1, g2, g3, J1, J2, J3, contact)
        # B(γ)ω̈ = Λω̇ × ω + Λω × ω̇ + D(⟨γ̇,ω̇⟩γ + ⟨γ,ω̇⟩γ̇).
        d1, d2, d3 = g2 * w3 - g3 * w2, g3 * w1 - g1 * w3, g1 * w2 - g2 * w1
        along, across = contact * (d1 * a1 + d2 * a2 + d3 * a3), contact * (g1 * a1 + g2 * a2 + g3 * a3)
        n1, n2, n3 = (S[BALL, b] + contact) * a1, (S[BALL + 1, b] + contact) * a2, (S[BALL + 2, b] + contact) * a3
        x1 = ((n2 * w3 - n3 * w2) + (m2 * a3 - m3 * a2)) + (along * g1 + across * d1)
        x2 = ((n3 * w1 - n1 * w3) + (m3 * a1 - m1 * a3)) + (along * g2 + across * d2)
        x3 = ((n1 * w2 - n2 * w1) + (m1 * a2 - m2 * a1)) + (along * g3 + across * d3)
        x1, x2, x3 = angular_velocity(x1, x2, x3, g1, g2, g3, J1, J2, J3, contact)
        whole = 2.0 * S[LENGTH, b]
        square = whole * whole
        S[START, b], S[START + 1, b], S[START + 2, b] = K1, K2, K3
        S[VERTICAL, b], S[VERTICAL + 1, b], S[VERTICAL + 2, b] = g1, g2, g3
        S[OMEGA, b], S[OMEGA + 1, b], S[OMEGA + 2, b] = w1, w2, w3
        S[RATE, b], S[RATE + 1, b], S[RATE + 2, b] = whole * a1, whole * a2, whole * a3
        S[CURVE, b], S[CURVE + 1, b], S[CURVE + 2, b] = square * x1, square * x2, square * x3
        S[TURNED, b] = turn_square(whole, first, w1, w2, w3)
        S[LATER, b], S[LATER + 1, b], S[LATER + 2, b], S[LOST, b] = 0.0, 0.0, 0.0, S[RESTS, b]
    for row in range(START, TURNED + 1):
        for b in lanes(B):
            one = S[row, b]
            S[row, B + b], S[row, 2 * B + b], S[row, 3 * B + b] = one, one, one
    for b in lanes(B):
        one = S[LOST, b]
        S[LOST, B + b], S[LOST, 2 * B + b], S[LOST, 3 * B + b] = one, one, one


def side_by_side(S, B, columns, traced, following, beginning):
    """One long step of every ball in place but of those that get lost; returns whether one is."""
    first, second = LAST + 1 - columns, LAST - LANES  # the largest of the second columns
    rates(S, B, first)
    begin(S, B)
    lost = False
    for slot in range(LAST):
        lane = LAST - slot
        if lane < LANES:  # it has finished its first column, n = slot
            for b in lanes(B):
                finish(S, lane * B + b)
        if lane == 3 and first <= 3:
            begin_second(S, B, 3, beginning)
        elif lane == 2 and first <= 2:
            begin_second(S, B, 2, beginning)
        for j in range(TERMS):
            for c in range(LANES):
                weight = following[slot, j, c]
                for b in lanes(B):
                    S[WEIGHT + j, c * B + b] = weight
        left, rounds = checked(S, B, False), 0
        while left > 0 and rounds < MOST_ROUNDS:
            left, rounds = checked(S, B, True), rounds + 1
        if left > 0:
            lost = True
            lose(S, B)
            if B == 1:
                return True
        if traced:  # two loops: one would compute the centre in any case
            moved(S, B, True)
        else:
            moved(S, B, False)
        if slot == 0:
            for i in lanes(LANES * B):
                S[KEPT, i], S[KEPT + 1, i] = S[V, i] * S[INVERSE, i], S[V + 1, i] * S[INVERSE, i]
                S[KEPT + 2, i] = S[V + 2, i] * S[INVERSE, i]
        elif lane == second and lane < LANES:
            for b in lanes(B):
                i = lane * B + b
                S[LATER, b], S[LATER + 1, b] = S[V, i] * S[INVERSE, i], S[V + 1, i] * S[INVERSE, i]
                S[LATER + 2, b] = S[V + 2, i] * S[INVERSE, i]
    for b in lanes(B):
        finish(S, b)
    gather(S, B)
    return lost


def lose(S, B):
    """Marks all lanes of every ball of which one is open, and closes them."""
    for b in lanes(B):
        is_open = (S[OPEN, b] + S[OPEN, B + b]) + (S[OPEN, 2 * B + b] + S[OPEN, 3 * B + b]) != 0.0
        for lane in range(LANES):
            S[LOST, lane * B + b] = 1.0 if is_open else S[LOST, lane * B + b]
