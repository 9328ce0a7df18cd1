"""The Chaplygin sleigh: a body on a plane on a knife edge, whose centre of mass is a distance ahead of the edge."""

from sympy import cos, sin, symbols

from chapsym.mechanics import System, dot

x, y, heading = symbols("x y heading")  # the centre of mass
mass, inertia, ahead = symbols("mass inertia ahead")
vx, vy, turning = map(dot, (x, y, heading))

SYSTEM = System(
    "Chaplygin sleigh",
    coordinates=(x, y, heading),
    lagrangian=mass * (vx**2 + vy**2) / 2 + inertia * turning**2 / 2,
    constraints=[-vx * sin(heading) + vy * cos(heading) - ahead * turning],
    parameters={mass: 1, inertia: "3/2", ahead: "1/2"},
    start={heading: "1/10", vx: "1/5", turning: "7/10"},
    source="S. A. Chaplygin, Mat. Sb. 28 (1911) 303; Regul. Chaotic Dyn. 13 (2008) 369",
)
