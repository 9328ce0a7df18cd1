"""The trace of the contact point on the plane: of one ball, of several in colours, of thousands as a density."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from xarray import Dataset

from chapsym.dynamics.ball import Floats

from ..drawing import curves, reading, series, traces
from ..drawing.style import COLOURS, FEW, VERTICES, WIDTH, Picture, in_power, legend, new, power
from .four import draw_pairs

ABSENT = 'no contact: add "contact" to run.outputs'
#: Inches of the trace's panel, from flat to tall.
LOW, HIGH = 2.2, 5.6
#: Cells of the density along each side; and when ellipses around the balls are drawn, as parts of the run.
CELLS = 360
MOMENTS = (0.25, 0.5, 0.75, 1.0)
SHARES = (50, 90)
#: Traces that stay this near to their chord (of its length) are shown a second time, enlarged across it.
STRAIGHT = 0.08


def draw(dataset: Dataset) -> Picture:
    """The traces, in metres, with equal axes; in n dimensions a panel for each pair of coordinates."""
    trace = reading.values(dataset, "contact")
    if trace.shape[-1] > 2:
        return draw_pairs(dataset, trace)
    factor, text = power(float(np.nanmax(np.abs(trace), initial=0.0)))
    trace = trace / factor
    aside = [] if len(trace) > FEW else sideways(trace, reading.last_frames(dataset))
    heights = [panel_height(trace), *([2.1] if aside else [])]
    figure, (axis, *below) = new(
        str(dataset.attrs.get("title", "")), len(heights), height=sum(heights) / len(heights), height_ratios=heights
    )
    axis.set_aspect("equal", adjustable="datalim")
    if len(trace) <= curves.LINES:
        traces.lines(axis, dataset, trace)
    else:
        _density(axis, dataset, trace)
    axis.set(xlabel=in_power("x", "m", text), ylabel=in_power("y", "m", text))
    axis.margins(0.06)
    for panel in below:
        label = in_power("along the way, from start to end", "m", text)
        _aside(panel, aside, label, factor, curves.too_far(dataset))
    legend(figure, [axis])
    return figure


def sideways(trace: Floats, last: np.ndarray) -> list[tuple[Floats, Floats]]:
    """Of each ball how far it is along the line from its start to its end, and off it to the left, (frames,) each.

    Nothing where the traces are not so straight that a picture with equal axes hides how they bend.
    """
    found = []
    for path, end in zip(trace, last, strict=True):
        way = path[end] - path[0] if end > 0 else np.zeros(2)
        length = float(np.sqrt(way @ way))
        if length == 0.0:
            continue
        away = path[: end + 1] - path[0]
        along, off = away @ way / length, (away[:, 1] * way[0] - away[:, 0] * way[1]) / length
        found.append((along, off))
        if np.abs(off).max() > STRAIGHT * length:
            return []
    return found if any(np.abs(off).max() > 1e-12 * np.abs(along).max() for along, off in found) else []


def _aside(panel: Axes, aside: list[tuple[Floats, Floats]], label: str, factor: float, points: bool) -> None:
    """The same traces with the direction across the way enlarged; of many waves their range."""
    size = max(float(np.abs(off).max()) for _, off in aside)
    unit, text = power(factor * size)
    for colour, (along, off) in zip(COLOURS, aside, strict=False):
        if (np.diff(along) >= 0).all():
            series.line(panel, along, off * factor / unit, colour, points=points, linewidth=1.2)
        else:
            panel.plot(along, off * factor / unit, color=colour, linewidth=1.2)
    if any(series.swings(off) > series.SWINGS for _, off in aside) and not points:
        panel.set_title("the range of its waves", fontsize=10)
    panel.set(xlabel=label, ylabel=in_power("to the left", "m", text))


def panel_height(trace: Floats) -> float:
    """Inches for the panel, such that the trace fills it with equal axes."""
    low, high = (f(trace.reshape(-1, trace.shape[-1]), axis=0) for f in (np.nanmin, np.nanmax))
    across, up = (float(x) for x in (high - low)[:2])
    inside = WIDTH - 0.9
    return float(np.clip(inside * up / across if across > 0.0 else HIGH, LOW, HIGH)) + 0.9


def _density(axis: Axes, dataset: Dataset, trace: Floats) -> None:
    """How often each place was visited, the mean path, and ellipses that hold 50 and 90 % of the balls."""
    count, edges = _visits(trace)
    shown = axis.imshow(
        np.ma.masked_equal(count.T, 0), extent=(*edges[0], *edges[1]), origin="lower", cmap="viridis_r",
        norm=LogNorm(1, max(2.0, float(count.max()))), interpolation="nearest", aspect="equal", zorder=1,
    )  # fmt: skip
    axis.set_aspect("equal", adjustable="datalim")
    axis.figure.colorbar(shown, ax=axis, location="bottom", aspect=40, pad=0.02, fraction=0.06,
                         label=f"frames of {len(trace)} balls in a cell")  # fmt: skip
    going = np.asarray(np.isfinite(trace).all(axis=-1))
    frames = np.flatnonzero(going.sum(axis=0) > going[:, 0].sum() // 2)  # of those whose turn has come
    mean = np.array([trace[going[:, k], k].mean(axis=0) for k in frames])
    axis.plot(
        *mean.T, color="black", linewidth=1.0, label="mean of the balls", zorder=3, rasterized=len(mean) > VERTICES
    )
    for part in MOMENTS:
        k = int(frames[round(part * (len(frames) - 1))])
        for share in SHARES:
            told = f"{SHARES[0]} and {SHARES[1]} % of them" if part == MOMENTS[0] and share == SHARES[0] else None
            axis.plot(*ellipse(trace[going[:, k], k], share).T, color=COLOURS[1], linewidth=1.3, label=told, zorder=4)


def _visits(trace: Floats) -> tuple[np.ndarray, list[tuple[float, float]]]:
    """Counts in square cells, (nx, ny), and the range of each side."""
    flat = trace.reshape(-1, 2)
    flat = flat[np.isfinite(flat).all(axis=-1)]
    low, high = flat.min(axis=0), flat.max(axis=0)
    size = float((high - low).max()) / CELLS or 1.0
    cells = np.maximum(np.ceil((high - low) / size).astype(int), 1)
    at = np.minimum(((flat - low) / size).astype(int), cells - 1)
    count = np.bincount(at[:, 0] * cells[1] + at[:, 1], minlength=cells.prod()).reshape(cells)
    return count, [(float(a), float(a + n * size)) for a, n in zip(low, cells, strict=True)]


def ellipse(points: Floats, share: float) -> Floats:
    """The ellipse about the mean of points (balls, 2), shaped as their covariance, that holds `share` % of them."""
    centre = points.mean(axis=0)
    widths, axes = np.linalg.eigh(np.atleast_2d(np.cov(points.T, bias=True)))
    widths = np.sqrt(np.maximum(widths, 0.0))
    local = (points - centre) @ axes
    inside = np.divide(local, widths, out=np.zeros_like(local), where=widths > 1e-12 * max(widths.max(), 1e-300))
    radius = np.percentile(np.sqrt((inside**2).sum(axis=-1)), share)
    turn = np.linspace(0.0, 2.0 * np.pi, 91)
    return centre + radius * (np.stack([np.cos(turn), np.sin(turn)], -1) * widths) @ axes.T
