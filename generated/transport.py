"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: 5.3.  Operations: 41.  SymPy 1.14.0.
Expression: sha256 4c01ea3acc25f4ff4d7fadcfcf30a55dd1a118996a04b256c11bba362fbc2a02.
Certificate of 5.3: sha256 44588c50de9a6e278ddd2b523b96b2c49fcdc93f03c6f758b6a23a3a07783dd5.
"""


def transport(q0, q1, q2, q3, v1, v2, v3):
    """Ωᵀv for unit Euler parameters: what a vector fixed in space becomes in the body (5.3).

    rotation: q0, q1, q2, q3
    vector: v1, v2, v3
    Returns x1, x2, x3.
    """
    # intermediate terms
    t0 = q2 * q2
    t1 = q3 * q3
    t2 = 2 * v1
    t3 = q0 * q3
    t4 = q1 * q2
    t5 = q0 * q2
    t6 = q1 * q3
    t7 = 2 * v3
    t8 = q1 * q1
    t9 = 2 * v2
    t10 = q0 * q1
    t11 = q2 * q3
    # outputs
    o_x1 = (v1 + 2 * v2 * (t3 + t4)) - (t2 * (t0 + t1) + t7 * (t5 - t6))
    o_x2 = (v2 + 2 * v3 * (t10 + t11)) - (t2 * (t3 - t4) + t9 * (t1 + t8))
    o_x3 = (v3 + t2 * (t5 + t6)) - (t7 * (t0 + t8) + t9 * (t10 - t11))
    return o_x1, o_x2, o_x3
