"""The systems of the documentation, whose equations are derived once in a process, and symbols for those of tests."""

from functools import cache
from pathlib import Path

import sympy as sp

from chapsym.mechanics import METHODS, Runner, System, dot, loaded

SYSTEMS = Path(__file__).parents[1] / "docs/examples/systems"
#: The methods that take any system.
ANYWHERE = [name for name in METHODS if name != "own"]
SYMMETRIC = ["dla", "gni", "leapfrog", "spark", "midpoint"]
x, y, z, a, k = sp.symbols("x y z a k")
vx, vy, vz, va = map(dot, (x, y, z, a))
FREE = (vx**2 + vy**2 + vz**2) / 2


@cache
def example(name):
    """A system of the documentation, by the name of its file."""
    return loaded(SYSTEMS / f"{name}.py")


def particle(**changes):
    """The nonholonomic particle with other settings."""
    settings = {"lagrangian": FREE, "constraints": [vz - y * vx], "start": {y: "3/10", vx: 1, vy: "1/2"}}
    return System("particle", (x, y, z), **settings | changes)


@cache
def runner(name, method, precision="double"):
    """A method made ready for an example once, in C where it can be."""
    return Runner(example(name), method, precision=precision)
