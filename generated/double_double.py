"""The parts of a step on double-double numbers; x and x_ are the halves of x.

Written by `chapsym codegen`: do not edit; change the derivation and generate again.
From the kernels centre_step, compose, gibbs_residual, isotropic_spin, residual, rotate, turn.
Proved by: 4.9, 5.1, gibbs, gibbs-rotation, isotropic-spin, stable-momentum.
Programs: sha256 d0d28b418bb27e49b429c94c7a56ee601b776e562768a595ca24bcbf47d750fe.
"""

from chapsym.numbers.pairs import divide, loose_add, loose_add_float, loose_multiply, loose_multiply_float, loose_subtract, two_product, two_sum


def gibbs_residual_pairs(u1, u2, u3, k1, k1_, k2, k2_, k3, k3_, g1, g1_, g2, g2_, g3, g3_, I1, I1_, I2, I2_, I3, I3_, D):
    """G(u) = B(γ)u + u × Iu - (1 + |u|²)k at a float64 u; what is small of it has the error of its terms.

    gibbs: u1, u2, u3
    half_momentum: k1, k2, k3
    gamma: g1, g2, g3
    inertia: I1, I2, I3
    D: D
    Returns r1, r2, r3 as normalised pairs.  u1, u2, u3, D: float64; the others are pairs.
    Operations: 317.
    """
    t0, t0_ = loose_multiply_float(g3, g3_, u2)
    t1, t1_ = loose_multiply_float(g2, g2_, u3)
    t2, t2_ = loose_subtract(t0, t0_, t1, t1_)
    t3, t3_ = loose_multiply_float(g1, g1_, u3)
    t4, t4_ = loose_multiply_float(g3, g3_, u1)
    t5, t5_ = loose_subtract(t3, t3_, t4, t4_)
    t6, t6_ = loose_multiply_float(g2, g2_, u1)
    t7, t7_ = loose_multiply_float(g1, g1_, u2)
    t8, t8_ = loose_subtract(t6, t6_, t7, t7_)
    t9, t9_ = loose_multiply_float(I1, I1_, u1)
    t10, t10_ = loose_multiply_float(I2, I2_, u2)
    t11, t11_ = loose_multiply_float(I3, I3_, u3)
    t12, t12_ = two_product(u1, u1)
    t13, t13_ = loose_add_float(t12, t12_, 1)
    t14, t14_ = two_product(u2, u2)
    t15, t15_ = two_product(u3, u3)
    t16, t16_ = loose_add(t14, t14_, t15, t15_)
    t17, t17_ = loose_add(t13, t13_, t16, t16_)
    t18, t18_ = loose_multiply(g2, g2_, t8, t8_)
    t19, t19_ = loose_multiply(g3, g3_, t5, t5_)
    t20, t20_ = loose_subtract(t18, t18_, t19, t19_)
    t21, t21_ = loose_multiply_float(t20, t20_, D)
    t22, t22_ = loose_add(t9, t9_, t21, t21_)
    t23, t23_ = loose_multiply_float(t11, t11_, u2)
    t24, t24_ = loose_add(t22, t22_, t23, t23_)
    t25, t25_ = loose_multiply(k1, k1_, t17, t17_)
    t26, t26_ = loose_multiply_float(t10, t10_, u3)
    t27, t27_ = loose_add(t25, t25_, t26, t26_)
    t28, t28_ = loose_subtract(t24, t24_, t27, t27_)
    t29, t29_ = loose_multiply(g3, g3_, t2, t2_)
    t30, t30_ = loose_multiply(g1, g1_, t8, t8_)
    t31, t31_ = loose_subtract(t29, t29_, t30, t30_)
    t32, t32_ = loose_multiply_float(t31, t31_, D)
    t33, t33_ = loose_add(t10, t10_, t32, t32_)
    t34, t34_ = loose_multiply_float(t9, t9_, u3)
    t35, t35_ = loose_add(t33, t33_, t34, t34_)
    t36, t36_ = loose_multiply(k2, k2_, t17, t17_)
    t37, t37_ = loose_multiply_float(t11, t11_, u1)
    t38, t38_ = loose_add(t36, t36_, t37, t37_)
    t39, t39_ = loose_subtract(t35, t35_, t38, t38_)
    t40, t40_ = loose_multiply(g1, g1_, t5, t5_)
    t41, t41_ = loose_multiply(g2, g2_, t2, t2_)
    t42, t42_ = loose_subtract(t40, t40_, t41, t41_)
    t43, t43_ = loose_multiply_float(t42, t42_, D)
    t44, t44_ = loose_add(t11, t11_, t43, t43_)
    t45, t45_ = loose_multiply_float(t10, t10_, u1)
    t46, t46_ = loose_add(t44, t44_, t45, t45_)
    t47, t47_ = loose_multiply(k3, k3_, t17, t17_)
    t48, t48_ = loose_multiply_float(t9, t9_, u2)
    t49, t49_ = loose_add(t47, t47_, t48, t48_)
    t50, t50_ = loose_subtract(t46, t46_, t49, t49_)
    o_r1, o_r1_ = two_sum(t28, t28_)
    o_r2, o_r2_ = two_sum(t39, t39_)
    o_r3, o_r3_ = two_sum(t50, t50_)
    return o_r1, o_r1_, o_r2, o_r2_, o_r3, o_r3_


def residual_pairs(q0, q0_, q1, q1_, q2, q2_, q3, q3_, K1, K1_, K2, K2_, K3, K3_, g1, g1_, g2, g2_, g3, g3_, J1, J2, J3, D):
    """𝒦(q, γ) - 𝒦 (5.2) at Euler parameters of length 1.

    rotation: q0, q1, q2, q3
    momentum: K1, K2, K3
    gamma: g1, g2, g3
    mass_tensor: J1, J2, J3
    D: D
    Returns r1, r2, r3 as normalised pairs.  J1, J2, J3, D: float64; the others are pairs.
    Operations: 428.
    """
    t0, t0_ = loose_multiply(q2, q2_, g3, g3_)
    t1, t1_ = loose_multiply(q3, q3_, g2, g2_)
    t2, t2_ = loose_subtract(t0, t0_, t1, t1_)
    t2, t2_ = two_sum(t2, t2_)
    t3, t3_ = loose_multiply(q3, q3_, g1, g1_)
    t4, t4_ = loose_multiply(q1, q1_, g3, g3_)
    t5, t5_ = loose_subtract(t3, t3_, t4, t4_)
    t5, t5_ = two_sum(t5, t5_)
    t6, t6_ = loose_multiply(q1, q1_, g2, g2_)
    t7, t7_ = loose_multiply(q2, q2_, g1, g1_)
    t8, t8_ = loose_subtract(t6, t6_, t7, t7_)
    t8, t8_ = two_sum(t8, t8_)
    t9, t9_ = loose_multiply_float(t2, t2_, D)
    t10, t10_ = loose_multiply_float(t5, t5_, D)
    t11, t11_ = loose_multiply_float(t8, t8_, D)
    t12 = -J3
    t13, t13_ = 2 * q3, 2 * q3_
    t14, t14_ = 2 * q0, 2 * q0_
    t15, t15_ = loose_multiply(g2, g2_, t11, t11_)
    t16, t16_ = two_sum(J2, J3)
    t17, t17_ = loose_multiply(q1, q1_, t16, t16_)
    t18, t18_ = loose_add(t15, t15_, t17, t17_)
    t18, t18_ = two_sum(t18, t18_)
    t19, t19_ = loose_multiply(g3, g3_, t10, t10_)
    t20, t20_ = loose_subtract(t18, t18_, t19, t19_)
    t20, t20_ = two_sum(t20, t20_)
    t21, t21_ = loose_multiply(t14, t14_, t20, t20_)
    t22, t22_ = loose_multiply(q2, q2_, t13, t13_)
    t23, t23_ = two_sum(J2, t12)
    t24, t24_ = loose_multiply(t22, t22_, t23, t23_)
    t25, t25_ = loose_add(t21, t21_, t24, t24_)
    t25, t25_ = two_sum(t25, t25_)
    t26, t26_ = loose_subtract(t25, t25_, K1, K1_)
    t26, t26_ = two_sum(t26, t26_)
    t27, t27_ = loose_multiply(g3, g3_, t9, t9_)
    t28, t28_ = two_sum(J1, J3)
    t29, t29_ = loose_multiply(q2, q2_, t28, t28_)
    t30, t30_ = loose_add(t27, t27_, t29, t29_)
    t30, t30_ = two_sum(t30, t30_)
    t31, t31_ = loose_multiply(g1, g1_, t11, t11_)
    t32, t32_ = loose_subtract(t30, t30_, t31, t31_)
    t32, t32_ = two_sum(t32, t32_)
    t33, t33_ = loose_multiply(t14, t14_, t32, t32_)
    t34, t34_ = loose_subtract(t33, t33_, K2, K2_)
    t34, t34_ = two_sum(t34, t34_)
    t35, t35_ = loose_multiply(q1, q1_, t13, t13_)
    t36, t36_ = two_sum(J1, t12)
    t37, t37_ = loose_multiply(t35, t35_, t36, t36_)
    t38, t38_ = loose_subtract(t34, t34_, t37, t37_)
    t38, t38_ = two_sum(t38, t38_)
    t39, t39_ = loose_multiply(g1, g1_, t10, t10_)
    t40, t40_ = two_sum(J1, J2)
    t41, t41_ = loose_multiply(q3, q3_, t40, t40_)
    t42, t42_ = loose_add(t39, t39_, t41, t41_)
    t42, t42_ = two_sum(t42, t42_)
    t43, t43_ = loose_multiply(g2, g2_, t9, t9_)
    t44, t44_ = loose_subtract(t42, t42_, t43, t43_)
    t44, t44_ = two_sum(t44, t44_)
    t45, t45_ = loose_multiply(t14, t14_, t44, t44_)
    t46, t46_ = 2 * q1, 2 * q1_
    t47, t47_ = loose_multiply(q2, q2_, t46, t46_)
    t48, t48_ = two_sum(J1, -J2)
    t49, t49_ = loose_multiply(t47, t47_, t48, t48_)
    t50, t50_ = loose_add(t45, t45_, t49, t49_)
    t50, t50_ = two_sum(t50, t50_)
    t51, t51_ = loose_subtract(t50, t50_, K3, K3_)
    t51, t51_ = two_sum(t51, t51_)
    o_r1, o_r1_ = two_sum(t26, t26_)
    o_r2, o_r2_ = two_sum(t38, t38_)
    o_r3, o_r3_ = two_sum(t51, t51_)
    return o_r1, o_r1_, o_r2, o_r2_, o_r3, o_r3_


def moved_pairs(q0, q0_, q1, q1_, q2, q2_, q3, q3_, w1, w2, w3):
    """q ∘ (1, w), divided by its length where w is small.

    rotation: q0, q1, q2, q3
    correction: w1, w2, w3
    Returns b0, b1, b2, b3 as normalised pairs.  w1, w2, w3: float64; the others are pairs.
    Operations: 249.
    """
    t0, t0_ = loose_multiply_float(q1, q1_, w1)
    t1, t1_ = loose_subtract(q0, q0_, t0, t0_)
    t2, t2_ = loose_multiply_float(q2, q2_, w2)
    t3, t3_ = loose_multiply_float(q3, q3_, w3)
    t4, t4_ = loose_add(t2, t2_, t3, t3_)
    t5, t5_ = loose_subtract(t1, t1_, t4, t4_)
    t6, t6_ = loose_multiply_float(q0, q0_, w1)
    t7, t7_ = loose_add(q1, q1_, t6, t6_)
    t8, t8_ = loose_multiply_float(q2, q2_, w3)
    t9, t9_ = loose_multiply_float(q3, q3_, w2)
    t10, t10_ = loose_subtract(t8, t8_, t9, t9_)
    t11, t11_ = loose_add(t7, t7_, t10, t10_)
    t12, t12_ = loose_multiply_float(q0, q0_, w2)
    t13, t13_ = loose_add(q2, q2_, t12, t12_)
    t14, t14_ = loose_multiply_float(q3, q3_, w1)
    t15, t15_ = loose_multiply_float(q1, q1_, w3)
    t16, t16_ = loose_subtract(t14, t14_, t15, t15_)
    t17, t17_ = loose_add(t13, t13_, t16, t16_)
    t18, t18_ = loose_multiply_float(q0, q0_, w3)
    t19, t19_ = loose_multiply_float(q1, q1_, w2)
    t20, t20_ = loose_add(t18, t18_, t19, t19_)
    t21, t21_ = loose_multiply_float(q2, q2_, w1)
    t22, t22_ = loose_subtract(q3, q3_, t21, t21_)
    t23, t23_ = loose_add(t20, t20_, t22, t22_)
    t24, t24_ = loose_multiply(t5, t5_, t5, t5_)
    t25, t25_ = loose_multiply(t11, t11_, t11, t11_)
    t26, t26_ = loose_add(t24, t24_, t25, t25_)
    t27, t27_ = loose_multiply(t17, t17_, t17, t17_)
    t28, t28_ = loose_multiply(t23, t23_, t23, t23_)
    t29, t29_ = loose_add(t27, t27_, t28, t28_)
    t30, t30_ = loose_add(t26, t26_, t29, t29_)
    t31, t31_ = loose_add_float(-t30, -t30_, 3)
    t32, t32_ = t31 / 2, t31_ / 2
    t33, t33_ = loose_multiply(t5, t5_, t32, t32_)
    t34, t34_ = loose_multiply(t11, t11_, t32, t32_)
    t35, t35_ = loose_multiply(t17, t17_, t32, t32_)
    t36, t36_ = loose_multiply(t23, t23_, t32, t32_)
    o_b0, o_b0_ = two_sum(t33, t33_)
    o_b1, o_b1_ = two_sum(t34, t34_)
    o_b2, o_b2_ = two_sum(t35, t35_)
    o_b3, o_b3_ = two_sum(t36, t36_)
    return o_b0, o_b0_, o_b1, o_b1_, o_b2, o_b2_, o_b3, o_b3_


def turn_pairs(u1, u1_, u2, u2_, u3, u3_, k1, k1_, k2, k2_, k3, k3_, g1, g1_, g2, g2_, g3, g3_):
    """Ωᵀk and Ωᵀγ for the rotation with the Gibbs vector u.

    gibbs: u1, u2, u3
    half_momentum: k1, k2, k3
    gamma: g1, g2, g3
    Returns l1, l2, l3, h1, h2, h3 as normalised pairs.
    Operations: 474.
    """
    t0, t0_ = loose_multiply(u1, u1_, u1, u1_)
    t1, t1_ = loose_add_float(t0, t0_, 1)
    t2, t2_ = loose_multiply(u2, u2_, u2, u2_)
    t3, t3_ = loose_multiply(u3, u3_, u3, u3_)
    t4, t4_ = loose_add(t2, t2_, t3, t3_)
    t5, t5_ = loose_add(t1, t1_, t4, t4_)
    t6d, t6d_ = two_sum(t5, t5_)
    t6, t6_ = divide(2, 0, t6d, t6d_)
    t7, t7_ = loose_multiply(u2, u2_, k3, k3_)
    t8, t8_ = loose_multiply(u3, u3_, k2, k2_)
    t9, t9_ = loose_subtract(t7, t7_, t8, t8_)
    t10, t10_ = loose_multiply(u3, u3_, k1, k1_)
    t11, t11_ = loose_multiply(u1, u1_, k3, k3_)
    t12, t12_ = loose_subtract(t10, t10_, t11, t11_)
    t13, t13_ = loose_multiply(u1, u1_, k2, k2_)
    t14, t14_ = loose_multiply(u2, u2_, k1, k1_)
    t15, t15_ = loose_subtract(t13, t13_, t14, t14_)
    t16, t16_ = loose_multiply(u2, u2_, t15, t15_)
    t17, t17_ = loose_subtract(t16, t16_, t9, t9_)
    t18, t18_ = loose_multiply(u3, u3_, t12, t12_)
    t19, t19_ = loose_subtract(t17, t17_, t18, t18_)
    t20, t20_ = loose_multiply(t6, t6_, t19, t19_)
    t21, t21_ = loose_multiply(u3, u3_, t9, t9_)
    t22, t22_ = loose_subtract(t21, t21_, t12, t12_)
    t23, t23_ = loose_multiply(u1, u1_, t15, t15_)
    t24, t24_ = loose_subtract(t22, t22_, t23, t23_)
    t25, t25_ = loose_multiply(t6, t6_, t24, t24_)
    t26, t26_ = loose_multiply(u1, u1_, t12, t12_)
    t27, t27_ = loose_subtract(t26, t26_, t15, t15_)
    t28, t28_ = loose_multiply(u2, u2_, t9, t9_)
    t29, t29_ = loose_subtract(t27, t27_, t28, t28_)
    t30, t30_ = loose_multiply(t6, t6_, t29, t29_)
    t31, t31_ = loose_multiply(u2, u2_, g3, g3_)
    t32, t32_ = loose_multiply(u3, u3_, g2, g2_)
    t33, t33_ = loose_subtract(t31, t31_, t32, t32_)
    t34, t34_ = loose_multiply(u3, u3_, g1, g1_)
    t35, t35_ = loose_multiply(u1, u1_, g3, g3_)
    t36, t36_ = loose_subtract(t34, t34_, t35, t35_)
    t37, t37_ = loose_multiply(u1, u1_, g2, g2_)
    t38, t38_ = loose_multiply(u2, u2_, g1, g1_)
    t39, t39_ = loose_subtract(t37, t37_, t38, t38_)
    t40, t40_ = loose_multiply(u2, u2_, t39, t39_)
    t41, t41_ = loose_subtract(t40, t40_, t33, t33_)
    t42, t42_ = loose_multiply(u3, u3_, t36, t36_)
    t43, t43_ = loose_subtract(t41, t41_, t42, t42_)
    t44, t44_ = loose_multiply(t6, t6_, t43, t43_)
    t45, t45_ = loose_multiply(u3, u3_, t33, t33_)
    t46, t46_ = loose_subtract(t45, t45_, t36, t36_)
    t47, t47_ = loose_multiply(u1, u1_, t39, t39_)
    t48, t48_ = loose_subtract(t46, t46_, t47, t47_)
    t49, t49_ = loose_multiply(t6, t6_, t48, t48_)
    t50, t50_ = loose_multiply(u1, u1_, t36, t36_)
    t51, t51_ = loose_subtract(t50, t50_, t39, t39_)
    t52, t52_ = loose_multiply(u2, u2_, t33, t33_)
    t53, t53_ = loose_subtract(t51, t51_, t52, t52_)
    t54, t54_ = loose_multiply(t6, t6_, t53, t53_)
    t55, t55_ = loose_add(k1, k1_, t20, t20_)
    t56, t56_ = loose_add(k2, k2_, t25, t25_)
    t57, t57_ = loose_add(k3, k3_, t30, t30_)
    t58, t58_ = loose_add(g1, g1_, t44, t44_)
    t59, t59_ = loose_add(g2, g2_, t49, t49_)
    t60, t60_ = loose_add(g3, g3_, t54, t54_)
    o_l1, o_l1_ = two_sum(t55, t55_)
    o_l2, o_l2_ = two_sum(t56, t56_)
    o_l3, o_l3_ = two_sum(t57, t57_)
    o_h1, o_h1_ = two_sum(t58, t58_)
    o_h2, o_h2_ = two_sum(t59, t59_)
    o_h3, o_h3_ = two_sum(t60, t60_)
    return o_l1, o_l1_, o_l2, o_l2_, o_l3, o_l3_, o_h1, o_h1_, o_h2, o_h2_, o_h3, o_h3_


def rotate_pairs(a0, a0_, a1, a1_, a2, a2_, a3, a3_, k1, k1_, k2, k2_, k3, k3_, g1, g1_, g2, g2_, g3, g3_):
    """Ak and Aγ for the attitude A.

    first: a0, a1, a2, a3
    half_momentum: k1, k2, k3
    gamma: g1, g2, g3
    Returns l1, l2, l3, h1, h2, h3 as normalised pairs.
    Operations: 426.
    """
    t0, t0_ = loose_multiply(a2, a2_, a2, a2_)
    t1, t1_ = loose_multiply(a3, a3_, a3, a3_)
    t2, t2_ = 2 * k1, 2 * k1_
    t3, t3_ = loose_multiply(a0, a0_, a2, a2_)
    t4, t4_ = loose_multiply(a1, a1_, a3, a3_)
    t5, t5_ = loose_multiply(a0, a0_, a3, a3_)
    t6, t6_ = loose_multiply(a1, a1_, a2, a2_)
    t7, t7_ = 2 * k2, 2 * k2_
    t8, t8_ = loose_multiply(a1, a1_, a1, a1_)
    t9, t9_ = loose_multiply(a0, a0_, a1, a1_)
    t10, t10_ = loose_multiply(a2, a2_, a3, a3_)
    t11, t11_ = 2 * k3, 2 * k3_
    t12, t12_ = loose_add(t3, t3_, t4, t4_)
    t13, t13_ = loose_multiply(t11, t11_, t12, t12_)
    t14, t14_ = loose_add(k1, k1_, t13, t13_)
    t15, t15_ = loose_add(t0, t0_, t1, t1_)
    t16, t16_ = loose_multiply(t2, t2_, t15, t15_)
    t17, t17_ = loose_subtract(t5, t5_, t6, t6_)
    t18, t18_ = loose_multiply(t7, t7_, t17, t17_)
    t19, t19_ = loose_add(t16, t16_, t18, t18_)
    t20, t20_ = loose_subtract(t14, t14_, t19, t19_)
    t21, t21_ = loose_add(t5, t5_, t6, t6_)
    t22, t22_ = loose_multiply(t2, t2_, t21, t21_)
    t23, t23_ = loose_add(k2, k2_, t22, t22_)
    t24, t24_ = loose_subtract(t9, t9_, t10, t10_)
    t25, t25_ = loose_multiply(t11, t11_, t24, t24_)
    t26, t26_ = loose_add(t1, t1_, t8, t8_)
    t27, t27_ = loose_multiply(t7, t7_, t26, t26_)
    t28, t28_ = loose_add(t25, t25_, t27, t27_)
    t29, t29_ = loose_subtract(t23, t23_, t28, t28_)
    t30, t30_ = loose_add(t9, t9_, t10, t10_)
    t31, t31_ = loose_multiply(t7, t7_, t30, t30_)
    t32, t32_ = loose_add(k3, k3_, t31, t31_)
    t33, t33_ = loose_add(t0, t0_, t8, t8_)
    t34, t34_ = loose_multiply(t11, t11_, t33, t33_)
    t35, t35_ = loose_subtract(t3, t3_, t4, t4_)
    t36, t36_ = loose_multiply(t2, t2_, t35, t35_)
    t37, t37_ = loose_add(t34, t34_, t36, t36_)
    t38, t38_ = loose_subtract(t32, t32_, t37, t37_)
    t39, t39_ = 2 * g1, 2 * g1_
    t40, t40_ = 2 * g2, 2 * g2_
    t41, t41_ = 2 * g3, 2 * g3_
    t42, t42_ = loose_multiply(t12, t12_, t41, t41_)
    t43, t43_ = loose_add(g1, g1_, t42, t42_)
    t44, t44_ = loose_multiply(t15, t15_, t39, t39_)
    t45, t45_ = loose_multiply(t17, t17_, t40, t40_)
    t46, t46_ = loose_add(t44, t44_, t45, t45_)
    t47, t47_ = loose_subtract(t43, t43_, t46, t46_)
    t48, t48_ = loose_multiply(t21, t21_, t39, t39_)
    t49, t49_ = loose_add(g2, g2_, t48, t48_)
    t50, t50_ = loose_multiply(t24, t24_, t41, t41_)
    t51, t51_ = loose_multiply(t26, t26_, t40, t40_)
    t52, t52_ = loose_add(t50, t50_, t51, t51_)
    t53, t53_ = loose_subtract(t49, t49_, t52, t52_)
    t54, t54_ = loose_multiply(t30, t30_, t40, t40_)
    t55, t55_ = loose_add(g3, g3_, t54, t54_)
    t56, t56_ = loose_multiply(t33, t33_, t41, t41_)
    t57, t57_ = loose_multiply(t35, t35_, t39, t39_)
    t58, t58_ = loose_add(t56, t56_, t57, t57_)
    t59, t59_ = loose_subtract(t55, t55_, t58, t58_)
    o_l1, o_l1_ = two_sum(t20, t20_)
    o_l2, o_l2_ = two_sum(t29, t29_)
    o_l3, o_l3_ = two_sum(t38, t38_)
    o_h1, o_h1_ = two_sum(t47, t47_)
    o_h2, o_h2_ = two_sum(t53, t53_)
    o_h3, o_h3_ = two_sum(t59, t59_)
    return o_l1, o_l1_, o_l2, o_l2_, o_l3, o_l3_, o_h1, o_h1_, o_h2, o_h2_, o_h3, o_h3_


def roll_pairs(q0, q0_, u1, u1_, u2, u2_, u3, u3_, g1, g1_, g2, g2_, g3, g3_, a0, a0_, a1, a1_, a2, a2_, a3, a3_, z1, z1_, z2, z2_, rho):
    """The attitude, divided by its length, and the contact point after the rotation q₀(1, u), q₀ = 1/√(1 + |u|²).

    scalar: q0
    gibbs: u1, u2, u3
    gamma: g1, g2, g3
    first: a0, a1, a2, a3
    contact: z1, z2
    radius: rho
    Returns b0, b1, b2, b3, n1, n2 as normalised pairs.  rho: float64; the others are pairs.
    Operations: 625.
    """
    t0, t0_ = loose_multiply(q0, q0_, u1, u1_)
    t1, t1_ = loose_multiply(q0, q0_, u2, u2_)
    t2, t2_ = loose_multiply(q0, q0_, u3, u3_)
    t3, t3_ = 2 * q0, 2 * q0_
    t4, t4_ = loose_multiply(g3, g3_, t1, t1_)
    t5, t5_ = loose_multiply(g2, g2_, t2, t2_)
    t6, t6_ = loose_subtract(t4, t4_, t5, t5_)
    t7, t7_ = loose_multiply(t3, t3_, t6, t6_)
    t8, t8_ = -t3, -t3_
    t9, t9_ = loose_multiply(g3, g3_, t0, t0_)
    t10, t10_ = loose_multiply(g1, g1_, t2, t2_)
    t11, t11_ = loose_subtract(t9, t9_, t10, t10_)
    t12, t12_ = loose_multiply(t8, t8_, t11, t11_)
    t13, t13_ = loose_multiply(g2, g2_, t0, t0_)
    t14, t14_ = loose_multiply(g1, g1_, t1, t1_)
    t15, t15_ = loose_subtract(t13, t13_, t14, t14_)
    t16, t16_ = loose_multiply(t3, t3_, t15, t15_)
    t17, t17_ = loose_multiply(a2, a2_, a2, a2_)
    t18, t18_ = loose_multiply(a3, a3_, a3, a3_)
    t19, t19_ = 2 * t7, 2 * t7_
    t20, t20_ = loose_multiply(a0, a0_, a2, a2_)
    t21, t21_ = loose_multiply(a1, a1_, a3, a3_)
    t22, t22_ = loose_multiply(a0, a0_, a3, a3_)
    t23, t23_ = loose_multiply(a1, a1_, a2, a2_)
    t24, t24_ = 2 * t12, 2 * t12_
    t25, t25_ = loose_multiply(a1, a1_, a1, a1_)
    t26, t26_ = loose_multiply(a0, a0_, a1, a1_)
    t27, t27_ = loose_multiply(a2, a2_, a3, a3_)
    t28, t28_ = 2 * t16, 2 * t16_
    t29, t29_ = loose_add(t20, t20_, t21, t21_)
    t30, t30_ = loose_multiply(t28, t28_, t29, t29_)
    t31, t31_ = loose_add(t7, t7_, t30, t30_)
    t32, t32_ = loose_add(t17, t17_, t18, t18_)
    t33, t33_ = loose_multiply(t19, t19_, t32, t32_)
    t34, t34_ = loose_subtract(t22, t22_, t23, t23_)
    t35, t35_ = loose_multiply(t24, t24_, t34, t34_)
    t36, t36_ = loose_add(t33, t33_, t35, t35_)
    t37, t37_ = loose_subtract(t31, t31_, t36, t36_)
    t38, t38_ = loose_add(t22, t22_, t23, t23_)
    t39, t39_ = loose_multiply(t19, t19_, t38, t38_)
    t40, t40_ = loose_add(t12, t12_, t39, t39_)
    t41, t41_ = loose_subtract(t26, t26_, t27, t27_)
    t42, t42_ = loose_multiply(t28, t28_, t41, t41_)
    t43, t43_ = loose_add(t18, t18_, t25, t25_)
    t44, t44_ = loose_multiply(t24, t24_, t43, t43_)
    t45, t45_ = loose_add(t42, t42_, t44, t44_)
    t46, t46_ = loose_subtract(t40, t40_, t45, t45_)
    t47, t47_ = loose_multiply_float(t37, t37_, rho)
    t48, t48_ = loose_add(z1, z1_, t47, t47_)
    t49, t49_ = loose_multiply_float(t46, t46_, rho)
    t50, t50_ = loose_add(z2, z2_, t49, t49_)
    t51, t51_ = loose_multiply(q0, q0_, a0, a0_)
    t52, t52_ = loose_multiply(a1, a1_, t0, t0_)
    t53, t53_ = loose_subtract(t51, t51_, t52, t52_)
    t54, t54_ = loose_multiply(a2, a2_, t1, t1_)
    t55, t55_ = loose_multiply(a3, a3_, t2, t2_)
    t56, t56_ = loose_add(t54, t54_, t55, t55_)
    t57, t57_ = loose_subtract(t53, t53_, t56, t56_)
    t58, t58_ = loose_multiply(a0, a0_, t0, t0_)
    t59, t59_ = loose_multiply(q0, q0_, a1, a1_)
    t60, t60_ = loose_add(t58, t58_, t59, t59_)
    t61, t61_ = loose_multiply(a2, a2_, t2, t2_)
    t62, t62_ = loose_multiply(a3, a3_, t1, t1_)
    t63, t63_ = loose_subtract(t61, t61_, t62, t62_)
    t64, t64_ = loose_add(t60, t60_, t63, t63_)
    t65, t65_ = loose_multiply(a0, a0_, t1, t1_)
    t66, t66_ = loose_multiply(q0, q0_, a2, a2_)
    t67, t67_ = loose_add(t65, t65_, t66, t66_)
    t68, t68_ = loose_multiply(a3, a3_, t0, t0_)
    t69, t69_ = loose_multiply(a1, a1_, t2, t2_)
    t70, t70_ = loose_subtract(t68, t68_, t69, t69_)
    t71, t71_ = loose_add(t67, t67_, t70, t70_)
    t72, t72_ = loose_multiply(a0, a0_, t2, t2_)
    t73, t73_ = loose_multiply(a1, a1_, t1, t1_)
    t74, t74_ = loose_add(t72, t72_, t73, t73_)
    t75, t75_ = loose_multiply(q0, q0_, a3, a3_)
    t76, t76_ = loose_multiply(a2, a2_, t0, t0_)
    t77, t77_ = loose_subtract(t75, t75_, t76, t76_)
    t78, t78_ = loose_add(t74, t74_, t77, t77_)
    t79, t79_ = loose_multiply(t57, t57_, t57, t57_)
    t80, t80_ = loose_multiply(t64, t64_, t64, t64_)
    t81, t81_ = loose_add(t79, t79_, t80, t80_)
    t82, t82_ = loose_multiply(t71, t71_, t71, t71_)
    t83, t83_ = loose_multiply(t78, t78_, t78, t78_)
    t84, t84_ = loose_add(t82, t82_, t83, t83_)
    t85, t85_ = loose_add(t81, t81_, t84, t84_)
    t86, t86_ = loose_add_float(-t85, -t85_, 3)
    t87, t87_ = t86 / 2, t86_ / 2
    t88, t88_ = loose_multiply(t57, t57_, t87, t87_)
    t89, t89_ = loose_multiply(t64, t64_, t87, t87_)
    t90, t90_ = loose_multiply(t71, t71_, t87, t87_)
    t91, t91_ = loose_multiply(t78, t78_, t87, t87_)
    o_b0, o_b0_ = two_sum(t88, t88_)
    o_b1, o_b1_ = two_sum(t89, t89_)
    o_b2, o_b2_ = two_sum(t90, t90_)
    o_b3, o_b3_ = two_sum(t91, t91_)
    o_n1, o_n1_ = two_sum(t48, t48_)
    o_n2, o_n2_ = two_sum(t50, t50_)
    return o_b0, o_b0_, o_b1, o_b1_, o_b2, o_b2_, o_b3, o_b3_, o_n1, o_n1_, o_n2, o_n2_


def steady_pairs(k1, k2, k3, g1, g2, g3, moment, moment_, D):
    """w = B(γ/|γ|)⁻¹k for three equal moments, and |w|².

    half_momentum: k1, k2, k3
    gamma: g1, g2, g3
    moment: moment
    D: D
    Returns w1, w2, w3, square as normalised pairs.  k1, k2, k3, g1, g2, g3, D: float64; the others are pairs.
    Operations: 220.
    """
    t0, t0_ = two_product(k1, g1)
    t1, t1_ = two_product(k2, g2)
    t2, t2_ = loose_add(t0, t0_, t1, t1_)
    t3, t3_ = two_product(k3, g3)
    t4, t4_ = loose_add(t2, t2_, t3, t3_)
    t5, t5_ = loose_multiply_float(t4, t4_, D)
    t6, t6_ = two_product(g1, g1)
    t7, t7_ = two_product(g2, g2)
    t8, t8_ = loose_add(t6, t6_, t7, t7_)
    t9, t9_ = two_product(g3, g3)
    t10, t10_ = loose_add(t8, t8_, t9, t9_)
    t11, t11_ = loose_multiply(moment, moment_, t10, t10_)
    t12d, t12d_ = two_sum(t11, t11_)
    t12, t12_ = divide(t5, t5_, t12d, t12d_)
    t13, t13_ = loose_add_float(moment, moment_, D)
    t14d, t14d_ = two_sum(t13, t13_)
    t14, t14_ = divide(1, 0, t14d, t14d_)
    t15, t15_ = loose_multiply_float(t12, t12_, g1)
    t16, t16_ = loose_add_float(t15, t15_, k1)
    t17, t17_ = loose_multiply(t14, t14_, t16, t16_)
    t18, t18_ = loose_multiply_float(t12, t12_, g2)
    t19, t19_ = loose_add_float(t18, t18_, k2)
    t20, t20_ = loose_multiply(t14, t14_, t19, t19_)
    t21, t21_ = loose_multiply_float(t12, t12_, g3)
    t22, t22_ = loose_add_float(t21, t21_, k3)
    t23, t23_ = loose_multiply(t14, t14_, t22, t22_)
    t24, t24_ = loose_multiply(t17, t17_, t17, t17_)
    t25, t25_ = loose_multiply(t20, t20_, t20, t20_)
    t26, t26_ = loose_add(t24, t24_, t25, t25_)
    t27, t27_ = loose_multiply(t23, t23_, t23, t23_)
    t28, t28_ = loose_add(t26, t26_, t27, t27_)
    o_w1, o_w1_ = two_sum(t17, t17_)
    o_w2, o_w2_ = two_sum(t20, t20_)
    o_w3, o_w3_ = two_sum(t23, t23_)
    o_square, o_square_ = two_sum(t28, t28_)
    return o_w1, o_w1_, o_w2, o_w2_, o_w3, o_w3_, o_square, o_square_
