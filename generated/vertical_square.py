"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: prop-3.  Operations: 11.  SymPy 1.14.0.
Expression: sha256 85f54a4c249d7c5794e172ecaaefd732ed5e0522c8b8f15505d392911fc800e4.
Certificate of prop-3: sha256 aae75f35cece04b862b233cdba93477655098e2f2348dec3efeed602920963ab.
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
