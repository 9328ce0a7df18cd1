"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: K-u1, K-u2, K-u3.  Operations: 42.  SymPy 1.14.0.
Expression: sha256 56fbc59f37670fe1b48c9c7d42cfe8283aae1f14b7199dc56cb18820b7ab644a.
Certificate of K-u1: sha256 8f15f69b27c1e803820885d8c78f46e8640dd80e82c24ba81a464885499cd3e5.
Certificate of K-u2: sha256 02834739b4d3f9d6672177e9818556918d88b2d508ac311cd51e0fada3a186b3.
Certificate of K-u3: sha256 d12fadbed51e11aa2212b9cb28e3ad3c0ab71c46e7e6063cc980d3112ed93a52.
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
