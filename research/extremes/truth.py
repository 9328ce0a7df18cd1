"""The truth from the oracle, the matrix equation (4.13) in mpmath: of a step, of a run, and where a branch folds.

    κ = 1 + |T⁻¹| (|𝒦| + 2 I_max |q|) / |q|,  T the tangent Jacobian in the Gibbs vector,

is the condition number of a step, as in `chapsym.studies.check`, here from the oracle's matrices.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from mpmath import MPContext, matrix, mpf

from chapsym.dynamics import Ball, fold
from chapsym.dynamics.oracle import Oracle, OracleFailed

from .judging import BUDGET, mp

#: More than any precision has, and what the root near its fold, and the Euler parameters near π, cost: `KNOWN` is left.
DIGITS = 115
#: And of the fold, of which a difference takes half.
FOLD_DIGITS = 40
#: The start of a run is changed by this, relatively, in a direction that is none in particular.
RUN_CHANGE, DIRECTION = mp.mpf(10) ** -40, (1.0, -0.7, 0.4)

Vector = tuple[float, ...]


def scaled(v: Iterable[float], factor: float) -> Vector:
    """A vector times a number."""
    return tuple(factor * c for c in v)


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

    @property
    def ball(self) -> Ball:
        """The ball."""
        return Ball(self.J, self.D)


@dataclass(frozen=True)
class Truth:
    """The step: Euler parameters, 𝒦 and γ after it, all mpf; and κ."""

    q0: mpf
    q: list[mpf]
    momentum: list[mpf]
    gamma: list[mpf]
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
    kappa = condition(state, oracle, oracle.tangent(step.rotation) * 2, max(map(abs, q)))
    return Truth(mp.convert(step.q0), q, momentum, gamma, kappa)


def condition(state: State, oracle: Oracle, tangent: matrix, extent: mpf) -> float:
    """κ of a state whose rotation has this tangent and extent."""
    largest = sum(sorted(state.J)[-2:])
    inverse = (tangent / largest) ** -1  # of T by the largest moment, so that it is a float
    stretch = float(np.linalg.norm(np.array(inverse.tolist(), dtype=float), 2))
    size = max(abs(mp.mpf(x)) for x in state.K)
    return 1.0 + stretch * (float(size / (extent * largest)) if extent else 0.0) + 2 * stretch


def unit_gamma(g: Iterable[float]) -> list[mpf]:
    """γ divided by its length."""
    exact = [mp.mpf(x) for x in g]
    length = mp.sqrt(sum(x * x for x in exact))
    return [x / length for x in exact]


@cache
def reachable(state: State) -> bool:
    """Whether any rotation has as much momentum in the direction of 𝒦: a quadratic form in the Euler parameters."""
    oracle = Oracle(state.J, state.D, unit_gamma(state.g), 40)
    K = [mp.mpf(x) for x in state.K]
    length = mp.sqrt(sum(x * x for x in K))

    def along(p: Sequence[mpf]) -> mpf:
        moved = oracle.components(oracle.momentum(rotation_matrix(oracle.mp, p)))
        return sum(k * x for k, x in zip(K, moved, strict=True)) / length

    basis = [[int(i == j) for j in range(4)] for i in range(4)]
    form = mp.matrix(4, 4)
    for i, a in enumerate(basis):
        for j, b in enumerate(basis):
            plus, minus = ([x + s * y for x, y in zip(a, b, strict=True)] for s in (1, -1))
            form[i, j] = (along(plus) - along(minus)) / 4
    return bool(length <= max(mp.eigsy(form, eigvals_only=True)) * (1 + mp.mpf("1e-12")))


def rotation_matrix(context: MPContext, p: Sequence[mpf]) -> matrix:
    """The matrix of Euler parameters of any length, times its square: quadratic in them."""
    a, x, y, z = (context.mpf(v) for v in p)
    return context.matrix([
        [a * a + x * x - y * y - z * z, 2 * (x * y - a * z), 2 * (x * z + a * y)],
        [2 * (x * y + a * z), a * a - x * x + y * y - z * z, 2 * (y * z - a * x)],
        [2 * (x * z - a * y), 2 * (y * z + a * x), a * a - x * x - y * y + z * z],
    ])  # fmt: skip


@cache
def fold_at(J: Vector, D: float, K: Vector, g: Vector) -> mpf:
    """The t at which the small-rotation branch along t𝒦 folds, as an mpf: 𝒦(q, γ) = t𝒦 and det T = 0.

    Solved by the oracle's matrices; `chapsym.fold` gives where to start.
    """
    near = fold(Ball(J, D), K, g)
    oracle = Oracle(J, D, g, FOLD_DIGITS)
    context = oracle.mp
    start = [context.mpf(float(x)) for x in near.rotation]
    largest = max(range(4), key=lambda i: abs(start[i]))

    def equations(*unknown: mpf) -> list[mpf]:
        *p, t = unknown
        full = [*p[:largest], start[largest], *p[largest:]]
        turned = rotation_matrix(context, full) / sum(x * x for x in full)
        moved = oracle.components(oracle.momentum(turned))
        gap = [x - t * k for x, k in zip(moved, map(context.mpf, K), strict=True)]
        return [*gap, 8 * context.det(oracle.tangent(turned))]

    first = [*start[:largest], *start[largest + 1 :], context.mpf(float(near.reach))]
    return context.findroot(equations, first, tol=context.mpf(10) ** (-2 * FOLD_DIGITS + 20))[3]


@cache
def chain(state: State, stages: Vector) -> list[Truth]:
    """The oracle's steps with the momenta cᵢ𝒦, one from the other; raises ArithmeticError where there is none."""
    steps: list[Truth] = []
    for c in stages:
        step = truth(replace(state, K=tuple(c * mp.mpf(x) for x in state.K)))
        if step is None:
            raise ArithmeticError("the oracle meets a fold on the way")
        steps.append(step)
        state = replace(state, K=tuple(x / c for x in step.momentum), g=tuple(step.gamma))
    return steps


@cache
def promised(state: State, stages: Vector) -> float:
    """A Σ 4(1 + |q|κ) ulps: each step what a single one does, times A ≥ 1, what the run makes of a small change."""
    steps = chain(state, stages)
    size = max(abs(mp.mpf(x)) for x in state.K)
    moved = tuple(mp.mpf(x) + RUN_CHANGE * size * part for x, part in zip(state.K, DIRECTION, strict=True))
    end = chain(replace(state, K=moved), stages)[-1]
    gaps = [abs(a - b) / size for a, b in zip(end.momentum, steps[-1].momentum, strict=True)]
    gaps += [abs(a - b) for a, b in zip(end.gamma, steps[-1].gamma, strict=True)]
    stretch = max(1.0, float(max(gaps) / RUN_CHANGE))
    return stretch * sum(BUDGET * (1 + float(max(map(abs, step.q))) * step.condition) for step in steps)
