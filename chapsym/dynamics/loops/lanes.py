"""A long step of the continuous ball, its columns side by side: four lanes in vector code, for numba only.

With the columns n = 2, ..., m lane i first takes the column m - i, and then the column i where there is one; so the
columns 2 to 7 are 7, 6, 5 + 2 and 4 + 3 steps of the map, 7 slots of four.  Each number has a row of its own.

The steps are as long as the error allows, mostly longer than lemma `small-branch` proves; so each is checked on the
spot.  With d the Newton correction of u, e the second one, A⁻¹ = C/det the inverse of the Jacobian at u and
c = ½(I_max - I_min) + |k|, which bounds the quadratic part of G: if |A⁻¹| c |d| ≤ 1/8 the theorem of Newton and
Kantorovich has a root within 1.2|d| of u, |A⁻¹| grows by less than 1.42 on the way to it, and u + d + e is at most
1.42 · 3 |A⁻¹| c max(|d|,|e|)|e| from the root.  Where the lemma holds, the root is that of the small-rotation branch;
beyond, it is the one that Newton's method finds from the rates of the other steps.
"""

from math import sqrt

import numpy as np

from chapsym.generated import angular_velocity, compose, turn

from .gibbs import LEFT, certificate, is_heavy, newton_round, second_round
from .long_step import FIRST, long_step, turn_all
from .loop import D, I, J, put, three

LANES = 4
#: The most columns that fit: 2, ..., 7.
MOST_COLUMNS = 6
SLOTS = MOST_COLUMNS + 1
#: A guess has weights for the last three Gibbs vectors of its column, for ω and for its derivative ...
TERMS = 5
#: ... and that of the first step of a lane's second column for ω, its derivative, and the first steps of the others.
FIRST_TERMS = 2 + LANES + 1
#: Rows of the one array: k, γ, u, the two before it, the quaternion so far, half the step and its inverse, c², the
#: lemma's radius², (what may be left of u / 4.26)², a quaternion of the step, whether it is open, and the weights.
K, G, U, V, X, Q, HALF, INVERSE = 0, 3, 6, 9, 12, 15, 19, 20
SLOPE, WITHIN, LEAST, P, OPEN, WEIGHT = 21, 22, 23, 24, 28, 29
ROWS = WEIGHT + TERMS
#: Where the lemma has no radius, none is asked for.
ANYWHERE = 2.0**1000
#: (|A⁻¹| c |d|)² may be this: Kantorovich's number, 2|A⁻¹|c|d|, is then at most 1/4.
KANTOROVICH = 1.0 / 64.0
#: (1.42 · 3)².
BEHIND = 18.2
#: Rounds of a slot that are tried before the long step is left to the safe way.
MOST_ROUNDS = 6


def checked(S, twice, I1, I2, I3, contact):
    """A Newton iterate, or two if `twice`, and a second correction in every lane; returns whether one is open."""
    for i in range(LANES):
        k1, k2, k3, g1, g2, g3 = S[K, i], S[K + 1, i], S[K + 2, i], S[G, i], S[G + 1, i], S[G + 2, i]
        u1, u2, u3 = S[U, i], S[U + 1, i], S[U + 2, i]
        if twice:
            _, _, _, _, u1, u2, u3, _, _, _, _, _, _, _, _, _, _, _, _, _ = newton_round(
                u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, contact
            )  # fmt: skip
        p0, p1, p2, p3, _, _, _, first, d1, d2, d3, c11, c12, c13, c21, c22, c23, c31, c32, c33 = newton_round(
            u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, contact
        )  # fmt: skip
        p1, p2, p3, w1, w2, w3, second = second_round(
            p0, p1, p2, p3, k1, k2, k3, d1, d2, d3, c11, c12, c13, c21, c22, c23, c31, c32, c33, I1, I2, I3
        )  # fmt: skip
        squares = (c11 * c11 + c12 * c12 + c13 * c13) + (c21 * c21 + c22 * c22 + c23 * c23)
        bent = S[SLOPE, i] * (squares + (c31 * c31 + c32 * c32 + c33 * c33))  # (p0 c |A⁻¹|)²
        settled = (p0 > 0.0) & (w1 * w1 + (w2 * w2 + w3 * w3) <= S[WITHIN, i])
        settled = settled & (bent * first <= KANTOROVICH * (p0 * p0))
        settled = settled & (bent * (max(first, second) * second) <= S[LEAST, i] * (p0 * p0))
        S[P, i], S[P + 1, i], S[P + 2, i], S[P + 3, i] = p0, p1, p2, p3
        S[U, i], S[U + 1, i], S[U + 2, i] = w1, w2, w3
        S[OPEN, i] = 0.0 if settled else 1.0
    return (S[OPEN, 0] + S[OPEN, 1]) + (S[OPEN, 2] + S[OPEN, 3]) != 0.0


def moved(S, o1, o2, o3, a1, a2, a3):
    """Turns k and γ of every lane, carries its quaternion on by (1, u), and guesses the next u.

    o is ω and a its derivative at the beginning of the long step.
    """
    for i in range(LANES):
        p0, p1, p2, p3 = S[P, i], S[P + 1, i], S[P + 2, i], S[P + 3, i]
        w1, w2, w3 = S[U, i], S[U + 1, i], S[U + 2, i]
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
        a, b, c = S[WEIGHT, i], S[WEIGHT + 1, i], S[WEIGHT + 2, i]
        d, e = S[HALF, i] * S[WEIGHT + 3, i], S[HALF, i] * S[WEIGHT + 4, i]
        S[U, i] = (a * w1 + b * v1) + (c * x1 + (d * o1 + e * a1))
        S[U + 1, i] = (a * w2 + b * v2) + (c * x2 + (d * o2 + e * a2))
        S[U + 2, i] = (a * w3 + b * v3) + (c * x3 + (d * o3 + e * a3))


def begin(S, i, n, K0, g, half, table, R, weights, terms):
    """Puts the column n into lane i; table[n] has its c², radius² and least, weights[n] those of its first guess."""
    for c in range(3):
        S[K + c, i], S[G + c, i], S[Q + 1 + c, i] = half / n * K0[c], g[c], 0.0
    S[Q, i], S[HALF, i], S[INVERSE, i] = 1.0, half / n, n / half
    S[SLOPE, i], S[WITHIN, i], S[LEAST, i] = three(table[n], 0)
    for c in range(3):
        rate = 0.0
        for j in range(terms):
            rate += weights[n, j] * R[j, c]
        S[U + c, i] = half / n * rate


def keep(S, i, R, j):
    """Keeps the rate of the step that lane i has just taken as R[j]."""
    for c in range(3):
        R[j, c] = S[V + c, i] * S[INVERSE, i]


def gather(S, i, w, v, T):
    """Adds the unit quaternion of a column that lane i has finished to T[0], and to T[1], with its weights."""
    scale = 1.0 / sqrt((S[Q, i] ** 2 + S[Q + 1, i] ** 2) + (S[Q + 2, i] ** 2 + S[Q + 3, i] ** 2))
    for c in range(4):
        q = S[Q + c, i] * scale
        T[0, c] += w * q
        T[1, c] += v * q


def bounds(K0, half, most, state, table):
    """Writes the squares of c and of the lemma's radius for every column up to `most`."""
    I1, I2, I3 = three(state, I)
    spread = 0.5 * (max(I1, I2, I3) - min(I1, I2, I3))
    for n in range(FIRST, most + 1):
        k1, k2, k3 = half / n * K0[0], half / n * K0[1], half / n * K0[2]
        size = sqrt(k1 * k1 + k2 * k2 + k3 * k3)
        radius, _ = certificate(k1, k2, k3, I1, I2, I3, state[D])
        least = LEFT * size / (max(I1, I2, I3) + state[D] + spread)
        anywhere = -1.0 if is_heavy(I1, I2, I3, state[D]) else ANYWHERE  # a heavy ball takes the safe way
        put(table[n], 0, (spread + size) ** 2, radius if radius >= 0.0 else anywhere, least * least / BEHIND)


def rates(K0, g, half, state, R):
    """ω and its derivative in units of the long step, (2.12) and (2.13), as R[0] and R[1]."""
    K1, K2, K3 = three(K0, 0)
    g1, g2, g3 = three(g, 0)
    J1, J2, J3 = three(state, J)
    w1, w2, w3 = angular_velocity(K1, K2, K3, g1, g2, g3, J1, J2, J3, state[D])
    put(R[0], 0, w1, w2, w3)
    # K = Λω - D⟨γ,ω⟩γ turns, and so does γ: B(γ)ω̇ = (K + D⟨γ,ω⟩γ) × ω.
    height = state[D] * (g1 * w1 + g2 * w2 + g3 * w3)
    m1, m2, m3 = K1 + height * g1, K2 + height * g2, K3 + height * g3
    x1, x2, x3 = m2 * w3 - m3 * w2, m3 * w1 - m1 * w3, m1 * w2 - m2 * w1
    x1, x2, x3 = angular_velocity(x1, x2, x3, g1, g2, g3, J1, J2, J3, state[D])
    put(R[1], 0, 2.0 * half * x1, 2.0 * half * x2, 2.0 * half * x3)


def side_by_side(K0, g, attitude, half, full, short, following, beginning, state, table, S, R, T):
    """One long step in place; returns (settled, doubt), and writes nothing unless all has settled."""
    most = FIRST + len(full) - 1
    second = most - LANES  # the largest of the second columns
    I1, I2, I3 = three(state, I)
    contact = state[D]
    rates(K0, g, half, state, R)
    o1, o2, o3 = three(R[0], 0)
    a1, a2, a3 = three(R[1], 0)
    for c in range(4):
        T[0, c], T[1, c] = 0.0, 0.0
    for i in range(LANES):
        begin(S, i, max(most - i, FIRST), K0, g, half, table, R, beginning, 2)
    for slot in range(most):
        i = most - slot
        if i < LANES:  # lane i has finished its first column, n = slot
            if slot >= FIRST:
                gather(S, i, full[slot - FIRST], full[slot - FIRST] - short[slot - FIRST], T)
            if FIRST <= i <= second:
                begin(S, i, i, K0, g, half, table, R, beginning, FIRST_TERMS)
        for j in range(TERMS):  # at fixed rows: the loops must see that nothing overlaps
            w0, w1, w2, w3 = following[slot, j, 0], following[slot, j, 1], following[slot, j, 2], following[slot, j, 3]
            S[WEIGHT + j, 0], S[WEIGHT + j, 1], S[WEIGHT + j, 2], S[WEIGHT + j, 3] = w0, w1, w2, w3
        is_open, left = checked(S, True, I1, I2, I3, contact), MOST_ROUNDS
        while is_open and left > 0:
            is_open, left = checked(S, False, I1, I2, I3, contact), left - 1
        if is_open:
            return False, 0.0
        moved(S, o1, o2, o3, a1, a2, a3)
        if slot == 0:
            for i in range(LANES):
                keep(S, i, R, 2 + i)
        elif i < LANES and i == second:
            keep(S, i, R, 2 + LANES)
    gather(S, 0, full[most - FIRST], full[most - FIRST] - short[most - FIRST], T)
    for i in range(FIRST, min(second + 1, LANES)):
        gather(S, i, full[i - FIRST], full[i - FIRST] - short[i - FIRST], T)
    turn_all(K0, g, attitude, T[0, 0], T[0, 1], T[0, 2], T[0, 3])
    return True, 2.0 * sqrt((T[1, 0] ** 2 + T[1, 1] ** 2) + (T[1, 2] ** 2 + T[1, 3] ** 2))


def long_steps_in_lanes(K0, g, attitude, half, full, short, following, beginning, state, steps):
    """As `long_step.long_steps`, with the weights of the guesses (`guess`); returns (taken, status, reach, doubt)."""
    S, T, R = np.zeros((ROWS, LANES)), np.zeros((2, 4)), np.zeros((FIRST_TERMS, 3))
    table = np.zeros((MOST_COLUMNS + FIRST, 3))
    bounds(K0, half, FIRST + len(full) - 1, state, table)
    doubt = 0.0
    for k in range(steps):
        settled, more = side_by_side(K0, g, attitude, half, full, short, following, beginning, state, table, S, R, T)
        if not settled:
            status, reach, more = long_step(K0, g, attitude, half, full, short, state)
            if status != 0:
                return k, status, reach, doubt
        doubt += more
    return steps, 0, 1.0, doubt
