"""What the disc runs on: its accelerations, the rates of its angular velocity, and the force of the plane."""

from chapsym.codegen import Kernel, left

from .disc import accelerations, by_spin, c, d, g, m, r, rolling, s, u
from .forces import force
from .kane import spin_rates

SINES, COSINES, RATES, SPIN = ("sines", s), ("cosines", c), ("rates", d), ("spin", u)
LEAN = ("lean", (s[1], c[1]))
RADIUS, MASS, GRAVITY = ("radius", (r,)), ("mass", (m,)), ("gravity", (g,))

KERNELS = [
    Kernel(
        "accelerations",
        "The second derivatives of heading, lean and turn, in the rates of the angles.",
        (
            left("I-a1", "q1'' = -2 q2' q3'/cos q2"),
            left("I-a2", "q2'' = 4 g sin q2/(5 r) + sin 2q2 q1'²/2 + 6 cos q2 q1' q3'/5"),
            left("I-a3", "q3'' = -(10 cos q2 q1' - 12 tan q2 q3') q2'/6"),
        ),
        (LEAN, RATES, RADIUS, GRAVITY),
        ("a1", "a2", "a3"),
        accelerations,
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
    ),
    Kernel(
        "force",
        "What the plane does to the disc: along its path, across it, and upwards.",
        (
            left("F-f1", "f1 = m r (u1 u3 + u2')"),
            left("F-f2", "f2 = m r u1² sin q2 + m r u2 u3/cos q2 - m r cos q2 u1'"),
            left("F-f3", "f3 = m g - m r (u1² cos q2 + sin q2 u1')"),
        ),
        (LEAN, SPIN, RADIUS, MASS, GRAVITY),
        ("f1", "f2", "f3"),
        force,
    ),
    Kernel(
        "velocity",
        "The velocity of the centre along L.x, L.y, L.z, for which the disc does not slip.",
        (left("K-velocity", "v = r u2 L.x - r u1 L.y"),),
        (SPIN, RADIUS),
        ("v1", "v2", "v3"),
        lambda: rolling().applyfunc(by_spin),
    ),
]
