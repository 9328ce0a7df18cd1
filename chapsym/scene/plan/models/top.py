"""Discrete tops: D = 0, or vertical momentum and two equal moments; every frame at once, by Jacobi's functions."""

import numpy as np

from chapsym.dynamics import BadInput, Ball, Status, StepNotTaken, TopMotion, is_top, top_frames
from chapsym.dynamics.closed import top
from chapsym.dynamics.closed.top import Precession

from ...members.members import Members, one_ball
from ...read.task import Columns, Task
from .model import Model, Progress, State, beyond_a_reduction

#: γ and the attitude lose up to 1/k' ulps: three digits at most.
NEAREST = 1e-3


class Top(Model):
    """`top_frames`: no step is taken."""

    name = "discrete top"
    title = "Moser-Veselov discrete Euler top"
    about = "𝒦 runs around its curve by the same phase each step: every frame by Jacobi's functions, no step between"
    columns = frozenset({"momentum", "gamma", "attitude", "phase", "rotation_number"})
    kernels = {"momentum": ("curve_increment",), "gamma": ("transport",), "attitude": ("compose",)}  # noqa: RUF012
    stepwise = False
    reduction = True

    def refuses(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Balls that are no such tops, and what `top_frames` does not have."""
        if (reason := beyond_a_reduction(members, task)) is not None:
            return reason
        assert isinstance(members.ball, Ball)
        tops = is_top(members.ball, members.momentum, members.gamma)
        if not tops.all():
            return f"D of {members.names[int(np.argmin(tops))]} is not 0, or its 𝒦 stays"
        return None

    def unfit(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Tops on the separatrix, or too near to it."""
        for i, name in enumerate(members.names):
            try:
                motion = motion_of(members, i)
                if _turned(members, needed):
                    if motion.curve.complement < NEAREST:
                        return f"{name} is near the separatrix, where an attitude at once loses digits"
                    Precession.of(motion)
            except BadInput as error:
                return f"{name}: {error}"
            except StepNotTaken:
                pass
        return None

    def price(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """The increment of each ball in hundreds of bits, and the frames; γ of D = 0 needs the precession."""
        free = not members.ball.D.any()
        fixed, frame = (2.7e6, 650.0) if _turned(members, needed) else (9e5, 110.0) if free else (1e6, 220.0)
        return len(members) * (fixed + task.frames * frame)

    def advance(
        self, members: Members, task: Task, needed: frozenset[str], state: State, segment: slice, progress: Progress
    ) -> tuple[Columns, State]:
        """The frames by their step numbers."""
        assert isinstance(members.ball, Ball)
        index = np.arange(segment.start, segment.stop) * task.every
        given = True if members.attitude is None else members.attitude
        found: Columns = {}
        status = np.zeros(len(members), dtype=np.int64)
        if needed & {"gamma", "attitude", "momentum"}:
            run = top_frames(
                members.ball, members.momentum, members.gamma, index, attitude=given if "attitude" in needed else False,
                time_step=task.time_step,
            )  # fmt: skip
            found = {name: getattr(run, name) for name in ("momentum", "gamma", "attitude") if name in needed}
            status = run.status
        if needed & {"phase", "rotation_number"}:
            found |= _phases(members, needed, index, status)
        last = task.steps if segment.stop == task.frames else int(index[-1])
        progress(len(members) * last)
        return found, {"taken": np.where(status == Status.TAKEN, last, 0), "status": status}


def _turned(members: Members, needed: frozenset[str]) -> bool:
    """Whether the precession is followed: of the attitude, and of γ for D = 0."""
    return "attitude" in needed or ("gamma" in needed and not members.ball.D.all())


def motion_of(members: Members, i: int) -> TopMotion:
    """`top.motion_of` of one ball."""
    return top.motion_of(one_ball(members, i), members.momentum[i], members.gamma[i])


def _phases(members: Members, needed: frozenset[str], index: np.ndarray, status: np.ndarray) -> Columns:
    """u of each frame and the turns a step; NaN, with `status` set, for a ball that cannot take a step."""
    phase, turns = np.full((len(members), len(index)), np.nan), np.full(len(members), np.nan)
    for i in range(len(members)):
        try:
            motion = motion_of(members, i)
        except StepNotTaken as stopped:
            status[i] = stopped.status
            continue
        phase[i], turns[i] = motion.phase(index), motion.rotation_number
    found = {"phase": phase, "rotation_number": turns}
    return {name: found[name] for name in found if name in needed}
