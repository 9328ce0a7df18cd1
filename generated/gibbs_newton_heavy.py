"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: gibbs-newton.  Operations: 164.  SymPy 1.14.0.
Expression: sha256 13c5855efdcc3908807d2d024f47cd62af450fc3f819c0ecc29195f82d86fa62.
Certificate of gibbs-newton: sha256 a1b79c19d4fe6372a54a836208a76eadc15c7402e947fe7bf300fd4b0b12ed38.
"""


def gibbs_newton_heavy(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D):
    """What `gibbs_newton` computes, with a determinant in which nothing cancels for D ≫ I.

    gibbs: u1, u2, u3
    half_momentum: k1, k2, k3
    gamma: g1, g2, g3
    inertia: I1, I2, I3
    D: D
    Returns det, N1, N2, N3, C11, C12, C13, C21, C22, C23, C31, C32, C33.
    """
    # intermediate terms
    w1 = D * g1
    w2 = D * g2
    w3 = D * g3
    e11 = g1 * w1
    e12 = g1 * w2
    e13 = g1 * w3
    e22 = g2 * w2
    e23 = g2 * w3
    e33 = g3 * w3
    t0 = u2 * u3
    t1 = (1 - u1 * u1) - (u2 * u2 + u3 * u3)
    t2 = u1 * u3
    t3 = u1 * u2
    r1 = I3 * t0 + k1 * t1 - I2 * t0
    r2 = I1 * t2 + k2 * t1 - I3 * t2
    r3 = I2 * t3 + k3 * t1 - I1 * t3
    t4 = 2 * k1
    t5 = I3 * u3
    t6 = I2 * u2
    t7 = 2 * k2
    t8 = I1 * u1
    t9 = 2 * k3
    m11 = I1 - t4 * u1
    m12 = t5 - I2 * u3 - t4 * u2
    m13 = I3 * u2 - t6 - t4 * u3
    m21 = I1 * u3 - t5 - t7 * u1
    m22 = I2 - t7 * u2
    m23 = t8 - I3 * u1 - t7 * u3
    m31 = t6 - I1 * u2 - t9 * u1
    m32 = I2 * u1 - t8 - t9 * u2
    m33 = I3 - t9 * u3
    a11 = e22 + e33 + m11
    a12 = m12 - e12
    a13 = m13 - e13
    a21 = m21 - e12
    a22 = e11 + e33 + m22
    a23 = m23 - e23
    a31 = m31 - e13
    a32 = m32 - e23
    a33 = e11 + e22 + m33
    c11 = a22 * a33 - a23 * a32
    c12 = a23 * a31 - a21 * a33
    c13 = a21 * a32 - a22 * a31
    c21 = a13 * a32 - a12 * a33
    c22 = a11 * a33 - a13 * a31
    c23 = a12 * a31 - a11 * a32
    c31 = a12 * a23 - a13 * a22
    c32 = a13 * a21 - a11 * a23
    c33 = a11 * a22 - a12 * a21
    y1 = g1 * m11 + g2 * m21 + g3 * m31
    y2 = g1 * m12 + g2 * m22 + g3 * m32
    y3 = g1 * m13 + g2 * m23 + g3 * m33
    z1 = c11 * g1 + c21 * g2 + c31 * g3
    z2 = c12 * g1 + c22 * g2 + c32 * g3
    z3 = c13 * g1 + c23 * g2 + c33 * g3
    # outputs
    o_det = (y1 * z1 + y2 * z2 + y3 * z3) / (g1 * g1 + g2 * g2 + g3 * g3)
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
