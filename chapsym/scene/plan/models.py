"""The models of a scene: methods to compute its balls, and their applicability; `MODELS` has all of them."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from typing import Any, ClassVar

import numpy as np

from chapsym import dynamics
from chapsym.accuracy import Accurate, Request, foreseen
from chapsym.accuracy.answer import answered, exact_values
from chapsym.accuracy.motion import FINEST, PARTS, Problem, moved, nominal
from chapsym.dynamics import BadInput, Ball, BallN, Curve, Status, StepNotTaken, TopMotion
from chapsym.dynamics.attitudes import attitude_with
from chapsym.dynamics.closed import top
from chapsym.dynamics.closed.elliptic import NEAREST
from chapsym.dynamics.closed.vertical import VerticalTrajectory
from chapsym.dynamics.outputs import BOUND, LOW, whose
from chapsym.dynamics.results import put_at

from ..members.members import Members, one_ball
from ..read.task import Columns, Task

#: The state for the next segment: arrays by name, each (balls, ...), always with `taken` and `status`.
State = dict[str, np.ndarray]
#: The columns of frames, and the status of each ball.
Found = tuple[Columns, np.ndarray]
Progress = Callable[[int], None]

FOLLOWED = ("momentum", "gamma", "attitude", "contact")
#: The number of balls from which on a batch runs in vector lanes.
BATCH = 16
#: The largest relative |𝒦 - hγ|: 𝒦 was rounded, and its motion stays this near to that with 𝒦 = hγ.
VERTICAL = 4 * np.finfo(np.float64).eps
#: The least k' of a top: γ and the attitude lose up to 1/k' ulps, at most three digits.
NEAREST_TOP = 1e-3

STEP = ("gibbs_newton", "gibbs_second", "turn")
ROLLING = {"momentum": STEP, "attitude": ("compose",), "contact": ("compose", "centre_step", "rotate")}


class Model(ABC):
    """A method to compute balls; its name determines the values.

    name: as in the plan; title: for readers.  about: one clause on its simplifications.
    columns: that it can compute.
    kernels: the generated kernels in its loops, for each computed column.
    motion: whether it computes the motion of the ball to an accuracy, or else the map; high: whether for balls in more
    than three dimensions.  reduction: whether it is simpler than the general model, only of order 2 and in float64, so
    that a plan gives the reason why it is not used.
    stepwise: whether its cost grows with the steps (else with the frames).
    whole: whether it must run in one segment, since its state has more than float64 arrays.
    proves: whether it can bound the error of each frame.
    unit_steps: steps of all balls in one unit of work: a second or two, the largest loss of a killed run.
    """

    name: ClassVar[str]
    title: ClassVar[str] = ""
    about: ClassVar[str]
    columns: ClassVar[frozenset[str]] = frozenset(FOLLOWED)
    kernels: ClassVar[Mapping[str, tuple[str, ...]]] = {}
    motion: ClassVar[bool] = False
    high: ClassVar[bool] = False
    reduction: ClassVar[bool] = False
    stepwise: ClassVar[bool] = True
    whole: ClassVar[bool] = False
    proves: ClassVar[bool] = False
    unit_steps: ClassVar[int] = 2**27

    @classmethod
    def in_words(cls) -> str:
        """The title for readers; `name` is in results and JSON."""
        return cls.title or cls.name

    def refuses(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Why this model does not apply to these balls and columns, in a clause; None if it does."""
        if isinstance(members.ball, BallN) != self.high:
            return f"it is for balls in {'more than ' if self.high else ''}three dimensions"
        if self.motion != (task.accuracy is not None):
            own, other = ("motion of the ball", "map") if self.motion else ("map", "motion of the ball")
            return f"it is of the {own}, and the {other} is asked for"
        if task.proved and not self.proves:
            return "it proves no bounds of its error"
        if self.reduction and (task.order != 2 or task.precision != "double"):
            return "it has order 2 and float64 only"
        missing = sorted(needed - self.columns)
        return self.unable(members, task, needed) or (f"it does not follow {', '.join(missing)}" if missing else None)

    def unable(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """The same, for the specific conditions of this model."""
        return None

    def unfit(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """The same, by a test of each ball that may take as long as its run, only for the cheapest models."""
        return None

    def begin(self, members: Members, task: Task, needed: frozenset[str]) -> State:
        """The state at the start."""
        n = len(members)
        return {"taken": np.zeros(n, dtype=np.int64), "status": np.zeros(n, dtype=np.int64)}

    def price(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """The cost in nanoseconds of one core: nominal, so that a plan does not depend on the machine.

        The prices are those of `chapsym bench plans`; the default is for models with `seconds`.
        """
        return 1.0

    def seconds(self, members: Members, task: Task, needed: frozenset[str]) -> float | None:
        """The expected duration of a run, if that is more than its price."""
        return None

    @abstractmethod
    def advance(
        self, members: Members, task: Task, needed: frozenset[str], state: State, segment: slice, progress: Progress
    ) -> tuple[Columns, State]:
        """The frames of a segment, (balls, frames, ...) of each column, in principal axes, and the state after it.

        Frames of a ball after its `taken` are NaN.  The given state is not changed.
        """


def _ball(members: Members) -> Ball:
    """The balls of a model in three dimensions."""
    assert isinstance(members.ball, Ball)
    return members.ball


# Models that take every step: a segment continues from the last frame of the one before.


class Stepwise(Model):
    """A model whose state is the last frame."""

    @abstractmethod
    def run(self, members: Members, task: Task, state: State, steps: int, progress: Progress) -> Any:
        """A trajectory of `steps` steps from a state, of all the balls; its contact point starts at the origin."""

    def attitude(self, members: Members) -> np.ndarray:
        """The default attitude at the start: the least rotation with R γ = e₃."""
        return attitude_with(members.gamma)

    def begin(self, members: Members, task: Task, needed: frozenset[str]) -> State:
        """𝒦, γ, and the attitude and the contact point if they are needed."""
        state = super().begin(members, task, needed) | {"momentum": members.momentum, "gamma": members.gamma}
        if needed & {"attitude", "contact"}:
            state["attitude"] = self.attitude(members) if members.attitude is None else members.attitude
        if "contact" in needed:
            origin = np.zeros((len(members), members.dimension - 1))
            state["contact"] = origin if members.place is None else members.place
        return state

    def advance(
        self, members: Members, task: Task, needed: frozenset[str], state: State, segment: slice, progress: Progress
    ) -> tuple[Columns, State]:
        """The frames of a segment; the last one takes the steps beyond the last frame, too."""
        n, frames, after = len(members), segment.stop - segment.start, int(segment.start > 0)
        first = max(segment.start - 1, 0) * task.every
        last = task.steps if segment.stop == task.frames else (segment.stop - 1) * task.every
        followed = [name for name in FOLLOWED if name in state]
        columns = {name: np.full((n, frames, *state[name].shape[1:]), np.nan) for name in followed}
        ends = {name: array.copy() for name, array in state.items()}
        going = np.flatnonzero(state["status"] == Status.TAKEN)
        if len(going):
            here = {name: array[going] for name, array in state.items()}
            run = self.run(members.of(going) if len(going) < n else members, task, here, last - first, progress)
            if "contact" in here:
                run = put_at(replace(run, contact=np.asarray(run.contact, dtype=np.float64)), here["contact"])
            for name in followed:
                values = np.asarray(getattr(run, name), dtype=np.float64)
                low = None if getattr(run, "low", None) is None else getattr(run.low, name)
                columns[name][going], ends[name][going] = values[:, after:], values[:, -1]
                if low is not None:
                    columns.setdefault(f"{name}{LOW}", np.full_like(columns[name], np.nan))
                    columns[f"{name}{LOW}"][going] = low[:, after:]
                if task.proved:
                    columns.setdefault(f"{name}{BOUND}", np.full((n, frames), np.nan))
                    columns[f"{name}{BOUND}"][going] = getattr(run.proved, name)[:, after:]
            ends["taken"][going], ends["status"][going] = first + run.taken, run.status
        return {name: array for name, array in columns.items() if whose(name) in needed}, ends


class Rolling(Stepwise):
    """The map (4.12), (4.13) itself, for every ball in three dimensions."""

    name = "reduced map"
    about = "𝒦 and γ step by step; attitude and contact point only if asked for"
    kernels = ROLLING
    proves = True

    def unable(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Bounds in other axes or of fewer digits."""
        if task.proved and members.axes is not None:
            return "bounds are proved in principal axes: give the principal moments"
        if task.proved and task.precision == "single":
            return "bounds are proved in double and double-double precision, not in single"
        return None

    def price(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """Vector lanes for batches; a proof needs a second run, in double-double."""
        alone, in_lanes = (40.0, 14.0) if needed & {"attitude", "contact"} else (27.0, 8.0)
        step = in_lanes if len(members) >= BATCH and task.order == 2 else alone
        step = 1000.0 if task.proved else step * (4 if task.precision == "double-double" else 1)
        return 3e4 + len(members) * (task.steps * len(dynamics.substeps(task.order)) * step + task.frames * 10.0)

    def run(self, members: Members, task: Task, state: State, steps: int, progress: Progress) -> dynamics.Trajectory:
        """`chapsym.trajectory` of the batch."""
        attitude = state.get("attitude", False)
        if "attitude" in state and members.attitude is None and task.precision == "double-double":
            attitude = True  # with 31 digits, like γ; such a run has one segment
        return dynamics.trajectory(
            _ball(members), state["momentum"], state["gamma"], steps, every=task.every, order=task.order,
            attitude=attitude, contact="contact" in state,
            precision=task.precision, time_step=task.time_step, proved=task.proved, progress=progress,
        )  # fmt: skip


class General(Stepwise):
    """The map on SO(n) × Sⁿ⁻¹, for balls in more than three dimensions: skew matrices, for every n."""

    name = "map in n dimensions"
    about = "skew matrices 𝒦, and γ, step by step"
    high = True
    unit_steps = 2**14

    def unable(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """The outputs that `trajectory_n` does not have."""
        return None if task.precision == "double" else "more than three dimensions have float64 only"

    def price(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """Skew matrices of n(n-1)/2 components, in systems of that many equations."""
        step = 2e3 + 2.0 * members.dimension**4
        return len(members) * task.steps * len(dynamics.substeps(task.order)) * step

    def attitude(self, members: Members) -> np.ndarray:
        """The least rotation with R γ = eₙ."""
        assert isinstance(members.ball, BallN)
        start = dynamics.trajectory_n(members.ball, members.momentum, members.gamma, 0, attitude=True).attitude
        assert start is not None
        return start[:, 0]

    def run(self, members: Members, task: Task, state: State, steps: int, progress: Progress) -> dynamics.Trajectory:
        """`chapsym.trajectory_n` of the batch."""
        assert isinstance(members.ball, BallN)
        found = dynamics.trajectory_n(
            members.ball, state["momentum"], state["gamma"], steps, order=task.order, every=task.every,
            attitude=state.get("attitude", False), contact="contact" in state,
        )  # fmt: skip
        progress(len(members) * steps)
        return found


class Vertical(Stepwise):
    """Vertical momentum: the map G_h on the sphere, with γ as the whole state, and the phase u on its curve."""

    name = "vertical momentum"
    about = "γ alone, on the sphere: 𝒦 = hγ; its phase on the curve ⟨γ,Λ⁻¹γ⟩ = l"
    columns = frozenset({"momentum", "gamma", "phase", "rotation_number"})
    kernels = dict.fromkeys(("gamma", "momentum", "phase", "rotation_number"), STEP)
    reduction = True
    unit_steps = 2**25

    def unable(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Momenta that are not vertical."""
        K, height = members.momentum, _heights(members)
        apart = np.abs(K - height[:, np.newaxis] * members.gamma).max(axis=-1) > VERTICAL * np.abs(height)
        if apart.any() or (height == 0).any():
            return f"the momentum of {members.names[int(np.argmax(apart | (height == 0)))]} is not along γ"
        return None

    def unfit(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Fixed points and the separatrix, if a phase is requested."""
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
        turns = 4e6 if "rotation_number" in needed else 0.0
        return len(members) * (task.steps * 25.0 + task.frames * frame + turns)

    def begin(self, members: Members, task: Task, needed: frozenset[str]) -> State:
        """γ and h; and the rotation number, which is computed once and passed to every segment."""
        height = _heights(members)
        state = Model.begin(self, members, task, needed) | {"gamma": members.gamma, "height": height}
        if "rotation_number" in needed:
            state["rotation_number"] = np.array([_turns(members, i, height[i]) for i in range(len(members))])
        return state

    def run(self, members: Members, task: Task, state: State, steps: int, progress: Progress) -> VerticalTrajectory:
        """`chapsym.trajectory_vertical` of the batch."""
        found = dynamics.trajectory_vertical(_ball(members), state["height"], state["gamma"], steps, every=task.every)
        progress(len(members) * steps)
        return found

    def advance(
        self, members: Members, task: Task, needed: frozenset[str], state: State, segment: slice, progress: Progress
    ) -> tuple[Columns, State]:
        """γ of a segment, and the quantities derived from it."""
        found, ends = super().advance(members, task, needed | {"gamma"}, state, segment, progress)
        gamma = found["gamma"]
        found["momentum"] = state["height"][:, np.newaxis, np.newaxis] * gamma
        if "phase" in needed:
            found["phase"] = np.full(gamma.shape[:2], np.nan)
            for i in range(len(members)):
                there = np.isfinite(gamma[i, :, 0])
                curve = Curve.through(one_ball(members, i), members.gamma[i])
                found["phase"][i, there] = curve.argument(gamma[i, there])
        if "rotation_number" in needed:
            found["rotation_number"] = state["rotation_number"]
        return {name: found[name] for name in found if name in needed}, ends


def _heights(members: Members) -> np.ndarray:
    """h = ⟨𝒦,γ⟩/⟨γ,γ⟩ in kg m², (n,): 𝒦 = hγ if 𝒦 is vertical."""
    return np.asarray((members.momentum * members.gamma).sum(axis=-1) / (members.gamma**2).sum(axis=-1))


def _turns(members: Members, i: int, height: float) -> float:
    """The rotation number, NaN for a ball whose orbit ends at a fold."""
    try:
        return dynamics.rotation_number(one_ball(members, i), height, members.gamma[i])
    except StepNotTaken:
        return float("nan")


# Models in closed form: each frame follows from its step number, and no step is taken.


class Direct(Model):
    """A model in closed form."""

    stepwise = False
    reduction = True

    @abstractmethod
    def frames(self, members: Members, task: Task, needed: frozenset[str], index: np.ndarray) -> Found:
        """The columns after these numbers of steps."""

    def advance(
        self, members: Members, task: Task, needed: frozenset[str], state: State, segment: slice, progress: Progress
    ) -> tuple[Columns, State]:
        """The frames by their step numbers."""
        index = np.arange(segment.start, segment.stop) * task.every
        columns, status = self.frames(members, task, needed, index)
        last = task.steps if segment.stop == task.frames else int(index[-1])
        progress(len(members) * last)
        return columns, {"taken": np.where(status == Status.TAKEN, last, 0), "status": status}


class Steady(Direct):
    """Steady rotation, `steady_frames`: homogeneous balls, rotations about principal axes, rest."""

    name = "steady rotation"
    about = "each step is the same rotation about a fixed axis: every frame in closed form, no step between"
    kernels = ROLLING | {"momentum": ("turn",), "gamma": ("turn",), "contact": ("centre_step", "rotate")}

    def unable(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Balls that do not rotate steadily."""
        steady = dynamics.is_steady(_ball(members), members.momentum, members.gamma)
        if not steady.all():
            return f"{members.names[int(np.argmin(steady))]} has unequal moments and is in no steady rotation"
        return None

    def price(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """The frames alone."""
        frame = 75.0 if needed & {"attitude", "contact"} else 40.0
        return 4.5e5 + len(members) * task.frames * frame

    def frames(self, members: Members, task: Task, needed: frozenset[str], index: np.ndarray) -> Found:
        """`chapsym.steady_frames` of the batch."""
        given = True if members.attitude is None else members.attitude
        run = dynamics.steady_frames(
            _ball(members), members.momentum, members.gamma, index, contact="contact" in needed,
            attitude=given if needed & {"attitude", "contact"} else False, time_step=task.time_step,
        )  # fmt: skip
        columns = {name: getattr(run, name) for name in FOLLOWED if name in needed}
        if "contact" in needed and members.place is not None:
            columns["contact"] = columns["contact"] + members.place[:, np.newaxis]
        return columns, run.status


class Top(Direct):
    """Discrete tops, `top_frames`: D = 0, or vertical momentum and two equal moments; by Jacobi's functions."""

    name = "discrete top"
    title = "Moser-Veselov discrete Euler top"
    about = "𝒦 runs around its curve by the same phase each step: every frame by Jacobi's functions, no step between"
    columns = frozenset({"momentum", "gamma", "attitude", "phase", "rotation_number"})
    kernels = {"momentum": ("curve_increment",), "gamma": ("transport",), "attitude": ("compose",)}  # noqa: RUF012

    def unable(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Balls that are no such tops."""
        tops = dynamics.is_top(_ball(members), members.momentum, members.gamma)
        if not tops.all():
            return f"D of {members.names[int(np.argmin(tops))]} is not 0, or its 𝒦 stays"
        return None

    def unfit(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Tops on the separatrix, or too near to it."""
        for i, name in enumerate(members.names):
            try:
                motion = motion_of(members, i)
                if _turned(members, needed):
                    if motion.curve.complement < NEAREST_TOP:
                        return f"{name} is near the separatrix, where an attitude at once loses digits"
                    motion.rotations(np.zeros(1, dtype=np.int64))
            except BadInput as error:
                return f"{name}: {error}"
            except StepNotTaken:
                pass
        return None

    def price(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """The increment of each ball in hundreds of bits, and the frames; γ for D = 0 needs the precession."""
        free = not _ball(members).D.any()
        fixed, frame = (2.7e6, 650.0) if _turned(members, needed) else (9e5, 110.0) if free else (1e6, 220.0)
        return len(members) * (fixed + task.frames * frame)

    def frames(self, members: Members, task: Task, needed: frozenset[str], index: np.ndarray) -> Found:
        """`chapsym.top_frames` of the batch; u of each frame and the turns per step, NaN if no step can be taken."""
        found: Columns = {}
        n = len(members)
        status = np.zeros(n, dtype=np.int64)
        if needed & {"gamma", "attitude", "momentum"}:
            given = True if members.attitude is None else members.attitude
            run = dynamics.top_frames(
                _ball(members), members.momentum, members.gamma, index,
                attitude=given if "attitude" in needed else False, time_step=task.time_step,
            )  # fmt: skip
            found = {name: getattr(run, name) for name in ("momentum", "gamma", "attitude")}
            status = run.status
        if needed & {"phase", "rotation_number"}:
            found["phase"], found["rotation_number"] = np.full((n, len(index)), np.nan), np.full(n, np.nan)
            for i in range(n):
                try:
                    motion = motion_of(members, i)
                except StepNotTaken as stopped:
                    status[i] = stopped.status
                    continue
                found["phase"][i], found["rotation_number"][i] = motion.phase(index), motion.rotation_number
        return {name: found[name] for name in found if name in needed}, status


def _turned(members: Members, needed: frozenset[str]) -> bool:
    """Whether the precession is computed: for the attitude, and for γ if D = 0."""
    return "attitude" in needed or ("gamma" in needed and not members.ball.D.all())


def motion_of(members: Members, i: int) -> TopMotion:
    """`top.motion_of` of one ball."""
    return top.motion_of(one_ball(members, i), members.momentum[i], members.gamma[i])


# Models of the continuous motion, to an accuracy that is verified during the run.


class Moving(Model):
    """`chapsym.accuracy.motion.moved`: in double precision, all balls of a unit together."""

    name = "motion of the ball"
    about = "long steps that meet the accuracy, chosen for each ball, with an estimate of the error"
    kernels = ROLLING
    motion = True
    whole = True

    def unable(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """More digits than float64 has."""
        if task.accuracy is not None and task.accuracy < FINEST:
            return f"double precision has no accuracy below {FINEST:g}: ask for one ball by time, without time_step"
        return None

    def price(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """Higher than that of a search for one ball, which also has higher precisions."""
        return 2.0

    def seconds(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """Nominal, by the number of steps of the law."""
        return nominal(self._problem(members, task, needed))

    def advance(
        self, members: Members, task: Task, needed: frozenset[str], state: State, segment: slice, progress: Progress
    ) -> tuple[Columns, State]:
        """All frames; the momentum is K."""
        problem = self._problem(members, task, needed)
        try:
            found = moved(problem, lambda balls: progress(int(balls * task.steps)))
        except BadInput as error:
            if len(members) == 1 and task.chosen and "contact" in needed and task.of == "state":
                raise BadInput(f'{error}; or have more digits by of = "contact"') from None
            raise
        columns = {
            "momentum": found.angular_momentum, "gamma": found.gamma, "attitude": found.attitude,
            "contact": found.contact,
        }  # fmt: skip
        if found.contact is not None and members.place is not None:
            columns["contact"] = found.contact + members.place[:, np.newaxis]
        at_end = found.reached == problem.frames
        return {name: columns[name] for name in needed}, state | {
            "taken": np.where(at_end, task.steps, found.reached * task.every), "status": found.status,
            "error": found.error, "order": found.order, "substeps": found.steps,
        }  # fmt: skip

    @staticmethod
    def _problem(members: Members, task: Task, needed: frozenset[str]) -> Problem:
        assert task.accuracy is not None
        attitude, metres = None, task.of == "contact"
        if metres or needed & {"attitude", "contact"}:
            attitude = attitude_with(members.gamma) if members.attitude is None else members.attitude
        parts = accurate_parts(task.outputs) | ({"contact"} if metres else frozenset())
        return Problem(
            _ball(members), members.momentum / task.scale, members.gamma, task.interval, task.frames - 1,
            task.accuracy, attitude, metres or "contact" in needed, metres, parts,
        )  # fmt: skip


def accurate_parts(outputs: tuple[str, ...]) -> frozenset[str]:
    """The kept parts of the motion, to which the accuracy applies."""
    made = {"momentum", "gamma"} if any(name not in PARTS for name in outputs) else set()
    return PARTS & (made | set(outputs))


class Chosen(Model):
    """`chapsym.accuracy.accurate`: precision and steps chosen for each ball.

    tell: called with each answer.  progress: called before each attempt.
    """

    name = "chosen for the accuracy"
    title = "automatic, accuracy-driven"
    about = "long steps that meet the accuracy, in double precision or double-double, with an estimate of the error"
    kernels = ROLLING
    motion = True
    whole = True

    def __init__(
        self, tell: Callable[[Accurate], object] = lambda _: None, progress: Callable[[str], None] = lambda _: None
    ) -> None:
        self.tell, self.progress = tell, progress

    def unable(self, members: Members, task: Task, needed: frozenset[str]) -> str | None:
        """Runs with given steps, and batches that are computed together."""
        if not task.searched:
            return "no accuracy is asked for"
        if not task.chosen:
            return "it takes a time and frames, without time_step"
        if len(members) > 1 and task.accuracy is not None and task.accuracy >= FINEST:
            return "it follows each ball for itself"
        if "contact" in needed and task.of != "contact":
            return 'the contact point is followed to an accuracy of the contact point: of = "contact"'
        return None

    def advance(
        self, members: Members, task: Task, needed: frozenset[str], state: State, segment: slice, progress: Progress
    ) -> tuple[Columns, State]:
        """Each ball separately; the momentum is K = 𝒦/ε."""
        runs = [self._one(members, i, task, needed) for i in range(len(members))]
        columns = {name: np.stack([run[name] for run, _ in runs]) for name in sorted(runs[0][0])}
        progress(task.steps * len(members))
        return columns, state | {"taken": state["taken"] + task.steps, "error": np.array([error for _, error in runs])}

    def seconds(self, members: Members, task: Task, needed: frozenset[str]) -> float:
        """The expected duration of the choice for the first ball, for all."""
        return foreseen(self._request(members, 0, task, needed), task.limit).seconds * len(members)

    @staticmethod
    def _request(members: Members, i: int, task: Task, needed: frozenset[str]) -> Request:
        """The request for one ball."""
        given = None if members.attitude is None else members.attitude[i]
        with_body = "attitude" in needed or (given is not None and "contact" in needed)
        body = (True if given is None else given) if with_body else False
        start = one_ball(members, i), members.momentum[i], members.gamma[i]
        return Request(*start, task.time, task.accuracy, task.of, task.frames - 1, body)  # type: ignore[arg-type]

    def _one(self, members: Members, i: int, task: Task, needed: frozenset[str]) -> tuple[Columns, float]:
        """The columns of one ball, and the bound of its error by comparison."""
        answer = answered(self._request(members, i, task, needed), task.limit, self.progress)
        self.tell(answer)
        run = answer.trajectory
        columns = {name: np.asarray(getattr(run, name), dtype=np.float64) for name in needed if name != "momentum"}
        if "momentum" in needed:
            columns["momentum"] = np.asarray(run.angular_momentum(), dtype=np.float64)
        if task.doubled and members.axes is None:
            for name in sorted(needed):
                columns |= _halves(name, exact_values(answer.request, run, name), members.place, i)
        elif "contact" in needed and members.place is not None:
            columns["contact"] = columns["contact"] + members.place[i]
        return columns, answer.estimate


def _halves(name: str, exact: np.ndarray, place: np.ndarray | None, i: int) -> Columns:
    """Numbers beyond float64 as their nearest floats and the rests."""
    exact = np.vectorize(Fraction, otypes=[object])(exact)
    if name == "contact" and place is not None:
        exact = exact + np.vectorize(Fraction, otypes=[object])(place[i])
    high = exact.astype(np.float64)
    rest = exact - np.vectorize(Fraction, otypes=[object])(high)
    return {name: high, f"{name}{LOW}": rest.astype(np.float64)}


#: The cheapest model that does not refuse is taken; for equal prices the first.
MODELS: tuple[Model, ...] = (Chosen(), Moving(), General(), Steady(), Top(), Vertical(), Rolling())
