"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: vertical-level.  Operations: 24.  SymPy 1.14.0.
Expression: sha256 d2d44f25ebe452046d79b757ca5071721c6327c5dc20e44c057b2445cdecd42c.
Certificate of vertical-level: sha256 9d0845ee05d5519d4c3aaa1c8fbe19ca2e96e370067188e1abf17bd324b1bf12.
"""


def vertical_level(t, v, level, L1, L2, L3):
    """The scalar equation of the level, zero for the step 𝒦 = hγ, and its derivative in v.

    scalars: t, v
    level: level
    Lambda: L1, L2, L3
    Returns f, fv.
    """
    # intermediate terms
    s = t * t
    m = s * v
    t0 = -m
    p1 = L1 + t0
    p2 = L2 + t0
    p3 = L3 + t0
    c = p1 * p2
    a = (L1 + L2) + (L3 - 2 * m)
    b = c + 2 * s + p3 * (p1 + p2)
    t1 = a * s + c * p3
    # outputs
    o_f = t1 * v - level - s
    o_fv = t1 - b * m
    return o_f, o_fv
