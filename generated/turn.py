"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: gibbs-rotation.  Operations: 35.  SymPy 1.14.0.
Expression: sha256 bc9d20e59b3d43e39595ba171f2ae3ba5c60b1c965bb7056067bd6058318b293.
Certificate of gibbs-rotation: sha256 612d55e348c6f845cf43df49fadc522f395f205c2dd379cbf1336457975be449.
"""


def turn(p0, p1, p2, p3, v1, v2, v3):
    """Ωᵀv - v for the rotation of a quaternion that need not be unit (5.3).

    quaternion: p0, p1, p2, p3
    vector: v1, v2, v3
    Returns x1, x2, x3.
    """
    # intermediate terms
    s = 2 / ((p0 * p0 + p1 * p1) + (p2 * p2 + p3 * p3))
    x1 = p2 * v3 - p3 * v2
    x2 = p3 * v1 - p1 * v3
    x3 = p1 * v2 - p2 * v1
    # outputs
    o_x1 = s * (p2 * x3 - p0 * x1 - p3 * x2)
    o_x2 = s * (p3 * x1 - p0 * x2 - p1 * x3)
    o_x3 = s * (p1 * x2 - p0 * x3 - p2 * x1)
    return o_x1, o_x2, o_x3
