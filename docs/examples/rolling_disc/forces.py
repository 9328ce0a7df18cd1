"""A rolling disc, with Kane's method and constraint forces.

rollingdisc_example_kane_constraints.rst, commit 0f519ce33e4b: f1, f2, f3 act on the disc where it touches
the plane, along L.x, along Y.z × L.x and along Y.z.  The page writes u1', u2' for the rates that its method finds.
"""

import sympy as sp

from chapsym.prove import Proof, claim

from .disc import HEADING, LEAN, UP, by_spin, by_time, c, equal, g, in_motion, m, moving, r, rolling, s, spin, u


def force():
    """What the plane does to the disc, m v' = f - m g N.z, along the axes of the page."""
    moved = (LEAN * rolling()).applyfunc(by_time)
    return (HEADING.T * (m * moved + m * g * UP)).applyfunc(lambda x: by_spin(in_motion(x)))


def rates():
    """u1', u2', u3'."""
    return [by_spin(in_motion(by_time(x))) for x in spin()]


@claim("F-f1", r"f_1 - m r (u_1 u_3 + \dot u_2) = 0", uses=["K-velocity", "K-u2"])
def along(p: Proof) -> None:
    """The force along the path of the disc."""
    moving(p)
    push = m * r * (u[0] * u[2] + rates()[1])
    p.printed(equal("f1 = m r (u1 u3 + u2')", force()[0], push))
    p.lemma(equal("f1 = m r u1 u3/3, by K-u2", force()[0], m * r * u[0] * u[2] / 3))
    p.control(equal("f1 = -m r (u1 u3 + u2')", force()[0], -push))


@claim(
    "F-f2",
    r"-m r u_1^2 \sin q_2 - \frac{m r u_2 u_3}{\cos q_2} + m r \cos q_2\, \dot u_1 + f_2 = 0",
    uses=["K-velocity", "K-u1"],
)
def across(p: Proof) -> None:
    """The force along the plane, across the path."""
    moving(p)
    lean = m * r * u[0] ** 2 * s[1]
    rest = m * r * u[1] * u[2] / c[1] - m * r * c[1] * rates()[0]
    p.printed(equal("f2 = m r u1² sin q2 + m r u2 u3/cos q2 - m r cos q2 u1'", force()[1], lean + rest))
    p.control(equal("the same with -m r u1² sin q2", force()[1], rest - lean))


@claim("F-f3", r"-g m + m r (u_1^2 \cos q_2 + \sin q_2\, \dot u_1) + f_3 = 0", uses=["K-velocity", "K-u1"])
def upwards(p: Proof) -> None:
    """The force of the plane upwards."""
    moving(p)
    fall = m * r * (u[0] ** 2 * c[1] + s[1] * rates()[0])
    p.printed(equal("f3 = m g - m r (u1² cos q2 + sin q2 u1')", force()[2], m * g - fall))
    flat = dict.fromkeys((u[0], u[1], u[2], s[1]), sp.S.Zero) | {c[1]: sp.S.One}
    p.lemma(equal("f3 = m g for a disc that stands upright", force()[2].xreplace(flat), m * g))
    p.control(equal("f3 = m g, always", force()[2], m * g))
