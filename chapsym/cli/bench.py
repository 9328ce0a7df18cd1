"""chapsym bench: what the map costs, beside what a user would take instead."""

from pathlib import Path
from typing import Annotated

import typer

from .app import app
from .options import Json
from .output import fail


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
    from chapsym.studies.harness import benchmark

    try:
        command = benchmark("command")
    except ModuleNotFoundError as error:
        fail(str(error), 2)
    command.measure(sections or [], quick, output, as_json)
