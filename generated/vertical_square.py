"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: prop-3.  Operations: 11.  SymPy 1.14.0.
Expression: sha256 85f54a4c249d7c5794e172ecaaefd732ed5e0522c8b8f15505d392911fc800e4.
Certificate of prop-3: sha256 6e26ee79d4a9d21515eef245f5a9adc32354a9e29428f72e30ded33e3dfae217.
"""


def vertical_square(g1, g2, g3, L1, L2, L3):
    """⟨γ, adj(Λ)γ⟩ = det(Λ)⟨γ, Λ⁻¹γ⟩, the integral of the reduced map G_h without its denominators.

    gamma: g1, g2, g3
    Lambda: L1, L2, L3
    Returns level.
    """
    # outputs
    o_level = L1 * L2 * g3 * g3 + L1 * L3 * g2 * g2 + L2 * L3 * g1 * g1
    return o_level
