"""A plan for a reader: the model and why, what it keeps, what that costs, and what following everything would cost."""

from .cost import Cost, full, predicted
from .plan import Plan

_UNITS = ("B", "kB", "MB", "GB", "TB")


def explained(plan: Plan) -> list[tuple[str, str]]:
    """Rows of a key and a text; it takes short runs of both models, some hundredths of a second each."""
    of = "ball" if len(plan.members) == 1 else "balls"
    rows = [
        ("model", f"{plan.model.name}: {plan.model.about}"),
        *((f"not {name}", why) for name, why in plan.refused.items()),
        ("follows", ", ".join(sorted(plan.needed))),
        ("kernels", ", ".join(plan.kernels()) or "none"),
        ("keeps", f"{', '.join(plan.task.outputs)}: {plan.frames} frames of {len(plan.members)} {of}"),
    ]
    cost = predicted(plan)
    rows.append(("cost", _told(cost)))
    if plan.task.accuracy is None:
        everything = predicted(full(plan))
        less = (
            f"{_ratio(everything.seconds, cost.seconds)} the time, {_ratio(everything.bytes, cost.bytes)} the numbers"
        )
        rows.append(("everything", f"{_told(everything)}: {less}"))
    units = len(plan.chunks) * len(plan.segments)
    rows.append(
        ("work", f"{units} unit{'s' if units > 1 else ''}: {len(plan.chunks)} × {len(plan.segments)}, balls × frames")
    )
    return rows


def _told(cost: Cost) -> str:
    size, unit = float(cost.bytes), 0
    while size >= 1000 and unit < len(_UNITS) - 1:
        size, unit = size / 1000, unit + 1
    return f"about {seconds_told(cost.seconds)} of the processor, {size:.3g} {_UNITS[unit]}"


def seconds_told(seconds: float) -> str:
    """A time for a reader."""
    for unit, length in (("h", 3600.0), ("min", 60.0), ("s", 1.0), ("ms", 1e-3)):
        if seconds >= length:
            return f"{seconds / length:.2g} {unit}" if seconds < 100 * length else f"{seconds / length:.0f} {unit}"
    return f"{seconds * 1e6:.2g} µs"


def _ratio(more: float, less: float) -> str:
    return f"{more / less:.1f} times" if less > 0 else "many times"
