"""The work of `chapsym extremes` and `chapsym study`: they measure, write and print."""

import json
from collections.abc import Sequence
from functools import partial
from importlib import import_module
from pathlib import Path
from types import ModuleType

from chapsym import extras, files
from chapsym.cli import measured
from chapsym.cli.output import SELDOM, check_known, console_for, fail, print_json, progress_bar, telling
from chapsym.studies.checkout import machine, save_figures

from . import units

#: How the signs of the verdicts look on a terminal; they read without colour.
COLOURS = {"✓": "green", "–": "cyan", "✗": "bold red"}


def extremes(groups: Sequence[str], quick: bool, output: Path | None, as_json: bool) -> None:
    """Judges the groups, all if none is named; fails where a cell failed."""
    from . import extremes as study

    wanted = list(dict.fromkeys(groups or study.GROUPS))
    check_known("group", wanted, study.GROUPS)
    if output is not None:
        if not measured.is_page(output) and output.suffix != ".html":
            fail(f"{str(output)!r}: the page must end in .html or .md", 2)
        files.check_destination(output)
    if output is not None or not as_json:
        extras.need("report")
    from .extremes import page

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


def _print_matrix(page: ModuleType, matrix: files.Data) -> None:
    from rich.text import Text

    console = console_for(120)
    measured.show(console, page.tables(matrix), lambda cell: Text(cell, COLOURS.get(cell[:1], "")))
    for verdict, (sign, meaning) in page.VERDICTS.items():
        console.print(f"{sign} {verdict}: {meaning}")
    console.print(", ".join(f"{count} {verdict}" for verdict, count in matrix["counts"].items()))


def study(name: str, quick: bool, output: Path | None, scheduler: str | None, as_json: bool) -> None:
    """Runs the study of that name; with an output also its data and figures, and what an unfinished one goes on with.

    A study is a package next to this file: study(quick, run), run as `units.run_units`, sentences(found), and DRAWN.
    """
    if output is not None:
        extras.need("figures")
    module = import_module(f".{name}", __package__)
    folder = None if output is None else files.made(output)
    kept = None if folder is None else folder / f"{name}.jsonl"
    with telling(SELDOM) as tell:  # units differ too much for an estimate of the time that is left
        run = partial(
            units.run_units, path=kept, scheduler=scheduler, report=lambda n, of: tell(f"{name}: {n} of {of}")
        )
        found = module.study(quick, run)
    written = list[Path]()
    if folder is not None:
        written = [folder / f"{name}.json"]
        files.write_text(written[0], json.dumps(found, ensure_ascii=False, allow_nan=False, indent=1) + "\n")
        written += save_figures(module.__name__, module.DRAWN, found, folder)
    if as_json:
        print_json(found)
        return
    for sentence in module.sentences(found):
        print(sentence)
    for path in written:
        print(f"wrote {path}")
