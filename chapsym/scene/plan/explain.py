"""A plan for a reader: the model and why, what it keeps, what that costs, and what following everything would cost."""

from dataclasses import replace

from chapsym.dynamics import Ball

from ..read.outputs import OUTPUTS, columns_for, timed
from .models import MODELS, General, Rolling
from .plan import Plan

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
    ]
    rows.append(("cost", _told(plan)))
    if plan.task.accuracy is None:
        rows.append(("full model", _beside(plan)))
    rows.append(("work", _work(len(plan.chunks), len(plan.segments))))
    return rows


def _work(balls: int, frames: int) -> str:
    """Into how many chunks the balls, and the frames of each, are divided."""
    chunks = f"{balls * frames} chunk{'s' if balls * frames > 1 else ''}"
    return chunks if frames == 1 else f"{chunks}: {balls} of balls × {frames} of frames"


def full(plan: Plan) -> Plan:
    """The plan of the same frames with the model that follows everything: every output that it can give."""
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
    """What the model that follows everything costs, where it follows what is asked for."""
    whole = full(plan)
    unknown = sorted(plan.needed - whole.model.columns)
    if unknown:
        return f"{_told(whole)}; it does not follow {' and '.join(unknown)}"
    ratios = _ratio(predicted(whole), predicted(plan)), _ratio(whole.bytes, plan.bytes)
    return f"{_told(whole)}: {ratios[0]} time, {ratios[1]} storage"


def _told(plan: Plan) -> str:
    size, unit = float(plan.bytes), 0
    while size >= 1000 and unit < len(_UNITS) - 1:
        size, unit = size / 1000, unit + 1
    return f"about {duration(predicted(plan))} of the processor, {size:.3g} {_UNITS[unit]}"


def duration(seconds: float) -> str:
    """A time for a reader."""
    units = (("h", 3600.0), ("min", 60.0), ("s", 1.0), ("ms", 1e-3), ("µs", 1e-6))
    unit, length = next(((unit, length) for unit, length in units if seconds >= length), units[-1])
    return f"{float(f'{seconds / length:.2g}'):g} {unit}"


def _ratio(more: float, less: float) -> str:
    return f"{more / less:.1f}×" if less > 0 else "many×"
