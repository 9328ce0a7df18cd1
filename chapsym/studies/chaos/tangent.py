"""The derivative of the map along an orbit: Lyapunov exponents, phase volume, averages that tell order from chaos.

The map turns 𝒦 and γ by one rotation, so that on M = {|𝒦|, ⟨𝒦,γ⟩, |γ| fixed} ≅ SO(3) a tangent vector is ξ ∈ ℝ³:
δ𝒦 = 𝒦 × ξ, δγ = γ × ξ.  The derivative of the step is the 3×3 matrix T: ξ ↦ Ωᵀξ + w, with the Gibbs vector u,
w = 2(δu - u × δu)/(1 + |u|²) and G_u δu = -(δB)u + (1 + |u|²)δ𝒦/2.  det T is the change of the volume of SO(3).

Plain scalar Python that numba compiles.
"""

from collections.abc import Callable
from functools import cache
from math import exp, log, sqrt
from typing import Any

import numpy as np

from chapsym import extras
from chapsym.dynamics.loops.gibbs import HEAVY
from chapsym.dynamics.loops.loop import ROWS, D, G, I, K, prepare, put, safe_rotation, three
from chapsym.generated import energy, gibbs_newton, turn

#: What `follow` returns for an orbit, in this order.
COLUMNS = (
    "taken", "growth1", "growth2", "growth3", "volume_first", "volume_second", "energy_first", "energy_second",
    "energy_low", "energy_high",
)  # fmt: skip


def cross(a1, a2, a3, b1, b2, b3):
    """a × b."""
    return a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1


def column(x1, x2, x3, u, k, g, contact, det, c):
    """Tξ for one tangent vector ξ; u, k = 𝒦/2, γ before the step, and det and the nine cofactors c of G_u."""
    u1, u2, u3 = u
    g1, g2, g3 = g
    a1, a2, a3 = cross(k[0], k[1], k[2], x1, x2, x3)
    b1, b2, b3 = cross(g1, g2, g3, x1, x2, x3)
    length = 1.0 + (u1 * u1 + u2 * u2 + u3 * u3)
    along, beside = contact * (g1 * u1 + g2 * u2 + g3 * u3), contact * (b1 * u1 + b2 * u2 + b3 * u3)
    r1 = along * b1 + beside * g1 + length * a1
    r2 = along * b2 + beside * g2 + length * a2
    r3 = along * b3 + beside * g3 + length * a3
    d1 = (c[0] * r1 + c[3] * r2 + c[6] * r3) / det
    d2 = (c[1] * r1 + c[4] * r2 + c[7] * r3) / det
    d3 = (c[2] * r1 + c[5] * r2 + c[8] * r3) / det
    v1, v2, v3 = cross(u1, u2, u3, d1, d2, d3)
    t1, t2, t3 = turn(1.0, u1, u2, u3, x1, x2, x3)
    f = 2.0 / length
    return x1 + t1 + f * (d1 - v1), x2 + t2 + f * (d2 - v2), x3 + t3 + f * (d3 - v3)


def derivative(u, k, g, moments, contact):
    """The matrix T of the step with the Gibbs vector u that begins at k = 𝒦/2 and γ: its three columns."""
    found = gibbs_newton(
        u[0], u[1], u[2], k[0], k[1], k[2], g[0], g[1], g[2], moments[0], moments[1], moments[2], contact
    )
    det, c = found[0], found[4:]
    return (
        column(1.0, 0.0, 0.0, u, k, g, contact, det, c),
        column(0.0, 1.0, 0.0, u, k, g, contact, det, c),
        column(0.0, 0.0, 1.0, u, k, g, contact, det, c),
    )


def determinant(t):
    """det T from its three columns."""
    x, y, z = t
    n1, n2, n3 = cross(y[0], y[1], y[2], z[0], z[1], z[2])
    return x[0] * n1 + x[1] * n2 + x[2] * n3


def moved(t, frame, growth):
    """T times the three orthonormal rows of `frame`, made orthonormal again; adds the logarithms of the lengths."""
    x, y, z = t
    for j in range(3):
        a, b, c = frame[j, 0], frame[j, 1], frame[j, 2]
        for i in range(3):
            frame[j, i] = x[i] * a + y[i] * b + z[i] * c
        for before in range(j):
            along = 0.0
            for i in range(3):
                along += frame[before, i] * frame[j, i]
            for i in range(3):
                frame[j, i] -= along * frame[before, i]
        length = sqrt(frame[j, 0] ** 2 + frame[j, 1] ** 2 + frame[j, 2] ** 2)
        for i in range(3):
            frame[j, i] /= length
        growth[j] += log(length)


def weight(n, count):
    """The weight of the n-th of `count` terms: the smooth bump exp(-1/(t(1 - t))), t = (n + 1)/(count + 1)."""
    t = (n + 1.0) / (count + 1.0)
    return exp(-1.0 / (t * (1.0 - t)))


def follow(momentum, gamma, tensor, contact, steps, row):
    """`steps` steps of one orbit; writes the `COLUMNS` into `row`.

    growth: the logarithms of the three stretchings (the exponents times `steps`); volume_first, _second: the weighted
    averages of log|det T| over the first and the second half, which for a quasiperiodic orbit converge faster than any
    power; energy_: the same of the energy (2.5 as corrected) of 𝒦 = εK, and its range.
    """
    state, frame, growth = np.empty(ROWS), np.eye(3), np.zeros(3)
    scale = prepare(momentum, gamma, tensor, contact, state)
    u1, u2, u3 = 0.0, 0.0, 0.0
    half, total = steps // 2, 0.0
    for c in range(len(row)):
        row[c] = 0.0
    row[8], row[9] = np.inf, -np.inf
    for n in range(2 * half):
        status, _, p0, p1, p2, p3, u1, u2, u3 = safe_rotation(u1, u2, u3, state)
        if status != 0 or p0 == 0.0:
            return
        k, g = three(state, K), three(state, G)
        t = derivative((u1, u2, u3), k, g, three(state, I), state[D])
        moved(t, frame, growth)
        volume = log(abs(determinant(t)))
        T = energy(scale * k[0], scale * k[1], scale * k[2], g[0], g[1], g[2], tensor[0], tensor[1], tensor[2], contact)
        second = n >= half
        share = weight(n - half if second else n, half)
        total += 0.0 if second else share
        row[5 if second else 4] += share * volume
        row[7 if second else 6] += share * T
        row[8], row[9] = min(row[8], T), max(row[9], T)
        z1, z2, z3 = turn(p0, p1, p2, p3, k[0], k[1], k[2])
        put(state, K, k[0] + z1, k[1] + z2, k[2] + z3)
        z1, z2, z3 = turn(p0, p1, p2, p3, g[0], g[1], g[2])
        put(state, G, g[0] + z1, g[1] + z2, g[2] + z3)
        row[0] = n + 1.0
    for c in range(3):
        row[1 + c] = growth[c]
    for c in range(4, 8):
        row[c] /= total


def follow_all(momenta, gammas, tensor, contact, steps, rows):
    """`follow` for each orbit, (n, 3), (n, 3), (3,), (), (); rows (n, len(COLUMNS))."""
    for i in range(momenta.shape[0]):
        follow(momenta[i], gammas[i], tensor, contact, steps, rows[i])


@cache
def _compiled() -> Callable[..., Any]:
    extras.need("fast")
    from numba.extending import register_jitable

    from chapsym.dynamics.levels.compiled import compiled

    for function in (cross, column, derivative, determinant, moved, weight, follow):
        register_jitable(error_model="numpy")(function)
    return compiled(follow_all)


def follow_orbits(ball: Any, momenta: np.ndarray, gammas: np.ndarray, steps: int) -> dict[str, np.ndarray]:
    """The `COLUMNS` of each orbit of a ball, from the starts (n, 3) and (n, 3); NaN where an orbit met a fold.

    Raises ValueError for a heavy ball: its Gibbs vector needs another kernel.
    """
    if (HEAVY * ball.inertia.min() < ball.D).any():
        raise ValueError("the derivative of the step is computed for balls with D ≤ 32 I_min only")
    rows = np.empty((len(momenta), len(COLUMNS)))
    _compiled()(
        np.ascontiguousarray(momenta), np.ascontiguousarray(gammas), ball.mass_tensor, float(ball.D), steps, rows
    )
    rows[rows[:, 0] < 2 * (steps // 2), 1:] = np.nan
    return dict(zip(COLUMNS, rows.T, strict=True))
