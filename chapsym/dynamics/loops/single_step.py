"""One step of each ball of a batch by the loops' own round."""

from math import sqrt

import numpy as np

from chapsym.generated import turn

from .gibbs import settle
from .loop import ENOUGH, RADIUS, ROWS, D, G, I, K, put, safe_rotation, scaled, three
from .text import Doubles, Integers, Matrix, Vector


def advance(momentum, g, tensor, contact, state, q):
    """The first step of `loop.march`, in place: writes the rotation into q and moves momentum and g.

    state (ROWS) is overwritten.  Returns (status, reach); nothing else is written unless the status is 0.
    """
    scale = scaled(momentum, g, tensor, contact, state)
    k1, k2, k3 = three(state, K)
    g1, g2, g3 = three(state, G)
    I1, I2, I3 = three(state, I)
    reach = 1.0
    settled, p0, p1, p2, p3, w1, w2, w3 = settle(
        0.0, 0.0, 0.0, k1, k2, k3, g1, g2, g3, I1, I2, I3, state[D], state[RADIUS], state[ENOUGH]
    )  # fmt: skip
    if not settled:
        status, reach, p0, p1, p2, p3, w1, w2, w3 = safe_rotation(w1, w2, w3, state)
        if status != 0:
            return status, reach
    length = sqrt((p0 * p0 + p1 * p1) + (p2 * p2 + p3 * p3))
    q[0], q[1], q[2], q[3] = p0 / length, p1 / length, p2 / length, p3 / length
    z1, z2, z3 = turn(p0, p1, p2, p3, k1, k2, k3)
    put(momentum, 0, scale * (k1 + z1), scale * (k2 + z2), scale * (k3 + z3))
    z1, z2, z3 = turn(p0, p1, p2, p3, g1, g2, g3)
    put(g, 0, g1 + z1, g2 + z2, g3 + z3)
    return 0, reach


def advance_all(
    momenta: Matrix, verticals: Matrix, tensors: Matrix, contacts: Vector, q: Matrix, status: Integers, reach: Doubles
):
    """One step of each ball, in place: arrays (n, 3), (n, 3), (n, 3), (n,), (n, 4), (n,), (n,)."""
    state = np.zeros(ROWS, momenta.dtype)
    for i in range(momenta.shape[0]):
        status[i], reach[i] = advance(momenta[i], verticals[i], tensors[i], contacts[i], state, q[i])
