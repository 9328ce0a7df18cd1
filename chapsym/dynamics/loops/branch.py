"""The small-rotation branch: the rotation with a given momentum, continued from the identity.

For fixed γ the branch is the curve q(t) with 𝒦(q(t), γ) = t𝒦 that starts at q(0) = 1 and is followed
up to t = 1 while its Jacobian is regular.  Around a point p of the curve write q ∝ p ∘ (1, w):
F(w) = 𝒦(p ∘ (1, w), γ) - t𝒦(1 + |w|²) is *quadratic* in w.  So the Newton-Kantorovich test needs no
estimate: with T = F'(0) it asks that |T⁻¹F(0)| · |T⁻¹F''| ≤ 1/2, and F'' is constant.  Each
continuation step is as long as the test allows, hence it stays on the branch; where the steps shrink
to nothing is the fold.

The equation does not know units: J, D and 𝒦 are first scaled by a power of two, exactly, so that the
largest moment of inertia is about 1.  No rotation has |𝒦| > 2Λmax, so the path need not go further.
"""

from math import frexp, ldexp, sqrt

from chapsym.generated import compose, residual, tangent_hessian, tangent_jacobian

from .gibbs import is_heavy

TAKEN, FOLDED, NOT_CONVERGED, NO_INERTIA = 0, 1, 2, 4

#: The Kantorovich number that a continuation step may have; the theorem asks for at most 1/2.
CONTRACTION = 0.25
#: A correction below this, relative to the rotation, is the last one: Newton squares it.
SETTLED = 1e-9
#: So is one that is below this many roundings of the residual, and shrinks no more.
ROUNDINGS = 16.0
UNIT_ROUNDOFF = 2.0**-53
#: Nor can a correction get below a few of the smallest numbers that float64 has.
SMALLEST = 2.0**-1070
#: A continuation step below this fraction of what is behind it is a fold.
SHORTEST = 4e-16
#: So is one below this fraction of what is behind it and of what is before it, for numbers with more digits.
FAR = 1e-19
#: A smaller momentum than 2^LEAST, where Λmax is below 1, is taken so large, and the rotation made as much smaller:
#: what is not linear is below 2^(2 LEAST), and no product underflows.
LEAST = -200
#: The path is followed as far as a momentum of 2^FARTHEST, where Λmax is below 1.
FARTHEST = 3
#: A determinant of the tangent Jacobian below this, for Λmax about 1, is rounding.
SINGULAR = 2.0**-50
MOST_STEPS = 20000
MOST_CORRECTIONS = 20


def small_rotation(K1, K2, K3, g1, g2, g3, J1, J2, J3, D):
    """Solves 𝒦(q, γ) = 𝒦 on the small-rotation branch; returns as `continued`."""
    return continued(K1, K2, K3, g1, g2, g3, J1, J2, J3, D, SHORTEST)


def continued(K1, K2, K3, g1, g2, g3, J1, J2, J3, D, shortest):
    """The small-rotation branch up to the momentum 𝒦; a step below `shortest` is taken for a fold.

    Returns (status, reach, q0, q1, q2, q3): the unit Euler parameters with q0 ≥ 0, and the fraction t
    that was attained, 1 when the status is TAKEN.
    """
    if K1 != K1 or K2 != K2 or K3 != K3:  # a product of the caller overflowed
        return NOT_CONVERGED, 0.0, 1.0, 0.0, 0.0, 0.0
    _, exponent = frexp(max(J2 + J3, J1 + J3, J1 + J2) + D)
    J1, J2, J3, D = ldexp(J1, -exponent), ldexp(J2, -exponent), ldexp(J3, -exponent), ldexp(D, -exponent)
    largest = max(abs(K1), abs(K2), abs(K3))
    _, size = frexp(largest)
    shift = min(-exponent, FARTHEST - size) if largest > 0.0 else -exponent
    beyond = max(0, LEAST - (size + shift)) if largest > 0.0 else 0
    K1, K2, K3 = ldexp(K1, shift + beyond), ldexp(K2, shift + beyond), ldexp(K3, shift + beyond)
    end = ldexp(1.0, shift + exponent)
    t = 0.0  # of the path up to `end` times the momentum
    q0, q1, q2, q3 = 1.0, 0.0, 0.0, 0.0
    for _ in range(MOST_STEPS):
        det, speed, bend, d1, d2, d3 = tangent(q0, q1, q2, q3, K1, K2, K3, g1, g2, g3, J1, J2, J3, D)
        if t == 0.0 and not det > SINGULAR:
            return NO_INERTIA, 0.0, q0, q1, q2, q3
        if not det > 0.0:
            return FOLDED, t * end, q0, q1, q2, q3
        # The longest step with speed·step·(bend + 2(t + step)·speed) ≤ CONTRACTION.
        slope = bend + 2.0 * t * speed
        length = 2.0 * CONTRACTION / (slope + sqrt(slope * slope + 8.0 * CONTRACTION))
        remaining = 1.0 - t
        step = remaining if speed * remaining <= length else length / speed
        if step < remaining and step < max(shortest * t, FAR * min(t, remaining)):
            return FOLDED, t * end, q0, q1, q2, q3
        ahead = 1.0 if step == remaining else t + step
        p0, p1, p2, p3 = turned(q0, q1, q2, q3, step * d1, step * d2, step * d3)
        settled, p0, p1, p2, p3 = corrected(
            p0, p1, p2, p3, ahead * K1, ahead * K2, ahead * K3, g1, g2, g3, J1, J2, J3, D
        )
        if not settled:
            return NOT_CONVERGED, t * end, q0, q1, q2, q3
        t, q0, q1, q2, q3 = ahead, p0, p1, p2, p3
        if t == 1.0 and end < 1.0:  # past what any rotation has: the fold was missed
            return NOT_CONVERGED, end, q0, q1, q2, q3
        if t == 1.0:
            if q0 < 0.0:
                q0, q1, q2, q3 = -q0, -q1, -q2, -q3
            return TAKEN, 1.0, q0, ldexp(q1, -beyond), ldexp(q2, -beyond), ldexp(q3, -beyond)
    return NOT_CONVERGED, t * end, q0, q1, q2, q3


def tangent(q0, q1, q2, q3, K1, K2, K3, g1, g2, g3, J1, J2, J3, D):
    """The direction of the curve, d = T⁻¹𝒦, and what bounds the step along it.

    Returns (det T, |d|, |T⁻¹𝒦''|, d1, d2, d3), with the Frobenius norm of T⁻¹𝒦''.
    """
    det, i11, i12, i13, i21, i22, i23, i31, i32, i33 = inverse(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D)
    h = tangent_hessian(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D)
    bend = 0.0
    for pair in range(6):
        x, y, z = h[3 * pair], h[3 * pair + 1], h[3 * pair + 2]
        a, b, c = i11 * x + i12 * y + i13 * z, i21 * x + i22 * y + i23 * z, i31 * x + i32 * y + i33 * z
        weight = 1.0 if pair < 3 else 2.0
        bend += weight * (a * a + b * b + c * c)
    d1 = i11 * K1 + i12 * K2 + i13 * K3
    d2 = i21 * K1 + i22 * K2 + i23 * K3
    d3 = i31 * K1 + i32 * K2 + i33 * K3
    return det, sqrt(d1 * d1 + d2 * d2 + d3 * d3), sqrt(bend), d1, d2, d3


def corrected(q0, q1, q2, q3, K1, K2, K3, g1, g2, g3, J1, J2, J3, D):
    """Newton's iteration at a fixed momentum; returns (settled, q0, q1, q2, q3)."""
    size = max(abs(K1), abs(K2), abs(K3))
    top = max(J2 + J3, J1 + J3, J1 + J2) + D
    before = 2.0
    for _ in range(MOST_CORRECTIONS):
        r1, r2, r3 = residual(q0, q1, q2, q3, K1, K2, K3, g1, g2, g3, J1, J2, J3, D)
        det, i11, i12, i13, i21, i22, i23, i31, i32, i33 = inverse(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D)
        if det == 0.0:
            return False, q0, q1, q2, q3
        w1 = -(i11 * r1 + i12 * r2 + i13 * r3)
        w2 = -(i21 * r1 + i22 * r2 + i23 * r3)
        w3 = -(i31 * r1 + i32 * r2 + i33 * r3)
        q0, q1, q2, q3 = turned(q0, q1, q2, q3, w1, w2, w3)
        change = max(abs(w1), abs(w2), abs(w3))
        extent = max(abs(q1), abs(q2), abs(q3))
        largest = max(abs(i11), abs(i12), abs(i13), abs(i21), abs(i22), abs(i23), abs(i31), abs(i32), abs(i33))
        noise = ROUNDINGS * UNIT_ROUNDOFF * largest * (size + 2.0 * top * extent)
        if change <= max(SETTLED * extent, SMALLEST):
            return True, q0, q1, q2, q3
        # Corrections that are rounding no longer shrink as Newton's do.
        if change <= noise and change >= 0.25 * before:
            return True, q0, q1, q2, q3
        before = change
    return False, q0, q1, q2, q3


def inverse(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D):
    """det T and T⁻¹, row by row, of the tangent Jacobian T; zeros if T is singular."""
    a11, a12, a13, a21, a22, a23, a31, a32, a33 = tangent_jacobian(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D)
    det, i11, i12, i13, i21, i22, i23, i31, i32, i33 = inverse_of(a11, a12, a13, a21, a22, a23, a31, a32, a33)
    if det == 0.0 or not is_heavy(J2 + J3, J1 + J3, J1 + J2, D):
        return det, i11, i12, i13, i21, i22, i23, i31, i32, i33
    # Lemma `stable-determinant`: γᵀT does not know D, and γᵀT T⁻¹γ = |γ|² would hold if `det` had no rounding of D³.
    a11, a12, a13, a21, a22, a23, a31, a32, a33 = tangent_jacobian(q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, 0.0 * D)
    y1, y2, y3 = g1 * a11 + g2 * a21 + g3 * a31, g1 * a12 + g2 * a22 + g3 * a32, g1 * a13 + g2 * a23 + g3 * a33
    z1, z2, z3 = i11 * g1 + i12 * g2 + i13 * g3, i21 * g1 + i22 * g2 + i23 * g3, i31 * g1 + i32 * g2 + i33 * g3
    true = (y1 * z1 + y2 * z2 + y3 * z3) / (g1 * g1 + g2 * g2 + g3 * g3)
    if true == 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    s = 1.0 / true
    return det * true, s * i11, s * i12, s * i13, s * i21, s * i22, s * i23, s * i31, s * i32, s * i33


def inverse_of(a11, a12, a13, a21, a22, a23, a31, a32, a33):
    """The determinant and the inverse of a 3×3 matrix of any numbers, row by row; zeros if it is singular."""
    c11, c12, c13 = a22 * a33 - a23 * a32, a23 * a31 - a21 * a33, a21 * a32 - a22 * a31
    c21, c22, c23 = a13 * a32 - a12 * a33, a11 * a33 - a13 * a31, a12 * a31 - a11 * a32
    c31, c32, c33 = a12 * a23 - a13 * a22, a13 * a21 - a11 * a23, a11 * a22 - a12 * a21
    det = a11 * c11 + a12 * c12 + a13 * c13
    if det == 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    s = 1.0 / det
    return det, c11 * s, c21 * s, c31 * s, c12 * s, c22 * s, c32 * s, c13 * s, c23 * s, c33 * s


def turned(q0, q1, q2, q3, w1, w2, w3):
    """q ∘ (1, w), normalised."""
    p0, p1, p2, p3 = compose(q0, q1, q2, q3, 1.0, w1, w2, w3)
    length = sqrt(p0 * p0 + p1 * p1 + p2 * p2 + p3 * p3)
    return p0 / length, p1 / length, p2 / length, p3 / length
