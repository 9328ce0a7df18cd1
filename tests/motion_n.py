"""The continuous ball in n dimensions by Taylor series at 100 bits: K = Jω + ωJ + D(Γω + ωΓ), with Γ = γγᵀ (2.13).

K' = [K, ω], γ' = -ωγ, R' = Rω, and the contact point moves by ρRωγ.
"""

import numpy as np
from flint import arb, arb_mat, ctx

BITS, TERMS, STEPS = 100, 26, 24


def matrix(values):
    return arb_mat([[arb(float(x)) for x in row] for row in np.atleast_2d(values)])


def product(A, B, m):
    """The coefficient m of the product of two series."""
    return sum((A[i] * B[m - i] for i in range(1, m + 1)), A[0] * B[m])


def inertia(J, D, Gamma):
    """K as a function of ω in the coordinates below the diagonal, as a matrix."""
    n = J.nrows()
    places = [(i, j) for i in range(n) for j in range(i)]
    columns = []
    for i, j in places:
        w = arb_mat(n, n)
        w[i, j], w[j, i] = 1, -1
        K = J * w + w * J + (Gamma * w + w * Gamma) * D
        columns.append([K[place] for place in places])
    return places, arb_mat(columns).transpose()


def series(J, D, rho, K, g, R, x):
    """Coefficients of K, γ, R and the contact point."""
    n = J.nrows()
    K, g, R, x, w, S = [K], [g], [R], [x], [], []
    Gammas = [g[0] * g[0].transpose()]
    places, A = inertia(J, D, Gammas[0])
    for m in range(TERMS):
        rest = K[m]
        for j in range(m):
            rest = rest - (Gammas[m - j] * w[j] + w[j] * Gammas[m - j]) * D
        found, skew = A.solve(arb_mat([[rest[place]] for place in places])), arb_mat(n, n)
        for row, (i, j) in enumerate(places):
            skew[i, j], skew[j, i] = found[row, 0], -found[row, 0]
        w.append(skew)
        S.append(product(R, w, m))
        K.append((product(K, w, m) - product(w, K, m)) * (1 / arb(m + 1)))
        g.append(product(w, g, m) * (-1 / arb(m + 1)))
        R.append(S[m] * (1 / arb(m + 1)))
        x.append(product(S, g, m) * (rho / arb(m + 1)))
        Gammas.append(sum((g[i] * g[m + 1 - i].transpose() for i in range(1, m + 2)), g[0] * g[m + 1].transpose()))
    return K, g, R, x


def middle(A):
    for i in range(A.nrows()):
        for j in range(A.ncols()):
            A[i, j] = A[i, j].mid()
    return A


def continuous(ball, K, gamma, attitude, time):
    """K, γ, R and the contact point at a time, each as an array of floats; the last terms are below 1e-20."""
    with ctx.workprec(BITS):
        n = len(gamma)
        J, D, rho, h = matrix(np.diag(ball.mass_tensor)), arb(float(ball.D)), arb(float(ball.radius)), arb(time) / STEPS
        state = [matrix(K), matrix(gamma).transpose(), matrix(attitude), arb_mat(n, 1)]
        for _ in range(STEPS):
            found = series(J, D, rho, *state)
            for one in found:
                assert all(abs(x) * h**TERMS < arb("1e-20") for x in one[TERMS].entries())
            state = [middle(sum((one[m] * h**m for m in range(1, TERMS + 1)), one[0])) for one in found]
    K, g, R, x = (np.array([[float(y) for y in row] for row in one.tolist()]) for one in state)
    return K, g[:, 0], R, x[:-1, 0]
