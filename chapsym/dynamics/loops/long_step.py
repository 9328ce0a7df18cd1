"""The safe way of a long step of the continuous ball: the rotation of n steps of the map, extrapolated from several n.

It takes the rotations of the small-rotation branch, proved or continued from no rotation; `lanes` does the same side by
side.
"""

from math import frexp, ldexp, sqrt

import numpy as np

from chapsym.generated import angular_velocity, centre_step, compose, rotate, turn

from .branch import NOT_CONVERGED
from .fitted import fitted, turn_square
from .gibbs import certificate, settle
from .loop import ENOUGH, RADIUS, D, G, I, J, K, entered, safe_rotation
from .vectors import (
    conjugate,
    four,
    largest,
    minus,
    plus,
    plus_four,
    put,
    put_four,
    scaled,
    scaled_four,
    shifted,
    square_of_four,
    three,
)  # fmt: skip

#: The last column; the first is LAST + 1 - columns: longer steps of the map gain less than more columns do.
LAST = 7
#: Longer steps than 2^LONGEST, in units where the momentum and the ball are about 1, have no rotation anyway.
LONGEST = 100
#: The rows of the weights: of the columns, and of the differences that the last three columns make.
FULL, CHANGES = 0, 3
#: A ball under way, and where its numbers begin: K, γ, the attitude, the contact point, and the doubt so far.  Of the
#: last step: by which vectors, in the axes at its end, the last three columns have turned it otherwise; and how far the
#: last one has moved the contact point, in radii.
MOMENTUM, VERTICAL, ATTITUDE, SPOT, DOUBT, TWIST, SLIP = 0, 3, 6, 10, 12, 13, 22
MOVING = 24


def begun(body, J0, D0, h, state):
    """Scales K of `body` by a power of two, exactly, so that it is about 1, and puts the ball, likewise, into `state`.

    Returns (half, exponent): half a long step in these units, and K's exponent.
    """
    none = np.zeros(3)
    _, size = frexp(entered(none, none, J0, D0, state))
    _, exponent = frexp(largest(three(body, 0)))
    put(body, 0, shifted(three(body, 0), -exponent))
    mantissa, shift = frexp(0.5 * h)
    return ldexp(mantissa, min(shift + exponent - (size - 2), LONGEST)), exponent


def column(body, half, n, square, state):
    """The unit quaternion that n fitted steps of the map make together from K and γ of `body`.

    Each has 𝒦 = 2 half K/n times `fitted`, of `turn_square` over n².
    state (`loop.ROWS`) has J, I and D; the rest of it is used.  Returns (status, reach, q, y) with the way y of the
    centre in radii, in the axes of the body at the start.
    """
    k = scaled(half / n * fitted(square * (1.0 / (n * n))), three(body, MOMENTUM))
    g, inertia, contact = three(body, VERTICAL), three(state, I), state[D]
    state[RADIUS], state[ENOUGH] = certificate(k, inertia, contact)
    u = angular_velocity(*k, *g, *three(state, J), contact)
    v = u  # the Gibbs vector of the step before
    q, y = (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for _ in range(n):
        settled, p, w = settle(u, k, g, inertia, contact, state[RADIUS], state[ENOUGH])
        if not settled:
            put(state, K, k)
            put(state, G, g)
            status, reach, p, w = safe_rotation(w, state)
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
    """One long step of `body` (MOVING) in place; sums: as of `lanes.march_lanes`.

    Returns (status, reach); nothing is written unless the status is 0.
    """
    q, y, z = (0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    changes = np.zeros((CHANGES, 4))
    w = angular_velocity(*three(body, MOMENTUM), *three(body, VERTICAL), *three(state, J), state[D])
    first = LAST + 1 - sums.shape[1]
    square = turn_square(2.0 * half, first, w)
    for i in range(sums.shape[1]):
        status, reach, p, s = column(body, half, first + i, square, state)
        if status != 0:
            return status, reach
        q, y = plus_four(q, scaled_four(sums[FULL, i], p)), plus(y, scaled(sums[FULL, i], s))
        z = plus(z, scaled(sums[FULL + 1, i], s))
        for c in range(CHANGES):
            put_four(changes[c], 0, plus_four(four(changes[c], 0), scaled_four(sums[FULL + 1 + c, i], p)))
    body[SLIP], body[SLIP + 1], _ = rotate(*four(body, ATTITUDE), *z)
    k, g, a, body[SPOT], body[SPOT + 1] = moved_body(
        three(body, MOMENTUM), three(body, VERTICAL), four(body, ATTITUDE), body[SPOT], body[SPOT + 1], q, y, radius
    )
    put(body, MOMENTUM, k)
    put(body, VERTICAL, g)
    put_four(body, ATTITUDE, a)
    for c in range(CHANGES):
        d = four(changes[c], 0)
        if c == 0:
            body[DOUBT] += 2.0 * sqrt(square_of_four(d))
        put(body, TWIST + 3 * c, twist(q, d))
    return 0, 1.0


def twist(q, d):
    """By which small vector, in the axes at the end, a unit quaternion q turns otherwise for a change d of it."""
    return scaled(2.0, compose(*conjugate(q), *d)[1:4])


def moved_body(k, g, a, x, y, q, s, radius):
    """K and γ turned by one quaternion q of any length, the attitude a with them, and the contact point moved by s."""
    d1, d2, _ = rotate(*a, *s)
    b = compose(*a, *q)
    b = scaled_four(1.0 / sqrt(square_of_four(b)), b)
    return plus(k, turn(*q, *k)), plus(g, turn(*q, *g)), b, x + radius * d1, y + radius * d2
