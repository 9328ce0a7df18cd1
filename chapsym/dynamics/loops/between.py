"""The ball within a long step: Hermite's polynomials of degree 11 through its two ends, of order 12 in the step.

The attitude and the contact point have at each end the value and five derivatives that (2.3) gives.  K and γ stay in
space, so the attitude alone turns them: |K|², ⟨K,γ⟩ and |γ|² are kept to rounding.  Plain scalar Python, so that the
same functions run on floats and are compiled.

Between the ends, at the part s of the step, a polynomial is off by the twelfth derivative over 12! times
(s(1 - s))⁶ ≤ 2⁻¹².  The last two coefficients are the eleventh over 11! and the tenth over 10!: the twelfth is taken
to follow as they do, and eight times that is stated as what may be wrong.
"""

from math import sqrt

from chapsym.generated import angular_velocity, compose, rotate

from .long_step import ATTITUDE, SPOT

#: Values and derivatives at an end, and of what: the attitude (4), the contact point (2).
TERMS, PARTS = 6, 6
#: Rows of the series of vectors that a run of `series` needs: ω, K, γ, and the horizontals x and y seen from the body.
SPIN, SPACE, UP, EAST, NORTH, ALONG = 0, 3, 6, 9, 12, 15
SERIES = 16
#: (s(1 - s))⁶ at the middle.
MIDDLE = 2.0**-12
#: How many times as large as the one before a coefficient is taken to be.
MOST_GROWN = 8.0


def crossed(V, at, n, i):
    """The coefficient n of the cross product of the series of a vector, in the rows from `at` on, with ω; i: which."""
    j = i + 1 if i < 2 else 0
    k = j + 1 if j < 2 else 0
    found = 0.0
    for m in range(n + 1):
        found += V[at + j, m] * V[SPIN + k, n - m] - V[at + k, m] * V[SPIN + j, n - m]
    return found


def series(body, J1, J2, J3, contact, radius, whole, traced, V, end):
    """Taylor's coefficients of the attitude and the contact point at `body`, in parts of a step, into `end` (6, 6).

    body: `long_step.MOVING`.  whole: the step, in the unit of time of K and J.  V (SERIES, TERMS) is used.
    traced: whether the contact point is wanted.
    """
    g1, g2, g3 = body[3], body[4], body[5]
    a0, a1, a2, a3 = body[ATTITUDE], body[ATTITUDE + 1], body[ATTITUDE + 2], body[ATTITUDE + 3]
    for i in range(3):
        V[SPACE + i, 0], V[UP + i, 0] = body[i], body[3 + i]
    if traced:
        V[EAST, 0], V[EAST + 1, 0], V[EAST + 2, 0] = rotate(a0, -a1, -a2, -a3, 1.0, 0.0, 0.0)
        V[NORTH, 0], V[NORTH + 1, 0], V[NORTH + 2, 0] = rotate(a0, -a1, -a2, -a3, 0.0, 1.0, 0.0)
    end[0, 0], end[0, 1], end[0, 2], end[0, 3] = a0, a1, a2, a3
    end[0, 4], end[0, 5] = body[SPOT], body[SPOT + 1]
    for n in range(TERMS - 1):
        # Λω - D⟨γ,ω⟩γ = K, of which all but the terms of ω itself is known.
        x1, x2, x3, along = whole * V[SPACE, n], whole * V[SPACE + 1, n], whole * V[SPACE + 2, n], 0.0
        for m in range(1, n + 1):
            here = contact * V[ALONG, n - m]
            along += V[UP, m] * V[SPIN, n - m] + V[UP + 1, m] * V[SPIN + 1, n - m] + V[UP + 2, m] * V[SPIN + 2, n - m]
            x1, x2, x3 = x1 + here * V[UP, m], x2 + here * V[UP + 1, m], x3 + here * V[UP + 2, m]
        here = contact * along
        w1, w2, w3 = angular_velocity(x1 + here * g1, x2 + here * g2, x3 + here * g3, g1, g2, g3, J1, J2, J3, contact)
        V[SPIN, n], V[SPIN + 1, n], V[SPIN + 2, n] = w1, w2, w3
        V[ALONG, n] = along + (g1 * w1 + g2 * w2 + g3 * w3)
        part = 1.0 / (n + 1)
        for i in range(3):
            V[SPACE + i, n + 1], V[UP + i, n + 1] = part * crossed(V, SPACE, n, i), part * crossed(V, UP, n, i)
        if traced:
            for i in range(3):
                V[EAST + i, n + 1], V[NORTH + i, n + 1] = part * crossed(V, EAST, n, i), part * crossed(V, NORTH, n, i)
            x, y = 0.0, 0.0
            for m in range(n + 1):
                for i in range(3):
                    x += V[SPIN + i, m] * V[NORTH + i, n - m]
                    y -= V[SPIN + i, m] * V[EAST + i, n - m]
            end[n + 1, 4], end[n + 1, 5] = radius * part * x, radius * part * y
        b0, b1, b2, b3 = 0.0, 0.0, 0.0, 0.0
        for m in range(n + 1):
            c0, c1, c2, c3 = compose(
                end[m, 0], end[m, 1], end[m, 2], end[m, 3],
                0.0, V[SPIN, n - m], V[SPIN + 1, n - m], V[SPIN + 2, n - m],
            )  # fmt: skip
            b0, b1, b2, b3 = b0 + c0, b1 + c1, b2 + c2, b3 + c3
        half = 0.5 * part
        end[n + 1, 0], end[n + 1, 1], end[n + 1, 2], end[n + 1, 3] = half * b0, half * b1, half * b2, half * b3


def shortened(end, ratio):
    """The same coefficients for a step so many times as long."""
    factor = 1.0
    for n in range(1, TERMS):
        factor *= ratio
        for i in range(PARTS):
            end[n, i] *= factor


def joined(first, end, radius, traced, curve):
    """The polynomial through two ends, into `curve` (12, 6): powers of s, and s⁶ times powers of s - 1.

    Returns what may be wrong in between, in radians, and of the contact point in radii.
    """
    for i in range(PARTS if traced else 4):
        for n in range(TERMS):
            curve[n, i] = first[n, i]
        a0, a1, a2, a3, a4, a5 = first[0, i], first[1, i], first[2, i], first[3, i], first[4, i], first[5, i]
        # What the first polynomial lacks at s = 1, over s⁶ = (1 + (s - 1))⁶.
        d0 = end[0, i] - (((a5 + a4) + a3) + (a2 + a1) + a0)
        d1 = end[1, i] - ((5.0 * a5 + 4.0 * a4) + (3.0 * a3 + 2.0 * a2) + a1)
        d2 = end[2, i] - ((10.0 * a5 + 6.0 * a4) + (3.0 * a3 + a2))
        d3 = end[3, i] - ((10.0 * a5 + 4.0 * a4) + a3)
        d4 = end[4, i] - (5.0 * a5 + a4)
        d5 = end[5, i] - a5
        curve[6, i] = d0
        curve[7, i] = d1 - 6.0 * d0
        curve[8, i] = (d2 - 6.0 * d1) + 21.0 * d0
        curve[9, i] = (d3 - 6.0 * d2) + (21.0 * d1 - 56.0 * d0)
        curve[10, i] = (d4 - 6.0 * d3) + (21.0 * d2 - 56.0 * d1) + 126.0 * d0
        curve[11, i] = (d5 - 6.0 * d4) + (21.0 * d3 - 56.0 * d2) + (126.0 * d1 - 252.0 * d0)
    last, turned, way = 0.0, 0.0, 0.0
    for i in range(4):
        turned, last = turned + curve[11, i] * curve[11, i], last + curve[10, i] * curve[10, i]
    turned = 2.0 * MIDDLE * followed(turned, last)
    if traced:
        way = curve[11, 4] * curve[11, 4] + curve[11, 5] * curve[11, 5]
        way = MIDDLE / radius * followed(way, curve[10, 4] * curve[10, 4] + curve[10, 5] * curve[10, 5])
    return turned, way


def followed(last, before):
    """Eight times the coefficient that comes next, by the squares of the last two."""
    return 8.0 * sqrt(last) * min(sqrt(last / before), MOST_GROWN) if before > 0.0 else 8.0 * sqrt(last)


def at_part(curve, i, s):
    """One of the numbers at the part s of the step."""
    r, square = s - 1.0, s * s
    low = ((curve[5, i] * s + curve[4, i]) * s + curve[3, i]) * s + curve[2, i]
    high = ((curve[11, i] * r + curve[10, i]) * r + curve[9, i]) * r + curve[8, i]
    low, high = (low * s + curve[1, i]) * s + curve[0, i], (high * r + curve[7, i]) * r + curve[6, i]
    return low + square * square * square * high


def ball_at(curve, s, body, traced, found):
    """The ball at the part s of the step that began at `body`, into `found`; both `long_step.MOVING`."""
    q0, q1, q2, q3 = at_part(curve, 0, s), at_part(curve, 1, s), at_part(curve, 2, s), at_part(curve, 3, s)
    scale = 1.0 / sqrt((q0 * q0 + q1 * q1) + (q2 * q2 + q3 * q3))
    q0, q1, q2, q3 = scale * q0, scale * q1, scale * q2, scale * q3
    a0, a1, a2, a3 = body[ATTITUDE], body[ATTITUDE + 1], body[ATTITUDE + 2], body[ATTITUDE + 3]
    p0, p1, p2, p3 = compose(q0, -q1, -q2, -q3, a0, a1, a2, a3)  # from the axes at the beginning to those of now
    found[0], found[1], found[2] = rotate(p0, p1, p2, p3, body[0], body[1], body[2])
    found[3], found[4], found[5] = rotate(p0, p1, p2, p3, body[3], body[4], body[5])
    found[ATTITUDE], found[ATTITUDE + 1], found[ATTITUDE + 2], found[ATTITUDE + 3] = q0, q1, q2, q3
    if traced:
        found[SPOT], found[SPOT + 1] = at_part(curve, 4, s), at_part(curve, 5, s)
