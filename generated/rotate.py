"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: 5.1.  Operations: 41.  SymPy 1.14.0.
Expression: sha256 25fea96bcda3521ef3d0bfb4373a3c5516aff7bd7b987d46f7e2eb684af25c1f.
Certificate of 5.1: sha256 64f49fa9619a0f7315e5fd081d8836e3cca188cf86b64909c1a70aff37aa5e38.
"""


def rotate(q0, q1, q2, q3, v1, v2, v3):
    """Ωv for unit Euler parameters: from the frame of the body after the rotation to the one before.

    rotation: q0, q1, q2, q3
    vector: v1, v2, v3
    Returns x1, x2, x3.
    """
    # intermediate terms
    t0 = q2 * q2
    t1 = q3 * q3
    t2 = 2 * v1
    t3 = q0 * q2
    t4 = q1 * q3
    t5 = q0 * q3
    t6 = q1 * q2
    t7 = 2 * v2
    t8 = q1 * q1
    t9 = q0 * q1
    t10 = q2 * q3
    t11 = 2 * v3
    # outputs
    o_x1 = (v1 + 2 * v3 * (t3 + t4)) - (t2 * (t0 + t1) + t7 * (t5 - t6))
    o_x2 = (v2 + t2 * (t5 + t6)) - (t11 * (t9 - t10) + t7 * (t1 + t8))
    o_x3 = (v3 + 2 * v2 * (t10 + t9)) - (t11 * (t0 + t8) + t2 * (t3 - t4))
    return o_x1, o_x2, o_x3
