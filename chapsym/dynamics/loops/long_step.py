"""A long step of the continuous ball, one column after another: n steps of the map, for several n.

Plain scalar Python, so that the same functions run on floats and are compiled by numba.  It takes the rotations of
the small-rotation branch, proved or continued from no rotation; `lanes` does the same side by side.
"""

from math import sqrt

from chapsym.generated import angular_velocity, compose, turn

from .branch import NOT_CONVERGED
from .gibbs import certificate, settle
from .loop import ENOUGH, RADIUS, D, G, I, J, K, put, safe_rotation, three

#: The first column: one step of the map as long as the whole gains little, and may not exist.
FIRST = 2


def column(K0, g, half, n, state):
    """The unit quaternion that n steps of the map make together from K0 and g (arrays of 3), each with 𝒦 = 2 half K0/n.

    state (`loop.ROWS`) has J, I and D; the rest of it is used.  Returns (status, reach, q0, q1, q2, q3).
    """
    k1, k2, k3 = half / n * K0[0], half / n * K0[1], half / n * K0[2]
    g1, g2, g3 = three(g, 0)
    I1, I2, I3 = three(state, I)
    state[RADIUS], state[ENOUGH] = certificate(k1, k2, k3, I1, I2, I3, state[D])
    u1, u2, u3 = angular_velocity(k1, k2, k3, g1, g2, g3, state[J], state[J + 1], state[J + 2], state[D])
    v1, v2, v3 = u1, u2, u3  # the Gibbs vector of the step before
    q0, q1, q2, q3 = 1.0, 0.0, 0.0, 0.0
    for _ in range(n):
        settled, p0, p1, p2, p3, w1, w2, w3 = settle(
            u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, state[D], state[RADIUS], state[ENOUGH]
        )  # fmt: skip
        if not settled:
            put(state, K, k1, k2, k3)
            put(state, G, g1, g2, g3)
            status, reach, p0, p1, p2, p3, w1, w2, w3 = safe_rotation(w1, w2, w3, state)
            if status != 0:
                return status, reach, q0, q1, q2, q3
        square = (p0 * p0 + p1 * p1) + (p2 * p2 + p3 * p3)
        if not square > 0.0:
            return NOT_CONVERGED, 0.0, q0, q1, q2, q3
        d1, d2, d3 = turn(p0, p1, p2, p3, k1, k2, k3)
        k1, k2, k3 = k1 + d1, k2 + d2, k3 + d3
        d1, d2, d3 = turn(p0, p1, p2, p3, g1, g2, g3)
        g1, g2, g3 = g1 + d1, g2 + d2, g3 + d3
        scale = 1.0 / sqrt(square)
        q0, q1, q2, q3 = compose(q0, q1, q2, q3, p0 * scale, p1 * scale, p2 * scale, p3 * scale)
        u1, u2, u3 = 2.0 * w1 - v1, 2.0 * w2 - v2, 2.0 * w3 - v3
        v1, v2, v3 = w1, w2, w3
    return 0, 1.0, q0, q1, q2, q3


def long_step(K0, g, attitude, half, full, short, state):
    """One long step in place, with the weights `full` of the columns; `short` are those without the last column.

    Returns (status, reach, doubt); nothing is written unless the status is 0.
    """
    q0, q1, q2, q3 = 0.0, 0.0, 0.0, 0.0
    d0, d1, d2, d3 = 0.0, 0.0, 0.0, 0.0
    for i in range(len(full)):
        status, reach, p0, p1, p2, p3 = column(K0, g, half, FIRST + i, state)
        if status != 0:
            return status, reach, 0.0
        w, v = full[i], full[i] - short[i]
        q0, q1, q2, q3 = q0 + w * p0, q1 + w * p1, q2 + w * p2, q3 + w * p3
        d0, d1, d2, d3 = d0 + v * p0, d1 + v * p1, d2 + v * p2, d3 + v * p3
    turn_all(K0, g, attitude, q0, q1, q2, q3)
    return 0, 1.0, 2.0 * sqrt((d0 * d0 + d1 * d1) + (d2 * d2 + d3 * d3))


def turn_all(K0, g, attitude, q0, q1, q2, q3):
    """Turns K0 and g by one quaternion of any length, and the attitude with them, in place."""
    x1, x2, x3 = turn(q0, q1, q2, q3, K0[0], K0[1], K0[2])
    put(K0, 0, K0[0] + x1, K0[1] + x2, K0[2] + x3)
    x1, x2, x3 = turn(q0, q1, q2, q3, g[0], g[1], g[2])
    put(g, 0, g[0] + x1, g[1] + x2, g[2] + x3)
    a0, a1, a2, a3 = compose(attitude[0], attitude[1], attitude[2], attitude[3], q0, q1, q2, q3)
    scale = 1.0 / sqrt((a0 * a0 + a1 * a1) + (a2 * a2 + a3 * a3))
    attitude[0] = a0 * scale
    put(attitude, 1, a1 * scale, a2 * scale, a3 * scale)


def long_steps(K0, g, attitude, half, full, short, state, steps):
    """`steps` long steps in place; returns (taken, status, reach, doubt)."""
    doubt = 0.0
    for k in range(steps):
        status, reach, more = long_step(K0, g, attitude, half, full, short, state)
        if status != 0:
            return k, status, reach, doubt
        doubt += more
    return steps, 0, 1.0, doubt
