"""γ and 𝒦/|𝒦| on their spheres, with the invariant curve, or the forbidden region; in four dimensions 𝒦±."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from xarray import Dataset

from chapsym.dynamics import Ball, kernels
from chapsym.dynamics.ball import Floats, checked_before, largest_moment

from ..drawing import reading, series
from ..drawing.invariant import bodies_of, curve_through, energy_range, is_vertical, unit
from ..drawing.sphere import LONGEST, View, draw_curve, draw_globe, draw_orbit
from ..drawing.style import COLOURS, FEW, VERTICES, Picture, empty, entitle, legend, new, scale

NEEDS = ("gamma", "momentum")
TITLES = {"gamma": r"$\gamma$", "momentum": r"$\mathcal{K}/|\mathcal{K}|$"}
#: The pixels of the region that the integrals forbid, and the number of points of a cloud of many balls.
PIXELS, CLOUD = 240, 80_000
#: The number of frames of a cloud.
MOMENTS = 400
#: The factor of the length of the line of an orbit if two spheres share the width.
NARROW = 0.25


def missing(dataset: Dataset) -> str | None:
    """Why this figure cannot be drawn, in a sentence; None if it can."""
    if not (there := [name for name in NEEDS if name in dataset]):
        return 'no γ and no 𝒦: add "gamma" or "momentum" to run.outputs'
    if dataset[there[0]].sizes.get("axis", 3) != 3 or "row" in dataset.dims:
        return None if dataset.sizes.get("axis") == 4 else "spheres are drawn in three and four dimensions only"
    return None


def draw(dataset: Dataset) -> Picture:
    """One sphere each for γ and 𝒦/|𝒦|; a single one if 𝒦 is vertical, as both are then the same."""
    if "row" in dataset.dims or dataset.sizes.get("axis") == 4:
        return _in_four_dimensions(dataset)
    found = {name: reading.values(dataset, name) for name in NEEDS if name in dataset}
    t, label = reading.clock(dataset)
    many = dataset.sizes["ball"] > FEW
    if many:
        instants = series.instants(len(t), MOMENTS)
        some = series.instants(dataset.sizes["ball"], max(2, CLOUD // len(instants)))
        found, t = {name: array[np.ix_(some, instants)] for name, array in found.items()}, t[instants]
    if "gamma" in found and "momentum" in found and not np.nan_to_num(found["momentum"]).any():
        del found["momentum"]
    vertical = len(found) == 2 and is_vertical(found["momentum"], found["gamma"])
    shown = ["gamma"] if vertical else list(found)
    figure, axes = new(reading.title(dataset), 1, len(shown), height=5.2 if len(shown) == 1 else 3.3)
    colours: Any = scale(axes, t, label)(t) if many else None
    for axis, name in zip(axes, shown, strict=True):
        points, part = unit(found[name]) if name == "momentum" else found[name], len(reading.steps(dataset))
        if many:
            _cloud(axis, colours, points)
        else:
            part = _panel(axis, dataset, name, points, found, vertical, 1.0 if len(shown) == 1 else NARROW)
        title = r"$\gamma$, and $\mathcal{K} = h\gamma$" if vertical else TITLES[name]
        axis.set_title("\n".join(filter(None, (title, reading.of_span(dataset, part)))))
    legend(figure, axes)
    return figure


def _panel(
    axis: Axes, dataset: Dataset, name: str, points: Floats, found: dict[str, Floats], vertical: bool, share: float
) -> int:
    """The orbits of a few balls, with `share` of each as a line; returns the number of frames of the shortest line.

    This is the number of all frames if each line is whole.
    """
    view = View.of(points[np.isfinite(points).all(axis=-1)])
    draw_globe(axis, view, ("1", "2", "3"))
    last, names = reading.last_frames(dataset), reading.labels(dataset)
    bodies = bodies_of(dataset)
    alone = len(points) == 1
    if alone and bodies and len(found) == 2 and not vertical and bodies[0].D > 0.0:
        _forbidden(axis, view, bodies[0], found, name == "gamma")
    shortest = points.shape[1]
    for i, one in enumerate(points):
        orbit, colour = one[: last[i] + 1], COLOURS[i]
        if bodies and (vertical or (name == "momentum" and bodies[i].D == 0.0)):
            curve = curve_through(bodies[i], orbit, float(bodies[i].D) if vertical else 0.0)
            if curve is not None:
                draw_curve(axis, view, curve, "invariant curve")
        most, longest = VERTICES // len(points), LONGEST * share / len(points)
        part = draw_orbit(axis, view, orbit, colour, most=most, longest=longest)
        shortest = min(shortest, part if part < len(orbit) else shortest)
        if not alone:
            axis.plot([], [], "o", color=colour, markersize=5, label=names[i])
    if alone:
        axis.plot([], [], "o", color=COLOURS[0], markerfacecolor="white", label="start")
        axis.plot([], [], "s", color=COLOURS[0], label="end")
    return shortest


def _forbidden(axis: Axes, view: View, body: Ball, found: dict[str, Floats], of_gamma: bool) -> None:
    """Shades the region that |𝒦|, ⟨𝒦,γ⟩ and the energies of this run exclude."""
    there = np.isfinite(found["gamma"]).all(axis=-1)
    m, gamma = unit(body.to_principal(found["momentum"][there])), body.to_principal(found["gamma"][there])
    size = largest_moment(body.mass_tensor, body.D) or 1.0
    own = checked_before(body.mass_tensor / size, body.D / size)  # energies are compared with each other only
    energies = kernels.energy(m, gamma, own.mass_tensor, own.D)
    low, high = float(energies.min()), float(energies.max())
    inside, seen = view.disc(PIXELS)
    least, largest = energy_range(own, body.to_principal(seen), float(np.median((m * gamma).sum(-1))), of_gamma)
    image = np.zeros((PIXELS, PIXELS, 4))
    # The least and largest energies have the error of a parabola through samples: 1.6e-4 of the range was measured.
    slack = 1e-3 * (float(np.max(largest)) - float(np.min(least)))
    image[inside, 3] = 0.3 * ((least > high + slack) | (largest < low - slack))
    image[..., :3] = 0.35
    edge = 1.0 + 1.0 / (PIXELS - 1)  # of the pixels whose centres are at ±1
    axis.imshow(image, extent=(-edge, edge, -edge, edge), origin="lower", zorder=0.9, interpolation="bilinear")
    axis.set(xlim=(-1.22, 1.22), ylim=(-1.22, 1.22))
    if image[..., 3].any():
        axis.fill([], [], color="0.35", alpha=0.3, linewidth=0, label="not with these integrals")


def _cloud(axis: Axes, colours: Floats, points: Floats) -> None:
    """Many balls, (balls, frames, 3): points in the colour of their time, (frames, 4), rasterised."""
    there = np.isfinite(points).all(axis=-1)
    colours, points = np.broadcast_to(colours, (*there.shape, 4))[there], points[there]
    view = View.of(points)
    draw_globe(axis, view, ("1", "2", "3"))
    x, y, depth = view.project(points)
    for front in (False, True):
        seen = (depth >= 0.0) == front
        axis.scatter(
            x[seen], y[seen], c=colours[seen], s=1.5 if len(x) > 5000 else 4, linewidths=0,
            alpha=0.8 if front else 0.2, zorder=3 + front, rasterized=True,
        )  # fmt: skip


def halves(momentum: Floats) -> tuple[Floats, Floats]:
    """The self-dual and the anti-self-dual part of skew matrices (..., 4, 4), (..., 3) each: so(4) = so(3) + so(3).

    The map 𝒦 ↦ Ωᵀ𝒦Ω turns each part by its own rotation, so it keeps |𝒦₊| and |𝒦₋|.
    """
    first = np.stack([momentum[..., 2, 1], momentum[..., 0, 2], momentum[..., 1, 0]], axis=-1)
    last = np.stack([momentum[..., 3, 0], momentum[..., 3, 1], momentum[..., 3, 2]], axis=-1)
    return first + last, first - last


def _in_four_dimensions(dataset: Dataset) -> Picture:
    """𝒦₊/|𝒦₊| and 𝒦₋/|𝒦₋| on their spheres, and γ, which is on S³, in two planes; of the first balls."""
    ends = reading.last_frames(dataset) + 1
    shown: list[tuple[str, Floats]] = []
    if "momentum" in dataset:
        for sign, part in zip("+-", halves(reading.values(dataset, "momentum")), strict=True):
            if np.nan_to_num(part).any():
                shown.append((rf"$\mathcal{{K}}_{sign}/|\mathcal{{K}}_{sign}|$", unit(part)))
    planes = [(0, 1), (2, 3)] if "gamma" in dataset else []
    rows = -(-(len(shown) + len(planes)) // 2)
    figure = empty(2.9 * rows + 0.35)
    entitle(figure, reading.title(dataset))
    # Each has its own row, as the labels of the planes would change the sizes of the spheres.
    axes = [axis for row in figure.subfigures(rows, 1, squeeze=False).flat for axis in row.subplots(1, 2)]
    for axis, (name, points) in zip(axes, shown, strict=False):
        view = View.of(points[np.isfinite(points).all(axis=-1)])
        draw_globe(axis, view, ("1", "2", "3"))
        for orbit, end, colour in zip(points[:FEW], ends, COLOURS, strict=False):
            draw_orbit(axis, view, orbit[:end], colour, most=VERTICES // min(len(points), FEW))
        axis.set_title(name)
    for axis, (a, b) in zip(axes[len(shown) :], planes, strict=False):
        turn = np.linspace(0.0, 2.0 * np.pi, 181)
        axis.plot(np.cos(turn), np.sin(turn), color="0.6", linewidth=0.9)
        for orbit, end, colour in zip(reading.values(dataset, "gamma")[:FEW], ends, COLOURS, strict=False):
            x, y = orbit[:end, [a, b]].T
            axis.plot(x, y, ".", markersize=2, color=colour, rasterized=end > VERTICES // FEW)
            axis.plot(x[0], y[0], "o", color=colour, markerfacecolor="white", markersize=6)
            axis.plot(x[-1], y[-1], "s", color=colour, markersize=6)
        axis.set_aspect("equal")
        axis.set(xlim=(-1.1, 1.1), ylim=(-1.1, 1.1), xlabel=rf"$\gamma_{a + 1}$", ylabel=rf"$\gamma_{b + 1}$")
    for axis in axes[len(shown) + len(planes) :]:
        axis.set_visible(False)
    return figure
