"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: 5.2-limit.  Operations: 30.  SymPy 1.14.0.
Expression: sha256 8364d39ba783995bbec5d72ea1b61a921649cb00dcfb7b206e3b346ce4bdfbd6.
Certificate of 5.2-limit: sha256 103e5e52e3c8ae0978dde988ed08fef471ad1e8020cba9f98f2af15b0ec5ba78.
"""


def contact_momentum(w1, w2, w3, g1, g2, g3, J1, J2, J3, D):
    """K = Λω - D⟨ω,γ⟩γ, the momentum of the continuous ball about the contact point.

    omega: w1, w2, w3
    gamma: g1, g2, g3
    mass_tensor: J1, J2, J3
    D: D
    Returns K1, K2, K3.
    """
    # intermediate terms
    c1 = g3 * w2 - g2 * w3
    c2 = g1 * w3 - g3 * w1
    c3 = g2 * w1 - g1 * w2
    f1 = D * c1
    f2 = D * c2
    f3 = D * c3
    # outputs
    o_K1 = f3 * g2 + w1 * (J2 + J3) - f2 * g3
    o_K2 = f1 * g3 + w2 * (J1 + J3) - f3 * g1
    o_K3 = f2 * g1 + w3 * (J1 + J2) - f1 * g2
    return o_K1, o_K2, o_K3
