"""The attitude: the paths of the body axes on the sphere of space, and the quaternion over time."""

import numpy as np
from xarray import Dataset

from chapsym.dynamics import kernels
from chapsym.dynamics.ball import Floats

from ..drawing import components, curves, reading, series
from ..drawing.sphere import LONGEST, View, draw_globe, draw_orbit
from ..drawing.style import COLOURS, FEW, VERTICES, Picture, empty, entitle, legend

#: From where the sphere of space is seen.
EYE = np.array([0.8, -0.5, 0.5])
#: Four lines that swing more often than this in one panel cannot be told apart.
SWINGS = 40


def missing(dataset: Dataset) -> str | None:
    """Why this figure cannot be drawn, in a sentence; None if it can."""
    if "attitude" not in dataset:
        return 'no attitude: add "attitude" to run.outputs'
    return "the attitude is drawn in three dimensions only" if "quaternion" not in dataset["attitude"].dims else None


def draw(dataset: Dataset) -> Picture:
    """One ball: its axes on the sphere of space and its quaternion; several: their quaternions."""
    quaternions = continued(reading.values(dataset, "attitude"))
    names = [f"$q_{i}$" for i in range(4)]
    if len(quaternions) > 1:
        return components.draw(
            dataset, quaternions if len(quaternions) <= FEW else _signed(quaternions), names, "q", ""
        )
    figure = empty(7.2)
    above, below = figure.subplots(2, 1, height_ratios=[1.75, 1.0])
    entitle(figure, str(dataset.attrs.get("title", "")))
    t, label = reading.clock(dataset)
    one = quaternions[0][np.isfinite(quaternions[0]).all(axis=-1)]
    view = View.towards_eye(EYE)
    draw_globe(above, view, ("x", "y", "z"))
    shown = len(t)
    for i in range(3):
        path = kernels.rotate(one, np.broadcast_to(np.eye(3)[i], (len(one), 3)))
        part = draw_orbit(above, view, path, COLOURS[i], most=VERTICES // 3, longest=LONGEST / 5)
        shown = min(shown, part if part < len(path) else shown)
        above.plot([], [], "o", color=COLOURS[i], markersize=5, label=f"body axis {i + 1}")
    told = "body axes in space (ring: start, square: end)"
    above.set_title("\n".join(filter(None, (told, reading.of_span(dataset, shown)))))
    above.legend(loc="upper center", bbox_to_anchor=(0.5, 0.02), ncols=3, columnspacing=1.0)
    points, whole = curves.too_far(dataset), quaternions[0]
    part = len(t) if points or not any(series.swings(y) > SWINGS for y in whole.T) else series.start(whole)
    for i in range(4):
        series.line(below, t[:part], whole[:part, i], ("#000000", *COLOURS)[i], names[i], points=points)
    below.set(xlabel=label, ylabel="quaternion", ylim=(-1.05, 1.05))
    if part < len(t):
        below.set_title(f"its start, {reading.span(t[:part], label)} of {reading.span(t, label)}", fontsize=10)
    legend(figure, [below])
    return figure


def continued(quaternions: Floats) -> Floats:
    """Quaternions (balls, frames, 4) with the sign that is nearer to the frame before: q and -q are one attitude."""
    turns = np.sign((quaternions[:, 1:] * quaternions[:, :-1]).sum(axis=-1))
    signs = np.cumprod(np.where(turns < 0, -1.0, 1.0), axis=1)
    return np.concatenate([quaternions[:, :1], quaternions[:, 1:] * signs[..., np.newaxis]], axis=1)


def _signed(quaternions: Floats) -> Floats:
    """All balls with q₀ ≥ 0 at the start."""
    return quaternions * np.where(quaternions[:, :1, :1] < 0, -1.0, 1.0)
