"""A register of two claims, which processes load sooner than the proofs of the paper."""

import sympy as sp

from chapsym.derive import Quotient
from chapsym.prove import claim, equations

a, b = sp.symbols("a b")
equal = equations(Quotient((a, b)))


def difference(p):
    """A difference of squares."""
    p.printed(equal("a² - b² = (a - b)(a + b)", a**2 - b**2, (a - b) * (a + b)))
    p.control(equal("the same with a² + b²", a**2 + b**2, (a - b) * (a + b)))


for name in ("s-1", "s-2"):
    claim(name, r"a^2 - b^2 = (a - b)(a + b)")(difference)
