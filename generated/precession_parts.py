"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: top-precession.  Operations: 15.  SymPy 1.14.0.
Expression: sha256 0c9795cc937a6b0efc114d9aa8a9c59e1ff2ba12bf43265696618ff430e1bbde.
Certificate of top-precession: sha256 99321ef024351bf090c4242707573deae05f9fed41d7c21e3bad9c15a8072561.
"""


def precession_parts(L1, L2, L3, l):
    """|b|² = P0 + P1 sn² and ⟨b,Λ⁻¹b⟩ = N0 + N1 sn² on a curve, b = γ × Λ⁻¹γ: Rb turns about γ by their quotient.

    ordered: L1, L2, L3
    inverse_square: l
    Returns P0, P1, N0, N1.
    """
    # intermediate terms
    t0 = (L3 * l - 1) / (L1 * L3)
    t1 = t0 * (L1 * l - 1)
    t2 = 1 / L2
    t3 = t0 * t2 * (L1 - L2)
    # outputs
    o_P0 = -t1
    o_P1 = t3
    o_N0 = -t1 * t2
    o_N1 = l * t3
    return o_P0, o_P1, o_N0, o_N1
