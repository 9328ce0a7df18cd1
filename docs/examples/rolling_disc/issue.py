"""What the issue 27631 of SymPy gives in the place of the page on Lagrange's method.

github.com/sympy/sympy/issues/27631, of 2021: Error in the example "A rolling disk using the Lagrange method".
"""

from chapsym.prove import Proof, claim

from .disc import accelerations, c, d, equal, g, moving, r, s

TAN = s[1] / c[1]


@claim("I-a1", r"\ddot q_1 = -\frac{2 \dot q_2 \dot q_3}{\cos q_2}")
def heading_acceleration(p: Proof) -> None:
    """The acceleration of the heading, as the issue has it."""
    moving(p)
    p.printed(equal("q1'' = -2 q2' q3'/cos q2", accelerations()[0], -2 * d[1] * d[2] / c[1]))
    p.control(equal("q1'' = 2 q2' q3'/cos q2", accelerations()[0], 2 * d[1] * d[2] / c[1]))


@claim(
    "I-a2",
    r"\ddot q_2 = \frac{4 g \sin q_2}{5 r} + \tfrac12 \sin 2q_2\, \dot q_1^2 + \tfrac65 \cos q_2\, \dot q_1 \dot q_3",
)
def lean_acceleration(p: Proof) -> None:
    """The acceleration of the lean, as the issue has it."""
    moving(p)
    fall, rest = 4 * g * s[1] / (5 * r), 6 * c[1] * d[0] * d[2] / 5
    found, turned = accelerations()[1], s[1] * c[1] * d[0] ** 2
    p.printed(equal("q2'' = 4 g sin q2/(5 r) + sin 2q2 q1'²/2 + 6 cos q2 q1' q3'/5", found, fall + turned + rest))
    p.control(equal("the same with sin q2 for sin 2q2", found, fall + s[1] * d[0] ** 2 / 2 + rest))


@claim("I-a3", r"\ddot q_3 = -\tfrac16 (10 \cos q_2\, \dot q_1 - 12 \tan q_2\, \dot q_3)\, \dot q_2")
def turn_acceleration(p: Proof) -> None:
    """The acceleration of the turn, as the issue has it."""
    moving(p)
    found = accelerations()[2]
    p.printed(
        equal("q3'' = -(10 cos q2 q1' - 12 tan q2 q3') q2'/6", found, -(10 * c[1] * d[0] - 12 * TAN * d[2]) * d[1] / 6)
    )
    p.control(equal("the same with +12 tan q2 q3'", found, -(10 * c[1] * d[0] + 12 * TAN * d[2]) * d[1] / 6))
