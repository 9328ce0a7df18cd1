"""Many steps of one ball in n dimensions, one text for every n.

It serves balls below the bound of `n.near_n` only, where any rotation with the momentum and a small E is the right one.
"""

from numpy import empty

from .rotation_n import gap, guess, move, polish, remember, roll, slope, solve, turn
from .text import Cube, Matrix, Tensor, Vector

#: Corrections of Newton in a step, at most.
MOST_ROUNDS = 12


def settle(k, g, J, D, near, enough, E, O, W, T, r, h, c):
    """Newton's iteration from E on, in place; whether it came to the rotation with the momentum k.

    near: what Σ Eᵢⱼ² may be.  enough: the last correction and the polish before it, squared, are below this times |E|.
    """
    for _ in range(MOST_ROUNDS):
        far = polish(E, W, c)
        gap(E, k, g, J, D, c, r)
        slope(E, g, J, D, O, h, c, T)
        solve(T, r)
        change, size = turn(E, r, O, W, c)
        off = change + far
        if off * off <= enough * enough * size:
            return size <= near
    return False


def march(
    k: Matrix, g: Vector, J: Vector, D: float, c: Vector, near: Vector, enough: Vector, past: Tensor, use: Matrix,
    first: int, count: int, every: int, scale: float, momenta: Cube, verticals: Matrix, with_body: bool, R: Matrix,
    spot: Vector, rho: float, attitudes: Cube, traces: Matrix, T: Matrix,
):  # fmt: skip
    """Takes `count` stages from the stage `first` on, until one does not settle; returns how many.

    A step is its stages, with the coefficients c (s,), one after the other: each turns k by the rotation of cᵢk.
    k (n, n), g (n), R (n, n) and spot (n - 1) hold the present state and move.  Each stage has its own bounds near (s,)
    and enough (s,), and its last rotations in past (s, ORDER, n, n) and use (s, ORDER).
    𝒦 = scale·k.  T: room for a matrix, n(n - 1)/2 by as many.  The state after every `every`-th step goes to the
    frame arrays.  The attitude and the trace are touched only when `with_body`.
    """
    n, stages = k.shape[0], c.shape[0]
    E, O, W = empty((n, n)), empty((n, n)), empty((n, n))
    r, h, v, part = empty(T.shape[0]), empty(n), empty(n), empty((n, n))
    for stage in range(first, first + count):
        s = stage % stages
        for i in range(n):
            for j in range(n):
                part[i, j] = c[s] * k[i, j]
        guess(past[s], use[s], E)
        if not settle(part, g, J, D, near[s], enough[s], E, O, W, T, r, h, v):
            return stage - first
        remember(E, past[s], use[s])
        if with_body:
            roll(E, g, R, spot, rho, v, W)
        move(E, k, g, W, v)
        if (stage + 1) % (stages * every) == 0:
            frame = (stage + 1) // (stages * every)
            for i in range(n):
                verticals[frame, i] = g[i]
                for j in range(n):
                    momenta[frame, i, j] = scale * k[i, j]
            if with_body:
                for i in range(n):
                    for j in range(n):
                        attitudes[frame, i, j] = R[i, j]
                for i in range(n - 1):
                    traces[frame, i] = spot[i]
    return count
