"""The cheapest model with the outputs of a scene, and the division of its run into units of work."""

from dataclasses import dataclass, replace

import numpy as np

from chapsym.dynamics import BadInput, Ball
from chapsym.dynamics.ball import Floats
from chapsym.dynamics.outputs import BOUND, LOW, OUTPUTS, K, columns_for, kernels_for, timed
from chapsym.dynamics.principal_axes import attitude_from_principal, from_principal
from chapsym.jobs import duration

from ..members.members import Members, expand
from ..read.scene import Scene, from_source
from ..read.task import Columns, Task
from .models import MODELS, Chosen, General, Model, Rolling

#: Balls of one unit of work: enough for the vector lanes and threads of a batch, little enough for its memory.
CHUNK = 4096
#: The largest number of values in one unit, 32 MB.
UNIT_NUMBERS = 2**22
#: Balls and values of a unit whose model, or proof, runs all frames at once: smaller ones lose less, but verify more.
WHOLE_BALLS, WHOLE_NUMBERS = 1024, 2**24


@dataclass(frozen=True, eq=False)
class Plan:
    """The plan of a run.

    model: the cheapest applicable one; needed: its columns.  refused: why each reduction does not apply.  chunks ×
    segments are the units of work: balls × frames.  They depend only on the scene, not on the machine, so that an
    interrupted run has the same bits as another.
    scene: its text, or JSON of a dict; title: its own; seed: of its random ranges.  They go with the result.
    """

    members: Members
    task: Task
    model: Model
    needed: frozenset[str]
    refused: dict[str, str]
    scene: str = ""
    title: str | None = None
    seed: int | None = None

    @property
    def frames(self) -> int:
        """The number of stored states of each ball."""
        return self.task.frames

    @property
    def numbers(self) -> int:
        """The number of stored values of one frame of one ball, including low halves and bounds."""
        outputs = [OUTPUTS[name] for name in self.task.outputs]
        widths = {one: one.width(self.members.dimension) for one in outputs if not one.per_ball}
        columns = {one: width for one, width in widths.items() if one.derive is None}
        return sum(widths.values()) + self.doubled * sum(columns.values()) + self.task.proved * len(columns)

    @property
    def doubled(self) -> bool:
        """Whether the columns have low halves, which are kept only in principal axes."""
        return self.task.doubled and self.members.axes is None

    @property
    def chunks(self) -> list[slice]:
        """The balls of each unit."""
        size = 1 if isinstance(self.model, Chosen) else CHUNK
        if (self.model.whole or self.task.proved) and size > 1:
            size = max(1, min(CHUNK, WHOLE_BALLS, WHOLE_NUMBERS // (self.frames * max(self.numbers, 1))))
        return [slice(i, min(i + size, len(self.members))) for i in range(0, len(self.members), size)]

    @property
    def segments(self) -> list[slice]:
        """The frames of each unit; the first has the start."""
        if self.model.whole or self.task.precision != "double" or self.task.proved:
            return [slice(0, self.frames)]
        balls = min(CHUNK, len(self.members))
        by_steps = self.model.unit_steps // (balls * self.task.every) if self.model.stepwise else self.frames
        size = max(1, min(by_steps, UNIT_NUMBERS // (balls * max(self.numbers, 1)), self.frames))
        return [slice(i, min(i + size, self.frames)) for i in range(0, self.frames, size)]

    @property
    def bytes(self) -> int:
        """The size of the outputs, uncompressed."""
        once = sum(OUTPUTS[name].per_ball for name in self.task.outputs)
        return 8 * len(self.members) * (self.frames * self.numbers + once)

    def kernels(self) -> list[str]:
        """The generated kernels that run."""
        of_model = {kernel for column in self.needed for kernel in self.model.kernels.get(column, ())}
        return sorted(of_model | {kernel for name in self.task.outputs for kernel in kernels_for(name)})

    def describe(self) -> dict[str, object]:
        """The plan as plain data."""
        return {
            "model": self.model.name,
            "about": self.model.about,
            "balls": len(self.members),
            "dimension": self.members.dimension,
            "frames": self.frames,
            "steps": self.task.steps,
            "outputs": list(self.task.outputs),
            "follows": sorted(self.needed),
            "kernels": self.kernels(),
            "bytes": self.bytes,
            "units": len(self.chunks) * len(self.segments),
            "refused": self.refused,
        }


def plan_of(scene: Scene) -> Plan:
    """The plan of a scene, with its text and title; raises BadInput if no model has its outputs."""
    plan = planned(expand(scene), scene.task())
    drawn = scene.sweep.samples is not None
    return replace(plan, scene=scene.source, title=scene.title, seed=scene.sweep.seed if drawn else None)


def plan_from(text: str) -> Plan:
    """The plan of a scene from its text, `Plan.scene`, TOML or JSON of a dict, as sent to a worker of a cluster."""
    return replace(plan_of(from_source(text)), scene=text)


def planned(members: Members, task: Task) -> Plan:
    """The plan with the cheapest model; raises BadInput, with the reasons, if no model has the outputs."""
    top = isinstance(members.ball, Ball) and not members.ball.D.any()
    _check_outputs(members, task)
    needed = columns_for(task.outputs, top)
    refused: dict[str, str] = {}
    prices: dict[str, float] = {}
    for model in MODELS:
        if (reason := model.refuses(members, task, needed)) is None:
            prices[model.name] = model.price(members, task, needed)
        else:
            refused[model.name] = reason
    for chosen in sorted((model for model in MODELS if model.name in prices), key=lambda model: prices[model.name]):
        if (reason := chosen.unfit(members, task, needed)) is None:
            break
        refused[chosen.name] = reason
        del prices[chosen.name]
    else:
        able = [model.name for model in MODELS if needed <= model.columns] or list(refused)
        clause = "; ".join(f"{name}: {refused[name]}" for name in able)
        raise BadInput(f"no model yields {', '.join(task.outputs)} for these balls: {clause}")
    least = prices.pop(chosen.name)
    dearer = {name: f"it would cost {price / least:.1f} times as much" for name, price in prices.items()}
    lesser = {model.name: (refused | dearer).get(model.name) for model in MODELS if model.reduction}
    return Plan(members, task, chosen, needed, {name: why for name, why in lesser.items() if why is not None})


def _check_outputs(members: Members, task: Task) -> None:
    """Raises BadInput for outputs that these balls cannot have."""
    if unknown := [name for name in task.outputs if name not in OUTPUTS]:
        raise BadInput(f"{unknown[0]!r} is no output; choose of {', '.join(OUTPUTS)}")
    of = (task.of,) if task.of in OUTPUTS else ()
    on_plane = [OUTPUTS[name].long_name for name in (*task.outputs, *of) if OUTPUTS[name].radius]
    if members.ball.radius is None and on_plane:
        raise BadInput(f"the {on_plane[0]} needs the radius: give the ball its mass and radius")
    untimed = [] if task.timed else sorted(name for name in task.outputs if timed(name))
    if untimed:
        raise BadInput(f"{untimed[0]} needs run.time_step, in seconds: 𝒦 = εK alone does not tell it")
    if task.proved and all(OUTPUTS[name].derive is not None for name in task.outputs):
        raise BadInput("run.proved bounds momentum, gamma, attitude and contact: ask for one in run.outputs")
    if members.axes is not None and task.precision == "double-double":
        clause = "give the principal moments, and the start in their axes"
        raise BadInput(f"31 digits are kept in principal axes only: {clause}")
    unknown = sorted(name for name in task.outputs if OUTPUTS[name].dims_n is None)
    if members.dimension > 3 and unknown:
        raise BadInput(f"{unknown[0]} is known in three dimensions only")


# From the columns of a model to the requested outputs: derived outputs, in the axes of the user.


@np.errstate(all="ignore")  # what is beyond float64 is refused in a sentence
def asked_for(members: Members, task: Task, columns: Columns) -> Columns:
    """The requested outputs of a task, from the columns of a model in principal axes."""
    found: Columns = {}
    for name in task.outputs:
        found[name] = columns[name] if OUTPUTS[name].derive is None else _derived(name, members, task, columns)
        found |= {whole: columns[whole] for end in (LOW, BOUND) if (whole := f"{name}{end}") in columns}
    return in_given_axes(members, found)


def _derived(name: str, members: Members, task: Task, columns: Columns) -> np.ndarray:
    """A derived output; frames that a ball did not reach are NaN, and not given to a kernel."""
    columns = {key: columns[key] for key in columns_for((name,), top=False) if key in columns}
    some = next(iter(columns.values()))
    missing = np.isnan(some).reshape(*some.shape[:2], -1).any(axis=-1)
    if missing.any():
        for key, values in columns.items():
            where = missing.reshape(*missing.shape, *[1] * (values.ndim - 2))
            columns[key] = np.where(where, _vertical(members) if key == "gamma" else 0.0, values)
    values = np.array(_value(name, members, task, columns), dtype=np.float64)
    if not np.isfinite(values[~missing]).all():
        raise BadInput(f"{name} is beyond the range of float64; take other units")
    values[missing] = np.nan
    return values


def _value(name: str, members: Members, task: Task, columns: Columns) -> Floats:
    """A column, K, or an output derived from these; one that enters only with D may be missing, then arbitrary."""
    if name == K:
        return columns["momentum"] / (task.scale if task.accuracy is None else 1.0)  # for the motion, K itself is kept
    one = OUTPUTS[name]
    if one.derive is None:
        return columns[name]
    given = {
        part: np.broadcast_to(_vertical(members), (*columns["momentum"].shape[:2], members.dimension))
        if part in one.with_D and part not in columns
        else _value(part, members, task, columns)
        for part in one.needs
    }
    return one.derive(members.ball.mass_tensor[:, np.newaxis], members.ball.D[:, np.newaxis], given)


def _vertical(members: Members) -> Floats:
    return np.eye(members.dimension)[-1]


def in_given_axes(members: Members, columns: Columns) -> Columns:
    """Vectors and attitudes, converted from principal axes to the axes of the user."""
    if members.axes is None:
        return columns
    axes = members.axes[:, np.newaxis]
    back = {("axis",): from_principal, ("quaternion",): attitude_from_principal}
    return {
        name: back[dims](axes, values) if (dims := OUTPUTS[name].dims) in back else values
        for name, values in columns.items()
    }


# A plan for a reader: the model and its reason, the outputs, their cost, and the cost of the full model.

_UNITS = ("B", "kB", "MB", "GB", "TB")


def explained(plan: Plan) -> list[tuple[str, str]]:
    """Rows of a key and a text."""
    of = "ball" if len(plan.members) == 1 else "balls"
    titles = {model.name: model.in_words() for model in MODELS}
    rows = [
        ("model", f"{plan.model.in_words()}: {plan.model.about}"),
        *((f"not {titles[name]}", why) for name, why in plan.refused.items() if plan.task.accuracy is None),
        ("follows", ", ".join(sorted(plan.needed))),
        ("kernels", ", ".join(plan.kernels()) or "none"),
        ("keeps", f"{', '.join(plan.task.outputs)}: {plan.frames} frames of {len(plan.members)} {of}"),
        ("cost", _cost(plan)),
    ]
    if plan.task.accuracy is None:
        rows.append(("full model", _beside(plan)))
    balls, frames = len(plan.chunks), len(plan.segments)
    work = f"{balls * frames} chunk{'s' if balls * frames > 1 else ''}"
    return [*rows, ("work", work if frames == 1 else f"{work}: {balls} of balls × {frames} of frames")]


def full(plan: Plan) -> Plan:
    """The plan of the same frames with the full model and all its outputs."""
    model = Rolling() if isinstance(plan.members.ball, Ball) else General()
    n, radius = plan.members.dimension, plan.members.ball.radius
    outputs = tuple(
        name
        for name, one in OUTPUTS.items()
        if columns_for((name,), False) <= model.columns
        and (n == 3 or one.dims_n is not None)
        and (radius is not None or not one.radius)
        and (plan.task.timed or not timed(name))
    )
    return replace(plan, model=model, task=replace(plan.task, outputs=outputs), needed=columns_for(outputs, False))


def predicted(plan: Plan) -> float:
    """Seconds of the processor, all cores together, without the disk: nominal, by the prices of the models."""
    known = plan.model.seconds(plan.members, plan.task, plan.needed)
    return 1e-9 * plan.model.price(plan.members, plan.task, plan.needed) if known is None else known


def _beside(plan: Plan) -> str:
    """The cost of the full model, if it has the requested outputs."""
    whole = full(plan)
    if unknown := sorted(plan.needed - whole.model.columns):
        return f"{_cost(whole)}; it does not follow {' and '.join(unknown)}"
    ratios = _ratio(predicted(whole), predicted(plan)), _ratio(whole.bytes, plan.bytes)
    return f"{_cost(whole)}: {ratios[0]} time, {ratios[1]} storage"


def _cost(plan: Plan) -> str:
    size, unit = float(plan.bytes), 0
    while size >= 1000 and unit < len(_UNITS) - 1:
        size, unit = size / 1000, unit + 1
    return f"about {duration(predicted(plan))} of the processor, {size:.3g} {_UNITS[unit]}"


def _ratio(more: float, less: float) -> str:
    return f"{more / less:.1f}×" if less > 0 else "many×"
