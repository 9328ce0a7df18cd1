"""The derivative of the map along an orbit: Lyapunov exponents, phase volume, averages that tell order from chaos.

The map turns 𝒦 and γ by one rotation, so that on M = {|𝒦|, ⟨𝒦,γ⟩, |γ| fixed} ≅ SO(3) a tangent vector is ξ ∈ ℝ³:
δ𝒦 = 𝒦 × ξ, δγ = γ × ξ.  The derivative of the step is the 3×3 matrix T: ξ ↦ Ωᵀξ + w, with the Gibbs vector u,
w = 2(δu - u × δu)/(1 + |u|²) and G_u δu = -(δB)u + (1 + |u|²)δ𝒦/2.  det T is the change of the volume of SO(3).
"""

from math import exp, log, sqrt

import numpy as np

from chapsym.generated import energy, gibbs_newton, turn

from .loop import ROWS, D, G, I, K, put, safe_rotation, scaled, three
from .text import Matrix, Vector


def cross(a1, a2, a3, b1, b2, b3):
    """a × b."""
    return a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1


def column(x1, x2, x3, u1, u2, u3, state, det, c):
    """Tξ for one tangent vector ξ; state (`loop.ROWS`) before the step, det and the nine cofactors c of G_u."""
    g1, g2, g3 = three(state, G)
    a1, a2, a3 = cross(state[K], state[K + 1], state[K + 2], x1, x2, x3)
    b1, b2, b3 = cross(g1, g2, g3, x1, x2, x3)
    length = 1.0 + (u1 * u1 + u2 * u2 + u3 * u3)
    along = state[D] * (g1 * u1 + g2 * u2 + g3 * u3)
    across = state[D] * (b1 * u1 + b2 * u2 + b3 * u3)
    r1 = along * b1 + across * g1 + length * a1
    r2 = along * b2 + across * g2 + length * a2
    r3 = along * b3 + across * g3 + length * a3
    d1 = (c[0] * r1 + c[3] * r2 + c[6] * r3) / det
    d2 = (c[1] * r1 + c[4] * r2 + c[7] * r3) / det
    d3 = (c[2] * r1 + c[5] * r2 + c[8] * r3) / det
    v1, v2, v3 = cross(u1, u2, u3, d1, d2, d3)
    t1, t2, t3 = turn(1.0, u1, u2, u3, x1, x2, x3)
    f = 2.0 / length
    return x1 + t1 + f * (d1 - v1), x2 + t2 + f * (d2 - v2), x3 + t3 + f * (d3 - v3)


def derivative(u1, u2, u3, state, T):
    """Writes the three columns of the matrix T of the step with the Gibbs vector u into the rows of T."""
    found = gibbs_newton(  # type: ignore[call-arg]
        u1, u2, u3, *three(state, K), *three(state, G), *three(state, I), state[D]
    )
    for i in range(3):
        x = 1.0 if i == 0 else 0.0
        y = 1.0 if i == 1 else 0.0
        z = 1.0 if i == 2 else 0.0
        T[i, 0], T[i, 1], T[i, 2] = column(x, y, z, u1, u2, u3, state, found[0], found[4:13])


def determinant(T):
    """det T from its three columns, the rows of T."""
    n1, n2, n3 = cross(T[1, 0], T[1, 1], T[1, 2], T[2, 0], T[2, 1], T[2, 2])
    return T[0, 0] * n1 + T[0, 1] * n2 + T[0, 2] * n3


def moved(T, frame, growth):
    """T times the three orthonormal rows of `frame`, made orthonormal again; adds the logarithms of the lengths."""
    for j in range(3):
        a, b, c = frame[j, 0], frame[j, 1], frame[j, 2]
        for i in range(3):
            frame[j, i] = T[0, i] * a + T[1, i] * b + T[2, i] * c
        for before in range(j):
            along = 0.0
            for i in range(3):
                along += frame[before, i] * frame[j, i]
            for i in range(3):
                frame[j, i] -= along * frame[before, i]
        length = sqrt(frame[j, 0] * frame[j, 0] + frame[j, 1] * frame[j, 1] + frame[j, 2] * frame[j, 2])
        for i in range(3):
            frame[j, i] /= length
        growth[j] += log(length)


def weight(n, count):
    """The weight of the n-th of `count` terms: the smooth bump exp(-1/(t(1 - t))), t = (n + 1)/(count + 1)."""
    t = (n + 1.0) / (count + 1.0)
    return exp(-1.0 / (t * (1.0 - t)))


def follow(momentum, gamma, tensor, contact, steps, row):
    """`steps` steps of one orbit; writes into `row` what `follow_all` says."""
    state, frame, growth = np.empty(ROWS), np.eye(3), np.zeros(3)
    T = np.empty((3, 3))
    scale = scaled(momentum, gamma, tensor, contact, state)
    u1, u2, u3 = 0.0, 0.0, 0.0
    half, total = steps // 2, 0.0
    row[:] = 0.0
    row[8], row[9] = np.inf, -np.inf
    for n in range(2 * half):
        status, _, p0, p1, p2, p3, u1, u2, u3 = safe_rotation(u1, u2, u3, state)
        if status != 0 or p0 == 0.0:
            return
        derivative(u1, u2, u3, state, T)
        moved(T, frame, growth)
        volume = log(abs(determinant(T)))
        k1, k2, k3 = three(state, K)
        g1, g2, g3 = three(state, G)
        E = energy(scale * k1, scale * k2, scale * k3, g1, g2, g3, tensor[0], tensor[1], tensor[2], contact)
        second = 1 if n >= half else 0
        share = weight(n - second * half, half)
        total += 0.0 if second == 1 else share
        row[4 + second] += share * volume
        row[6 + second] += share * E
        row[8], row[9] = min(row[8], E), max(row[9], E)
        z1, z2, z3 = turn(p0, p1, p2, p3, k1, k2, k3)
        put(state, K, k1 + z1, k2 + z2, k3 + z3)
        z1, z2, z3 = turn(p0, p1, p2, p3, g1, g2, g3)
        put(state, G, g1 + z1, g2 + z2, g3 + z3)
        row[0] = n + 1.0
    for c in range(3):
        row[1 + c] = growth[c]
    for c in range(4, 8):
        row[c] /= total


def follow_all(momenta: Matrix, gammas: Matrix, tensor: Vector, contact: float, steps: int, rows: Matrix):
    """`steps` steps of each orbit, (n, 3), (n, 3); rows (n, 10).

    A row has the steps that were taken; the logarithms of the three stretchings (the exponents times the steps); the
    weighted averages of log|det T| over the first and the second half, which for a quasiperiodic orbit converge faster
    than any power; the same of the energy (2.5 as corrected) of 𝒦 = εK; and its range.
    """
    for i in range(momenta.shape[0]):
        follow(momenta[i], gammas[i], tensor, contact, steps, rows[i])
