"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: M-step.  Operations: 52.  SymPy 1.14.0.
Expression: sha256 4e3ef32683e38fa443e0088fdfe939cd6fcdef36903f91137777e73144006dc1.
Certificate of M-step: sha256 33282fe507c2a3fb1f7d4290ce4703d86a9a27b23432c9c24e71ffc67c2c8165.
"""

from chapsym.numbers.functions import cos, sin


def step_slope(q2, u1, u2, u3, x1, x2, x3, x4, r, g, h):
    """Its derivatives by the middle, row by row.

    middle: q2, u1, u2, u3
    start: x1, x2, x3, x4
    radius: r
    gravity: g
    step: h
    Returns j11, j12, j13, j14, j21, j22, j23, j24, j31, j32, j33, j34, j41, j42, j43, j44.
    """
    # letters
    s2 = sin(q2, u1, u2, u3, x1, x2, x3, x4, r, g, h)
    c2 = cos(q2, u1, u2, u3, x1, x2, x3, x4, r, g, h)
    # intermediate terms
    t0 = h / 2
    t1 = 1 / (c2 * c2)
    t2 = s2 * s2
    t3 = u3 * u3
    t4 = 1 / c2
    t5 = r * t4
    t6 = h / (10 * r)
    t7 = h * u3
    t8 = h * u1
    t9 = t0 * u1
    t10 = t9 * u3
    # outputs
    o_j11 = 1
    o_j12 = -t0
    o_j13 = 0
    o_j14 = 0
    o_j21 = h * t1 * t2 * t3 / 10 - c2 * t6 * (4 * g - t3 * t5)
    o_j22 = 1
    o_j23 = -3 * t7 / 5
    o_j24 = -t6 * (6 * r * u2 - 2 * s2 * t5 * u3)
    o_j31 = 0
    o_j32 = t7 / 3
    o_j33 = 1
    o_j34 = t8 / 3
    o_j41 = -t10 - t1 * t10 * t2
    o_j42 = -t0 * (s2 * t4 * u3 - 2 * u2)
    o_j43 = t8
    o_j44 = 1 - s2 * t4 * t9
    return o_j11, o_j12, o_j13, o_j14, o_j21, o_j22, o_j23, o_j24, o_j31, o_j32, o_j33, o_j34, o_j41, o_j42, o_j43, o_j44
