"""Many steps of one ball in n dimensions, one source for every n.

Ω is stored as E = Ω - 1, as in `n.so_n`.  The coordinate p of a skew matrix is its entry (i, j), i > j, row by row.

`march` is only for balls below the bound of `n.near_n`, where a rotation with the momentum and a small E is unique.
"""

from typing import NamedTuple

from numpy import empty

from .records import Steps, Track
from .text import Matrix, Tensor, Vector

#: The most Newton corrections in a step.
MOST_ROUNDS = 12
#: The number of last rotations for the guess of the next one.
ORDER = 8


class Under(NamedTuple):
    """A ball under way.  Moments are divided by `scale`, so that the largest is about 1; 𝒦 = scale·k.

    Of the stages cᵢ of a step, (s,): the bounds near and enough for `settle`, and the last rotations, past
    (s, ORDER, n, n) and use (s, ORDER).  The attitude R and the contact point `spot`, (n - 1,), are used only if
    followed.
    """

    k: Matrix
    g: Vector
    J: Vector
    D: float
    c: Vector
    near: Vector
    enough: Vector
    past: Tensor
    use: Matrix
    scale: float
    R: Matrix
    spot: Vector
    rho: float


def guess(past, use, E):
    """Writes the extrapolation of the last rotations to the next step into E; the identity if there are none."""
    n = E.shape[0]
    for i in range(n):
        for j in range(n):
            z = use[ORDER - 1] * past[ORDER - 1, i, j]
            for m in range(ORDER - 2, -1, -1):
                z += use[m] * past[m, i, j]
            E[i, j] = z


def remember(E, past, use):
    """Adds E to the backward differences `past` (ORDER, n, n); use (ORDER) is 1 for those that exist."""
    n = E.shape[0]
    for i in range(n):
        for j in range(n):
            z = E[i, j]
            for m in range(ORDER):
                before = past[m, i, j]
                past[m, i, j] = z
                z -= before
    for m in range(ORDER - 1, 0, -1):
        use[m] = use[m - 1]
    use[0] = 1.0


def polish(E, W, v):
    """A Newton-Schulz step to the rotation nearest to 1 + E, in place; returns the square of the distance."""
    n = E.shape[0]
    far = 0.0
    for i in range(n):
        for j in range(i + 1):
            z = E[i, j] + E[j, i]
            for m in range(n):
                z += E[m, i] * E[m, j]
            W[i, j] = z
            W[j, i] = z
            far += z * z
    for i in range(n):
        for j in range(n):
            z = W[i, j]
            for m in range(n):
                z += E[i, m] * W[m, j]
            v[j] = z
        for j in range(n):
            E[i, j] -= 0.5 * v[j]
    return far


def gap(E, k, g, J, D, c, r):
    """Writes the coordinates of 𝒦 - 𝒦(Ω, γ) (4.13) into r."""
    n = E.shape[0]
    for i in range(n):
        z = (E[i, 0] - E[0, i]) * g[0]
        for j in range(1, n):
            z += (E[i, j] - E[j, i]) * g[j]
        c[i] = 0.5 * D * z
    p = 0
    for i in range(1, n):
        for j in range(i):
            r[p] = k[i, j] - ((E[i, j] * J[j] + c[i] * g[j]) - (E[j, i] * J[i] + c[j] * g[i]))
            p += 1


def slope(E, g, J, D, O, h, c, T):
    """Writes the derivative of 𝒦 along Ω(1 + ξ), that is 𝒦(Ωξ), into T: row p for the coordinate p of ξ.

    For the coordinate (p, q), Ωξ has the column p of Ω as its column q, and minus the column q as its column p.
    """
    n = E.shape[0]
    for i in range(n):
        for j in range(n):
            O[i, j] = E[i, j] + (1.0 if i == j else 0.0)
    for i in range(n):
        z = O[0, i] * g[0]
        for m in range(1, n):
            z += O[m, i] * g[m]
        h[i] = 0.5 * D * z
    at = 0
    for p in range(1, n):
        for q in range(p):
            dq, dp = 0.5 * D * g[q], 0.5 * D * g[p]
            for i in range(n):
                c[i] = O[i, p] * dq - O[i, q] * dp
            c[q] -= h[p]
            c[p] += h[q]
            row = 0
            for i in range(1, n):
                for j in range(i):
                    T[at, row] = c[i] * g[j] - c[j] * g[i]
                    row += 1
            for i in range(n):
                if i != q:
                    row = i * (i - 1) // 2 + q if i > q else q * (q - 1) // 2 + i
                    z = O[i, p] * J[q]
                    T[at, row] += z if i > q else -z
                if i != p:
                    row = i * (i - 1) // 2 + p if i > p else p * (p - 1) // 2 + i
                    z = O[i, q] * J[p]
                    T[at, row] -= z if i > p else -z
            at += 1


def solve(T, r):
    """Replaces r by the solution ξ of ξT = r, by elimination without pivoting; T is overwritten.

    The symmetric part of T is positive definite if the step is accepted, so that no pivot vanishes then.
    """
    size = r.shape[0]
    for k in range(size):
        inverse = 1.0 / T[k, k]
        for i in range(k + 1, size):
            f = T[i, k] * inverse
            T[i, k] = f
            for j in range(k + 1, size):
                T[i, j] -= f * T[k, j]
        z = r[k] * inverse
        r[k] = z
        for j in range(k + 1, size):
            r[j] -= z * T[k, j]
    for i in range(size - 1, 0, -1):
        for j in range(i):
            r[j] -= r[i] * T[i, j]


def turn(E, r, O, W, v):
    """Replaces E by that of Ω(1 + ξ + ξ²/2), a rotation up to ξ⁴/8; r: coordinates of ξ; returns |ξ|² and |E|²."""
    n = E.shape[0]
    p, change, size = 0, 0.0, 0.0
    for i in range(n):
        O[i, i] = 0.0
        for j in range(i):
            O[i, j] = r[p]
            O[j, i] = -r[p]
            change += r[p] * r[p]
            p += 1
    for i in range(n):
        for j in range(n):
            z = O[i, 0] * O[0, j]
            for m in range(1, n):
                z += O[i, m] * O[m, j]
            W[i, j] = O[i, j] + 0.5 * z
    for i in range(n):
        for j in range(n):
            z = W[i, j]
            for m in range(n):
                z += E[i, m] * W[m, j]
            v[j] = z
        for j in range(n):
            E[i, j] += v[j]
            size += E[i, j] * E[i, j]
    return change, size


def roll(E, g, R, spot, rho, c, W):
    """Moves the contact point `spot` and the attitude R by the step E that begins at the vertical g."""
    n = E.shape[0]
    for i in range(n):
        z = (E[i, 0] - E[0, i]) * g[0]
        for j in range(1, n):
            z += (E[i, j] - E[j, i]) * g[j]
        c[i] = z
    for i in range(n - 1):
        z = R[i, 0] * c[0]
        for j in range(1, n):
            z += R[i, j] * c[j]
        spot[i] += 0.5 * rho * z
    for i in range(n):
        for j in range(n):
            z = R[i, j]
            for m in range(n):
                z += R[i, m] * E[m, j]
            c[j] = z
        for j in range(n):
            R[i, j] = c[j]
    for i in range(n):  # the nearest rotation
        for j in range(i + 1):
            z = R[0, i] * R[0, j]
            for m in range(1, n):
                z += R[m, i] * R[m, j]
            W[i, j] = z - (1.0 if i == j else 0.0)
            W[j, i] = W[i, j]
    for i in range(n):
        for j in range(n):
            z = R[i, 0] * W[0, j]
            for m in range(1, n):
                z += R[i, m] * W[m, j]
            c[j] = z
        for j in range(n):
            R[i, j] -= 0.5 * c[j]


def move(E, k, g, W, c):
    """Replaces k and γ by ΩᵀkΩ and Ωᵀγ (4.11, 4.12), by increments; k stays exactly skew."""
    n = E.shape[0]
    for i in range(n):
        z = E[0, i] * g[0]
        for m in range(1, n):
            z += E[m, i] * g[m]
        c[i] = z
    for i in range(n):
        g[i] += c[i]
    for i in range(n):
        for j in range(n):
            z = k[i, 0] * E[0, j]
            for m in range(1, n):
                z += k[i, m] * E[m, j]
            W[i, j] = z
    for i in range(1, n):
        for j in range(i):
            z, y = E[0, i] * W[0, j], E[0, j] * W[0, i]
            for m in range(1, n):
                z += E[m, i] * W[m, j]
                y += E[m, j] * W[m, i]
            z = k[i, j] + ((W[i, j] + 0.5 * z) - (W[j, i] + 0.5 * y))
            k[i, j] = z
            k[j, i] = -z


def settle(ball, k, s, E, T):
    """Newton's iteration from E, in place; whether it converged to the rotation with the momentum k of the stage s.

    near: the bound for Σ Eᵢⱼ².  enough · |E|: the bound for the squares of the last corrections.
    """
    n, g, J, D, enough = k.shape[0], ball.g, ball.J, ball.D, ball.enough[s]
    O, W, r, h, c = empty((n, n)), empty((n, n)), empty(T.shape[0]), empty(n), empty(n)
    for _ in range(MOST_ROUNDS):
        far = polish(E, W, c)
        gap(E, k, g, J, D, c, r)
        slope(E, g, J, D, O, h, c, T)
        solve(T, r)
        change, size = turn(E, r, O, W, c)
        off = change + far
        if off * off <= enough * enough * size:
            return size <= ball.near[s]
    return False


def march(ball: Under, stages: Steps, track: Track, T: Matrix):
    """Takes stages, until one does not converge; returns the number of the first that was not taken.

    A step consists of the stages cᵢ: each turns k by the rotation of cᵢk.  The state after every `every`-th step is
    written, a matrix as one row.  T: workspace, a square matrix of size n(n - 1)/2.
    """
    k, g, n, count = ball.k, ball.g, ball.k.shape[0], ball.c.shape[0]
    E, W, part, v = empty((n, n)), empty((n, n)), empty((n, n)), empty(n)
    for stage in range(stages.first, stages.last):
        s = stage % count
        for i in range(n):
            for j in range(n):
                part[i, j] = ball.c[s] * k[i, j]
        guess(ball.past[s], ball.use[s], E)
        if not settle(ball, part, s, E, T):
            return stage
        remember(E, ball.past[s], ball.use[s])
        if track.follows:
            roll(E, g, ball.R, ball.spot, ball.rho, v, W)
        move(E, k, g, W, v)
        if (stage + 1) % (count * stages.every) == 0:
            frame = (stage + 1) // (count * stages.every)
            for i in range(n):
                track.verticals[frame, i] = g[i]
                for j in range(n):
                    track.momenta[frame, n * i + j] = ball.scale * k[i, j]
                    if track.follows:
                        track.attitudes[frame, n * i + j] = ball.R[i, j]
            if track.follows:
                for i in range(n - 1):
                    track.traces[frame, i] = ball.spot[i]
    return stages.last
