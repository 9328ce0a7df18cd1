"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: modified-energy.  Operations: 21.  SymPy 1.14.0.
Expression: sha256 2873e2fb63e73f3c1972decf787535812ef0e179767324d1da173af17a093e59.
Certificate of modified-energy: sha256 4e3c43a416488e439f0f2fb35177e03d217bb06c110d5c7a7f751b70d6def97e.
"""


def energy_rate(w1, w2, w3, a1, a2, a3, g1, g2, g3, D):
    """4X₃(H) = D⟨γ,ω'⟩⟨γ × ω,ω'⟩: in a step of size ε the energy changes by ε³X₃(H), up to ε⁴.

    omega: w1, w2, w3
    rate: a1, a2, a3
    gamma: g1, g2, g3
    D: D
    Returns rate.
    """
    # outputs
    o_rate = D * (a1 * g1 + a2 * g2 + a3 * g3) * (a1 * (g2 * w3 - g3 * w2) + a2 * (g3 * w1 - g1 * w3) + a3 * (g1 * w2 - g2 * w1))
    return o_rate
