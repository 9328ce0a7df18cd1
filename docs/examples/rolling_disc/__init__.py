"""What the documentation of SymPy prints about a rolling disc, judged: a register that is not of chapsym."""

SCRIPTS = ("kane", "forces", "lagrange", "issue", "step")

PAPER = "SymPy, documentation of sympy.physics.mechanics, A rolling disc"

NOTE = (
    "The pages print code and what it answers; the formulas are these answers, with s_i, c_i, d_i, a_i for "
    "sin q_i, cos q_i, q_i', q_i'' and L.x, L.y, L.z for the axes of the lean frame."
)
