"""G(u) = B(γ)u + u × Iu - (1 + |u|²)k with u = q/q0, k = 𝒦/2: zero for the rotation of the next step (5.2).

Written by `chapsym codegen`: do not edit; change the derivation and generate again.
Proved by: gibbs.  Operations: 62.  SymPy 1.14.0.
Expression: sha256 3d412801f7d385f80f70d5c53092c9cbb357c2660d733bc5c933bb793e2a9695.
"""


def gibbs_residual(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D):
    """G(u) = B(γ)u + u × Iu - (1 + |u|²)k with u = q/q0, k = 𝒦/2: zero for the rotation of the next step (5.2).

    gibbs: u1, u2, u3
    half_momentum: k1, k2, k3
    gamma: g1, g2, g3
    inertia: I1, I2, I3
    D: D
    Returns r1, r2, r3.
    """
    # intermediate terms
    n = 1 + u1 * u1 + u2 * u2 + u3 * u3
    t0 = g2 * g2
    t1 = g3 * g3
    t2 = D * g1
    t3 = g1 * g1
    b11 = I1 + D * (t0 + t1)
    b12 = -g2 * t2
    b13 = -g3 * t2
    b22 = I2 + D * (t1 + t3)
    b23 = -D * g2 * g3
    b33 = I3 + D * (t0 + t3)
    t4 = u2 * u3
    t5 = u1 * u3
    t6 = u1 * u2
    # outputs
    o_r1 = I3 * t4 + b11 * u1 + b12 * u2 + b13 * u3 - I2 * t4 - k1 * n
    o_r2 = I1 * t5 + b12 * u1 + b22 * u2 + b23 * u3 - I3 * t5 - k2 * n
    o_r3 = I2 * t6 + b13 * u1 + b23 * u2 + b33 * u3 - I1 * t6 - k3 * n
    return o_r1, o_r2, o_r3
