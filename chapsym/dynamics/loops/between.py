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

from .lanes import ATTITUDE, SPOT
from .vectors import (
    conjugate,
    dot,
    four,
    plus,
    plus_four,
    put,
    put_four,
    put_in,
    scaled,
    scaled_four,
    square_of_four,
    three,
    three_in,
)

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


def series(body, J, contact, radius, whole, traced, V, end):
    """Taylor's coefficients of the attitude and the contact point at `body`, in parts of a step, into `end` (6, 6).

    body: `lanes.MOVING`.  whole: the step, in the unit of time of K and J.  V (SERIES, TERMS) is used.
    traced: whether the contact point is wanted.
    """
    g, a = three(body, 3), four(body, ATTITUDE)
    put_in(V, SPACE, 0, three(body, 0))
    put_in(V, UP, 0, g)
    if traced:
        put_in(V, EAST, 0, rotate(*conjugate(a), 1.0, 0.0, 0.0))
        put_in(V, NORTH, 0, rotate(*conjugate(a), 0.0, 1.0, 0.0))
    put_four(end[0], 0, a)
    end[0, 4], end[0, 5] = body[SPOT], body[SPOT + 1]
    for n in range(TERMS - 1):
        # Λω - D⟨γ,ω⟩γ = K, of which all but the terms of ω itself is known.
        x, along = scaled(whole, three_in(V, SPACE, n)), 0.0
        for m in range(1, n + 1):
            along += dot(three_in(V, UP, m), three_in(V, SPIN, n - m))
            x = plus(x, scaled(contact * V[ALONG, n - m], three_in(V, UP, m)))
        w = angular_velocity(*plus(x, scaled(contact * along, g)), *g, *J, contact)
        put_in(V, SPIN, n, w)
        V[ALONG, n] = along + dot(g, w)
        part = 1.0 / (n + 1)
        for i in range(3):
            V[SPACE + i, n + 1], V[UP + i, n + 1] = part * crossed(V, SPACE, n, i), part * crossed(V, UP, n, i)
        if traced:
            for i in range(3):
                V[EAST + i, n + 1], V[NORTH + i, n + 1] = part * crossed(V, EAST, n, i), part * crossed(V, NORTH, n, i)
            x1, x2 = 0.0, 0.0
            for m in range(n + 1):
                for i in range(3):
                    x1 += V[SPIN + i, m] * V[NORTH + i, n - m]
                    x2 -= V[SPIN + i, m] * V[EAST + i, n - m]
            end[n + 1, 4], end[n + 1, 5] = radius * part * x1, radius * part * x2
        b = 0.0, 0.0, 0.0, 0.0
        for m in range(n + 1):
            b = plus_four(b, compose(*four(end[m], 0), 0.0, *three_in(V, SPIN, n - m)))
        put_four(end[n + 1], 0, scaled_four(0.5 * part, b))


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
    r, power = s - 1.0, s * s
    low = ((curve[5, i] * s + curve[4, i]) * s + curve[3, i]) * s + curve[2, i]
    high = ((curve[11, i] * r + curve[10, i]) * r + curve[9, i]) * r + curve[8, i]
    low, high = (low * s + curve[1, i]) * s + curve[0, i], (high * r + curve[7, i]) * r + curve[6, i]
    return low + power * power * power * high


def ball_at(curve, s, body, traced, found):
    """The ball at the part s of the step that began at `body`, into `found`; both `lanes.MOVING`."""
    q = at_part(curve, 0, s), at_part(curve, 1, s), at_part(curve, 2, s), at_part(curve, 3, s)
    q = scaled_four(1.0 / sqrt(square_of_four(q)), q)
    p = compose(*conjugate(q), *four(body, ATTITUDE))  # from the axes at the beginning to those of now
    put(found, 0, rotate(*p, *three(body, 0)))
    put(found, 3, rotate(*p, *three(body, 3)))
    put_four(found, ATTITUDE, q)
    if traced:
        found[SPOT], found[SPOT + 1] = at_part(curve, 4, s), at_part(curve, 5, s)
