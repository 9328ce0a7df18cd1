"""Values over time: the angular velocity, the attitude, the energy, the integrals, and the spread of balls."""

import re
from itertools import cycle

import numpy as np
from matplotlib.axes import Axes
from xarray import Dataset

from chapsym.dynamics import kernels
from chapsym.dynamics.ball import Floats
from chapsym.dynamics.interpolation import continued

from ..drawing import curves, reading, series
from ..drawing.invariant import unit
from ..drawing.sphere import EYE, LONGEST, View, draw_globe, draw_orbit
from ..drawing.style import COLOURS, FEW, VERTICES, Picture, add_note, at_least, in_power, legend, new, power

#: The largest change, relative to the largest component, that is drawn flat.
FLAT = 1e-3
#: The largest number of oscillations of four lines that can be distinguished in one panel.
SWINGS = 40
#: The least range of an axis for constants, in ulps of the value, so that changes of the last digit look small.
ULPS = 20
ULP = float(np.finfo(np.float64).eps)
#: The outputs with a single integral, and their names in "integrals", which contains all of them.
OF_ONE = {"vertical_momentum": "K.gamma", "momentum_squared": "K.K", "gamma_squared": "gamma.gamma"}
SYMBOLS = {
    "K.gamma": r"$\langle\mathcal{K},\gamma\rangle$",
    "K.K": r"$\langle\mathcal{K},\mathcal{K}\rangle$",
    "gamma.gamma": r"$\langle\gamma,\gamma\rangle$",
}
#: A spread that grows by more than this factor after a tenth of the run has a logarithmic axis.
LOGARITHMIC = 30.0
#: Distances below this fraction of the largest are roundoff.
ROUNDOFF = 1e-12
SPREAD = ((5, 95, 0.18, "5 to 95 %"), (25, 75, 0.3, "25 to 75 %"))


def draw_omega(dataset: Dataset) -> Picture:
    """The components of ω; in n dimensions those of the skew matrix above the diagonal."""
    omega, names = reading.values(dataset, "omega"), [r"$\omega_1$", r"$\omega_2$", r"$\omega_3$"]
    if omega.ndim == 4:
        rows, columns = np.triu_indices(omega.shape[-1], 1)
        omega = omega[..., rows, columns]
        names = [rf"$\omega_{{{i + 1}{j + 1}}}$" for i, j in zip(rows, columns, strict=True)]
    units = reading.readable(dataset["omega"].attrs.get("units", ""))
    return _components(dataset, omega, names, r"$\omega$", units)


def _components(dataset: Dataset, array: Floats, names: list[str], symbol: str, units: str) -> Picture:
    """array (balls, frames, components): one panel with all components of one ball, else a panel for each.

    If those of one ball oscillate so often that they would be striped blocks: their ranges, and a panel with the first
    oscillations.
    """
    t, label = reading.clock(dataset)
    factor, text = power(reading.size_of(array))
    array, points, few = array / factor, curves.too_far(dataset), len(array) <= FEW
    if len(array) == 1:
        crowded = not points and any(series.swings(y) > series.SWINGS for y in array[0].T)
        part = series.start(array[0]) if crowded else 0
        figure, axes = new(reading.title(dataset), 2 if part else 1, height=2.6 if part else 3.3, sharex=not part)
        for k, name in enumerate(names):
            colour = COLOURS[k % len(COLOURS)]
            series.line(axes[0], t, array[0, :, k], colour, name, points=points)
            if part:
                axes[1].plot(t[:part], array[0, :part, k], color=colour)
        if part:
            axes[0].set_title("above, the range of each in the whole run; below, its start", fontsize=10)
        symbols = [symbol] * len(axes)
    else:
        figure, axes = new(reading.title(dataset), len(names), height=1.9, sharex=True)
        for k, axis in enumerate(axes):
            caption = reading.labels(dataset) if k == 0 else [None] * FEW
            series.balls(axis, t, array[:, :, k], COLOURS[k % len(COLOURS)], caption, points=points)
        symbols = names
    for axis, name in zip(axes, symbols, strict=True):
        axis.set_ylabel(in_power(name, units, text))
        at_least(axis, FLAT * max(map(abs, axis.get_ylim())))
    axes[-1].set_xlabel(label)
    if few:
        legend(figure, axes)
    else:
        add_note(figure, "median of the balls; bands: 50 %, 90 %, all")
        if count := int(reading.stopped(dataset).sum()):
            add_note(figure, f"without the {count} of {len(array)} balls that stopped early, after they stopped")
    return figure


def draw_slip(dataset: Dataset) -> Picture:
    """|v - ρ ω × e₃|, the speed of the contact point of the body: 0 for a ball that rolls."""
    return _components(dataset, reading.values(dataset, "slip")[..., None], ["slip"], "slip", reading.readable("m s-1"))


def draw_attitude(dataset: Dataset) -> Picture:
    """One ball: its axes on the sphere of space and its quaternion; several: their quaternions."""
    quaternions = continued(reading.values(dataset, "attitude"))
    names = [f"$q_{i}$" for i in range(4)]
    if len(quaternions) > FEW:  # all balls have q₀ ≥ 0 at the start
        quaternions = quaternions * np.where(quaternions[:, :1, :1] < 0, -1.0, 1.0)
    if len(quaternions) > 1:
        return _components(dataset, quaternions, names, "q", "")
    figure, (above, below) = new(reading.title(dataset), 2, height=3.425, height_ratios=[1.75, 1.0])
    t, label = reading.clock(dataset)
    whole = quaternions[0]
    there = whole[np.isfinite(whole).all(axis=-1)]
    view = View.towards_eye(EYE)
    draw_globe(above, view, ("x", "y", "z"))
    shown = len(t)
    for axis, colour in zip(np.eye(3), COLOURS, strict=False):
        path = kernels.rotate(there, np.broadcast_to(axis, (len(there), 3)))
        part = draw_orbit(above, view, path, colour, most=VERTICES // 3, longest=LONGEST / 5)
        shown = min(shown, part if part < len(path) else shown)
    for i in range(3):
        above.plot([], [], "o", color=COLOURS[i], markersize=5, label=f"body axis {i + 1}")
    caption = "body axes in space (ring: start, square: end)"
    above.set_title("\n".join(filter(None, (caption, reading.of_span(dataset, shown)))))
    above.legend(loc="upper center", bbox_to_anchor=(0.5, 0.02), ncols=3, columnspacing=1.0)
    points = curves.too_far(dataset)
    part = len(t) if points or not any(series.swings(y) > SWINGS for y in whole.T) else series.start(whole)
    for name, colour, y in zip(names, ("#000000", *COLOURS), whole.T, strict=False):
        series.line(below, t[:part], y[:part], colour, name, points=points)
    below.set(xlabel=label, ylabel="quaternion", ylim=(-1.05, 1.05))
    if part < len(t):
        below.set_title(f"its start, {reading.span(t[:part], label)} of {reading.span(t, label)}", fontsize=10)
    legend(figure, [below])
    return figure


def draw_energy(dataset: Dataset) -> Picture:
    """(E - E₀)/E₀; the map keeps the energy up to an oscillation, and for D = 0 to roundoff."""
    energy = reading.values(dataset, "energy")
    low, high = float(energy[:, 0].min()), float(energy[:, 0].max())
    caption = f"{low:.6g}" if low == high else f"{low:.4g} to {high:.4g}"
    changes = {"largest change of E": relative(energy, np.abs(energy[:, 0]))}
    return _changes(dataset, changes, f"kinetic energy, {caption} J at the start", 3.4)


def no_integrals(dataset: Dataset) -> str | None:
    """Why the integrals cannot be drawn, in a sentence; None if they can."""
    if "integrals" in dataset or any(name in dataset for name in OF_ONE):
        return None
    wanted = '"vertical_momentum" and "momentum_squared"' if dataset.sizes.get("axis", 3) == 3 else '"integrals"'
    return f"no integrals: add {wanted} to run.outputs"


def draw_integrals(dataset: Dataset) -> Picture:
    """The changes of the momentum integrals, which the map keeps: only roundoff."""
    found, names = stored(dataset)
    changes = dict(zip(map(_symbol, names), drifts(found, names), strict=True))
    return _changes(dataset, changes, "momentum integrals, and the largest change of each", 3.6)


def stored(dataset: Dataset) -> tuple[Floats, list[str]]:
    """The integrals in a result, (balls, frames, integrals), and their names."""
    if "integrals" not in dataset:
        some = [name for name in OF_ONE if name in dataset]
        return np.stack([reading.values(dataset, name) for name in some], axis=-1), [OF_ONE[name] for name in some]
    found = reading.values(dataset, "integrals")
    names = dataset["integral"].values if "integral" in dataset.coords else range(1, found.shape[-1] + 1)
    return found, [str(name) for name in names]


def _symbol(name: str) -> str:
    """A name of the result as mathematics: "tr K^2" is tr 𝒦²."""
    if name in SYMBOLS:
        return SYMBOLS[name]
    if not re.fullmatch(r"(tr |gamma\.)?K\^\d+(\.gamma)?", name):
        return reading.literal(name)
    for text, symbol in (("gamma", r"\gamma"), ("K", r"\mathcal{K}"), ("tr ", r"\mathrm{tr}\,"), (".", " ")):
        name = name.replace(text, symbol)
    return "$" + re.sub(r"(\d+)", r"{\1}", name) + "$"


def drifts(found: Floats, names: list[str]) -> list[Floats]:
    """The relative change of each of the named integrals, (balls, frames, integrals); a list of (balls, frames).

    Each is relative to its size at the start, except ⟨𝒦,γ⟩, which may vanish, relative to |𝒦||γ|.
    """
    sizes = dict(zip(names, np.abs(found[:, 0]).T, strict=True))
    if {"K.gamma", "K.K", "gamma.gamma"} <= sizes.keys():
        sizes["K.gamma"] = np.sqrt(sizes["K.K"] * sizes["gamma.gamma"])
    return [relative(found[..., i], size) for i, size in enumerate(sizes.values())]


def relative(quantity: Floats, size: Floats) -> Floats:
    """(x - x at the start)/size, (balls, frames), of x (balls, frames) and size (balls,); not divided if that is 0."""
    return np.asarray((quantity - quantity[:, :1]) / np.where(size > 0.0, size, 1.0)[:, np.newaxis])


def _changes(dataset: Dataset, changes: dict[str, Floats], title: str, height: float) -> Picture:
    """Relative changes (balls, frames) by name: lines for one ball, or a few if it is one change; bands for more.

    The axis spans 20 ulps at least: roundoff looks like roundoff.
    """
    figure, (axis,) = new(reading.title(dataset), height=height)
    t, label = reading.clock(dataset)
    points = curves.too_far(dataset)
    sizes = [reading.size_of(change) for change in changes.values()]
    largest, least = max(sizes, default=0.0), ULPS * ULP / 2
    factor, text = power(max(largest, least))
    for colour, (name, change), size in zip(cycle(COLOURS), changes.items(), sizes, strict=False):
        caption = f"{name}: " + (f"{size:.1e}".replace("e-0", "e-") if size else "0")
        if len(change) == 1:
            series.line(axis, t, change[0] / factor, colour, caption, points=points)
        elif len(changes) == 1 and len(change) <= FEW:
            series.balls(axis, t, change / factor, colour, reading.labels(dataset), points=points)
        else:
            series.fan(axis, t, change / factor, colour, caption)
    if largest <= least:
        axis.set_ylim(-least / factor, least / factor)
    axis.axhline(0.0, color="0.6", linewidth=0.8, zorder=0.5)
    axis.set(xlabel=label, ylabel=f"relative change, {text}" if text else "relative change", title=title)
    legend(figure, [axis])
    return figure


def draw_spread(dataset: Dataset) -> Picture:
    """Percentiles of the distance from the mean contact point (m), and of the angle of γ from its mean (degrees)."""
    shown = [name for name in ("contact", "gamma") if name in dataset]
    figure, axes = new(reading.title(dataset), len(shown), height=2.8, sharex=True)
    t, label = reading.clock(dataset)
    some = series.instants(len(t))
    for axis, name, colour in zip(axes, shown, COLOURS, strict=False):
        points = reading.values(dataset, name)[:, some]
        if name == "contact":
            _spread(axis, t[some], _chord(points, mean(points)), colour, "distance from the mean", "m")
        else:
            half = np.minimum(_chord(points, unit(mean(points))) / 2.0, 1.0)
            _spread(axis, t[some], np.rad2deg(2.0 * np.arcsin(half)), colour, r"angle of $\gamma$ from its mean", "°")
    axes[-1].set_xlabel(label)
    legend(figure, axes[:1])
    return figure


def _spread(axis: Axes, t: Floats, far: Floats, colour: str, caption: str, unit: str) -> None:
    low, half = series.percentiles(far, (SPREAD[0][0], 50))
    going = half[np.isfinite(half)]
    # From a tenth of the run to its end the median grows by orders of magnitude, unlike linear growth.
    logarithmic = len(going) > 10 and going[-1] > LOGARITHMIC * going[len(going) // 10] > 0.0
    factor, text = (1.0, "") if logarithmic else power(float(np.nanmax(far, initial=0.0)))
    series.fan(axis, t, far / factor, colour, "median", SPREAD)
    if logarithmic:
        axis.set_yscale("log")
        seen = np.concatenate([low[1:], half[1:]])
        seen = seen[seen > ROUNDOFF * np.nanmax(far)]
        axis.set_ylim(bottom=0.5 * float(np.nanmin(seen, initial=going[-1])))
    else:
        axis.set_ylim(bottom=0.0)
    axis.set_ylabel(in_power(caption, unit, text))


def mean(points: Floats) -> Floats:
    """The mean over the balls that have not stopped, (frames, k), of points (balls, frames, k); NaN if all have."""
    there = np.isfinite(points).all(axis=-1, keepdims=True)
    with np.errstate(invalid="ignore"):
        return np.asarray(np.where(there, points, 0.0).sum(axis=0) / there.sum(axis=0))


def _chord(points: Floats, centre: Floats) -> Floats:
    """The distance of each ball from a point, (balls, frames)."""
    return np.asarray(np.sqrt(((points - centre) ** 2).sum(axis=-1)))
