"""How the flow carries errors: the errors of the long steps of a ball, and the ellipsoid that holds their sum.

An error of a step turns the body by a small φ, in its axes, and leaves K and γ where they are in space.  With
Bω = Λω - D⟨γ,ω⟩γ = K and the rate δω that follows from φ, B δω = Λω × φ + D⟨ω × γ, φ⟩γ, it goes on as φ' = δω + φ × ω,
and the contact point is off by the integral of R(φ' × γ) radii.  From both ends of a step of length h

    (1 - (h/2)A + (h²/12)P) φ₁ = (1 + (h/2)A₀ + (h²/12)P₀) φ₀    with φ' = Aφ, φ'' = Pφ,

up to the fifth power of h, and for steady A without growth where there is none (Padé).

If step i leaves an error of at most eᵢ in any direction, all of them together are Σ Φᵢ uᵢ with |uᵢ| ≤ eᵢ, where Φᵢ is
the flow from there on.  By Cauchy and Schwarz its part along any direction d squared is at most (Σ eᵢ) (Σ eᵢ |Φᵢᵀd|²).
So S' = Φ S Φᵀ + e is carried on, and (Σ eᵢ) tr S is more than the square of the error.
"""

from chapsym.generated import angular_velocity, rotate

from .long_step import ATTITUDE

#: Rows of an end, by columns of φ: δω, φ' and φ'', each 3 by 3, and how fast the contact point leaves, 2 by 3, and its
#: rate; ω, along which the flow goes, and the gradient of the energy; of two ends; then S: of φ (6), of the contact
#: point with φ (6), of the contact point (3); and Σ e.
SPUN, RATE, SECOND, WAY, BEND, FLOW, GRADIENT = 0, 9, 18, 27, 33, 39, 42
END = 45
INNER, MIXED, OUTER, DOUBTED = 2 * END, 2 * END + 6, 2 * END + 12, 2 * END + 15
ERRORS = DOUBTED + 1
#: Below this part of |Λω| |ω| the gradient of the energy is too much of a rounding to be used.
STEADY = 1e-7


def tangent(body, J1, J2, J3, contact, traced, E, at):
    """The rates of an error φ of `body` (`long_step.MOVING`), in its unit of time, into E from the row `at` on."""
    K1, K2, K3, g1, g2, g3 = body[0], body[1], body[2], body[3], body[4], body[5]
    I1, I2, I3 = (J2 + J3) + contact, (J1 + J3) + contact, (J1 + J2) + contact
    w1, w2, w3 = angular_velocity(K1, K2, K3, g1, g2, g3, J1, J2, J3, contact)
    m1, m2, m3 = I1 * w1, I2 * w2, I3 * w3
    a1, a2, a3 = angular_velocity(
        m2 * w3 - m3 * w2, m3 * w1 - m1 * w3, m1 * w2 - m2 * w1, g1, g2, g3, J1, J2, J3, contact
    )
    n1, n2, n3 = I1 * a1, I2 * a2, I3 * a3
    E[at + FLOW], E[at + FLOW + 1], E[at + FLOW + 2] = w1, w2, w3
    s1, s2, s3 = w2 * m3 - w3 * m2, w3 * m1 - w1 * m3, w1 * m2 - w2 * m1
    least = STEADY * STEADY * ((m1 * m1 + m2 * m2 + m3 * m3) * (w1 * w1 + w2 * w2 + w3 * w3))
    one = 1.0 if s1 * s1 + s2 * s2 + s3 * s3 > least else 0.0
    E[at + GRADIENT], E[at + GRADIENT + 1], E[at + GRADIENT + 2] = one * s1, one * s2, one * s3
    v1, v2, v3 = w2 * g3 - w3 * g2, w3 * g1 - w1 * g3, w1 * g2 - w2 * g1  # ω × γ = -γ'
    u1 = (a2 * g3 - a3 * g2) - (w2 * v3 - w3 * v2)
    u2 = (a3 * g1 - a1 * g3) - (w3 * v1 - w1 * v3)
    u3 = (a1 * g2 - a2 * g1) - (w1 * v2 - w2 * v1)
    x1, x2, x3, y1, y2, y3 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    if traced:
        a, b, c, d = body[ATTITUDE], body[ATTITUDE + 1], body[ATTITUDE + 2], body[ATTITUDE + 3]
        x1, x2, x3 = rotate(a, -b, -c, -d, 1.0, 0.0, 0.0)
        y1, y2, y3 = rotate(a, -b, -c, -d, 0.0, 1.0, 0.0)
    for i in range(3):
        e1, e2, e3 = 1.0 if i == 0 else 0.0, 1.0 if i == 1 else 0.0, 1.0 if i == 2 else 0.0
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
        row = at + 3 * i
        E[row + SPUN], E[row + SPUN + 1], E[row + SPUN + 2] = s1, s2, s3
        E[row + RATE], E[row + RATE + 1], E[row + RATE + 2] = f1, f2, f3
        E[row + SECOND], E[row + SECOND + 1], E[row + SECOND + 2] = p1, p2, p3
        if traced:
            z1, z2, z3 = f2 * g3 - f3 * g2, f3 * g1 - f1 * g3, f1 * g2 - f2 * g1
            b1 = (w2 * z3 - w3 * z2) + (p2 * g3 - p3 * g2) - (f2 * v3 - f3 * v2)
            b2 = (w3 * z1 - w1 * z3) + (p3 * g1 - p1 * g3) - (f3 * v1 - f1 * v3)
            b3 = (w1 * z2 - w2 * z1) + (p1 * g2 - p2 * g1) - (f1 * v2 - f2 * v1)
            row = at + 2 * i
            E[row + WAY], E[row + WAY + 1] = x1 * z1 + x2 * z2 + x3 * z3, y1 * z1 + y2 * z2 + y3 * z3
            E[row + BEND], E[row + BEND + 1] = x1 * b1 + x2 * b2 + x3 * b3, y1 * b1 + y2 * b2 + y3 * b3


def carry(E, first, last, whole, error, traced, F):
    """Carries S on by a step between two ends of E, and adds the error of the step.

    whole: the step, in the unit of time of the ends.  F (27) is used.
    """
    half, twelfth = 0.5 * whole, whole * whole * (1.0 / 12.0)
    for i in range(9):
        one = 1.0 if i % 4 == 0 else 0.0
        F[i] = one - half * E[last + RATE + i] + twelfth * E[last + SECOND + i]
        F[9 + i] = one + half * E[first + RATE + i] + twelfth * E[first + SECOND + i]
    # The inverse of the first, by columns as all of these: a₁ × a₂ over the determinant is its first row.
    a1, a2, a3, b1, b2, b3, c1, c2, c3 = F[0], F[1], F[2], F[3], F[4], F[5], F[6], F[7], F[8]
    r1, r2, r3 = b2 * c3 - b3 * c2, b3 * c1 - b1 * c3, b1 * c2 - b2 * c1
    s1, s2, s3 = c2 * a3 - c3 * a2, c3 * a1 - c1 * a3, c1 * a2 - c2 * a1
    t1, t2, t3 = a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1
    over = 1.0 / (a1 * r1 + a2 * r2 + a3 * r3)
    for i in range(3):
        x, y, z = over * F[9 + 3 * i], over * F[10 + 3 * i], over * F[11 + 3 * i]
        F[18 + 3 * i], F[19 + 3 * i] = r1 * x + r2 * y + r3 * z, s1 * x + s2 * y + s3 * z
        F[20 + 3 * i] = t1 * x + t2 * y + t3 * z
    kept(E, first, last, F)
    a1, a2, a3, b1, b2, b3, c1, c2, c3 = F[18], F[19], F[20], F[21], F[22], F[23], F[24], F[25], F[26]
    s11, s12, s13, s22, s23, s33 = E[INNER], E[INNER + 1], E[INNER + 2], E[INNER + 3], E[INNER + 4], E[INNER + 5]
    # Φ S, of which only the rows are needed.
    p11, p12, p13 = a1 * s11 + b1 * s12 + c1 * s13, a1 * s12 + b1 * s22 + c1 * s23, a1 * s13 + b1 * s23 + c1 * s33
    p21, p22, p23 = a2 * s11 + b2 * s12 + c2 * s13, a2 * s12 + b2 * s22 + c2 * s23, a2 * s13 + b2 * s23 + c2 * s33
    p31, p32, p33 = a3 * s11 + b3 * s12 + c3 * s13, a3 * s12 + b3 * s22 + c3 * s23, a3 * s13 + b3 * s23 + c3 * s33
    E[INNER] = (p11 * a1 + p12 * b1 + p13 * c1) + error
    E[INNER + 1], E[INNER + 2] = p11 * a2 + p12 * b2 + p13 * c2, p11 * a3 + p12 * b3 + p13 * c3
    E[INNER + 3], E[INNER + 4] = (p21 * a2 + p22 * b2 + p23 * c2) + error, p21 * a3 + p22 * b3 + p23 * c3
    E[INNER + 5] = (p31 * a3 + p32 * b3 + p33 * c3) + error
    E[DOUBTED] += error
    if not traced:
        return
    for j in range(2):
        # The row j of what the contact point gets from φ: Simpson's rule with the rates of the ends, by columns.
        f1, f2, f3 = (
            half * E[last + WAY + j] - twelfth * E[last + BEND + j],
            half * E[last + WAY + 2 + j] - twelfth * E[last + BEND + 2 + j],
            half * E[last + WAY + 4 + j] - twelfth * E[last + BEND + 4 + j],
        )
        for i in range(3):
            F[3 * j + i] = (half * E[first + WAY + 2 * i + j] + twelfth * E[first + BEND + 2 * i + j]) + (
                f1 * F[18 + 3 * i] + f2 * F[19 + 3 * i] + f3 * F[20 + 3 * i]
            )
    x1, x2, x3, y1, y2, y3 = F[0], F[1], F[2], F[3], F[4], F[5]
    m1, m2, m3 = E[MIXED], E[MIXED + 1], E[MIXED + 2]
    n1, n2, n3 = E[MIXED + 3], E[MIXED + 4], E[MIXED + 5]
    # u = C S + X for each of the two, with which both what is mixed and what is outer go on.
    u1 = (x1 * s11 + x2 * s12 + x3 * s13) + m1
    u2 = (x1 * s12 + x2 * s22 + x3 * s23) + m2
    u3 = (x1 * s13 + x2 * s23 + x3 * s33) + m3
    v1 = (y1 * s11 + y2 * s12 + y3 * s13) + n1
    v2 = (y1 * s12 + y2 * s22 + y3 * s23) + n2
    v3 = (y1 * s13 + y2 * s23 + y3 * s33) + n3
    E[OUTER] += (u1 * x1 + u2 * x2 + u3 * x3) + (m1 * x1 + m2 * x2 + m3 * x3) + error
    E[OUTER + 1] += (u1 * y1 + u2 * y2 + u3 * y3) + (n1 * x1 + n2 * x2 + n3 * x3)
    E[OUTER + 2] += (v1 * y1 + v2 * y2 + v3 * y3) + (n1 * y1 + n2 * y2 + n3 * y3) + error
    E[MIXED], E[MIXED + 1] = u1 * a1 + u2 * b1 + u3 * c1, u1 * a2 + u2 * b2 + u3 * c2
    E[MIXED + 2], E[MIXED + 3] = u1 * a3 + u2 * b3 + u3 * c3, v1 * a1 + v2 * b1 + v3 * c1
    E[MIXED + 4], E[MIXED + 5] = v1 * a2 + v2 * b2 + v3 * c2, v1 * a3 + v2 * b3 + v3 * c3


def kept(E, first, last, F):
    """Corrects Φ, the columns from F[18] on, so that it takes ω to ω, and keeps what an error does to the energy.

    The flow takes a shift in time along, φ = ω, and the energy is an integral: ⟨n, φ⟩ with n = ω × Λω.  An error of Φ
    there would grow with each passage of an unstable rotation, where all else only grows with their number.
    """
    w1, w2, w3 = E[first + FLOW], E[first + FLOW + 1], E[first + FLOW + 2]
    square = w1 * w1 + w2 * w2 + w3 * w3
    part = 1.0 / square if square > 0.0 else 0.0
    for r in range(3):
        off = part * (E[last + FLOW + r] - (F[18 + r] * w1 + F[21 + r] * w2 + F[24 + r] * w3))
        F[18 + r] += off * w1
        F[21 + r] += off * w2
        F[24 + r] += off * w3
    n1, n2, n3 = E[last + GRADIENT], E[last + GRADIENT + 1], E[last + GRADIENT + 2]
    before = E[first + GRADIENT] * E[first + GRADIENT] + (
        E[first + GRADIENT + 1] * E[first + GRADIENT + 1] + E[first + GRADIENT + 2] * E[first + GRADIENT + 2]
    )
    square = n1 * n1 + n2 * n2 + n3 * n3
    part = 1.0 / square if before > 0.0 and square > 0.0 else 0.0
    for i in range(3):
        off = part * (E[first + GRADIENT + i] - (n1 * F[18 + 3 * i] + n2 * F[19 + 3 * i] + n3 * F[20 + 3 * i]))
        F[18 + 3 * i] += off * n1
        F[19 + 3 * i] += off * n2
        F[20 + 3 * i] += off * n3


def turned_square(E):
    """The square of how far the attitude may be off, in radians²."""
    return max(E[DOUBTED] * (E[INNER] + E[INNER + 3] + E[INNER + 5]), 0.0)


def way_square(E):
    """The square of how far the contact point may be off, in radii²."""
    return max(E[DOUBTED] * (E[OUTER] + E[OUTER + 2]), 0.0)


def spun_square(E, at):
    """The square of how far ω may be off at the end in the rows from `at` on."""
    s11, s12, s13, s22, s23, s33 = E[INNER], E[INNER + 1], E[INNER + 2], E[INNER + 3], E[INNER + 4], E[INNER + 5]
    found = 0.0
    for i in range(3):
        a, b, c = E[at + SPUN + i], E[at + SPUN + 3 + i], E[at + SPUN + 6 + i]
        found += a * (a * s11 + 2.0 * (b * s12 + c * s13)) + b * (b * s22 + 2.0 * c * s23) + c * c * s33
    return max(E[DOUBTED] * found, 0.0)
