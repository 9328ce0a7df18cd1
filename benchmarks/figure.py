"""The figure of what has curves: work and precision, and the drifts of long runs, on logarithmic scales."""

from matplotlib.axes import Axes

from chapsym.show.drawing.style import Picture, empty

from .results import Curve, Result

AXES = {"work-precision": ("µs a ball", "relative error"), "long": ("steps", "relative change")}
#: Chapsym's lines are drawn over the others and thicker.
OURS = "chapsym"
MARKERS = "osD^v<>Ph*X"
PANEL = 4.2  # inches


def draw(results: dict[str, Result]) -> Picture:
    """A figure with a row of panels for each section that has curves."""
    drawn = {name: panels(found) for name, found in results.items() if found.curves}
    columns = 3
    rows = {name: -(-len(found) // columns) for name, found in drawn.items()}
    figure = empty(PANEL * sum(rows.values()) + 0.6 * len(rows), PANEL * columns)
    parts = figure.subfigures(len(drawn), 1, height_ratios=list(rows.values()), squeeze=False)[:, 0]
    for part, (name, found) in zip(parts, drawn.items(), strict=True):
        part.suptitle(results[name].title)
        axes = list(part.subplots(rows[name], columns, squeeze=False).flat)
        for axis, (title, curves) in zip(axes, found.items(), strict=False):
            _panel(axis, title, curves, name)
        for axis in axes[len(found) :]:
            axis.set_visible(False)
        handles, labels = part.axes[0].get_legend_handles_labels()
        part.legend(handles, labels, loc="outside lower center", ncols=4)
    return figure


def panels(found: Result) -> dict[str, list[Curve]]:
    """The curves of a section by panel, in their order."""
    names = dict.fromkeys(curve.panel for curve in found.curves)
    return {name: [curve for curve in found.curves if curve.panel == name] for name in names}


def _panel(axis: Axes, title: str, curves: list[Curve], section: str) -> None:
    drawn = sorted(curves, key=lambda curve: not curve.label.startswith(OURS))
    colours = {name: f"C{i}" for i, name in enumerate(dict.fromkeys(map(_alone, drawn)))}
    for i, curve in enumerate(drawn):
        shown = [(x, y) for x, y in zip(curve.x, curve.y, strict=True) if y > 0]
        ours = curve.label.startswith(OURS)
        axis.plot(
            [x for x, _ in shown], [y for _, y in shown], label=curve.label, marker=MARKERS[i % len(MARKERS)],
            color=colours[_alone(curve)], linestyle="-" if _alone(curve) == curve.label else "--",
            markersize=4, linewidth=2.2 if ours else 1.0, zorder=3 if ours else 2,
        )  # fmt: skip
    if section == "long":
        ends = [curves[0].x[0], curves[0].x[-1]]
        axis.plot(ends, [0.65 * 2.0**-53 * x**0.5 for x in ends], "k:", linewidth=1, label="0.65·2⁻⁵³·√n", zorder=1)
    axis.set(xscale="log", yscale="log", title=title, xlabel=AXES[section][0], ylabel=AXES[section][1])


def _alone(curve: Curve) -> str:
    """The name of the method for one ball: its batch has the same colour, and dashes."""
    return curve.label.removesuffix(", batch")
