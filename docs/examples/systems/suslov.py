"""The Suslov problem: a body about a fixed point, which may not turn about its third axis."""

from sympy import Matrix, symbols

from chapsym.mechanics import Quaternion, System, dot

body = Quaternion("q")
q0, q1, q2, q3 = body.coordinates
I1, I2, I3, I13, I23 = symbols("I1 I2 I3 I13 I23")
inertia = Matrix([[I1, 0, I13], [0, I2, I23], [I13, I23, I3]])

SYSTEM = System(
    "Suslov",
    coordinates=body.coordinates,
    lagrangian=body.spin.dot(inertia * body.spin) / 2 + 2 * I1 * body.swelling**2,
    constraints=[body.spin[2]],
    holonomic=[body.norm - 1],
    parameters={I1: 1, I2: 2, I3: "5/2", I13: "1/10", I23: "1/5"},
    start={q0: 1, dot(q1): "1/4", dot(q2): "3/20"},
    step="1/20",
    source="G. K. Suslov, Theoretical Mechanics, Gostekhizdat 1946 (in Russian)",
)
