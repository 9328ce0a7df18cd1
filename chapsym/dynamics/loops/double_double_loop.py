"""Many steps of one ball in double-double.

A step is a composition with any stages, of which the map itself has one.  𝒦, γ, the attitude and the contact point are
pairs, and need no compensation; the integrals are restored now and then.
"""

from math import ldexp

from chapsym.generated import centre_step, compose, rotate, turn
from chapsym.numbers.loose import Loose, square_root
from chapsym.numbers.pairs import subtract, two_sum

from .branch import TAKEN
from .double_double_step import bounds, scales, solved, unit
from .integrals import PERIOD, shares
from .sums import filtered
from .text import Cube, Matrix, Vector, out_of_line
from .vectors import (
    dot,
    highs,
    normalised,
    normalised_four,
    of_length_one,
    pair,
    plus,
    put_pair,
    put_pairs,
    scaled,
    three,
    three_pairs,
)  # fmt: skip

#: The rows of the numbers that describe a ball under way: k = 𝒦/2, γ and I as pairs (high, low, high, ...), J,
#: D, and the three integrals as pairs.
K, G, I, J, D, INTEGRALS = 0, 6, 12, 18, 21, 22
ROWS = 28


@out_of_line
def prepare_pairs(
    momentum: Vector,
    g: Vector,
    tensor: Vector,
    contact: float,
    c: Matrix,
    state: Vector,
    radius: Vector,
    enough: Vector,
):
    """Writes the state of a ball at the start and the bounds of its stages; returns the exponents of `scales`."""
    shift, beyond = scales(momentum, tensor, contact)
    size = beyond - shift - 1
    for i in range(3):
        state[K + 2 * i], state[K + 2 * i + 1] = ldexp(momentum[i], shift), 0.0
        state[J + i] = ldexp(tensor[i], -size)
    state[D] = ldexp(contact, -size)
    put_pairs(state, G, unit(three(g, 0)))
    state[I], state[I + 1] = two_sum(state[J + 1], state[J + 2])
    state[I + 2], state[I + 3] = two_sum(state[J], state[J + 2])
    state[I + 4], state[I + 5] = two_sum(state[J], state[J + 1])
    remember_pairs(state)
    for i in range(c.shape[0]):
        k, inertia = scaled(c[i, 0], highs(three_pairs(state, K))), highs(three_pairs(state, I))
        radius[i], enough[i] = bounds(k, inertia, state[D])
    return shift, beyond


def remember_pairs(state):
    """Writes ⟨γ,γ⟩, ⟨k,γ⟩ and ⟨k,k⟩ into the state."""
    k, g = three_pairs(state, K), three_pairs(state, G)
    put_pairs(state, INTEGRALS, normalised((dot(g, g), dot(k, g), dot(k, k))))


@out_of_line
def restore_pairs(state):
    """Gives k and γ the three integrals again, up to the rounding of these: else they walk by u² at each step."""
    k, g = three_pairs(state, K), three_pairs(state, G)
    h, now = three_pairs(state, INTEGRALS), normalised((dot(g, g), dot(k, g), dot(k, k)))
    unit, _ = subtract(h[0].high, h[0].low, now[0].high, now[0].low)
    height, _ = subtract(h[1].high, h[1].low, now[1].high, now[1].low)
    squared, _ = subtract(h[2].high, h[2].low, now[2].high, now[2].low)
    stretch, along_k, along_gamma = shares(unit, height, squared, h[0].high, h[1].high, h[2].high)
    for i in range(0, 6, 2):
        x, y = pair(state, K + i), pair(state, G + i)
        put_pair(state, K + i, Loose(*two_sum(x.high, x.low + (along_k * x.high + along_gamma * y.high))))
        put_pair(state, G + i, Loose(*two_sum(y.high, y.low + stretch * y.high)))


def extrapolated(past, w):
    """Takes the newest Gibbs vector of a stage into its filter (8, 3), the first row of which is the next guess."""
    for c, x in ((0, w[0]), (1, w[1]), (2, w[2])):
        (
            past[0, c], past[1, c], past[2, c], past[3, c], past[4, c], past[5, c], past[6, c], past[7, c]
        ) = filtered(past[1, c], past[2, c], past[3, c], past[4, c], past[5, c], past[6, c], past[7, c], x)  # fmt: skip


def stage(state, c, radius, enough, past):
    """The Gibbs vector of a stage with the coefficient c, a pair, and its filter carried on; returns as `solved`."""
    k, g, inertia = normalised(scaled(c, three_pairs(state, K))), three_pairs(state, G), three_pairs(state, I)
    status, reach, u = solved(three(past[0], 0), k, g, inertia, three(state, J), state[D], radius, enough)
    if status == TAKEN:
        extrapolated(past, highs(u))
    return status, reach, u


def rolled(u, g, a, x, y, rho):
    """The attitude a and the contact point (x, y), in pairs, after the step by u from the vertical g."""
    q0 = 1.0 / square_root(dot(u, u) + 1.0)
    q = scaled(q0, u)
    d1, d2, _ = rotate(*a, *centre_step(q0, *q, *g))
    turned = normalised_four(of_length_one(compose(*a, q0, *q)))
    return turned, (x + Loose(rho) * d1).normalised(), (y + Loose(rho) * d2).normalised()


def follow_body(u, state, attitude, contact, rho):
    """Moves the attitude (8) and the contact point (4), pairs, by the step with the Gibbs vector u."""
    a = pair(attitude, 0), pair(attitude, 2), pair(attitude, 4), pair(attitude, 6)
    b, x, y = rolled(u, three_pairs(state, G), a, pair(contact, 0), pair(contact, 2), rho)
    put_pair(attitude, 0, b[0])
    put_pairs(attitude, 2, b[1:4])
    put_pair(contact, 0, x)
    put_pair(contact, 2, y)


def turned(u, v):
    """The vector v of pairs, turned by the step with the Gibbs vector u."""
    return normalised(plus(v, turn(1, *u, *v)))


def write(frame, frame_, pairs, at, exponent):
    """2^exponent times the pairs from `at` on into the two halves of a frame."""
    for i in range(frame.shape[0]):
        frame[i], frame_[i] = ldexp(pairs[at + 2 * i], exponent), ldexp(pairs[at + 2 * i + 1], exponent)


def march_pairs(
    state: Vector, c: Matrix, radius: Vector, enough: Vector, past: Cube, first: int, count: int, every: int,
    shift: int, beyond: int, momenta: Matrix, momenta_: Matrix, verticals: Matrix, verticals_: Matrix, with_body: bool,
    attitude: Vector, contact: Vector, rho: float, attitudes: Matrix, attitudes_: Matrix, traces: Matrix,
    traces_: Matrix,
):  # fmt: skip
    """Takes `count` steps from the step `first` on, each with the stages c (s, 2); keeps every `every`-th state.

    state (ROWS), past (s, 8, 3), attitude (8) and contact (4) hold the present and move; shift and beyond are those of
    `scales`.  A name with _ is the low halves of its frames.  Returns (taken, status, reach).
    """
    period = max(1, PERIOD // c.shape[0])
    for step in range(first + 1, first + count + 1):
        for i in range(c.shape[0]):
            status, reach, u = stage(state, Loose(c[i, 0], c[i, 1]), radius[i], enough[i], past[i])
            if status != TAKEN:
                return step - 1 - first, status, reach
            if with_body:
                follow_body(u, state, attitude, contact, rho)
            put_pairs(state, K, turned(u, three_pairs(state, K)))
            put_pairs(state, G, turned(u, three_pairs(state, G)))
        if step % period == 0:
            restore_pairs(state)
        if step % every == 0:
            frame = step // every
            write(momenta[frame], momenta_[frame], state, K, -shift)
            write(verticals[frame], verticals_[frame], state, G, 0)
            if with_body:
                write(attitudes[frame], attitudes_[frame], attitude, 0, 0)
                write(traces[frame], traces_[frame], contact, 0, -beyond)
    return count, TAKEN, 1.0
