"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: K-velocity.  Operations: 3.  SymPy 1.14.0.
Expression: sha256 cb1e4af1d00e41ee05df92fd03fddca0f4ebffd9f95e59201e3cb38bd26bfdcf.
Certificate of K-velocity: sha256 8aacdaa7496007ab66318611058b717fce4b4c90776578ce7a5e5d3cd10f31d6.
"""


def velocity(u1, u2, u3, r):
    """The velocity of the centre along L.x and L.y, for which the disc does not slip.

    spin: u1, u2, u3
    radius: r
    Returns v1, v2.
    """
    # outputs
    o_v1 = r * u2
    o_v2 = -r * u1
    return o_v1, o_v2
