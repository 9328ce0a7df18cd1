"""The small-rotation branch: the rotation with a given momentum, continued from the identity.

For fixed γ the branch is the curve q(t) with 𝒦(q(t), γ) = t𝒦 that starts at q(0) = 1 and is followed to t = 1 while its
Jacobian is regular.  Near a point p of the curve write q ∝ p ∘ (1, w): F(w) = 𝒦(p ∘ (1, w), γ) - t𝒦(1 + |w|²) is
*quadratic* in w, and F'' is constant.  So the Newton-Kantorovich test, |T⁻¹F(0)| · |T⁻¹F''| ≤ 1/2 with T = F'(0), needs
no estimate of F''.  Each continuation step is as long as the test allows, so it stays on the branch; at a fold the
steps shrink to 0.

The equation is homogeneous: J, D and 𝒦 are first scaled by a power of two, exactly, so that the largest moment of
inertia is about 1.  No rotation has |𝒦| > 2Λmax, so the path need not go further.
"""

from math import frexp, ldexp, sqrt

from chapsym.generated import compose, residual, tangent_hessian, tangent_jacobian

from .gibbs import is_heavy
from .vectors import dot, largest, scaled, shifted

TAKEN, FOLDED, NOT_CONVERGED, NO_INERTIA = 0, 1, 2, 4

#: The largest Kantorovich number of a continuation step; the theorem requires at most 1/2.
CONTRACTION = 0.25
#: A correction below this, relative to the rotation, is the last one, as Newton's method squares the error.
SETTLED = 1e-9
#: A correction below this many rounding errors of the residual is the last one if it no longer decreases.
ROUNDINGS = 16.0
UNIT_ROUNDOFF = 2.0**-53
#: The least correction that is significant: a few of the smallest numbers of float64.
SMALLEST = 2.0**-1070
#: A continuation step below this fraction of the path so far means a fold.
SHORTEST = 4e-16
#: The same fraction for numbers with more digits, of the path so far and of the path left.
FAR = 1e-19
#: A momentum below 2^LEAST, for Λmax below 1, is scaled up to it, and the rotation is scaled back: nonlinear terms are
#: below 2^(2 LEAST), and no product underflows.
LEAST = -200
#: The path is followed up to a momentum of 2^FARTHEST, for Λmax below 1.
FARTHEST = 3
#: A determinant of the tangent Jacobian below this, for Λmax about 1, is a rounding error.
SINGULAR = 2.0**-50
MOST_STEPS = 20000
MOST_CORRECTIONS = 20


def small_rotation(K1, K2, K3, g1, g2, g3, J1, J2, J3, D):
    """The solution of 𝒦(q, γ) = 𝒦 on the small-rotation branch: (status, reach, q0, q1, q2, q3), as `continued`."""
    status, reach, q = continued((K1, K2, K3), (g1, g2, g3), (J1, J2, J3), D, SHORTEST)
    return status, reach, *q


def continued(K, g, J, D, shortest):
    """The small-rotation branch up to the momentum 𝒦; a step below `shortest` means a fold.

    Returns (status, reach, q): q are unit Euler parameters with q0 ≥ 0; reach is the attained fraction t, 1 for the
    status TAKEN.
    """
    q = 1.0, 0.0, 0.0, 0.0
    if K[0] != K[0] or K[1] != K[1] or K[2] != K[2]:  # the caller overflowed
        return NOT_CONVERGED, 0.0, q
    _, exponent = frexp(max(*moments(J)) + D)
    J, D = shifted(J, -exponent), ldexp(D, -exponent)
    most = largest(K)
    _, size = frexp(most)
    shift = min(-exponent, FARTHEST - size) if most > 0.0 else -exponent
    beyond = max(0, LEAST - (size + shift)) if most > 0.0 else 0
    K, end = shifted(K, shift + beyond), ldexp(1.0, shift + exponent)
    t = 0.0  # of the path up to `end` times the momentum
    for _ in range(MOST_STEPS):
        det, speed, bend, d = tangent(q, K, g, J, D)
        if t == 0.0 and not det > SINGULAR:
            return NO_INERTIA, 0.0, q
        if not det > 0.0:
            return FOLDED, t * end, q
        # The longest step with speed·step·(bend + 2(t + step)·speed) ≤ CONTRACTION.
        slope = bend + 2.0 * t * speed
        length = 2.0 * CONTRACTION / (slope + sqrt(slope * slope + 8.0 * CONTRACTION))
        remaining = 1.0 - t
        step = remaining if speed * remaining <= length else length / speed
        if step < remaining and step < max(shortest * t, FAR * min(t, remaining)):
            return FOLDED, t * end, q
        ahead = 1.0 if step == remaining else t + step
        settled, p = corrected(turned(q, scaled(step, d)), scaled(ahead, K), g, J, D)
        if not settled:
            return NOT_CONVERGED, t * end, q
        t, q = ahead, p
        if t == 1.0 and end < 1.0:  # beyond the momentum of any rotation: the fold was missed
            return NOT_CONVERGED, end, q
        if t == 1.0:
            if q[0] < 0.0:
                q = -q[0], -q[1], -q[2], -q[3]
            return TAKEN, 1.0, (q[0], *shifted(q[1:4], -beyond))
    return NOT_CONVERGED, t * end, q


def moments(J):
    """The moments of inertia."""
    return J[1] + J[2], J[0] + J[2], J[0] + J[1]


def tangent(q, K, g, J, D):
    """(det T, |d|, |T⁻¹𝒦''|, d): the direction d = T⁻¹𝒦 of the curve, and the numbers that bound the step."""
    det, n = inverse(q, g, J, D)
    h = tangent_hessian(*q, *g, *J, D)
    bend = 0.0
    for pair in range(6):
        w = product(n, (h[3 * pair], h[3 * pair + 1], h[3 * pair + 2]))
        weight = 1.0 if pair < 3 else 2.0
        bend += weight * dot(w, w)
    d = product(n, K)
    return det, sqrt(dot(d, d)), sqrt(bend), d


def corrected(q, K, g, J, D):
    """Newton's iteration at a fixed momentum; returns (settled, q)."""
    size = largest(K)
    top = max(*moments(J)) + D
    before = 2.0
    for _ in range(MOST_CORRECTIONS):
        r = residual(*q, *K, *g, *J, D)
        det, n = inverse(q, g, J, D)
        if det == 0.0:
            return False, q
        w = product(n, r)
        q = turned(q, (-w[0], -w[1], -w[2]))
        change, extent = largest(w), largest(q[1:4])
        most = max(largest(n[0:3]), largest(n[3:6]), largest(n[6:9]))
        noise = ROUNDINGS * UNIT_ROUNDOFF * most * (size + 2.0 * top * extent)
        if change <= max(SETTLED * extent, SMALLEST):
            return True, q
        # Corrections at the level of rounding no longer decrease as those of Newton's method.
        if change <= noise and change >= 0.25 * before:
            return True, q
        before = change
    return False, q


def product(n, v):
    """The product of a matrix, given row by row, and a vector."""
    return dot(n[0:3], v), dot(n[3:6], v), dot(n[6:9], v)


def inverse(q, g, J, D):
    """The determinant and the inverse, row by row, of the tangent Jacobian T; zeros if T is singular."""
    det, n = inverse_of(tangent_jacobian(*q, *g, *J, D))
    if det == 0.0 or not is_heavy(moments(J), D):
        return det, n
    # Lemma `stable-determinant`: γᵀT is independent of D, and γᵀT T⁻¹γ = |γ|² fails only by errors ∝ D³ of det.
    a = tangent_jacobian(*q, *g, *J, 0.0 * D)
    y = dot(g, (a[0], a[3], a[6])), dot(g, (a[1], a[4], a[7])), dot(g, (a[2], a[5], a[8]))
    true = dot(y, product(n, g)) / dot(g, g)
    if true == 0.0:
        return 0.0, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    s = 1.0 / true
    return det * true, (*scaled(s, n[0:3]), *scaled(s, n[3:6]), *scaled(s, n[6:9]))


def inverse_of(a):
    """The determinant and the inverse, row by row, of a 3×3 matrix of any numbers; zeros if it is singular."""
    a11, a12, a13, a21, a22, a23, a31, a32, a33 = a
    c11, c12, c13 = a22 * a33 - a23 * a32, a23 * a31 - a21 * a33, a21 * a32 - a22 * a31
    c21, c22, c23 = a13 * a32 - a12 * a33, a11 * a33 - a13 * a31, a12 * a31 - a11 * a32
    c31, c32, c33 = a12 * a23 - a13 * a22, a13 * a21 - a11 * a23, a11 * a22 - a12 * a21
    det = a11 * c11 + a12 * c12 + a13 * c13
    if det == 0.0:
        return 0.0, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    s = 1.0 / det
    return det, (c11 * s, c21 * s, c31 * s, c12 * s, c22 * s, c32 * s, c13 * s, c23 * s, c33 * s)


def turned(q, w):
    """q ∘ (1, w), normalised."""
    p = compose(*q, 1.0, *w)
    length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2] + p[3] * p[3])
    return p[0] / length, p[1] / length, p[2] / length, p[3] / length
