"""The root of a step in the Gibbs vector u = q/q₀: one Newton iterate from a good guess, checked.

With k = 𝒦/2 the step solves G(u) = B(γ)u + u × Iu - (1 + |u|²)k = 0.  Lemma `small-branch`: where |𝒦| is
below a bound, a root with |u| < 1 is that of the small-rotation branch, for every γ, and in the ball
|u| ≤ `radius` the Jacobian A satisfies ⟨d, Ad⟩ ≥ m|d|².  As |𝒦| is an integral of the map, the bound is looked
at once for a trajectory.  A Newton correction d leaves an error of at most c|d|², c = (½(I_max - I_min) + |k|)/m,
a second one e with the same cofactors at most 3c|d||e|.  That is compared with |u| ≥ |k|/(Λmax + ½(I_max - I_min)).

For D ≫ I the sum over a row of A leaves det A, and with it u, roundings of D/I: such a ball is `heavy`, has no
certificate, and takes the safe way, with the determinant of lemma `stable-determinant`.
"""

from math import frexp, ldexp, sqrt
from typing import NamedTuple

from chapsym.generated import gibbs_newton, gibbs_newton_heavy, gibbs_second

#: The error that the last correction may leave, relative to the least that |u| can be: the unit roundoff.
LEFT = 2.0**-53
#: An `enough` below this cannot be compared with squares: only float32 has so few exponents.
LEAST_ENOUGH = 0.0
#: How much of the bound may be used: at the bound the Jacobian is singular.
INSIDE = 0.95
MOST_ROUNDS = 12
#: Below this, for Λmax about 1, the squares of |𝒦| or of a determinant leave the range of float64.
SMALLEST = 2.0**-120
#: The same for a heavy ball, whose det is I D², and of which no power above the second is taken.
LIGHTEST = 2.0**-300
#: From this D/I_min on a ball is heavy: by a row u loses up to half of D/I_min in ulps, a twelfth in the median.
HEAVY = 32.0
#: In place of a radius²: |𝒦| is beyond the bound, and each root has to be proved (`path`).
BEYOND = -2.0
#: float32: a momentum below 2^-48, for Λmax = 1, turns the ball by less than the compensated sums of 𝒦 and γ can hold.
SINGLE = {"LEFT": 2.0**-24, "SMALLEST": 2.0**-48, "LIGHTEST": 2.0**-48, "LEAST_ENOUGH": 2.0**-62}


def is_heavy(I1, I2, I3, D):
    """Whether the determinant by a row of the Jacobian loses too much."""
    return HEAVY * min(I1, I2, I3) < D


def certificate(k1, k2, k3, I1, I2, I3, D):
    """`bound` for a ball that is not heavy, else (-1, 0)."""
    if is_heavy(I1, I2, I3, D):
        return -1.0, 0.0
    return bound(k1, k2, k3, I1, I2, I3, D)


def bound(k1, k2, k3, I1, I2, I3, D):
    """(radius², enough) by lemma `small-branch`; (BEYOND, 0) where |𝒦| is beyond its bound.

    A Newton correction d with |d|² ≤ enough is the last: it leaves a relative error of `LEFT` at most.
    """
    half = sqrt(k1 * k1 + k2 * k2 + k3 * k3)
    size = 2.0 * half
    least, most = min(I1, I2, I3), max(I1, I2, I3)
    spread = 0.5 * (most - least)
    if not size < least:
        return BEYOND, 0.0
    inner = size / (least + sqrt((least - size) * (least + size)))  # tan(½ arcsin(|𝒦|/I_min)): the root is within
    slope = spread + size
    if not inner * slope < INSIDE * least:
        return BEYOND, 0.0
    limit = min(1.0, least / slope) if slope > 0.0 else 1.0
    # A little more than the ball that contains the root, inside the one on which G is monotone.
    radius = min(1.25 * inner, 0.5 * (inner + limit))
    if half == 0.0:  # its square may be below the range of float32
        moving = k1 != 0.0 or k2 != 0.0 or k3 != 0.0
        return (-1.0, 0.0) if moving and LEAST_ENOUGH > 0.0 else (0.0, 0.0)
    contraction = (spread + half) / (least - radius * slope)
    enough = LEFT * half / ((most + D + spread) * contraction)
    return (-1.0, 0.0) if enough < LEAST_ENOUGH else (radius * radius, enough)


class Round(NamedTuple):
    """A Newton iterate: a quaternion p and its Gibbs vector w = u + d; |d|², d, and the cofactors of ∂G/∂u at u."""

    p0: float
    p1: float
    p2: float
    p3: float
    w1: float
    w2: float
    w3: float
    first: float
    d1: float
    d2: float
    d3: float
    c11: float
    c12: float
    c13: float
    c21: float
    c22: float
    c23: float
    c31: float
    c32: float
    c33: float


def newton_round(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, heavy=False):
    """A Newton iterate from u."""
    if heavy:
        p0, p1, p2, p3, c11, c12, c13, c21, c22, c23, c31, c32, c33 = gibbs_newton_heavy(
            u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D
        )
    else:
        p0, p1, p2, p3, c11, c12, c13, c21, c22, c23, c31, c32, c33 = gibbs_newton(
            u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D
        )
    scale = 1.0 / p0
    w1, w2, w3 = p1 * scale, p2 * scale, p3 * scale
    d1, d2, d3 = w1 - u1, w2 - u2, w3 - u3
    first = d1 * d1 + (d2 * d2 + d3 * d3)
    return Round(p0, p1, p2, p3, w1, w2, w3, first, d1, d2, d3, c11, c12, c13, c21, c22, c23, c31, c32, c33)


def second_round(r, k1, k2, k3, I1, I2, I3):
    """The second correction e after a round: (p1, p2, p3, w1, w2, w3, |e|²)."""
    e1, e2, e3 = gibbs_second(
        r.d1, r.d2, r.d3, k1, k2, k3, r.c11, r.c12, r.c13, r.c21, r.c22, r.c23, r.c31, r.c32, r.c33, I1, I2, I3
    )
    scale = 1.0 / r.p0
    p1, p2, p3 = r.p1 - e1, r.p2 - e2, r.p3 - e3
    second = (e1 * e1 + (e2 * e2 + e3 * e3)) * (scale * scale)
    return p1, p2, p3, p1 * scale, p2 * scale, p3 * scale, second


def settle(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, radius, enough, heavy=False):
    """One round from a guess of the Gibbs vector: a Newton iterate, and a second correction where it is needed.

    Returns (settled, p0, p1, p2, p3, u1, u2, u3): the rotation as a quaternion of any length, and as a Gibbs vector.
    """
    if not u1 * u1 + (u2 * u2 + u3 * u3) <= radius:
        return False, 1.0, 0.0, 0.0, 0.0, u1, u2, u3
    r = newton_round(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, heavy)
    if r.first <= enough:
        return True, r.p0, r.p1, r.p2, r.p3, r.w1, r.w2, r.w3
    p1, p2, p3, w1, w2, w3, second = second_round(r, k1, k2, k3, I1, I2, I3)
    settled = 9.0 * max(r.first, second) * second <= enough * enough and w1 * w1 + (w2 * w2 + w3 * w3) <= radius
    return settled, r.p0, p1, p2, p3, w1, w2, w3


def search(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, radius, enough, heavy=False):
    """Rounds of `settle` from a poor guess, and from no rotation where that leads nowhere; returns as it does."""
    for guess in range(2):
        if guess == 1:
            u1, u2, u3 = 0.0, 0.0, 0.0
        for _ in range(MOST_ROUNDS):
            settled, p0, p1, p2, p3, u1, u2, u3 = settle(
                u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, radius, enough, heavy
            )  # fmt: skip
            if settled:
                return True, p0, p1, p2, p3, u1, u2, u3
    return False, 1.0, 0.0, 0.0, 0.0, u1, u2, u3


def search_safely(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, radius, enough):
    """`search` by the certificate, and for a heavy ball by `bound`; nothing where it does not reach, or underflows.

    A heavy ball is scaled anew, as that with a tiny momentum is not, and products of its D would overflow.
    """
    heavy = is_heavy(I1, I2, I3, D)
    if heavy and max(abs(k1), abs(k2), abs(k3)) < min(I1, I2, I3):
        _, size = frexp(max(I1, I2, I3) + D)
        I1, I2, I3, D = ldexp(I1, -size), ldexp(I2, -size), ldexp(I3, -size), ldexp(D, -size)
        k1, k2, k3 = ldexp(k1, -size), ldexp(k2, -size), ldexp(k3, -size)
        if min(I1, I2, I3) >= LIGHTEST and max(abs(k1), abs(k2), abs(k3)) >= LIGHTEST:
            radius, enough = bound(k1, k2, k3, I1, I2, I3, D)
    if not radius >= 0.0:
        return False, 1.0, 0.0, 0.0, 0.0, u1, u2, u3
    return search(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, radius, enough, heavy)
