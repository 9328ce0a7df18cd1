"""Mechanical systems with constraints on the velocities: equations, maps and verdicts from a Lagrangian.

>>> from sympy import symbols
>>> from chapsym.mechanics import System, dot, flag
>>> x, y, z = symbols("x y z")
>>> particle = System("particle", (x, y, z), sum(dot(q) ** 2 for q in (x, y, z)) / 2, [dot(z) - y * dot(x)])
>>> flag(particle).growth
(2, 3)
"""

from .attitude import Quaternion, Turned
from .brackets import Flag, flag
from .claims import Certified, certified
from .density import Volume, volume
from .equations import Agreement, Conservation, agree, conserved, in_symbols, of_kane
from .judged import Verdict, verdicts
from .lab import Cell, measured
from .methods import METHODS, Method, Scheme
from .motion import Motion, NotSolved, Runner, moved
from .system import STEP, BadSystem, Discrete, System, after, dot, loaded, rate

__all__ = [
    "METHODS", "STEP", "Agreement", "BadSystem", "Cell", "Certified", "Conservation", "Discrete", "Flag", "Method",
    "Motion", "NotSolved", "Quaternion", "Runner", "Scheme", "System", "Turned", "Verdict", "Volume", "after",
    "agree", "certified", "conserved", "dot", "flag", "in_symbols", "loaded", "measured",
    "moved", "of_kane", "rate", "verdicts", "volume",
]  # fmt: skip
