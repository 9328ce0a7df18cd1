"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: 5.2.  Operations: 137.  SymPy 1.14.0.
Expression: sha256 70929b34a14edeab42d2458890bb8cc2e49395acc5fec6b7fac464a6359defb2.
Certificate of 5.2: sha256 36e60697b1b35dffdeea1fa2c80f51aa7e4f706d13f9400d30895270b04b38cb.
"""


def tangent_jacobian(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D):
    """The derivative of 𝒦 along q ∘ (0, w), w ∈ R³, row by row; regular at every rotation.

    rotation: q0, q1, q2, q3
    gamma: g1, g2, g3
    mass_tensor: J1, J2, J3
    D: D
    Returns dK11, dK12, dK13, dK21, dK22, dK23, dK31, dK32, dK33, the 3×3 matrix row by row.
    """
    # intermediate terms
    t0 = q0 * q0
    t1 = g2 * g2
    t2 = g3 * g3
    t3 = J2 + J3 + D * (t1 + t2)
    t4 = 2 * t3
    t5 = 2 * D * g1
    t6 = g2 * t5
    t7 = q0 * t6
    t8 = -J3
    t9 = J2 + t8
    t10 = 2 * q3 * t9 - t7
    t11 = g3 * t5
    t12 = q0 * t11
    t13 = 2 * q2 * t9 - t12
    t14 = 2 * q1 * t3 - q2 * t6 - q3 * t11
    t15 = q0 * t4
    t16 = g1 * g1
    t17 = J1 + J3 + D * (t16 + t2)
    t18 = 2 * t17
    t19 = q0 * t18
    t20 = 2 * J1 + 2 * t8
    t21 = -t7 - q3 * t20
    t22 = 2 * D * g2 * g3
    t23 = q0 * t22
    t24 = -t23 - q1 * t20
    t25 = 2 * q2 * t17 - q1 * t6 - q3 * t22
    t26 = J1 + J2 + D * (t1 + t16)
    t27 = 2 * t26
    t28 = q0 * t27
    t29 = J1 - J2
    t30 = 2 * q2 * t29 - t12
    t31 = 2 * q1 * t29 - t23
    t32 = 2 * q3 * t26 - q1 * t11 - q2 * t22
    # outputs
    o_dK11 = (q3 * t10 + t0 * t4) - (q1 * t14 + q2 * t13)
    o_dK12 = (q0 * t10 + q1 * t13) - (q2 * t14 + q3 * t15)
    o_dK13 = (q0 * t13 + q2 * t15) - (q1 * t10 + q3 * t14)
    o_dK21 = (q0 * t21 + q3 * t19) - (q1 * t25 + q2 * t24)
    o_dK22 = (q1 * t24 + t0 * t18) - (q2 * t25 + q3 * t21)
    o_dK23 = (q0 * t24 + q2 * t21) - (q1 * t19 + q3 * t25)
    o_dK31 = (q0 * t30 + q3 * t31) - (q1 * t32 + q2 * t28)
    o_dK32 = (q0 * t31 + q1 * t28) - (q2 * t32 + q3 * t30)
    o_dK33 = (q2 * t30 + t0 * t27) - (q1 * t31 + q3 * t32)
    return o_dK11, o_dK12, o_dK13, o_dK21, o_dK22, o_dK23, o_dK31, o_dK32, o_dK33
