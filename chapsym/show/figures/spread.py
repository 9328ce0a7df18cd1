"""How far the balls of a batch are from each other, over time."""

import numpy as np
from matplotlib.axes import Axes
from xarray import Dataset

from chapsym.dynamics.ball import Floats

from ..drawing import reading, series
from ..drawing.style import COLOURS, Picture, in_power, legend, new, power

NEEDS = ("contact", "gamma")
#: A spread that grows more than this after a tenth of the run is drawn in logarithms.
LOGARITHMIC = 30.0
#: Distances below this part of the largest are roundoff.
ROUNDOFF = 1e-12
WANTED = ((5, 95, 0.18, "5 to 95 %"), (25, 75, 0.3, "25 to 75 %"))


def missing(dataset: Dataset) -> str | None:
    """Why this figure cannot be drawn, in a sentence; None if it can."""
    if dataset.sizes.get("ball", 1) < 3:
        return "a spread needs at least three balls"
    if "contact" not in dataset and "gamma" not in dataset:
        return 'no contact and no γ: add "contact" to run.outputs'
    going = np.count_nonzero(reading.last_frames(dataset) > 0)
    return "a spread needs at least three balls that go on" if going < 3 else None


def draw(dataset: Dataset) -> Picture:
    """Percentiles of the distance from the mean contact point (m), and of the angle of γ from its mean (degrees)."""
    shown = [name for name in NEEDS if name in dataset]
    figure, axes = new(str(dataset.attrs.get("title", "")), len(shown), height=2.8, sharex=True)
    t, label = reading.clock(dataset)
    some = series.instants(len(t))
    for axis, name, colour in zip(axes, shown, COLOURS, strict=False):
        far = from_mean(reading.values(dataset, name)[:, some], on_sphere=name == "gamma")
        told, unit = ("distance from the mean", "m") if name == "contact" else (r"angle of $\gamma$ from its mean", "°")
        _panel(axis, t[some], far, colour, told, unit)
    axes[-1].set_xlabel(label)
    legend(figure, axes[:1])
    return figure


def _panel(axis: Axes, t: Floats, far: Floats, colour: str, told: str, unit: str) -> None:
    wanted = sorted({p for low, high, *_ in WANTED for p in (low, high)} | {50})
    found = dict(zip(wanted, series.percentiles(far, tuple(wanted)), strict=True))
    half = found[50]
    logarithmic = _grows(half)
    factor, text = (1.0, "") if logarithmic else power(float(np.nanmax(far, initial=0.0)))
    for low, high, alpha, name in WANTED:
        axis.fill_between(
            t, found[low] / factor, found[high] / factor, color=colour, alpha=alpha, linewidth=0, label=name
        )
    axis.plot(t, half / factor, color=colour, label="median")
    if logarithmic:
        axis.set_yscale("log", nonpositive="mask")
        seen = found[WANTED[0][0]][1:]
        axis.set_ylim(bottom=0.5 * float(np.nanmin(seen[seen > ROUNDOFF * np.nanmax(far)])))
    else:
        axis.set_ylim(bottom=0.0)
    axis.set_ylabel(in_power(told, unit, text))


def _grows(half: Floats) -> bool:
    """Whether the median distance grows by orders between a tenth of the run and its end: linear growth does not."""
    going = half[np.isfinite(half)]
    return len(going) > 10 and going[-1] > LOGARITHMIC * going[len(going) // 10] > 0.0


def from_mean(points: Floats, on_sphere: bool) -> Floats:
    """Distance of each ball from the mean of those that go on, (balls, frames); on the sphere the angle in degrees."""
    mean = np.full(points.shape[1:], np.nan)
    for k in range(points.shape[1]):
        there = points[np.isfinite(points[:, k]).all(axis=-1), k]
        if len(there):
            mean[k] = there.mean(axis=0)
    if on_sphere:
        length = np.sqrt((mean * mean).sum(axis=-1, keepdims=True))
        mean = mean / np.where(length > 0.0, length, 1.0)
    chord = np.sqrt(((points - mean) ** 2).sum(axis=-1))
    return np.rad2deg(2.0 * np.arcsin(np.minimum(chord / 2.0, 1.0))) if on_sphere else chord
