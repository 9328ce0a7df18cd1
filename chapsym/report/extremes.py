"""The page of the extremes: the matrix of conditions and precisions as one HTML file that opens from disk."""

from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any

from markupsafe import Markup

from chapsym.renamed import in_words

from .page import FOLDER, prose, templates

#: verdict: its sign, which reads without colour, and what it says.
VERDICTS = {
    "within": ("✓", "the error is within the promise; the number is that of correct digits"),
    "refused": ("–", "refused, with a sentence that says why"),
    "failed": ("✗", "wrong, or refused without a true reason"),
}
#: Decimal digits of the precisions: no more are counted.
MOST_DIGITS = {"single": 7.2, "double": 16.0, "quad": 31.3, "Digits(50)": 50.0, "Ball(200)": 60.2}


def html(matrix: Mapping[str, Any], versions: Mapping[str, str], machine: str, date: str | None = None) -> str:
    """The whole page of the JSON object of `chapsym extremes`; the same input gives the same bytes."""
    found = templates()
    found.globals |= {"in_words": in_words, "VERDICTS": VERDICTS, "shown": shown, "told": told, "heat": heat}
    found.filters["prose"] = prose
    style = "".join((FOLDER / name).read_text(encoding="utf-8") for name in ("style.css", "extremes.css"))
    return found.get_template("extremes.html").render(
        style=Markup(style), matrix=matrix, groups=groups(matrix), versions=versions, machine=machine, date=date
    )


def groups(matrix: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Each group with its precisions and rows, a row with its cells by precision, and why cells are not within."""
    found = []
    for name, those in groupby(matrix["cells"], lambda cell: cell["group"]):
        cells = list(those)
        rows = [(title, {c["rung"]: c for c in row}) for title, row in groupby(cells, lambda cell: cell["condition"])]
        precisions = [precision for precision in matrix["rungs"] if any(cell["rung"] == precision for cell in cells)]
        title = matrix["groups"][name]
        found.append({"name": name, "title": title, "precisions": precisions, "rows": rows, "reasons": reasons(cells)})
    return found


def reasons(cells: Sequence[Mapping[str, Any]]) -> list[dict[str, Any]]:
    """Why cells are not within: each sentence once, with the conditions and the precisions that it is about."""
    merged: dict[tuple[str, str], dict[str, list[str]]] = {}
    for cell in cells:
        if cell["verdict"] != "within":
            about = merged.setdefault((cell["verdict"], cell["reason"].removeprefix("step 0: ")), {})
            about.setdefault(cell["condition"], []).append(cell["rung"])
    return [
        {
            "verdict": verdict,
            "reason": reason,
            "about": [(name, ", ".join(precisions)) for name, precisions in about.items()],
        }
        for (verdict, reason), about in merged.items()
    ]


def shown(cell: Mapping[str, Any]) -> str:
    """The text of a cell: its sign, and the correct digits if it is within."""
    sign = VERDICTS[cell["verdict"]][0]
    if cell["verdict"] != "within":
        return sign
    if cell["digits"] is None:
        return f"{sign} exact"
    return f"{sign} {min(cell['digits'], MOST_DIGITS.get(cell['rung'], cell['digits'])):.1f}"


def told(cell: Mapping[str, Any]) -> str:
    """What a cell says when it is pointed at."""
    said = [f"{in_words(cell['rung'])}: {cell['verdict']}"]
    if cell["ulps"] is not None:
        said.append(f"error {cell['ulps']:.3g} ulps of {cell['promised']:.3g} promised")
    if cell["condition_number"] is not None:
        said.append(f"condition number {cell['condition_number']:.3g}")
    return "; ".join([*said, *([cell["reason"]] if cell["reason"] else [])])


def heat(cell: Mapping[str, Any]) -> int:
    """How much of the promise is used up, in percent, from 12 on, so that a colour is seen."""
    share = cell["ulps"] / cell["promised"] if cell["ulps"] is not None and cell["promised"] else 0.0
    return round(12 + 48 * min(1.0, share) ** 0.5) if cell["verdict"] == "within" else 30
