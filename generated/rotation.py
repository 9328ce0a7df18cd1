"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: 5.1.  Operations: 35.  SymPy 1.14.0.
Expression: sha256 ca0961cd87d6a1f3573cea2f4b644f0ac063985ce1349f384d79a2091784e601.
Certificate of 5.1: sha256 64f49fa9619a0f7315e5fd081d8836e3cca188cf86b64909c1a70aff37aa5e38.
"""


def rotation(q0, q1, q2, q3):
    """The matrix Ω of unit Euler parameters, row by row (5.1 as corrected).

    rotation: q0, q1, q2, q3
    Returns R11, R12, R13, R21, R22, R23, R31, R32, R33, the 3×3 matrix row by row.
    """
    # intermediate terms
    t0 = q1 * q1
    t1 = q2 * q2
    t2 = -t1
    t3 = q0 * q0
    t4 = q3 * q3
    t5 = t3 - t4
    t6 = 2 * q0
    t7 = q3 * t6
    t8 = q2 * t6
    t9 = 2 * q1
    t10 = -t0
    t11 = q1 * t6
    # outputs
    o_R11 = t0 + t2 + t5
    o_R12 = 2 * q1 * q2 - t7
    o_R13 = t8 + q3 * t9
    o_R21 = t7 + q2 * t9
    o_R22 = t1 + t10 + t5
    o_R23 = 2 * q2 * q3 - t11
    o_R31 = 2 * q1 * q3 - t8
    o_R32 = t11 + 2 * q2 * q3
    o_R33 = (t10 + t2) + (t3 + t4)
    return o_R11, o_R12, o_R13, o_R21, o_R22, o_R23, o_R31, o_R32, o_R33
