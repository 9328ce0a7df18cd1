"""Vertical momentum: the reduced map G_h on the sphere, where γ is the whole state."""

import numpy as np

from chapsym.dynamics import BadInput, Ball, Curve, Status, StepNotTaken, rotation_number, trajectory_vertical

from ...members.members import Members, one_ball
from ...read.task import Columns, Task
from .model import Model, Progress, State, beyond_a_reduction

#: How far 𝒦 may be from hγ, relatively: 𝒦 was rounded, and its motion stays as near as that to the one with 𝒦 = hγ.
VERTICAL = 4 * np.finfo(np.float64).eps
#: Next to the separatrix roundings lead from curve to curve, and to the other side of it, where k' is less than this.
NEAREST = 1e-6


class Vertical(Model):
    """`trajectory_vertical`, and the phase u of γ on its elliptic curve."""

    name = "vertical momentum"
    about = "γ alone, on the sphere: 𝒦 = hγ; its phase on the curve ⟨γ,Λ⁻¹γ⟩ = l"
    columns = frozenset({"momentum", "gamma", "phase", "rotation_number"})
    kernels = {  # noqa: RUF012
        "gamma": ("gibbs_newton", "gibbs_second", "turn"),
        "momentum": ("gibbs_newton", "gibbs_second", "turn"),
        "phase": ("gibbs_newton", "gibbs_second", "turn"),
        "rotation_number": ("gibbs_newton", "gibbs_second", "turn"),
    }
    reduction = True
    unit_steps = 2**25

    def refuses(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Momenta that are not vertical."""
        if (reason := beyond_a_reduction(members, task)) is not None:
            return reason
        assert isinstance(members.ball, Ball)
        K, height = members.momentum, heights(members)
        apart = np.abs(K - height[:, np.newaxis] * members.gamma).max(axis=-1) > VERTICAL * np.abs(height)
        if apart.any() or (height == 0).any():
            return f"the momentum of {members.names[int(np.argmax(apart | (height == 0)))]} is not along γ"
        return None

    def unfit(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Points that stay, and the separatrix, where a phase is asked for."""
        if not needed & {"phase", "rotation_number"}:
            return None
        for i, name in enumerate(members.names):
            try:
                curve = Curve.through(one_ball(members, i), members.gamma[i])
            except BadInput as error:
                return f"{name}: {error}"
            if curve.complement < NEAREST:
                return f"{name} is on the separatrix, where the period is infinite, or too near to it for a phase"
        return None

    def price(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """The steps of each ball, its phases, and the steps of its rotation number."""
        frame = 1300.0 if "phase" in needed else 10.0
        turns = 5e7 if "rotation_number" in needed else 0.0
        return len(members) * (task.steps * 25.0 + task.frames * frame + turns)

    def begin(self, members: Members, task: Task, needed: frozenset[str]) -> State:
        """γ and h; and the rotation number, which every segment tells and one computes."""
        height = heights(members)
        state = super().begin(members, task, needed) | {"gamma": members.gamma, "height": height}
        if "rotation_number" in needed:
            state["rotation_number"] = np.array([_turns(members, i, height[i]) for i in range(len(members))])
        return state

    def advance(
        self, members: Members, task: Task, needed: frozenset[str], state: State, segment: slice, progress: Progress
    ) -> tuple[Columns, State]:
        """The frames of a segment; the last one takes the steps beyond the last frame, too."""
        assert isinstance(members.ball, Ball)
        after = int(segment.start > 0)
        first = max(segment.start - 1, 0) * task.every
        last = task.steps if segment.stop == task.frames else (segment.stop - 1) * task.every
        gamma = np.full((len(members), segment.stop - segment.start, 3), np.nan)
        ends = {name: array.copy() for name, array in state.items()}
        going = np.flatnonzero(state["status"] == Status.TAKEN)
        if len(going):
            ball, height = members.of(going).ball, state["height"][going]
            assert isinstance(ball, Ball)
            run = trajectory_vertical(ball, height, state["gamma"][going], last - first, every=task.every)
            gamma[going], ends["gamma"][going] = run.gamma[:, after:], run.gamma[:, -1]
            ends["taken"][going], ends["status"][going] = first + run.taken, run.status
        progress(len(members) * (last - first))
        return self._columns(members, state, gamma, needed), ends

    @staticmethod
    def _columns(members: Members, state: State, gamma: np.ndarray, needed: frozenset[str]) -> Columns:
        found: Columns = {"gamma": gamma, "momentum": state["height"][:, np.newaxis, np.newaxis] * gamma}
        if "phase" in needed:
            found["phase"] = np.full(gamma.shape[:2], np.nan)
            for i in range(len(members)):
                there = np.isfinite(gamma[i, :, 0])
                found["phase"][i, there] = Curve.through(one_ball(members, i), members.gamma[i]).argument(
                    gamma[i, there]
                )
        if "rotation_number" in needed:
            found["rotation_number"] = state["rotation_number"]
        return {name: found[name] for name in found if name in needed}


def heights(members: Members) -> np.ndarray:
    """h = ⟨𝒦,γ⟩/⟨γ,γ⟩ in kg m², (n,): 𝒦 = hγ where 𝒦 is vertical."""
    return np.asarray((members.momentum * members.gamma).sum(axis=-1) / (members.gamma**2).sum(axis=-1))


def _turns(members: Members, i: int, height: float) -> float:
    """The rotation number, NaN for a ball whose orbit ends at a fold: it has none."""
    try:
        return rotation_number(one_ball(members, i), height, members.gamma[i])
    except StepNotTaken:
        return float("nan")
