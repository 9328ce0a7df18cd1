"""The contact oscillator with ∂L/∂v beyond the velocities: no longer reversible by q, p -> q, -p."""

from sympy import sin, symbols

from chapsym.mechanics import System, dot

x, y, z, coupling, beyond = symbols("x y z coupling beyond")
vx, vy, vz = map(dot, (x, y, z))

SYSTEM = System(
    "contact oscillator",
    coordinates=(x, y, z),
    lagrangian=(vx**2 + vy**2 + vz**2) / 2 + beyond * sin(z) * vz - (x**2 + y**2 + z**2 + coupling * x**2 * z**2) / 2,
    constraints=[vx + y * vz],
    parameters={coupling: "3/10", beyond: 1},
    start={x: "6/5", z: "1/2", vy: 1},
    source="R. McLachlan, M. Perlmutter, J. Nonlinear Sci. 16 (2006) 283, 5.2; `beyond`: K. Modin, O. Verdier, 2020",
)
