"""The inner loop of compositions: plain scalar Python that numba compiles.

A composition takes the stages Φ_{cᵢε} one after the other.  In the paper's variables 𝒦 = εK, so a stage finds its
rotation from cᵢ𝒦 and then carries 𝒦 itself: 𝒦 and γ turn rigidly, whatever the coefficients are.  The Gibbs vector
of the stage i is smooth from step to step, so each stage has an extrapolation of its own.
"""

from chapsym.generated import turn

from .gibbs import settle
from .integrals import PERIOD, restore
from .loop import follow_body, put, safe_rotation, three

#: The polynomial through the last 8 Gibbs vectors, as a filter.
WEIGHTS = (8.0, -28.0, 56.0, -70.0, 56.0, -28.0, 8.0, -1.0)


def extrapolated(past, w1, w2, w3):
    """Takes the newest Gibbs vector of a stage into its filter (8, 3), the first row of which is the next guess."""
    for j in range(7):
        past[j, 0] = past[j + 1, 0] + WEIGHTS[j] * w1
        past[j, 1] = past[j + 1, 1] + WEIGHTS[j] * w2
        past[j, 2] = past[j + 1, 2] + WEIGHTS[j] * w3
    past[7, 0], past[7, 1], past[7, 2] = WEIGHTS[7] * w1, WEIGHTS[7] * w2, WEIGHTS[7] * w3


def turned_with(p0, p1, p2, p3, v, rest, at):
    """Turns the vector v by the quaternion p in place, with the compensation of its sum in rest[at:]."""
    v1, v2, v3 = three(v, 0)
    x1, x2, x3 = three(rest, at)
    z1, z2, z3 = turn(p0, p1, p2, p3, v1, v2, v3)
    z1, z2, z3 = z1 - x1, z2 - x2, z3 - x3
    w1, w2, w3 = v1 + z1, v2 + z2, v3 + z3
    put(rest, at, (w1 - v1) - z1, (w2 - v2) - z2, (w3 - v3) - z3)
    put(v, 0, w1, w2, w3)


def composed_step(k, g, J, I, D, c, radius, contraction, past, memory, with_body, attitude, contact, rho):
    """All stages of one step, in place: k = 𝒦/2, g, and what is remembered.

    c, radius, contraction: of the stages, (s,); past: their filters, (s, 8, 3).  Returns (status, reach).  Where a
    stage is not taken, k is left with its momentum, cᵢ𝒦/2, and g with its vertical.
    """
    for i in range(c.shape[0]):
        k1, k2, k3 = c[i] * k[0], c[i] * k[1], c[i] * k[2]
        g1, g2, g3 = three(g, 0)
        settled, p0, p1, p2, p3, w1, w2, w3 = settle(
            past[i, 0, 0], past[i, 0, 1], past[i, 0, 2], k1, k2, k3, g1, g2, g3,
            I[0], I[1], I[2], D, radius[i], contraction[i],
        )  # fmt: skip
        if not settled:
            status, reach, p0, p1, p2, p3, w1, w2, w3 = safe_rotation(
                w1, w2, w3, k1, k2, k3, g1, g2, g3, J, I, D, radius[i], contraction[i]
            )
            if status != 0:
                put(k, 0, k1, k2, k3)
                return status, reach
        extrapolated(past[i], w1, w2, w3)
        if with_body:
            follow_body(p0, p1, p2, p3, g1, g2, g3, attitude, contact, rho)
        turned_with(p0, p1, p2, p3, k, memory, 0)
        turned_with(p0, p1, p2, p3, g, memory, 3)
    return 0, 1.0


def march_composed(
    k, g, J, I, D, c, radius, contraction, past, memory, first, count, every, scale,
    momenta, verticals, with_body, attitude, contact, rho, attitudes, traces,
):  # fmt: skip
    """`march` of `loop`, each step a composition with the stage coefficients c.  Returns (taken, status, reach)."""
    period = max(1, PERIOD // c.shape[0])
    for step in range(first + 1, first + count + 1):
        status, reach = composed_step(
            k, g, J, I, D, c, radius, contraction, past, memory, with_body, attitude, contact, rho
        )
        if status != 0:
            return step - 1 - first, status, reach
        if step % period == 0:
            restore(k[0], k[1], k[2], g[0], g[1], g[2], memory)
        if step % every == 0:
            frame = step // every
            put(momenta[frame], 0, scale * k[0], scale * k[1], scale * k[2])
            put(verticals[frame], 0, g[0], g[1], g[2])
            if with_body:
                for i in range(4):
                    attitudes[frame, i] = attitude[i]
                traces[frame, 0], traces[frame, 1] = contact[0], contact[1]
    return count, 0, 1.0
