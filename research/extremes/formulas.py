"""Closed formulas beside the same in mpmath: ω, the energy, 𝒦 of ω.

The condition number is componentwise: Σ |∂f/∂x · x|/|f| over the inputs, with γ kept a unit vector.  So nothing is
forgiven that a better formula would not lose: ω of a ball with D = 1e6 is as well conditioned as with D = 1.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from chapsym.dynamics import kernels

from . import states
from .judging import BUDGET, Judged, Level, compared, mp
from .states import AXIS, RATIOS, ROD, D, G, J, K
from .truth import State, componentwise, scaled, unit_gamma

Inputs = Sequence[Any]


def moments(J: Inputs, D: Any) -> list[Any]:
    """Λ's entries."""
    return [J[1] + J[2] + D, J[0] + J[2] + D, J[0] + J[1] + D]


def angular_velocity(inputs: Inputs) -> list[Any]:
    """ω of K = Λω - D⟨ω,γ⟩γ, by the linear equations; of K, γ, J and D."""
    g, D = mp.matrix(unit_gamma(inputs[3:6])), inputs[9]
    return list(mp.lu_solve(mp.diag(moments(inputs[6:9], D)) - D * g * g.T, mp.matrix(inputs[:3])))


def energy(inputs: Inputs) -> list[Any]:
    """½⟨K,ω⟩."""
    return [sum(k * w for k, w in zip(inputs[:3], angular_velocity(inputs), strict=True)) / 2]


def contact_momentum(inputs: Inputs) -> list[Any]:
    """K = Λω - D⟨ω,γ⟩γ, of ω, γ, J and D."""
    omega, g, D = inputs[:3], unit_gamma(inputs[3:6]), inputs[9]
    along = sum(a * b for a, b in zip(omega, g, strict=True))
    return [m * w - D * along * c for m, w, c in zip(moments(inputs[6:9], D), omega, g, strict=True)]


#: A quantity, and the function that is the truth of the kernel of its name.
QUANTITIES = {"ω": angular_velocity, "energy": energy, "𝒦 of ω": contact_momentum}


def derived(item: tuple[str, State], level: Level, quick: bool) -> Judged:
    """A quantity of a state, whose vector is K, or ω, within 4(1 + κ) ulps."""
    quantity, state = item
    function = QUANTITIES[quantity]
    found = getattr(kernels, function.__name__)(state.K, state.g, state.J, state.D)
    truth, kappa = componentwise(function, (*state.K, *state.g, *state.J, state.D))
    return compared(level, kappa, quantity, np.atleast_1d(found), truth, BUDGET * (1 + kappa))


def _several(D: float, size: float = 1.0) -> list[State]:
    pairs = (K, G), (K, AXIS), (G, G), (states.ACROSS, G), (AXIS, AXIS), (K, states.unit((1e-6, -2e-6, 1.0)))
    return [State(J, D, scaled(v, size), g) for v, g in pairs]


def items() -> dict[str, list[tuple[str, State]]]:
    """What is derived, by quantity and condition."""
    conditions = {
        **{f"D = {D}": _several(float(D)) for D in ("3", "0", "1e6", "1e12")},
        "momentum 1e-300": _several(3.0, 1e-150),
        "a rod 1e-6 from upright": [State(ROD, D, K, states.unit((1e-6, 0.0, 1.0)))],
        "ratios of 1e12": [State(RATIOS, 1.0, K, G)],
    }
    return {f"{q}: {name}": [(q, state) for state in those] for q in QUANTITIES for name, those in conditions.items()}
