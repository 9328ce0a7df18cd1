"""chapsym extremes: where each precision breaks."""

from pathlib import Path
from typing import Annotated, Any

import typer

from . import measured
from .app import app
from .options import Json
from .output import check_known, console_for, fail, print_json, progress_bar

#: How the signs of the verdicts look on a terminal; they read without colour.
COLOURS = {"✓": "green", "–": "cyan", "✗": "bold red"}


@app.command()
def extremes(
    groups: Annotated[
        list[str] | None, typer.Argument(metavar="[GROUP]...", help="Groups of conditions; all by default.")
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help="Short runs and small batches.")] = False,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="PAGE", help="A page: .html, that opens from disk, or .md.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Judge every precision at the extremes: tiny momenta, folds, rotations by π, D up to 1e15, odd bodies and arrays.

    Exit status 1 if a cell failed: wrong, or refused without a true reason.  It needs a checkout of chapsym.

    Example: chapsym extremes --quick -o extremes.html
    """
    from chapsym import extras, files
    from chapsym.studies.harness import in_checkout

    study = in_checkout("research", "extremes")
    wanted = list(dict.fromkeys(groups or study.GROUPS))
    check_known("group", wanted, study.GROUPS)
    if output is not None:
        if not measured.is_page(output) and output.suffix != ".html":
            fail(f"{str(output)!r}: the page must end in .html or .md", 2)
        files.check_destination(output)
    if output is not None or not as_json:
        extras.need("report")
    with progress_bar("judging", study.rows(wanted)) as shown:
        cells = study.extremes(quick, groups=wanted, on_row=shown)
    matrix = study.as_json(cells, quick)
    if output is not None and output.suffix == ".md":
        measured.write(output, "At the extremes", _about(matrix["counts"]), _tables(matrix))
    elif output is not None:
        text = _page(matrix)
        files.write_whole(output, lambda stream: stream.write(text.encode()))
    if as_json:
        print_json(matrix)
    else:
        _print_matrix(matrix)
        if output is not None:
            print(f"wrote {output}")
    if failed := matrix["counts"]["failed"]:
        fail(f"{failed} of {len(cells)} cells failed", 1)


def _reader() -> Any:
    """What shows the matrix to a reader."""
    from chapsym.studies.harness import in_checkout

    return in_checkout("research", "extremes.page")


def _page(matrix: dict[str, Any]) -> str:
    from chapsym.studies import harness

    machine = harness.machine()
    return _reader().html(
        matrix, machine["versions"], f"{machine['cpu']}, {machine['cores']} cores, {machine['python']}"
    )


def _about(counts: dict[str, int]) -> str:
    """What the cells of the tables say."""
    page = _reader()
    signs = "; ".join(f"{sign} {verdict}: {meaning}" for verdict, (sign, meaning) in page.VERDICTS.items())
    told = ", ".join(f"{count} {verdict}" for verdict, count in counts.items())
    return (
        "Every precision level under hard conditions, against references that share no formula with what they judge. "
        f"{sum(counts.values())} cells: {told}. {signs[0].upper()}{signs[1:]}."
    )


def _tables(matrix: dict[str, Any]) -> list[measured.Table]:
    """A table for each group of conditions, with the sentences of what was refused."""
    page = _reader()
    return [
        measured.Table(
            f"{group['name']}: {group['title']}",
            [
                {
                    "condition": condition,
                    **{r: page.shown(cells[r]) if r in cells else "·" for r in group["precisions"]},
                }
                for condition, cells in group["rows"]
            ],
            [
                f"{page.VERDICTS[one['verdict']][0]} "
                + "; ".join(f"{condition} ({levels})" for condition, levels in one["about"])
                + f": {one['reason']}"
                for one in group["reasons"]
            ],
        )
        for group in page.groups(matrix)
    ]


def _print_matrix(matrix: dict[str, Any]) -> None:
    from rich.text import Text

    page, console = _reader(), console_for(120)
    measured.show(console, _tables(matrix), lambda cell: Text(cell, COLOURS.get(cell[:1], "")))
    for verdict, (sign, meaning) in page.VERDICTS.items():
        console.print(f"{sign} {verdict}: {meaning}")
    console.print(", ".join(f"{count} {verdict}" for verdict, count in matrix["counts"].items()))
