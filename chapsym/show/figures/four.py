"""Four dimensions on paper: so(4) = so(3) + so(3) has two spheres, S³ and the hyperplane are seen in pairs of axes."""

from itertools import combinations

import numpy as np
from matplotlib.axes import Axes
from xarray import Dataset

from chapsym.dynamics.ball import Floats

from ..drawing import reading, traces
from ..drawing.invariant import unit
from ..drawing.sphere import View, draw_globe, draw_orbit
from ..drawing.style import COLOURS, FEW, VERTICES, Picture, empty, entitle, in_power, new, power


def halves(momentum: Floats) -> tuple[Floats, Floats]:
    """The self-dual and the anti-self-dual part of skew matrices (..., 4, 4), (..., 3) each.

    The map turns 𝒦 into Ωᵀ𝒦Ω, which turns each part by a rotation of its own: it keeps |𝒦₊| and |𝒦₋|.
    """
    first = np.stack([momentum[..., 2, 1], momentum[..., 0, 2], momentum[..., 1, 0]], axis=-1)
    last = np.stack([momentum[..., 3, 0], momentum[..., 3, 1], momentum[..., 3, 2]], axis=-1)
    return first + last, first - last


def draw(dataset: Dataset) -> Picture:
    """𝒦₊/|𝒦₊| and 𝒦₋/|𝒦₋| on their spheres, and γ in two planes."""
    shown: list[tuple[str, Floats]] = []
    if "momentum" in dataset:
        for sign, part in zip("+-", halves(reading.values(dataset, "momentum")), strict=True):
            if np.nan_to_num(part).any():
                shown.append((rf"$\mathcal{{K}}_{sign}/|\mathcal{{K}}_{sign}|$", unit(part)))
    gamma = reading.values(dataset, "gamma") if "gamma" in dataset else None
    planes = [(0, 1), (2, 3)] if gamma is not None else []
    count = len(shown) + len(planes)
    figure = empty(2.9 * -(-count // 2) + 0.35)
    entitle(figure, str(dataset.attrs.get("title", "")))
    # A row of its own each: the labels of the planes would make the spheres different in size.
    rows = figure.subfigures(-(-count // 2), 1, squeeze=False).flat
    axes = [axis for row in rows for axis in row.subplots(1, 2)]
    for axis, (name, points) in zip(axes, shown, strict=False):
        view = View.of(points[np.isfinite(points).all(axis=-1)])
        draw_globe(axis, view, ("1", "2", "3"))
        for i, orbit in enumerate(_some(dataset, points)):
            draw_orbit(axis, view, orbit, COLOURS[i % len(COLOURS)], most=VERTICES // min(len(points), FEW))
        axis.set_title(name)
    for axis, (a, b) in zip(axes[len(shown) :], planes, strict=False):
        assert gamma is not None
        _plane(axis, dataset, gamma, a, b)
    for axis in axes[count:]:
        axis.set_visible(False)
    return figure


def _some(dataset: Dataset, points: Floats) -> list[Floats]:
    """The first balls, each up to its last frame."""
    last = reading.last_frames(dataset)
    return [one[: last[i] + 1] for i, one in enumerate(points[:FEW])]


def _plane(axis: Axes, dataset: Dataset, gamma: Floats, a: int, b: int) -> None:
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    axis.plot(np.cos(turn), np.sin(turn), color="0.6", linewidth=0.9)
    for i, orbit in enumerate(_some(dataset, gamma)):
        axis.plot(orbit[:, a], orbit[:, b], ".", markersize=2, color=COLOURS[i], rasterized=len(orbit) > VERTICES // 6)
        for end, face in ((0, "white"), (-1, COLOURS[i])):
            axis.plot(
                *orbit[end, [a, b]], "o" if end == 0 else "s", color=COLOURS[i], markerfacecolor=face, markersize=6
            )
    axis.set_aspect("equal")
    axis.set(xlim=(-1.1, 1.1), ylim=(-1.1, 1.1), xlabel=rf"$\gamma_{a + 1}$", ylabel=rf"$\gamma_{b + 1}$")


def draw_pairs(dataset: Dataset, trace: Floats) -> Picture:
    """The contact point in a hyperplane, (balls, frames, n - 1): a panel for each pair of the first three axes."""
    factor, text = power(float(np.nanmax(np.abs(trace), initial=0.0)))
    names = ["$x_1$", "$x_2$", "$x_3$"]
    figure, axes = new(str(dataset.attrs.get("title", "")), 2, 2, height=2.9)
    pairs = list(combinations(range(3), 2))
    for axis, (a, b) in zip(axes, pairs, strict=False):
        traces.lines(
            axis, dataset.isel(ball=slice(0, FEW)), trace[:FEW][..., [a, b]] / factor, legend=(a, b) == pairs[0]
        )
        axis.set_aspect("equal", adjustable="datalim")
        axis.set(xlabel=in_power(names[a], "m", text), ylabel=in_power(names[b], "m", text))
    axes[3].set_axis_off()
    axes[3].legend(*axes[0].get_legend_handles_labels(), loc="center")
    return figure
