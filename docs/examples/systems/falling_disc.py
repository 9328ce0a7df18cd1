"""A disc that rolls on a plane and may fall."""

from sympy import Matrix, cos, sin, symbols

from chapsym.mechanics import System, dot, rate

x, y, heading, lean, roll = q = symbols("x y heading lean roll")  # x, y: where it touches the plane
mass, radius, across, along, gravity = symbols("mass radius across along gravity")

ahead = Matrix([cos(heading), sin(heading), 0])
aside = Matrix([-sin(heading), cos(heading), 0])
up = Matrix([0, 0, 1])
axis = aside * cos(lean) - up * sin(lean)
spoke = aside * sin(lean) + up * cos(lean)  # from where it touches to the centre
spin = up * dot(heading) - ahead * dot(lean) + axis * dot(roll)
velocity = rate(Matrix([x, y, 0]) + radius * spoke, q)  # of the centre
slip = velocity - radius * spin.cross(spoke)

SYSTEM = System(
    "falling rolling disc",
    coordinates=q,
    lagrangian=mass * velocity.dot(velocity) / 2
    + across * (spin.dot(spoke) ** 2 + spin.dot(ahead) ** 2) / 2
    + along * spin.dot(axis) ** 2 / 2
    - mass * gravity * radius * cos(lean),
    constraints=[slip.dot(ahead).simplify(), slip.dot(aside).simplify()],
    parameters={mass: 1, radius: 1, across: "1/4", along: "1/2", gravity: 1},
    start={lean: "1/5", dot(heading): "1/2", dot(roll): 2},
    step="1/20",
    source="A. M. Bloch, Nonholonomic Mechanics and Control, 2nd ed., Springer 2015, section 1.4",
)
