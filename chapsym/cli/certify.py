"""chapsym certify: certificates of what the paper left open, found, written and checked."""

import json
import os
import sys
import time
from collections.abc import Callable, Mapping
from decimal import ROUND_CEILING, Context
from fractions import Fraction
from functools import partial
from math import isfinite
from pathlib import Path
from typing import Annotated, Any

import typer

from chapsym.rationals import rational, rationals

from .app import app
from .options import BALL, Json, argument, ball_from, takes, with_options, writes
from .output import Data, check_apart, counted, fail, print_json, put, telling

certify = typer.Typer(
    help="""Find and check certificates of what the paper left open.

    Example: chapsym certify no-invariant-measure -o found.json && chapsym certify check found.json
    """,
    rich_markup_mode=None,
)
app.add_typer(certify, name="certify")

#: The options of a ball without its mass and radius.
BODY = {name: BALL[name] for name in ("mass_tensor", "inertia", "contact")}
Output = Annotated[Path | None, writes("FILE", "Write the certificate there.")]
Digits = Annotated[int | None, takes("N", "Decimals; as many as needed by default.")]
Radius = Annotated[str | None, takes("R", "How far parameters may be off; the largest power of 10.")]
Limit = Annotated[float, takes("S", "Seconds after which the search stops, at its next report of progress.")]


def _ball(given: Mapping[str, str | None], D: str, J: str = "1,2,4") -> tuple[Any, Fraction]:
    """J and D as they are given; by default those of the command."""
    if all(value is None for value in given.values()):
        given = {"mass_tensor": J, "contact": D}
    if given.get("contact") is None:
        fail("D is missing: give --D", 2)
    return ball_from(given)


def _optional(text: str | None, name: str) -> Fraction | None:
    """A number that may be left out."""
    return None if text is None else rational(text, name)


@certify.command("no-invariant-measure")
@with_options(BODY)
def no_invariant_measure(
    vertical_momentum: Annotated[
        str, takes("H", "h of G_h: the momentum is h gamma.", "--vertical-momentum", "--height")
    ] = "12/5",
    steps: Annotated[int | None, takes("Q", "Steps; the fewest possible, odd.")] = None,
    turns: Annotated[int | None, takes("P", "Half turns in them; 1.")] = None,
    level: Annotated[str | None, takes("L", "The level; found by default.")] = None,
    digits: Digits = None,
    radius: Radius = None,
    limit: Limit = 600.0,
    output: Output = None,
    as_json: Json = False,
    **body: str | None,
) -> None:
    """Certify that the reduced map preserves no measure with a positive continuous density.

    On a level circle with the rotation number p/q one point is moved by more, another by less than p half turns in q
    steps.  By default for the ball with J = (1, 2, 4), D = 1.  Beyond the bound of lemma small-branch it is also proved
    that each point of the circle has one root of the branch.

    Example: chapsym certify no-invariant-measure --mass-tensor 1,2,4 --D 7 --steps 21 -o real-ball.json
    """
    J, D = _ball(body, "1")
    h = rational(vertical_momentum, "--vertical-momentum")
    at, within = _optional(level, "--level"), _optional(radius, "--radius")
    from chapsym.certificates.measure import no_invariant_measure as search
    from chapsym.certificates.reduced import Top

    options = {"steps": steps, "half_turns": turns, "level": at, "digits": digits, "radius": within}
    _deliver(output, as_json, limit, search, Top(J, D, h), **options)


@certify.command("heteroclinic")
@with_options(BODY)
def heteroclinic(
    vertical_momentum: Annotated[str, takes("H", "h of G_h: the momentum is h gamma.")] = "22/5",
    starts: Annotated[str | None, takes("X1,X2", "Two starts x = e^2u; 1 and about the middle of a step.")] = None,
    digits: Digits = None,
    radius: Radius = None,
    limit: Limit = 600.0,
    output: Output = None,
    as_json: Json = False,
    **body: str | None,
) -> None:
    """Certify that orbits of the reduced map between the unstable rotations do not fit at their ends.

    On the level 1/Lambda2 increments tend to one number at both ends; what an orbit misses between them is proved to be
    different for two starts.  By default for the ball with J = (1, 4, 8), D = 1/2.

    Example: chapsym certify heteroclinic --mass-tensor 1,8,12 --D 22 --vertical-momentum 8 -o ends.json
    """
    J, D = _ball(body, "1/2", "1,4,8")
    h = rational(vertical_momentum, "--vertical-momentum")
    within = _optional(radius, "--radius")
    two = None if starts is None else rationals(starts, "--starts", 2)
    from chapsym.certificates.heteroclinic import heteroclinic as search
    from chapsym.certificates.reduced import Top

    _deliver(output, as_json, limit, search, Top(J, D, h), starts=two, digits=digits, radius=within)


@certify.command("periodic-orbit")
@with_options(BODY)
def periodic_orbit(
    k_squared: Annotated[str, takes("KK", "|K|^2.", "--k-squared", "--momentum-momentum")] = "15/2",
    vertical_momentum: Annotated[
        str | None, takes("H", "<K, gamma>; found by default.", "--vertical-momentum", "--momentum-gamma")
    ] = None,
    steps: Annotated[int, takes("Q", "Steps after which the orbit is back.")] = 20,
    attracting: Annotated[bool, typer.Option("--attracting", help="It must attract the orbits near it.")] = False,
    digits: Digits = None,
    radius: Radius = None,
    limit: Limit = 600.0,
    output: Output = None,
    as_json: Json = False,
    **body: str | None,
) -> None:
    """Certify a periodic orbit, K not parallel to gamma, that contracts volumes: no density near it is invariant.

    On the level of |K| and of K with gamma it is isolated and no symmetry maps it to itself.  By default for the
    ball with J = (1, 2, 4), D = 2.

    Example: chapsym certify periodic-orbit --mass-tensor 1,2,4 --D 1 --steps 26 --attracting -o attracting.json
    """
    J, D = _ball(body, "2")
    KK = rational(k_squared, "--k-squared")
    Kg = _optional(vertical_momentum, "--vertical-momentum")
    within = _optional(radius, "--radius")
    from chapsym.certificates.orbit import periodic_orbit as search

    _deliver(output, as_json, limit, search, J, D, KK, steps, Kg, digits, attracting, within)


@certify.command("energy-drift")
@with_options(BODY)
def energy_drift(
    momentum: Annotated[str, takes("K1,K2,K3", "The start, near a closed orbit.")] = "1,2,3.42454",
    gamma: Annotated[str, takes("G1,G2,G3", "The unit vertical, rational.")] = "3/7,6/7,2/7",
    symmetry: Annotated[str, takes("S1,S2,S3", "Signs: how the orbit is back.")] = "-1,-1,1",
    time: Annotated[str, takes("T", "When it is back.")] = "8.5478",
    vary: Annotated[int, takes("N", "The component of the momentum that is adjusted.", min=1, max=3)] = 3,
    digits: Annotated[int, takes("N", "Its decimals.", min=12, max=200)] = 20,
    limit: Limit = 600.0,
    output: Output = None,
    as_json: Json = False,
    **body: str | None,
) -> None:
    """Certify a closed orbit of the continuous ball on which the energy of the map drifts.

    By default for the ball with J = (1, 2, 4), D = 1.

    Example: chapsym certify energy-drift -o drift.json
    """
    J, D = _ball(body, "1")
    K, g = rationals(momentum, "--momentum", 3), rationals(gamma, "--gamma", 3)
    signs, end = rationals(symmetry, "--symmetry", 3), rational(time, "--time")
    from chapsym.certificates.drift import energy_drift as search

    _deliver(output, as_json, limit, search, J, D, K, g, signs, end, vary - 1, digits=digits)


@certify.command()
def check(
    files: Annotated[list[Path] | None, argument("FILE...", "Certificates.")] = None,
    manifest: Annotated[Path | None, takes("FILE", "Check all that a manifest lists; none may be missing.")] = None,
) -> None:
    """Check certificates: exit status 0 accepted, 1 rejected, 2 unreadable.

    The separate checker judges them, which imports nothing from what found them.
    """
    import subprocess

    if not files and manifest is None:
        fail("name a FILE, or a --manifest (see chapsym certify check --help)", 2)
    # A process of its own, so that nothing loaded here has a part in it.
    command = [sys.executable, "-m", "chapsym.checker", *([f"--manifest={manifest}"] if manifest else []), "--"]
    command += map(str, files or [])
    raise typer.Exit(subprocess.run(command, check=False).returncode)


@certify.command("manifest")
def manifest_of(folder: Annotated[Path, argument("DIR", "Certificates, in this folder and those below.")]) -> None:
    """Write DIR/manifest.json, which lists all certificates of a folder: one that is missing later is seen.

    Example: chapsym certify manifest proofs
    """
    from chapsym import checker, files
    from chapsym.checker import manifest

    path, names = folder / "manifest.json", dict[str, str]()
    if not folder.is_dir():
        fail(f"there is no folder {folder}", 2)
    with telling() as progress:
        for place, below, there in os.walk(folder):
            progress(f"{counted(len(names), 'certificate')}; in {place}")
            for file in sorted(Path(place, name) for name in below + there if name.endswith(".json")):
                progress(f"{counted(len(names), 'certificate')}; {file}")
                try:
                    if file != path:
                        names[file.relative_to(folder).as_posix()] = checker.check(checker.read(file)).name
                except (checker.Rejected, checker.Unreadable) as error:
                    fail(f"{file}: {error}", 1)
    if not names:
        fail(f"{folder} has no certificates", 2)
    files.write_text(path, json.dumps(manifest.made(names), indent=1) + "\n")
    put(f"wrote {path}: {len(names)} certificates")


@certify.command()
def motion(
    scene: Annotated[Path, argument("SCENE.toml", "One ball, and how it starts.")],
    digits: Annotated[int, takes("N", "How many digits of every number are proved.")] = 20,
    limit: Annotated[float, takes("S", "Seconds after which what is proved is given.")] = 600.0,
    against: Annotated[Path | None, takes("RESULT", "A result of the scene: a bound of its error is proved.")] = None,
    certificate: Annotated[Path | None, takes("FILE", "Write there what the separate checker judges.")] = None,
    output: Annotated[Path | None, writes("FILE", "Write the frames there.")] = None,
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
    from chapsym.scene.members.exactly import case_of, exact_motion
    from chapsym.scene.result import formats
    from chapsym.scene.result.proved import UNITS, check_scene, proved_errors

    check_apart(output, scene, against, certificate)
    check_apart(certificate, scene, against)
    for path in filter(None, (output, certificate)):
        files.check_destination(path)
    given = load(scene)
    start, times = exact_motion(given)
    if certificate is not None:
        check_start(start, len(times))
    result = None if against is None else formats.load(against).load()
    if result is not None:
        check_scene(result, str(given.toml))
    with telling() as progress:
        began = time.monotonic()
        found = follow(start, times, digits, limit=limit, progress=progress)
    written = found.write()
    errors = {}
    if result is not None:
        errors = proved_errors(result, found)
        written["errors"] = {name: error if isfinite(error) else None for name, error in errors.items()}
    if output is not None:
        write(output, case_of(scene.stem, given.title, start) | written)
    if certificate is not None and found.stopped is None:
        with telling(every=0.0) as progress:
            write(certificate, certified(start, found, progress, limit - (time.monotonic() - began)))
    if as_json:
        print_json(written)
    elif found.times:
        if output is not None:
            put(f"wrote {output}")
        if certificate is not None and found.stopped is None:
            put(f"wrote {certificate}; check it by chapsym certify check {files.pasted(certificate)}")
        about = f"{digits} digits, {counted(found.steps, 'step')}, {found.bits} bits"
        print(f"{counted(len(found.times), 'frame')} proved: {about}; the last of them")
        last = written["frames"][-1]
        print(f"  time {last['time']}")
        for name, vector in last.items():
            for middle, radius in vector if name != "time" else ():
                print(f"  {name:16} {middle} +/- {radius}")
        for name, error in errors.items():
            put(f"  {name:16} of {against} {within(error, UNITS[name])}")
    if found.stopped is not None:
        fail(found.stopped, 1)


@certify.command("run")
def run_of_map(
    scene: Annotated[Path, argument("SCENE.toml", "One ball of the map, in double precision.")],
    limit: Limit = 600.0,
    output: Output = None,
    as_json: Json = False,
) -> None:
    """Certify how far the frames of a run of the map in float64 are from its exact orbit.

    The checker repeats the run in integers, from the numbers as float64 has them.

    Example: chapsym certify run docs/examples/map.toml -o run.json
    """
    from chapsym.certificates.run import check_steps
    from chapsym.certificates.run import map_run as search
    from chapsym.dynamics import trajectory
    from chapsym.scene import load
    from chapsym.scene.members.members import one_ball
    from chapsym.scene.plan.plan import plan_of

    check_apart(output, scene)
    plan = plan_of(load(scene))
    if plan.task.accuracy is not None:
        fail(f"{scene} is of the motion of the ball: add map = true under [run], or take chapsym certify motion", 2)
    if len(plan.members) > 1 or plan.members.axes is not None or plan.members.dimension > 3:
        fail(f"{scene}: certify run takes one ball in three dimensions, by its principal moments", 2)
    start, task = (one_ball(plan.members, 0), plan.members.momentum[0], plan.members.gamma[0]), plan.task
    check_steps(task.steps // task.every * task.every)
    run = trajectory(*start, task.steps, every=task.every, order=task.order, precision=task.precision, proved=True)
    _deliver(output, as_json, limit, partial(search, limit=limit), run)


def within(error: float | None, unit: str) -> str:
    """A bound in two digits, which are rounded up; none where a frame has no number."""
    if error is None or not isfinite(error):
        return "has no number or no bound at some of these frames"
    shown = Context(prec=2, rounding=ROUND_CEILING).create_decimal_from_float(error)
    return f"is within {float(shown):.2g}{unit} at these frames: proved"


def _deliver(
    output: Path | None, as_json: bool, limit: float, search: Callable[..., Data], *given: Any, **options: Any
) -> None:
    """Finds a certificate with its progress on standard error, writes it, and prints what the checker says of it."""
    from chapsym import checker, files
    from chapsym.certificates.document import write
    from chapsym.dynamics.map import until

    if output is not None:
        files.check_destination(output)
    with telling() as progress:
        found = search(*given, **options, progress=until(limit, progress))
    if output is not None:
        write(output, found)
    if as_json:
        print_json(found)
        return
    if output is not None:
        put(f"wrote {output}; check it by chapsym certify check {files.pasted(output)}")
    verdict = checker.check(found)
    put(f"Proved: {verdict.statement}")
    put(*(f"  {name}: {value}" for name, value in verdict.numbers.items()))
