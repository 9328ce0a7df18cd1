"""The figure: for each section, digits against the time of a simulated second; the frontier drawn through."""

import textwrap
from typing import Any

from matplotlib.lines import Line2D
from matplotlib.ticker import NullFormatter

from chapsym.renamed import in_words
from chapsym.show.drawing import style
from chapsym.show.drawing.style import Picture

from .frontier import Frontier, Point

#: A colour for each order, and a marker for each precision.
COLOURS = {order: style.COLOURS[i] for order, i in (("2", 0), ("4", 4), ("6", 2), ("8", 1), ("12", 3), ("24", 5))}
MARKERS = {
    "single": "v", "double": "o", "quad": "s", "digits30": "D", "digits50": "^", "digits100": "P", "ball100": "*",
    "ball300": "X",
}  # fmt: skip
PANEL = (5.6, 4.2)  # inches


def draw(found: dict[str, Frontier]) -> Picture:
    """A figure with a panel for each section."""
    columns = min(2, len(found))
    rows = -(-len(found) // columns)
    figure, axes = style.new("", rows, columns, height=PANEL[1] + 0.9 / rows, width=PANEL[0] * columns)
    precisions = list(dict.fromkeys(_precision(p) for one in found.values() for p in one.points))
    markers = {precision: MARKERS.get(precision, "h") for precision in precisions}
    for axis, one in zip(axes, found.values(), strict=False):
        _panel(axis, one, markers)
    for axis in axes[len(found) :]:
        axis.set_visible(False)
    figure.legend(handles=_legend(found, markers), loc="outside lower center", ncols=6)
    return figure


def _panel(axis: Any, one: Frontier, markers: dict[str, str]) -> None:
    best = one.best
    for point in one.points:
        on = point in best
        axis.plot(
            point.digits, point.per_time * 1e6, marker=markers[_precision(point)], color=COLOURS[_order(point)],
            markersize=7 if on else 5, alpha=1.0 if on else 0.55, linestyle="none",
            markeredgecolor="black" if on else "none", markeredgewidth=0.8, zorder=3 if on else 2,
        )  # fmt: skip
    axis.step([p.digits for p in best], [p.per_time * 1e6 for p in best], where="pre", color="0.35", linewidth=1)
    axis.set(yscale="log", title=one.title, xlabel=_wrapped(one.question), ylabel="µs a unit of simulated time")
    axis.yaxis.set_minor_formatter(NullFormatter())


def _legend(found: dict[str, Frontier], markers: dict[str, str]) -> list[Any]:
    orders = sorted({_order(p) for one in found.values() for p in one.points}, key=int)
    shown = [Line2D([], [], color=COLOURS[o], marker="o", linestyle="none", label=f"order {o}") for o in orders]
    shown += [
        Line2D([], [], color="0.3", marker=m, linestyle="none", label=in_words(precision))
        for precision, m in markers.items()
    ]
    return [*shown, Line2D([], [], color="0.35", linewidth=1, label="frontier")]


def _precision(point: Point) -> str:
    return point.name.partition(",")[0]


def _order(point: Point) -> str:
    return point.name.split("order ")[1].split(",")[0]


def _wrapped(text: str) -> str:
    return "\n".join(textwrap.wrap(text.replace("𝒦", "K"), 56))
