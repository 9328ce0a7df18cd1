"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: 5.2.  Operations: 347.  SymPy 1.14.0.
Expression: sha256 36b7e708d75b061dc08c9a9f6d82e512739f151b84b60c6406715ba78a2824d3.
Certificate of 5.2: sha256 36e60697b1b35dffdeea1fa2c80f51aa7e4f706d13f9400d30895270b04b38cb.
"""


def tangent_hessian(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D):
    """The constant second derivative of 𝒦(q ∘ (1, w)) in w: the vectors for 11, 22, 33, 23, 13, 12.

    rotation: q0, q1, q2, q3
    gamma: g1, g2, g3
    mass_tensor: J1, J2, J3
    D: D
    Returns ddK11_1, ddK11_2, ddK11_3, ddK22_1, ddK22_2, ddK22_3, ddK33_1, ddK33_2, ddK33_3, ddK23_1, ddK23_2, ddK23_3, ddK13_1, ddK13_2, ddK13_3, ddK12_1, ddK12_2, ddK12_3, the 6×3 matrix row by row.
    """
    # intermediate terms
    t0 = q0 * q1
    t1 = J3 * t0
    t2 = q2 * q3
    t3 = J3 * t2
    t4 = J2 * t0 + J2 * t2
    t5 = g3 * q2
    t6 = g1 * t5
    t7 = g2 * g2
    t8 = q0 * t7
    t9 = g3 * g3
    t10 = q0 * t9
    t11 = g1 * g2
    t12 = q3 * t11
    t13 = 4 * D
    t14 = q1 * t13
    t15 = q1 * q3
    t16 = J1 * t15
    t17 = q0 * q2
    t18 = J3 * t15 + J3 * t17
    t19 = 4 * J1 * q0 * q2 - 4 * t16 - 4 * t18
    t20 = g1 * g1
    t21 = q3 * t20
    t22 = q3 * t9
    t23 = q1 * q2
    t24 = J2 * t23
    t25 = q0 * q3
    t26 = J2 * t25
    t27 = J1 * t23 + J1 * t25
    t28 = 4 * t24 + 4 * t27 - 4 * t26
    t29 = g1 * g3
    t30 = g2 * g3
    t31 = q2 * t20
    t32 = q2 * t7
    t33 = 4 * t3 + 4 * t4 - 4 * t1
    t34 = q3 * t7
    t35 = q2 * t13
    t36 = q0 * t20
    t37 = q1 * t30
    t38 = q1 * t20
    t39 = q2 * t9
    t40 = q3 * t13
    t41 = q0 * q0
    t42 = J2 * t41
    t43 = q1 * q1
    t44 = J3 * t43
    t45 = q2 * q2
    t46 = J2 * t45
    t47 = J3 * t45
    t48 = q3 * q3
    t49 = J3 * t48 - J3 * t41
    t50 = J2 * t48 - J2 * t43
    t51 = t11 * t25
    t52 = t17 * t29
    t53 = t15 * t29
    t54 = t11 * t23
    t55 = t48 * t9
    t56 = t45 * t7
    t57 = 2 * D
    t58 = 4 * J3
    t59 = q3 * t10
    t60 = q1 * t39 - t11 * t48
    t61 = 4 * J2
    t62 = q2 * t8
    t63 = q1 * t34 - t29 * t45
    t64 = J1 * t48
    t65 = J1 * t45
    t66 = J1 * t41 - J1 * t43
    t67 = t0 * t30
    t68 = t2 * t30
    t69 = t20 * t43
    t70 = 4 * J1
    t71 = q2 * t21 - t30 * t43
    # outputs
    o_ddK11_1 = (4 * t3 - 4 * t1) - (4 * t4 + t14 * ((t10 + t6) + (t8 - t12)))
    o_ddK11_2 = t19 + t14 * ((g1 * g2 * q0 - t21) - (t22 + g2 * t5))
    o_ddK11_3 = t28 + t14 * ((t31 + t32) + (q0 * t29 + q3 * t30))
    o_ddK22_1 = t33 + t35 * ((t22 + t34) + (q0 * t11 + q1 * t29))
    o_ddK22_2 = (4 * t16 - 4 * t18) - (4 * J1 * t17 + t35 * ((t10 + t12) + (t36 - t37)))
    o_ddK22_3 = t35 * ((g2 * g3 * q0 - t38) - (q1 * t7 + q3 * t29)) - t28
    o_ddK33_1 = t40 * ((g1 * g3 * q0 - t32) - (t39 + q1 * t11)) - t33
    o_ddK33_2 = t40 * ((t38 + q0 * t30) + (q1 * t9 + q2 * t11)) - t19
    o_ddK33_3 = (4 * t24 - 4 * t26) - (4 * t27 + t40 * ((t36 + t37) + (t8 - t6)))
    o_ddK23_1 = ((2 * t42 + 2 * t44) + (2 * t49 + 2 * t50)) + (t57 * (((t51 + t52) + (t53 + t55)) + ((t48 * t7 - t54) - (t56 + t45 * t9))) - 2 * t46 - 2 * t47)
    o_ddK23_2 = t57 * (((t60 + q1 * t31) + (t11 * t45 + t15 * t30)) + (t17 * t30 - t59 - q0 * t21)) - t58 * (t25 - t23)
    o_ddK23_3 = -t57 * (((t62 + t63) + (q0 * t31 + q1 * t21)) + (t23 * t30 + t29 * t48 - t25 * t30)) - t61 * (t15 + t17)
    o_ddK13_1 = t57 * (((g1 * g3 * q0 * q1 - t59) - (t60 + q1 * t32)) - (q3 * t8 + t11 * t43 + t2 * t29)) - t58 * (t23 + t25)
    o_ddK13_2 = ((2 * t44 + 2 * t65) + (t57 * (((t51 + t54) + (t67 + t69)) + ((t43 * t9 - t55) - (t68 + t20 * t48))) - 2 * t47)) - (2 * t49 + 2 * t64 + 2 * t66)
    o_ddK13_3 = -t57 * (((q0 * q1 * t20 + q0 * q1 * t7) - (t71 + q3 * t32)) - (t23 * t29 + t25 * t29 + t30 * t48)) - t70 * (t0 - t2)
    o_ddK12_1 = t57 * (((t63 + q1 * t22) + (t0 * t11 + t11 * t2)) + (t29 * t43 - t62 - q2 * t10)) - t61 * (t17 - t15)
    o_ddK12_2 = -t57 * (((t71 + q1 * t10) + (q1 * t36 + q2 * t22)) + (t11 * t15 + t30 * t45 - t11 * t17)) - t70 * (t0 + t2)
    o_ddK12_3 = ((2 * t46 + 2 * t50) + (2 * t65 + 2 * t66)) + (t57 * (((t52 + t56) + (t67 + t68)) + ((t20 * t45 - t53) - (t69 + t43 * t7))) - 2 * t42 - 2 * t64)
    return o_ddK11_1, o_ddK11_2, o_ddK11_3, o_ddK22_1, o_ddK22_2, o_ddK22_3, o_ddK33_1, o_ddK33_2, o_ddK33_3, o_ddK23_1, o_ddK23_2, o_ddK23_3, o_ddK13_1, o_ddK13_2, o_ddK13_3, o_ddK12_1, o_ddK12_2, o_ddK12_3
