"""How far a result is from the motion of the ball: by its error, where that was verified, or as a map of its steps."""

import math
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import numpy as np

from chapsym.accuracy.discretisation import Discretisation, read

if TYPE_CHECKING:
    from xarray import Dataset

    from .dataset import Arrays


def far(data: "Dataset | Arrays") -> dict[str, Any]:
    """As plain data: `motion`, with what was asked for, estimated and chosen; or `discretisation`; or nothing."""
    map_ = _map(data)
    if map_ is not None:
        return {"discretisation": asdict(map_)}
    if "error" not in data or "accuracy" not in data.attrs:
        return {}
    error = np.asarray(data["error"].values, dtype=float)
    there = ~np.isnan(error)  # balls whose turn has not come, or that stopped
    if not there.any() or data.sizes.get("frame", 1) < 2:
        return {}
    accuracy, of = float(data.attrs["accuracy"]), str(data.attrs.get("accuracy_of"))
    chosen = {name: [int(f(data[name].values[there])) for f in (min, max)] for name in _CHOSEN if name in data}
    largest, worse = float(error[there].max()), int((error[there] > accuracy).sum())
    told = largest if math.isfinite(largest) else None
    return {"motion": {"accuracy": accuracy, "of": of, "error": told, "worse": worse, **chosen}}


_CHOSEN = ("order", "substeps")


def sentence(data: "Dataset | Arrays") -> tuple[str, str] | None:
    """The same for a reader: a key and a text; None if nothing is known."""
    map_, found = _map(data), far(data).get("motion")
    if "row" in data.dims and "time" in data.coords:
        return "discretisation", "of a ball in more than three dimensions it is not estimated"
    if map_ is not None:
        return "discretisation", map_.sentence()
    if found is None:
        return None
    balls, unit = data.sizes["ball"], " m" if found["of"] == "contact" else ""
    error = "an error that is not known" if found["error"] is None else f"an estimated {found['error']:.1e}{unit}"
    about = f"of the ball to {error}" if balls == 1 else f"of the balls to {error}, the worst of {balls}"
    more = f"; {found['worse']} of them are not within it" if found["worse"] and balls > 1 else ""
    asked = f"{'not the ' if found['worse'] and balls == 1 else ''}{found['accuracy']:g} asked for{more}"
    return "motion", f"{about} ({asked})" + _how(*(found[name] for name in _CHOSEN if name in found))


def _how(order: tuple[int, int] = (0, 0), substeps: tuple[int, int] | None = None) -> str:
    """What was chosen, where it is known."""
    if substeps is None:
        return ""
    if order[1] == 0:
        return ": a steady rotation, in closed form"
    steps = _span(*substeps)
    return f": order {_span(*order)}, at most {steps} step{'s' if steps != '1' else ''} from frame to frame"


def _span(least: int, most: int) -> str:
    return f"{least}" if least == most else f"{least} to {most}"


def _map(data: "Dataset | Arrays") -> Discretisation | None:
    return read(data.attrs.get("discretisation"))
