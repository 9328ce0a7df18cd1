"""Many steps of one ball in double-double.

A step is a composition with any stages, of which the map itself has one.  𝒦, γ, the attitude and the contact point are
pairs, and need no compensation; the integrals are restored now and then.
"""

from math import ldexp

from chapsym.generated.double_double import roll_pairs, turn_pairs
from chapsym.numbers.pairs import (
    divide,
    loose_add,
    loose_add_float,
    loose_multiply,
    multiply,
    root,
    subtract,
    two_sum,
)

from .branch import TAKEN
from .double_double_step import bounds, scales, solved, unit
from .integrals import PERIOD, shares
from .sums import filtered
from .text import Cube, Matrix, Vector, out_of_line

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
    state[G], state[G + 1], state[G + 2], state[G + 3], state[G + 4], state[G + 5] = unit(g[0], g[1], g[2])
    state[I], state[I + 1] = two_sum(state[J + 1], state[J + 2])
    state[I + 2], state[I + 3] = two_sum(state[J], state[J + 2])
    state[I + 4], state[I + 5] = two_sum(state[J], state[J + 1])
    remember_pairs(state)
    for i in range(c.shape[0]):
        s = c[i, 0]
        radius[i], enough[i] = bounds(
            s * state[K], s * state[K + 2], s * state[K + 4], state[I], state[I + 2], state[I + 4], state[D]
        )
    return shift, beyond


def inner(a, b):
    """⟨a, b⟩ of two vectors of pairs."""
    x, x_ = loose_multiply(a[0], a[1], b[0], b[1])
    y, y_ = loose_multiply(a[2], a[3], b[2], b[3])
    z, z_ = loose_multiply(a[4], a[5], b[4], b[5])
    x, x_ = loose_add(x, x_, y, y_)
    x, x_ = loose_add(x, x_, z, z_)
    return two_sum(x, x_)


def remember_pairs(state):
    """Writes ⟨γ,γ⟩, ⟨k,γ⟩ and ⟨k,k⟩ into the state."""
    k, g = state[K:G], state[G:I]
    state[INTEGRALS], state[INTEGRALS + 1] = inner(g, g)
    state[INTEGRALS + 2], state[INTEGRALS + 3] = inner(k, g)
    state[INTEGRALS + 4], state[INTEGRALS + 5] = inner(k, k)


@out_of_line
def restore_pairs(state):
    """Gives k and γ the three integrals again, up to the rounding of these: else they walk by u² at each step."""
    k, g, h = state[K:G], state[G:I], state[INTEGRALS:ROWS]
    unit, _ = subtract(h[0], h[1], *inner(g, g))
    height, _ = subtract(h[2], h[3], *inner(k, g))
    squared, _ = subtract(h[4], h[5], *inner(k, k))
    stretch, along_k, along_gamma = shares(unit, height, squared, h[0], h[2], h[4])
    for i in range(0, 6, 2):
        k[i], k[i + 1] = two_sum(k[i], k[i + 1] + (along_k * k[i] + along_gamma * g[i]))
        g[i], g[i + 1] = two_sum(g[i], g[i + 1] + stretch * g[i])


def extrapolated(past, w1, w2, w3):
    """Takes the newest Gibbs vector of a stage into its filter (8, 3), the first row of which is the next guess."""
    for c, w in ((0, w1), (1, w2), (2, w3)):
        (
            past[0, c], past[1, c], past[2, c], past[3, c], past[4, c], past[5, c], past[6, c], past[7, c]
        ) = filtered(past[1, c], past[2, c], past[3, c], past[4, c], past[5, c], past[6, c], past[7, c], w)  # fmt: skip


def stage(state, c, c_, radius, enough, past):
    """The Gibbs vector of a stage with the coefficient c, and its filter carried on; returns as `solved`."""
    k1, k1_ = multiply(state[K], state[K + 1], c, c_)
    k2, k2_ = multiply(state[K + 2], state[K + 3], c, c_)
    k3, k3_ = multiply(state[K + 4], state[K + 5], c, c_)
    status, reach, u1, u1_, u2, u2_, u3, u3_ = solved(
        past[0, 0], past[0, 1], past[0, 2], k1, k1_, k2, k2_, k3, k3_,
        state[G], state[G + 1], state[G + 2], state[G + 3], state[G + 4], state[G + 5],
        state[I], state[I + 1], state[I + 2], state[I + 3], state[I + 4], state[I + 5],
        state[J], state[J + 1], state[J + 2], state[D], radius, enough,
    )  # fmt: skip
    if status == TAKEN:
        extrapolated(past, u1, u2, u3)
    return status, reach, u1, u1_, u2, u2_, u3, u3_


def follow_body(u1, u1_, u2, u2_, u3, u3_, state, attitude, contact, rho):
    """Moves the attitude (8) and the contact point (4), pairs, by the step with the Gibbs vector u."""
    n, n_ = loose_add(*loose_multiply(u1, u1_, u1, u1_), *loose_multiply(u2, u2_, u2, u2_))
    n, n_ = loose_add(n, n_, *loose_multiply(u3, u3_, u3, u3_))
    n, n_ = root(*two_sum(*loose_add_float(n, n_, 1.0)))
    q0, q0_ = divide(1.0, 0.0, n, n_)
    (
        attitude[0], attitude[1], attitude[2], attitude[3], attitude[4], attitude[5], attitude[6], attitude[7],
        contact[0], contact[1], contact[2], contact[3],
    ) = roll_pairs(
        q0, q0_, u1, u1_, u2, u2_, u3, u3_,
        state[G], state[G + 1], state[G + 2], state[G + 3], state[G + 4], state[G + 5],
        attitude[0], attitude[1], attitude[2], attitude[3], attitude[4], attitude[5], attitude[6], attitude[7],
        contact[0], contact[1], contact[2], contact[3], rho,
    )  # fmt: skip


def turn_both(u1, u1_, u2, u2_, u3, u3_, state):
    """Turns k and γ."""
    (
        state[0], state[1], state[2], state[3], state[4], state[5],
        state[6], state[7], state[8], state[9], state[10], state[11],
    ) = turn_pairs(
        u1, u1_, u2, u2_, u3, u3_, state[0], state[1], state[2], state[3], state[4], state[5],
        state[6], state[7], state[8], state[9], state[10], state[11],
    )  # fmt: skip


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
            status, reach, u1, u1_, u2, u2_, u3, u3_ = stage(state, c[i, 0], c[i, 1], radius[i], enough[i], past[i])
            if status != TAKEN:
                return step - 1 - first, status, reach
            if with_body:
                follow_body(u1, u1_, u2, u2_, u3, u3_, state, attitude, contact, rho)
            turn_both(u1, u1_, u2, u2_, u3, u3_, state)
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
