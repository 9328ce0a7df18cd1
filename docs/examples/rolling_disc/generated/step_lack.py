"""Written by `chapsym codegen`: do not edit; change the derivation and generate again.

Proved by: M-step.  Operations: 34.  SymPy 1.14.0.
Expression: sha256 0bca49e1720c686f45e9e82036f4be14a7b306c1c7fbec2dde6d7f5ba1976384.
Certificate of M-step: sha256 33282fe507c2a3fb1f7d4290ce4703d86a9a27b23432c9c24e71ffc67c2c8165.
"""

from chapsym.numbers.functions import cos, sin


def step_lack(q2, u1, u2, u3, x1, x2, x3, x4, r, g, h):
    """What vanishes where the middle is that of a step of the midpoint rule.

    middle: q2, u1, u2, u3
    start: x1, x2, x3, x4
    radius: r
    gravity: g
    step: h
    Returns f1, f2, f3, f4.
    """
    # letters
    s2 = sin(q2, u1, u2, u3, x1, x2, x3, x4, r, g, h)
    c2 = cos(q2, u1, u2, u3, x1, x2, x3, x4, r, g, h)
    # intermediate terms
    t0 = h * u1
    t1 = t0 / 2
    t2 = 1 / c2
    # outputs
    o_f1 = q2 - t1 - x1
    o_f2 = u1 - x2 - h * (4 * g * s2 + 6 * r * u2 * u3 - r * s2 * t2 * u3 * u3) / (10 * r)
    o_f3 = u2 + t0 * u3 / 3 - x3
    o_f4 = u3 - x4 - t1 * (s2 * t2 * u3 - 2 * u2)
    return o_f1, o_f2, o_f3, o_f4
