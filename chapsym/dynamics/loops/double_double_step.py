"""One step in double-double: the float64 root, corrected once by a residual in pairs.

Let w be a float64 Gibbs vector near the root of
G(u) = B(γ)u + u × Iu - (1 + |u|²)k, found by a Newton correction d, and A the Jacobian before d, in float64.  G(w) in
pairs is as exact as its terms allow, so e = -A⁻¹G(w) is the error of w to a few parts in 2⁵³, up to what A misses: by
`gibbs-newton` that is exactly 2b(d, e) + b(e, e), b the quadratic part of G, and a second solution takes it back.
There is left at most the square of c|d|, below 2⁻⁵³ where d settled (`dynamics.gibbs`), and the rounding of A⁻¹, each
times |e|.  So where |e| is a few roundings of w, (w, e) has the error of a pair times the condition of A; where it
is more, the rotation of w + e is corrected afresh, in Euler parameters (`polished`).
"""

from math import frexp, sqrt

from chapsym.generated import compose, gibbs_mixed, gibbs_residual, residual
from chapsym.numbers.loose import Loose, Normal, square_root

from .branch import FOLDED, NOT_CONVERGED, TAKEN, inverse, product, small_rotation
from .gibbs import BEYOND, MOST_ROUNDS, certificate, newton_round
from .loop import HIGHEST
from .path import search_on_path
from .vectors import dot, exact, highs, largest, normalised_four, of_length_one, plus, scaled, square, summed

#: |e|² relative to |w|² from which the sum is corrected once more: 8 roundings of float64.
SMALL = 2.0**-100
#: Corrections in pairs: at a fold each may gain but little.
MOST_CORRECTIONS = 60
#: A correction of q, relative to |q|, that is a rounding of a pair; and one below which it may stop to shrink.
ROUNDING, FLOOR = 2.0**-104, 2.0**-60
#: The largest correction: a fold that is one of rounding is so near to the root; a root of float64 has digits.
BESIDE_FOLD, ANYWHERE = 1e-6, 0.1
#: Instead of q₀ = 0, a rotation by π, which has no Gibbs vector: it is off by less than a rounding.
LEAST_COSINE = 2.0**-110
#: Above this part of 𝒦 a fold of the float64 continuation may be one of rounding.
NEARLY = 1.0 - 2.0**-45
#: Scaled momenta are at least so large.  Then no product underflows, and what is not linear in 𝒦 is below 2^-200.
LEAST = -200
#: A moment of inertia below this, for Λmax about 1, has a determinant beyond float64: every step takes the safe way.
SMALLEST = 2.0**-120


def unit(v):
    """A vector of floats divided by its length, as pairs."""
    x = exact(v)
    length = square_root(dot(x, x))
    return x[0] / length, x[1] / length, x[2] / length


def scales(momentum, tensor, contact):
    """Exponents (shift, beyond): k = 2^shift 𝒦, exactly, for Λmax about 1; tiny momenta are 2^beyond times as large."""
    _, exponent = frexp(max(tensor[1] + tensor[2], tensor[0] + tensor[2], tensor[0] + tensor[1]) + contact)
    most = max(abs(momentum[0]), abs(momentum[1]), abs(momentum[2]))
    _, size = frexp(most)
    exponent = max(exponent, size - HIGHEST)  # k does not overflow
    beyond = max(0, LEAST - (size - exponent)) if most > 0.0 else 0
    return beyond - exponent - 1, beyond


def bounds(k, I, D):
    """(radius², enough) by the certificate of |𝒦|; radius² = -1 where every step takes the safe way."""
    if min(*I) < SMALLEST:
        return -1.0, 0.0
    return certificate(k, I, D)


def approach(u, k, g, I, D, radius, enough):
    """Newton's iteration in float64: the last round."""
    r = newton_round(u, k, g, I, D)
    for _ in range(MOST_ROUNDS - 1):
        if r.first <= enough or radius < 0.0:
            break
        r = newton_round(r.w if square(r.w) <= radius else (0.0, 0.0, 0.0), k, g, I, D)
    return r


def correction(det, d, cofactors, r, k, I):
    """e with G(w + e) = 0 for G(w) = r, by the Jacobian of the round that led to w by d."""
    c, s = cofactors, -1.0 / det
    e1 = s * (c[0] * r[0] + c[3] * r[1] + c[6] * r[2])
    e2 = s * (c[1] * r[0] + c[4] * r[1] + c[7] * r[2])
    e3 = s * (c[2] * r[0] + c[5] * r[1] + c[8] * r[2])
    e = e1, e2, e3
    return plus(e, scaled(s, gibbs_mixed(*plus(d, scaled(0.5, e)), *e, *k, *c, *I)))


def small(w, e):
    """Whether e is a few roundings of w."""
    return square(e) <= SMALL * square(w)


def polished(p, k, g, J, D, near):
    """Newton's iteration in pairs from a float64 rotation near the root: (settled, u as pairs).

    In Euler parameters, so that it is regular at every rotation, and with their residual again at each pair: so it
    keeps its digits for heavy balls, too, where one correction by a float64 Jacobian leaves those of D/I.  Up to its
    fold the branch has det > 0, and its mirror behind the fold det < 0: det ≤ 0 or a correction above `near` means
    another branch.
    """
    K, v, floats = sums_normal(plus(k, k)), sums_normal(g), highs(g)
    q, before, settled = (Loose(p[0], 0.0), Loose(p[1], 0.0), Loose(p[2], 0.0), Loose(p[3], 0.0)), near, False
    for _ in range(MOST_CORRECTIONS):
        r = residual(Normal(q[0].high, q[0].low), *sums_normal(q[1:4]), *K, *v, *exact(J), Loose(D))
        det, n = inverse((q[0].high, *highs(q[1:4])), floats, J, D)
        if not det > 0.0:
            break
        w = product(n, (r[0].normalised().high, r[1].normalised().high, r[2].normalised().high))
        q = normalised_four(of_length_one(compose(*q, 1, Loose(-w[0]), Loose(-w[1]), Loose(-w[2]))))
        change, extent = largest(w), largest(highs(q[1:4]))
        if change > near:
            break
        # The last correction is a rounding of pairs, or one that the condition leaves: it shrinks no more.
        settled = change <= ROUNDING * extent or (change <= FLOOR * extent and change >= 0.25 * before)
        if settled:
            break
        before = change
    cosine = q[0]
    if cosine.high == 0.0:
        cosine = Loose(LEAST_COSINE, q[0].low)
    return settled, (q[1] / cosine, q[2] / cosine, q[3] / cosine)


def sums_normal(v):
    """A vector of pairs of which sums are normalised."""
    return Normal(v[0].high, v[0].low), Normal(v[1].high, v[1].low), Normal(v[2].high, v[2].low)


def solved(u, k, g, I, J, D, radius, enough):
    """The Gibbs vector of a step from a guess u, with k, γ and I in pairs: (status, reach, u as pairs)."""
    floats, vertical, inertia, zero = highs(k), highs(g), highs(I), Loose(0.0, 0.0)
    r = approach(u if square(u) <= radius else (0.0, 0.0, 0.0), floats, vertical, inertia, D, radius, enough)
    settled, w, status, reach = radius >= 0.0 and r.first <= enough, r.w, TAKEN, 1.0
    if settled:
        G = gibbs_residual(*exact(w), *k, *g, *I, Loose(D))
        left = G[0].normalised().high, G[1].normalised().high, G[2].normalised().high
        e = correction(r.p[0], r.d, r.cofactors, left, floats, inertia)
        if small(w, e):
            return TAKEN, 1.0, summed(w, e)
        p = rotation_of(plus(w, e))
    else:
        if radius == BEYOND:
            settled, p, w = search_on_path(u, floats, vertical, inertia, D)
        if settled:
            p = rotation_of(w)
        else:
            status, reach, p0, p1, p2, p3 = small_rotation(*scaled(2.0, floats), *vertical, *J, D)
            p = p0, p1, p2, p3
        # So near to 1 float64 does not see on which side of the fold 𝒦 is; pairs do.
        if status != TAKEN and not (status == FOLDED and reach > NEARLY):
            return status, reach, (zero, zero, zero)
    settled, found = polished(p, k, g, J, D, BESIDE_FOLD if status == FOLDED else ANYWHERE)
    if settled:
        return TAKEN, 1.0, found
    return FOLDED if status == FOLDED else NOT_CONVERGED, reach, (zero, zero, zero)


def rotation_of(w):
    """The Euler parameters of a Gibbs vector."""
    p0 = 1.0 / sqrt(1.0 + square(w))
    return p0, p0 * w[0], p0 * w[1], p0 * w[2]
