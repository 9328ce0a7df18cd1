"""chapsym certify motion: the continuous ball of a scene, with proved digits."""

from decimal import ROUND_CEILING, Context
from math import isfinite
from pathlib import Path
from typing import Annotated, Any

import typer

from .certify import Output, certify
from .options import Json
from .output import counted, fail, print_json, telling


@certify.command()
def motion(
    scene: Annotated[Path, typer.Argument(metavar="SCENE.toml", help="One ball, and how it starts.")],
    digits: Annotated[int, typer.Option(metavar="N", help="How many digits of every number are proved.")] = 20,
    limit: Annotated[float, typer.Option(metavar="S", help="Seconds after which what is proved is given.")] = 600.0,
    against: Annotated[
        Path | None, typer.Option(metavar="RESULT", help="A result of the scene: a bound of its error is proved.")
    ] = None,
    certificate: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Write there what the separate checker judges on its own.")
    ] = None,
    by: Annotated[
        str, typer.Option(metavar="ROUTE", help="taylor, or theta: in theta functions, with a checkout of chapsym.")
    ] = "taylor",
    output: Output = None,
    as_json: Json = False,
) -> None:
    """Enclose the motion of the continuous ball at the frames of a scene, with proved radii.

    The numbers of the scene are taken exactly as they are written.  With --against, a bound of how far the frames of
    its result are from the motion.  With --certificate, a file for chapsym certify check, of a motion of few turns.

    Example: chapsym certify motion docs/first.toml --digits 20 -o motion.json
    """
    from chapsym import files
    from chapsym.certificates.document import write
    from chapsym.certificates.motion import check_start
    from chapsym.certificates.motion import motion as certified
    from chapsym.dynamics.enclosed_motion import follow
    from chapsym.scene import load
    from chapsym.scene.members.exactly import exact_motion
    from chapsym.scene.result.proved import UNITS, proved_errors

    for path in (output, certificate):
        if path is not None:
            files.check_destination(path)
    given = load(scene)
    start, times = exact_motion(given)
    if certificate is not None:
        check_start(start)
    result = None if against is None else _loaded(against, str(given.toml))
    with telling() as progress:
        found = follow(start, times, digits, by=by, limit=limit, progress=progress)
        if certificate is not None and found.stopped is None:
            write(certificate, certified(start, found, progress))
    written = found.write()
    errors = {}
    if result is not None:
        errors = proved_errors(result, found)
        written["errors"] = {name: error if isfinite(error) else None for name, error in errors.items()}
    if output is not None:
        write(output, written)
    if as_json:
        print_json(written)
    elif found.times:
        if output is not None:
            print(f"wrote {output}")
        if certificate is not None and found.stopped is None:
            print(f"wrote {certificate}; check it by chapsym certify check {certificate}")
        about = f"{digits} digits, {counted(found.steps, 'step')}, {found.bits} bits"
        print(f"{counted(len(found.times), 'frame')} proved: {about}; the last of them")
        last = written["frames"][-1]
        print(f"  time {last['time']}")
        for name, vector in last.items():
            for middle, radius in vector if name != "time" else ():
                print(f"  {name:16} {middle} +/- {radius}")
        for name, error in errors.items():
            print(f"  {name:16} of {against} {within(error, UNITS[name])}")
    if found.stopped is not None:
        fail(found.stopped, 1)


def within(error: float | None, unit: str) -> str:
    """A bound in two digits, which are rounded up; none where a frame has no number."""
    if error is None or not isfinite(error):
        return "has no number at some of these frames"
    shown = Context(prec=2, rounding=ROUND_CEILING).create_decimal_from_float(error)
    return f"is within {float(shown):.2g}{unit} at these frames: proved"


def _loaded(result: Path, scene: str) -> Any:
    """A result, which must be of the scene."""
    from chapsym.scene.result import formats
    from chapsym.scene.result.proved import check_scene

    dataset = formats.load(result).load()
    check_scene(dataset, scene)
    return dataset
