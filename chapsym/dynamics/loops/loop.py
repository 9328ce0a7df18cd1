"""The inner loop: many steps of one ball, each a composition of the map with any stages; the map itself has one stage.

A composition takes the stages Φ_{cᵢε} one after the other.  In the paper's variables 𝒦 = εK, so a stage computes its
rotation from cᵢ𝒦 and turns 𝒦 itself: 𝒦 and γ turn rigidly, for any coefficients.  Stages go forward and backward in
time, so the stages of the last steps surround the next one: its Gibbs vector is guessed from theirs.
"""

from math import frexp, ldexp

import numpy as np

from chapsym.generated import centre_step, compose, rotate, turn

from . import single_loop
from .branch import moments, small_rotation
from .gibbs import BEYOND, SMALLEST, certificate, search_safely, settle
from .integrals import PERIOD, remember, restore, turned
from .path import search_on_path
from .records import Moving, Stages, Steps, Track
from .text import Doubles, Integers, Matrix, Vector, out_of_line
from .vectors import four, largest, plus, put, put_four, scaled, scaled_four, shifted, three, unit

#: The largest binary exponent for the scaling of a ball.
HIGHEST = 1021
#: The layout of the state of a ball: k = 𝒦/2, γ, their compensations, the three integrals as pairs, J, I, D, radius²
#: and enough (lemma small-branch).
K, G, X, INTEGRALS, J, I, D, RADIUS, ENOUGH = 0, 3, 6, 12, 18, 21, 24, 25, 26
ROWS = 27
#: The substitutes for float32.
SINGLE = {"small_rotation": single_loop.widened, "follow_body": single_loop.follow_body}


@out_of_line
def prepare(momentum: Vector, g: Vector, tensor: Vector, contact: float, c: Vector, state: Vector, limits: Matrix):
    """Writes the state of a ball, and the limits for each stage c, (s,); returns `scale`, with 𝒦 = scale·k."""
    part, scale = np.empty(3, momentum.dtype), 1.0
    for i in range(c.shape[0]):
        put(part, 0, scaled(c[i], three(momentum, 0)))
        scale = entered(part, g, tensor, contact, state)
        limits[0, i], limits[1, i] = state[RADIUS], state[ENOUGH]
    if c.shape[0] > 1:  # a single stage is the step
        scale = entered(momentum, g, tensor, contact, state)
    remember(state)
    return scale


def scaling(momentum, tensor, contact):
    """The exponent of the power of two that scales a ball to Λmax about 1, and whether its momentum is tiny."""
    _, exponent = frexp(max(*moments(tensor)) + contact)
    most = largest(momentum)
    _, size = frexp(most)
    exponent = max(min(exponent, HIGHEST), size - HIGHEST)  # neither `scale` nor k overflows
    tiny = 0.0 < most < ldexp(SMALLEST, exponent)
    if tiny:
        exponent = max(-1, exponent - HIGHEST + 1)  # k = 𝒦, if J permits: no digits of a subnormal momentum are lost
    return exponent, tiny


def times(v, exponent):
    """The vector v times a power of two, rounded once: a product if the power is normal in float32."""
    if -126 <= exponent <= 127:
        return scaled(ldexp(1.0, exponent), v)
    return shifted(v, exponent)


def limits(k, inertia, contact, tiny):
    """radius² and enough of the steps of a ball, by its certificate."""
    radius, enough = certificate(k, inertia, contact)
    # Products of three or four tiny numbers would underflow: every step uses `safe_rotation`.
    return -1.0 if tiny else -1.0 if min(*inertia) < SMALLEST else radius, enough


@out_of_line
def entered(momentum, g, tensor, contact, state):
    """Writes the state, except the integrals, scaled by a power of two to Λmax about 1; returns `scale`."""
    exponent, tiny = scaling(three(momentum, 0), three(tensor, 0), contact)
    state[:] = 0.0
    put(state, K, times(three(momentum, 0), -exponent - 1))
    put(state, G, three(g, 0))
    put(state, J, times(three(tensor, 0), -exponent))
    put(state, I, moments(three(state, J)))
    state[D], _, _ = times((contact, 0.0, 0.0), -exponent)
    state[RADIUS], state[ENOUGH] = limits(three(state, K), three(state, I), state[D], tiny)
    return ldexp(1.0, exponent + 1)


@out_of_line
def safe_rotation(u, state):
    """(status, reach, p, u) of a step whose first round did not converge: from its guess, or by continuation."""
    k, g, inertia, contact = three(state, K), three(state, G), three(state, I), state[D]
    if state[RADIUS] == BEYOND:
        settled, p, w = search_on_path(u, k, g, inertia, contact)
    else:
        settled, p, w = search_safely(u, k, g, inertia, contact, state[RADIUS], state[ENOUGH])
    if settled:
        return 0, 1.0, p, w
    status, reach, p0, p1, p2, p3 = small_rotation(*scaled(2.0, k), *g, *three(state, J), contact)
    if p0 == 0.0:
        return status, reach, (p0, p1, p2, p3), (0.0, 0.0, 0.0)  # a rotation by π has no Gibbs vector
    return status, reach, (p0, p1, p2, p3), (p1 / p0, p2 / p0, p3 / p0)


def follow_body(p, g, attitude, contact, radius):
    """Moves the attitude and the contact point by the step with the quaternion p from the vertical g."""
    a, contact[0], contact[1] = followed(p, g, four(attitude, 0), contact[0], contact[1], radius)
    put_four(attitude, 0, a)


def followed(p, g, a, x, y, radius):
    """The attitude a and the contact point (x, y) after the step with the quaternion p from the vertical g."""
    q = unit(p)
    d1, d2, _ = rotate(*a, *centre_step(*q, *g))
    b = compose(*a, *q)
    # One Newton step to length 1 suffices: the product of unit quaternions has only a rounding error.
    scale = 1.5 - 0.5 * (b[0] * b[0] + b[1] * b[1] + b[2] * b[2] + b[3] * b[3])
    return scaled_four(scale, b), x + radius * d1, y + radius * d2


def guessed(past, at, weights):
    """The guess of the next Gibbs vector: a weighted sum of the rows of past from the oldest, `at`, on."""
    u = 0.0, 0.0, 0.0
    for j in range(len(weights)):
        u = plus(u, scaled(weights[j], three(past[at + j], 0)))
    return u


def march(ball: Moving, stages: Stages, steps: Steps, begun: int, scale: float, track: Track):
    """Takes the steps of a ball; 𝒦 = scale·k, and `begun` steps were taken before step 0 of the frames.

    The state has ROWS numbers, the attitude 4, the contact point 2; past (2 places, 3) has each Gibbs vector twice, so
    that those of a guess are contiguous.  Returns (taken, status, reach); if a stage fails, the state is left with the
    momentum and the vertical of that stage.
    """
    state, past, c, weights = ball.state, ball.past, stages.c, stages.weights
    k, g, x, y, inertia = three(state, K), three(state, G), three(state, X), three(state, X + 3), three(state, I)
    count, places = c.shape[0], weights.shape[1]
    period = max(1, PERIOD // count)
    step, status, reach = steps.first, 0, 1.0
    while step < steps.last and status == 0:
        # Up to the next frame, the next restoration, or the end.
        stop = min(steps.last, step + steps.every - step % steps.every, step + period - (begun + step) % period)
        while step < stop:
            at = (begun + step) * count % places
            later = 1 if (begun + step) * count >= places else 0
            for i in range(count):
                m = scaled(c[i], k)
                u = guessed(past, at + i, weights[later, at + i])
                settled, p, u = settle(u, m, g, inertia, state[D], ball.limits[0, i], ball.limits[1, i])
                if not settled:
                    put(state, K, m)
                    put(state, G, g)
                    state[RADIUS], state[ENOUGH] = ball.limits[0, i], ball.limits[1, i]
                    status, reach, p, u = safe_rotation(u, state)
                    if status != 0:
                        break
                put(past[at + i], 0, u)
                put(past[places + at + i], 0, u)
                if track.follows:
                    follow_body(p, g, ball.attitude, ball.contact, ball.radius)
                k, x = turned(p, k, x)
                g, y = turned(p, g, y)
            if status != 0:
                break
            step += 1
        if status == 0:
            put(state, K, k)
            put(state, G, g)
        put(state, X, x)
        put(state, X + 3, y)
        if status == 0 and (begun + step) % period == 0:
            restore(state)
            x, y = three(state, X), three(state, X + 3)
        if status == 0 and step % steps.every == 0:
            frame = step // steps.every
            put(track.momenta[frame], 0, scaled(scale, k))
            put(track.verticals[frame], 0, g)
            if track.follows:
                put_four(track.attitudes[frame], 0, four(ball.attitude, 0))
                track.traces[frame, 0], track.traces[frame, 1] = ball.contact[0], ball.contact[1]
    return step - steps.first, status, reach


def advance(momentum, g, tensor, contact, state, q):
    """The first step of `loop.march`, in place: writes the rotation into q and updates momentum and g.

    state (ROWS) is overwritten.  Returns (status, reach); nothing else is written unless the status is 0.
    """
    scale = entered(momentum, g, tensor, contact, state)
    k, v, reach = three(state, K), three(state, G), 1.0
    settled, p, u = settle((0.0, 0.0, 0.0), k, v, three(state, I), state[D], state[RADIUS], state[ENOUGH])
    if not settled:
        status, reach, p, u = safe_rotation(u, state)
        if status != 0:
            return status, reach
    put_four(q, 0, unit(p))
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
