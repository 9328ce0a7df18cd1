"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: I-a1.  Operations: 33.  SymPy 1.14.0.
Expression: sha256 0f159213b1968f9442fbaf2701374fd3b677df3261cbccb88385bf08450800d9.
Certificate of I-a1: sha256 cb4fabaf3e9c06232eddc2141de185bd2a0e3f913e7b6a7bd263aa6ee4399eeb.
"""

from chapsym.numbers.functions import cos, sin


def accelerations(q2, d1, d2, d3, r, g):
    """The second derivatives of heading, lean and turn, in the rates of the angles.

    lean: q2
    rates: d1, d2, d3
    radius: r
    gravity: g
    Returns a1, a2, a3.
    """
    # letters
    s2 = sin(q2, d1, d2, d3, r, g)
    c2 = cos(q2, d1, d2, d3, r, g)
    # intermediate terms
    t0 = d2 * d3
    t1 = c2 * r
    # outputs
    o_a1 = -2 * t0 / c2
    o_a2 = (4 * g * s2 + 6 * d1 * d3 * t1 + 5 * d1 * d1 * s2 * t1) / (5 * r)
    o_a3 = -(5 * c2 * c2 * c2 * d1 * d2 - 6 * c2 * s2 * t0) / (3 * c2 * c2)
    return o_a1, o_a2, o_a3
