"""The inner loop of compositions: plain scalar Python that numba compiles.

A composition takes the stages Φ_{cᵢε} one after the other.  In the paper's variables 𝒦 = εK, so a stage finds its
rotation from cᵢ𝒦 and then carries 𝒦 itself: 𝒦 and γ turn rigidly, whatever the coefficients are.  The stages go back
and forth, so those of the last step or two lie all around the next: its Gibbs vector is guessed from theirs.
"""

import numpy as np

from .gibbs import settle
from .integrals import PERIOD, restore
from .loop import ENOUGH, RADIUS, D, G, I, K, X, follow_body, prepare, put, safe_rotation, three
from .sums import turned
from .text import Cube, Matrix, Vector, out_of_line


def guess(past, weights):
    """The next Gibbs vector from those of the last stages, (places, 3), by its weights (`guess.stage_weights`)."""
    u1, u2, u3 = 0.0, 0.0, 0.0
    for j in range(len(weights)):
        u1 = u1 + weights[j] * past[j, 0]
        u2 = u2 + weights[j] * past[j, 1]
        u3 = u3 + weights[j] * past[j, 2]
    return u1, u2, u3


def place(step, stages, places):
    """Of a step, counted from 0, the place of its first stage, and which weights it takes: 0 in the first round."""
    return step * stages % places, 0 if step * stages < places else 1


def turn_at(p0, p1, p2, p3, state, at, rest):
    """Turns the vector at state[at:], with the rests of its sums at state[rest:], by the quaternion p in place."""
    v1, v2, v3, x1, x2, x3 = turned(p0, p1, p2, p3, *three(state, at), *three(state, rest))
    put(state, at, v1, v2, v3)
    put(state, rest, x1, x2, x3)


@out_of_line
def prepare_composed(
    momentum: Vector,
    g: Vector,
    tensor: Vector,
    contact: float,
    c: Vector,
    state: Vector,
    radius: Vector,
    enough: Vector,
):
    """`prepare` of `loop`, and the certificate of the momentum of each stage into radius and enough, (s,)."""
    part = np.empty(3, momentum.dtype)
    for i in range(c.shape[0]):
        for j in range(3):
            part[j] = c[i] * momentum[j]
        prepare(part, g, tensor, contact, state)
        radius[i], enough[i] = state[RADIUS], state[ENOUGH]
    return prepare(momentum, g, tensor, contact, state)


def composed_step(step, state, c, weights, radius, enough, past, with_body, attitude, contact, rho):
    """All stages of one step, counted from 0, of the ball in `state` (ROWS), in place.

    c, radius², enough: of the stages, (s,); weights: of the guesses (`guess.stage_weights`), and past, (vectors, 3),
    what they are for.  Returns (status, reach).  Where a stage is not taken, the state is left with its momentum and
    its vertical.
    """
    at, later = place(step, c.shape[0], weights.shape[1])
    for i in range(c.shape[0]):
        k1, k2, k3 = three(state, K)
        g1, g2, g3 = three(state, G)
        I1, I2, I3 = three(state, I)
        u1, u2, u3 = guess(past, weights[later, at + i])
        settled, p0, p1, p2, p3, w1, w2, w3 = settle(
            u1, u2, u3, c[i] * k1, c[i] * k2, c[i] * k3, g1, g2, g3, I1, I2, I3, state[D], radius[i], enough[i]
        )  # fmt: skip
        if not settled:
            put(state, K, c[i] * k1, c[i] * k2, c[i] * k3)
            state[RADIUS], state[ENOUGH] = radius[i], enough[i]
            status, reach, p0, p1, p2, p3, w1, w2, w3 = safe_rotation(w1, w2, w3, state)
            if status != 0:
                return status, reach
            put(state, K, k1, k2, k3)
        put(past[at + i], 0, w1, w2, w3)
        if with_body:
            follow_body(p0, p1, p2, p3, g1, g2, g3, attitude, contact, rho)
        turn_at(p0, p1, p2, p3, state, K, X)
        turn_at(p0, p1, p2, p3, state, G, X + 3)
    return 0, 1.0


def march_composed(
    state: Vector, c: Vector, weights: Cube, radius: Vector, enough: Vector, past: Matrix, begun: int, first: int,
    count: int, every: int, scale: float, momenta: Matrix, verticals: Matrix, with_body: bool, attitude: Vector,
    contact: Vector, rho: float, attitudes: Matrix, traces: Matrix,
):  # fmt: skip
    """`march` of `loop`, each step a composition with the stage coefficients c.  Returns (taken, status, reach)."""
    period = max(1, PERIOD // c.shape[0])
    for step in range(first + 1, first + count + 1):
        status, reach = composed_step(
            begun + step - 1, state, c, weights, radius, enough, past, with_body, attitude, contact, rho
        )
        if status != 0:
            return step - 1 - first, status, reach
        if (begun + step) % period == 0:
            restore(state)
        if step % every == 0:
            frame = step // every
            put(momenta[frame], 0, scale * state[K], scale * state[K + 1], scale * state[K + 2])
            put(verticals[frame], 0, state[G], state[G + 1], state[G + 2])
            if with_body:
                for i in range(4):
                    attitudes[frame, i] = attitude[i]
                traces[frame, 0], traces[frame, 1] = contact[0], contact[1]
    return count, 0, 1.0
