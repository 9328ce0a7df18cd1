"""The map as a user might write it: each peer takes (K, g, J, D, steps) and returns the last (K, g).

They share nothing with the loop that they are compared with.
"""

import numpy as np

from .harness import NotComparable

#: A Newton correction below this, relative to the rotation, is the last one: the next would be its square.
SETTLED = 1e-9
MOST = 30


def with_lists(K, g, J, D, steps):
    """Plain Python floats."""
    K, g = _run(*(tuple(map(float, v)) for v in (K, g, J)), D, steps, bool)  # type: ignore[call-arg]
    return np.array(K), np.array(g)


def by_columns(K, g, J, D, steps):
    """NumPy with one array for each component, of all balls."""
    K, g = _run(*(v.T.copy() for v in (K, g, J)), D, steps, np.all)  # type: ignore[call-arg]
    return np.stack(K, axis=-1), np.stack(g, axis=-1)


def _run(K, g, J, D, steps, everywhere):
    """A run by the Gibbs vector u = q/q₀, extrapolated from six steps, corrected and checked."""
    past: list = []
    moments = moments_of(*J)
    for _ in range(steps):
        if len(past) == 6:
            u = [6 * (p + t) - 15 * (q + s) + (20 * r - z) for p, q, r, s, t, z in zip(*past, strict=True)]
            past.pop()
        else:
            u = past[0] if past else [0 * x for x in K]
        settled, *u = newton_in_u(*u, *K, *g, *moments, D, everywhere)  # type: ignore[call-arg]
        if not settled:
            raise NotComparable("Newton's iteration in u does not converge")
        past.insert(0, u)
        f = 2 / (1 + u[0] * u[0] + u[1] * u[1] + u[2] * u[2])
        K, g = turned(*u, f, *K), turned(*u, f, *g)  # type: ignore[call-arg]
    return K, g


def moments_of(J1, J2, J3):
    """The moments of inertia, and the differences that Λ has, too."""
    return J2 + J3, J1 + J3, J1 + J2, J2 - J3, J3 - J1, J1 - J2


def newton_in_u(u1, u2, u3, K1, K2, K3, g1, g2, g3, I1, I2, I3, E1, E2, E3, D, everywhere=bool):
    """Solves Bu + u×Λu = ½𝒦(1 + |u|²), B = Λ - Dγγᵀ, from a start; returns (settled, u1, u2, u3)."""
    k1, k2, k3 = 0.5 * K1, 0.5 * K2, 0.5 * K3
    e1, e2, e3 = D * g1, D * g2, D * g3
    b11, b22, b33 = I1 + e2 * g2 + e3 * g3, I2 + e1 * g1 + e3 * g3, I3 + e1 * g1 + e2 * g2
    b12, b13, b23 = -e1 * g2, -e1 * g3, -e2 * g3
    for _ in range(MOST):
        t1, t2, t3 = E1 * u2, E2 * u3, E3 * u1
        w = 1 + u1 * u1 + u2 * u2 + u3 * u3
        r1 = b11 * u1 + b12 * u2 + b13 * u3 + t1 * u3 - w * k1
        r2 = b12 * u1 + b22 * u2 + b23 * u3 + t2 * u1 - w * k2
        r3 = b13 * u1 + b23 * u2 + b33 * u3 + t3 * u2 - w * k3
        v1, v2, v3 = 2 * u1, 2 * u2, 2 * u3
        d1, d2, d3 = solved(
            b11 - k1 * v1, b12 + E1 * u3 - k1 * v2, b13 + t1 - k1 * v3,
            b12 + t2 - k2 * v1, b22 - k2 * v2, b23 + E2 * u1 - k2 * v3,
            b13 + E3 * u2 - k3 * v1, b23 + t3 - k3 * v2, b33 - k3 * v3,
            r1, r2, r3,
        )  # fmt: skip
        u1, u2, u3 = u1 - d1, u2 - d2, u3 - d3
        if everywhere(d1 * d1 + d2 * d2 + d3 * d3 <= SETTLED * SETTLED * (w - 1)):
            return True, u1, u2, u3
    return False, u1, u2, u3


def turned(u1, u2, u3, f, x, y, z):
    """v + f (u × (u × v) - u × v), which is Ωᵀv for f = 2/(1 + |u|²)."""
    a, b, c = u2 * z - u3 * y, u3 * x - u1 * z, u1 * y - u2 * x
    return x + f * (u2 * c - u3 * b - a), y + f * (u3 * a - u1 * c - b), z + f * (u1 * b - u2 * a - c)


def solved(a11, a12, a13, a21, a22, a23, a31, a32, a33, r1, r2, r3):
    """The solution of a 3×3 system by cofactors."""
    c11, c12, c13 = a22 * a33 - a23 * a32, a23 * a31 - a21 * a33, a21 * a32 - a22 * a31
    s = 1 / (a11 * c11 + a12 * c12 + a13 * c13)
    return (
        s * (c11 * r1 + (a13 * a32 - a12 * a33) * r2 + (a12 * a23 - a13 * a22) * r3),
        s * (c12 * r1 + (a11 * a33 - a13 * a31) * r2 + (a13 * a21 - a11 * a23) * r3),
        s * (c13 * r1 + (a12 * a31 - a11 * a32) * r2 + (a11 * a22 - a12 * a21) * r3),
    )


def with_tuned_arrays(K, g, J, D, steps):
    """NumPy on arrays of three with as few calls as we could do with: both vectors turn in one product."""
    J, state = np.asarray(J), np.array([K, g]).T
    moments, differences = np.diag(J.sum() - J + D), np.roll(J, -1) - np.roll(J, -2)
    twist = np.zeros((3, 3, 3))
    for i, (j, l) in enumerate(((1, 2), (2, 0), (0, 1))):
        twist[i, j, l] = twist[i, l, j] = differences[i]
    u = np.zeros(3)
    for _ in range(steps):
        k, g = state[:, 0] / 2, state[:, 1]
        B = moments - D * np.multiply.outer(g, g)
        for _ in range(MOST):
            bend = twist @ u - 2 * np.multiply.outer(k, u)
            d = np.linalg.solve(B + bend, (B + bend / 2) @ u - k)
            u = u - d
            if d @ d <= SETTLED * SETTLED * (u @ u):
                break
        else:
            raise NotComparable("Newton's iteration with np.linalg.solve does not converge")
        cross = np.array([[0.0, -u[2], u[1]], [u[2], 0.0, -u[0]], [-u[1], u[0], 0.0]])
        state = state + (2 / (1 + u @ u)) * (cross @ (cross @ state - state))
    return state[:, 0], state[:, 1]
