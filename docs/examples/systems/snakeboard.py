"""A snakeboard: a board with a rotor and two axles, which are steered against each other."""

from sympy import cos, sin, symbols

from chapsym.mechanics import System, dot

x, y, heading, rotor, steer = q = symbols("x y heading rotor steer")
mass, inertia, of_rotor, of_axle, half = symbols("mass inertia of_rotor of_axle half")
vx, vy, turning, spinning, steering = map(dot, q)

SYSTEM = System(
    "snakeboard",
    coordinates=q,
    lagrangian=mass * (vx**2 + vy**2) / 2
    + inertia * turning**2 / 2
    + of_rotor * (turning + spinning) ** 2 / 2
    + of_axle * ((turning + steering) ** 2 + (turning - steering) ** 2) / 2,
    constraints=[
        -vx * sin(heading + steer) + vy * cos(heading + steer) + half * turning * cos(steer),
        -vx * sin(heading - steer) + vy * cos(heading - steer) - half * turning * cos(steer),
    ],
    parameters={mass: 1, inertia: "1/2", of_rotor: "1/4", of_axle: "1/20", half: 1},
    start={steer: "2/5", vx: 1, spinning: 1, steering: "1/10"},
    step="1/20",
    source="J. Ostrowski, A. Lewis, R. Murray, J. Burdick, Proc. IEEE ICRA 1994, 2391",
)
