"""How the flow carries errors: what the long steps of a ball leave, and what their roundings do, side by side.

An error of a step turns the body by a small φ, in its axes, and leaves K and γ where they are in space.  With
Bω = Λω - D⟨γ,ω⟩γ = K and the rate δω that follows from φ, B δω = Λω × φ + D⟨ω × γ, φ⟩γ, it goes on as φ' = δω + φ × ω,
and the contact point is off by the integral of R(φ' × γ) radii.  From both ends of a step of length h

    (1 - (h/2)A + (h²/12)P) φ₁ = (1 + (h/2)A₀ + (h²/12)P₀) φ₀    with φ' = Aφ, φ'' = Pφ,

up to the fifth power of h, and for steady A without growth where there is none (Padé).

Two things are carried on by φ₁ = Φφ₀.  What the steps leave is of a size that the last columns tell, but of an unknown
direction, which may change little from step to step: three errors of this size go on as Φφ + e, one along each of the
changes that the last three columns have made, so that what the steps do and undo is seen as such.  Roundings have no
direction: the matrix S of their mean squares goes on as ΦSΦᵀ + r².
"""

from math import sqrt

from chapsym.generated import angular_velocity, rotate

from .lanes import BALL, CHANGE, DONE, LANES, MOVED, RADIUS, SUMS, Q, Y
from .long_step import ATTITUDE, CHANGES, SLIP, SPOT, TWIST, twist
from .text import lanes

#: Rows of an end.  Of the unit error φ of a lane: δω, φ', φ'', how fast the contact point leaves, and its rate.  Of the
#: ball, in its first lane: ω, along which the flow goes, and the gradient of the energy.
SPUN, RATE, SECOND, WAY, BEND, FLOW, GRADIENT = 0, 3, 6, 9, 11, 13, 16
END = 19
#: Rows beyond the two ends: the unit error; K, γ, the attitude and J, in all lanes; and what becomes of a unit error
#: by the end of the step, and of the contact point.
UNIT, INPUT, SHAPE, FLOWN, CARRIED = 2 * END, 2 * END + 3, 2 * END + 13, 2 * END + 16, 2 * END + 19
#: φ and the contact point as the steps leave them, three errors in three lanes.  Rows of the ball: S of φ (6), of the
#: contact point with φ (6), of the contact point (2).  What a step that stays brings: its length in the unit of time of
#: S, which part its error is of each vector of `TWIST`, and the square of its rounding.
LEFT, ROLLED, INNER, MIXED, OUTER = CARRIED + 2, CARRIED + 5, CARRIED + 7, CARRIED + 13, CARRIED + 19
WHOLE, PART, ROUNDED = CARRIED + 21, CARRIED + 22, CARRIED + 25
#: And what comes of it: the lengths of φ, of δω and of the way of the contact point, and the roots of the mean squares
#: of the same that are rounding.
FOUND = CARRIED + 26
#: The inverse of the matrix of the last end, by rows, and the length of the step over 2, and its square over 12.
INVERSE, HALF, TWELFTH = FOUND + 6, FOUND + 15, FOUND + 16
#: The changes of the quaternion that the last three columns have made, and of the way of the centre by the last.
CHANGED = FOUND + 17
ROWS = CHANGED + 4 * CHANGES + 3
#: A rounding.
UNIT_ROUNDING = 2.0**-53
#: Below this part of |Λω| |ω| the gradient of the energy is too much of a rounding to be used.
STEADY = 1e-7


def begun(E, B, b, J1, J2, J3, start):
    """Puts a ball without errors, but for the rounding of its start, into its lanes."""
    for lane in range(LANES):
        i = lane * B + b
        for c in range(3):
            E[UNIT + c, i] = 1.0 if c == lane else 0.0
        E[SHAPE, i], E[SHAPE + 1, i], E[SHAPE + 2, i] = J1, J2, J3
        for row in range(LEFT, ROWS):
            E[row, i] = 0.0
    E[INNER, b], E[INNER + 3, b], E[INNER + 5, b] = start * start, start * start, start * start


def tangent(S, E, B, at, traced):
    """The rates of the unit errors of every ball, in the unit of time of S, into the rows of E from `at` on."""
    for row in range(10):
        for b in lanes(B):
            one = S[MOVED + row, b]
            E[INPUT + row, b], E[INPUT + row, B + b] = one, one
            E[INPUT + row, 2 * B + b], E[INPUT + row, 3 * B + b] = one, one
    for i in lanes(LANES * B):
        g1, g2, g3 = E[INPUT + 3, i], E[INPUT + 4, i], E[INPUT + 5, i]
        J1, J2, J3, contact = E[SHAPE, i], E[SHAPE + 1, i], E[SHAPE + 2, i], S[BALL + 3, i]
        I1, I2, I3 = S[BALL, i] + contact, S[BALL + 1, i] + contact, S[BALL + 2, i] + contact
        w1, w2, w3 = angular_velocity(
            E[INPUT, i], E[INPUT + 1, i], E[INPUT + 2, i], g1, g2, g3, J1, J2, J3, contact
        )  # fmt: skip
        m1, m2, m3 = I1 * w1, I2 * w2, I3 * w3
        s1, s2, s3 = w2 * m3 - w3 * m2, w3 * m1 - w1 * m3, w1 * m2 - w2 * m1
        a1, a2, a3 = angular_velocity(-s1, -s2, -s3, g1, g2, g3, J1, J2, J3, contact)
        n1, n2, n3 = I1 * a1, I2 * a2, I3 * a3
        E[at + FLOW, i], E[at + FLOW + 1, i], E[at + FLOW + 2, i] = w1, w2, w3
        least = STEADY * STEADY * ((m1 * m1 + m2 * m2 + m3 * m3) * (w1 * w1 + w2 * w2 + w3 * w3))
        one = 1.0 if s1 * s1 + s2 * s2 + s3 * s3 > least else 0.0
        E[at + GRADIENT, i], E[at + GRADIENT + 1, i], E[at + GRADIENT + 2, i] = one * s1, one * s2, one * s3
        v1, v2, v3 = w2 * g3 - w3 * g2, w3 * g1 - w1 * g3, w1 * g2 - w2 * g1  # ω × γ = -γ'
        u1 = (a2 * g3 - a3 * g2) - (w2 * v3 - w3 * v2)
        u2 = (a3 * g1 - a1 * g3) - (w3 * v1 - w1 * v3)
        u3 = (a1 * g2 - a2 * g1) - (w1 * v2 - w2 * v1)
        e1, e2, e3 = E[UNIT, i], E[UNIT + 1, i], E[UNIT + 2, i]
        v, u = contact * (v1 * e1 + v2 * e2 + v3 * e3), contact * (u1 * e1 + u2 * e2 + u3 * e3)
        s1, s2, s3 = angular_velocity(
            (m2 * e3 - m3 * e2) + v * g1, (m3 * e1 - m1 * e3) + v * g2, (m1 * e2 - m2 * e1) + v * g3,
            g1, g2, g3, J1, J2, J3, contact,
        )  # fmt: skip
        f1, f2, f3 = s1 + (e2 * w3 - e3 * w2), s2 + (e3 * w1 - e1 * w3), s3 + (e1 * w2 - e2 * w1)
        # B δω' = Λω' × φ + Λω × φ' + D(⟨ω × γ,φ'⟩ + ⟨(ω × γ)',φ⟩)γ + D⟨ω × γ,φ⟩γ' + D⟨γ,δω⟩γ' + D⟨γ',δω⟩γ.
        up = u + contact * ((v1 * f1 + v2 * f2 + v3 * f3) - (v1 * s1 + v2 * s2 + v3 * s3))
        over = v + contact * (g1 * s1 + g2 * s2 + g3 * s3)
        t1, t2, t3 = angular_velocity(
            ((n2 * e3 - n3 * e2) + (m2 * f3 - m3 * f2)) + (up * g1 - over * v1),
            ((n3 * e1 - n1 * e3) + (m3 * f1 - m1 * f3)) + (up * g2 - over * v2),
            ((n1 * e2 - n2 * e1) + (m1 * f2 - m2 * f1)) + (up * g3 - over * v3),
            g1, g2, g3, J1, J2, J3, contact,
        )  # fmt: skip
        p1 = t1 + (f2 * w3 - f3 * w2) + (e2 * a3 - e3 * a2)
        p2 = t2 + (f3 * w1 - f1 * w3) + (e3 * a1 - e1 * a3)
        p3 = t3 + (f1 * w2 - f2 * w1) + (e1 * a2 - e2 * a1)
        E[at + SPUN, i], E[at + SPUN + 1, i], E[at + SPUN + 2, i] = s1, s2, s3
        E[at + RATE, i], E[at + RATE + 1, i], E[at + RATE + 2, i] = f1, f2, f3
        E[at + SECOND, i], E[at + SECOND + 1, i], E[at + SECOND + 2, i] = p1, p2, p3
        if traced:
            z1, z2, z3 = f2 * g3 - f3 * g2, f3 * g1 - f1 * g3, f1 * g2 - f2 * g1
            b1 = (w2 * z3 - w3 * z2) + (p2 * g3 - p3 * g2) - (f2 * v3 - f3 * v2)
            b2 = (w3 * z1 - w1 * z3) + (p3 * g1 - p1 * g3) - (f3 * v1 - f1 * v3)
            b3 = (w1 * z2 - w2 * z1) + (p1 * g2 - p2 * g1) - (f1 * v2 - f2 * v1)
            q0, q1, q2, q3 = (
                E[INPUT + ATTITUDE, i], E[INPUT + ATTITUDE + 1, i],
                E[INPUT + ATTITUDE + 2, i], E[INPUT + ATTITUDE + 3, i],
            )  # fmt: skip
            E[at + WAY, i], E[at + WAY + 1, i], _ = rotate(q0, q1, q2, q3, z1, z2, z3)
            E[at + BEND, i], E[at + BEND + 1, i], _ = rotate(q0, q1, q2, q3, b1, b2, b3)


def flown(E, B, traced):
    """The matrix Φ of the step `WHOLE` of every ball, column by column in its lanes, and of the contact point."""
    for b in lanes(B):
        half, twelfth = 0.5 * E[WHOLE, b], E[WHOLE, b] * E[WHOLE, b] * (1.0 / 12.0)
        i, j, k = b, B + b, 2 * B + b
        a1 = 1.0 - half * E[END + RATE, i] + twelfth * E[END + SECOND, i]
        a2 = twelfth * E[END + SECOND + 1, i] - half * E[END + RATE + 1, i]
        a3 = twelfth * E[END + SECOND + 2, i] - half * E[END + RATE + 2, i]
        b1 = twelfth * E[END + SECOND, j] - half * E[END + RATE, j]
        b2 = 1.0 - half * E[END + RATE + 1, j] + twelfth * E[END + SECOND + 1, j]
        b3 = twelfth * E[END + SECOND + 2, j] - half * E[END + RATE + 2, j]
        c1 = twelfth * E[END + SECOND, k] - half * E[END + RATE, k]
        c2 = twelfth * E[END + SECOND + 1, k] - half * E[END + RATE + 1, k]
        c3 = 1.0 - half * E[END + RATE + 2, k] + twelfth * E[END + SECOND + 2, k]
        # The rows of the inverse are the cross products of the columns, over the determinant.
        r1, r2, r3 = b2 * c3 - b3 * c2, b3 * c1 - b1 * c3, b1 * c2 - b2 * c1
        over = 1.0 / (a1 * r1 + a2 * r2 + a3 * r3)
        E[INVERSE, b], E[INVERSE + 1, b], E[INVERSE + 2, b] = over * r1, over * r2, over * r3
        E[INVERSE + 3, b], E[INVERSE + 4, b] = over * (c2 * a3 - c3 * a2), over * (c3 * a1 - c1 * a3)
        E[INVERSE + 5, b], E[INVERSE + 6, b] = over * (c1 * a2 - c2 * a1), over * (a2 * b3 - a3 * b2)
        E[INVERSE + 7, b], E[INVERSE + 8, b] = over * (a3 * b1 - a1 * b3), over * (a1 * b2 - a2 * b1)
        E[HALF, b], E[TWELFTH, b] = half, twelfth
    for column in range(3):
        for b in lanes(B):
            i, half, twelfth = column * B + b, E[HALF, b], E[TWELFTH, b]
            x = E[UNIT, i] + half * E[RATE, i] + twelfth * E[SECOND, i]
            y = E[UNIT + 1, i] + half * E[RATE + 1, i] + twelfth * E[SECOND + 1, i]
            z = E[UNIT + 2, i] + half * E[RATE + 2, i] + twelfth * E[SECOND + 2, i]
            E[FLOWN, i] = E[INVERSE, b] * x + E[INVERSE + 1, b] * y + E[INVERSE + 2, b] * z
            E[FLOWN + 1, i] = E[INVERSE + 3, b] * x + E[INVERSE + 4, b] * y + E[INVERSE + 5, b] * z
            E[FLOWN + 2, i] = E[INVERSE + 6, b] * x + E[INVERSE + 7, b] * y + E[INVERSE + 8, b] * z
    kept(E, B)
    if traced:  # Simpson's rule with the rates of the ends
        for column in range(3):
            for b in lanes(B):
                i, half, twelfth = column * B + b, E[HALF, b], E[TWELFTH, b]
                x = half * E[WAY, i] + twelfth * E[BEND, i]
                y = half * E[WAY + 1, i] + twelfth * E[BEND + 1, i]
                for c in range(3):
                    lane, off = c * B + b, E[FLOWN + c, i]
                    x += (half * E[END + WAY, lane] - twelfth * E[END + BEND, lane]) * off
                    y += (half * E[END + WAY + 1, lane] - twelfth * E[END + BEND + 1, lane]) * off
                E[CARRIED, i], E[CARRIED + 1, i] = x, y


def kept(E, B):
    """Corrects Φ so that it takes ω to ω, and keeps what an error does to the energy.

    The flow takes a shift in time along, φ = ω, and the energy is an integral: ⟨n, φ⟩ with n = ω × Λω.  An error of Φ
    there would grow with each passage of an unstable rotation, where all else only grows with their number.
    """
    for b in lanes(B):
        i, j, k = b, B + b, 2 * B + b
        w1, w2, w3 = E[FLOW, b], E[FLOW + 1, b], E[FLOW + 2, b]
        square = w1 * w1 + w2 * w2 + w3 * w3
        part = 1.0 / square if square > 0.0 else 0.0
        x = part * (E[END + FLOW, b] - (E[FLOWN, i] * w1 + E[FLOWN, j] * w2 + E[FLOWN, k] * w3))
        y = part * (E[END + FLOW + 1, b] - (E[FLOWN + 1, i] * w1 + E[FLOWN + 1, j] * w2 + E[FLOWN + 1, k] * w3))
        z = part * (E[END + FLOW + 2, b] - (E[FLOWN + 2, i] * w1 + E[FLOWN + 2, j] * w2 + E[FLOWN + 2, k] * w3))
        a1, a2, a3 = E[FLOWN, i] + x * w1, E[FLOWN + 1, i] + y * w1, E[FLOWN + 2, i] + z * w1
        b1, b2, b3 = E[FLOWN, j] + x * w2, E[FLOWN + 1, j] + y * w2, E[FLOWN + 2, j] + z * w2
        c1, c2, c3 = E[FLOWN, k] + x * w3, E[FLOWN + 1, k] + y * w3, E[FLOWN + 2, k] + z * w3
        n1, n2, n3 = E[END + GRADIENT, b], E[END + GRADIENT + 1, b], E[END + GRADIENT + 2, b]
        x, y, z = E[GRADIENT, b], E[GRADIENT + 1, b], E[GRADIENT + 2, b]
        square = n1 * n1 + n2 * n2 + n3 * n3
        part = 1.0 / square if square > 0.0 and x * x + y * y + z * z > 0.0 else 0.0
        x = part * (x - (n1 * a1 + n2 * a2 + n3 * a3))
        y = part * (y - (n1 * b1 + n2 * b2 + n3 * b3))
        z = part * (z - (n1 * c1 + n2 * c2 + n3 * c3))
        E[FLOWN, i], E[FLOWN + 1, i], E[FLOWN + 2, i] = a1 + x * n1, a2 + x * n2, a3 + x * n3
        E[FLOWN, j], E[FLOWN + 1, j], E[FLOWN + 2, j] = b1 + y * n1, b2 + y * n2, b3 + y * n3
        E[FLOWN, k], E[FLOWN + 1, k], E[FLOWN + 2, k] = c1 + z * n1, c2 + z * n2, c3 + z * n3


def changes(S, E, B):
    """What the last columns have changed in the step of every ball, into `TWIST` and `SLIP`.

    Not of those that get lost: the safe way says it of these.
    """
    for i in lanes(LANES * B):
        a0, a1, a2, a3 = S[DONE, i], S[DONE + 1, i], S[DONE + 2, i], S[DONE + 3, i]
        b0, b1, b2, b3 = S[Q, i], S[Q + 1, i], S[Q + 2, i], S[Q + 3, i]
        one = 1.0 / sqrt((a0 * a0 + a1 * a1) + (a2 * a2 + a3 * a3))
        two = 1.0 / sqrt((b0 * b0 + b1 * b1) + (b2 * b2 + b3 * b3))
        for c in range(CHANGES):
            w, v = S[CHANGE + 2 * c, i] * one, S[CHANGE + 2 * c + 1, i] * two
            E[CHANGED + 4 * c, i], E[CHANGED + 4 * c + 1, i] = w * a0 + v * b0, w * a1 + v * b1
            E[CHANGED + 4 * c + 2, i], E[CHANGED + 4 * c + 3, i] = w * a2 + v * b2, w * a3 + v * b3
        for c in range(3):
            at = CHANGED + 4 * CHANGES + c
            E[at, i] = S[CHANGE, i] * S[DONE + 4 + c, i] + S[CHANGE + 1, i] * S[Y + c, i]
    for row in range(CHANGED, ROWS):
        for b in lanes(B):
            E[row, b] = (E[row, b] + E[row, B + b]) + (E[row, 2 * B + b] + E[row, 3 * B + b])
    for c in range(CHANGES):
        for b in lanes(B):
            at, row = MOVED + TWIST + 3 * c, CHANGED + 4 * c
            S[at, b], S[at + 1, b], S[at + 2, b] = twist(
                S[SUMS, b], S[SUMS + 1, b], S[SUMS + 2, b], S[SUMS + 3, b],
                E[row, b], E[row + 1, b], E[row + 2, b], E[row + 3, b],
            )  # fmt: skip
    for b in lanes(B):
        at, row = INPUT + ATTITUDE, CHANGED + 4 * CHANGES
        S[MOVED + SLIP, b], S[MOVED + SLIP + 1, b], _ = rotate(
            E[at, b], E[at + 1, b], E[at + 2, b], E[at + 3, b], E[row, b], E[row + 1, b], E[row + 2, b]
        )


def leave(S, E, B, traced):
    """Carries what the steps leave, and finds the root of the sum of the squares of the three."""
    for b in lanes(B):
        E[FOUND, b], E[FOUND + 1, b], E[FOUND + 2, b] = 0.0, 0.0, 0.0
    for c in range(CHANGES):
        for b in lanes(B):
            i, j, k, lane, part = b, B + b, 2 * B + b, c * B + b, E[PART + c, b]
            v1, v2, v3 = E[LEFT, lane], E[LEFT + 1, lane], E[LEFT + 2, lane]
            at = MOVED + TWIST + 3 * c
            l1 = E[FLOWN, i] * v1 + E[FLOWN, j] * v2 + E[FLOWN, k] * v3 + part * S[at, b]
            l2 = E[FLOWN + 1, i] * v1 + E[FLOWN + 1, j] * v2 + E[FLOWN + 1, k] * v3 + part * S[at + 1, b]
            l3 = E[FLOWN + 2, i] * v1 + E[FLOWN + 2, j] * v2 + E[FLOWN + 2, k] * v3 + part * S[at + 2, b]
            E[LEFT, lane], E[LEFT + 1, lane], E[LEFT + 2, lane] = l1, l2, l3
            at = END + SPUN
            x = E[at, i] * l1 + E[at, j] * l2 + E[at, k] * l3
            y = E[at + 1, i] * l1 + E[at + 1, j] * l2 + E[at + 1, k] * l3
            z = E[at + 2, i] * l1 + E[at + 2, j] * l2 + E[at + 2, k] * l3
            E[FOUND, b] += l1 * l1 + l2 * l2 + l3 * l3
            E[FOUND + 1, b] += x * x + y * y + z * z
            if traced:
                at, part = CARRIED, E[PART, b]
                x = E[at, i] * v1 + E[at, j] * v2 + E[at, k] * v3 + part * S[MOVED + SLIP, b]
                y = E[at + 1, i] * v1 + E[at + 1, j] * v2 + E[at + 1, k] * v3 + part * S[MOVED + SLIP + 1, b]
                x, y = E[ROLLED, lane] + x, E[ROLLED + 1, lane] + y
                E[ROLLED, lane], E[ROLLED + 1, lane] = x, y
                E[FOUND + 2, b] += x * x + y * y
    for b in lanes(B):
        E[FOUND, b], E[FOUND + 1, b], E[FOUND + 2, b] = (
            sqrt(E[FOUND, b]), sqrt(E[FOUND + 1, b]), sqrt(E[FOUND + 2, b])
        )  # fmt: skip


def carry(S, E, B, traced):
    """Carries the errors of every ball on by the step that `WHOLE`, `PART` and `ROUNDED` describe, 0 where none stays.

    Both ends are there; the last becomes the first.
    """
    flown(E, B, traced)
    leave(S, E, B, traced)
    for b in lanes(B):
        i, j, k = b, B + b, 2 * B + b
        a1, a2, a3 = E[FLOWN, i], E[FLOWN + 1, i], E[FLOWN + 2, i]
        b1, b2, b3 = E[FLOWN, j], E[FLOWN + 1, j], E[FLOWN + 2, j]
        c1, c2, c3 = E[FLOWN, k], E[FLOWN + 1, k], E[FLOWN + 2, k]
        error = E[ROUNDED, b]
        s11, s12, s13 = E[INNER, b], E[INNER + 1, b], E[INNER + 2, b]
        s22, s23, s33 = E[INNER + 3, b], E[INNER + 4, b], E[INNER + 5, b]
        p11, p12, p13 = a1 * s11 + b1 * s12 + c1 * s13, a1 * s12 + b1 * s22 + c1 * s23, a1 * s13 + b1 * s23 + c1 * s33
        p21, p22, p23 = a2 * s11 + b2 * s12 + c2 * s13, a2 * s12 + b2 * s22 + c2 * s23, a2 * s13 + b2 * s23 + c2 * s33
        p31, p32, p33 = a3 * s11 + b3 * s12 + c3 * s13, a3 * s12 + b3 * s22 + c3 * s23, a3 * s13 + b3 * s23 + c3 * s33
        e11, e12, e13 = p11 * a1 + p12 * b1 + p13 * c1, p11 * a2 + p12 * b2 + p13 * c2, p11 * a3 + p12 * b3 + p13 * c3
        e22, e23, e33 = p21 * a2 + p22 * b2 + p23 * c2, p21 * a3 + p22 * b3 + p23 * c3, p31 * a3 + p32 * b3 + p33 * c3
        e11, e22, e33 = e11 + error, e22 + error, e33 + error
        E[INNER, b], E[INNER + 1, b], E[INNER + 2, b] = e11, e12, e13
        E[INNER + 3, b], E[INNER + 4, b], E[INNER + 5, b] = e22, e23, e33
        rounded = 0.0
        for c in range(3):
            x, y, z = E[END + SPUN + c, i], E[END + SPUN + c, j], E[END + SPUN + c, k]
            rounded += x * (x * e11 + 2.0 * (y * e12 + z * e13)) + y * (y * e22 + 2.0 * z * e23) + z * z * e33
        E[FOUND + 3, b], E[FOUND + 4, b] = sqrt(e11 + e22 + e33), sqrt(max(rounded, 0.0))
        if traced:
            x1, x2, x3 = E[CARRIED, i], E[CARRIED, j], E[CARRIED, k]
            y1, y2, y3 = E[CARRIED + 1, i], E[CARRIED + 1, j], E[CARRIED + 1, k]
            m1, m2, m3 = E[MIXED, b], E[MIXED + 1, b], E[MIXED + 2, b]
            n1, n2, n3 = E[MIXED + 3, b], E[MIXED + 4, b], E[MIXED + 5, b]
            # u = C S + X for each of the two, with which both what is mixed and what is outer go on.
            u1 = (x1 * s11 + x2 * s12 + x3 * s13) + m1
            u2 = (x1 * s12 + x2 * s22 + x3 * s23) + m2
            u3 = (x1 * s13 + x2 * s23 + x3 * s33) + m3
            v1 = (y1 * s11 + y2 * s12 + y3 * s13) + n1
            v2 = (y1 * s12 + y2 * s22 + y3 * s23) + n2
            v3 = (y1 * s13 + y2 * s23 + y3 * s33) + n3
            # The contact point, far away, is rounded by itself.
            x, y, one = S[MOVED + SPOT, b], S[MOVED + SPOT + 1, b], UNIT_ROUNDING / S[RADIUS, b]
            error += one * one * (x * x + y * y) if error > 0.0 else 0.0
            x = E[OUTER, b] + ((u1 * x1 + u2 * x2 + u3 * x3) + (m1 * x1 + m2 * x2 + m3 * x3) + error)
            y = E[OUTER + 1, b] + ((v1 * y1 + v2 * y2 + v3 * y3) + (n1 * y1 + n2 * y2 + n3 * y3) + error)
            E[OUTER, b], E[OUTER + 1, b], E[FOUND + 5, b] = x, y, sqrt(max(x + y, 0.0))
            E[MIXED, b], E[MIXED + 1, b] = u1 * a1 + u2 * b1 + u3 * c1, u1 * a2 + u2 * b2 + u3 * c2
            E[MIXED + 2, b], E[MIXED + 3, b] = u1 * a3 + u2 * b3 + u3 * c3, v1 * a1 + v2 * b1 + v3 * c1
            E[MIXED + 4, b], E[MIXED + 5, b] = v1 * a2 + v2 * b2 + v3 * c2, v1 * a3 + v2 * b3 + v3 * c3
    for row in range(END):
        for i in lanes(LANES * B):
            E[row, i] = E[END + row, i]
