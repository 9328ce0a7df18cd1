"""A disc that rolls upright on a plane, in a potential."""

from sympy import cos, sin, symbols

from chapsym.mechanics import System, dot

x, y, heading, roll = symbols("x y heading roll")
mass, radius, about_vertical, about_axis = symbols("mass radius about_vertical about_axis")
vx, vy, turning, rolling = map(dot, (x, y, heading, roll))

SYSTEM = System(
    "vertical rolling disc",
    coordinates=(x, y, heading, roll),
    lagrangian=mass * (vx**2 + vy**2) / 2 + about_vertical * turning**2 / 2 + about_axis * rolling**2 / 2 - sin(x) / 2,
    constraints=[vx - radius * cos(heading) * rolling, vy - radius * sin(heading) * rolling],
    parameters={mass: 1, radius: 1, about_vertical: "1/4", about_axis: "1/2"},
    start={heading: "2/5", turning: "7/10", rolling: "9/10"},
    source="A. M. Bloch, Nonholonomic Mechanics and Control, 2nd ed., Springer 2015, section 1.4",
)
