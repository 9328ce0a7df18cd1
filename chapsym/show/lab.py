"""The page of `chapsym lab`: for each system a table of methods, and their energies as curves."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

from markupsafe import Markup

from chapsym.files import Data

from . import rendered

#: The columns of a table, with their widths as text.
COLUMNS = {
    "method": 9, "order": 6, "energy": 11, "oscillation": 11, "drift": 10, "constraint": 10, "places": 7, "returns": 9,
    "µs/step": 8,
}  # fmt: skip


def page(cells: Sequence[Data], titles: Mapping[str, str], constraints: Mapping[str, str]) -> str:
    """The page, as text; the cells are `chapsym.mechanics.Cell.data`, of each system a sentence on its constraints."""
    systems: dict[str, list[Data]] = {}
    for cell in cells:
        systems.setdefault(cell["system"], []).append(cell)
    said = {"titles": titles, "constraints": constraints, "columns": COLUMNS, "figures": figures, "verdicts": _verdicts}
    title = "Methods on mechanical systems"
    return rendered(Path(__file__).with_name("lab.html"), title=title, systems=systems, curves=_curves, **said)


def figures(cell: Data) -> list[str]:
    """The figures of a cell as text, in the order of COLUMNS without the method, then further ones, or "".

    - replaces missing figures, and those hidden by rounding.
    """

    def of(name: str, form: str) -> str:
        return "-" if cell[name] is None else format(cell[name], form)

    more = [f"{name}: {value:.1e}" for name, value in cell["integrals"].items()]
    if cell["halved"] is not None:
        less = f", {abs(cell['drift'] / cell['halved']):.1f} times less" if cell["drift"] and cell["halved"] else ""
        more.append(f"with half the step: {cell['halved']:+.1e}{less}")
    more += decided(cell)
    return [
        of("order", ".2f"),
        of("energy", ".6g"),
        of("oscillation", ".1e"),
        of("drift", "+.1e"),
        "proved 0" if cell["kept"] else of("constraint", ".1e"),
        of("places", ".1e") if cell["places"] else "-",
        of("returns", ".1e"),
        of("microseconds", ".2f"),
        "; ".join(more),
    ]


def decided(cell: Data) -> list[str]:
    """The proved properties of a cell, with its order; the false, with the power of the step; the undecided."""
    found: dict[str, list[str]] = {"proved": [], "false": [], "not decided": []}
    for name, one in cell.get("verdicts", {}).items():
        if one["verdict"] == "measured":
            found["not decided"].append(f"{name} ({one['said']})" if name == "order" else name)
        else:
            last = one["said"].rpartition(" ")[2]
            shown = one["said"] if one["verdict"] == "proved" else last if last.startswith("h^") else ""
            found[one["verdict"]].append(f"{name} {shown}".rstrip())
    return [f"{verdict}: {', '.join(of)}" for verdict, of in found.items() if of]


def _verdicts(cells: Sequence[Data]) -> list[str]:
    """The verdicts of methods, with the exact states where they are false."""
    lines = []
    for cell in cells:
        for name, one in cell.get("verdicts", {}).items():
            at = ", ".join(f"{x} = {v}" for x, v in one["point"].items())
            said = " ".join(filter(None, (one["verdict"], one["said"], at and f"from {at}")))
            lines.append(f"{cell['method']}: {name}: {said}")
    return lines


def _curves(cells: Sequence[Data]) -> Markup:
    """The change of the energy over time, on a scale that shows large and small ones; and the error against work."""
    from matplotlib.ticker import LogFormatterSciNotation

    from .drawing.style import COLOURS, legend, new, styled

    if not (drawn := [cell for cell in cells if not cell["failed"]]):
        return Markup()
    with styled():
        figure, (energy, error) = new("", columns=2, height=3.8, width=11)
        for cell, colour in zip(drawn, COLOURS, strict=False):
            first = cell["curve"][0][1]
            changes = [(t, abs(e - first)) for t, e in cell["curve"]]
            for axes, points, mark in ((energy, changes, ""), (error, cell["work"], ".")):
                if shown := [(x, y if y > 0 else math.nan) for x, y in points]:
                    axes.plot(*zip(*shown, strict=True), marker=mark, color=colour, label=cell["method"])
                if any(y > 0 for _, y in shown):  # otherwise there is no such scale
                    axes.set(yscale="log")
        energy.set(xlabel="time", ylabel="|energy - first|")
        error.set(xscale="log", xlabel="µs of processor time", ylabel="error of the place")
        error.xaxis.set_minor_formatter(LogFormatterSciNotation(minor_thresholds=(1, 0.4)))  # otherwise they overlap
        legend(figure, [energy, error])
    return Markup(figure.svg())
