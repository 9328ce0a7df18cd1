"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: S-gibbs.  Operations: 30.  SymPy 1.14.0.
Expression: sha256 b3245bbba8391333d7208c5a4616984e9cdc539ff71d4082e898b8e7c5158495.
Certificate of S-gibbs: sha256 4bf3002a3b7a8f634b7fc9c9a665682c3b0b35187010128e81ea1ece2cc5bf51.
"""


def residual_jacobian(u1, u2, M1, M2, J1, J2, J3, J13, J23):
    """Its derivatives by the Gibbs vector, row by row.

    gibbs: u1, u2
    momentum: M1, M2
    mass_tensor: J1, J2, J3, J13, J23
    Returns a11, a12, a21, a22.
    """
    # intermediate terms
    t0 = 2 * J3
    t1 = 2 * J13
    t2 = 2 * M1
    t3 = J23 * u2
    # outputs
    o_a11 = (t1 * u2 + t2 * u1) - (2 * J2 + t0)
    o_a12 = 4 * t3 + t1 * u1 + t2 * u2
    o_a21 = 2 * M2 * u1 - 2 * t3 - 4 * J13 * u1
    o_a22 = (2 * M2 * u2 - 2 * J1) - (t0 + 2 * J23 * u1)
    return o_a11, o_a12, o_a21, o_a22
