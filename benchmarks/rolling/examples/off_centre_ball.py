"""A ball whose centre of mass is off its centre: it rolls on a plane under its weight."""

from sympy import Matrix, diag, symbols

from chapsym.mechanics import Quaternion, System, dot

body = Quaternion("q")
q0, q1, q2, q3 = body.coordinates
x, y, mass, radius, gravity = symbols("x y mass radius gravity")  # x, y: where it touches the plane
inertia, offset = symbols("A B C"), Matrix(symbols("a b c"))  # about the centre of mass, which is off by this

up = body.rotation.T * Matrix([0, 0, 1])
velocity = body.rotation.T * Matrix([dot(x), dot(y), 0]) + body.spin.cross(offset)  # of the centre of mass

SYSTEM = System(
    "off-centre ball",
    coordinates=(x, y, *body.coordinates),
    lagrangian=mass * velocity.dot(velocity) / 2
    + body.spin.dot(diag(*inertia) * body.spin) / 2
    - mass * gravity * up.dot(offset)
    + 2 * inertia[0] * body.swelling**2,
    constraints=[dot(x) - radius * body.spin_in_space[1], dot(y) + radius * body.spin_in_space[0]],
    holonomic=[body.norm - 1],
    parameters={
        mass: "6/5", radius: "11/100", gravity: "9.81", **dict(zip(inertia, ("81e-4", "88e-4", "94e-4"), strict=True)),
        **dict(zip(offset, ("3/1000", "-2/1000", "4/1000"), strict=True)),
    },
    start={q0: 1, dot(q1): 1, dot(q2): "-3/4", dot(q3): "5/4"},
    step="1/100",
)  # fmt: skip
