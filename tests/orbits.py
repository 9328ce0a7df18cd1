"""Orbits by the independent oracle: (4.13) in matrices, step after step, in mpmath."""

import mpmath

from chapsym.dynamics.oracle import Oracle


def context(digits):
    found = mpmath.MPContext()
    found.dps = digits
    return found


def from_quaternion(mp, a):
    """The rows of the rotation matrix of a quaternion of any length."""
    w, x, y, z = map(mp.mpf, a)
    s = mp.matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return (mp.eye(3) + 2 * (w * s + s * s) / (w * w + x * x + y * y + z * z)).tolist()


def orbit(ball, momentum, gamma, steps, stages=(1,), digits=40, attitude=None):
    """(𝒦, γ, R, r/ρ) of the exact floats, γ divided by its length, after 0, 1, ..., `steps` steps.

    A stage with the coefficient c takes its rotation from c𝒦; R starts at the matrix of `attitude` (or 1),
    or as the least rotation that turns γ up ("least").
    """
    mp = context(digits + 15)
    K, g = (mp.matrix([mp.mpf(float(x)) for x in v]) for v in (momentum, gamma))
    g /= mp.norm(g)
    if isinstance(attitude, str):
        attitude = (1 + g[2], g[1], -g[0], 0)
    R, r = mp.matrix(from_quaternion(mp, (1, 0, 0, 0) if attitude is None else attitude)), mp.zeros(3, 1)
    found = [(list(K), list(g), R.tolist(), list(r))]
    tensor, D = [mp.mpf(float(x)) for x in ball.mass_tensor], mp.mpf(float(ball.D))
    for _ in range(steps):
        for c in stages:
            factor = mp.mpf(c.numerator) / c.denominator
            turn = mp.matrix(Oracle(tensor, D, g, digits + 10).step(factor * K).rotation)
            between = R * turn * R.T
            r += (between - between.T)[:, 2] / 2
            K, g, R = turn.T * K, turn.T * g, R * turn
        found.append((list(K), list(g), R.tolist(), list(r)))
    return found
