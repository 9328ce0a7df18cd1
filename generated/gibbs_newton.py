"""The Newton correction d = -(∂G/∂u)⁻¹G of the Gibbs vector, and (∂G/∂u)⁻¹ row by row.

Written by `chapsym codegen`: do not edit; change the derivation and generate again.
Proved by: gibbs, gibbs-newton.  Operations: 163.  SymPy 1.14.0.
Expression: sha256 fd8dd7347c92b70a5c579b0847daac3d765909511a1707269edcb2a89ee252f5.
"""


def gibbs_newton(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D):
    """The Newton correction d = -(∂G/∂u)⁻¹G of the Gibbs vector, and (∂G/∂u)⁻¹ row by row.

    gibbs: u1, u2, u3
    half_momentum: k1, k2, k3
    gamma: g1, g2, g3
    inertia: I1, I2, I3
    D: D
    Returns d1, d2, d3, i11, i12, i13, i21, i22, i23, i31, i32, i33.
    """
    # intermediate terms
    n = 1 + u1 * u1 + u2 * u2 + u3 * u3
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
    t5 = u1 * u3
    t6 = u1 * u2
    r1 = I3 * t4 + b11 * u1 + b12 * u2 + b13 * u3 - I2 * t4 - k1 * n
    r2 = I1 * t5 + b12 * u1 + b22 * u2 + b23 * u3 - I3 * t5 - k2 * n
    r3 = I2 * t6 + b13 * u1 + b23 * u2 + b33 * u3 - I1 * t6 - k3 * n
    t7 = 2 * k1
    t8 = -I3
    t9 = -I2 - t8
    t10 = 2 * k2
    t11 = I1 + t8
    t12 = 2 * k3
    t13 = I2 - I1
    a11 = b11 - t7 * u1
    a12 = b12 + t9 * u3 - t7 * u2
    a13 = b13 + t9 * u2 - t7 * u3
    a21 = b12 + t11 * u3 - t10 * u1
    a22 = b22 - t10 * u2
    a23 = b23 + t11 * u1 - t10 * u3
    a31 = b13 + t13 * u2 - t12 * u1
    a32 = b23 + t13 * u1 - t12 * u2
    a33 = b33 - t12 * u3
    c11 = a22 * a33 - a23 * a32
    c12 = a23 * a31 - a21 * a33
    c13 = a21 * a32 - a22 * a31
    c21 = a13 * a32 - a12 * a33
    c22 = a11 * a33 - a13 * a31
    c23 = a12 * a31 - a11 * a32
    c31 = a12 * a23 - a13 * a22
    c32 = a13 * a21 - a11 * a23
    c33 = a11 * a22 - a12 * a21
    s = 1 / (a11 * c11 + a12 * c12 + a13 * c13)
    # outputs
    o_d1 = -s * (c11 * r1 + c21 * r2 + c31 * r3)
    o_d2 = -s * (c12 * r1 + c22 * r2 + c32 * r3)
    o_d3 = -s * (c13 * r1 + c23 * r2 + c33 * r3)
    o_i11 = c11 * s
    o_i12 = c21 * s
    o_i13 = c31 * s
    o_i21 = c12 * s
    o_i22 = c22 * s
    o_i23 = c32 * s
    o_i31 = c13 * s
    o_i32 = c23 * s
    o_i33 = c33 * s
    return o_d1, o_d2, o_d3, o_i11, o_i12, o_i13, o_i21, o_i22, o_i23, o_i31, o_i32, o_i33
