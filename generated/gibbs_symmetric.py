"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: straight-path.  Operations: 80.  SymPy 1.14.0.
Expression: sha256 b603b93937e923f16641664eec350b6c5dc201755fe3ec8ea2c90fc8f7f882b2.
Certificate of straight-path: sha256 dd44f67826d5387bbbb40bbf43188bb94f7668c7a9d7673df8c477d11f607515.
"""


def gibbs_symmetric(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D):
    """The trace, the sum of the principal minors of size 2 and the determinant of the symmetric part of ∂G/∂u.

    gibbs: u1, u2, u3
    half_momentum: k1, k2, k3
    gamma: g1, g2, g3
    inertia: I1, I2, I3
    D: D
    Returns trace, minors, det.
    """
    # intermediate terms
    t0 = D * g2 * g2
    t1 = D * g3 * g3
    t2 = D * g1
    t3 = D * g1 * g1
    e11 = (I1 + t0) + (t1 - 2 * k1 * u1)
    e12 = (I1 * u3 / 2 - I2 * u3 / 2 - g2 * t2) - (k1 * u2 + k2 * u1)
    e13 = (I3 * u2 / 2 - I1 * u2 / 2 - g3 * t2) - (k1 * u3 + k3 * u1)
    e22 = (I2 + t1) + (t3 - 2 * k2 * u2)
    e23 = (I2 * u1 / 2 - I3 * u1 / 2 - k2 * u3) - (k3 * u2 + D * g2 * g3)
    e33 = (I3 + t0) + (t3 - 2 * k3 * u3)
    t4 = e22 * e33 - e23 * e23
    # outputs
    o_trace = e11 + e22 + e33
    o_minors = (t4 + e11 * e22 + e11 * e33) - (e12 * e12 + e13 * e13)
    o_det = e11 * t4 + e12 * (e13 * e23 - e12 * e33) + e13 * (e12 * e23 - e13 * e22)
    return o_trace, o_minors, o_det
