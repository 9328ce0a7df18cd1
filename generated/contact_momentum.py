"""K = Λω - D⟨ω,γ⟩γ, the momentum of the continuous ball about the contact point.

Written by `chapsym codegen`: do not edit; change the derivation and generate again.
Proved by: 4.13-limit, 5.2-limit.  Operations: 36.  SymPy 1.14.0.
Expression: sha256 8364d39ba783995bbec5d72ea1b61a921649cb00dcfb7b206e3b346ce4bdfbd6.
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
    t0 = D * g1
    t1 = g2 * t0
    t2 = g3 * w3
    t3 = g2 * g2
    t4 = g3 * g3
    t5 = D * g2
    t6 = g1 * g1
    # outputs
    o_K1 = w1 * (J2 + J3 + D * (t3 + t4)) - t0 * t2 - t1 * w2
    o_K2 = w2 * (J1 + J3 + D * (t4 + t6)) - t1 * w1 - t2 * t5
    o_K3 = w3 * (J1 + J2 + D * (t3 + t6)) - g3 * t0 * w1 - g3 * t5 * w2
    return o_K1, o_K2, o_K3
