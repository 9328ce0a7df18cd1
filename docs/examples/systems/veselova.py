"""The Veselova problem: a body about a fixed point, which may not turn about the vertical."""

from sympy import diag, symbols

from chapsym.mechanics import Quaternion, System, dot

body = Quaternion("q")
q0, q1, q2, q3 = body.coordinates
I1, I2, I3 = symbols("I1 I2 I3")

SYSTEM = System(
    "Veselova",
    coordinates=body.coordinates,
    lagrangian=body.spin.dot(diag(I1, I2, I3) * body.spin) / 2 + 2 * I1 * body.swelling**2,
    constraints=[body.spin_in_space[2]],
    holonomic=[body.norm - 1],
    parameters={I1: 1, I2: 2, I3: 3},
    start={q0: 1, dot(q1): "1/4", dot(q2): "3/20"},
    step="1/20",
    source="A. P. Veselov, L. E. Veselova, Math. Notes 44 (1988) 810",
)
