"""chapsym extremes, study and bench: what a checkout of chapsym measures, in `research` and `benchmarks`."""

from pathlib import Path
from typing import Annotated

import typer

from chapsym.rationals import rationals

from .app import app
from .options import BALL, STUDIES, Json, argument, ball_from, takes, with_options, writes
from .output import Data, check_known, fail


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


@app.command()
@with_options(BALL)
def bench(
    sections: Annotated[
        list[str] | None,
        argument(
            "[SECTION]...",
            "goals, trajectory, batch, steps, calls, plans, dimensions, digits, memory, work-precision, long; all.",
        ),
    ] = None,
    quick: Annotated[bool, typer.Option("--quick", help="Smaller sizes and fewer rounds: seconds.")] = False,
    output: Annotated[Path | None, writes("FILE", "A figure (.svg, .png, .pdf) or a page (.md).")] = None,
    momentum: Annotated[str | None, takes("K1,K2,K3", "The discrete momentum of a ball of your own.")] = None,
    gamma: Annotated[str, takes("G1,G2,G3", "Its unit vertical, upwards.")] = "2/7,3/7,6/7",
    as_json: Json = False,
    **body: str | None,
) -> None:
    """Measure speed, memory, drift and precision against other ways, all in one process, interleaved.

    With --momentum and a ball, the section trajectory is measured with that ball.

    A figure that is not reached is shown, and is no failure: times depend on the machine and on what else it does.
    It needs a checkout of chapsym.

    Example: chapsym bench trajectory --quick
    """
    from chapsym.studies.checkout import in_checkout

    command = in_checkout("benchmarks", "command")
    own: Data = {}
    if momentum is not None or any(value is not None for value in body.values()):
        if momentum is None:
            fail("--momentum K1,K2,K3 goes with a ball of your own", 2)
        J, D = ball_from(body)
        K, g = rationals(momentum, "--momentum", 3), rationals(gamma, "--gamma", 3)
        if not any(K):
            fail(f"--momentum {momentum}: a ball at rest takes no time to step; give another", 2)
        sections = sections or ["trajectory"]
        if sections != ["trajectory"]:
            fail("a ball of your own goes with the section trajectory alone", 2)
        own["own"] = J, D, K, g
    command.measure(sections or [], quick, output, as_json, **own)
