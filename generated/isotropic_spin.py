"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: isotropic-spin.  Operations: 24.  SymPy 1.14.0.
Expression: sha256 dca5ee5fa586d5431e4f75db2c142fff21679e5cefc16f8b58c3ca65552173b7.
Certificate of isotropic-spin: sha256 cbe7a8f044ad5467f35b4523ba37acf26753c04142ae6dc2926e41a05abc7b96.
"""


def isotropic_spin(k1, k2, k3, g1, g2, g3, moment, D):
    """w = B(γ/|γ|)⁻¹k for three equal moments: 2w is sin θ times the axis of the steady rotation.

    half_momentum: k1, k2, k3
    gamma: g1, g2, g3
    moment: moment
    D: D
    Returns w1, w2, w3.
    """
    # intermediate terms
    share = D * (g1 * k1 + g2 * k2 + g3 * k3) / (moment * (g1 * g1 + g2 * g2 + g3 * g3))
    whole = D + moment
    t0 = 1 / whole
    # outputs
    o_w1 = t0 * (k1 + g1 * share)
    o_w2 = t0 * (k2 + g2 * share)
    o_w3 = t0 * (k3 + g3 * share)
    return o_w1, o_w2, o_w3
