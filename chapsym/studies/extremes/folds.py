"""Where a branch folds, to many digits: 𝒦(q, γ) = t𝒦 and det T = 0, solved in mpmath by the oracle's matrices."""

from functools import cache
from typing import Any

from chapsym.dynamics import Ball, fold
from chapsym.dynamics.oracle import Oracle

from .truth import Vector, rotation_matrix

DIGITS = 40


@cache
def fold_at(J: Vector, D: float, K: Vector, g: Vector) -> Any:
    """The t at which the small-rotation branch along t𝒦 folds, as an mpf; `chapsym.fold` gives where to start."""
    near = fold(Ball(J, D), K, g)
    oracle = Oracle(J, D, g, DIGITS)
    mp = oracle.mp
    start = [mp.mpf(float(x)) for x in near.rotation]
    _, largest = max((abs(x), i) for i, x in enumerate(start))

    def equations(*unknown: Any) -> list[Any]:
        *p, t = unknown
        full = [*p[:largest], start[largest], *p[largest:]]
        norm = sum(x * x for x in full)
        turned = rotation_matrix(mp, full) / norm
        moved = oracle.momentum(turned)
        gap = [x - t * k for x, k in zip(oracle.components(moved), map(mp.mpf, K), strict=True)]
        return [*gap, 8 * mp.det(oracle.tangent(turned))]

    first = [*start[:largest], *start[largest + 1 :], mp.mpf(float(near.reach))]
    return mp.findroot(equations, first, tol=mp.mpf(10) ** (-2 * DIGITS + 20))[3]
