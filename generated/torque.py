"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: modified-field.  Operations: 17.  SymPy 1.14.0.
Expression: sha256 6e1ceb494c0645abfc62a87e1f6c6a1e1c7d981fd23374dc3ec444ab208fc323.
Certificate of modified-field: sha256 42d5db5763fbdd55fdde6089975273932648591e41d01f38566e83f3f3741d79.
"""


def torque(w1, w2, w3, J1, J2, J3):
    """B(γ)ω' = Iω × ω, ω' the rate of ω of the continuous ball.

    omega: w1, w2, w3
    mass_tensor: J1, J2, J3
    Returns x1, x2, x3.
    """
    # intermediate terms
    t0 = J1 + J2
    t1 = J1 + J3
    t2 = w1 * w3
    t3 = J2 + J3
    # outputs
    o_x1 = t1 * w2 * w3 - t0 * w2 * w3
    o_x2 = t0 * t2 - t2 * t3
    o_x3 = t3 * w1 * w2 - t1 * w1 * w2
    return o_x1, o_x2, o_x3
