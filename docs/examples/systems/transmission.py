"""A continuously variable transmission between two oscillators, whose ratio a pendulum drives."""

from sympy import cos, sin, symbols

from chapsym.mechanics import System, dot

x, z, driver, gravity = symbols("x z driver gravity")

SYSTEM = System(
    "transmission",
    coordinates=(x, z, driver),
    lagrangian=(dot(x) ** 2 + dot(z) ** 2 + dot(driver) ** 2) / 2 - (x**2 + z**2) / 2 + gravity * cos(driver),
    constraints=[dot(x) + sin(driver) * dot(z)],
    parameters={gravity: 1},
    start={x: 1, z: "1/2", driver: "3/10", dot(driver): "3/2"},
    source="after K. Modin, O. Verdier, Numer. Math. 145 (2020) 405",
)
