"""The inner loop of compositions: plain scalar Python that numba compiles.

A composition takes the stages Φ_{cᵢε} one after the other.  In the paper's variables 𝒦 = εK, so a stage finds its
rotation from cᵢ𝒦 and then carries 𝒦 itself: 𝒦 and γ turn rigidly, whatever the coefficients are.
"""

from chapsym.generated import transport

from .loop import advance, follow_body


def composed_step(K, g, J, D, q, c, stage, before, with_body, attitude, contact, radius):
    """One step of all stages in place; stage and before are room for two vectors.

    Returns (status, reach).  Where a stage is not taken, K is left with its momentum cᵢ𝒦 and g with its vertical.
    """
    for i in range(c.shape[0]):
        stage[0], stage[1], stage[2] = c[i] * K[0], c[i] * K[1], c[i] * K[2]
        before[0], before[1], before[2] = g[0], g[1], g[2]
        status, reach = advance(stage, g, J, D, q)
        if status != 0:
            K[0], K[1], K[2] = stage[0], stage[1], stage[2]
            return status, reach
        K[0], K[1], K[2] = transport(q[0], q[1], q[2], q[3], K[0], K[1], K[2])
        if with_body:
            follow_body(q, before, attitude, contact, radius)
    return 0, 1.0


def march_composed(
    K, g, J, D, q, c, first, count, every, momenta, verticals, with_body, attitude, contact, radius, attitudes, traces
):
    """`march` of `loop`, each step a composition with the stage coefficients c.  Returns (taken, status, reach)."""
    stage, before = K.copy(), g.copy()
    for k in range(first, first + count):
        status, reach = composed_step(K, g, J, D, q, c, stage, before, with_body, attitude, contact, radius)
        if status != 0:
            return k - first, status, reach
        if (k + 1) % every == 0:
            frame = (k + 1) // every
            momenta[frame, 0], momenta[frame, 1], momenta[frame, 2] = K[0], K[1], K[2]
            verticals[frame, 0], verticals[frame, 1], verticals[frame, 2] = g[0], g[1], g[2]
            if with_body:
                for i in range(4):
                    attitudes[frame, i] = attitude[i]
                traces[frame, 0], traces[frame, 1] = contact[0], contact[1]
    return count, 0, 1.0
