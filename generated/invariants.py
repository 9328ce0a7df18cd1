"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: 5.3-integrals.  Operations: 15.  SymPy 1.14.0.
Expression: sha256 501e078b24c674f9edbb37ed6e8457d6b5da2c6ecd1fe28cfbe3588c521326bf.
Certificate of 5.3-integrals: sha256 f7d01888ece4ffb99451b34d54eddbe31fc0acd6eadffb446d24c0d4b275cca1.
"""


def invariants(K1, K2, K3, g1, g2, g3):
    """⟨𝒦,γ⟩ (the paper's h), ⟨𝒦,𝒦⟩ (its n) and ⟨γ,γ⟩, which every branch of the map preserves.

    momentum: K1, K2, K3
    gamma: g1, g2, g3
    Returns h, n, unit.
    """
    # outputs
    o_h = K1 * g1 + K2 * g2 + K3 * g3
    o_n = K1 * K1 + K2 * K2 + K3 * K3
    o_unit = g1 * g1 + g2 * g2 + g3 * g3
    return o_h, o_n, o_unit
