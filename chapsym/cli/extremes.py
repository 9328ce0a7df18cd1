"""chapsym extremes: where each precision breaks."""

from pathlib import Path
from typing import Annotated

import typer

from .app import app
from .options import Json, argument, writes


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
    from chapsym.studies.checkout import in_checkout

    in_checkout("research", "command").extremes(groups or [], quick, output, as_json)
