"""The top from its Lagrangian and its constraint.

The attitudes R0, R1, ... turn by Ω = R0ᵀR1, ...; the Lagrangian of a turn is tr(Ω J), with the mass tensor J.  The
constraint admits turns about axes across e3, and variations of an attitude about such axes.
"""

import sympy as sp

from chapsym.derive import Quotient
from chapsym.prove import equations

q = sp.Matrix(sp.symbols("q0:3"))  # Euler parameters of a turn; the fourth is 0
p = sp.Matrix(sp.symbols("p0:3"))  # of the turn before
x = sp.Matrix(sp.symbols("x1:3"))  # what varies an attitude
u = sp.Matrix(sp.symbols("u1:3"))  # the Gibbs vector of a turn, (q1, q2)/q0
M = sp.Matrix(sp.symbols("M1:3"))  # the momentum
J1, J2, J3, J13, J23 = MASS = sp.symbols("J1 J2 J3 J13 J23")
J = sp.Matrix([[J1, 0, J13], [0, J2, J23], [J13, J23, J3]])
I = sp.Matrix([J2 + J3, J1 + J3])  # the moments of inertia about e1 and e2

UNIT = q.dot(q) - 1
equal = equations(Quotient((*q, *MASS), [UNIT]))
free = equations(Quotient((*u, *M, *MASS)))


def turn(a, b, c, d):
    """The matrix of the Euler parameters (a, b, c, d)."""
    v = sp.Matrix([b, c, d])
    cross = sp.Matrix([[0, -d, c], [d, 0, -b], [-c, b, 0]])
    return (a**2 - v.dot(v)) * sp.eye(3) + 2 * v * v.T + 2 * a * cross


def product(a, b):
    """The quaternion of one turn after another."""
    v, w = a[1:, :], b[1:, :]
    return sp.Matrix([a[0] * b[0] - v.dot(w), *(a[0] * w + b[0] * v + v.cross(w))])


def action(before, after):
    """Of two turns, with the attitude between them varied by x: R becomes R (1 + x + ...), at the first order."""
    first = product(sp.Matrix([*before, 0]), sp.Matrix([1, *x / 2, 0]))
    second = product(sp.Matrix([1, *-x / 2, 0]), sp.Matrix([*after, 0]))
    return (turn(*first) * J + turn(*second) * J).trace()


def variation(before, after):
    """What the principle sets to 0: the derivatives of the action by x."""
    return [sp.diff(action(before, after), y).subs(dict.fromkeys(x, 0)) for y in x]


def momentum(a, b):
    """The first two entries of the axial vector of Ω J - J Ωᵀ, of the turn (a, b)."""
    skew = turn(a, *b, 0) * J - J * turn(a, *b, 0).T
    return sp.Matrix([skew[2, 1], skew[0, 2]]).applyfunc(sp.expand)


def outward(a, b):
    """The momentum with which a turn starts."""
    return momentum(a, b)


def inward(a, b):
    """The momentum with which a turn ends: that of the turn back, with the other sign."""
    return -momentum(a, -b)


def slip(b):
    """The mass products that the axis of a turn meets; where it is 0, the top turns steadily."""
    return J13 * b[0] + J23 * b[1]


def across(b):
    """b, turned by a right angle."""
    return sp.Matrix([b[1], -b[0]])


def energy(m):
    """That of a momentum."""
    return m[0] ** 2 / I[0] + m[1] ** 2 / I[1]


def residual():
    """What vanishes where the turn of Gibbs vector u starts with the momentum M."""
    return (1 + u.dot(u)) * M - sp.Matrix(outward(1, u))
