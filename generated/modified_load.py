"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: modified-field.  Operations: 65.  SymPy 1.14.0.
Expression: sha256 10c875e3b2338a8697cc9e70572243414d8567461435ae4b669db7026925b6f7.
Certificate of modified-field: sha256 42d5db5763fbdd55fdde6089975273932648591e41d01f38566e83f3f3741d79.
"""


def modified_load(w1, w2, w3, a1, a2, a3, g1, g2, g3, J1, J2, J3, D):
    """The load of the modified equations: 12ω₃ = 2|ω|²ω - ω × ω' - B(γ)⁻¹load, ω' the rate.

    omega: w1, w2, w3
    rate: a1, a2, a3
    gamma: g1, g2, g3
    mass_tensor: J1, J2, J3
    D: D
    Returns x1, x2, x3.
    """
    # intermediate terms
    t0 = J1 + J2
    t1 = a2 * w3
    t2 = a3 * w2
    t3 = J1 + J3
    t4 = g2 * w3 - g3 * w2
    t5 = a1 * g1 + a2 * g2 + a3 * g3
    t6 = g3 * w1 - g1 * w3
    t7 = g1 * w2 - g2 * w1
    t8 = a1 * t4 + a2 * t6 + a3 * t7
    t9 = 2 * D
    t10 = J2 + J3
    t11 = a1 * w3
    t12 = a3 * w1
    t13 = a1 * w2
    t14 = a2 * w1
    # outputs
    o_x1 = (t0 * t1 + t0 * t2 + t9 * (g1 * t8 + t4 * t5)) - (t1 * t3 + t2 * t3)
    o_x2 = (t10 * t11 + t10 * t12 + t9 * (g2 * t8 + t5 * t6)) - (t0 * t11 + t0 * t12)
    o_x3 = (t13 * t3 + t14 * t3 + t9 * (g3 * t8 + t5 * t7)) - (t10 * t13 + t10 * t14)
    return o_x1, o_x2, o_x3
