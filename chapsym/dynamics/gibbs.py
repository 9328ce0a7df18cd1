"""The fast way along a trajectory: the Gibbs vector u = q/q₀, extrapolated and corrected.

Plain scalar Python, so that the same functions run on floats and are compiled by numba.

With k = 𝒦/2 the step solves G(u) = B(γ)u + u × Iu - (1 + |u|²)k = 0.  Lemma `small-branch`: where |𝒦| is
below a bound, a root with |u| < 1 is that of the small-rotation branch, for every γ, and on the ball
|u| ≤ `radius` the Jacobian A satisfies ⟨d, Ad⟩ ≥ m|d|².  As |𝒦| is an integral of the map, the bound is looked
at once for a trajectory.  One Newton correction d and a second correction e with the same inverse leave an
error of at most (½(I_max - I_min) + |k|)(2|d| + |e|)|e|/m: that is what is checked.  A step that does not
settle takes the safe way, `branch.small_rotation`.
"""

from math import sqrt

from chapsym.generated import gibbs_newton, gibbs_second

#: The error that the last correction may leave, relative to |u|, squared: an eighth of an ulp.
LEFT = 2.0**-110
#: How much of the ball on which G is monotone may be used: at its rim the Jacobian is singular.
INSIDE = 0.95
MOST_ROUNDS = 8
#: The extrapolation goes through this many past Gibbs vectors, with these weights.
POINTS = 6


def certificate(k1, k2, k3, I1, I2, I3):
    """(radius², contraction²) of lemma `small-branch`; (-1, 0) where |𝒦| is beyond its bound.

    contraction = (½(I_max - I_min) + |k|)/m: times |d|² it bounds what a Newton correction d leaves.
    """
    size = 2.0 * sqrt(k1 * k1 + k2 * k2 + k3 * k3)
    least, most = min(I1, I2, I3), max(I1, I2, I3)
    spread = 0.5 * (most - least)
    if not size < least:
        return -1.0, 0.0
    inner = size / (least + sqrt((least - size) * (least + size)))  # tan(½ arcsin(|𝒦|/I_min))
    slope = spread + size
    if not inner * slope < INSIDE * least:
        return -1.0, 0.0
    # Between the ball that contains the root and the one on which G is monotone.
    radius = 0.5 * (inner + min(1.0, least / slope))
    contraction = (spread + 0.5 * size) / (least - radius * slope)
    return radius * radius, contraction * contraction


def settle(u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D, radius, contraction):
    """Corrects a guess of the Gibbs vector; returns (settled, u1, u2, u3)."""
    for _ in range(MOST_ROUNDS):
        if not u1 * u1 + u2 * u2 + u3 * u3 <= radius:
            return False, u1, u2, u3
        d1, d2, d3, i11, i12, i13, i21, i22, i23, i31, i32, i33 = gibbs_newton(
            u1, u2, u3, k1, k2, k3, g1, g2, g3, I1, I2, I3, D
        )
        first = contraction * (d1 * d1 + d2 * d2 + d3 * d3)
        if first * (d1 * d1 + d2 * d2 + d3 * d3) <= LEFT * (u1 * u1 + u2 * u2 + u3 * u3):
            return True, u1 + d1, u2 + d2, u3 + d3
        e1, e2, e3 = gibbs_second(
            d1, d2, d3, k1, k2, k3, i11, i12, i13, i21, i22, i23, i31, i32, i33, I1, I2, I3
        )  # fmt: skip
        u1, u2, u3 = u1 + (d1 + e1), u2 + (d2 + e2), u3 + (d3 + e3)
        second = e1 * e1 + e2 * e2 + e3 * e3
        if 9.0 * max(first, contraction * second) * second <= LEFT * (u1 * u1 + u2 * u2 + u3 * u3):
            return u1 * u1 + u2 * u2 + u3 * u3 <= radius, u1, u2, u3
    return False, u1, u2, u3
