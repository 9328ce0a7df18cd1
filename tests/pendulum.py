"""A register of its own for tests of kernels: a pendulum."""

CLAIMS = '''"""A pendulum that is pushed: its acceleration, and what keeps its length."""

import sympy as sp

from chapsym.derive import Quotient
from chapsym.prove import Proof, claim, equations

x, y, v, w, a, g = sp.symbols("x y v w a g")
equal = equations(Quotient((x, y, v, w, a, g), [x**2 + y**2 - 1]))


def pull():
    """The multiplier with x'' = -a x, y'' = -a y - g, where (x² + y²)'' = 0."""
    return v**2 + w**2 - g * y


@claim("{id}", r"a = v^2 + w^2 - gy")
def length(p: Proof) -> None:
    """What keeps the length."""
    second = v**2 + w**2 + x * (-a * x) + y * (-a * y - g)
    p.printed(equal("(x² + y²)''/2 = v² + w² - a - g y", second, v**2 + w**2 - a - g * y))
    p.lemma(equal("a at which that is 0", pull(), (v**2 + w**2 - g * y) * (x**2 + y**2)))
    p.control(equal("the same with + g y", pull(), v**2 + w**2 + g * y))
'''
KERNELS = """from chapsym.codegen import Kernel, left, right

from .claims import a, g, pull, v, w, x, y

MOVING = "(x² + y²)''/2 = v² + w² - a - g y"
KERNELS = [
    Kernel("pull", "What keeps the length.", ({carrier},), {groups}, ("a",), lambda: [{expression}]),
]
"""
SOLVED = "right('{id}', MOVING).at({{a: 0}}).solved(right('{id}', MOVING).along({{a: -1}}))"
GROUPS = '(("place", (x, y)), ("velocity", (v, w)), ("gravity", (g,)))'
