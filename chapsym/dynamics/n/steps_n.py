"""Steps in n dimensions, each continued from the identity, on whatever numbers NumPy's arrays hold."""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from ..ball import Floats
from ..errors import Status
from . import so_n
from .branch_n import small_rotation


def some_balls(state: dict[str, Floats], at: np.ndarray) -> dict[str, Floats]:
    """The state of some of the balls."""
    return {name: array[at] for name, array in state.items()}


def continued(
    state: dict[str, Floats], frames: dict[str, Floats], stages: Iterable[Any], steps: int, every: int,
    taken: np.ndarray, status: np.ndarray, reach: Floats, at: np.ndarray,
    rotations: Callable[..., tuple[Floats, np.ndarray, Floats]] = small_rotation,
) -> dict[str, Floats]:  # fmt: skip
    """Steps some balls together, the rows `at` of what else is given, and writes these in place.

    rotations: what finds the rotations of a stage, as `small_rotation` in float64.
    Returns the state of the balls that took all steps.
    """
    for step in range(1, steps + 1):
        for c in stages:
            K, rest = c * state["momentum"], (state[x] for x in ("gamma", "mass_tensor", "D"))
            E, status[at], reach[at] = rotations(K, *rest)
            went = status[at] == Status.TAKEN
            if not went.all():
                at, E, state = at[went], E[went], some_balls(state, went)
                if not at.size:
                    return state
            state = _moved(state, E)
        taken[at] += 1
        if step % every == 0:
            for name in frames:
                frames[name][at, step // every] = state[name]
    return state


def _moved(state: dict[str, Floats], E: Floats) -> dict[str, Floats]:
    """The state after the rotation 1 + E: 𝒦 and γ, and those of attitude and contact that there are."""
    K, g = state["momentum"], state["gamma"]
    after = {**state, "momentum": so_n.carried(K, E), "gamma": so_n.transported(g, E)}
    if "contact" in state:
        stride = (state["attitude"] @ so_n.twist(E, g)[..., np.newaxis])[..., :-1, 0]
        after["contact"] = state["contact"] + state["radius"][:, np.newaxis] / 2 * stride
    if "attitude" in state:
        after["attitude"] = so_n.polar(state["attitude"] + state["attitude"] @ E)
    return after
