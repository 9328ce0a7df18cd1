"""Paths on the plane: a line for each ball, with its ends and the way it went."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from xarray import Dataset

from chapsym.dynamics.ball import Floats

from . import reading
from .style import COLOURS, FEW, VERTICES, scale


def lines(axis: Axes, dataset: Dataset, trace: Floats, legend: bool = True) -> None:
    """A line for each ball, with its start, its end, and arrows along it."""
    last, names, stopped = reading.last_frames(dataset), reading.labels(dataset), reading.stopped(dataset)
    few = len(trace) <= FEW
    colours = list(COLOURS[: len(trace)]) if few else _by_parameter(axis, dataset, len(trace))
    dense = trace.shape[0] * trace.shape[1] > VERTICES
    for i, path in enumerate(trace):
        path = path[: last[i] + 1]
        label = names[i] if few and len(trace) > 1 and legend else None
        axis.plot(*path.T, color=colours[i], linewidth=1.3 if few else 0.8, rasterized=dense, label=label, zorder=2)
        if few:
            _arrows(axis, path, colours[i], 4 if len(trace) == 1 else 2)
        end = ("stopped", "X") if stopped[i] else ("end", "s")
        ends: tuple[tuple[int, str, str, Any], ...] = ((0, "start", "o", "white"), (-1, *end, colours[i]))
        for at, name, marker, face in ends:
            axis.plot(
                *path[at], marker, color=colours[i], markerfacecolor=face, markersize=7 if few else 3.5, zorder=4,
                label=name if len(trace) == 1 and legend else None,
            )  # fmt: skip
    if len(trace) > 1 and legend and stopped.any():
        axis.plot([], [], "X", color="0.3", markersize=7 if few else 4, label="stopped early")


def _by_parameter(axis: Axes, dataset: Dataset, count: int) -> list[Any]:
    """Colours by the first parameter of the sweep, or by the number of the ball."""
    varied = reading.parameters(dataset)
    if varied:
        name, (data, units) = next(iter(varied.items()))
        return [tuple(c) for c in scale(axis, data, reading.labelled(name, units))(data)]
    number = np.arange(count, dtype=np.float64)
    return [tuple(c) for c in scale(axis, number, "ball")(number)]


def _arrows(axis: Axes, path: Floats, colour: str, count: int) -> None:
    """Heads of arrows at equal parts of the length of a path."""
    along = np.concatenate([[0.0], np.cumsum(np.sqrt((np.diff(path, axis=0) ** 2).sum(axis=-1)))])
    if along[-1] == 0.0:
        return
    for part in (np.arange(count) + 0.5) / count:
        k = int(np.clip(np.searchsorted(along, part * along[-1]), 1, len(path) - 1))
        axis.annotate(
            "", xy=tuple(path[k]), xytext=tuple(path[k - 1]), zorder=3,
            arrowprops={"arrowstyle": "-|>,head_width=0.28,head_length=0.55", "color": colour, "linewidth": 0,
                        "shrinkA": 0, "shrinkB": 0},
        )  # fmt: skip
