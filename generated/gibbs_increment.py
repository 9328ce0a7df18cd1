"""Ωᵀv - v = 2/(1 + |u|²)·(u × (u × v) - u × v) of the rotation with the Gibbs vector u.

Written by `chapsym codegen`: do not edit; change the derivation and generate again.
Proved by: gibbs-rotation.  Operations: 31.  SymPy 1.14.0.
Expression: sha256 bb4acba944e27deb3d0eca56b132b211aef95dbcc124c25b23336f8dca5f01df.
"""


def gibbs_increment(u1, u2, u3, v1, v2, v3):
    """Ωᵀv - v = 2/(1 + |u|²)·(u × (u × v) - u × v) of the rotation with the Gibbs vector u.

    gibbs: u1, u2, u3
    vector: v1, v2, v3
    Returns x1, x2, x3.
    """
    # intermediate terms
    s = 2 / (1 + u1 * u1 + u2 * u2 + u3 * u3)
    p1 = u2 * v3 - u3 * v2
    p2 = u3 * v1 - u1 * v3
    p3 = u1 * v2 - u2 * v1
    # outputs
    o_x1 = s * (p3 * u2 - p1 - p2 * u3)
    o_x2 = s * (p1 * u3 - p2 - p3 * u1)
    o_x3 = s * (p2 * u1 - p3 - p1 * u2)
    return o_x1, o_x2, o_x3
