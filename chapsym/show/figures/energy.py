"""The kinetic energy over time, as its relative change."""

import numpy as np
from xarray import Dataset

from ..drawing import reading
from ..drawing.style import Picture, legend, new
from . import change

ABSENT = 'no energy: add "energy" to run.outputs (and give run.time_step)'


def draw(dataset: Dataset) -> Picture:
    """(E - E₀)/E₀; the map keeps the energy up to an oscillation, and for D = 0 to roundoff."""
    energy = reading.values(dataset, "energy")
    start = energy[:, 0]
    figure, (axis,) = new(str(dataset.attrs.get("title", "")))
    change.plot(axis, dataset, {"largest change of E": change.relative(energy, np.abs(start))})
    low, high = float(start.min()), float(start.max())
    told = f"{low:.6g}" if low == high else f"{low:.4g} to {high:.4g}"
    axis.set_title(f"kinetic energy, {told} J at the start")
    legend(figure, [axis])
    return figure
