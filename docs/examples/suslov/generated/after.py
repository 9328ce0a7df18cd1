"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: S-gibbs.  Operations: 21.  SymPy 1.14.0.
Expression: sha256 816f54a78c764b8f485504a72bc9f91d6edc62a217f27f4d242ecdcaada1397c.
Certificate of S-gibbs: sha256 4bf3002a3b7a8f634b7fc9c9a665682c3b0b35187010128e81ea1ece2cc5bf51.
"""


def after(u1, u2, J1, J2, J3, J13, J23):
    """The momentum with which the turn of a Gibbs vector ends, and the next one starts.

    gibbs: u1, u2
    mass_tensor: J1, J2, J3, J13, J23
    Returns m1, m2.
    """
    # intermediate terms
    t0 = 1 / (1 + u1 * u1 + u2 * u2)
    t1 = 2 * u1
    t2 = J13 * u1 + J23 * u2
    # outputs
    o_m1 = t0 * (t1 * (J2 + J3) + 2 * t2 * u2)
    o_m2 = t0 * (2 * u2 * (J1 + J3) - t1 * t2)
    return o_m1, o_m2
