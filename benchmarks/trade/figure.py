"""The figure: for each section, digits against the time of a simulated second; the frontier drawn through."""

import textwrap

from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import NullFormatter

from chapsym.numbers import in_words
from chapsym.show.drawing import style
from chapsym.show.drawing.style import Picture

from .frontiers import Frontier, Point

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
    for axis, one in zip(axes, found.values(), strict=False):
        _panel(axis, one)
    for axis in axes[len(found) :]:
        axis.set_visible(False)
    ways = [_way(point) for one in found.values() for point in one.points]
    handles = [
        *(_sign(f"order {order}", COLOURS[order], "o") for order in sorted({order for _, order in ways}, key=int)),
        *(_sign(in_words(name), "0.3", MARKERS.get(name, "h")) for name in dict.fromkeys(name for name, _ in ways)),
        Line2D([], [], color="0.35", linewidth=1, label="frontier"),
    ]
    figure.legend(handles=handles, loc="outside lower center", ncols=6)
    return figure


def _panel(axis: Axes, one: Frontier) -> None:
    best = one.best
    for point in one.points:
        on, (precision, order) = point in best, _way(point)
        axis.plot(
            point.digits, point.per_time * 1e6, marker=MARKERS.get(precision, "h"), color=COLOURS[order],
            markersize=7 if on else 5, alpha=1.0 if on else 0.55, linestyle="none",
            markeredgecolor="black" if on else "none", markeredgewidth=0.8, zorder=3 if on else 2,
        )  # fmt: skip
    axis.step([p.digits for p in best], [p.per_time * 1e6 for p in best], where="pre", color="0.35", linewidth=1)
    question = textwrap.fill(one.question.replace("𝒦", "K"), 56)
    axis.set(yscale="log", title=one.title, xlabel=question, ylabel="µs a unit of simulated time")
    axis.yaxis.set_minor_formatter(NullFormatter())


def _sign(label: str, colour: str, marker: str) -> Line2D:
    return Line2D([], [], color=colour, marker=marker, linestyle="none", label=label)


def _way(point: Point) -> tuple[str, str]:
    """The precision and the order."""
    precision, _, order = point.name.partition(", order ")
    return precision, order
