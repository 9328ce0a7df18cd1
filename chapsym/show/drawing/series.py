"""Values over time: lines for a few balls, bands of percentiles for many; nothing is lost by thinning out."""

import numpy as np
from matplotlib.axes import Axes

from chapsym.dynamics.ball import Floats

#: A line has at most so many vertices; of more frames the range in each of as many intervals is drawn.
MOST = 1500
#: Percentiles are taken at so many frames at most.
INSTANTS = 600


def line(axis: Axes, t: Floats, y: Floats, colour: str, label: str | None = None, **options: object) -> None:
    """One series, t and y (frames,): a line, or where that were too dense the range of y in each interval of t."""
    if len(t) <= 2 * MOST:
        alone = {"marker": "o", "markersize": 5} if np.count_nonzero(np.isfinite(y)) == 1 else {}
        axis.plot(t, y, color=colour, label=label, **(alone | options))  # type: ignore[arg-type]
        return
    edges = np.linspace(0, len(t), MOST + 1).astype(int)[:-1]
    low, high = np.fmin.reduceat(y, edges), np.fmax.reduceat(y, edges)
    # Next intervals share an end, so that a slow series is a line without gaps.
    low[1:], high[1:] = np.fmin(low[1:], y[edges[1:] - 1]), np.fmax(high[1:], y[edges[1:] - 1])
    axis.fill_between(t[edges], low, high, color=colour, linewidth=0.8, label=label)


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
