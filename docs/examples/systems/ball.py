"""The Chaplygin ball: balanced, of three moments of inertia, it rolls on a plane; and the map of Fedorov's paper."""

from sympy import Matrix, diag, symbols

from chapsym.mechanics import STEP, Discrete, Quaternion, System, after, dot

body = Quaternion("q")
q0, q1, q2, q3 = body.coordinates
x, y, mass, radius, J1, J2, J3 = symbols("x y mass radius J1 J2 J3")  # J: the second moments of mass

inertia, up = diag(J2 + J3, J1 + J3, J1 + J2), body.rotation.T * Matrix([0, 0, 1])
across = body.spin - up * up.dot(body.spin)
momentum = inertia * body.spin + mass * radius**2 * across  # about the contact point
start, end = body.rotation, body.rotation.xreplace({q: after(q) for q in body.coordinates})
moved, turned = Matrix([after(x) - x, after(y) - y, 0]), end * start.T
slip = moved + radius / 2 * (turned - turned.T) * Matrix([0, 0, -1])  # (4.9), whose plane is above the ball
skew = end * diag(J1, J2, J3) * start.T
carried = (skew - skew.T).vee() + mass * radius * Matrix([0, 0, 1]).cross(moved)  # 𝒦, in the axes of space
energy = (mass * moved.dot(moved) + ((end - start) * diag(J1, J2, J3) * (end - start).T).trace()) / 2

SYSTEM = System(
    "Chaplygin ball",
    coordinates=(x, y, *body.coordinates),
    lagrangian=mass * (dot(x) ** 2 + dot(y) ** 2) / 2
    + body.spin.dot(inertia * body.spin) / 2
    + 2 * J1 * body.swelling**2,
    constraints=[dot(x) - radius * body.spin_in_space[1], dot(y) + radius * body.spin_in_space[0]],
    holonomic=[body.norm - 1],
    parameters={mass: 1, radius: 1, J1: "5/4", J2: "3/4", J3: "1/4"},
    start={q0: 1, dot(q1): "1/4", dot(q2): "1/8", dot(q3): "1/10"},
    step="1/20",
    source="S. A. Chaplygin, Mat. Sb. 24 (1903) 139; Yu. Fedorov, SIGMA 3 (2007) 044",
    integrals={"|K|²": momentum.dot(momentum), "⟨K,γ⟩": momentum.dot(up)},
    discrete=Discrete(energy / STEP, slip[:2], {"|𝒦|²": carried.dot(carried), "⟨𝒦,γ⟩": carried[2]}),
)
