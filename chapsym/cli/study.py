"""chapsym study: numerical evidence about the questions that the paper left open."""

import json
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer

from .app import app
from .options import Json, argument, takes, writes
from .output import check_known, print_json, progress_bar

#: The packages of research, in a checkout, that offer study(quick, run), run as `run_units`, sentences(found), and
#: DRAWN, what draws each figure.
STUDIES = ("rotation", "energy", "chaos")


@app.command()
def study(
    name: Annotated[str, argument("NAME", f"{', '.join(STUDIES)}.")],
    quick: Annotated[bool, typer.Option("--quick", help="Fewer and coarser.")] = False,
    output: Annotated[
        Path | None, writes("DIR", "A folder for the data and figures; an unfinished one is resumed.")
    ] = None,
    scheduler: Annotated[str | None, takes("ADDRESS", "A Dask scheduler, such as tcp://host:8786.")] = None,
    as_json: Json = False,
) -> None:
    """Measure: rotation numbers and mode locking of the reduced map, the energy of the full map, how much is chaotic.

    With -o every unit of work is kept as it is done: repeat the command to resume an interrupted study.  It needs a
    checkout of chapsym.

    Example: chapsym study rotation --quick -o open
    """
    from chapsym import extras
    from chapsym.studies.checkout import in_checkout

    check_known("study", [name], STUDIES)
    if output is not None:
        extras.need("figures")
    module, units = in_checkout("research", name), in_checkout("research", "units")
    folder = None if output is None else units.folder(output)
    kept = None if folder is None else folder / f"{name}.jsonl"
    with progress_bar(name, 0) as shown:
        run = partial(units.run_units, path=kept, scheduler=scheduler, report=shown)
        found = module.study(quick, run)
    written = [] if folder is None else _write(module, name, found, folder)
    if as_json:
        print_json(found)
        return
    for sentence in module.sentences(found):
        print(sentence)
    for path in written:
        print(f"wrote {path}")


def _write(module: Any, name: str, found: dict[str, Any], folder: Path) -> list[Path]:
    """The data as JSON and the figures, each whole."""
    from chapsym import files
    from chapsym.studies.checkout import save_figures

    data = folder / f"{name}.json"
    text = json.dumps(found, ensure_ascii=False, allow_nan=False, indent=1) + "\n"
    files.write_text(data, text)
    return [data, *save_figures(module.__name__, module.DRAWN, found, folder)]
