"""chapsym run: roll a scene."""

from pathlib import Path
from typing import Annotated, Any

import typer

from .app import app
from .options import Json
from .output import fail, print_json, progress_bar


@app.command()
def run(
    scene: Annotated[Path, typer.Argument(metavar="SCENE.toml", help="What to roll.")],
    output: Annotated[Path | None, typer.Option("-o", "--output", metavar="OUT", help="A .npz or .csv file.")] = None,
    as_json: Json = False,
) -> None:
    """Run a scene and write the trajectory.

    Example: chapsym run docs/first.toml -o first.npz
    """
    from chapsym import scene as scenes
    from chapsym.dynamics import BadInput, StepNotTaken
    from chapsym.scene.files import check_destination

    try:
        wanted = scenes.load(scene)
        destination = output or (Path(wanted.run.output) if wanted.run.output else None)
        if destination is None:
            fail(f'{scene} names no output: add -o OUT.npz, or output = "..." under [run]', 2)
        check_destination(destination)
        failure = None
        if wanted.run.accuracy is not None:
            _run_accurately(wanted, destination, as_json)
            return
        with progress_bar("rolling", wanted.task().steps) as shown:
            try:
                result = scenes.run(wanted, shown)
            except StepNotTaken as error:
                failure, result = error, error.trajectory
        scenes.save(result, destination)
    except BadInput as error:
        fail(str(error), 2)
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


def _run_accurately(scene: Any, destination: Path, as_json: bool) -> None:
    """A scene that asks for an accuracy: what was chosen is told with the result."""
    from chapsym import scene as scenes

    from .trade import described, print_answer, quiet, say

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
    from chapsym.dynamics import front

    size = float(abs(run.momentum[0]).max()) or 1.0
    invariants = front.invariants(run.momentum / size, run.gamma)
    return [float(x) for x in abs(invariants - invariants[0]).max(axis=0)]
