"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: stable-inverse.  Operations: 39.  SymPy 1.14.0.
Expression: sha256 6ded677a84093b061a97f89aafc747634aa5807172e160ea9656bfd65bb9d7cf.
Certificate of stable-inverse: sha256 5db020d5d32aa64d3f60ea9a20bbe1d8c232f9965594c3c29928f58603dd4c28.
"""


def angular_velocity(K1, K2, K3, g1, g2, g3, J1, J2, J3, D):
    """ω(K, γ) of the continuous ball (the unnumbered inverse before 2.5, as corrected).

    momentum: K1, K2, K3
    gamma: g1, g2, g3
    mass_tensor: J1, J2, J3
    D: D
    Returns w1, w2, w3.
    """
    # intermediate terms
    t0 = J2 + J3
    t1 = 1 / (D + t0)
    t2 = J1 + J3
    t3 = 1 / (D + t2)
    t4 = J1 + J2
    t5 = 1 / (D + t4)
    t6 = D * (K1 * g1 * t1 + K2 * g2 * t3 + K3 * g3 * t5) / (g1 * g1 * t0 * t1 + g2 * g2 * t2 * t3 + g3 * g3 * t4 * t5)
    # outputs
    o_w1 = t1 * (K1 + g1 * t6)
    o_w2 = t3 * (K2 + g2 * t6)
    o_w3 = t5 * (K3 + g3 * t6)
    return o_w1, o_w2, o_w3
