"""The step in n = 4 dimensions, beside (4.13) in mpmath: the oracle's iteration in so(n), for matrices of any size."""

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

import numpy as np

from chapsym.dynamics import BadInput, BallN, StepNotTaken, step_n

from .cells import BUDGET, Compared, Judged, compared, worst
from .levels import Level, mp
from .steps import refused

#: 𝒦 below the diagonal, row by row, of a generic state; γ, J and D with it.
K, G, J, D = (0.3, -0.2, 0.5, 0.1, 0.4, -0.25), (0.1, 0.1, 0.7, 0.7), (1.0, 2.0, 0.5, 3.0), 3.0
#: The oracle's steps along t𝒦, halved where Newton's iteration does not contract, down to this.
SHORTEST = mp.mpf(10) ** -8
SETTLED = mp.mpf(10) ** -20  # Newton squares it


def skew(x: Sequence[Any]) -> Any:
    """The skew matrix with these entries below its diagonal."""
    matrix, entries = mp.matrix(4, 4), iter(x)
    for i in range(4):
        for j in range(i):
            matrix[i, j] = mp.mpf(next(entries))
            matrix[j, i] = -matrix[i, j]
    return matrix


def below(matrix: Any) -> list[Any]:
    """The entries below the diagonal."""
    return [matrix[i, j] for i in range(4) for j in range(i)]


def momentum(X: Any, g: Any, tensor: Any, contact: Any) -> Any:
    """(4.13): XJ - JXᵀ + D/2 (XΓ - ΓXᵀ + ΓX - XᵀΓ)."""
    Gamma = g * g.T
    return X * tensor - tensor * X.T + contact / 2 * (X * Gamma - Gamma * X.T + Gamma * X - X.T * Gamma)


@cache
def truth(x: tuple[float, ...], g: tuple[float, ...], J: tuple[float, ...], D: float) -> tuple[Any, Any, Any, float]:
    """Ω - 1, 𝒦 and γ after the step, and κ = 1 + |T⁻¹|(|𝒦| + 2 I_max |Ω - 1|)/|Ω - 1|; ArithmeticError at a fold."""
    size = max(map(abs, x))
    with mp.workdps(mp.dps + (max(0, -int(np.log10(size))) if size else 0)):  # Ω - 1 is as small as 𝒦
        return _truth(x, g, J, D, size)


def _truth(
    x: tuple[float, ...], g: tuple[float, ...], J: tuple[float, ...], D: float, size: float
) -> tuple[Any, Any, Any, float]:
    gamma, tensor, contact, target = mp.matrix(g), mp.diag([mp.mpf(v) for v in J]), mp.mpf(D), skew(x)
    basis = [skew([int(i == j) for j in range(6)]) for i in range(6)]
    R, t, dt = mp.eye(4), mp.zero, mp.one
    while t < 1:
        trial = min(mp.one, t + dt)
        moved = _newton(R, trial * target, gamma, tensor, contact, basis)
        if moved is None:
            dt /= 2
            if dt < SHORTEST:
                raise ArithmeticError("the branch folds")
        else:
            R, t = moved, trial
    jacobian = mp.matrix([below(momentum(R * e, gamma, tensor, contact)) for e in basis]).T
    top = sum(sorted(J)[-2:])
    stretch = float(np.linalg.norm(np.array(((jacobian / top) ** -1).tolist(), dtype=float), 2))
    E = R - mp.eye(4)
    extent = max(abs(v) for v in E)
    kappa = 1 + stretch * (float(mp.mpf(size) / (extent * top)) if size else 0.0) + 2 * stretch
    return E, R.T * target * R, R.T * gamma, kappa


def _newton(R: Any, target: Any, g: Any, tensor: Any, contact: Any, basis: list[Any]) -> Any:
    """Newton's iteration, Ω becoming Ω·Cayley(ξ); None if it does not contract from 0.2 radians on."""
    largest = mp.mpf("0.2")
    for _ in range(40):
        jacobian = mp.matrix([below(momentum(R * e, g, tensor, contact)) for e in basis]).T
        xi = mp.lu_solve(jacobian, mp.matrix(below(target - momentum(R, g, tensor, contact))))
        size = mp.norm(xi)
        if size > largest:
            return None
        half = skew([v / 2 for v in xi])
        R = R * (mp.inverse(mp.eye(4) - half) * (mp.eye(4) + half))
        if size <= SETTLED * mp.norm(R - mp.eye(4)):
            return R
        largest = 3 * size / 4
    return None


#: A state: the entries of 𝒦, γ, J and D.
StateN = tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...], float]
_AXIS = (0.0, 0.0, 0.0, 1.0)
_VERTICAL = (0.0, 0.0, 0.0, 0.4, 0.0, 0.0)

CONDITIONS: dict[str, list[StateN]] = {
    "generic": [(K, G, J, D)],
    "momentum 1e-12": [(tuple(1e-12 * x for x in K), G, J, D)],
    "momentum 1e-300": [(tuple(1e-300 * x for x in K), G, J, D)],
    "momentum 5e-320": [(tuple(5e-320 * x for x in K), G, J, D)],
    "at rest": [((0.0,) * 6, G, J, D)],
    "D = 0": [(K, G, J, 0.0)],
    "D = 1e6": [(K, G, J, 1e6)],
    "D = 1e12": [(K, G, J, 1e12)],
    "J equal": [(K, G, (1.0,) * 4, D)],
    "J 1e-15 apart": [(K, G, (1.0, 1 + 1e-15, 1 - 1e-15, 1.0), D)],
    "a flat body, one J = 0": [(K, G, (1.0, 0.0, 0.5, 3.0), D)],
    "ratios of 1e12": [(K, G, (1e-12, 1.0, 1e-6, 3.0), D)],
    "γ along an axis": [(K, _AXIS, J, D)],
    "one plane only": [(_VERTICAL, G, J, D), (_VERTICAL, _AXIS, J, D)],
    "a body of size 1e-150": [(tuple(1e-150 * x for x in K), G, tuple(1e-150 * x for x in J), 3e-150)],
    "a body of size 1e150": [(tuple(1e150 * x for x in K), G, tuple(1e150 * x for x in J), 3e150)],
}


def judge(level: Level, state: StateN) -> Judged:
    """One step in four dimensions: Ω - 1 within 4κ ulps, 𝒦 and γ within 4(1 + |Ω - 1|κ)."""
    x, g, J, D = state
    E, after, gamma, kappa = truth(*state)
    matrix = np.array(skew(x).tolist(), dtype=float)
    try:
        found = step_n(BallN(J, D), matrix, g)
    except (BadInput, StepNotTaken) as refusal:
        return refused(str(refusal), None)
    extent = float(max(abs(v) for v in E))
    moved = BUDGET * (1 + extent * kappa)
    vectors = [
        Compared("the rotation", list(found.rotation.flat), [v + int(i % 5 == 0) for i, v in enumerate(E)], moved, 1),
        Compared("the momentum", list(found.momentum.flat), list(after), moved),
        Compared("gamma", list(found.gamma), list(gamma), moved, 1),
    ]
    return compared(level, vectors, kappa)


def of(condition: str) -> Callable[[Level, bool], Judged]:
    """What judges the worst of the states of a condition."""
    return lambda level, quick: worst([judge(level, state) for state in CONDITIONS[condition]])
