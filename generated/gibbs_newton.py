"""The next Newton iterate of the Gibbs vector, N/det, as a quaternion (det, N); and the cofactors of ∂G/∂u.

Written by `chapsym codegen`: do not edit; change the derivation and generate again.
Proved by: gibbs, gibbs-newton.  Operations: 129.  SymPy 1.14.0.
Expression: sha256 13c5855efdcc3908807d2d024f47cd62af450fc3f819c0ecc29195f82d86fa62.
"""


def gibbs_newton(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D):
    """The next Newton iterate of the Gibbs vector, N/det, as a quaternion (det, N); and the cofactors of ∂G/∂u.

    gibbs: u1, u2, u3
    half_momentum: k1, k2, k3
    gamma: g1, g2, g3
    inertia: I1, I2, I3
    D: D
    Returns det, N1, N2, N3, C11, C12, C13, C21, C22, C23, C31, C32, C33.
    """
    # intermediate terms
    t0 = g2 * g2
    t1 = g3 * g3
    t2 = D * g1
    t3 = g1 * g1
    b11 = I1 + D * (t0 + t1)
    b12 = -g2 * t2
    b13 = -g3 * t2
    b22 = I2 + D * (t1 + t3)
    b23 = -D * g2 * g3
    b33 = I3 + D * (t0 + t3)
    t4 = u2 * u3
    t5 = (1 - u1 * u1) - (u2 * u2 + u3 * u3)
    t6 = u1 * u3
    t7 = u1 * u2
    r1 = I3 * t4 + k1 * t5 - I2 * t4
    r2 = I1 * t6 + k2 * t5 - I3 * t6
    r3 = I2 * t7 + k3 * t5 - I1 * t7
    t8 = 2 * k1
    t9 = -I3
    t10 = -I2 - t9
    t11 = 2 * k2
    t12 = I1 + t9
    t13 = 2 * k3
    t14 = I2 - I1
    a11 = b11 - t8 * u1
    a12 = b12 + t10 * u3 - t8 * u2
    a13 = b13 + t10 * u2 - t8 * u3
    a21 = b12 + t12 * u3 - t11 * u1
    a22 = b22 - t11 * u2
    a23 = b23 + t12 * u1 - t11 * u3
    a31 = b13 + t14 * u2 - t13 * u1
    a32 = b23 + t14 * u1 - t13 * u2
    a33 = b33 - t13 * u3
    c11 = a22 * a33 - a23 * a32
    c12 = a23 * a31 - a21 * a33
    c13 = a21 * a32 - a22 * a31
    c21 = a13 * a32 - a12 * a33
    c22 = a11 * a33 - a13 * a31
    c23 = a12 * a31 - a11 * a32
    c31 = a12 * a23 - a13 * a22
    c32 = a13 * a21 - a11 * a23
    c33 = a11 * a22 - a12 * a21
    # outputs
    o_det = a11 * c11 + a12 * c12 + a13 * c13
    o_N1 = c11 * r1 + c21 * r2 + c31 * r3
    o_N2 = c12 * r1 + c22 * r2 + c32 * r3
    o_N3 = c13 * r1 + c23 * r2 + c33 * r3
    o_C11 = c11
    o_C12 = c12
    o_C13 = c13
    o_C21 = c21
    o_C22 = c22
    o_C23 = c23
    o_C31 = c31
    o_C32 = c32
    o_C33 = c33
    return o_det, o_N1, o_N2, o_N3, o_C11, o_C12, o_C13, o_C21, o_C22, o_C23, o_C31, o_C32, o_C33
