"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: vertical-rotation.  Operations: 44.  SymPy 1.14.0.
Expression: sha256 1b59598563aad694dcc4d8cd7fa37a2401a7bd0e565d4b8f5fed87ca5262396f.
Certificate of vertical-rotation: sha256 0e4be450855e6b23231ae72b0a483e041d565dd51622b0b6db48a196ddeea891.
"""


def vertical_rotation(t, e, g1, g2, g3, L1, L2, L3):
    """The rotation of the step 𝒦 = hγ up to a factor, (q0, q) ∝ (det M, t adj(M)γ), M = Λ - e - t γ×.

    sigma: t, e
    gamma: g1, g2, g3
    Lambda: L1, L2, L3
    Returns p0, p1, p2, p3.
    """
    # intermediate terms
    t0 = -e
    t1 = L1 + t0
    t2 = L2 + t0
    t3 = L3 + t0
    t4 = t2 * t3
    t5 = t * t
    t6 = -L3
    t7 = g3 * t
    # outputs
    o_p0 = t1 * t4 + t5 * (g1 * g1 * t1 + g2 * g2 * t2 + g3 * g3 * t3)
    o_p1 = t * (g1 * (t4 + t5) + g2 * t7 * (L2 + t6))
    o_p2 = t * (g2 * (t5 + t1 * t3) + g1 * t7 * (-L1 - t6))
    o_p3 = t * (g3 * (t5 + t1 * t2) + g1 * g2 * t * (L1 - L2))
    return o_p0, o_p1, o_p2, o_p3
