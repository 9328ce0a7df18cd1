"""A map of the disc: the midpoint rule on its lean and its angular velocity.

A step of length h goes from x = (q2, u1, u2, u3) to y with y - x = h f((x + y)/2), where f are the rates that follow
from the principle.  Its unknown is the middle z = (x + y)/2; s2 and c2 are the sine and the cosine of the lean there.
"""

import sympy as sp

from chapsym.derive import Quotient
from chapsym.prove import Proof, claim, equations

from .disc import by_spin, c, d, g, moving, r, s, u
from .kane import spin_rates

q2, h = sp.symbols("q2 h")
x = sp.Matrix(sp.symbols("x1:5"))  # at the beginning
z = sp.Matrix([q2, *u])  # in the middle

equal = equations(Quotient((*z, *x, s[1], c[1], r, g, h), [s[1] ** 2 + c[1] ** 2 - 1]))
STEP = "the middle less the beginning is half of h f"


def rates():
    """f in the middle: the rate of the lean, and those of the angular velocity."""
    return sp.Matrix([by_spin(d[1]), *spin_rates()])


def lack(start, length):
    """What vanishes where z is the middle of the step from `start`."""
    return z - start - length / 2 * rates()


def typed(start, length):
    """The same, with the rates as SymPy's documentation prints them."""
    tan = s[1] / c[1]
    turned = (4 * g * s[1] + 6 * r * u[1] * u[2] - r * u[2] ** 2 * tan) / (5 * r)
    printed = sp.Matrix([u[0], turned, -2 * u[0] * u[2] / 3, (u[2] * tan - 2 * u[1]) * u[0]])
    return z - start - length / 2 * printed


@claim("M-step", r"z - x = \tfrac{h}{2} f(z)", uses=["K-u1", "K-u2", "K-u3"])
def step(p: Proof) -> None:
    """The equations of a step, by the rates that follow from the principle and by those that are printed."""
    moving(p)
    p.printed(equal(STEP, lack(x, h), typed(x, h)))
    p.control(equal("the same with the whole of h", lack(x, 2 * h), typed(x, h)))


@claim("M-reverse", r"\Phi_{-h}(\Phi_h(x)) = x", uses=["M-step"])
def reverse(p: Proof) -> None:
    """The step back from y = 2z - x has the same middle: the map is self-adjoint."""
    moving(p)
    p.printed(equal("the equations of the step back", lack(2 * z - x, -h), -lack(x, h)))
    p.control(equal("of the step on, from there", lack(2 * z - x, h), -lack(x, h)))


@claim("M-steady", r"\Phi_h(x) = x \iff f(x) = 0", uses=["M-step"])
def steady(p: Proof) -> None:
    """The map rests where the disc moves steadily, for every h."""
    moving(p)
    p.assume("h is not 0", sp.Ne(h, 0))
    p.say("The end is the beginning where the middle is, as y = 2z - x.")
    p.printed(equal("the equations, with the beginning in the middle", lack(z, h), -h / 2 * rates()))
    p.control(equal("with the whole of h", lack(z, h), -h * rates()))
