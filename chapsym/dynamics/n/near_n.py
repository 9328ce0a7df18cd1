"""For |𝒦| below a bound, any rotation by small angles with the momentum 𝒦 is the small rotation.

The argument is by hand; tests try each of its inequalities, and no claim of the register checks it.  Norms of skew
matrices are |η|² = Σ ηᵢⱼ², i > j; the angles of a rotation are those of its invariant planes.  s is the least Jᵢ + Jⱼ,
i ≠ j, and λ(φ) the least eigenvalue of [[s cos φ, -D sin φ/4], [-D sin φ/4, (s + D) cos φ]].

1. For a rotation M by angles up to φ < 90° and η skew, ⟨η, 𝒦(Mη)⟩ ≥ λ(φ)|η|².  By (4.13) the left side is
   Σ Jⱼ ηⱼᵀMηⱼ + D/2 (ζᵀMζ + ζᵀηMᵀγ), with the columns ηⱼ of η, and ζ = ηγ.  Here xᵀMx ≥ cos φ |x|², Σ Jⱼ|ηⱼ|² ≥ s|η|²,
   and Mᵀγ = aγ + w with w ⟂ γ, a ≥ cos φ and |w| ≤ sin φ.  So it is at least
   s cos φ |η|² + D/2 (2 cos φ |ζ|² - sin φ |ζ| y), where y is the part of ηw/|w| normal to γ, and |ζ|² + y² ≤ |η|².
2. If λ(r) > 0, two rotations by angles up to r have different momenta.  They are MC and MCᵀ with C² the rotation from
   one to the other, as xᵀMCx + xᵀMCᵀx > 0; so their difference is Mη with η = C - Cᵀ, and 𝒦, which is linear, is 𝒦(Mη).
   The angles of M are up to r: for an eigenvector x of M with the angle φ, 2 cos r ≤ cos φ x*(C + Cᵀ)x ≤ 2 cos φ.
   So by 1, 𝒦(Mη) = 0 only for η = 0.
3. If the largest angle of Ω is θ < 180°, then |𝒦(Ω)| ≥ 2 sin(θ/2) λ(θ/2).  With the root M of Ω, Ω - 1 = M(M - Mᵀ), and
   |M - Mᵀ| is at least 2 sin(θ/2); 1 gives |𝒦||η| ≥ λ(θ/2)|η|² for η = M - Mᵀ.

So for |𝒦| < 2 sin(r/2) λ(r/2) the branch from the identity never comes to the angle r (3), has no fold before it (1),
and at its end is the only rotation by angles up to r with the momentum 𝒦 (2).  As Σ Eᵢⱼ² is the sum of 8 sin²(θ/2) over
the planes, Σ Eᵢⱼ² ≤ 8 sin²(r/2) bounds the angles by r; the end of the branch satisfies this, by the proof of 3.
A rotation found with a residual is the small rotation of a momentum that differs from 𝒦 by the residual.
|𝒦| is an integral, so that one check at the start is enough for a trajectory.
"""

import numpy as np

from ..ball import Floats, largest_moment

#: The trial angles r, as fractions of the angle at which λ vanishes; the least sufficient one is taken.
ANGLES = np.array((0.25, 0.5, 0.75, 0.9))
#: A bound of the relative change of |𝒦| and |γ| by roundings in a trajectory.
DRIFT = 1e-6
#: For a momentum or a least moment below this times the largest moment, no bound is used.
LEAST_MOMENTUM, LEAST_MOMENT = 2.0**-200, 2.0**-30
#: No bound is used for balls whose moments are beyond 2^±MOST.
MOST = 900


def least(angle: Floats, s: Floats, D: Floats) -> Floats:
    """λ(φ)."""
    cos, sin = np.cos(angle), np.sin(angle)
    product = cos * s * (cos * (s + D)) - (D * sin / 4) ** 2
    return product / (cos * (s + D / 2) + np.hypot(cos * D / 2, D * sin / 4))


def bounds(size: Floats, J: Floats, D: Floats) -> tuple[Floats, Floats]:
    """(near, enough) for |𝒦| = size, (b, s), moments (b, n) and D (b,) of which the largest is about 1.

    near: a rotation with the momentum and Σ Eᵢⱼ² ≤ near is the small one; negative if that is not known.
    enough: a bound of the squared Newton correction over |E| that makes the next correction less than half a rounding
    of |E|: the next is at most l/2λ times that square, with l = 2 max J + D, a bound of 𝒦(Ωξ²).
    """
    s = np.sort(J, axis=-1)[:, :2].sum(axis=-1)
    r = ANGLES[:, np.newaxis] * np.arctan2(4 * np.sqrt(s * (s + D)), D)
    half, slack = np.sin(r / 2), 2.0**-53 / (2 * J.max(axis=-1) + D)
    bound = np.where(s >= LEAST_MOMENT, 2 * half * least(r / 2, s, D), -1.0)
    fits = (size * (1 + DRIFT) < bound[..., np.newaxis]) & (size >= LEAST_MOMENTUM)
    first = fits.argmax(axis=0), np.arange(len(D))[:, np.newaxis]
    return np.where(fits.any(axis=0), 8 * half[first] ** 2, -1.0), slack[:, np.newaxis] * least(r, s, D)[first]


def limits(K: Floats, J: Floats, D: Floats, stages: Floats) -> tuple[Floats, Floats]:
    """`bounds` of balls of any size, with 𝒦 (b, n, n), of the momentum cᵢ𝒦 of each stage: (b, s)."""
    exponent = np.frexp(largest_moment(J, D))[1]
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):  # no bound if all moments but one vanish
        size = np.linalg.norm(np.ldexp(K, -exponent[:, np.newaxis, np.newaxis]), axis=(-2, -1)) / np.sqrt(2)
        sizes = np.multiply.outer(size, np.abs(stages))
        near, enough = bounds(sizes, np.ldexp(J, -exponent[:, np.newaxis]), np.ldexp(D, -exponent))
    near[np.abs(exponent) > MOST] = -1.0
    return near, enough
