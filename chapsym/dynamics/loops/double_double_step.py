"""One step in double-double: the float64 root, corrected once by a residual in pairs.

Names as in `numbers.pairs`: x, x_ are the halves of x.  Let w be a float64 Gibbs vector near the root of
G(u) = B(γ)u + u × Iu - (1 + |u|²)k, found by a Newton correction d, and A the Jacobian before d, in float64.  G(w) in
pairs is as exact as its terms allow, so e = -A⁻¹G(w) is the error of w to a few parts in 2⁵³, up to what A misses: by
`gibbs-newton` that is exactly 2b(d, e) + b(e, e), b the quadratic part of G, and a second solution takes it back.
There is left at most the square of c|d|, below 2⁻⁵³ where d settled (`dynamics.gibbs`), and the rounding of A⁻¹, each
times |e|.  So where |e| is a few roundings of w, (w, e) has the error of a pair times the condition of A; where it
is more, the rotation of w + e is corrected afresh, in Euler parameters (`polished`).
"""

from math import frexp, sqrt

from chapsym.generated import gibbs_mixed
from chapsym.generated.double_double import gibbs_residual_pairs, moved_pairs, residual_pairs
from chapsym.numbers.pairs import divide, loose_add, root, two_product, two_sum

from .branch import FOLDED, NOT_CONVERGED, TAKEN, inverse, small_rotation
from .gibbs import BEYOND, MOST_ROUNDS, certificate, newton_round
from .loop import HIGHEST
from .path import search_on_path

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


def unit(a, b, c):
    """The float vector (a, b, c) divided by its length, as pairs."""
    n, n_ = loose_add(*two_product(a, a), *two_product(b, b))
    n, n_ = loose_add(n, n_, *two_product(c, c))
    n, n_ = root(*two_sum(n, n_))
    x, x_ = divide(a, 0.0, n, n_)
    y, y_ = divide(b, 0.0, n, n_)
    z, z_ = divide(c, 0.0, n, n_)
    return x, x_, y, y_, z, z_


def scales(momentum, tensor, contact):
    """Exponents (shift, beyond): k = 2^shift 𝒦, exactly, for Λmax about 1; tiny momenta are 2^beyond times as large."""
    _, exponent = frexp(max(tensor[1] + tensor[2], tensor[0] + tensor[2], tensor[0] + tensor[1]) + contact)
    largest = max(abs(momentum[0]), abs(momentum[1]), abs(momentum[2]))
    _, size = frexp(largest)
    exponent = max(exponent, size - HIGHEST)  # k does not overflow
    beyond = max(0, LEAST - (size - exponent)) if largest > 0.0 else 0
    return beyond - exponent - 1, beyond


def bounds(k1, k2, k3, I1, I2, I3, D):
    """(radius², enough) by the certificate of |𝒦|; radius² = -1 where every step takes the safe way."""
    if min(I1, I2, I3) < SMALLEST:
        return -1.0, 0.0
    return certificate(k1, k2, k3, I1, I2, I3, D)


def approach(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, radius, enough):
    """Newton's iteration in float64: the last round."""
    r = newton_round(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D)
    for _ in range(MOST_ROUNDS - 1):
        if r.first <= enough or radius < 0.0:
            break
        w1, w2, w3 = r.w1, r.w2, r.w3
        if not w1 * w1 + (w2 * w2 + w3 * w3) <= radius:
            w1, w2, w3 = 0.0, 0.0, 0.0
        r = newton_round(w1, w2, w3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D)
    return r


def correction(r, r1, r2, r3, k1, k2, k3, I1, I2, I3):
    """e with G(w + e) = 0 for G(w) = (r1, r2, r3), by the Jacobian of the round r that led to w."""
    s = -1.0 / r.p0
    e1 = s * (r.c11 * r1 + r.c21 * r2 + r.c31 * r3)
    e2 = s * (r.c12 * r1 + r.c22 * r2 + r.c32 * r3)
    e3 = s * (r.c13 * r1 + r.c23 * r2 + r.c33 * r3)
    x1, x2, x3 = gibbs_mixed(
        r.d1 + 0.5 * e1, r.d2 + 0.5 * e2, r.d3 + 0.5 * e3, e1, e2, e3, k1, k2, k3,
        r.c11, r.c12, r.c13, r.c21, r.c22, r.c23, r.c31, r.c32, r.c33, I1, I2, I3,
    )  # fmt: skip
    return e1 + s * x1, e2 + s * x2, e3 + s * x3


def small(w1, w2, w3, e1, e2, e3):
    """Whether e is a few roundings of w."""
    return e1 * e1 + (e2 * e2 + e3 * e3) <= SMALL * (w1 * w1 + (w2 * w2 + w3 * w3))


def polished(q0, q1, q2, q3, k1, k1_, k2, k2_, k3, k3_, g1, g1_, g2, g2_, g3, g3_, J1, J2, J3, D, near):
    """Newton's iteration in pairs from a float64 rotation near the root: (settled, u as pairs).

    In Euler parameters, so that it is regular at every rotation, and with their residual again at each pair: so it
    keeps its digits for heavy balls, too, where one correction by a float64 Jacobian leaves those of D/I.  Up to its
    fold the branch has det > 0, and its mirror behind the fold det < 0: det ≤ 0 or a correction above `near` means
    another branch.
    """
    q0_, q1_, q2_, q3_, before = 0.0, 0.0, 0.0, 0.0, near
    settled = False
    for _ in range(MOST_CORRECTIONS):
        r1, _, r2, _, r3, _ = residual_pairs(
            q0, q0_, q1, q1_, q2, q2_, q3, q3_, 2.0 * k1, 2.0 * k1_, 2.0 * k2, 2.0 * k2_, 2.0 * k3, 2.0 * k3_,
            g1, g1_, g2, g2_, g3, g3_, J1, J2, J3, D,
        )  # fmt: skip
        det, i11, i12, i13, i21, i22, i23, i31, i32, i33 = inverse(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D)
        if not det > 0.0:
            break
        w1 = -(i11 * r1 + i12 * r2 + i13 * r3)
        w2 = -(i21 * r1 + i22 * r2 + i23 * r3)
        w3 = -(i31 * r1 + i32 * r2 + i33 * r3)
        q0, q0_, q1, q1_, q2, q2_, q3, q3_ = moved_pairs(q0, q0_, q1, q1_, q2, q2_, q3, q3_, w1, w2, w3)
        change, extent = max(abs(w1), abs(w2), abs(w3)), max(abs(q1), abs(q2), abs(q3))
        if change > near:
            break
        # The last correction is a rounding of pairs, or one that the condition leaves: it shrinks no more.
        settled = change <= ROUNDING * extent or (change <= FLOOR * extent and change >= 0.25 * before)
        if settled:
            break
        before = change
    if q0 == 0.0:
        q0 = LEAST_COSINE
    return settled, *divide(q1, q1_, q0, q0_), *divide(q2, q2_, q0, q0_), *divide(q3, q3_, q0, q0_)


def solved(
    u1, u2, u3, k1, k1_, k2, k2_, k3, k3_, g1, g1_, g2, g2_, g3, g3_, I1, I1_, I2, I2_, I3, I3_, J1, J2, J3, D,
    radius, enough,
):  # fmt: skip
    """The Gibbs vector of a step from a guess u: (status, reach, u1, u1_, u2, u2_, u3, u3_)."""
    near = u1 * u1 + (u2 * u2 + u3 * u3) <= radius
    r = approach(
        u1 if near else 0.0, u2 if near else 0.0, u3 if near else 0.0, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, radius,
        enough,
    )  # fmt: skip
    settled, w1, w2, w3 = radius >= 0.0 and r.first <= enough, r.w1, r.w2, r.w3
    status, reach = TAKEN, 1.0
    if settled:
        r1, _, r2, _, r3, _ = gibbs_residual_pairs(
            w1, w2, w3, k1, k1_, k2, k2_, k3, k3_, g1, g1_, g2, g2_, g3, g3_, I1, I1_, I2, I2_, I3, I3_, D
        )
        e1, e2, e3 = correction(r, r1, r2, r3, k1, k2, k3, I1, I2, I3)
        if small(w1, w2, w3, e1, e2, e3):
            return TAKEN, 1.0, *two_sum(w1, e1), *two_sum(w2, e2), *two_sum(w3, e3)
        w1, w2, w3 = w1 + e1, w2 + e2, w3 + e3
        p0 = 1.0 / sqrt(1.0 + (w1 * w1 + (w2 * w2 + w3 * w3)))
        p1, p2, p3 = p0 * w1, p0 * w2, p0 * w3
    else:
        if radius == BEYOND:
            settled, p0, p1, p2, p3, w1, w2, w3 = search_on_path(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D)
        if settled:
            p0 = 1.0 / sqrt(1.0 + (w1 * w1 + (w2 * w2 + w3 * w3)))
            p1, p2, p3 = p0 * w1, p0 * w2, p0 * w3
        else:
            status, reach, p0, p1, p2, p3 = small_rotation(2.0 * k1, 2.0 * k2, 2.0 * k3, g1, g2, g3, J1, J2, J3, D)
        # So near to 1 float64 does not see on which side of the fold 𝒦 is; pairs do.
        if status != TAKEN and not (status == FOLDED and reach > NEARLY):
            return status, reach, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    settled, u1, u1_, u2, u2_, u3, u3_ = polished(
        p0, p1, p2, p3, k1, k1_, k2, k2_, k3, k3_, g1, g1_, g2, g2_, g3, g3_, J1, J2, J3, D,
        BESIDE_FOLD if status == FOLDED else ANYWHERE,
    )  # fmt: skip
    if settled:
        return TAKEN, 1.0, u1, u1_, u2, u2_, u3, u3_
    return FOLDED if status == FOLDED else NOT_CONVERGED, reach, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
