"""The truth about one step, from the oracle: the matrix equation (4.13) in mpmath, and its condition number.

    κ = 1 + |T⁻¹| (|𝒦| + 2 I_max |q|) / |q|,  T the tangent Jacobian in the Gibbs vector,

as in `studies.check`, here from the oracle's matrices.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from chapsym.dynamics.oracle import Oracle, OracleFailed

from .levels import mp

#: More than any precision has, and what the root near its fold, and the Euler parameters near π, cost: `KNOWN` is left.
DIGITS = 115
#: An input is changed by this, relatively, to see what becomes of the output.
CHANGE = mp.mpf(10) ** -50

Vector = tuple[float, float, float]


def scaled(v: Iterable[float], factor: float) -> Vector:
    """A vector times a number."""
    x, y, z = (factor * c for c in v)
    return x, y, z


@dataclass(frozen=True)
class State:
    """A ball and its state, in float64, exactly.

    from_fold: how far 𝒦 is from the fold, relatively: positive before it, negative beyond; None if it is far.
    """

    J: Vector
    D: float
    K: Vector
    g: Vector
    from_fold: float | None = None


@dataclass(frozen=True)
class Truth:
    """The step: Euler parameters, 𝒦 and γ after it, all mpf; and κ.  None where there is no small rotation."""

    q0: Any
    q: list[Any]
    momentum: list[Any]
    gamma: list[Any]
    condition: float


@cache
def truth(state: State) -> Truth | None:
    """The step of the state, with γ divided by its length; None where the branch has folded."""
    if state.from_fold is not None and state.from_fold < 0:
        return None  # known from `fold_at`; the oracle would search long
    oracle = Oracle(state.J, state.D, unit_gamma(state.g), DIGITS)
    try:
        step = oracle.step(state.K)
    except OracleFailed:
        return None
    q, momentum, gamma = ([mp.convert(x) for x in v] for v in (step.q, step.momentum, step.gamma))
    kappa = condition(state, oracle, step.rotation, q)
    return Truth(mp.convert(step.q0), q, momentum, gamma, kappa)


def unit_gamma(g: Vector) -> list[Any]:
    """γ divided by its length."""
    exact = [mp.mpf(x) for x in g]
    length = mp.sqrt(sum(x * x for x in exact))
    return [x / length for x in exact]


def condition(state: State, oracle: Oracle, rotation: Any, q: list[Any]) -> float:
    """κ of the state at its rotation."""
    largest = sum(state.J) - min(state.J)
    scaled_tangent = oracle.tangent(rotation) * 2 / largest  # T, so that its inverse is a float
    stretch = np.linalg.norm(np.array((scaled_tangent**-1).tolist(), dtype=float), 2)
    size, extent = max(abs(mp.mpf(x)) for x in state.K), max(map(abs, q))
    return 1.0 + float(stretch * float(size / (extent * largest) if extent else 0) + 2 * stretch)


def componentwise(
    function: Callable[[Sequence[Any]], list[Any]], inputs: Sequence[Any], change: Any = CHANGE
) -> tuple[list[Any], float]:
    """f of the inputs, in mpmath, and Σ |∂f/∂x · x|/|f|, with the largest component as the norm."""
    exact = [mp.mpf(x) for x in inputs]
    value = [mp.convert(x) for x in function(exact)]
    size = max(map(abs, value))
    total = mp.zero
    for i, x in enumerate(exact):
        if x == 0:
            continue
        moved = function([*exact[:i], x * (1 + change), *exact[i + 1 :]])
        total += max(abs(mp.convert(a) - b) for a, b in zip(moved, value, strict=True)) / change
    return value, float(total / size) if size else 0.0


@cache
def reachable(state: State) -> bool:
    """Whether any rotation has as much momentum in the direction of 𝒦: a quadratic form in the Euler parameters."""
    oracle = Oracle(state.J, state.D, unit_gamma(state.g), 40)
    K = [mp.mpf(x) for x in state.K]
    length = mp.sqrt(sum(x * x for x in K))

    def along(p: Any) -> Any:
        moved = oracle.components(oracle.momentum(rotation_matrix(oracle.mp, p)))
        return sum(k * x for k, x in zip(K, moved, strict=True)) / length

    basis = [[int(i == j) for j in range(4)] for i in range(4)]
    form = mp.matrix(4, 4)
    for i, a in enumerate(basis):
        for j, b in enumerate(basis):
            plus, minus = ([x + s * y for x, y in zip(a, b, strict=True)] for s in (1, -1))
            form[i, j] = (along(plus) - along(minus)) / 4
    return bool(length <= max(mp.eigsy(form, eigvals_only=True)) * (1 + mp.mpf("1e-12")))


def rotation_matrix(context: Any, p: list[Any]) -> Any:
    """The matrix of Euler parameters of any length, times its square: quadratic in them."""
    a, x, y, z = (context.mpf(v) for v in p)
    return context.matrix([
        [a * a + x * x - y * y - z * z, 2 * (x * y - a * z), 2 * (x * z + a * y)],
        [2 * (x * y + a * z), a * a - x * x + y * y - z * z, 2 * (y * z - a * x)],
        [2 * (x * z - a * y), 2 * (y * z + a * x), a * a - x * x - y * y + z * z],
    ])  # fmt: skip
