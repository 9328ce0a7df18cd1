"""The rotation number of the balls of a sweep against what was varied."""

import numpy as np
from xarray import Dataset

from ..drawing import reading
from ..drawing.style import COLOURS, VERTICES, Picture, in_power, new, power, scale


def missing(dataset: Dataset) -> str | None:
    """Why this figure cannot be drawn, in a sentence; None if it can."""
    if "rotation_number" not in dataset:
        return 'no rotation number: add "rotation_number" to run.outputs'
    return "one ball has one rotation number: sweep a parameter to see it change" if dataset.sizes["ball"] < 2 else None


def draw(dataset: Dataset) -> Picture:
    """Points over the first parameter; a second one is the colour.  Without parameters, over the number of the ball."""
    found = reading.per_ball(dataset, "rotation_number")
    assert found is not None
    varied = reading.parameters(dataset)
    figure, (axis,) = new(str(dataset.attrs.get("title", "")), height=4.0 if len(varied) > 1 else 3.4)
    number = np.arange(len(found), dtype=np.float64)
    (name, (data, units)), *more = varied.items() or [("ball", (number, ""))]
    factor, text = power(float(np.nanmax(np.abs(data), initial=0.0)))
    dense = len(found) > VERTICES // 8
    if more:
        other, (values, other_units) = more[0]
        colours = scale(axis, values, reading.labelled(other, other_units))(values)
        axis.scatter(data / factor, found, c=colours, s=10, linewidths=0, rasterized=dense)
    else:
        order = np.argsort(data, kind="stable")
        style = "-" if len(found) > 40 else "o-"
        axis.plot(data[order] / factor, found[order], style, color=COLOURS[0], markersize=4, rasterized=dense)
    axis.set_xlabel(in_power(reading.literal(name), reading.readable(units), text))
    axis.set_ylabel("rotation number, turns a step")
    lost = int((~np.isfinite(found)).sum())
    if lost:
        axis.set_title(f"{lost} of {len(found)} balls have none (not on a closed curve)")
    return figure
