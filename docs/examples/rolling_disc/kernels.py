"""What the disc runs on: its accelerations, the rates of its angular velocity, the velocity of its centre, a step."""

import sympy as sp

from chapsym.codegen import Kernel, left, right

from .disc import LINEAR, a, accelerations, c, d, g, r, s, u
from .kane import spin_rates
from .step import STEP, h, q2, typed, x, z

LEANS = {s[1]: sp.sin(q2), c[1]: sp.cos(q2)}
LEAN, RATES, SPIN = ("lean", (q2,)), ("rates", d), ("spin", u)
RADIUS, GRAVITY = ("radius", (r,)), ("gravity", (g,))
STATE = ("middle", tuple(z)), ("start", tuple(x)), RADIUS, GRAVITY, ("step", (h,))
#: The derivatives by the middle: the letters move with the lean.
BY_MIDDLE = {q2: 1, s[1]: c[1], c[1]: -s[1]}, *({y: 1} for y in u)


def slope():
    """The derivatives of a step's equations by the lean and the angular velocity in the middle."""
    lack = typed(x, h)
    by_lean = [sum(sp.diff(f, y) * rate for y, rate in BY_MIDDLE[0].items()) for f in lack]
    return sp.Matrix.hstack(sp.Matrix(by_lean), lack.jacobian(u))


def at_rest(principle):
    """The principle where nothing is accelerated: what the accelerations balance."""
    return principle.at(dict.fromkeys(a, 0))


KERNELS = [
    Kernel(
        "accelerations",
        "The second derivatives of heading, lean and turn, in the rates of the angles.",
        (at_rest(left("I-a1", LINEAR)).solved(left("I-a1", LINEAR).along(*({x: -1} for x in a))),),
        (LEAN, RATES, RADIUS, GRAVITY),
        ("a1", "a2", "a3"),
        accelerations,
        letters=LEANS,
    ),
    Kernel(
        "spin_rates",
        "The derivatives of the angular velocity along L.x, L.y, L.z.",
        (
            left("K-u1", "u1' = (4 g sin q2 + 6 r u2 u3 - r u3² tan q2)/(5 r)"),
            left("K-u2", "u2' = -2 u1 u3/3"),
            left("K-u3", "u3' = (u3 tan q2 - 2 u2) u1"),
        ),
        (LEAN, SPIN, RADIUS, GRAVITY),
        ("b1", "b2", "b3"),
        spin_rates,
        letters=LEANS,
    ),
    Kernel(
        "velocity",
        "The velocity of the centre along L.x and L.y, for which the disc does not slip.",
        (right("K-velocity", "v = r u2 L.x - r u1 L.y").entries(0, 1),),
        (SPIN, RADIUS),
        ("v1", "v2"),
        lambda: [r * u[1], -r * u[0]],
    ),
    Kernel(
        "step_lack",
        "What vanishes where the middle is that of a step of the midpoint rule.",
        (right("M-step", STEP),),
        STATE,
        ("f1", "f2", "f3", "f4"),
        lambda: list(typed(x, h)),
        letters=LEANS,
    ),
    Kernel(
        "step_slope",
        "Its derivatives by the middle, row by row.",
        (right("M-step", STEP).along(*BY_MIDDLE),),
        STATE,
        tuple(f"j{row}{column}" for row in range(1, 5) for column in range(1, 5)),
        lambda: list(slope()),
        letters=LEANS,
    ),
]
