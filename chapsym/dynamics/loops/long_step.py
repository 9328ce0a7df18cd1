"""The safe way of a long step of the continuous ball: the rotation of n steps of the map, extrapolated from several n.

It takes the rotations of
the small-rotation branch, proved or continued from no rotation; `lanes` does the same side by side.
"""

from math import frexp, ldexp, sqrt

import numpy as np

from chapsym.generated import angular_velocity, centre_step, compose, rotate, turn

from .branch import NOT_CONVERGED
from .fitted import fitted, turn_square
from .gibbs import certificate, settle
from .loop import ENOUGH, RADIUS, D, G, I, J, K, put, safe_rotation, scaled, three

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
    _, size = frexp(scaled(none, none, J0, D0, state))
    _, exponent = frexp(max(abs(body[0]), abs(body[1]), abs(body[2])))
    for c in range(3):
        body[c] = ldexp(body[c], -exponent)
    mantissa, shift = frexp(0.5 * h)
    return ldexp(mantissa, min(shift + exponent - (size - 2), LONGEST)), exponent


def column(body, half, n, square, state):
    """The unit quaternion that n fitted steps of the map make together from K and γ of `body`.

    Each has 𝒦 = 2 half K/n times `fitted`, of `turn_square` over n².
    state (`loop.ROWS`) has J, I and D; the rest of it is used.  Returns (status, reach, q0, q1, q2, q3, y1, y2, y3)
    with the way y of the centre in radii, in the axes of the body at the start.
    """
    part = half / n * fitted(square * (1.0 / (n * n)))
    k1, k2, k3 = part * body[MOMENTUM], part * body[MOMENTUM + 1], part * body[MOMENTUM + 2]
    g1, g2, g3 = three(body, VERTICAL)
    I1, I2, I3 = three(state, I)
    state[RADIUS], state[ENOUGH] = certificate(k1, k2, k3, I1, I2, I3, state[D])
    u1, u2, u3 = angular_velocity(k1, k2, k3, g1, g2, g3, state[J], state[J + 1], state[J + 2], state[D])
    v1, v2, v3 = u1, u2, u3  # the Gibbs vector of the step before
    q0, q1, q2, q3 = 1.0, 0.0, 0.0, 0.0
    y1, y2, y3 = 0.0, 0.0, 0.0
    for _ in range(n):
        settled, p0, p1, p2, p3, w1, w2, w3 = settle(
            u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, state[D], state[RADIUS], state[ENOUGH]
        )  # fmt: skip
        if not settled:
            put(state, K, k1, k2, k3)
            put(state, G, g1, g2, g3)
            status, reach, p0, p1, p2, p3, w1, w2, w3 = safe_rotation(w1, w2, w3, state)
            if status != 0:
                return status, reach, q0, q1, q2, q3, y1, y2, y3
        square = (p0 * p0 + p1 * p1) + (p2 * p2 + p3 * p3)
        if not square > 0.0:
            return NOT_CONVERGED, 0.0, q0, q1, q2, q3, y1, y2, y3
        scale = 1.0 / sqrt(square)
        s1, s2, s3 = centre_step(p0 * scale, p1 * scale, p2 * scale, p3 * scale, g1, g2, g3)
        s1, s2, s3 = rotate(q0, q1, q2, q3, s1, s2, s3)
        y1, y2, y3 = y1 + s1, y2 + s2, y3 + s3
        d1, d2, d3 = turn(p0, p1, p2, p3, k1, k2, k3)
        k1, k2, k3 = k1 + d1, k2 + d2, k3 + d3
        d1, d2, d3 = turn(p0, p1, p2, p3, g1, g2, g3)
        g1, g2, g3 = g1 + d1, g2 + d2, g3 + d3
        q0, q1, q2, q3 = compose(q0, q1, q2, q3, p0 * scale, p1 * scale, p2 * scale, p3 * scale)
        u1, u2, u3 = 2.0 * w1 - v1, 2.0 * w2 - v2, 2.0 * w3 - v3
        v1, v2, v3 = w1, w2, w3
    return 0, 1.0, q0, q1, q2, q3, y1, y2, y3


def long_step(body, half, radius, sums, state):
    """One long step of `body` (MOVING) in place; sums: as of `lanes.march_lanes`.

    Returns (status, reach); nothing is written unless the status is 0.
    """
    q0, q1, q2, q3 = 0.0, 0.0, 0.0, 0.0
    changes = np.zeros((CHANGES, 4))
    y1, y2, y3, z1, z2, z3 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    w1, w2, w3 = angular_velocity(
        body[0], body[1], body[2], body[3], body[4], body[5], state[J], state[J + 1], state[J + 2], state[D]
    )
    first = LAST + 1 - sums.shape[1]
    square = turn_square(2.0 * half, first, w1, w2, w3)
    for i in range(sums.shape[1]):
        status, reach, p0, p1, p2, p3, s1, s2, s3 = column(body, half, first + i, square, state)
        if status != 0:
            return status, reach
        w, v = sums[FULL, i], sums[FULL + 1, i]
        q0, q1, q2, q3 = q0 + w * p0, q1 + w * p1, q2 + w * p2, q3 + w * p3
        y1, y2, y3 = y1 + w * s1, y2 + w * s2, y3 + w * s3
        z1, z2, z3 = z1 + v * s1, z2 + v * s2, z3 + v * s3
        for c in range(CHANGES):
            w = sums[FULL + 1 + c, i]
            changes[c, 0], changes[c, 1] = changes[c, 0] + w * p0, changes[c, 1] + w * p1
            changes[c, 2], changes[c, 3] = changes[c, 2] + w * p2, changes[c, 3] + w * p3
    body[SLIP], body[SLIP + 1], _ = rotate(body[6], body[7], body[8], body[9], z1, z2, z3)
    (
        body[0], body[1], body[2], body[3], body[4], body[5], body[6], body[7], body[8], body[9], body[10], body[11]
    ) = moved_body(
        body[0], body[1], body[2], body[3], body[4], body[5], body[6], body[7], body[8], body[9], body[10], body[11],
        q0, q1, q2, q3, y1, y2, y3, radius,
    )  # fmt: skip
    for c in range(CHANGES):
        d0, d1, d2, d3 = changes[c, 0], changes[c, 1], changes[c, 2], changes[c, 3]
        if c == 0:
            body[DOUBT] += 2.0 * sqrt((d0 * d0 + d1 * d1) + (d2 * d2 + d3 * d3))
        at = TWIST + 3 * c
        body[at], body[at + 1], body[at + 2] = twist(q0, q1, q2, q3, d0, d1, d2, d3)
    return 0, 1.0


def twist(q0, q1, q2, q3, d0, d1, d2, d3):
    """By which small vector, in the axes at the end, a unit quaternion q turns otherwise for a change d of it."""
    _, x, y, z = compose(q0, -q1, -q2, -q3, d0, d1, d2, d3)
    return 2.0 * x, 2.0 * y, 2.0 * z


def moved_body(
    k1, k2, k3, g1, g2, g3, a0, a1, a2, a3, x, y, q0, q1, q2, q3, y1, y2, y3, radius
):  # fmt: skip
    """K and γ turned by one quaternion q of any length, the attitude with them, and the contact point moved by y."""
    d1, d2, d3 = turn(q0, q1, q2, q3, k1, k2, k3)
    k1, k2, k3 = k1 + d1, k2 + d2, k3 + d3
    d1, d2, d3 = turn(q0, q1, q2, q3, g1, g2, g3)
    g1, g2, g3 = g1 + d1, g2 + d2, g3 + d3
    d1, d2, _ = rotate(a0, a1, a2, a3, y1, y2, y3)
    x, y = x + radius * d1, y + radius * d2
    a0, a1, a2, a3 = compose(a0, a1, a2, a3, q0, q1, q2, q3)
    scale = 1.0 / sqrt((a0 * a0 + a1 * a1) + (a2 * a2 + a3 * a3))
    return k1, k2, k3, g1, g2, g3, a0 * scale, a1 * scale, a2 * scale, a3 * scale, x, y
