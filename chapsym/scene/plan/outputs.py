"""What a scene can ask for: from which columns of a run each output comes, and by which generated kernels."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from chapsym.dynamics import BallN, invariants_n, kernels
from chapsym.dynamics.ball import Floats

from ..members.members import Members
from ..running.task import Columns, Task


@dataclass(frozen=True)
class Output:
    """needs: the columns that a model must follow; kernels: those evaluated on them; dims beside ball and frame."""

    long_name: str
    units: str
    needs: frozenset[str]
    dims: tuple[str, ...] = ()
    kernels: tuple[str, ...] = ()
    derive: Callable[[Members, Task, Columns], Floats] | None = None


def _omega(members: Members, task: Task, columns: Columns) -> Floats:
    """ω = Λ⁻¹(K + D⟨ω,γ⟩γ), in principal axes, from K = 𝒦/ε (2.4 solved)."""
    J, D = members.ball.mass_tensor[:, np.newaxis], members.ball.D[:, np.newaxis]
    return kernels.angular_velocity(columns["momentum"] / task.scale, _vertical(members, columns), J, D)


def _energy(members: Members, task: Task, columns: Columns) -> Floats:
    """½⟨K,ω⟩ in joules."""
    J, D = members.ball.mass_tensor[:, np.newaxis], members.ball.D[:, np.newaxis]
    return kernels.energy(columns["momentum"] / task.scale, _vertical(members, columns), J, D)


def _vertical(members: Members, columns: Columns) -> Floats:
    """γ, or anything where D = 0 and a model has left it out: then it does not enter."""
    return columns["gamma"] if "gamma" in columns else np.broadcast_to([0.0, 0.0, 1.0], columns["momentum"].shape)


def _integrals(members: Members, task: Task, columns: Columns) -> Floats:
    """The momentum integrals, which the map keeps (Proposition 2)."""
    of = invariants_n if isinstance(members.ball, BallN) else kernels.invariants
    return of(columns["momentum"], columns["gamma"])


_STATE = frozenset({"momentum", "gamma"})

OUTPUTS: dict[str, Output] = {
    "momentum": Output("discrete momentum 𝒦, body axes", "kg m2", frozenset({"momentum"}), ("axis",)),
    "gamma": Output("vertical γ, upwards, body axes", "1", frozenset({"gamma"}), ("axis",)),
    "omega": Output("angular velocity ω, body axes", "rad s-1", _STATE, ("axis",), ("angular_velocity",), _omega),
    "attitude": Output("attitude, body axes to space", "1", frozenset({"attitude"}), ("quaternion",)),
    "contact": Output("contact point", "m", frozenset({"contact"}), ("plane",)),
    "energy": Output("kinetic energy", "J", _STATE, (), ("energy",), _energy),
    "integrals": Output("momentum integrals", "", _STATE, ("integral",), ("invariants",), _integrals),
    "phase": Output("elliptic phase u", "1", frozenset({"phase"})),
    "rotation_number": Output("turns around the invariant curve, a step", "1", frozenset({"rotation_number"})),
}
#: Those that are one number a ball, not one a frame.
PER_BALL = frozenset({"rotation_number"})
#: Those in which γ enters only with D.
WITHOUT_GAMMA = frozenset({"omega", "energy"})


def columns_for(outputs: tuple[str, ...], top: bool) -> frozenset[str]:
    """The columns that a model must follow for these outputs; a `top` (D = 0) leaves out γ where it can."""
    found: set[str] = set()
    for name in outputs:
        found |= OUTPUTS[name].needs - ({"gamma"} if top and name in WITHOUT_GAMMA else set())
    return frozenset(found)
