"""How far what should stay has moved, relatively: in units in which roundoff looks like roundoff."""

import numpy as np
from matplotlib.axes import Axes
from xarray import Dataset

from chapsym.dynamics.ball import Floats

from ..drawing import curves, reading, series
from ..drawing.style import COLOURS, FEW, power

#: The least range of an axis, in ulps of the value: a wobble of the last digit looks like one.
ULPS = 20
ULP = float(np.finfo(np.float64).eps)


def relative(quantity: Floats, size: Floats) -> Floats:
    """(x - x at the start)/size, (balls, frames), of x (balls, frames) and size (balls,); undivided where that is 0."""
    divisor = np.where(size > 0.0, size, 1.0)[:, np.newaxis]
    return np.asarray((quantity - quantity[:, :1]) / divisor)


def plot(axis: Axes, dataset: Dataset, changes: dict[str, Floats]) -> None:
    """Each change (balls, frames): lines for one ball, or a few if it is one change; bands for more.

    The axis spans 20 ulps at least.
    """
    t, label = reading.clock(dataset)
    points = curves.too_far(dataset)
    largest = max((float(np.nanmax(np.abs(c), initial=0.0)) for c in changes.values()), default=0.0)
    factor, text = power(max(largest, ULPS * ULP / 2))
    for colour, (name, change) in zip(COLOURS, changes.items(), strict=False):
        told = f"{name}: {_brief(float(np.nanmax(np.abs(change), initial=0.0)))}"
        if len(change) == 1 or (len(changes) == 1 and len(change) <= FEW):
            for i, one in enumerate(change):
                each = told if len(change) == 1 else reading.labels(dataset)[i]
                series.line(axis, t, one / factor, colour if len(change) == 1 else COLOURS[i], each, points=points)
        else:
            series.fan(axis, t, change / factor, colour, told)
    if largest <= ULPS * ULP / 2:
        axis.set_ylim(-ULPS * ULP / 2 / factor, ULPS * ULP / 2 / factor)
    axis.axhline(0.0, color="0.6", linewidth=0.8, zorder=0.5)
    axis.set(xlabel=label, ylabel=f"relative change, {text}" if text else "relative change")


def _brief(size: float) -> str:
    return f"{size:.1e}".replace("e-0", "e-") if size else "0"
