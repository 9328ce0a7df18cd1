"""The elliptic phase u of a ball with vertical momentum, and its increments."""

from typing import TYPE_CHECKING

import numpy as np

from chapsym.dynamics.ball import Floats

from . import change, reading, series
from .style import COLOURS, FEW, at_least, in_power, legend, new, power

if TYPE_CHECKING:
    from xarray import Dataset

    from .picture import Picture

NEEDS = ("phase",)
ABOUT = "elliptic phase u over time, and its increment a step"


def missing(dataset: "Dataset") -> str | None:
    """Why this figure cannot be drawn, in a sentence; None if it can."""
    if "phase" not in dataset:
        return 'no phase: add "phase" to run.outputs (for vertical momentum)'
    return "an increment needs two frames" if dataset.sizes["frame"] < 2 else None


def draw(dataset: "Dataset") -> "Picture":
    """u(t) above; below (u of the next frame - u)/(steps between), constant for D = 0, else a function of u."""
    u = reading.values(dataset, "phase")
    t, label = reading.clock(dataset)
    figure, (above, below) = new(str(dataset.attrs.get("title", "")), 2, height=2.4, sharex=True)
    each = np.diff(u, axis=1) / np.diff(reading.steps(dataset))
    for axis, array, when in ((above, u, t), (below, each, t[:-1])):
        factor, text = power(float(np.nanmax(np.abs(array), initial=0.0)))
        if len(u) <= FEW:
            for i, one in enumerate(array):
                name = reading.ball_names(dataset)[i] if len(u) > 1 and axis is above else None
                series.line(axis, when, one / factor, COLOURS[i], name)
        else:
            series.fan(axis, when, array / factor, COLOURS[0])
        axis.set_ylabel(in_power("phase u" if axis is above else "increment a step", "", text))
    at_least(below, _flat(u, each))
    below.set_xlabel(label)
    legend(figure, [above])
    return figure


def _flat(u: Floats, each: Floats) -> float:
    """Roundoff of u in an increment is flat: 20 ulps of u, and a thousandth of the increment, in the panel's unit."""
    largest = float(np.nanmax(np.abs(each), initial=0.0))
    factor, _ = power(largest)
    return max(change.ULPS * change.ULP * float(np.nanmax(np.abs(u), initial=0.0)), 1e-3 * largest) / factor
