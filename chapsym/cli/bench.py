"""chapsym bench: what the map costs, beside what a user would take instead."""

import sys
from pathlib import Path
from typing import Annotated, Any

import typer

from .app import app
from .options import Json
from .output import fail, print_json

FORMATS = (".svg", ".png", ".pdf")


@app.command()
def bench(
    sections: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[SECTION]...", help="trajectory, batch, memory, plans, first-call, long, work-precision; or all."
        ),
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help="Smaller sizes and fewer rounds: seconds.")] = False,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FIGURE", help="A figure: .svg, .png or .pdf.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Measure speed, memory, drift and precision against other ways, all in one process, interleaved.

    A figure that is not reached is shown, and is no failure: times depend on the machine and on what else it does.

    Example: chapsym bench trajectory --quick
    """
    from chapsym import files
    from chapsym.studies import bench as study

    wanted = list(dict.fromkeys(sections or study.SECTIONS))
    for name in wanted:
        if name not in study.SECTIONS:
            fail(f"there is no section {name!r}; there are {', '.join(study.SECTIONS)}", 2)
    if output is not None:
        _check_figure(output, wanted)
    results = {}
    for name in wanted:
        try:
            results[name] = study.run(name, quick, _say)
        except study.NotComparable as error:
            fail(f"bench {name}: {error}", 1)
    if output is not None:
        try:
            _write_figure(output, results)
        except files.CannotWrite as error:
            fail(str(error), 2)
    measured = study.as_json(results, quick)
    if as_json:
        print_json(measured)
    else:
        _print_all(measured)


def _say(text: str) -> None:
    """Progress on standard error: one line that moves on a terminal, and nothing elsewhere."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)


def _check_figure(output: Path, wanted: list[str]) -> None:
    from chapsym import files
    from chapsym.studies.bench import figure, harness

    if output.suffix not in FORMATS:
        fail(f"{str(output)!r}: a figure must end in {', '.join(FORMATS)}", 2)
    if not set(wanted) & set(figure.AXES):
        fail(f"only {' and '.join(figure.AXES)} have a figure", 2)
    if reason := harness.installed("matplotlib"):
        fail(f"a figure needs matplotlib, and {reason}", 2)
    try:
        files.check_destination(output)
    except files.CannotWrite as error:
        fail(str(error), 2)


def _write_figure(output: Path, results: dict[str, Any]) -> None:
    from chapsym import files
    from chapsym.studies.bench import figure

    drawn = figure.draw(results)
    files.write_whole(output, lambda stream: drawn.savefig(stream, format=output.suffix[1:], dpi=120))


def _print_all(measured: dict[str, Any]) -> None:
    from rich.console import Console
    from rich.table import Table

    if sys.stderr.isatty():
        print("\r\033[K", end="", file=sys.stderr, flush=True)
    console = Console(width=None if sys.stdout.isatty() else 140, markup=False, highlight=False)
    for section in measured["sections"].values():
        table = Table(title=section["title"], title_justify="left")
        for name in section["rows"][0]:
            table.add_column(name, justify="left" if name == "name" else "right")
        for row in section["rows"]:
            table.add_row(*map(_shown, row.values()))
        console.print(table)
        for one in section["reach"]:
            sign, limit = ("reached" if one["met"] else "NOT reached"), ("at least" if one["at_least"] else "at most")
            console.print(f"  {one['what']}: {one['value']:.3g} (wanted: {limit} {one['wanted']:.3g}): {sign}")
        for name, reason in section["missing"].items():
            console.print(f"  {name}: {reason}")
        for note in section["notes"]:
            console.print(f"  {note}")
        console.print()
    machine = measured["machine"]
    versions = ", ".join(f"{name} {version}" for name, version in machine["versions"].items())
    console.print(f"{machine['cpu']}; {machine['cores']} cores; {machine['system']}; C: {machine['compiler']}")
    console.print(f"{machine['python']}; {versions}" + ("; quick" if measured["quick"] else ""))


def _shown(value: Any) -> str:
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, list):
        return " to ".join(map(_shown, value))
    return f"{value:.3g}" if isinstance(value, float) else str(value)
