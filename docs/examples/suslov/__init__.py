"""The discrete Suslov top: a body about a fixed point, none of whose turns is about an axis with a part along e3."""

PAPER = "The discrete Suslov top"

NOTE = (
    "Fedorov and Zenkov (Nonlinearity 18, 2005) introduced such tops. The formulas are not quoted from there: they are "
    "derived from the Lagrangian of Moser and Veselov, tr(Ω J), and the constraint. Ω is the turn of the body from one "
    "instant to the next, of Euler parameters q0, (q1, q2, 0); the axes are such that J12 = 0."
)
