"""A rolling disc using Lagrange's Method.

rollingdisc_example_lagrange.rst, commit 07941f60ee1a: the page puts the constraint into the Lagrangian and
takes its Euler-Lagrange equations, which is no principle of mechanics where the constraint is nonholonomic; and it
lets the disc fall upwards.
"""

import sympy as sp

from chapsym.prove import Proof, claim

from .disc import a, accelerations, by_angle, c, d, equal, g, height, m, moving, principle, r, rolling, s, seen_moving

#: sin 2q2, cos 2q2.
TWICE = 2 * s[1] * c[1], c[1] ** 2 - s[1] ** 2
TAN = s[1] / c[1]


@claim("L-velocity", r"v = r(\sin q_2\, \dot q_1 + \dot q_3)\, L_x - r \dot q_2\, L_y")
def centre_velocity(p: Proof) -> None:
    """The velocity of the centre, in the rates of the angles."""
    p.printed(equal("v", rolling(), [r * (s[1] * d[0] + d[2]), -r * d[1], 0]))
    p.control(equal("the same with cos q2", rolling(), [r * (c[1] * d[0] + d[2]), -r * d[1], 0]))


@claim("L-potential", r"V = -m g r \cos q_2")
def potential(p: Proof) -> None:
    """The potential energy has the wrong sign: the disc would fall upwards."""
    p.say("The weight -m g N.z, as the page on Kane's method has it, does the work -δV in a lean of the disc.")
    work = -m * g * by_angle(height(), 1)
    printed, true = -m * g * r * c[1], m * g * r * c[1]
    p.printed(equal("V = -m g r cos q2: -∂V/∂q2 is the work of the weight", -by_angle(printed, 1), work))
    p.corrected(
        r"V = m g r \cos q_2", equal("V = m g r cos q2: -∂V/∂q2 is the work of the weight", -by_angle(true, 1), work)
    )
    p.counterexample(seen_moving())
    p.control(equal("V = m g r sin q2", -by_angle(m * g * r * s[1], 1), work))


@claim(
    "L-1",
    r"\tfrac{m r^2}4 \left(6 \sin q_2\, \ddot q_3 + 5 \sin 2q_2\, \dot q_1 \dot q_2 + 6 \cos q_2\, \dot q_2 \dot q_3"
    r" - \tfrac52 \cos 2q_2\, \ddot q_1 + \tfrac72 \ddot q_1\right) = 0",
    uses=["K-inertia", "L-velocity"],
)
def heading(p: Proof) -> None:
    """The equation of the heading: the constraint must not be put into the Lagrangian."""
    found = principle()[0]
    rest = 6 * s[1] * a[2] + 5 * TWICE[0] * d[0] * d[1] + (7 - 5 * TWICE[1]) * a[0] / 2

    def with_factor(x):
        return m * r**2 * (rest + x * c[1] * d[1] * d[2]) / 4

    p.printed(equal("with 6 cos q2 q2' q3', it is what the principle sets to 0 for δq1", with_factor(6), found))
    p.corrected(
        r"\tfrac{m r^2}4 \left(6 \sin q_2\, \ddot q_3 + 5 \sin 2q_2\, \dot q_1 \dot q_2"
        r" + 2 \cos q_2\, \dot q_2 \dot q_3 - \tfrac52 \cos 2q_2\, \ddot q_1 + \tfrac72 \ddot q_1\right) = 0",
        equal("with 2 cos q2 q2' q3', it is what the principle sets to 0 for δq1", with_factor(2), found),
    )
    p.counterexample(seen_moving())
    p.control(equal("with -2 cos q2 q2' q3'", with_factor(-2), found))


@claim(
    "L-2",
    r"\tfrac{m r}4 \left(4 g \sin q_2 - \tfrac52 r \sin 2q_2\, \dot q_1^2 - 6 r \cos q_2\, \dot q_1 \dot q_3"
    r" + 5 r \ddot q_2\right) = 0",
    uses=["K-inertia", "L-velocity", "L-potential"],
)
def lean(p: Proof) -> None:
    """The equation of the lean: the sign of gravity is that of the potential energy."""
    found = principle()[1]
    rest = -5 * r * TWICE[0] * d[0] ** 2 / 2 - 6 * r * c[1] * d[0] * d[2] + 5 * r * a[1]

    def with_factor(x):
        return m * r * (x * g * s[1] + rest) / 4

    p.printed(equal("with 4 g sin q2, it is what the principle sets to 0 for δq2", with_factor(4), found))
    p.corrected(
        r"\tfrac{m r}4 \left(-4 g \sin q_2 - \tfrac52 r \sin 2q_2\, \dot q_1^2 - 6 r \cos q_2\, \dot q_1 \dot q_3"
        r" + 5 r \ddot q_2\right) = 0",
        equal("with -4 g sin q2, it is what the principle sets to 0 for δq2", with_factor(-4), found),
    )
    p.counterexample(seen_moving())
    p.control(equal("with -2 g sin q2", with_factor(-2), found))


@claim(
    "L-3",
    r"\tfrac32 m r^2 (\sin q_2\, \ddot q_1 + \cos q_2\, \dot q_1 \dot q_2 + \ddot q_3) = 0",
    uses=["K-inertia", "L-velocity"],
)
def turn(p: Proof) -> None:
    """The equation of the turn: the constraint must not be put into the Lagrangian."""
    found = principle()[2]

    def with_factor(x):
        return 3 * m * r**2 * (s[1] * a[0] + x * c[1] * d[0] * d[1] + a[2]) / 2

    p.printed(equal("with cos q2 q1' q2', it is what the principle sets to 0 for δq3", with_factor(1), found))
    more = sp.Rational(5, 3)
    p.corrected(
        r"\tfrac32 m r^2 (\sin q_2\, \ddot q_1 + \tfrac53 \cos q_2\, \dot q_1 \dot q_2 + \ddot q_3) = 0",
        equal("with 5/3 cos q2 q1' q2', it is what the principle sets to 0 for δq3", with_factor(more), found),
    )
    p.counterexample(seen_moving())
    p.control(equal("with 2 cos q2 q1' q2'", with_factor(2), found))


@claim(
    "L-a1",
    r"\ddot q_1 = -2\left(2 \tan q_2\, \dot q_1 + \frac{3 \dot q_3}{\cos q_2}\right)\dot q_2",
    uses=["L-1", "L-3"],
)
def heading_acceleration(p: Proof) -> None:
    """The acceleration of the heading, from equations that are wrong."""
    moving(p)
    found = accelerations()[0]
    p.printed(
        equal("q1'' = -2 (2 tan q2 q1' + 3 q3'/cos q2) q2'", found, -2 * (2 * TAN * d[0] + 3 * d[2] / c[1]) * d[1])
    )
    p.corrected(
        r"\ddot q_1 = -\frac{2 \dot q_2 \dot q_3}{\cos q_2}",
        equal("q1'' = -2 q2' q3'/cos q2", found, -2 * d[1] * d[2] / c[1]),
    )
    p.counterexample(seen_moving())
    p.control(equal("q1'' = -q2' q3'/cos q2", found, -d[1] * d[2] / c[1]))


@claim(
    "L-a2",
    r"\ddot q_2 = -\frac{4 g \sin q_2}{5 r} + \tfrac12 \sin 2q_2\, \dot q_1^2 + \tfrac65 \cos q_2\, \dot q_1 \dot q_3",
    uses=["L-2"],
)
def lean_acceleration(p: Proof) -> None:
    """The acceleration of the lean, which gravity would set upright."""
    moving(p)
    found = accelerations()[1]
    pull, rest = 4 * g * s[1] / (5 * r), TWICE[0] * d[0] ** 2 / 2 + 6 * c[1] * d[0] * d[2] / 5
    p.printed(equal("q2'' = -4 g sin q2/(5 r) + sin 2q2 q1'²/2 + 6 cos q2 q1' q3'/5", found, rest - pull))
    p.corrected(
        r"\ddot q_2 = \frac{4 g \sin q_2}{5 r} + \tfrac12 \sin 2q_2\, \dot q_1^2"
        r" + \tfrac65 \cos q_2\, \dot q_1 \dot q_3",
        equal("the same with 4 g sin q2/(5 r)", found, rest + pull),
    )
    p.counterexample(seen_moving())
    p.control(equal("the same without gravity", found, rest))


@claim(
    "L-a3",
    r"\ddot q_3 = \left(-5 \cos q_2\, \dot q_1 + 6 \tan q_2\, \dot q_3 + \frac{4 \dot q_1}{\cos q_2}\right)\dot q_2",
    uses=["L-1", "L-3"],
)
def turn_acceleration(p: Proof) -> None:
    """The acceleration of the turn, from equations that are wrong."""
    moving(p)
    found = accelerations()[2]
    printed = (-5 * c[1] * d[0] + 6 * TAN * d[2] + 4 * d[0] / c[1]) * d[1]
    p.printed(equal("q3'' = (-5 cos q2 q1' + 6 tan q2 q3' + 4 q1'/cos q2) q2'", found, printed))
    p.corrected(
        r"\ddot q_3 = \left(-\tfrac53 \cos q_2\, \dot q_1 + 2 \tan q_2\, \dot q_3\right)\dot q_2",
        equal("q3'' = (-5/3 cos q2 q1' + 2 tan q2 q3') q2'", found, (-5 * c[1] * d[0] / 3 + 2 * TAN * d[2]) * d[1]),
    )
    p.counterexample(seen_moving())
    p.control(equal("q3'' = (-cos q2 q1' + 2 tan q2 q3') q2'", found, (-c[1] * d[0] + 2 * TAN * d[2]) * d[1]))
