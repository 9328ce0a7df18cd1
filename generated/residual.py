"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: stable-momentum.  Operations: 53.  SymPy 1.14.0.
Expression: sha256 a1532f21963741f580e54a3338de6b26e964faa6ae1cd81f1e4ad4d88ca41462.
Certificate of stable-momentum: sha256 5d517e9a0dc98362d5d0de996a9a6a105aabe6676b1bbcaf61c5bb8bd0d7d172.
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
    c1 = g3 * q2 - g2 * q3
    c2 = g1 * q3 - g3 * q1
    c3 = g2 * q1 - g1 * q2
    f1 = D * c1
    f2 = D * c2
    f3 = D * c3
    t0 = -J3
    t1 = 2 * q3
    t2 = 2 * q0
    # outputs
    o_r1 = t2 * (f3 * g2 + q1 * (J2 + J3) - f2 * g3) + q2 * t1 * (J2 + t0) - K1
    o_r2 = 2 * q0 * (f1 * g3 + q2 * (J1 + J3) - f3 * g1) - K2 - q1 * t1 * (J1 + t0)
    o_r3 = t2 * (f2 * g1 + q3 * (J1 + J2) - f1 * g2) + 2 * q1 * q2 * (J1 - J2) - K3
    return o_r1, o_r2, o_r3
