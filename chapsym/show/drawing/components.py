"""Vectors over time, a panel for each component or all in one: lines for a few balls, bands for many."""

import numpy as np
from xarray import Dataset

from chapsym.dynamics.ball import Floats

from . import reading, series
from .curves import too_far
from .style import COLOURS, FEW, Picture, add_note, at_least, in_power, legend, new, power

#: A change below this part of the largest component is drawn flat.
FLAT = 1e-3


def draw(dataset: Dataset, array: Floats, names: list[str], symbol: str, units: str) -> Picture:
    """array (balls, frames, components): one panel with all components of one ball, else a panel for each.

    Where one ball's swing so often that they would be striped blocks, their ranges, and a panel with the first swings.
    """
    t, label = reading.clock(dataset)
    factor, text = power(float(np.nanmax(np.abs(array), initial=0.0)))
    array = array / factor
    alone = len(array) == 1
    points = too_far(dataset)
    part = series.start(array[0]) if alone and not points and _crowded(array[0]) else 0
    figure, axes = new(
        str(dataset.attrs.get("title", "")), (2 if part else 1) if alone else len(names),
        height=(2.6 if part else 3.3) if alone else 1.9, sharex=not part,
    )  # fmt: skip
    balls = reading.labels(dataset)
    for k, name in enumerate(names):
        axis = axes[0 if alone else k]
        if alone:
            series.line(axis, t, array[0, :, k], COLOURS[k % len(COLOURS)], name, points=points)
            if part:
                axes[1].plot(t[:part], array[0, :part, k], color=COLOURS[k % len(COLOURS)])
        elif len(array) <= FEW:
            for i, one in enumerate(array):
                series.line(axis, t, one[:, k], COLOURS[i], balls[i] if k == 0 else None, points=points)
        else:
            series.fan(axis, t, array[:, :, k], COLOURS[k % len(COLOURS)])
        if not alone:
            axis.set_ylabel(in_power(name, units, text))
    if alone:
        for axis in axes:
            axis.set_ylabel(in_power(symbol, units, text))
    if part:
        axes[0].set_title("above, the range of each in the whole run; below, its start", fontsize=10)
    for axis in axes:
        at_least(axis, FLAT * max(map(abs, axis.get_ylim())))
    axes[-1].set_xlabel(label)
    if len(array) <= FEW:
        legend(figure, axes)
    else:
        add_note(figure, "median of the balls; bands: 50 %, 90 %, all")
    return figure


def _crowded(array: Floats) -> bool:
    return any(series.swings(y) > series.SWINGS for y in array.T)
