"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: S-gibbs.  Operations: 27.  SymPy 1.14.0.
Expression: sha256 32f66c790c70a310d362de169d21bff863f9e97d952000980a532bde1c0d9307.
Certificate of S-gibbs: sha256 4bf3002a3b7a8f634b7fc9c9a665682c3b0b35187010128e81ea1ece2cc5bf51.
"""


def residual(u1, u2, M1, M2, J1, J2, J3, J13, J23):
    """What vanishes where the turn of a Gibbs vector starts with a momentum.

    gibbs: u1, u2
    momentum: M1, M2
    mass_tensor: J1, J2, J3, J13, J23
    Returns r1, r2.
    """
    # intermediate terms
    t0 = 2 * u1
    t1 = t0 * u2
    t2 = u2 * u2
    t3 = u1 * u1
    t4 = 1 + t2 + t3
    t5 = 2 * u2
    # outputs
    o_r1 = (J13 * t1 + 2 * J23 * t2 + M1 * t4) - (J2 * t0 + J3 * t0)
    o_r2 = (M2 * t4 - J1 * t5 - 2 * J13 * t3) - (J23 * t1 + J3 * t5)
    return o_r1, o_r2
