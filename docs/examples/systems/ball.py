"""The Chaplygin ball: a balanced ball of three moments of inertia, which rolls on a plane."""

from sympy import diag, symbols

from chapsym.mechanics import Quaternion, System, dot

body = Quaternion("q")
q0, q1, q2, q3 = body.coordinates
x, y, mass, radius, I1, I2, I3 = symbols("x y mass radius I1 I2 I3")

SYSTEM = System(
    "Chaplygin ball",
    coordinates=(x, y, *body.coordinates),
    lagrangian=mass * (dot(x) ** 2 + dot(y) ** 2) / 2
    + body.spin.dot(diag(I1, I2, I3) * body.spin) / 2
    + 2 * I1 * body.swelling**2,
    constraints=[dot(x) - radius * body.spin_in_space[1], dot(y) + radius * body.spin_in_space[0]],
    holonomic=[body.norm - 1],
    parameters={mass: 1, radius: 1, I1: 1, I2: "3/2", I3: 2},
    start={q0: 1, dot(q1): "1/4", dot(q2): "1/8", dot(q3): "1/10"},
    step="1/20",
    source="S. A. Chaplygin, Mat. Sb. 24 (1903) 139; Yu. Fedorov, SIGMA 3 (2007) 044",
)
