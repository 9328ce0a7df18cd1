"""Values over time: lines for a few balls, bands of percentiles for many; nothing is lost by thinning out."""

import numpy as np
from matplotlib.axes import Axes

from chapsym.dynamics.ball import Floats

#: A line has at most so many vertices; of more frames the range in each of as many intervals is drawn.
MOST = 1500
#: A line that swings more often than this in a panel would be a striped block.
SWINGS = 100
#: Of a series with more swings, so many are drawn as a line.
SOME = 20
#: Percentiles are taken at so many frames at most.
INSTANTS = 600


def swings(y: Floats) -> int:
    """How often a series (frames,) goes up and down."""
    ways = np.sign(np.diff(y[np.isfinite(y)]))
    ways = ways[ways != 0]
    return int(np.count_nonzero(ways[1:] != ways[:-1]) + 1) // 2


def start(series: Floats) -> int:
    """How many frames of several series, (frames, k), are the first twenty swings of that with the most."""
    ways = [np.sign(np.diff(y)) for y in np.nan_to_num(series).T]
    turns = max((np.flatnonzero(way[1:] * way[:-1] < 0) for way in ways), key=len)
    return int(turns[2 * SOME]) + 2 if len(turns) > 2 * SOME else len(series)


def line(
    axis: Axes, t: Floats, y: Floats, colour: str, label: str | None = None, *, points: bool = False, **options: object
) -> None:
    """One series, t and y (frames,): a line, or where that were too dense the range of y in each interval of t.

    points: whether the frames are so far apart that a line between them would mean nothing.
    """
    if points:
        size = 4.0 if len(t) < 200 else 2.0
        axis.plot(t, y, "o", color=colour, markersize=size, markeredgewidth=0, rasterized=len(t) > MOST)
        axis.plot([], [], "o", color=colour, markersize=5, markeredgewidth=0, label=label)
        return
    many = swings(y)
    if many > SWINGS:
        _band(axis, t, y, colour, label, min(MOST, many // 3), alpha=0.55)
        return
    if len(t) <= 2 * MOST:
        alone = {"marker": "o", "markersize": 5} if np.count_nonzero(np.isfinite(y)) == 1 else {}
        axis.plot(t, y, color=colour, label=label, **(alone | options))  # type: ignore[arg-type]
        return
    _band(axis, t, y, colour, label, MOST)


def _band(
    axis: Axes, t: Floats, y: Floats, colour: str, label: str | None, intervals: int, alpha: float | None = None
) -> None:
    """The range of a series in so many intervals."""
    edges = np.linspace(0, len(t), intervals + 1).astype(int)[:-1]
    low, high = np.fmin.reduceat(y, edges), np.fmax.reduceat(y, edges)
    # Next intervals share an end, so that a slow series is a line without gaps.
    low[1:], high[1:] = np.fmin(low[1:], y[edges[1:] - 1]), np.fmax(high[1:], y[edges[1:] - 1])
    ends = np.append(t[edges], t[-1])
    axis.fill_between(
        ends, np.append(low, low[-1]), np.append(high, high[-1]), color=colour, linewidth=0.8, label=label, alpha=alpha
    )


def instants(frames: int) -> np.ndarray:
    """The frames at which percentiles are taken, with the first and the last."""
    return np.unique(np.linspace(0, frames - 1, min(frames, INSTANTS)).round().astype(int))


def percentiles(y: Floats, wanted: tuple[float, ...]) -> Floats:
    """Percentiles over the balls at each frame, (len(wanted), frames), of y (balls, frames); NaN where none is left."""
    found = np.full((len(wanted), y.shape[1]), np.nan)
    for frame in range(y.shape[1]):
        there = y[:, frame][np.isfinite(y[:, frame])]
        if there.size:
            found[:, frame] = np.percentile(there, wanted)
    return found


def fan(axis: Axes, t: Floats, y: Floats, colour: str, label: str | None = None) -> None:
    """Many balls, y (balls, frames): the median, and bands that hold 50 and 90 % and all of them."""
    some = instants(len(t))
    low, five, quarter, half, three, most, high = percentiles(y[:, some], (0, 5, 25, 50, 75, 95, 100))
    axis.fill_between(t[some], low, high, color=colour, alpha=0.13, linewidth=0)
    axis.fill_between(t[some], five, most, color=colour, alpha=0.2, linewidth=0)
    axis.fill_between(t[some], quarter, three, color=colour, alpha=0.3, linewidth=0)
    axis.plot(t[some], half, color=colour, label=label)
