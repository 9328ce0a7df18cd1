"""Many long steps of one ball in double-double: the attitude after each, extrapolated from n steps of the map.

K and γ are fixed in space.  So it is the attitude alone that goes on, with the contact point, and before each long step
it turns the two back into the body: their integrals are kept to rounding, however many steps there are.
"""

from math import frexp, ldexp, sqrt

import numpy as np

from chapsym.generated import angular_velocity
from chapsym.generated.double_double import rotate_pairs
from chapsym.numbers.pairs import divide, loose_add, loose_multiply, multiply, root, two_sum

from .branch import TAKEN
from .double_double_loop import ROWS, D, G, I, J, K, follow_body, prepare_pairs, turn_both, write
from .double_double_step import bounds, solved
from .text import Matrix, Vector

#: The n of the first column; more columns are of n one by one larger.
FIRST = 3
#: Longer steps, in units where the momentum and the ball are about 1, have no rotation anyway.
LONGEST = 100


def turned_into(vectors, attitude, way, to):
    """Writes the vectors k and γ (12), turned by the attitude, or by its inverse where `way` is -1."""
    (
        to[0], to[1], to[2], to[3], to[4], to[5], to[6], to[7], to[8], to[9], to[10], to[11],
    ) = rotate_pairs(
        attitude[0], attitude[1], way * attitude[2], way * attitude[3], way * attitude[4], way * attitude[5],
        way * attitude[6], way * attitude[7], vectors[0], vectors[1], vectors[2], vectors[3], vectors[4], vectors[5],
        vectors[6], vectors[7], vectors[8], vectors[9], vectors[10], vectors[11],
    )  # fmt: skip


def column(state, n, radius, enough, rho, body):
    """Takes n steps of the map from k and γ of the state; body (12), attitude and contact point, moves with them."""
    attitude, contact = body[0:8], body[8:12]
    u1, u2, u3 = angular_velocity(
        state[K], state[K + 2], state[K + 4], state[G], state[G + 2], state[G + 4], state[J], state[J + 1],
        state[J + 2], state[D],
    )  # fmt: skip
    v1, v2, v3 = u1, u2, u3  # the Gibbs vector of the step before
    for _ in range(n):
        status, reach, w1, w1_, w2, w2_, w3, w3_ = solved(
            u1, u2, u3, state[K], state[K + 1], state[K + 2], state[K + 3], state[K + 4], state[K + 5],
            state[G], state[G + 1], state[G + 2], state[G + 3], state[G + 4], state[G + 5],
            state[I], state[I + 1], state[I + 2], state[I + 3], state[I + 4], state[I + 5],
            state[J], state[J + 1], state[J + 2], state[D], radius, enough,
        )  # fmt: skip
        if status != TAKEN:
            return status, reach
        follow_body(w1, w1_, w2, w2_, w3, w3_, state, attitude, contact, rho)
        turn_both(w1, w1_, w2, w2_, w3, w3_, state)
        u1, u2, u3 = 2.0 * w1 - v1, 2.0 * w2 - v2, 2.0 * w3 - v3
        v1, v2, v3 = w1, w2, w3
    return TAKEN, 1.0


def add_share(sums, w, w_, numbers, count):
    """Adds a weight times `count` pairs to sums."""
    for i in range(0, 2 * count, 2):
        x, x_ = multiply(w, w_, numbers[i], numbers[i + 1])
        x, x_ = loose_add(sums[i], sums[i + 1], x, x_)
        sums[i], sums[i + 1] = two_sum(x, x_)


def to_length_one(q):
    """Divides a quaternion of pairs (8) by its length."""
    n, n_ = loose_multiply(q[0], q[1], q[0], q[1])
    for i in range(2, 8, 2):
        x, x_ = loose_multiply(q[i], q[i + 1], q[i], q[i + 1])
        n, n_ = loose_add(n, n_, x, x_)
    x, x_ = two_sum(n, n_)
    n, n_ = root(x, x_)
    for i in range(0, 8, 2):
        q[i], q[i + 1] = divide(q[i], q[i + 1], n, n_)


def march_long_pairs(
    momentum: Vector, g: Vector, tensor: Vector, contact: float, h: float, h_: float, first: int, count: int,
    every: int, weights: Matrix, rho: float, follows: bool, attitude: Vector, body: Vector, momenta: Matrix,
    momenta_: Matrix, verticals: Matrix, verticals_: Matrix, attitudes: Matrix, attitudes_: Matrix, traces: Matrix,
    traces_: Matrix,
):  # fmt: skip
    """Takes `count` long steps h, a pair, of a ball from the step `first` on; keeps every `every`-th state.

    momentum, g, attitude: K, γ and pairs (8), at the step 0.  body: pairs, the present attitude and contact point (12),
    which move.  A name with _ is the low halves of its frames; `follows`: whether there are those of the body.
    weights: of the columns n = FIRST, ..., as pairs, and of the differences that the last one makes, (columns, 4).
    Returns (taken, status, reach, doubt).
    """
    columns, doubt = weights.shape[0], 0.0
    state, one, limits = np.zeros(ROWS), np.zeros((1, 2)), np.zeros((2, columns))
    space, moved, sums, changes = np.zeros(12), np.zeros(12), np.zeros(12), np.zeros(8)
    one[0, 0] = 1.0
    # K is scaled to about 1, and h apart from its exponent, so that neither leaves the range.
    _, size = frexp(max(abs(momentum[0]), abs(momentum[1]), abs(momentum[2])))
    mantissa, exponent = frexp(h)
    part = np.zeros(3)
    for c in range(3):
        part[c] = ldexp(ldexp(momentum[c], -size), min(size + exponent, 1000))
    shift, beyond = prepare_pairs(part, g, tensor, contact, one, state, limits[0], limits[1])
    half = ldexp(mantissa, min(size + exponent + shift, LONGEST))
    half_ = ldexp(ldexp(h_, -exponent), min(size + exponent + shift, LONGEST))
    for c in range(3):
        moved[2 * c] = ldexp(momentum[c], -size)
    for c in range(6):
        moved[6 + c] = state[G + c]
    for j in range(columns):
        s = half / (FIRST + j)
        limits[0, j], limits[1, j] = bounds(
            s * moved[0], s * moved[2], s * moved[4], state[I], state[I + 2], state[I + 4], state[D]
        )
    turned_into(moved, attitude, 1.0, space)
    for step in range(first, first + count):
        sums[:] = 0.0
        changes[:] = 0.0
        for j in range(columns):
            n = FIRST + j
            turned_into(space, body, -1.0, state)
            f, f_ = divide(half, half_, n * 1.0, 0.0)
            for c in range(0, 6, 2):
                state[K + c], state[K + c + 1] = multiply(state[K + c], state[K + c + 1], f, f_)
            for c in range(8):
                moved[c], moved[8 + c // 2] = body[c], 0.0
            status, reach = column(state, n, limits[0, j], limits[1, j], rho, moved)
            if status != TAKEN:
                return step - first, status, reach, doubt
            add_share(sums, weights[j, 0], weights[j, 1], moved, 6)
            add_share(changes, weights[j, 2], weights[j, 3], moved, 4)
        for c in range(8):
            body[c] = sums[c]
        to_length_one(body)
        for c in range(8, 12, 2):
            x, x_ = loose_add(body[c], body[c + 1], sums[c], sums[c + 1])
            body[c], body[c + 1] = two_sum(x, x_)
        a, b, c_, d = changes[0], changes[2], changes[4], changes[6]
        doubt = doubt + 2.0 * sqrt((a * a + b * b) + (c_ * c_ + d * d))
        if (step + 1) % every == 0:
            frame = (step + 1) // every
            turned_into(space, body, -1.0, state)
            write(momenta[frame], momenta_[frame], state, K, size)
            write(verticals[frame], verticals_[frame], state, G, 0)
            if follows:
                write(attitudes[frame], attitudes_[frame], body, 0, 0)
                write(traces[frame], traces_[frame], body, 8, -beyond)
    return count, TAKEN, 1.0, doubt
