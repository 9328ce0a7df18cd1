"""The step in n = 4 dimensions, beside the oracle's."""

from functools import cache
from typing import Any

import numpy as np

from chapsym.dynamics import BadInput, BallN, StepNotTaken, step_n
from chapsym.dynamics.oracle import Oracle

from .cells import BUDGET, Compared, Judged, compared, worst
from .levels import Level, mp
from .steps import refused
from .truth import DIGITS

#: 𝒦 below the diagonal, row by row, of a generic state; γ, J and D with it.
K, G, J, D = (0.3, -0.2, 0.5, 0.1, 0.4, -0.25), (0.1, 0.1, 0.7, 0.7), (1.0, 2.0, 0.5, 3.0), 3.0


@cache
def truth(x: tuple[float, ...], g: tuple[float, ...], J: tuple[float, ...], D: float) -> tuple[Any, Any, Any, float]:
    """Ω - 1, 𝒦 and γ after the step, and κ = 1 + |T⁻¹|(|𝒦| + 2 I_max |Ω - 1|)/|Ω - 1|; ArithmeticError at a fold."""
    oracle = Oracle(J, D, g, DIGITS)
    step = oracle.step(x)
    one = oracle.mp.eye(4)
    E, after = step.rotation - one, oracle.skew(step.momentum)
    top = sum(sorted(J)[-2:])
    tangent = oracle.tangent(step.rotation) / top  # so that its inverse is a float
    stretch = float(np.linalg.norm(np.array((tangent**-1).tolist(), dtype=float), 2))
    size, extent = max(map(abs, x)), max(abs(v) for v in E)
    kappa = 1 + stretch * (float(mp.mpf(size) / (mp.convert(extent) * top)) if size else 0.0) + 2 * stretch
    E, after, gamma = ([mp.convert(v) for v in found] for found in (E, after, step.gamma))
    return E, after, gamma, kappa


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
    matrix = np.array(Oracle(J, D, g).skew(x).tolist(), dtype=float)
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


def of(condition: str, level: Level, quick: bool) -> Judged:
    """The worst of the states of a condition."""
    return worst([judge(level, state) for state in CONDITIONS[condition]])
