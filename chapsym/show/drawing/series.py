"""Values over time: lines for a few balls, bands of percentiles for many; dense series keep their range."""

import warnings
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from chapsym.dynamics.ball import Floats

from .style import COLOURS, FEW

#: The largest number of vertices of a line; for more frames the range in each of as many intervals is drawn.
MOST = 1500
#: The largest number of oscillations of a line in a panel; more would be a striped block.
SWINGS = 100
#: The number of oscillations that are drawn as a line of a series with more.
SOME = 20
#: The largest number of frames at which percentiles are taken.
INSTANTS = 600
#: Bands around a median: the two percentiles, the opacity, and the name in the legend.
BANDS = ((0, 100, 0.13, None), (5, 95, 0.2, None), (25, 75, 0.3, None))


def swings(y: Floats) -> int:
    """The number of times that a series (frames,) goes up and down."""
    ways = np.sign(np.diff(y[np.isfinite(y)]))
    ways = ways[ways != 0]
    return int(np.count_nonzero(ways[1:] != ways[:-1]) + 1) // 2


def start(series: Floats) -> int:
    """The number of frames of several series, (frames, k), in the first twenty oscillations of the fastest one."""
    ways = [np.sign(np.diff(y)) for y in np.nan_to_num(series).T]
    turns = max((np.flatnonzero(way[1:] * way[:-1] < 0) for way in ways), key=len)
    return int(turns[2 * SOME]) + 2 if len(turns) > 2 * SOME else len(series)


def line(
    axis: Axes, t: Floats, y: Floats, colour: str, label: str | None = None, *, points: bool = False, **options: object
) -> None:
    """One series, t and y (frames,): a line, or, if that is too dense, the range of y in each interval of t.

    points: whether the frames are too far apart for a line between them.
    """
    many = swings(y)
    if points:
        size = 4.0 if len(t) < 200 else 2.0
        axis.plot(t, y, "o", color=colour, markersize=size, markeredgewidth=0, rasterized=len(t) > MOST)
        axis.plot([], [], "o", color=colour, markersize=5, markeredgewidth=0, label=label)
    elif many > SWINGS:
        _range(axis, t, y, min(MOST, many // 3), color=colour, label=label, alpha=0.55)
    elif len(t) > 2 * MOST:
        _range(axis, t, y, MOST, color=colour, label=label)
    else:
        alone = {"marker": "o", "markersize": 5} if np.count_nonzero(np.isfinite(y)) == 1 else {}
        axis.plot(t, y, color=colour, label=label, **(alone | options))  # type: ignore[arg-type]


def _range(axis: Axes, t: Floats, y: Floats, intervals: int, **options: object) -> None:
    """The range of a series in each of this many intervals."""
    edges = np.linspace(0, len(t), intervals + 1).astype(int)[:-1]
    low, high = np.fmin.reduceat(y, edges), np.fmax.reduceat(y, edges)
    # Adjacent intervals share an end, so that a slow series is a line without gaps.
    low[1:], high[1:] = np.fmin(low[1:], y[edges[1:] - 1]), np.fmax(high[1:], y[edges[1:] - 1])
    ends = np.append(t[edges], t[-1])
    axis.fill_between(ends, np.append(low, low[-1]), np.append(high, high[-1]), linewidth=0.8, **options)  # type: ignore[arg-type]


def instants(frames: int, most: int = INSTANTS) -> np.ndarray:
    """At most this many of the frames, evenly, with the first and the last."""
    return np.unique(np.linspace(0, frames - 1, min(frames, most)).round().astype(int))


def percentiles(y: Floats, wanted: Sequence[float]) -> Floats:
    """Percentiles over the balls at each frame, (len(wanted), frames), of y (balls, frames); NaN if no ball is left."""
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "All-NaN slice")
        return np.asarray(np.nanpercentile(y, wanted, axis=0))


def fan(
    axis: Axes, t: Floats, y: Floats, colour: str, label: str | None = None,
    bands: Sequence[tuple[float, float, float, str | None]] = BANDS,
) -> None:  # fmt: skip
    """Many balls, y (balls, frames): the median, and percentile bands."""
    some = instants(len(t))
    t, y = t[some], y[:, some]
    for low, high, alpha, name in bands:
        axis.fill_between(t, *percentiles(y, (low, high)), color=colour, alpha=alpha, linewidth=0, label=name)
    axis.plot(t, percentiles(y, (50,))[0], color=colour, label=label)


def balls(axis: Axes, t: Floats, y: Floats, colour: str, names: Sequence[str | None], *, points: bool = False) -> None:
    """A line in its colour for each of a few balls, y (balls, frames), or bands in one colour for more."""
    if len(y) > FEW:
        fan(axis, t, y, colour)
        return
    for own, one, name in zip(COLOURS, y, names, strict=False):
        line(axis, t, one, own, name, points=points)
