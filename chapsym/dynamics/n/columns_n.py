"""The steps of `loops.loop_n` for many balls at once, in NumPy: on each ball the same operations, in the same order.

Every array has the balls along its last axis.  Nothing is summed by a library, which would choose an order of its own.
"""

from functools import cache
from typing import NamedTuple

import numpy as np

from ..ball import Floats
from ..loops.loop_n import MOST_ROUNDS
from ..loops.rotation_n import ORDER
from . import so_n


def guess(past: Floats, use: Floats) -> Floats:
    """`rotation_n.guess`: E (n, n, b)."""
    E = use[ORDER - 1] * past[ORDER - 1]
    for m in range(ORDER - 2, -1, -1):
        E += use[m] * past[m]
    return E


def remember(E: Floats, past: Floats, use: Floats) -> None:
    """`rotation_n.remember`."""
    more = E
    for m in range(ORDER):
        past[m], more = more, more - past[m]
    use[1:] = use[:-1].copy()
    use[0] = 1.0


def _product(A: Floats, B: Floats) -> Floats:
    """Σ A[i, m] B[m, j], m from 0 on."""
    total = A[:, 0, np.newaxis] * B[0]
    for m in range(1, len(B)):
        total += A[:, m, np.newaxis] * B[m]
    return total


def _onto(start: Floats, A: Floats, B: Floats) -> Floats:
    """The same, onto `start`, which is kept."""
    total = start + A[:, 0, np.newaxis] * B[0]
    for m in range(1, len(B)):
        total += A[:, m, np.newaxis] * B[m]
    return total


def _applied(A: Floats, v: Floats) -> Floats:
    """Σ A[i, m] v[m], m from 0 on."""
    total = A[:, 0] * v[0]
    for m in range(1, len(v)):
        total += A[:, m] * v[m]
    return total


def _sum(terms: Floats) -> Floats:
    """The sum along the first axis, from its beginning on."""
    return np.add.accumulate(terms)[-1]


def polish(E: Floats) -> tuple[Floats, Floats]:
    """`rotation_n.polish`: (E, how far it was, squared)."""
    n = len(E)
    W = _onto(E + E.swapaxes(0, 1), E.swapaxes(0, 1), E)
    below = W[np.tril_indices(n)]
    return E - 0.5 * _onto(W, E, W), _sum(below * below)


def gap(E: Floats, k: Floats, g: Floats, J: Floats, D: Floats) -> Floats:
    """`rotation_n.gap`: (N, b)."""
    rows, columns = so_n.places(len(E))
    c = 0.5 * D * _applied(E - E.swapaxes(0, 1), g)
    half = E * J + c[:, np.newaxis] * g
    return k[rows, columns] - (half[rows, columns] - half[columns, rows])


class Places(NamedTuple):
    """Where the entries of `rotation_n.slope` come from: its coordinates (p, q), and what is added to which rows."""

    p: np.ndarray
    q: np.ndarray
    at: tuple[np.ndarray, np.ndarray]
    row: tuple[np.ndarray, np.ndarray]
    i: tuple[np.ndarray, np.ndarray]
    sign: tuple[Floats, Floats]


@cache
def _places(n: int) -> Places:
    p, q = so_n.places(n)
    found = []
    for line in (p, q):
        every = [
            (at, i * (i - 1) // 2 + x if i > x else x * (x - 1) // 2 + i, i, 1.0 if i > x else -1.0)
            for at, x in enumerate(line.tolist())
            for i in range(n)
            if i != x
        ]
        found.append([np.array(x) for x in zip(*every, strict=True)])
    at, row, i, sign = zip(*found, strict=True)
    return Places(p, q, at, row, i, sign)


def slope(E: Floats, g: Floats, J: Floats, D: Floats) -> Floats:
    """`rotation_n.slope`: (N, N, b)."""
    n = len(E)
    p, q, at, row, i, sign = _places(n)
    every = np.arange(len(p))
    O = E + np.eye(n)[..., np.newaxis]
    h, d = 0.5 * D * _applied(O.swapaxes(0, 1), g), 0.5 * D * g
    c = (O[:, p] * d[q] - O[:, q] * d[p]).swapaxes(0, 1)
    c[every, q] -= h[p]
    c[every, p] += h[q]
    T = c[:, p] * g[q] - c[:, q] * g[p]
    T[at[0], row[0]] -= sign[0][:, np.newaxis] * (O[i[0], q[at[0]]] * J[p[at[0]]])
    T[at[1], row[1]] += sign[1][:, np.newaxis] * (O[i[1], p[at[1]]] * J[q[at[1]]])
    return T


def solve(T: Floats, r: Floats) -> None:
    """`rotation_n.solve`."""
    for k in range(len(r)):
        inverse = 1.0 / T[k, k]
        T[k + 1 :, k] *= inverse
        T[k + 1 :, k + 1 :] -= T[k + 1 :, k, np.newaxis] * T[k, k + 1 :]
        r[k] *= inverse
        r[k + 1 :] -= r[k] * T[k, k + 1 :]
    for i in range(len(r) - 1, 0, -1):
        r[:i] -= r[i] * T[i, :i]


def turn(E: Floats, r: Floats) -> tuple[Floats, Floats, Floats]:
    """`rotation_n.turn`: (E, Σ ξᵢⱼ², i > j, Σ Eᵢⱼ²)."""
    rows, columns = so_n.places(len(E))
    xi = np.zeros(E.shape)
    xi[rows, columns], xi[columns, rows] = r, -r
    W = xi + 0.5 * _product(xi, xi)
    E = E + _onto(W, E, W)
    return E, _sum(r * r), _sum((E * E).reshape(-1, E.shape[-1]))


def settle(
    E: Floats, k: Floats, g: Floats, J: Floats, D: Floats, near: Floats, enough: Floats
) -> tuple[Floats, np.ndarray]:
    """`loop_n.settle`: (E, whether it settled)."""
    result, settled, at = E.copy(), np.zeros(len(D), dtype=bool), np.arange(len(D))
    for _ in range(MOST_ROUNDS):
        E, far = polish(E)
        r, T = gap(E, k, g, J, D), slope(E, g, J, D)
        solve(T, r)
        E, change, size = turn(E, r)
        off = change + far
        done = off * off <= enough * enough * size
        result[..., at[done]], settled[at[done]] = E[..., done], size[done] <= near[done]
        if done.all():
            break
        if done.any():
            at = at[~done]
            E, k, g, J, D, near, enough = (x[..., ~done] for x in (E, k, g, J, D, near, enough))
    return result, settled


def roll(E: Floats, g: Floats, R: Floats, spot: Floats, rho: Floats) -> None:
    """`rotation_n.roll`."""
    n = len(E)
    c = _applied(E - E.swapaxes(0, 1), g)
    spot += 0.5 * rho * _applied(R[:-1], c)
    R[:] = _onto(R, R, E)
    W = _product(R.swapaxes(0, 1), R) - np.eye(n)[..., np.newaxis]
    R -= 0.5 * _product(R, W)


def move(E: Floats, k: Floats, g: Floats) -> None:
    """`rotation_n.move`."""
    back = E.swapaxes(0, 1)
    g += _applied(back, g)
    W = _product(k, E)
    half = W + 0.5 * _product(back, W)
    k += half - half.swapaxes(0, 1)
