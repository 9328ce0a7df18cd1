"""𝒦(q, γ) - 𝒦, which the rotation of the next step makes zero (5.2).

Written by `chapsym codegen`: do not edit; change the derivation and generate again.
Proved by: 5.2.  Operations: 59.  SymPy 1.14.0.
Expression: sha256 a1532f21963741f580e54a3338de6b26e964faa6ae1cd81f1e4ad4d88ca41462.
"""


def residual(q0, q1, q2, q3, K1, K2, K3, g1, g2, g3, J1, J2, J3, D):
    """𝒦(q, γ) - 𝒦, which the rotation of the next step makes zero (5.2).

    rotation: q0, q1, q2, q3
    momentum: K1, K2, K3
    gamma: g1, g2, g3
    mass_tensor: J1, J2, J3
    D: D
    Returns r1, r2, r3.
    """
    # intermediate terms
    t0 = -J3
    t1 = 2 * q3
    t2 = D * g1
    t3 = g2 * t2
    t4 = g3 * q3
    t5 = g2 * g2
    t6 = g3 * g3
    t7 = 2 * q0
    t8 = D * g2
    t9 = g1 * g1
    # outputs
    o_r1 = t7 * (q1 * (J2 + J3 + D * (t5 + t6)) - q2 * t3 - t2 * t4) + q2 * t1 * (J2 + t0) - K1
    o_r2 = 2 * q0 * (q2 * (J1 + J3 + D * (t6 + t9)) - q1 * t3 - t4 * t8) - K2 - q1 * t1 * (J1 + t0)
    o_r3 = t7 * (q3 * (J1 + J2 + D * (t5 + t9)) - g3 * q1 * t2 - g3 * q2 * t8) + 2 * q1 * q2 * (J1 - J2) - K3
    return o_r1, o_r2, o_r3
