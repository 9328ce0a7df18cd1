"""γ and 𝒦/|𝒦| on their spheres, with the invariant curve, or what the integrals forbid."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from xarray import Dataset

from chapsym.dynamics import kernels
from chapsym.dynamics.ball import Floats

from ..drawing import reading
from ..drawing.invariant import Body, bodies_of, curve_through, energy_range, is_vertical, unit
from ..drawing.sphere import LONGEST, View, draw_curve, draw_globe, draw_orbit
from ..drawing.style import COLOURS, FEW, MAP, VERTICES, Picture, legend, new
from . import four

NEEDS = ("gamma", "momentum")
TITLES = {"gamma": r"$\gamma$", "momentum": r"$\mathcal{K}/|\mathcal{K}|$"}
#: Pixels of the region that the integrals forbid, and points of a cloud of many balls.
PIXELS, CLOUD = 240, 80_000
#: The frames of a cloud.
MOMENTS = 400
#: How much less of an orbit is drawn as a line where two spheres share the width.
NARROW = 0.25


def missing(dataset: Dataset) -> str | None:
    """Why this figure cannot be drawn, in a sentence; None if it can."""
    there = [name for name in NEEDS if name in dataset]
    if not there:
        return 'no γ and no 𝒦: add "gamma" or "momentum" to run.outputs'
    if dataset[there[0]].sizes.get("axis", 3) != 3 or "row" in dataset.dims:
        return None if dataset.sizes.get("axis") == 4 else "spheres are drawn in three and four dimensions only"
    return None


def draw(dataset: Dataset) -> Picture:
    """One sphere for each of γ and 𝒦/|𝒦|; one alone where 𝒦 is vertical, and they are the same."""
    if "row" in dataset.dims or dataset.sizes.get("axis") == 4:
        return four.draw(dataset)
    found = {name: reading.values(dataset, name) for name in NEEDS if name in dataset}
    t, _ = reading.clock(dataset)
    if len(next(iter(found.values()))) > FEW:
        balls, frames = _chosen(*next(iter(found.values())).shape[:2])
        found, t = {name: array[np.ix_(balls, frames)] for name, array in found.items()}, t[frames]
    title = str(dataset.attrs.get("title", ""))
    still = "momentum" in found and not np.nan_to_num(found["momentum"]).any()
    if still and "gamma" in found:
        del found["momentum"]
    vertical = len(found) == 2 and _all_vertical(found)
    shown = ["gamma"] if vertical else list(found)
    figure, axes = new(title, 1, len(shown), height=5.2 if len(shown) == 1 else 3.3)
    for axis, name in zip(axes, shown, strict=True):
        points = unit(found[name]) if name == "momentum" else found[name]
        if len(points) > FEW:
            _cloud(axis, t, points)
            part = len(t)
        else:
            longest = LONGEST / len(points) * (1.0 if len(shown) == 1 else NARROW)
            part = _panel(axis, dataset, name, points, found, vertical, longest)
        title = r"$\gamma$, and $\mathcal{K} = h\gamma$" if vertical else TITLES[name]
        axis.set_title("\n".join(filter(None, (title, reading.of_span(dataset, part)))))
    if len(found[shown[0]]) > FEW:
        _times(figure, axes, dataset)
    legend(figure, axes)
    return figure


def _all_vertical(found: dict[str, Floats]) -> bool:
    there = np.isfinite(found["gamma"]).all(axis=-1)
    return is_vertical(found["momentum"][there], found["gamma"][there])


def _panel(
    axis: Axes, dataset: Dataset, name: str, points: Floats, found: dict[str, Floats], vertical: bool, longest: float
) -> int:
    """The orbits of a few balls; how many frames the shortest of their lines shows, all of them if each is whole."""
    flat = points[np.isfinite(points).all(axis=-1)]
    view = View.of(flat)
    draw_globe(axis, view, ("1", "2", "3"))
    last, names = reading.last_frames(dataset), reading.labels(dataset)
    bodies = bodies_of(dataset)
    if len(points) == 1 and bodies and len(found) == 2 and not vertical and bodies[0].D > 0.0:
        _forbidden(axis, view, bodies[0], found, name == "gamma")
    shortest = points.shape[1]
    for i, one in enumerate(points):
        orbit, colour = one[: last[i] + 1], COLOURS[i]
        if bodies and (vertical or (name == "momentum" and bodies[i].D == 0.0)):
            curve = curve_through(bodies[i], orbit, bodies[i].D if vertical else 0.0)
            if curve is not None:
                draw_curve(axis, view, curve, "invariant curve")
        part = draw_orbit(axis, view, orbit, colour, most=VERTICES // len(points), longest=longest)
        shortest = min(shortest, part if part < len(orbit) else shortest)
        if len(points) > 1:
            axis.plot([], [], "o", color=colour, markersize=5, label=names[i])
    if len(points) == 1:
        axis.plot([], [], "o", color=COLOURS[0], markerfacecolor="white", label="start")
        axis.plot([], [], "s", color=COLOURS[0], label="end")
    return shortest


def _forbidden(axis: Axes, view: View, body: Body, found: dict[str, Floats], of_gamma: bool) -> None:
    """Greys out where |𝒦|, ⟨𝒦,γ⟩ and the energies of this run do not let the vector be."""
    there = np.isfinite(found["gamma"]).all(axis=-1)
    m, gamma = unit(body.principal(found["momentum"][there])), body.principal(found["gamma"][there])
    energies = kernels.energy(m, gamma, body.mass_tensor, np.float64(body.D))
    low, high = float(energies.min()), float(energies.max())
    side = np.linspace(-1.0, 1.0, PIXELS)
    x, y = np.meshgrid(side, side)
    inside = x * x + y * y < 1.0
    depth = np.sqrt(np.maximum(1.0 - x * x - y * y, 0.0))
    seen = x[..., np.newaxis] * view.right + y[..., np.newaxis] * view.up + depth[..., np.newaxis] * view.towards
    least, largest = energy_range(body, body.principal(seen[inside]), float(np.median((m * gamma).sum(-1))), of_gamma)
    image: Any = np.zeros((PIXELS, PIXELS, 4))
    # The least and largest energies have the error of a parabola through samples: 1.6e-4 of the range was measured.
    slack = 1e-3 * (float(np.max(largest)) - float(np.min(least)))
    image[inside, 3] = 0.3 * ((least > high + slack) | (largest < low - slack))
    image[..., :3] = 0.35
    edge = 1.0 + 1.0 / (PIXELS - 1)  # of the pixels whose centres are at ±1
    axis.imshow(image, extent=(-edge, edge, -edge, edge), origin="lower", zorder=0.9, interpolation="bilinear")
    axis.set(xlim=(-1.22, 1.22), ylim=(-1.22, 1.22))
    if image[..., 3].any():
        axis.fill([], [], color="0.35", alpha=0.3, linewidth=0, label="not with these integrals")


def _chosen(balls: int, frames: int) -> tuple[np.ndarray, np.ndarray]:
    """Which balls and frames a cloud of points shows: evenly, the first and the last among them."""
    instants = np.unique(np.linspace(0, frames - 1, min(frames, MOMENTS)).round().astype(int))
    some = np.unique(np.linspace(0, balls - 1, min(balls, max(2, CLOUD // len(instants)))).round().astype(int))
    return some, instants


def _cloud(axis: Axes, t: Floats, points: Floats) -> None:
    """Many balls: points in the colour of their time, rasterised."""
    when = np.broadcast_to(t, points.shape[:2])
    there = np.isfinite(points).all(axis=-1)
    view = View.of(points[there])
    draw_globe(axis, view, ("1", "2", "3"))
    x, y, depth = view.project(points[there])
    for front_side in (False, True):
        seen = depth >= 0.0 if front_side else depth < 0.0
        axis.scatter(
            x[seen], y[seen], c=when[there][seen], cmap=MAP, vmin=t[0], vmax=t[-1], s=1.5 if len(x) > 5000 else 4,
            linewidths=0, alpha=0.8 if front_side else 0.2, zorder=3 + front_side, rasterized=True,
        )  # fmt: skip


def _times(figure: Picture, axes: list[Axes], dataset: Dataset) -> None:
    t, label = reading.clock(dataset)
    mapped = ScalarMappable(Normalize(t[0], t[-1] if t[-1] > t[0] else t[0] + 1.0), MAP)
    figure.colorbar(mapped, ax=axes, location="bottom", aspect=40, pad=0.02, fraction=0.06, label=label)
