"""chapsym study: numerical evidence about the questions that the paper left open."""

from pathlib import Path
from typing import Annotated

import typer

from .app import app
from .options import Json, argument, takes, writes
from .output import check_known

#: Packages of research, in a checkout.
STUDIES = ("rotation", "energy", "chaos")


@app.command()
def study(
    name: Annotated[str, argument("NAME", f"{', '.join(STUDIES)}.")],
    quick: Annotated[bool, typer.Option("--quick", help="Fewer and coarser.")] = False,
    output: Annotated[Path | None, writes("DIR", "For data and figures; an unfinished one is resumed.")] = None,
    scheduler: Annotated[str | None, takes("ADDRESS", "A Dask scheduler, such as tcp://host:8786.")] = None,
    as_json: Json = False,
) -> None:
    """Measure: rotation numbers and mode locking of the reduced map, the energy of the full map, how much is chaotic.

    With -o every unit of work is kept as it is done: repeat the command to resume an interrupted study.  It needs a
    checkout of chapsym.

    Example: chapsym study rotation --quick -o open
    """
    from chapsym.studies.checkout import in_checkout

    check_known("study", [name], STUDIES)
    in_checkout("research", "command").study(name, quick, output, scheduler, as_json)
