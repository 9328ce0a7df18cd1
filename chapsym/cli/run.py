"""chapsym run: roll a scene."""

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from chapsym import files

from .app import INTERRUPTED, app
from .options import Json, argument, takes, writes
from .output import Data, apart, check_printed, counted, fail, note, print_json, put

if TYPE_CHECKING:
    from xarray import Dataset

    from chapsym.dynamics.labelled import Arrays
    from chapsym.scene.plan.plan import Plan
    from chapsym.scene.running.sweep import Outcome

OUT = "A .zarr, which can be resumed; or .nc, .parquet, .csv, .npz; - prints a CSV."


@app.command()
def run(
    scene: Annotated[Path, argument("SCENE.toml", "What to roll; or a .urdf, .sdf or MuJoCo's .xml, with a start.")],
    output: Annotated[Path | None, writes("OUT", OUT)] = None,
    scheduler: Annotated[
        str | None, takes("ADDRESS", "A Dask scheduler, such as tcp://host:8786, for a .zarr.")
    ] = None,
    fresh: Annotated[bool, typer.Option("--fresh", "--force", help="Replace any result that is there.")] = False,
    omega: Annotated[
        str | None,
        takes("W1,W2,W3", "For a robot's file: ω at the start in rad/s, with the ball's axes along those of space."),
    ] = None,
    time: Annotated[str | None, takes("S", "For a robot's file: the duration in seconds.")] = None,
    as_json: Json = False,
) -> None:
    """Run a scene and write the result.

    Repeat the command to resume an interrupted run to a .zarr.  A result of another scene is not replaced without
    --fresh.

    Example: chapsym run docs/first.toml -o first.npz
    """
    from chapsym.scene import load
    from chapsym.scene.plan.plan import plan_of
    from chapsym.scene.result import formats
    from chapsym.scene.result.proved import LIMIT, motion_to_prove, with_proof
    from chapsym.scene.running import sweep
    from chapsym.scene.running.store import check_same, save

    from .output import following, quiet, telling

    saved = False
    try:
        wanted = load(scene, None if omega is None else omega.split(","), time)
        destination = output or _named(scene, wanted.run.output)
        if scheduler is not None and destination.suffix != ".zarr":
            fail(f"{destination}: --scheduler needs a .zarr, of which each worker writes its part", 2)
        check_printed(destination, as_json)
        formats.check_destination(destination)
        exact = motion_to_prove(wanted)
        if exact is not None and destination.suffix == ".zarr":
            fail(f"{destination}: run.proved writes its bounds into one file: take .npz, .nc, .csv or .parquet", 2)
        plan = plan_of(wanted)
        formats.check_size(plan, destination)
        if destination.is_file() and not fresh:
            check_same(destination, plan)
        data: Dataset | Arrays
        with following() as report, telling() as about:
            plan, answers = sweep.answering(plan, about)
            if destination.suffix == ".zarr":
                outcome = sweep.run_to_store(plan, destination, scheduler, fresh, report)
                data = formats.load(destination)
            else:
                data = rolled = sweep.run(plan, report)
                if exact is None or destination != formats.STDOUT:
                    save(data, destination, plan, fresh)
                outcome = sweep.Outcome(int((data["status"].values != 0).sum()))
        quiet()
        stopped = None
        if exact is not None:
            saved = True
            with telling() as progress:
                data, motion = with_proof(rolled, exact, float(wanted.run.limit or LIMIT), progress)
            formats.save(data, destination)
            stopped = motion.stopped
    except KeyboardInterrupt:
        kept = "the same command goes on from there" if destination.suffix == ".zarr" else "nothing was written"
        if saved:
            kept = f"the result is in {destination}, without a proof"
        fail(f"interrupted; {kept}", INTERRUPTED)
    with apart(destination):
        shown = Path("standard output") if destination == formats.STDOUT else destination
        _tell(plan, shown, outcome, data, answers, as_json)
    if stopped is not None:
        fail(f"the frames after {len(motion.times)} are not proved: {stopped}", 1)


def _named(scene: Path, name: str | None) -> Path:
    """The destination in a scene: below this folder or its own, as scenes may come from others."""
    if name is None:
        fail(f'{scene} names no output: add -o OUT.npz, or output = "..." under [run]', 2)
    whole = Path(os.path.realpath(name))
    if not any(whole.is_relative_to(os.path.realpath(folder)) for folder in (Path.cwd(), scene.parent)):
        clause = f"if you mean it, say -o {files.pasted(Path(name))}"
        fail(f"{scene}: run.output = {name!r} leaves this folder and that of the scene; {clause}", 2)
    return Path(name)


def _tell(
    plan: "Plan", destination: Path, outcome: "Outcome", data: "Dataset | Arrays", answers: list[Any], as_json: bool
) -> None:
    """Prints the run and its destination; units that were not run are an error, balls that stopped early are none."""
    from chapsym.scene.result.proved import PROVED, UNITS, UNITS_OF_MAP, bounds_of
    from chapsym.scene.result.summary import far, last_state, sentence, stopped

    from .certify import within
    from .trade import described, print_answer

    balls, failed = len(plan.members), outcome.failed
    bounds = json.loads(data.attrs[PROVED]) if PROVED in data.attrs else bounds_of(data)
    one = last_state(data) if balls == 1 and not outcome.lost else {}
    answer = answers[0] if balls == len(answers) == 1 else None
    if as_json:
        found = {
            "output": str(destination), "balls": balls, "frames": plan.frames, "steps": plan.task.steps,
            "model": plan.model.name, "failed": failed, "complete": outcome.complete,
            "lost": [{"balls": list(which), "reason": why} for which, why in outcome.lost.items()],
        }  # fmt: skip
        found |= one | far(data) | ({} if answer is None else described(answer, plan.members))
        print_json(found | ({PROVED: bounds} if bounds else {}))
    else:
        _print(plan, destination, outcome, one)
        if answer is not None:
            print_answer(answer, plan.members)
        elif (away := sentence(data)) is not None:
            put(": ".join(away))
        for name, error in bounds.items():
            of_map = "" if PROVED in data.attrs else ", of the map"
            put(f"{name} {within(error, (UNITS | UNITS_OF_MAP)[name])}{of_map}")
    if failed == balls == 1:
        fail(f"{stopped(data)}; the {one['steps']} steps before it are in {destination}", 2)
    if failed == balls:
        fail(f"no ball got to the end: {stopped(data)}; the frames before are in {destination}", 2)
    if failed:
        note(f"stopped early: {stopped(data)}")
    if outcome.damaged:
        more = f" and {len(outcome.damaged) - 1} more" if len(outcome.damaged) > 1 else ""
        note(f"{destination}: {outcome.damaged[0]}{more} had been lost or damaged; these balls were computed anew")
    if outcome.lost:
        (first, last), why = next(iter(outcome.lost.items()))
        if last - first == balls:
            fail(why, 2)
        more = f", and {len(outcome.lost) - 1} other units" if len(outcome.lost) > 1 else ""
        clause = f"balls {first + 1} to {last} could not be run{more} ({why})"
        fail(f"{clause}; the others are in {destination}, and the same command tries these again", 2)


def _print(plan: "Plan", destination: Path, outcome: "Outcome", one: Data) -> None:
    """Prints a line on the run; for one ball also the drift of the integrals."""
    if one:
        steps = "" if plan.task.accuracy is not None else f"{one['steps']} steps, "
        about, where = f"{steps}{plan.frames} frames", f" in {destination}"
    else:
        about = f"{counted(len(plan.members), 'ball')}, {plan.frames} frames, {plan.model.in_words()}"
        where = f", in {destination}"
    about += f"; {outcome.failed} stopped early" if outcome.failed else ""
    put(about + (f"; {destination} was complete already" if outcome.nothing_to_do else where))
    if "drift" in one and plan.task.accuracy is None:
        print("relative drift of <K,gamma>, <K,K>, <gamma,gamma>: " + ", ".join(f"{x:.1e}" for x in one["drift"]))
