"""Many steps of one ball in n dimensions: plain scalar Python that numba compiles, once for every n.

It serves balls below the bound of `n.near_n` only, where any rotation with the momentum and a small E is the right one.
"""

from numpy import empty

from .rotation_n import gap, guess, move, polish, remember, roll, slope, solve, turn

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
    k, g, J, D, near, enough, past, use, first, count, every, scale, momenta, verticals,
    with_body, R, spot, rho, attitudes, traces,
):  # fmt: skip
    """Takes `count` steps from the step `first` on, until one does not settle; returns how many.

    k (n, n), g (n), R (n, n) and spot (n - 1) hold the present state and move; past (ORDER, n, n) and use (ORDER)
    have the last rotations.  𝒦 = scale·k.  Every `every`-th state goes to the frame arrays.
    The attitude and the trace are touched only when `with_body`.
    """
    n = k.shape[0]
    E, O, W, T = empty((n, n)), empty((n, n)), empty((n, n)), empty((n * (n - 1) // 2, n * (n - 1) // 2))
    r, h, c = empty(n * (n - 1) // 2), empty(n), empty(n)
    for step in range(first + 1, first + count + 1):
        guess(past, use, E)
        if not settle(k, g, J, D, near, enough, E, O, W, T, r, h, c):
            return step - 1 - first
        remember(E, past, use)
        if with_body:
            roll(E, g, R, spot, rho, c, W)
        move(E, k, g, W, c)
        if step % every == 0:
            frame = step // every
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
