"""The derivative of the map along an orbit: Lyapunov exponents, phase volume, averages that detect chaos.

The map turns 𝒦 and γ by the same rotation, so that on M = {|𝒦|, ⟨𝒦,γ⟩, |γ| fixed} ≅ SO(3) a tangent vector is ξ ∈ ℝ³:
δ𝒦 = 𝒦 × ξ, δγ = γ × ξ.  The derivative of the step with the Gibbs vector u is the 3×3 matrix T: ξ ↦ Ωᵀξ + w,
w = 2(δu - u × δu)/(1 + |u|²) and G_u δu = -(δB)u + (1 + |u|²)δ𝒦/2.  det T is the change of volume on SO(3).
"""

from math import exp, log, sqrt

import numpy as np

from chapsym.generated import energy, gibbs_newton, turn

from .loop import ROWS, D, G, I, K, entered, safe_rotation
from .text import Matrix, Vector
from .vectors import adjoint, cross, dot, minus, plus, put, scaled, three


def column(x, u, k, g, D, det, c):
    """Tξ for one tangent vector ξ = x from k and γ; det and the nine cofactors c of G_u; with δu = d, G_u d = r."""
    a, b = cross(k, x), cross(g, x)
    length = 1.0 + dot(u, u)
    r = plus(plus(scaled(D * dot(g, u), b), scaled(D * dot(b, u), g)), scaled(length, a))
    x1, x2, x3 = adjoint(c, r)
    d = x1 / det, x2 / det, x3 / det
    return plus(plus(x, turn(1.0, *u, *x)), scaled(2.0 / length, minus(d, cross(u, d)))), d, r


def derivative(u, state, T):
    """Writes the three columns of the matrix T of the step with the Gibbs vector u into the rows of T."""
    k, g = three(state, K), three(state, G)
    n = gibbs_newton(*u, *k, *g, *three(state, I), state[D])
    for i in range(3):
        x = 1.0 if i == 0 else 0.0, 1.0 if i == 1 else 0.0, 1.0 if i == 2 else 0.0
        y, _, _ = column(x, u, k, g, state[D], n[0], n[4:13])
        put(T[i], 0, y)


def determinant(T):
    """det T from its three columns, the rows of T."""
    return dot(three(T[0], 0), cross(three(T[1], 0), three(T[2], 0)))


def moved(T, frame, growth):
    """T times the three orthonormal rows of `frame`, orthonormalised; adds the logarithms of the lengths."""
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
    """`steps` steps of one orbit; writes the results into `row`, as described in `follow_all`."""
    state, frame, growth = np.empty(ROWS), np.eye(3), np.zeros(3)
    T = np.empty((3, 3))
    scale = entered(momentum, gamma, tensor, contact, state)
    u = 0.0, 0.0, 0.0
    half, total = steps // 2, 0.0
    row[:] = 0.0
    row[8], row[9] = np.inf, -np.inf
    for n in range(2 * half):
        status, _, p, u = safe_rotation(u, state)
        if status != 0 or p[0] == 0.0:
            return
        derivative(u, state, T)
        moved(T, frame, growth)
        volume = log(abs(determinant(T)))
        k, g = three(state, K), three(state, G)
        E = energy(*scaled(scale, k), *g, *three(tensor, 0), contact)
        second = 1 if n >= half else 0
        share = weight(n - second * half, half)
        total += 0.0 if second == 1 else share
        row[4 + second] += share * volume
        row[6 + second] += share * E
        row[8], row[9] = min(row[8], E), max(row[9], E)
        put(state, K, plus(k, turn(*p, *k)))
        put(state, G, plus(g, turn(*p, *g)))
        row[0] = n + 1.0
    for c in range(3):
        row[1 + c] = growth[c]
    for c in range(4, 8):
        row[c] /= total


def follow_all(momenta: Matrix, gammas: Matrix, tensor: Vector, contact: float, steps: int, rows: Matrix):
    """`steps` steps of each orbit, (n, 3), (n, 3); writes the results into rows (n, 10).

    A row has the number of steps taken; the logarithms of the three stretching factors (Lyapunov exponents times
    steps); the weighted averages of log|det T| over the first and the second half, which for a quasiperiodic orbit
    converge faster than any power; the same of the energy (2.5 as corrected) evaluated at 𝒦 = εK; and its range.
    """
    for i in range(momenta.shape[0]):
        follow(momenta[i], gammas[i], tensor, contact, steps, rows[i])
