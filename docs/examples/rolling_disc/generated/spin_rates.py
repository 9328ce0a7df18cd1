"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: K-u1, K-u2, K-u3.  Operations: 42.  SymPy 1.14.0.
Expression: sha256 56fbc59f37670fe1b48c9c7d42cfe8283aae1f14b7199dc56cb18820b7ab644a.
Certificate of K-u1: sha256 a9442e43d09ac7362ce106d36c42be4ff12166683d3eade3852869e7abde7edd.
Certificate of K-u2: sha256 62e9d1d99c940a5cf4916984dd9dd12250e2425ce6279bd05a5ce752302fdbd9.
Certificate of K-u3: sha256 3bdf586b42b43a6a43d1344803a61ea21c9f232fb57f8ea1a1dd42f6aadaa882.
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
