"""The small-rotation branch for every n: the Ω with a given momentum, continued from the identity, for batches.

For fixed γ the branch is the curve Ω(t) with 𝒦(Ω(t), γ) = t𝒦 and Ω(0) = 1.  From a point of it Newton's iteration in
so(n), Ω becoming Ω·Cayley(ξ), goes to a later t.  It is assumed to stay on the branch if the first correction, the step
along the tangent, is at most LARGEST and each correction is below SHRINK of the one before: for Newton's iteration on
Kantorovich's majorant this is equivalent to the number of his theorem, which must be below 1/2, being at most 1/4.
Otherwise the step along t is halved; if the steps shrink to nothing, the branch folds.  The ratio of two corrections
estimates that number and does not bound it; the tests compare with shorter steps that are proven to stay on the branch
(|𝒦| times the step at most σ²/2l, σ the least singular value of the Jacobian, l = 2 max J + D).

Units: J, D and 𝒦 are first scaled by a power of two, exactly, so that the largest moment is about 1.
"""

import numpy as np

from ..ball import Floats, largest_moment
from ..errors import Status
from . import so_n

#: The largest first correction, in radians.
LARGEST = 0.5
#: The largest ratio of a correction to the one before.
SHRINK = 1 / 6
#: The size of the last correction, relative to the rotation, since Newton's iteration squares it.
SETTLED = 1e-9
#: A step along t below this fraction of the way so far means a fold.
SHORTEST = 1e-15
#: The path ends at a momentum of 2^FARTHEST; no entry of 𝒦(Ω, γ) is above 1.
FARTHEST = 3
#: The size of a rounding in an eigenvalue of the inertia about the contact point, the largest being about 1.
SINGULAR = 2.0**-50
MOST_STEPS = 5000
MOST_CORRECTIONS = 20


def small_rotation(K: Floats, gamma: Floats, J: Floats, D: Floats) -> tuple[Floats, np.ndarray, Floats]:
    """The small rotations with momenta 𝒦 of b balls: (Ω - 1, NaN where the status is not TAKEN, status, reach)."""
    K, J, D, end = _scaled(K, J, D)
    k = so_n.coordinates(K)
    status = np.full(len(D), Status.NOT_CONVERGED, dtype=np.int64)
    E, t, step = np.zeros_like(K), np.zeros(len(D)), np.ones(len(D))
    lost = _without_inertia(gamma, J, D)
    status[lost & (((J == 0) & (gamma == 0)).sum(axis=-1) > 1)] = Status.NO_INERTIA  # in others it is below a rounding
    going = np.flatnonzero(~lost)
    for _ in range(MOST_STEPS):
        if not going.size:
            break
        ahead = np.minimum(t[going] + step[going], 1.0)
        moved, settled = corrected(E[going], ahead[:, np.newaxis] * k[going], gamma[going], J[going], D[going])
        # The Jacobian is positive definite at rest: a determinant that is not positive means that a fold was passed.
        slope = so_n.jacobian(moved, gamma[going], J[going], D[going])
        settled &= np.linalg.slogdet(slope)[0] > 0
        arrived, refused = going[settled], going[~settled]
        E[arrived], t[arrived] = moved[settled], ahead[settled]
        step[arrived] *= 2
        step[refused] /= 2
        status[refused[step[refused] < SHORTEST * t[refused]]] = Status.FOLDED
        status[arrived[t[arrived] == 1]] = Status.TAKEN  # never on a cut path: no rotation has its end
        going = going[(status[going] == Status.NOT_CONVERGED) & (t[going] < 1)]
    E[status != Status.TAKEN] = np.nan
    return so_n.orthogonal(E), status, t * end


def corrected(E: Floats, k: Floats, gamma: Floats, J: Floats, D: Floats) -> tuple[Floats, np.ndarray]:
    """Newton's iteration at a fixed momentum with the coordinates k, (b, N); returns (E, settled)."""
    n, result, settled = E.shape[-1], E.copy(), np.zeros(len(D), dtype=bool)
    at, limit = np.arange(len(D)), np.full(len(D), LARGEST)
    for _ in range(MOST_CORRECTIONS):
        xi = _solved(so_n.jacobian(E, gamma, J, D), k - so_n.coordinates(so_n.momentum(E, gamma, J, D)))
        change = np.sqrt((xi * xi).sum(axis=-1))
        fits = change <= limit
        if not fits.all():
            at, E, k, gamma, J, D, xi, change = (x[fits] for x in (at, E, k, gamma, J, D, xi, change))
        E = so_n.turned(E, so_n.from_coordinates(xi, n))
        done = change <= SETTLED * np.abs(E).max(axis=(-2, -1))
        result[at[done]], settled[at[done]] = E[done], True
        if done.all():
            break
        if done.any():
            at, E, k, gamma, J, D, change = (x[~done] for x in (at, E, k, gamma, J, D, change))
        limit = SHRINK * change
    return result, settled


def _solved(matrix: Floats, vector: Floats) -> Floats:
    """Solutions of linear systems, (b, N); infinite for a singular matrix."""
    try:
        return np.linalg.solve(matrix, vector[..., np.newaxis])[..., 0].astype(np.float64, copy=False)
    except np.linalg.LinAlgError:
        if len(matrix) == 1:
            return np.full_like(vector, np.inf)
        return np.concatenate([_solved(matrix[i : i + 1], vector[i : i + 1]) for i in range(len(matrix))])


def _scaled(K: Floats, J: Floats, D: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """𝒦, J and D times a power of two, the largest moment about 1, 𝒦 cut at 2^FARTHEST, and the fraction left."""
    exponent = np.frexp(largest_moment(J, D))[1]
    largest = np.abs(K).max(axis=(-2, -1))
    shift = np.where(largest > 0, np.minimum(-exponent, FARTHEST - np.frexp(largest)[1]), -exponent)
    J, D = np.ldexp(J, -exponent[:, np.newaxis]), np.ldexp(D, -exponent)
    return np.ldexp(K, shift[:, np.newaxis, np.newaxis]), J, D, np.ldexp(1.0, shift + exponent)


def _without_inertia(gamma: Floats, J: Floats, D: Floats) -> np.ndarray:
    """Whether a rotation has no inertia about the contact point, up to rounding; needs two such moments in J."""
    found = np.sort(J, axis=-1)[..., :2].sum(axis=-1) <= SINGULAR
    if found.any():
        start = so_n.jacobian(np.zeros((int(found.sum()), *2 * J.shape[-1:])), gamma[found], J[found], D[found])
        found[found] = np.linalg.eigvalsh(start)[:, 0] <= SINGULAR
    return found
