"""A particle in a harmonic potential, which may only move so that z' = y x'."""

from sympy import symbols

from chapsym.mechanics import System, dot

x, y, z = symbols("x y z")
vx, vy, vz = map(dot, (x, y, z))

SYSTEM = System(
    "nonholonomic particle",
    coordinates=(x, y, z),
    lagrangian=(vx**2 + vy**2 + vz**2) / 2 - (x**2 + y**2) / 2,
    constraints=[vz - y * vx],
    start={x: 1, y: "3/10", vx: "1/5", vy: "1/2"},
    source="L. Bates, J. Śniatycki, Rep. Math. Phys. 32 (1993) 99",
)
