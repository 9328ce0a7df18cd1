"""so(n) and the momentum (4.13) on arrays, for every n.

A rotation Ω is stored as E = Ω - 1: the terms of (4.13) are linear in Ω and their sum vanishes at Ω = 1, so 𝒦 is the
same function of E, and a small rotation keeps all its digits.  Vectors are (..., n), matrices (..., n, n).
"""

from functools import cache

import numpy as np

from ..ball import Floats


@cache
def places(n: int) -> tuple[np.ndarray, np.ndarray]:
    """The rows and the columns of the coordinates of a skew matrix: the entries below the diagonal."""
    return np.tril_indices(n, -1)


def coordinates(skew: Floats) -> Floats:
    """The N = n(n-1)/2 entries of a skew matrix below its diagonal, (..., N)."""
    rows, columns = places(skew.shape[-1])
    return skew[..., rows, columns]


def from_coordinates(x: Floats, n: int) -> Floats:
    """The skew matrix with the coordinates x, (..., n, n)."""
    rows, columns = places(n)
    skew = np.zeros((*x.shape[:-1], n, n), x.dtype)
    skew[..., rows, columns] = x
    skew[..., columns, rows] = -x
    return skew


@cache
def _basis(n: int) -> Floats:
    """The stacked transposes of the skew matrices with one coordinate 1, (N n, n)."""
    return np.ascontiguousarray(from_coordinates(np.eye(n * (n - 1) // 2), n).mT.reshape(-1, n))


def twist(X: Floats, gamma: Floats) -> Floats:
    """(X - Xᵀ)γ, (..., n): twice Δr/ρ of a step, in the body, γ upwards (4.9 with 2.9 as corrected)."""
    return ((X - X.mT) @ gamma[..., np.newaxis])[..., 0]


def momentum(X: Floats, gamma: Floats, J: Floats, D: Floats) -> Floats:
    """𝒦 = XJ - JXᵀ + D/2 (XΓ - ΓXᵀ + ΓX - XᵀΓ), skew, for X = Ω or Ω - 1 (prop-1, 4.13).

    As Γ = γγᵀ, the last bracket is cγᵀ - γcᵀ with c = (X - Xᵀ)γ.  J is the diagonal, (..., n); D is (...).
    """
    c = D[..., np.newaxis] / 2 * twist(X, gamma)
    half = X * J[..., np.newaxis, :] + c[..., :, np.newaxis] * gamma[..., np.newaxis, :]
    return half - half.mT


def jacobian(E: Floats, gamma: Floats, J: Floats, D: Floats) -> Floats:
    """The derivative of 𝒦 along Ω(1 + ξ), ξ skew, in coordinates, (..., N, N): 𝒦(Ωξ), as 𝒦 is linear."""
    n = E.shape[-1]
    transposed = (_basis(n) @ (E.mT + np.eye(n))).reshape(*E.shape[:-2], -1, n, n)
    columns = momentum(transposed.mT, gamma[..., np.newaxis, :], J[..., np.newaxis, :], D[..., np.newaxis])
    return coordinates(columns).mT


def turned(E: Floats, xi: Floats) -> Floats:
    """Ω·Cayley(ξ) - 1 for Cayley(ξ) = (1 - ξ/2)⁻¹(1 + ξ/2), which is 1 + (1 - ξ/2)⁻¹ξ."""
    turn = np.linalg.solve(np.eye(xi.shape[-1]) - xi / 2, xi)
    return E + turn + E @ turn


def orthogonal(E: Floats) -> Floats:
    """E of the rotation nearest to 1 + E, a rotation but for rounding, by a Newton-Schulz step."""
    defect = E + E.mT + E.mT @ E
    return E - (defect + E @ defect) / 2


def polar(R: Floats) -> Floats:
    """The rotation nearest to a nearly orthogonal R, by a Newton-Schulz step."""
    return R - R @ (R.mT @ R - np.eye(R.shape[-1])) / 2


def carried(skew: Floats, E: Floats) -> Floats:
    """ΩᵀAΩ for a skew matrix A, as A plus an increment: exactly skew."""
    first = skew @ E
    half = first + E.mT @ first / 2
    return skew + (half - half.mT)


def transported(gamma: Floats, E: Floats) -> Floats:
    """Ωᵀγ, as γ plus an increment."""
    return gamma + (E.mT @ gamma[..., np.newaxis])[..., 0]


def invariants(K: Floats, gamma: Floats) -> Floats:
    """`invariants_n` without checks, of floats or other numbers."""
    n, g = K.shape[-1], gamma[..., np.newaxis]
    square, power, moved = K @ K, np.eye(n), g
    traces, weights = [], []
    for j in range(1, n // 2 + 1):
        power, moved = power @ square, square @ moved
        traces.append(np.trace(power, axis1=-2, axis2=-1))
        weights += [(g.mT @ moved)[..., 0, 0]] if j <= (n - 1) // 2 else []
    return np.stack(np.broadcast_arrays(*traces, *weights, (g.mT @ g)[..., 0, 0]), axis=-1)
