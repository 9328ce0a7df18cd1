"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: stable-inverse.  Operations: 44.  SymPy 1.14.0.
Expression: sha256 bf001ea627c2a020209b8f7cd96e7b036037dbd39581337739aa4e562cb3b0c8.
Certificate of stable-inverse: sha256 5db020d5d32aa64d3f60ea9a20bbe1d8c232f9965594c3c29928f58603dd4c28.
"""


def energy(K1, K2, K3, g1, g2, g3, J1, J2, J3, D):
    """The kinetic energy ½⟨K, ω⟩ of the continuous ball with the momentum K (2.5 as corrected).

    momentum: K1, K2, K3
    gamma: g1, g2, g3
    mass_tensor: J1, J2, J3
    D: D
    Returns T.
    """
    # intermediate terms
    t0 = J2 + J3
    t1 = 1 / (D + t0)
    t2 = J1 + J3
    t3 = 1 / (D + t2)
    t4 = J1 + J2
    t5 = 1 / (D + t4)
    t6 = K1 * g1 * t1 + K2 * g2 * t3 + K3 * g3 * t5
    # outputs
    o_T = (K1 * K1 * t1 / 2 + K2 * K2 * t3 / 2) + (K3 * K3 * t5 / 2 + D * t6 * t6 / (2 * (g1 * g1 * t0 * t1 + g2 * g2 * t2 * t3 + g3 * g3 * t4 * t5)))
    return o_T
