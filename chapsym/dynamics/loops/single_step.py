"""One step of each ball of a batch by the loops' own round."""

from math import sqrt

import numpy as np

from chapsym.generated import turn

from .gibbs import settle
from .loop import ENOUGH, RADIUS, ROWS, D, G, I, K, entered, safe_rotation
from .text import Doubles, Integers, Matrix, Vector
from .vectors import plus, put, scaled, square_of_four, three


def advance(momentum, g, tensor, contact, state, q):
    """The first step of `loop.march`, in place: writes the rotation into q and moves momentum and g.

    state (ROWS) is overwritten.  Returns (status, reach); nothing else is written unless the status is 0.
    """
    scale = entered(momentum, g, tensor, contact, state)
    k, v, reach = three(state, K), three(state, G), 1.0
    settled, p, u = settle((0.0, 0.0, 0.0), k, v, three(state, I), state[D], state[RADIUS], state[ENOUGH])
    if not settled:
        status, reach, p, u = safe_rotation(u, state)
        if status != 0:
            return status, reach
    length = sqrt(square_of_four(p))
    q[0], q[1], q[2], q[3] = p[0] / length, p[1] / length, p[2] / length, p[3] / length
    put(momentum, 0, scaled(scale, plus(k, turn(*p, *k))))
    put(g, 0, plus(v, turn(*p, *v)))
    return 0, reach


def advance_all(
    momenta: Matrix, verticals: Matrix, tensors: Matrix, contacts: Vector, q: Matrix, status: Integers, reach: Doubles
):
    """One step of each ball, in place: arrays (n, 3), (n, 3), (n, 3), (n,), (n, 4), (n,), (n,)."""
    state = np.zeros(ROWS, momenta.dtype)
    for i in range(momenta.shape[0]):
        status[i], reach[i] = advance(momenta[i], verticals[i], tensors[i], contacts[i], state, q[i])
