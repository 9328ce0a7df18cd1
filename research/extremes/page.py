"""The matrix of conditions and precisions as tables, and as one HTML file that opens from disk."""

from collections.abc import Mapping, Sequence
from itertools import groupby
from pathlib import Path

from chapsym.cli.measured import Table
from chapsym.files import Data

from .judging import LEVELS

#: verdict: its sign, which reads without colour, and what it says.
VERDICTS = {
    "within": ("✓", "the error is within the promise; the number is that of correct digits"),
    "refused": ("–", "refused, with a sentence that says why"),
    "failed": ("✗", "wrong, or refused without a true reason"),
}
HERE = Path(__file__).parent
_LEVELS = {level.key: level for level in LEVELS}


class Shown(str):
    """The text of a cell, with its verdict, and what it says when it is pointed at."""

    verdict: str
    details: str


def shown(cell: Data) -> Shown:
    """The sign of a cell, and the correct digits if it is within, at most those of its numbers."""
    level, (sign, _), digits = _LEVELS[cell["rung"]], VERDICTS[cell["verdict"]], cell["digits"]
    if cell["verdict"] == "within":
        sign += " exact" if digits is None else f" {min(digits, level.digits):.1f}"
    details = [f"{level.name}: {cell['verdict']}"]
    if cell["ulps"] is not None:
        details.append(f"error {cell['ulps']:.3g} ulps of {cell['promised']:.3g} promised")
    if cell["condition_number"] is not None:
        details.append(f"condition number {cell['condition_number']:.3g}")
    found = Shown(sign)
    found.verdict, found.details = cell["verdict"], "; ".join(filter(None, [*details, cell["reason"]]))
    return found


def about(matrix: Data) -> str:
    """The meanings of the cells, and the number of each."""
    signs = "; ".join(f"{sign} {verdict}: {meaning}" for verdict, (sign, meaning) in VERDICTS.items())
    counted = ", ".join(f"{count} {verdict}" for verdict, count in matrix["counts"].items())
    return (
        "Every precision level under hard conditions, against references that share no formula with what they judge. "
        f"{sum(matrix['counts'].values())} cells: {counted}. {signs[0].upper()}{signs[1:]}."
    )


def tables(matrix: Data) -> list[Table]:
    """A table for each group of conditions, with the sentences of what is not within."""
    found = []
    for name, those in groupby(matrix["cells"], lambda cell: cell["group"]):
        cells = list(those)
        there = {cell["rung"] for cell in cells}
        none = {level.name: "·" for level in LEVELS if level.key in there}
        rows = [
            {"condition": condition, **none, **{_LEVELS[cell["rung"]].name: shown(cell) for cell in row}}
            for condition, row in groupby(cells, lambda cell: cell["condition"])
        ]
        found.append(Table(f"{name}: {matrix['groups'][name]}", rows, reasons(cells)))
    return found


def reasons(cells: Sequence[Data]) -> list[str]:
    """Why cells are not within: each sentence once, with the conditions and the precisions that it is about."""
    merged: dict[tuple[str, str], dict[str, list[str]]] = {}
    for cell in cells:
        if cell["verdict"] != "within":
            of = merged.setdefault((cell["verdict"], cell["reason"].removeprefix("step 0: ")), {})
            of.setdefault(cell["condition"], []).append(_LEVELS[cell["rung"]].name)
    found = []
    for (verdict, reason), of in merged.items():
        named = "; ".join(f"{condition} ({', '.join(those)})" for condition, those in of.items())
        found.append(f"{VERDICTS[verdict][0]} {named}: {reason}")
    return found


def html(matrix: Data, versions: Mapping[str, str], machine: str) -> str:
    """The whole page of the JSON object of `chapsym extremes`; the same input gives the same bytes."""
    from chapsym.report.page import style, templates

    said = {"about": about(matrix), "tables": tables(matrix), "versions": versions, "machine": machine}
    return templates(HERE).get_template("page.html").render(style=style(HERE / "page.css"), **said)
