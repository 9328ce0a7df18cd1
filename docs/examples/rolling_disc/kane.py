"""A rolling disc, with Kane's method.

rollingdisc_example_kane.rst, commit 0f519ce33e4b: the motion, in the angular velocity u1, u2, u3 along
L.x, L.y, L.z.
"""

from chapsym.prove import Proof, claim

from .disc import by_spin, by_time, c, equal, g, in_motion, inertia, m, moving, r, rolling, s, spin, u


def spin_rates():
    """u1', u2', u3' in the motion of the disc, in terms of u."""
    return [by_spin(in_motion(by_time(x))) for x in spin()]


@claim("K-inertia", r"I = \mathrm{diag}\left(\frac{m r^2}4, \frac{m r^2}2, \frac{m r^2}4\right)")
def disc_inertia(p: Proof) -> None:
    """The inertia of a thin uniform disc, along the axes of the lean frame."""
    p.say("The mean of m (|x|² - x xᵀ) over the disc, by integration.")
    p.printed(equal("I = diag(m r²/4, m r²/2, m r²/4)", inertia().diagonal(), [m * r**2 / x for x in (4, 2, 4)]))
    p.control(equal("as of a sphere, diag(1, 1, 1) 2 m r²/5", inertia().diagonal(), [2 * m * r**2 / 5] * 3))


@claim("K-velocity", r"v = r u_2\, L_x - r u_1\, L_y")
def centre_velocity(p: Proof) -> None:
    """The velocity of the centre, for which the disc does not slip."""
    p.say("The point that touches the plane is at rest: v + ω × (-r L.z) = 0.")
    derived = rolling().applyfunc(by_spin)
    p.printed(equal("v = r u2 L.x - r u1 L.y", derived, [r * u[1], -r * u[0], 0]))
    p.control(equal("v = r u2 L.x + r u1 L.y", derived, [r * u[1], r * u[0], 0]))


@claim(
    "K-u1", r"\dot u_1 = \frac{4 g \sin q_2 + 6 r u_2 u_3 - r u_3^2 \tan q_2}{5 r}", uses=["K-inertia", "K-velocity"]
)
def lean_rate(p: Proof) -> None:
    """How the rate of the lean changes."""
    moving(p)
    derived, rest = spin_rates()[0], 6 * r * u[1] * u[2] - r * u[2] ** 2 * s[1] / c[1]
    p.printed(equal("u1' = (4 g sin q2 + 6 r u2 u3 - r u3² tan q2)/(5 r)", derived, (4 * g * s[1] + rest) / (5 * r)))
    p.control(equal("the same with -4 g sin q2", derived, (-4 * g * s[1] + rest) / (5 * r)))


@claim("K-u2", r"\dot u_2 = -\tfrac23 u_1 u_3", uses=["K-inertia", "K-velocity"])
def roll_rate(p: Proof) -> None:
    """How the rate about the axis of the disc changes."""
    moving(p)
    derived = spin_rates()[1]
    p.printed(equal("u2' = -2 u1 u3/3", derived, -2 * u[0] * u[2] / 3))
    p.control(equal("u2' = -u1 u3/3", derived, -u[0] * u[2] / 3), equal("u2' = 0", derived, 0))


@claim("K-u3", r"\dot u_3 = (u_3 \tan q_2 - 2 u_2) u_1", uses=["K-inertia", "K-velocity"])
def turn_rate(p: Proof) -> None:
    """How the rate along L.z changes."""
    moving(p)
    derived = spin_rates()[2]
    p.printed(equal("u3' = (u3 tan q2 - 2 u2) u1", derived, (u[2] * s[1] / c[1] - 2 * u[1]) * u[0]))
    p.control(equal("u3' = (u3 tan q2 - u2) u1", derived, (u[2] * s[1] / c[1] - u[1]) * u[0]))
