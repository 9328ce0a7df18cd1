"""A plan for a reader: the model and why, what it keeps, what that costs, and what following everything would cost."""

from .cost import Cost, full, predicted
from .models import MODELS
from .plan import Plan

_UNITS = ("B", "kB", "MB", "GB", "TB")


def explained(plan: Plan) -> list[tuple[str, str]]:
    """Rows of a key and a text; it takes short runs of both models, some hundredths of a second each."""
    of = "ball" if len(plan.members) == 1 else "balls"
    titles = {model.name: model.in_words() for model in MODELS}
    rows = [
        ("model", f"{plan.model.in_words()}: {plan.model.about}"),
        *((f"not {titles[name]}", why) for name, why in plan.refused.items() if plan.task.accuracy is None),
        ("follows", ", ".join(sorted(plan.needed))),
        ("kernels", ", ".join(plan.kernels()) or "none"),
        ("keeps", f"{', '.join(plan.task.outputs)}: {plan.frames} frames of {len(plan.members)} {of}"),
    ]
    cost = predicted(plan)
    rows.append(("cost", _told(cost)))
    if plan.task.accuracy is None:
        rows.append(("full model", _beside(plan, cost)))
    rows.append(("work", _work(len(plan.chunks), len(plan.segments))))
    return rows


def _work(balls: int, frames: int) -> str:
    """Into how many chunks the balls, and the frames of each, are divided."""
    chunks = f"{balls * frames} chunk{'s' if balls * frames > 1 else ''}"
    return chunks if frames == 1 else f"{chunks}: {balls} of balls × {frames} of frames"


def _beside(plan: Plan, cost: Cost) -> str:
    """What the model that follows everything costs, where it follows what is asked for."""
    whole = full(plan)
    unknown = sorted(plan.needed - whole.model.columns)
    everything = predicted(whole)
    if unknown:
        return f"{_told(everything)}; it does not follow {' and '.join(unknown)}"
    ratios = _ratio(everything.seconds, cost.seconds), _ratio(everything.bytes, cost.bytes)
    return f"{_told(everything)}: {ratios[0]} time, {ratios[1]} storage"


def _told(cost: Cost) -> str:
    size, unit = float(cost.bytes), 0
    while size >= 1000 and unit < len(_UNITS) - 1:
        size, unit = size / 1000, unit + 1
    return f"about {seconds_told(cost.seconds)} of the processor, {size:.3g} {_UNITS[unit]}"


def seconds_told(seconds: float) -> str:
    """A time for a reader."""
    units = (("h", 3600.0), ("min", 60.0), ("s", 1.0), ("ms", 1e-3), ("µs", 1e-6))
    unit, length = next(((unit, length) for unit, length in units if seconds >= length), units[-1])
    return f"{float(f'{seconds / length:.2g}'):g} {unit}"


def _ratio(more: float, less: float) -> str:
    return f"{more / less:.1f}×" if less > 0 else "many×"
