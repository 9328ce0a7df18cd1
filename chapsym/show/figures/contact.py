"""The trace of the contact point on the plane: one ball, several in colours, or thousands as a density."""

from itertools import combinations
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from xarray import Dataset

from chapsym.dynamics.ball import Floats

from ..drawing import curves, reading, series
from ..drawing.style import COLOURS, FEW, VERTICES, WIDTH, Picture, colour_bar, in_power, legend, new, power, scale
from .over_time import mean

#: The least and the largest height of the panel of the trace, in inches.
LOW, HIGH = 2.2, 5.6
#: Cells of the density along each side; and the times of the ellipses around the balls, as fractions of the run.
CELLS = 360
MOMENTS = (0.25, 0.5, 0.75, 1.0)
SHARES = (50, 90)
#: Traces within this fraction of their length of their chord are shown again, enlarged across it.
STRAIGHT = 0.08
#: The least side of a cell, relative to the largest coordinate.
ROUNDED = 1e-12


def draw(dataset: Dataset) -> Picture:
    """The traces, in metres, with equal axes; in n dimensions a panel for each pair of coordinates."""
    trace = reading.values(dataset, "contact")
    factor, text = power(reading.size_of(trace))
    trace = trace / factor
    if trace.shape[-1] > 2:
        return _pairs(dataset.isel(ball=slice(0, FEW)), trace[:FEW], text)
    aside = [] if len(trace) > FEW else sideways(trace, reading.last_frames(dataset))
    heights = [panel_height(trace), *([2.1] if aside else [])]
    each = sum(heights) / len(heights)
    figure, (axis, *below) = new(reading.title(dataset), len(heights), height=each, height_ratios=heights)
    axis.set_aspect("equal", adjustable="datalim")
    if len(trace) <= curves.LINES:
        _lines(axis, dataset, trace)
    else:
        _density(axis, trace)
    axis.set(xlabel=in_power("x", "m", text), ylabel=in_power("y", "m", text))
    axis.margins(0.06)
    for panel in below:
        label = in_power("along the way, from start to end", "m", text)
        _aside(panel, aside, label, factor, curves.too_far(dataset))
    legend(figure, [axis])
    return figure


def _pairs(dataset: Dataset, trace: Floats, text: str) -> Picture:
    """The contact point in a hyperplane, (balls, frames, n - 1): a panel for each pair of the first three axes."""
    figure, (first, *more, last) = new(reading.title(dataset), 2, 2, height=2.9)
    for axis, (a, b) in zip((first, *more), combinations(range(3), 2), strict=True):
        _lines(axis, dataset, trace[..., [a, b]], legend=axis is first)
        axis.set_aspect("equal", adjustable="datalim")
        axis.set(xlabel=in_power(f"$x_{a + 1}$", "m", text), ylabel=in_power(f"$x_{b + 1}$", "m", text))
    last.set_axis_off()
    last.legend(*first.get_legend_handles_labels(), loc="center")
    return figure


def sideways(trace: Floats, last: np.ndarray) -> list[tuple[Floats, Floats]]:
    """The distance of each ball along the line from its start to its end, and to the left of it, (frames,) each.

    None unless the traces are so straight that a picture with equal axes hides their curvature.
    """
    found = []
    for path, end in zip(trace @ [1.0, 1.0j], last, strict=True):
        away = path[: end + 1] - path[0]
        length = float(np.abs(away[-1]))
        if length > 0.0:
            turned = away * np.conj(away[-1]) / length
            found.append((turned.real, turned.imag))
            if np.abs(turned.imag).max() > STRAIGHT * length:
                return []
    return found if any(np.abs(off).max() > 1e-12 * np.abs(along).max() for along, off in found) else []


def _aside(panel: Axes, aside: list[tuple[Floats, Floats]], label: str, factor: float, points: bool) -> None:
    """The same traces with the direction across the path enlarged; for many oscillations their range."""
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
    """The height of the panel in inches that the trace fills with equal axes."""
    low, high = (f(trace.reshape(-1, trace.shape[-1]), axis=0) for f in (np.nanmin, np.nanmax))
    across, up = (float(x) for x in (high - low)[:2])
    inside = WIDTH - 0.9
    return float(np.clip(inside * up / across if across > 0.0 else HIGH, LOW, HIGH)) + 0.9


def _lines(axis: Axes, dataset: Dataset, trace: Floats, legend: bool = True) -> None:
    """A line for each ball, with its start, its end, and arrows along it."""
    last, names, stopped = reading.last_frames(dataset), reading.labels(dataset), reading.stopped(dataset)
    few = len(trace) <= FEW
    colours = COLOURS
    if not few:
        name, data, units = reading.first_parameter(dataset)
        colours = scale([axis], data, reading.labelled(name, units))(data)
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


def _density(axis: Axes, trace: Floats) -> None:
    """The number of visits of each cell, the mean path, and ellipses that contain 50 and 90 % of the balls."""
    going = np.asarray(np.isfinite(trace).all(axis=-1))
    flat = trace[going]
    low, high = flat.min(axis=0), flat.max(axis=0)
    size = max(float((high - low).max()) / CELLS, ROUNDED * float(np.abs(flat).max())) or 1.0
    cells = np.maximum(np.ceil((high - low) / size).astype(int), 1)  # square cells
    sides = np.stack([low, low + cells * size], axis=-1)
    count, _, _ = np.histogram2d(flat[:, 0], flat[:, 1], bins=cells.tolist(), range=sides)
    norm = LogNorm(1, max(2.0, float(count.max())))
    axis.imshow(
        np.ma.masked_equal(count.T, 0), extent=(*sides[0], *sides[1]), origin="lower", cmap="viridis_r", norm=norm,
        interpolation="nearest", zorder=1,
    )  # fmt: skip
    axis.set_aspect("equal", adjustable="datalim")
    colour_bar(ScalarMappable(norm, "viridis_r"), [axis], f"frames of {len(trace)} balls in a cell")
    frames = np.flatnonzero(going.sum(axis=0) > going[:, 0].sum() // 2)  # of the balls that have started
    path = mean(trace[:, frames])
    dense = len(path) > VERTICES
    axis.plot(*path.T, color="black", linewidth=1.0, label="mean of the balls", zorder=3, rasterized=dense)
    for part in MOMENTS:
        k = int(frames[round(part * (len(frames) - 1))])
        for share in SHARES:
            entry = f"{SHARES[0]} and {SHARES[1]} % of them" if part == MOMENTS[0] and share == SHARES[0] else None
            axis.plot(*ellipse(trace[going[:, k], k], share).T, color=COLOURS[1], linewidth=1.3, label=entry, zorder=4)


def ellipse(points: Floats, share: float) -> Floats:
    """The ellipse about the mean of points (balls, 2), in the shape of their covariance, with `share` % of them."""
    centre = points.mean(axis=0)
    widths, axes = np.linalg.eigh(np.atleast_2d(np.cov(points.T, bias=True)))
    widths = np.sqrt(np.maximum(widths, 0.0))
    local = (points - centre) @ axes
    inside = np.divide(local, widths, out=np.zeros_like(local), where=widths > 1e-12 * max(widths.max(), 1e-300))
    radius = np.percentile(np.sqrt((inside**2).sum(axis=-1)), share)
    turn = np.linspace(0.0, 2.0 * np.pi, 91)
    return centre + radius * (np.stack([np.cos(turn), np.sin(turn)], -1) * widths) @ axes.T
