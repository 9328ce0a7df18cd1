"""Propagation of errors by the flow: truncation errors of the long steps of a ball, and their rounding errors.

An error of a step turns the body by a small φ, in body axes, and does not change K and γ in space.  Let
Bω = Λω - D⟨γ,ω⟩γ = K.  The change δω of the rate is given by B δω = Λω × φ + D⟨ω × γ, φ⟩γ.  Then φ' = δω + φ × ω, and
the error of the contact point is the integral of R(φ' × γ) radii.  For a step of length h, from both ends,

    (1 - (h/2)A + (h²/12)P) φ₁ = (1 + (h/2)A₀ + (h²/12)P₀) φ₀    with φ' = Aφ, φ'' = Pφ,

up to the fifth power of h; for constant A without growth there is no growth (Padé).

φ₁ = Φφ₀ propagates two kinds of errors.  The size of a truncation error is estimated from the last columns; its
direction is unknown, and may change little from step to step.  So three errors of this size go on as Φφ + e, one along
each of the changes by the last three columns: then cancellation between steps is taken into account.  Rounding errors
have random directions: the matrix of their mean squares goes on as ΦSΦᵀ + r².  It is kept as a factor, S = LLᵀ, and
reflections take [ΦL, r] to a triangle: where errors grow along one direction and shrink along others, S itself would
lose the latter to rounding, and then be wrong where these grow.
"""

from math import sqrt

from chapsym.generated import angular_velocity, rotate

from .lanes import ATTITUDE, BALL, CHANGE, CHANGES, DONE, LANES, MOVED, RADIUS, SLIP, SPOT, SUMS, TWIST, Q, Y, twist
from .text import lanes
from .vectors import cross, dot, four_in, minus, mixed, plus, put_four_in, put_in, scaled, square_of_four, three_in

#: Rows of an end.  Of the unit error φ of a lane: δω, φ', φ'', the rate of the error of the contact point, and its
#: derivative.  Of the ball, in its first lane: ω, the direction of the flow, and the gradient of the energy.
SPUN, RATE, SECOND, WAY, BEND, FLOW, GRADIENT = 0, 3, 6, 9, 11, 13, 16
END = 19
#: Rows beyond the two ends: the unit error; K, γ, the attitude and J, in all lanes; the image of a unit error at the
#: end of the step, and its contribution to the contact point.
UNIT, INPUT, SHAPE, FLOWN, CARRIED = 2 * END, 2 * END + 3, 2 * END + 13, 2 * END + 16, 2 * END + 19
#: The accumulated truncation errors of φ and the contact point, three errors in three lanes.  Rows of the ball: L by
#: columns (6), the two rows of the contact point in these columns (6), and the mean squares of its others (2).  Of an
#: accepted step: its length in the unit of time of S, its error as a fraction of each vector of `TWIST`, and the square
#: of its rounding error.
LEFT, ROLLED, INNER, MIXED, OUTER = CARRIED + 2, CARRIED + 5, CARRIED + 7, CARRIED + 13, CARRIED + 19
WHOLE, PART, ROUNDED = CARRIED + 21, CARRIED + 22, CARRIED + 25
#: The results: the lengths of φ, of δω and of the error of the contact point, and the root mean squares of the rounding
#: errors of the same.
FOUND = CARRIED + 26
#: The inverse, by rows, of the matrix of the last end, and h/2 and h²/12 of the step.
INVERSE, HALF, TWELFTH = FOUND + 6, FOUND + 15, FOUND + 16
#: At the last end: ω from the component of K of a lane alone; and the relative change of ω for a relative rounding
#: error 1 of each component of K.
SHARE, SWAY = FOUND + 17, FOUND + 20
#: The changes of the quaternion by the last three columns, and of the path of the centre by the last.
CHANGED = FOUND + 21
ROWS = CHANGED + 4 * CHANGES + 3
#: The unit roundoff.
UNIT_ROUNDING = 2.0**-53
#: Below this fraction of |Λω| |ω| the gradient of the energy is not used, as rounding dominates.
STEADY = 1e-7


def begun(E, B, b, J, start):
    """Puts a ball into its lanes, with no error except the rounding error of its start."""
    for lane in range(LANES):
        i = lane * B + b
        for c in range(3):
            E[UNIT + c, i] = 1.0 if c == lane else 0.0
        put_in(E, SHAPE, i, J)
        for row in range(LEFT, ROWS):
            E[row, i] = 0.0
    E[INNER, b], E[INNER + 3, b], E[INNER + 5, b] = start, start, start


def tangent(S, E, B, at, traced):
    """Writes the rates of the unit errors of every ball, in the unit of time of S, into E from the row `at` on."""
    for row in range(10):
        for b in lanes(B):
            one = S[MOVED + row, b]
            E[INPUT + row, b], E[INPUT + row, B + b] = one, one
            E[INPUT + row, 2 * B + b], E[INPUT + row, 3 * B + b] = one, one
    for i in lanes(LANES * B):
        K, g, J, contact = three_in(E, INPUT, i), three_in(E, INPUT + 3, i), three_in(E, SHAPE, i), S[BALL + 3, i]
        body = S[BALL, i] + contact, S[BALL + 1, i] + contact, S[BALL + 2, i] + contact
        w = angular_velocity(*K, *g, *J, contact)
        m = by(body, w)
        s = cross(w, m)
        a = angular_velocity(-s[0], -s[1], -s[2], *g, *J, contact)
        n = by(body, a)
        put_in(E, at + FLOW, i, w)
        least = STEADY * STEADY * (dot(m, m) * dot(w, w))
        put_in(E, at + GRADIENT, i, scaled(1.0 if dot(s, s) > least else 0.0, s))
        v = cross(w, g)  # -γ'
        u = minus(cross(a, g), cross(w, v))
        e = three_in(E, UNIT, i)
        put_in(E, SHARE, i, angular_velocity(*by(e, K), *g, *J, contact))
        along, across = contact * dot(v, e), contact * dot(u, e)
        s = angular_velocity(*plus(cross(m, e), scaled(along, g)), *g, *J, contact)
        f = plus(s, cross(e, w))
        # B δω' = Λω' × φ + Λω × φ' + D(⟨ω × γ,φ'⟩ + ⟨(ω × γ)',φ⟩)γ + D⟨ω × γ,φ⟩γ' + D⟨γ,δω⟩γ' + D⟨γ',δω⟩γ.
        up, over = across + contact * (dot(v, f) - dot(v, s)), along + contact * dot(g, s)
        turned = minus(scaled(up, g), scaled(over, v))
        t = angular_velocity(*plus(plus(cross(n, e), cross(m, f)), turned), *g, *J, contact)
        p = plus(plus(t, cross(f, w)), cross(e, a))
        put_in(E, at + SPUN, i, s)
        put_in(E, at + RATE, i, f)
        put_in(E, at + SECOND, i, p)
        if traced:
            q, z = four_in(E, INPUT + ATTITUDE, i), cross(f, g)
            b = minus(plus(cross(w, z), cross(p, g)), cross(f, v))
            E[at + WAY, i], E[at + WAY + 1, i], _ = rotate(*q, *z)
            E[at + BEND, i], E[at + BEND + 1, i], _ = rotate(*q, *b)
    for b in lanes(B):
        i, j, k, w, found = b, B + b, 2 * B + b, three_in(E, at + FLOW, b), 0.0
        for c in range(3):
            moved = abs(E[SHARE + c, i]) + abs(E[SHARE + c, j]) + abs(E[SHARE + c, k])
            found += moved * moved
        size = dot(w, w)
        E[SWAY, b] = sqrt(found / size) if size > 0.0 else 0.0


def by(a, b):
    """The products of the components of two vectors."""
    return a[0] * b[0], a[1] * b[1], a[2] * b[2]


def ended(E, i, half, twelfth):
    """((h²/12)P - (h/2)A)φ for the unit error φ of a lane, at the last end."""
    return minus(scaled(twelfth, three_in(E, END + SECOND, i)), scaled(half, three_in(E, END + RATE, i)))


def flown(E, B, traced):
    """Writes Φ of the step `WHOLE` of every ball, column by column in its lanes, and the rows of the contact point."""
    for b in lanes(B):
        half, twelfth = 0.5 * E[WHOLE, b], E[WHOLE, b] * E[WHOLE, b] * (1.0 / 12.0)
        i, j, k = b, B + b, 2 * B + b
        u, v, w = ended(E, i, half, twelfth), ended(E, j, half, twelfth), ended(E, k, half, twelfth)
        a = 1.0 - half * E[END + RATE, i] + twelfth * E[END + SECOND, i], u[1], u[2]
        d = v[0], 1.0 - half * E[END + RATE + 1, j] + twelfth * E[END + SECOND + 1, j], v[2]
        e = w[0], w[1], 1.0 - half * E[END + RATE + 2, k] + twelfth * E[END + SECOND + 2, k]
        # The rows of the inverse are the cross products of the columns, over the determinant.
        row = cross(d, e)
        over = 1.0 / dot(a, row)
        put_in(E, INVERSE, b, scaled(over, row))
        put_in(E, INVERSE + 3, b, scaled(over, cross(e, a)))
        put_in(E, INVERSE + 6, b, scaled(over, cross(a, d)))
        E[HALF, b], E[TWELFTH, b] = half, twelfth
    for column in range(3):
        for b in lanes(B):
            i, half, twelfth = column * B + b, E[HALF, b], E[TWELFTH, b]
            v = plus(three_in(E, UNIT, i), scaled(half, three_in(E, RATE, i)))
            v = plus(v, scaled(twelfth, three_in(E, SECOND, i)))
            E[FLOWN, i] = dot(three_in(E, INVERSE, b), v)
            E[FLOWN + 1, i], E[FLOWN + 2, i] = dot(three_in(E, INVERSE + 3, b), v), dot(three_in(E, INVERSE + 6, b), v)
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
    """Corrects Φ so that it takes ω to ω, and preserves the change of energy by an error.

    The flow transports a shift in time, φ = ω; and the energy is an integral, with the derivative ⟨n, φ⟩, n = ω × Λω.
    Errors of Φ in these would grow exponentially with passages of an unstable rotation, all others linearly.
    """
    for b in lanes(B):
        i, j, k = b, B + b, 2 * B + b
        w, columns = three_in(E, FLOW, b), (three_in(E, FLOWN, i), three_in(E, FLOWN, j), three_in(E, FLOWN, k))
        size = dot(w, w)
        part = 1.0 / size if size > 0.0 else 0.0
        x = scaled(part, minus(three_in(E, END + FLOW, b), applied(columns, w)))
        c1, c2, c3 = (
            plus(columns[0], scaled(w[0], x)),
            plus(columns[1], scaled(w[1], x)),
            plus(columns[2], scaled(w[2], x)),
        )
        n, m = three_in(E, END + GRADIENT, b), three_in(E, GRADIENT, b)
        size = dot(n, n)
        part = 1.0 / size if size > 0.0 and dot(m, m) > 0.0 else 0.0
        put_in(E, FLOWN, i, plus(c1, scaled(part * (m[0] - dot(n, c1)), n)))
        put_in(E, FLOWN, j, plus(c2, scaled(part * (m[1] - dot(n, c2)), n)))
        put_in(E, FLOWN, k, plus(c3, scaled(part * (m[2] - dot(n, c3)), n)))


def applied(columns, v):
    """The product of a matrix, given by its columns, and a vector."""
    return plus(plus(scaled(v[0], columns[0]), scaled(v[1], columns[1])), scaled(v[2], columns[2]))


def changes(S, E, B):
    """Writes the changes by the last columns into `TWIST` and `SLIP`, for every ball that is not lost."""
    for i in lanes(LANES * B):
        a, b = four_in(S, DONE, i), four_in(S, Q, i)
        one, two = 1.0 / sqrt(square_of_four(a)), 1.0 / sqrt(square_of_four(b))
        for c in range(CHANGES):
            w, v = S[CHANGE + 2 * c, i] * one, S[CHANGE + 2 * c + 1, i] * two
            put_four_in(E, CHANGED + 4 * c, i, mixed(w, a, v, b))
        way = plus(scaled(S[CHANGE, i], three_in(S, DONE + 4, i)), scaled(S[CHANGE + 1, i], three_in(S, Y, i)))
        put_in(E, CHANGED + 4 * CHANGES, i, way)
    for row in range(CHANGED, ROWS):
        for b in lanes(B):
            E[row, b] = (E[row, b] + E[row, B + b]) + (E[row, 2 * B + b] + E[row, 3 * B + b])
    for c in range(CHANGES):
        for b in lanes(B):
            put_in(S, MOVED + TWIST + 3 * c, b, twist(four_in(S, SUMS, b), four_in(E, CHANGED + 4 * c, b)))
    for b in lanes(B):
        S[MOVED + SLIP, b], S[MOVED + SLIP + 1, b], _ = rotate(
            *four_in(E, INPUT + ATTITUDE, b), *three_in(E, CHANGED + 4 * CHANGES, b)
        )


def leave(S, E, B, traced):
    """Propagates the truncation errors, and finds the root of the sum of the squares of the three."""
    for b in lanes(B):
        E[FOUND, b], E[FOUND + 1, b], E[FOUND + 2, b] = 0.0, 0.0, 0.0
    for c in range(CHANGES):
        for b in lanes(B):
            i, j, k, lane, part = b, B + b, 2 * B + b, c * B + b, E[PART + c, b]
            v = three_in(E, LEFT, lane)
            columns = three_in(E, FLOWN, i), three_in(E, FLOWN, j), three_in(E, FLOWN, k)
            l = plus(applied(columns, v), scaled(part, three_in(S, MOVED + TWIST + 3 * c, b)))
            put_in(E, LEFT, lane, l)
            columns = three_in(E, END + SPUN, i), three_in(E, END + SPUN, j), three_in(E, END + SPUN, k)
            x = applied(columns, l)
            E[FOUND, b] += dot(l, l)
            E[FOUND + 1, b] += dot(x, x)
            if traced:
                east, north = row_of(E, CARRIED, i, j, k), row_of(E, CARRIED + 1, i, j, k)
                y1 = E[ROLLED, lane] + (dot(east, v) + E[PART, b] * S[MOVED + SLIP, b])
                y2 = E[ROLLED + 1, lane] + (dot(north, v) + E[PART, b] * S[MOVED + SLIP + 1, b])
                E[ROLLED, lane], E[ROLLED + 1, lane] = y1, y2
                E[FOUND + 2, b] += y1 * y1 + y2 * y2
    for b in lanes(B):
        E[FOUND, b], E[FOUND + 1, b], E[FOUND + 2, b] = (
            sqrt(E[FOUND, b]), sqrt(E[FOUND + 1, b]), sqrt(E[FOUND + 2, b])
        )  # fmt: skip


def carry(S, E, B, traced):
    """Propagates errors by the step `WHOLE`, `PART`, `ROUNDED` (0 if not accepted); its last end becomes the first."""
    flown(E, B, traced)
    leave(S, E, B, traced)
    for b in lanes(B):
        i, j, k = b, B + b, 2 * B + b
        error, r = E[ROUNDED, b], sqrt(E[ROUNDED, b])
        l = three_in(E, INNER, b), (0.0, E[INNER + 3, b], E[INNER + 4, b]), (0.0, 0.0, E[INNER + 5, b])
        # The rows of [ΦL, r], and of the contact point.
        p, q, s = through(E, FLOWN, l, i, j, k), through(E, FLOWN + 1, l, i, j, k), through(E, FLOWN + 2, l, i, j, k)
        x = plus(through(E, CARRIED, l, i, j, k), three_in(E, MIXED, b))
        y = plus(through(E, CARRIED + 1, l, i, j, k), three_in(E, MIXED + 3, b))
        p1, p2, p3 = p
        v = reflection((p1, p2, p3, r))
        q1, q2, q3, q4 = reflected(v, (q[0], q[1], q[2], 0.0))
        s1, s2, s3, s4 = reflected(v, (s[0], s[1], s[2], 0.0))
        x1, x2, x3, x4 = reflected(v, (x[0], x[1], x[2], 0.0))
        y1, y2, y3, y4 = reflected(v, (y[0], y[1], y[2], 0.0))
        one = p1 - v[0], q1, s1
        v = reflection((q2, q3, q4, r))
        s2, s3, s4, s5 = reflected(v, (s2, s3, s4, 0.0))
        x2, x3, x4, x5 = reflected(v, (x2, x3, x4, 0.0))
        y2, y3, y4, y5 = reflected(v, (y2, y3, y4, 0.0))
        two = 0.0, q2 - v[0], s2
        v = reflection((s3, s4, s5, r))
        x3, x4, x5, x6 = reflected(v, (x3, x4, x5, 0.0))
        y3, y4, y5, y6 = reflected(v, (y3, y4, y5, 0.0))
        last = 0.0, 0.0, s3 - v[0]
        put_in(E, INNER, b, one)
        E[INNER + 3, b], E[INNER + 4, b], E[INNER + 5, b] = two[1], two[2], last[2]
        put_in(E, MIXED, b, (x1, x2, x3))
        put_in(E, MIXED + 3, b, (y1, y2, y3))
        columns = three_in(E, END + SPUN, i), three_in(E, END + SPUN, j), three_in(E, END + SPUN, k)
        a, d, c = applied(columns, one), applied(columns, two), applied(columns, last)
        E[FOUND + 3, b] = sqrt(dot(one, one) + dot(two, two) + dot(last, last))
        E[FOUND + 4, b] = sqrt(dot(a, a) + dot(d, d) + dot(c, c))
        if traced:
            # Far from the origin the contact point has rounding errors of its own.
            east, north, own = S[MOVED + SPOT, b], S[MOVED + SPOT + 1, b], UNIT_ROUNDING / S[RADIUS, b]
            error += own * own * (east * east + north * north) if error > 0.0 else 0.0
            E[OUTER, b] += x4 * x4 + x5 * x5 + x6 * x6 + error
            E[OUTER + 1, b] += y4 * y4 + y5 * y5 + y6 * y6 + error
            out = (x1 * x1 + x2 * x2 + x3 * x3) + (y1 * y1 + y2 * y2 + y3 * y3)
            E[FOUND + 5, b] = sqrt(out + E[OUTER, b] + E[OUTER + 1, b])
    for row in range(END):
        for i in lanes(LANES * B):
            E[row, i] = E[END + row, i]


def through(E, at, l, i, j, k):
    """The product of a row and the matrix L, by its columns."""
    row = row_of(E, at, i, j, k)
    return dot(row, l[0]), dot(row, l[1]), dot(row, l[2])


def reflection(u):
    """The vector v of the reflection 1 - f vvᵀ that takes u to (u₀ - v₀, 0, 0, 0), and f."""
    size = sqrt(square_of_four(u))
    first = u[0] + (size if u[0] >= 0.0 else -size)
    return first, u[1], u[2], u[3], 1.0 / (size * abs(first)) if size > 0.0 else 0.0


def reflected(v, row):
    """A row, reflected."""
    along = v[4] * (v[0] * row[0] + v[1] * row[1] + v[2] * row[2] + v[3] * row[3])
    return row[0] - along * v[0], row[1] - along * v[1], row[2] - along * v[2], row[3] - along * v[3]


def row_of(E, at, i, j, k):
    """The numbers of a row in three lanes."""
    return E[at, i], E[at, j], E[at, k]
