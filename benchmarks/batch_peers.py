"""Many balls, as a user might write it.

Each peer takes (K (n, 3), g (n, 3), J (n, 3), D (n,), steps) and returns the last (K, g).
"""

from functools import cache

import numpy as np

from chapsym.studies.harness import NotComparable

from .scalar_peers import MOST, SETTLED, newton_in_q, solved, turned

#: The weights that extend six values of a polynomial of degree five, the newest first.
EXTEND = (6.0, -15.0, 20.0, -15.0, 6.0, -1.0)


def by_columns(K, g, J, D, steps):
    """NumPy with one array for each component: the Gibbs vector, extrapolated from six steps, and a check of all."""
    K1, K2, K3 = K.T.copy()
    g1, g2, g3 = g.T.copy()
    J1, J2, J3 = J.T.copy()
    S1, S2, S3, E1, E2, E3 = J2 + J3, J1 + J3, J1 + J2, J2 - J3, J3 - J1, J1 - J2
    past: list[list[np.ndarray]] = []
    for _ in range(steps):
        k1, k2, k3 = 0.5 * K1, 0.5 * K2, 0.5 * K3
        d1, d2, d3 = D * g1, D * g2, D * g3
        e1, e2, e3 = d1 * g1, d2 * g2, d3 * g3
        b11, b22, b33 = S1 + (e2 + e3), S2 + (e1 + e3), S3 + (e1 + e2)
        b12, b13, b23 = -d1 * g2, -d1 * g3, -d2 * g3
        if len(past) == len(EXTEND):
            u1, u2, u3 = (sum(w * p[i] for w, p in zip(EXTEND, past, strict=True)) for i in range(3))
            past.pop()
        else:
            u1, u2, u3 = past[0] if past else solved(b11, b12, b13, b12, b22, b23, b13, b23, b33, k1, k2, k3)
        for _ in range(MOST):
            t1, t2, t3 = E1 * u2, E2 * u3, E3 * u1
            w = u1 * u1 + u2 * u2 + u3 * u3
            r1 = b11 * u1 + b12 * u2 + b13 * u3 + t1 * u3 - (1 + w) * k1
            r2 = b12 * u1 + b22 * u2 + b23 * u3 + t2 * u1 - (1 + w) * k2
            r3 = b13 * u1 + b23 * u2 + b33 * u3 + t3 * u2 - (1 + w) * k3
            v1, v2, v3 = 2 * u1, 2 * u2, 2 * u3
            c1, c2, c3 = solved(
                b11 - k1 * v1, b12 + E1 * u3 - k1 * v2, b13 + t1 - k1 * v3,
                b12 + t2 - k2 * v1, b22 - k2 * v2, b23 + E2 * u1 - k2 * v3,
                b13 + E3 * u2 - k3 * v1, b23 + t3 - k3 * v2, b33 - k3 * v3,
                r1, r2, r3,
            )  # fmt: skip
            u1, u2, u3 = u1 - c1, u2 - c2, u3 - c3
            if (c1 * c1 + c2 * c2 + c3 * c3 <= SETTLED * SETTLED * w).all():
                break
        else:
            raise NotComparable("Newton's iteration by columns does not converge")
        past.insert(0, [u1, u2, u3])
        f = 2 / (1 + u1 * u1 + u2 * u2 + u3 * u3)
        K1, K2, K3 = turned(u1, u2, u3, f, K1, K2, K3)
        g1, g2, g3 = turned(u1, u2, u3, f, g1, g2, g3)
    return np.stack([K1, K2, K3], axis=-1), np.stack([g1, g2, g3], axis=-1)


def by_rows(K, g, J, D, steps):
    """NumPy on (n, 3) arrays with np.linalg.solve, from the solution of the linear part."""
    moments = J.sum(axis=-1, keepdims=True) - J + D[:, np.newaxis]
    diagonal = moments[:, :, np.newaxis] * np.eye(3)
    for _ in range(steps):
        k = K / 2
        B = diagonal - (D[:, np.newaxis] * g)[:, :, np.newaxis] * g[:, np.newaxis, :]
        u = np.linalg.solve(B, k[..., np.newaxis])[..., 0]
        for _ in range(MOST):
            square = (u * u).sum(axis=-1, keepdims=True)
            twisted = moments * u
            residual = (B @ u[..., np.newaxis])[..., 0] + np.cross(u, twisted) - k * (1 + square)
            slope = B + _skew(u) * moments[:, np.newaxis, :] - _skew(twisted)
            slope -= 2 * k[:, :, np.newaxis] * u[:, np.newaxis, :]
            d = np.linalg.solve(slope, residual[..., np.newaxis])[..., 0]
            u = u - d
            if ((d * d).sum(axis=-1) <= SETTLED * SETTLED * square[:, 0]).all():
                break
        else:
            raise NotComparable("Newton's iteration by rows does not converge")
        f = 2 / (1 + (u * u).sum(axis=-1, keepdims=True))
        K, g = (v + f * (np.cross(u, np.cross(u, v)) - np.cross(u, v)) for v in (K, g))
    return K, g


def _skew(a):
    matrix = np.zeros((*a.shape, 3))
    matrix[:, 2, 1], matrix[:, 0, 2], matrix[:, 1, 0] = a[:, 0], a[:, 1], a[:, 2]
    return matrix - matrix.transpose(0, 2, 1)


@cache
def _loop():
    import numba

    from .scalar_peers import jitted

    march = jitted(newton_in_q)

    @numba.njit(parallel=True, error_model="numpy")
    def run(K, g, J, D, steps, converged):
        for i in numba.prange(K.shape[0]):
            converged[i], K[i, 0], K[i, 1], K[i, 2], g[i, 0], g[i, 1], g[i, 2] = march(K[i], g[i], J[i], D[i], steps)

    return run


def over_rows(K, g, J, D, steps):
    """numba over the rows of (n, 3) arrays, in parallel: Newton's iteration in q for each ball."""
    K, g, converged = K.copy(), g.copy(), np.zeros(len(K), dtype=bool)
    _loop()(K, g, J, D, steps, converged)
    if not converged.all():
        raise NotComparable("Newton's iteration in q does not converge")
    return K, g
