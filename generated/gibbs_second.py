"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: gibbs-newton.  Operations: 41.  SymPy 1.14.0.
Expression: sha256 f7a3880abd927af60736b4bb8bed6c855768d4fa2c2642c72539a7a8cfe46679.
Certificate of gibbs-newton: sha256 a1b79c19d4fe6372a54a836208a76eadc15c7402e947fe7bf300fd4b0b12ed38.
"""


def gibbs_second(d1, d2, d3, k1, k2, k3, c11, c12, c13, c21, c22, c23, c31, c32, c33, I1, I2, I3):
    """What N loses by a second correction after a Newton correction d, with the same cofactors.

    correction: d1, d2, d3
    half_momentum: k1, k2, k3
    cofactors: c11, c12, c13, c21, c22, c23, c31, c32, c33
    inertia: I1, I2, I3
    Returns e1, e2, e3.
    """
    # intermediate terms
    t0 = d1 * d1 + d2 * d2 + d3 * d3
    r1 = I3 * d2 * d3 - k1 * t0 - I2 * d2 * d3
    r2 = I1 * d1 * d3 - k2 * t0 - I3 * d1 * d3
    r3 = I2 * d1 * d2 - k3 * t0 - I1 * d1 * d2
    # outputs
    o_e1 = c11 * r1 + c21 * r2 + c31 * r3
    o_e2 = c12 * r1 + c22 * r2 + c32 * r3
    o_e3 = c13 * r1 + c23 * r2 + c33 * r3
    return o_e1, o_e2, o_e3
