"""The page of the extremes: the matrix of conditions and precisions as one HTML file that opens from disk."""

from collections.abc import Iterable, Mapping
from itertools import groupby
from pathlib import Path
from typing import Any

from chapsym.report.page import style, templates

from .judging import LEVELS

#: verdict: its sign, which reads without colour, and what it says.
VERDICTS = {
    "within": ("✓", "the error is within the promise; the number is that of correct digits"),
    "refused": ("–", "refused, with a sentence that says why"),
    "failed": ("✗", "wrong, or refused without a true reason"),
}
HERE = Path(__file__).parent
_LEVELS = {level.key: level for level in LEVELS}


def html(matrix: Mapping[str, Any], versions: Mapping[str, str], machine: str, date: str | None = None) -> str:
    """The whole page of the JSON object of `chapsym extremes`; the same input gives the same bytes."""
    found = templates(HERE)
    found.globals |= {"VERDICTS": VERDICTS, "shown": shown, "told": told, "heat": heat}
    said = {"matrix": matrix, "groups": groups(matrix), "versions": versions, "machine": machine, "date": date}
    return found.get_template("page.html").render(style=style(HERE / "page.css"), **said)


def groups(matrix: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Each group with its precisions and rows, a row with its cells by precision, and why cells are not within."""
    found = []
    for name, those in groupby(matrix["cells"], lambda cell: cell["group"]):
        cells = list(those)
        names = list(map(precision, cells))
        rows = [
            (title, {precision(c): c for c in row}) for title, row in groupby(cells, lambda cell: cell["condition"])
        ]
        precisions = [level.name for level in LEVELS if level.name in names]
        title = matrix["groups"][name]
        found.append({"name": name, "title": title, "precisions": precisions, "rows": rows, "reasons": reasons(cells)})
    return found


def precision(cell: Mapping[str, Any]) -> str:
    """What a reader calls the precision of a cell."""
    return _LEVELS[cell["rung"]].name


def reasons(cells: Iterable[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Why cells are not within: each sentence once, with the conditions and the precisions that it is about."""
    merged: dict[tuple[str, str], dict[str, list[str]]] = {}
    for cell in cells:
        if cell["verdict"] != "within":
            about = merged.setdefault((cell["verdict"], cell["reason"].removeprefix("step 0: ")), {})
            about.setdefault(cell["condition"], []).append(precision(cell))
    return [
        {"verdict": verdict, "reason": reason, "about": [(name, ", ".join(those)) for name, those in about.items()]}
        for (verdict, reason), about in merged.items()
    ]


def shown(cell: Mapping[str, Any]) -> str:
    """The text of a cell: its sign, and the correct digits if it is within, at most those of its numbers."""
    sign = VERDICTS[cell["verdict"]][0]
    if cell["verdict"] != "within":
        return sign
    digits = cell["digits"]
    return f"{sign} exact" if digits is None else f"{sign} {min(digits, _LEVELS[cell['rung']].digits):.1f}"


def told(cell: Mapping[str, Any]) -> str:
    """What a cell says when it is pointed at."""
    said = [f"{precision(cell)}: {cell['verdict']}"]
    if cell["ulps"] is not None:
        said.append(f"error {cell['ulps']:.3g} ulps of {cell['promised']:.3g} promised")
    if cell["condition_number"] is not None:
        said.append(f"condition number {cell['condition_number']:.3g}")
    return "; ".join([*said, *([cell["reason"]] if cell["reason"] else [])])


def heat(cell: Mapping[str, Any]) -> int:
    """How much of the promise is used up, in percent, from 12 on, so that a colour is seen."""
    share = cell["ulps"] / cell["promised"] if cell["ulps"] is not None and cell["promised"] else 0.0
    return round(12 + 48 * min(1.0, share) ** 0.5) if cell["verdict"] == "within" else 30
