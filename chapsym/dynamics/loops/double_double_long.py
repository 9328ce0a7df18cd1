"""Many long steps of one ball in double-double: the attitude after each, extrapolated from n steps of the map.

K and γ are fixed in space.  So it is the attitude alone that goes on, with the contact point, and before each long step
it turns the two back into the body: their integrals are kept to rounding, however many steps there are.
"""

from math import frexp, ldexp, sqrt

import numpy as np

from chapsym.generated import angular_velocity, rotate
from chapsym.numbers.loose import Loose, square_root

from .branch import TAKEN
from .double_double_loop import ROWS, D, G, I, K, prepare_pairs, rolled, turned, write
from .double_double_loop import J as J_ROW
from .double_double_step import bounds, solved
from .text import Matrix, Vector
from .vectors import (
    conjugate,
    dot_four,
    highs,
    largest,
    minus,
    normalised,
    pair,
    put,
    put_pair,
    put_pairs,
    scaled,
    shifted,
    square_of_four,
    three,
    three_pairs,
)  # fmt: skip

#: The n of the first column; more columns are of n one by one larger.
FIRST = 3
#: Longer steps, in units where the momentum and the ball are about 1, have no rotation anyway.
LONGEST = 100


def rotated(a, v):
    """The vector v of pairs by the attitude a."""
    return normalised(rotate(*a, *v))


def column(k, g, a, x, y, n, state, radius, enough, rho):
    """n steps of the map from k and γ, pairs: (status, reach, a, x, y), the attitude and the contact point moved.

    state: with I, J and D.
    """
    inertia, J, contact = three_pairs(state, I), three(state, J_ROW), state[D]
    u = angular_velocity(*highs(k), *highs(g), *J, contact)
    v, status, reach = u, TAKEN, 1.0  # v: the Gibbs vector of the step before
    for _ in range(n):
        status, reach, w = solved(u, k, g, inertia, J, contact, radius, enough)
        if status != TAKEN:
            break
        a, x, y = rolled(w, g, a, x, y, rho)
        k, g = turned(w, k), turned(w, g)
        u, v = minus(scaled(2.0, highs(w)), v), highs(w)
    return status, reach, a, x, y


def with_share(total, weight, x):
    """The pair `total` with a weight times another."""
    return (total + (weight * x).normalised()).normalised()


def with_shares(total, weight, q):
    """The same of four pairs."""
    return (
        with_share(total[0], weight, q[0]), with_share(total[1], weight, q[1]),
        with_share(total[2], weight, q[2]), with_share(total[3], weight, q[3]),
    )  # fmt: skip


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
    columns, doubt, zero = weights.shape[0], 0.0, Loose(0.0, 0.0)
    state, one, limits = np.zeros(ROWS), np.zeros((1, 2)), np.zeros((2, columns))
    one[0, 0] = 1.0
    # K is scaled to about 1, and h apart from its exponent, so that neither leaves the range.
    _, size = frexp(largest(three(momentum, 0)))
    mantissa, exponent = frexp(h)
    k, part = shifted(three(momentum, 0), -size), np.zeros(3)
    put(part, 0, shifted(k, min(size + exponent, 1000)))
    shift, beyond = prepare_pairs(part, g, tensor, contact, one, state, limits[0], limits[1])
    half = ldexp(mantissa, min(size + exponent + shift, LONGEST))
    half_ = ldexp(ldexp(h_, -exponent), min(size + exponent + shift, LONGEST))
    for j in range(columns):
        limits[0, j], limits[1, j] = bounds(scaled(half / (FIRST + j), k), highs(three_pairs(state, I)), state[D])
    a = pair(attitude, 0), pair(attitude, 2), pair(attitude, 4), pair(attitude, 6)
    K_, g_ = rotated(a, (Loose(k[0], 0.0), Loose(k[1], 0.0), Loose(k[2], 0.0))), rotated(a, three_pairs(state, G))
    a, x, y = (pair(body, 0), pair(body, 2), pair(body, 4), pair(body, 6)), pair(body, 8), pair(body, 10)
    for step in range(first, first + count):
        sums, changes, x_, y_ = (zero, zero, zero, zero), (zero, zero, zero, zero), zero, zero
        k_body, g_body = rotated(conjugate(a), K_), rotated(conjugate(a), g_)
        for j in range(columns):
            n = FIRST + j
            f = Loose(half, half_) / Loose(n * 1.0)
            status, reach, p, s, t = column(
                normalised(scaled(f, k_body)), g_body, a, zero, zero, n, state, limits[0, j], limits[1, j], rho
            )
            if status != TAKEN:
                return step - first, status, reach, doubt
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
        if (step + 1) % every == 0:
            frame = (step + 1) // every
            put_pairs(state, K, rotated(conjugate(a), K_))
            put_pairs(state, G, rotated(conjugate(a), g_))
            write(momenta[frame], momenta_[frame], state, K, size)
            write(verticals[frame], verticals_[frame], state, G, 0)
            if follows:
                write(attitudes[frame], attitudes_[frame], body, 0, 0)
                write(traces[frame], traces_[frame], body, 8, -beyond)
    return count, TAKEN, 1.0, doubt
