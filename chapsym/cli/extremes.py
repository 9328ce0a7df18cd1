"""chapsym extremes: where each precision breaks."""

from pathlib import Path
from typing import Annotated, Any

import typer

from . import measured
from .app import app
from .options import Json, argument, writes
from .output import check_known, console_for, fail, print_json, progress_bar

#: How the signs of the verdicts look on a terminal; they read without colour.
COLOURS = {"✓": "green", "–": "cyan", "✗": "bold red"}


@app.command()
def extremes(
    groups: Annotated[list[str] | None, argument("[GROUP]...", "Groups of conditions; all by default.")] = None,
    quick: Annotated[bool, typer.Option("--quick", help="Short runs and small batches.")] = False,
    output: Annotated[Path | None, writes("PAGE", "A page: .html, that opens from disk, or .md.")] = None,
    as_json: Json = False,
) -> None:
    """Judge every precision at the extremes: tiny momenta, folds, rotations by π, D up to 1e15, odd bodies.

    Exit status 1 if a cell failed: wrong, or refused without a true reason.  It needs a checkout of chapsym.

    Example: chapsym extremes --quick -o extremes.html
    """
    from chapsym import extras, files
    from chapsym.studies.checkout import in_checkout, machine

    study = in_checkout("research", "extremes")
    wanted = list(dict.fromkeys(groups or study.GROUPS))
    check_known("group", wanted, study.GROUPS)
    if output is not None:
        if not measured.is_page(output) and output.suffix != ".html":
            fail(f"{str(output)!r}: the page must end in .html or .md", 2)
        files.check_destination(output)
    if output is not None or not as_json:
        extras.need("report")
    page = in_checkout("research", "extremes.page")
    with progress_bar("judging", study.rows(wanted)) as shown:
        cells = study.extremes(quick, groups=wanted, on_row=shown)
    matrix = study.as_json(cells, quick)
    if output is not None and output.suffix == ".md":
        measured.write(output, "At the extremes", page.about(matrix), page.tables(matrix))
    elif output is not None:
        here = machine()
        text = page.html(matrix, here["versions"], f"{here['cpu']}, {here['cores']} cores, {here['python']}")
        files.write_text(output, text)
    if as_json:
        print_json(matrix)
    else:
        _print_matrix(page, matrix)
        if output is not None:
            print(f"wrote {output}")
    if failed := matrix["counts"]["failed"]:
        fail(f"{failed} of {len(cells)} cells failed", 1)


def _print_matrix(page: Any, matrix: dict[str, Any]) -> None:
    from rich.text import Text

    console = console_for(120)
    measured.show(console, page.tables(matrix), lambda cell: Text(cell, COLOURS.get(cell[:1], "")))
    for verdict, (sign, meaning) in page.VERDICTS.items():
        console.print(f"{sign} {verdict}: {meaning}")
    console.print(", ".join(f"{count} {verdict}" for verdict, count in matrix["counts"].items()))
