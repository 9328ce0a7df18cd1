"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: S-gibbs.  Operations: 19.  SymPy 1.14.0.
Expression: sha256 8101e48378602aed52e50176ca985a1d178b1a44fee87ac2f72c95468bb0e59a.
Certificate of S-gibbs: sha256 4bf3002a3b7a8f634b7fc9c9a665682c3b0b35187010128e81ea1ece2cc5bf51.
"""


def turn(u1, u2):
    """The matrix of the turn of a Gibbs vector, row by row.

    gibbs: u1, u2
    Returns t11, t12, t13, t21, t22, t23, t31, t32, t33, the 3×3 matrix row by row.
    """
    # intermediate terms
    t0 = u2 * u2
    t1 = u1 * u1
    t2 = 1 + t1
    t3 = 1 / (t0 + t2)
    t4 = 2 * t3
    t5 = t4 * u2
    t6 = t5 * u1
    t7 = t4 * u1
    # outputs
    o_t11 = t3 * (t2 - t0)
    o_t12 = t6
    o_t13 = t5
    o_t21 = t6
    o_t22 = t3 * (1 + t0 - t1)
    o_t23 = -t7
    o_t31 = -t5
    o_t32 = t7
    o_t33 = t3 * (1 - t0 - t1)
    return o_t11, o_t12, o_t13, o_t21, o_t22, o_t23, o_t31, o_t32, o_t33
