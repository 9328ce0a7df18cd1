"""Orbits by the independent oracle: (4.13) in matrices, step after step, in mpmath."""

import mpmath

from chapsym.dynamics.oracle import Oracle


def context(digits):
    found = mpmath.MPContext()
    found.dps = digits
    return found


def rows(matrix):
    return [[matrix[i, j] for j in range(3)] for i in range(3)]


def from_quaternion(mp, a):
    """The rows of the rotation matrix of a quaternion of any length."""
    w, x, y, z = map(mp.mpf, a)
    n = w * w + x * x + y * y + z * z
    table = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    return [[x / n for x in row] for row in table]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def turned(a, v):
    """Aᵀv."""
    return [sum(a[k][i] * v[k] for k in range(3)) for i in range(3)]


def orbit(ball, momentum, gamma, steps, stages=(1,), digits=40, attitude=None):
    """(𝒦, γ, R, r/ρ) of the exact floats, γ divided by its length, after 0, 1, ..., `steps` steps.

    A stage with the coefficient c takes its rotation from c𝒦; R starts at the matrix of `attitude` (or 1),
    or as the least rotation that turns γ up ("least").
    """
    mp = context(digits + 15)
    K, g = ([mp.mpf(float(x)) for x in v] for v in (momentum, gamma))
    length = mp.sqrt(sum(x * x for x in g))
    g = [x / length for x in g]
    if isinstance(attitude, str):
        attitude = (1 + g[2], g[1], -g[0], 0)
    R = from_quaternion(mp, (1, 0, 0, 0) if attitude is None else attitude)
    r = [mp.mpf(0)] * 3
    found = [(K, g, R, r)]
    tensor, D = [mp.mpf(float(x)) for x in ball.mass_tensor], mp.mpf(float(ball.D))
    for _ in range(steps):
        for c in stages:
            factor = mp.mpf(c.numerator) / c.denominator
            turn = rows(Oracle(tensor, D, g, digits + 10).step([factor * x for x in K]).rotation)
            turn = [[mp.mpf(x) for x in row] for row in turn]
            after = product(R, turn)
            between = product(after, [list(column) for column in zip(*R, strict=True)])
            r = [r[i] + (between[i][2] - between[2][i]) / 2 for i in range(3)]
            K, g, R = turned(turn, K), turned(turn, g), after
        found.append((K, g, R, r))
    return found
