"""The discrete momentum 𝒦(q, γ) about the contact point (5.2); homogeneous of degree 2 in (q0, q).

Written by `chapsym codegen`: do not edit; change the derivation and generate again.
Proved by: prop-1, 5.2.  Operations: 55.  SymPy 1.14.0.
Expression: sha256 75ad331ebfa1ee3e05b747c58813463b4dadd96671fbc4df84126dfbd9b29c3d.
"""


def momentum(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D):
    """The discrete momentum 𝒦(q, γ) about the contact point (5.2); homogeneous of degree 2 in (q0, q).

    rotation: q0, q1, q2, q3
    gamma: g1, g2, g3
    mass_tensor: J1, J2, J3
    D: D
    Returns K1, K2, K3.
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
    o_K1 = t7 * (q1 * (J2 + J3 + D * (t5 + t6)) - q2 * t3 - t2 * t4) + q2 * t1 * (J2 + t0)
    o_K2 = t7 * (q2 * (J1 + J3 + D * (t6 + t9)) - q1 * t3 - t4 * t8) - q1 * t1 * (J1 + t0)
    o_K3 = t7 * (q3 * (J1 + J2 + D * (t5 + t9)) - g3 * q1 * t2 - g3 * q2 * t8) + 2 * q1 * q2 * (J1 - J2)
    return o_K1, o_K2, o_K3
