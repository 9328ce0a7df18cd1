"""How far a result is from the motion of the ball: by its error, where that was verified, or as a map of its steps."""

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from chapsym.accuracy.discretisation import Discretisation, discretisation, read
from chapsym.dynamics import Ball

from ..plan.plan import Plan

if TYPE_CHECKING:
    from xarray import Dataset


def attributes(plan: Plan) -> dict[str, Any]:
    """What a result is told of it: the accuracy that was asked for, or the estimate of a pilot."""
    members, task = plan.members, plan.task
    if task.accuracy is not None:
        return {"accuracy": task.accuracy, "accuracy_of": task.of}
    if task.time_step is None or not isinstance(members.ball, Ball):
        return {}
    found = discretisation(
        members.ball, members.momentum, members.gamma, task.time_step, task.steps, task.order, task.precision,
        attitude=bool(plan.needed & {"attitude", "contact"}), contact="contact" in plan.needed,
    )  # fmt: skip
    return {} if found is None else {"discretisation": found.write()}


def far(data: "Dataset") -> dict[str, Any]:
    """As plain data: `motion`, with what was asked for, estimated and chosen; or `discretisation`; or nothing."""
    map_ = _map(data)
    if map_ is not None:
        return {"discretisation": asdict(map_)}
    if not {"error", "order", "substeps"} <= set(data.data_vars) or "accuracy" not in data.attrs:
        return {}
    error, ran = np.asarray(data["error"].values, dtype=float), data["order"].values >= 0
    error = error[ran & np.isfinite(error)]
    if not error.size:
        return {}
    accuracy, of = float(data.attrs["accuracy"]), str(data.attrs.get("accuracy_of"))
    chosen = {name: [int(data[name].values[ran].min()), int(data[name].values[ran].max())] for name in _CHOSEN}
    worse = int((error > accuracy).sum())
    return {"motion": {"accuracy": accuracy, "of": of, "error": float(error.max()), "worse": worse, **chosen}}


_CHOSEN = ("order", "substeps")


def sentence(data: "Dataset") -> tuple[str, str] | None:
    """The same for a reader: a key and a text; None if nothing is known."""
    map_, found = _map(data), far(data).get("motion")
    if "row" in data.dims and "time" in data.coords:
        return "discretisation", "of a ball in more than three dimensions it is not estimated"
    if map_ is not None:
        return "discretisation", map_.sentence()
    if found is None:
        return None
    balls = data.sizes["ball"]
    unit = " m of the contact point" if found["of"] == "contact" else ""
    about = f"of the ball to an estimated {found['error']:.1e}{unit}" if balls == 1 else (
        f"of the balls to an estimated {found['error']:.1e}{unit}, the worst of {balls}"
    )  # fmt: skip
    more = f"; {found['worse']} of them are not within it" if found["worse"] and balls > 1 else ""
    asked = f"{'not the ' if found['worse'] and balls == 1 else ''}{found['accuracy']:g} asked for{more}"
    order, steps = (_span(*found[name]) for name in _CHOSEN)
    how = f"order {order}, {steps} step{'s' if steps != '1' else ''} from frame to frame" if order != "0" else (
        "a steady rotation, in closed form"
    )  # fmt: skip
    return "motion", f"{about} ({asked}): {how}"


def _span(least: int, most: int) -> str:
    return f"{least}" if least == most else f"{least} to {most}"


def _map(data: "Dataset") -> Discretisation | None:
    return read(data.attrs.get("discretisation"))
