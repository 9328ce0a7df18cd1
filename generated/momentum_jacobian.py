"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: 5.2.  Operations: 95.  SymPy 1.14.0.
Expression: sha256 1a94b029e62f39c9583843a13d0847a3dfee7deb89e19d06fa6b1a5a3682ebc6.
Certificate of 5.2: sha256 36e60697b1b35dffdeea1fa2c80f51aa7e4f706d13f9400d30895270b04b38cb.
"""


def momentum_jacobian(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D):
    """∂𝒦/∂q in the chart q0 = sqrt(1 - |q|²), row by row; it divides by q0.

    rotation: q0, q1, q2, q3
    gamma: g1, g2, g3
    mass_tensor: J1, J2, J3
    D: D
    Returns dK11, dK12, dK13, dK21, dK22, dK23, dK31, dK32, dK33, the 3×3 matrix row by row.
    """
    # intermediate terms
    t0 = g2 * g2
    t1 = g3 * g3
    t2 = J2 + J3 + D * (t0 + t1)
    t3 = 1 / q0
    t4 = 2 * D * g1
    t5 = g2 * t4
    t6 = g3 * t4
    t7 = t3 * (2 * q1 * t2 - q2 * t5 - q3 * t6)
    t8 = q0 * t5
    t9 = -J3
    t10 = J2 + t9
    t11 = q0 * t6
    t12 = 2 * J1 + 2 * t9
    t13 = 2 * D * g2 * g3
    t14 = g1 * g1
    t15 = J1 + J3 + D * (t1 + t14)
    t16 = t3 * (2 * q2 * t15 - q1 * t5 - q3 * t13)
    t17 = q0 * t13
    t18 = J1 - J2
    t19 = J1 + J2 + D * (t0 + t14)
    t20 = t3 * (2 * q3 * t19 - q1 * t6 - q2 * t13)
    # outputs
    o_dK11 = 2 * q0 * t2 - q1 * t7
    o_dK12 = 2 * q3 * t10 - t8 - q2 * t7
    o_dK13 = 2 * q2 * t10 - t11 - q3 * t7
    o_dK21 = -t8 - q1 * t16 - q3 * t12
    o_dK22 = 2 * q0 * t15 - q2 * t16
    o_dK23 = -t17 - q1 * t12 - q3 * t16
    o_dK31 = 2 * q2 * t18 - t11 - q1 * t20
    o_dK32 = 2 * q1 * t18 - t17 - q2 * t20
    o_dK33 = 2 * q0 * t19 - q3 * t20
    return o_dK11, o_dK12, o_dK13, o_dK21, o_dK22, o_dK23, o_dK31, o_dK32, o_dK33
