"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: 4.9.  Operations: 14.  SymPy 1.14.0.
Expression: sha256 b2ddfda83f23efc81a6081421999a6692502be23b8b84c91933ae8d83e98dd7d.
Certificate of 4.9: sha256 207623113b3af81fb483a06fff4056b43125216711ddbd216d8f456c1fe14577.
"""


def centre_step(q0, q1, q2, q3, g1, g2, g3):
    """Δr/ρ of one step in the body frame before it, γ upwards (4.9 with 2.1 as corrected).

    rotation: q0, q1, q2, q3
    gamma: g1, g2, g3
    Returns s1, s2, s3.
    """
    # intermediate terms
    t0 = 2 * q0
    # outputs
    o_s1 = t0 * (g3 * q2 - g2 * q3)
    o_s2 = -t0 * (g3 * q1 - g1 * q3)
    o_s3 = t0 * (g2 * q1 - g1 * q2)
    return o_s1, o_s2, o_s3
