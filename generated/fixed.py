"""Parts of a step on fixed-point numbers: integers, of which 2^P is one.

Written by `chapsym codegen`: do not edit; change the derivation and generate again.
From the kernels centre_step, compose, gibbs_newton, gibbs_residual, rotate, turn.
Proved by: 2.1, 4.9, 5.1, gibbs, gibbs-newton, gibbs-rotation.
Programs: sha256 a004d78e2f354a3e3f0da427f24f4e2adcbfbe363c32ba70aca054e38fc7865f.
"""


def residual_fixed(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, P):
    """G(u), which the Gibbs vector of the step makes zero.

    gibbs: u1, u2, u3
    half_momentum: k1, k2, k3
    gamma: g1, g2, g3
    inertia: I1, I2, I3
    D: D
    Returns r1, r2, r3.
    """
    t0 = (u1 * I1 >> P)
    t1 = (u1 * g2 - u2 * g1 >> P)
    t2 = (u3 * g1 - u1 * g3 >> P)
    t3 = (g2 * t1 - g3 * t2 >> P)
    t4 = (u3 * I3 >> P)
    t5 = (1 << P) + (u1 * u1 + u2 * u2 + u3 * u3 >> P)
    t6 = (u2 * I2 >> P)
    t7 = t0 + (D * t3 + u2 * t4 - k1 * t5 - u3 * t6 >> P)
    t8 = (u2 * g3 - u3 * g2 >> P)
    t9 = (g3 * t8 - g1 * t1 >> P)
    t10 = t6 + (D * t9 + u3 * t0 - k2 * t5 - u1 * t4 >> P)
    t11 = (g1 * t2 - g2 * t8 >> P)
    t12 = t4 + (D * t11 + u1 * t6 - k3 * t5 - u2 * t0 >> P)
    return t7, t10, t12


def cofactors_fixed(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, P):
    """The determinant and the cofactors of ∂G/∂u, row by row.

    gibbs: u1, u2, u3
    half_momentum: k1, k2, k3
    gamma: g1, g2, g3
    inertia: I1, I2, I3
    D: D
    Returns det, c11, c12, c13, c21, c22, c23, c31, c32, c33.
    """
    t0 = k1 + k1
    t1 = (g2 * D >> P)
    t2 = (g2 * t1 >> P)
    t3 = (g3 * D >> P)
    t4 = (g3 * t3 >> P)
    t5 = I1 + t2 + t4 + (-u1 * t0 >> P)
    t6 = k2 + k2
    t7 = (g1 * D >> P)
    t8 = (g1 * t7 >> P)
    t9 = I2 + t8 + t4 + (-u2 * t6 >> P)
    t10 = k3 + k3
    t11 = I3 + t8 + t2 + (-u3 * t10 >> P)
    t12 = (u1 * I1 >> P)
    t13 = (g2 * t3 >> P)
    t14 = t12 + (-u1 * I3 - u3 * t6 >> P) - t13
    t15 = (u1 * I2 - u2 * t10 >> P) - t12 - t13
    t16 = (t9 * t11 - t14 * t15 >> P)
    t17 = (u3 * I3 >> P)
    t18 = (g1 * t1 >> P)
    t19 = t17 + (-u3 * I2 - u2 * t0 >> P) - t18
    t20 = (u2 * I2 >> P)
    t21 = (g1 * t3 >> P)
    t22 = t20 + (-u2 * I1 - u1 * t10 >> P) - t21
    t23 = (u3 * I1 - u1 * t6 >> P) - t17 - t18
    t24 = (t14 * t22 - t23 * t11 >> P)
    t25 = (u2 * I3 - u3 * t0 >> P) - t20 - t21
    t26 = (t23 * t15 - t9 * t22 >> P)
    t27 = (t5 * t16 + t19 * t24 + t25 * t26 >> P)
    t28 = (t25 * t15 - t19 * t11 >> P)
    t29 = (t5 * t11 - t25 * t22 >> P)
    t30 = (t19 * t22 - t5 * t15 >> P)
    t31 = (t19 * t14 - t25 * t9 >> P)
    t32 = (t25 * t23 - t5 * t14 >> P)
    t33 = (t5 * t9 - t19 * t23 >> P)
    return t27, t16, t24, t26, t28, t29, t30, t31, t32, t33


def turns_fixed(u1, u2, u3, k1, k2, k3, g1, g2, g3, P):
    """Ωᵀk and Ωᵀγ for the Gibbs vector u.

    gibbs: u1, u2, u3
    half_momentum: k1, k2, k3
    gamma: g1, g2, g3
    Returns x1, x2, x3, y1, y2, y3.
    """
    t0 = (1 << P) + (u1 * u1 + u2 * u2 + u3 * u3 >> P)
    t1 = (2 << 2 * P) // t0
    t2 = (u1 * k2 - u2 * k1 >> P)
    t3 = (u2 * k3 - u3 * k2 >> P)
    t4 = (u3 * k1 - u1 * k3 >> P)
    t5 = (u2 * t2 - u3 * t4 >> P) - t3
    t6 = k1 + (t1 * t5 >> P)
    t7 = (u3 * t3 - u1 * t2 >> P) - t4
    t8 = k2 + (t1 * t7 >> P)
    t9 = (u1 * t4 - u2 * t3 >> P) - t2
    t10 = k3 + (t1 * t9 >> P)
    t11 = (u1 * g2 - u2 * g1 >> P)
    t12 = (u2 * g3 - u3 * g2 >> P)
    t13 = (u3 * g1 - u1 * g3 >> P)
    t14 = (u2 * t11 - u3 * t13 >> P) - t12
    t15 = g1 + (t1 * t14 >> P)
    t16 = (u3 * t12 - u1 * t11 >> P) - t13
    t17 = g2 + (t1 * t16 >> P)
    t18 = (u1 * t13 - u2 * t12 >> P) - t11
    t19 = g3 + (t1 * t18 >> P)
    return t6, t8, t10, t15, t17, t19


def body_fixed(a0, a1, a2, a3, p0, p1, p2, p3, g1, g2, g3, P):
    """The attitude a after the step with the unit quaternion p from the vertical γ, and Δr/ρ in space.

    first: a0, a1, a2, a3
    quaternion: p0, p1, p2, p3
    gamma: g1, g2, g3
    Returns c0, c1, c2, c3, x1, x2, x3.
    """
    t0 = (a0 * p0 - a1 * p1 - a2 * p2 - a3 * p3 >> P)
    t1 = (a0 * p1 + a1 * p0 + a2 * p3 - a3 * p2 >> P)
    t2 = (a0 * p2 + a2 * p0 + a3 * p1 - a1 * p3 >> P)
    t3 = (a0 * p3 + a1 * p2 + a3 * p0 - a2 * p1 >> P)
    t4 = p0 + p0
    t5 = (p2 * g3 - p3 * g2 >> P)
    t6 = (t4 * t5 >> P)
    t7 = (p1 * g2 - p2 * g1 >> P)
    t8 = (t4 * t7 >> P)
    t9 = t8 + t8
    t10 = (a0 * a2 >> P)
    t11 = (a1 * a3 >> P)
    t12 = t10 + t11
    t13 = t6 + t6
    t14 = (a2 * a2 >> P)
    t15 = (a3 * a3 >> P)
    t16 = t14 + t15
    t17 = -t4
    t18 = (p1 * g3 - p3 * g1 >> P)
    t19 = (t17 * t18 >> P)
    t20 = t19 + t19
    t21 = (a0 * a3 >> P)
    t22 = (a1 * a2 >> P)
    t23 = t21 - t22
    t24 = t6 + (t9 * t12 - t13 * t16 - t20 * t23 >> P)
    t25 = t21 + t22
    t26 = (a0 * a1 >> P)
    t27 = (a2 * a3 >> P)
    t28 = t26 - t27
    t29 = (a1 * a1 >> P)
    t30 = t15 + t29
    t31 = t19 + (t13 * t25 - t9 * t28 - t20 * t30 >> P)
    t32 = t26 + t27
    t33 = t14 + t29
    t34 = t10 - t11
    t35 = t8 + (t20 * t32 - t9 * t33 - t13 * t34 >> P)
    return t0, t1, t2, t3, t24, t31, t35
