"""The root of a step in the Gibbs vector u = q/q₀: one Newton iterate from a good guess, with an error bound.

With k = 𝒦/2 the step solves G(u) = B(γ)u + u × Iu - (1 + |u|²)k = 0.  Lemma `small-branch`: if |𝒦| is below a bound, a
root with |u| < 1 is on the small-rotation branch, for every γ, and in the ball |u| ≤ `radius` the Jacobian A satisfies
⟨d, Ad⟩ ≥ m|d|².  As |𝒦| is an integral of the map, the bound is tested once for a trajectory.  A Newton correction d
leaves an error of at most c|d|², c = (½(I_max - I_min) + |k|)/m; a second correction e with the same cofactors, at most
3c|d||e|.  These are compared with |u| ≥ |k|/(Λmax + ½(I_max - I_min)).

For D ≫ I the expansion by a row gives det A, and so u, rounding errors ∝ D/I.  Such a ball is called heavy, and needs
the determinant of lemma `stable-determinant`.  Long steps compute it in all lanes (`lanes.iterate`); steps of the map
have no certificate for such a ball, and use `search_safely` or the continuation.
"""

from math import frexp, ldexp, sqrt
from typing import NamedTuple

from chapsym.generated import gibbs_mixed, gibbs_newton, gibbs_newton_heavy, gibbs_second

from .text import Four, Nine, Three
from .vectors import adjoint, largest, length, minus, plus, scaled, shifted, square

#: The permitted error after the last correction, relative to the lower bound of |u|: the unit roundoff.
LEFT = 2.0**-53
#: An `enough` below this cannot be compared with squares; this occurs only in float32, by its small exponent range.
LEAST_ENOUGH = 0.0
#: The usable fraction of the bound, at which the Jacobian is singular.
INSIDE = 0.95
MOST_ROUNDS = 12
#: Below this, for Λmax about 1, the squares of |𝒦| or of a determinant leave the range of float64.
SMALLEST = 2.0**-120
#: The same for a heavy ball, whose det is I D², and for which only squares are computed.
LIGHTEST = 2.0**-300
#: The D/I_min above which a ball is heavy: by a row u loses up to D/(2 I_min) ulps, D/(12 I_min) in the median.
HEAVY = 32.0
#: The value of radius² if |𝒦| is beyond the bound, where each root must be proved to be on the branch (`path`).
BEYOND = -2.0
#: The values for float32: a momentum below 2^-48, for Λmax = 1, turns 𝒦 and γ by less than compensated sums resolve.
SINGLE = {"LEFT": 2.0**-24, "SMALLEST": 2.0**-48, "LIGHTEST": 2.0**-48, "LEAST_ENOUGH": 2.0**-62}


def is_heavy(I, D):
    """Whether a ball is heavy: the expansion of the determinant by a row is too inaccurate."""
    return HEAVY * min(*I) < D


def certificate(k, I, D):
    """`bound` for a ball that is not heavy, otherwise (-1, 0)."""
    heavy = is_heavy(I, D)
    radius, enough = bound(k, I, D)
    return -1.0 if heavy else radius, 0.0 if heavy else enough


def bound(k, I, D):
    """(radius², enough) by lemma `small-branch`; (BEYOND, 0) if |𝒦| is beyond its bound.

    A Newton correction d with |d|² ≤ enough is the last: it leaves a relative error of at most `LEFT`.  Without
    branches, so that loops of lanes vectorise it; (-1, 0) if `enough` cannot be compared.
    """
    half = length(k)
    size = 2.0 * half
    least, most = min(*I), max(*I)
    spread = 0.5 * (most - least)
    # tan(½ arcsin(|𝒦|/I_min)): the root is within.  Beyond I_min the 1 is outside, too, as the slope is above I_min.
    inner = size / (least + sqrt((least - size) * (least + size))) if size < least else 1.0
    slope = spread + size
    inside = inner * slope < INSIDE * least
    limit = min(1.0, least / slope) if slope > 0.0 else 1.0
    # A little more than the ball that contains the root, within the ball on which G is monotone.
    radius = min(1.25 * inner, 0.5 * (inner + limit))
    contraction = (spread + half) / (least - radius * slope) if inside else 1.0
    enough = LEFT * half / ((most + D + spread) * contraction) if half > 0.0 else 0.0
    slow = enough < (LEAST_ENOUGH if largest(k) > 0.0 else 0.0)
    radius, enough = -1.0 if slow else radius * radius, 0.0 if slow else enough
    return radius if inside else BEYOND, enough if inside else 0.0


class Round(NamedTuple):
    """A Newton iterate: a quaternion p and its Gibbs vector w = u + d; |d|², d, and the cofactors of ∂G/∂u at u."""

    p: Four
    w: Three
    first: float
    d: Three
    cofactors: Nine


def newton_round(u, k, g, I, D, heavy=False):
    """A Newton iterate from u."""
    if heavy:
        return round_from(u, gibbs_newton_heavy(*u, *k, *g, *I, D))
    return round_from(u, gibbs_newton(*u, *k, *g, *I, D))


def round_from(u, found):
    """The iterate from u, from the quaternion and the cofactors of a kernel."""
    w = scaled(1.0 / found[0], found[1:4])
    d = minus(w, u)
    return Round(found[0:4], w, square(d), d, found[4:13])


def second_round(r, k, I):
    """The second correction e after a round: (p, w, |e|²)."""
    e = gibbs_second(*r.d, *k, *r.cofactors, *I)
    scale = 1.0 / r.p[0]
    v = minus(r.p[1:4], e)
    return (r.p[0], *v), scaled(scale, v), square(e) * (scale * scale)


def correction(det, d, cofactors, r, k, I):
    """e with G(w + e) ≈ 0 for G(w) = r, by the Jacobian of the round that led to w by d."""
    s = -1.0 / det
    e = scaled(s, adjoint(cofactors, r))
    return plus(e, scaled(s, gibbs_mixed(*plus(d, scaled(0.5, e)), *e, *k, *cofactors, *I)))


def settle(u, k, g, I, D, radius, enough, heavy=False):
    """A round from a guess u, with a second correction if needed: (settled, p, u), p of any length."""
    if not square(u) <= radius:
        return False, (1.0, 0.0, 0.0, 0.0), u
    r = newton_round(u, k, g, I, D, heavy)
    if r.first <= enough:
        return True, r.p, r.w
    p, w, second = second_round(r, k, I)
    return 9.0 * max(r.first, second) * second <= enough * enough and square(w) <= radius, p, w


def search(u, k, g, I, D, radius, enough, heavy=False):
    """Rounds of `settle` from a poor guess, then from the identity if these fail; returns as `settle`."""
    for guess in range(2):
        if guess == 1:
            u = 0.0, 0.0, 0.0
        for _ in range(MOST_ROUNDS):
            settled, p, u = settle(u, k, g, I, D, radius, enough, heavy)
            if settled:
                return True, p, u
    return False, (1.0, 0.0, 0.0, 0.0), u


def search_safely(u, k, g, I, D, radius, enough):
    """`search` by the certificate, or for a heavy ball by `bound`; not settled beyond it, or on underflow.

    A heavy ball is rescaled: with a tiny momentum it is not yet scaled, and products of its D would overflow.
    """
    heavy = is_heavy(I, D)
    if heavy and largest(k) < min(*I):
        _, size = frexp(max(*I) + D)
        I, D, k = shifted(I, -size), ldexp(D, -size), shifted(k, -size)
        if min(*I) >= LIGHTEST and largest(k) >= LIGHTEST:
            radius, enough = bound(k, I, D)
    if not radius >= 0.0:
        return False, (1.0, 0.0, 0.0, 0.0), u
    return search(u, k, g, I, D, radius, enough, heavy)
