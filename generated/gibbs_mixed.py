"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: gibbs-newton.  Operations: 62.  SymPy 1.14.0.
Expression: sha256 ff93940aabfa8f04d8ab3f1249252df7ffd005dde2202cf5c7135439ed5aa798.
Certificate of gibbs-newton: sha256 a1b79c19d4fe6372a54a836208a76eadc15c7402e947fe7bf300fd4b0b12ed38.
"""


def gibbs_mixed(d1, d2, d3, e1, e2, e3, k1, k2, k3, c11, c12, c13, c21, c22, c23, c31, c32, c33, I1, I2, I3):
    """What N loses when a correction e follows a correction d with the cofactors from before d.

    correction: d1, d2, d3
    next_correction: e1, e2, e3
    half_momentum: k1, k2, k3
    cofactors: c11, c12, c13, c21, c22, c23, c31, c32, c33
    inertia: I1, I2, I3
    Returns x1, x2, x3.
    """
    # intermediate terms
    t0 = 2 * d1 * e1 + 2 * d2 * e2 + 2 * d3 * e3
    r1 = (I3 * d2 * e3 + I3 * d3 * e2 - k1 * t0) - (I2 * d2 * e3 + I2 * d3 * e2)
    r2 = (I1 * d1 * e3 + I1 * d3 * e1 - k2 * t0) - (I3 * d1 * e3 + I3 * d3 * e1)
    r3 = (I2 * d1 * e2 + I2 * d2 * e1 - k3 * t0) - (I1 * d1 * e2 + I1 * d2 * e1)
    # outputs
    o_x1 = c11 * r1 + c21 * r2 + c31 * r3
    o_x2 = c12 * r1 + c22 * r2 + c32 * r3
    o_x3 = c13 * r1 + c23 * r2 + c33 * r3
    return o_x1, o_x2, o_x3
