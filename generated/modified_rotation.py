"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: modified-field.  Operations: 26.  SymPy 1.14.0.
Expression: sha256 bc3215308c7917b39d2edd4c01f169c9d5a2eab74172a82477d46f5134259a2f.
Certificate of modified-field: sha256 42d5db5763fbdd55fdde6089975273932648591e41d01f38566e83f3f3741d79.
"""


def modified_rotation(w1, w2, w3, a1, a2, a3, e1, e2, e3):
    """12ω₃: the step of size ε is that of the continuous ball with ω + ε²ω₃, up to ε⁴; share = B(γ)⁻¹load.

    omega: w1, w2, w3
    rate: a1, a2, a3
    share: e1, e2, e3
    Returns x1, x2, x3.
    """
    # intermediate terms
    t0 = 2 * w1 * w1 + 2 * w2 * w2 + 2 * w3 * w3
    # outputs
    o_x1 = (a2 * w3 + t0 * w1) - (e1 + a3 * w2)
    o_x2 = (a3 * w1 + t0 * w2) - (e2 + a1 * w3)
    o_x3 = (a1 * w2 + t0 * w3) - (e3 + a2 * w1)
    return o_x1, o_x2, o_x3
