"""Vectors over time, a panel for each component or all in one: lines for a few balls, bands for many."""

import numpy as np
from xarray import Dataset

from chapsym.dynamics.ball import Floats

from . import reading, series
from .style import COLOURS, FEW, Picture, at_least, in_power, legend, new, power

#: A change below this part of the largest component is drawn flat.
FLAT = 1e-3


def draw(dataset: Dataset, array: Floats, names: list[str], symbol: str, units: str) -> Picture:
    """array (balls, frames, components): one panel with all components of one ball, else a panel for each."""
    t, label = reading.clock(dataset)
    factor, text = power(float(np.nanmax(np.abs(array), initial=0.0)))
    array = array / factor
    alone = len(array) == 1
    figure, axes = new(
        str(dataset.attrs.get("title", "")), 1 if alone else len(names), height=3.3 if alone else 1.9, sharex=True
    )
    balls = reading.labels(dataset)
    for k, name in enumerate(names):
        axis = axes[0 if alone else k]
        if alone:
            series.line(axis, t, array[0, :, k], COLOURS[k % len(COLOURS)], name)
        elif len(array) <= FEW:
            for i, one in enumerate(array):
                series.line(axis, t, one[:, k], COLOURS[i], balls[i] if k == 0 else None)
        else:
            series.fan(axis, t, array[:, :, k], COLOURS[k % len(COLOURS)])
        if not alone:
            axis.set_ylabel(in_power(name, units, text))
    if alone:
        axes[0].set_ylabel(in_power(symbol, units, text))
    for axis in axes:
        at_least(axis, FLAT * max(map(abs, axis.get_ylim())))
    axes[-1].set_xlabel(label)
    if len(array) <= FEW:
        legend(figure, axes)
    else:
        figure.supxlabel("median of the balls; bands: 50 %, 90 %, all", fontsize=10, color="0.35")
    return figure
