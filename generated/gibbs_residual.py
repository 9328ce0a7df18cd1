"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: gibbs.  Operations: 51.  SymPy 1.14.0.
Expression: sha256 3d412801f7d385f80f70d5c53092c9cbb357c2660d733bc5c933bb793e2a9695.
Certificate of gibbs: sha256 c3afc5e6c7d82e40fcfa3271af0508870c2b4c61cd736c8cb3238957ed2cf795.
"""


def gibbs_residual(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D):
    """G(u) = B(γ)u + u × Iu - (1 + |u|²)k, which the Gibbs vector of the next step makes zero.

    gibbs: u1, u2, u3
    half_momentum: k1, k2, k3
    gamma: g1, g2, g3
    inertia: I1, I2, I3
    D: D
    Returns r1, r2, r3.
    """
    # intermediate terms
    x1 = g3 * u2 - g2 * u3
    x2 = g1 * u3 - g3 * u1
    x3 = g2 * u1 - g1 * u2
    y1 = I1 * u1
    y2 = I2 * u2
    y3 = I3 * u3
    s = (1 + u1 * u1) + (u2 * u2 + u3 * u3)
    # outputs
    o_r1 = (y1 + D * (g2 * x3 - g3 * x2) + u2 * y3) - (k1 * s + u3 * y2)
    o_r2 = (y2 + D * (g3 * x1 - g1 * x3) + u3 * y1) - (k2 * s + u1 * y3)
    o_r3 = (y3 + D * (g1 * x2 - g2 * x1) + u1 * y2) - (k3 * s + u2 * y1)
    return o_r1, o_r2, o_r3
