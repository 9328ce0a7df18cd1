"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: 5.2.  Operations: 49.  SymPy 1.14.0.
Expression: sha256 75ad331ebfa1ee3e05b747c58813463b4dadd96671fbc4df84126dfbd9b29c3d.
Certificate of 5.2: sha256 36e60697b1b35dffdeea1fa2c80f51aa7e4f706d13f9400d30895270b04b38cb.
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
    o_K1 = t2 * (f3 * g2 + q1 * (J2 + J3) - f2 * g3) + q2 * t1 * (J2 + t0)
    o_K2 = t2 * (f1 * g3 + q2 * (J1 + J3) - f3 * g1) - q1 * t1 * (J1 + t0)
    o_K3 = t2 * (f2 * g1 + q3 * (J1 + J2) - f1 * g2) + 2 * q1 * q2 * (J1 - J2)
    return o_K1, o_K2, o_K3
