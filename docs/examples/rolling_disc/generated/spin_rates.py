"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: K-u1, K-u2, K-u3.  Operations: 42.  SymPy 1.14.0.
Expression: sha256 56fbc59f37670fe1b48c9c7d42cfe8283aae1f14b7199dc56cb18820b7ab644a.
Certificate of K-u1: sha256 7fdde0caa7143b72736d6ec02c96199def8bc1d4beaf7e75f95ce76ff0ceb8fa.
Certificate of K-u2: sha256 f587411fa55142f142ba2c331eb5e0c26e7b59db73268b66a75663006beb3673.
Certificate of K-u3: sha256 c94cb28fd58151189f25274f47275b65634d1c10623205d9f7ec819005365d79.
"""

from chapsym.numbers.functions import cos, sin


def spin_rates(q2, u1, u2, u3, r, g):
    """The derivatives of the angular velocity along L.x, L.y, L.z.

    lean: q2
    spin: u1, u2, u3
    radius: r
    gravity: g
    Returns b1, b2, b3.
    """
    # letters
    s2 = sin(q2, u1, u2, u3, r, g)
    c2 = cos(q2, u1, u2, u3, r, g)
    # intermediate terms
    t0 = 1 / c2
    t1 = r * t0
    t2 = s2 * u3
    t3 = c2 * u2 - t2
    t4 = c2 * c2
    t5 = 1 / t4
    t6 = t3 * u1
    t7 = s2 * t6
    # outputs
    o_b1 = (4 * g * s2 + 5 * s2 * t1 * u3 * u3 + 6 * t1 * t3 * u3) / (5 * r)
    o_b2 = u1 * u3 - 2 * t5 * t7 - t5 * (5 * t4 * u1 * u3 - 6 * t7) / 3
    o_b3 = -2 * t0 * t6 - t0 * t2 * u1
    return o_b1, o_b2, o_b3
