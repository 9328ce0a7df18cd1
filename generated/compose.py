"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: 5.1.  Operations: 28.  SymPy 1.14.0.
Expression: sha256 c2c5eedf4193ab6b075e0fe7934aa3730cac1fb5d19bde2b39cfe5363057b2b5.
Certificate of 5.1: sha256 64f49fa9619a0f7315e5fd081d8836e3cca188cf86b64909c1a70aff37aa5e38.
"""


def compose(a0, a1, a2, a3, b0, b1, b2, b3):
    """Hamilton's product of two quaternions, scalar first: R_{k+1} = R_k Ω_k for attitudes.

    first: a0, a1, a2, a3
    second: b0, b1, b2, b3
    Returns c0, c1, c2, c3.
    """
    # outputs
    o_c0 = (a0 * b0 - a1 * b1) - (a2 * b2 + a3 * b3)
    o_c1 = (a0 * b1 + a1 * b0) + (a2 * b3 - a3 * b2)
    o_c2 = (a0 * b2 + a2 * b0) + (a3 * b1 - a1 * b3)
    o_c3 = (a0 * b3 + a1 * b2) + (a3 * b0 - a2 * b1)
    return o_c0, o_c1, o_c2, o_c3
