"""What is derived from a state, ω, the energy and 𝒦 of ω, beside the same in mpmath; and what it asks of its input.

The condition number is componentwise: Σ |∂f/∂x · x|/|f| over the inputs, with γ kept a unit vector.  So nothing is
forgiven that a better formula would not lose: ω of a ball with D = 1e6 is as well conditioned as with D = 1.
"""

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

import numpy as np

from chapsym.dynamics import kernels

from . import states
from .cells import BUDGET, Compared, Judged, compared, worst
from .levels import Level, mp
from .truth import State, componentwise, unit_gamma

Function = Callable[[Sequence[Any]], list[Any]]


def split(inputs: Sequence[Any]) -> tuple[Any, Any, Any, Any]:
    """The vector, γ divided by its length, Λ's entries and D of nine numbers and D: v, γ, J, D."""
    v, g, J, D = inputs[0:3], unit_gamma(inputs[3:6]), inputs[6:9], inputs[9]  # type: ignore[arg-type]
    return v, g, [J[1] + J[2] + D, J[0] + J[2] + D, J[0] + J[1] + D], D


def angular_velocity(inputs: Sequence[Any]) -> list[Any]:
    """ω of K = Λω - D⟨ω,γ⟩γ, by the linear equations."""
    K, g, moments, D = split(inputs)
    operator = mp.diag(moments) - D * mp.matrix(g) * mp.matrix(g).T
    return list(mp.lu_solve(operator, mp.matrix(K)))


def energy(inputs: Sequence[Any]) -> list[Any]:
    """½⟨K,ω⟩."""
    return [sum(k * w for k, w in zip(inputs[:3], angular_velocity(inputs), strict=True)) / 2]


def contact_momentum(inputs: Sequence[Any]) -> list[Any]:
    """K = Λω - D⟨ω,γ⟩γ."""
    omega, g, moments, D = split(inputs)
    along = sum(a * b for a, b in zip(omega, g, strict=True))
    return [m * w - D * along * c for m, w, c in zip(moments, omega, g, strict=True)]


#: name: the function, and the kernel that is judged.
QUANTITIES: dict[str, tuple[Function, str]] = {
    "ω": (angular_velocity, "angular_velocity"),
    "energy": (energy, "energy"),
    "𝒦 of ω": (contact_momentum, "contact_momentum"),
}


@cache
def reference(quantity: str, inputs: tuple[float, ...]) -> tuple[list[Any], float]:
    """The value and its condition number."""
    return componentwise(QUANTITIES[quantity][0], inputs)


def judge(quantity: str, level: Level, state: State) -> Judged:
    """One quantity of one state; `state.K` is its vector: K, or ω."""
    exact, kappa = reference(quantity, (*state.K, *state.g, *state.J, state.D))
    kernel = getattr(kernels, QUANTITIES[quantity][1])
    found = np.atleast_1d(kernel(state.K, state.g, state.J, state.D))
    return compared(level, [Compared(quantity, list(found), exact, BUDGET * (1 + kappa))], kappa)


def _states(D: float, size: float = 1.0) -> list[State]:
    tilted = states.unit((1e-6, -2e-6, 1.0))
    across = states.unit(np.cross(states.G, (0.3, -0.5, 0.8)))
    return [
        State(states.J, D, states.scaled(v, size), g)
        for v, g in (
            (states.K, states.G), (states.K, states.AXIS), (states.G, states.G), (across, states.G),
            (states.AXIS, states.AXIS), (states.K, tilted),
        )
    ]  # fmt: skip


#: name: the states.
CONDITIONS: dict[str, list[State]] = {
    "D = 3": _states(3.0),
    "D = 0": _states(0.0),
    "D = 1e6": _states(1e6),
    "D = 1e12": _states(1e12),
    "momentum 1e-300": _states(3.0, 1e-150),
    "a rod 1e-6 from upright": [State((0.0, 0.0, 1.0), 3.0, states.K, states.unit((1e-6, 0.0, 1.0)))],
    "ratios of 1e12": [State((1e-12, 1e-6, 1.0), 1.0, states.K, states.G)],
}


def of(quantity: str, condition: str, level: Level, quick: bool) -> Judged:
    """The worst of the states of a condition."""
    return worst([judge(quantity, level, state) for state in CONDITIONS[condition]])
