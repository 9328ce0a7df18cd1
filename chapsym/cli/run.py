"""chapsym run: roll a scene."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from .app import INTERRUPTED, app
from .options import Json
from .output import fail, note, print_json, progress_bar

if TYPE_CHECKING:
    from chapsym.scene import Scene
    from chapsym.scene.plan.plan import Plan

OUT = "A .zarr, which can be gone on with; or .nc, .parquet, .csv, .npz."


@app.command()
def run(
    scene: Annotated[Path, typer.Argument(metavar="SCENE.toml", help="What to roll.")],
    output: Annotated[Path | None, typer.Option("-o", "--output", metavar="OUT", help=OUT)] = None,
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="A Dask scheduler, such as tcp://host:8786, for a .zarr.")
    ] = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Begin a .zarr anew, whatever result it holds.")] = False,
    as_json: Json = False,
) -> None:
    """Run a scene and write the result.

    A run to a .zarr that was ended, however, goes on with the same command.

    Example: chapsym run docs/first.toml -o first.npz
    """
    from chapsym import scene as scenes
    from chapsym.dynamics import BadInput

    try:
        wanted = scenes.load(scene)
        destination = output or (Path(wanted.run.output) if wanted.run.output else None)
        if destination is None:
            fail(f'{scene} names no output: add -o OUT.npz, or output = "..." under [run]', 2)
        if scheduler is not None and destination.suffix != ".zarr":
            fail(f"{destination}: --scheduler needs a .zarr, of which each worker writes its part", 2)
        _check(destination)
        if _is_single(wanted, destination):
            if wanted.run.accuracy is not None:
                _run_accurately(wanted, destination, as_json)
            else:
                _run_single(wanted, destination, as_json)
        else:
            _run_plan(wanted, destination, scheduler, fresh, as_json)
    except BadInput as error:
        fail(str(error), 2)


def _check(destination: Path) -> None:
    """Raises SceneError, before anything is computed, if the result cannot be written as it is named."""
    from chapsym import files
    from chapsym.scene import SceneError
    from chapsym.scene.result.formats import SUFFIXES

    if destination.suffix not in SUFFIXES:
        raise SceneError(f"{str(destination)!r}: the output must end in {', '.join(SUFFIXES[:-1])} or {SUFFIXES[-1]}")
    if destination.suffix != ".zarr":
        try:
            files.check_destination(destination)
        except files.CannotWrite as error:
            raise SceneError(str(error)) from None


def _is_single(scene: "Scene", destination: Path) -> bool:
    """Whether one ball and its state go to .npz or .csv, which have a form of their own for it."""
    from chapsym.scene import SceneError
    from chapsym.scene.members.expand import expand
    from chapsym.scene.read.scene import single

    if destination.suffix not in (".npz", ".csv"):
        return False
    members = expand(scene)
    try:
        single(members)
        told = sorted(set(scene.task().outputs) - {"momentum", "gamma", "attitude", "contact"})
        if told:
            raise SceneError(f"{told[0]} is kept in .zarr, .nc, .parquet and .csv")
    except SceneError as error:
        if destination.suffix == ".npz":
            raise SceneError(
                f"{destination}: a .npz holds one ball and its state; write to .zarr or .nc ({error})"
            ) from None
        return False
    return True


def _run_plan(scene: "Scene", destination: Path, scheduler: str | None, fresh: bool, as_json: bool) -> None:
    """Any scene, unit by unit, with the least model."""
    from chapsym.scene.result import formats
    from chapsym.scene.running import sweep
    from chapsym.scene.running.source import plan_of

    from .following import following

    plan = plan_of(scene)
    formats.check_size(plan, destination)
    try:
        with following(as_json) as report:
            if destination.suffix == ".zarr":
                outcome = sweep.run_to_store(plan, destination, scheduler, fresh, report)
            else:
                data = sweep.run_in_memory(plan, report)
                formats.save(data, destination)
                outcome = sweep.Outcome(int((data.status != 0).sum()))
    except KeyboardInterrupt:
        kept = "the same command goes on from there" if destination.suffix == ".zarr" else "nothing was written"
        fail(f"interrupted; {kept}", INTERRUPTED)
    _tell(plan, destination, outcome, as_json)


def _tell(plan: "Plan", destination: Path, outcome: Any, as_json: bool) -> None:
    """What was run and where it is; units that were not run are an error, balls that stopped early are none."""
    balls, failed = len(plan.members), outcome.failed
    if as_json:
        lost = [{"balls": list(which), "reason": why} for which, why in outcome.lost.items()]
        run = {"balls": balls, "frames": plan.frames, "steps": plan.task.steps, "model": plan.model.name}
        print_json({"output": str(destination), **run, "failed": failed, "complete": outcome.complete, "lost": lost})
    else:
        stopped = f"; {failed} stopped early" if failed else ""
        about = f"{balls} ball{'s' if balls > 1 else ''}, {plan.frames} frames, {plan.model.name}{stopped}"
        where = f"{destination} was complete already" if outcome.nothing_to_do else f"in {destination}"
        print(f"{about}; {where}" if outcome.nothing_to_do else f"{about}, {where}")
    if failed:
        told = _reasons(destination)
        if failed == balls:
            fail(f"no ball got to the end: {told}; the frames before are in {destination}", 2)
        note(f"stopped early: {told}")
    if outcome.lost:
        (first, last), why = next(iter(outcome.lost.items()))
        more = f", and {len(outcome.lost) - 1} other units" if len(outcome.lost) > 1 else ""
        if last - first == balls:
            fail(why, 2)
        told = f"balls {first + 1} to {last} could not be run{more} ({why})"
        fail(f"{told}; the others are in {destination}, and the same command tries these again", 2)


def _reasons(destination: Path) -> str:
    """Why balls stopped early: of each reason how many, and the first of them."""
    from chapsym.dynamics import Status
    from chapsym.scene.result import formats

    data = formats.load(destination)
    status, taken, names = data["status"].values, data["taken"].values, data["ball"].values
    reasons = []
    for reason in sorted(set(map(int, status)) - {-1, int(Status.TAKEN)}):
        which = (status == reason).nonzero()[0]
        first = f"{names[which[0]]} at step {taken[which[0]]}"
        count = f"{len(which)} balls, the first {first}" if len(which) > 1 else first
        reasons.append(f"{count}: {Status(reason).sentence}")
    return "; ".join(reasons)


def _run_single(scene: "Scene", destination: Path, as_json: bool) -> None:
    """One ball and its state, up to the fold where there is one."""
    from chapsym import scene as scenes
    from chapsym.dynamics import StepNotTaken

    failure = None
    with progress_bar("rolling", scene.task().steps) as shown:
        try:
            result = scenes.run(scene, shown)
        except StepNotTaken as error:
            failure, result = error, error.trajectory
    scenes.save(result, destination)
    summary: dict[str, Any] = {
        "output": str(destination),
        "steps": int(result.taken),
        "frames": len(result.index),
        "final": {"momentum": result.momentum[-1].tolist(), "gamma": result.gamma[-1].tolist()},
        "drift": _drift(result),
    }
    if result.contact is not None:
        summary["final"]["contact"] = result.contact[-1].tolist()
    if as_json:
        print_json(summary)
    else:
        print(f"{summary['steps']} steps, {summary['frames']} frames in {destination}")
        print("relative drift of <K,gamma>, <K,K>, <gamma,gamma>: " + ", ".join(f"{x:.1e}" for x in summary["drift"]))
    if failure is not None:
        fail(f"{failure}; the {summary['steps']} steps before it are in {destination}", 2)


def _run_accurately(scene: "Scene", destination: Path, as_json: bool) -> None:
    """A scene that asks for an accuracy: what was chosen is told with the result."""
    from chapsym import scene as scenes

    from .output import quiet, say
    from .trade import described, print_answer

    answer = scenes.run_accurately(scene, say)
    scenes.save(answer.trajectory, destination)
    quiet()
    if as_json:
        print_json({"output": str(destination), "frames": len(answer.trajectory.index)} | described(answer))
        return
    print(f"{len(answer.trajectory.index)} frames in {destination}")
    print_answer(answer)


def _drift(run: Any) -> list[float]:
    """The largest change of each invariant, relative to the scale of the momentum."""
    from chapsym.dynamics import kernels

    size = float(abs(run.momentum[0]).max()) or 1.0
    invariants = kernels.invariants(run.momentum / size, run.gamma)
    return [float(x) for x in abs(invariants - invariants[0]).max(axis=0)]
