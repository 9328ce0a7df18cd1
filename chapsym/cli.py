"""The command: thin, every room imported only when it is asked for.

Exit status: 0 done and proved; 1 a verdict or a check is not what it should be; 2 the input has no answer,
or the command line is wrong; 130 interrupted; 141 nobody reads the output.
"""

import json
import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn

import typer
from typer.exceptions import TyperException

import chapsym
from chapsym.exact import NotANumber, mass_tensor_from, rational, rationals

if TYPE_CHECKING:
    from chapsym.numbers import Rung

app = typer.Typer(
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)

INTERRUPTED = 130

Records = Annotated[
    Path | None,
    typer.Option(
        "--records",
        metavar="FILE",
        envvar="CHAPSYM_RECORDS",
        show_envvar=False,
        help="The JSON Lines file of verdicts; in the user's cache by default.",
    ),
]

Json = Annotated[bool, typer.Option("--json", help="Print one JSON object on standard output.")]


def main() -> NoReturn:
    """The entry point: turns every foreseen error into one sentence and an exit status."""
    if sys.stdout is None:  # closed by the caller
        sys.stdout = open(os.devnull, "w")  # noqa: SIM115
    if len(sys.argv) == 1:
        sys.argv.append("--help")
    try:
        status = typer.main.get_command(app).main(prog_name="chapsym", standalone_mode=False)
        sys.stdout.flush()
        if status == INTERRUPTED:
            _fail("interrupted", INTERRUPTED)
        sys.exit(status if isinstance(status, int) else 0)
    except SystemExit as stop:
        if isinstance(stop.__context__, BrokenPipeError):  # typer turns it into exit 1, which means something else
            _abandon_output()
        raise
    except TyperException as error:
        _fail(f"{error.format_message()} (see chapsym --help)", 2)
    except NotANumber as error:
        _fail(str(error), 2)
    except (KeyboardInterrupt, typer.Abort):
        _fail("interrupted", INTERRUPTED)
    except BrokenPipeError:
        _abandon_output()
    except OSError as error:
        _silence_output()
        _fail(f"the output cannot be written: {error.strerror or error}", 2)


def _abandon_output() -> NoReturn:
    _silence_output()
    sys.exit(141)


def _silence_output() -> None:
    """Lets nothing more be flushed to an output that refuses it."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _fail(sentence: str, status: int) -> NoReturn:
    print(f"chapsym: {sentence}", file=sys.stderr)
    sys.exit(status)


def _print_json(value: Any) -> None:
    print(json.dumps(value, ensure_ascii=False, allow_nan=False))


@contextmanager
def _progress(label: str, total: int) -> Iterator[Callable[[int], None]]:
    """A bar on standard error, when that is a terminal; yields a function that takes what is done."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    console = Console(stderr=True)
    bar = Progress(
        TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn(),
        console=console, transient=True, disable=not console.is_terminal,
    )  # fmt: skip
    with bar:
        task = bar.add_task(label, total=total)
        yield lambda done: bar.update(task, completed=done)


def _version(wanted: bool) -> None:
    if wanted:
        print(f"chapsym {chapsym.__version__}")
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    """A referee that can be run, for Fedorov's discrete Chaplygin ball."""


@app.command()
def prove(
    ids: Annotated[list[str] | None, typer.Argument(metavar="[ID ...]", help="Claims; all if none is named.")] = None,
    as_json: Json = False,
    listing: Annotated[bool, typer.Option("--list", help="List the claims that have a proof.")] = False,
    explain: Annotated[bool, typer.Option("--explain", help="Print the whole argument.")] = False,
    jobs: Annotated[int | None, typer.Option(min=1, help="Processes; one for each core by default.")] = None,
    kept_in: Records = None,
) -> None:
    """Judge the printed claims: run their proofs, side by side, and keep the verdicts.

    Example: chapsym prove prop-4 5.11 --explain
    """
    from chapsym.prove import unproved
    from chapsym.prove.runner import explain as argument

    claims = _claims()
    unknown = [id for id in ids or [] if id not in claims]
    if unknown:
        _fail(f"no proof judges the claim {unknown[0]!r}; chapsym prove --list names those that are judged", 2)
    if listing:
        _list_claims(claims, as_json, kept_in)
        return
    records = _judge(list(dict.fromkeys(ids or claims)), claims, jobs, kept_in)
    # The whole register is as it should be with the paper's open questions open; a claim that is named must be proved.
    failed = [record["id"] for record in records if record["verdict"] == "open"] if ids else unproved(records)
    if as_json:
        _print_json({"claims": records})
    elif explain:
        print("\n\n".join(argument(record) for record in records))
    else:
        for record in records:
            title = f"{record['evidence']['title']}  ({record['seconds']:.2f} s)"
            print(f"{record['id']:18} {record['verdict']:12} {title}")
            for problem in record["evidence"]["problems"]:
                print(f"{'':18} problem: {problem}")
        print(_tally(records))
    if failed:
        _fail(f"not proved: {', '.join(failed)}", 1)


def _list_claims(claims: dict[str, Any], as_json: bool, kept_in: Path | None) -> None:
    """Every claim with the verdict on record, and whether what it was made with has changed since."""
    from chapsym.prove import records

    kept = _kept(kept_in)
    old = records.stale(kept, claims)
    rows = [
        {"id": id, "title": claim.title, "verdict": kept[id]["verdict"] if id in kept else None, "stale": id in old}
        for id, claim in claims.items()
    ]
    if as_json:
        _print_json({"claims": rows})
        return
    for row in rows:
        state = "stale" if row["stale"] else row["verdict"] or "not judged"
        print(f"{row['id']:18} {state:12} {row['title']}")
    if old:
        print(f"{len(old)} records are stale: their derivation has changed; chapsym prove judges them anew")


def _judge(wanted: list[str], claims: dict[str, Any], jobs: int | None, kept_in: Path | None) -> list[dict[str, Any]]:
    """Proves the claims, keeps their records, and says where a verdict is another than it was."""
    from chapsym import files
    from chapsym.prove import records

    kept = _kept(kept_in)
    arrived: list[dict[str, Any]] = []
    try:
        judged = _judged("proving", wanted, jobs, arrived)
    finally:  # an interrupt keeps what was finished
        try:
            records.update(kept_in or records.default_path(), arrived, claims)
        except files.CannotWrite as error:
            print(f"chapsym: the verdicts are not kept: {error}", file=sys.stderr)
    for record in judged:
        before = kept.get(record["id"], record)["verdict"]
        if before != record["verdict"]:
            print(f"chapsym: {record['id']} was {before}, and is {record['verdict']} now", file=sys.stderr)
    return judged


def _kept(kept_in: Path | None) -> dict[str, dict[str, Any]]:
    from chapsym.prove import records

    try:
        return records.read(kept_in or records.default_path())
    except records.BrokenRecords as error:
        _fail(str(error), 2)
    except OSError as error:
        _fail(f"the records {error.filename} cannot be read: {error.strerror}", 2)


def _judged(
    label: str, ids: list[str], jobs: int | None = None, done: list[dict[str, Any]] | None = None
) -> list[dict[str, Any]]:
    """The records of claims, with a bar that moves as they arrive; `done` collects those that have."""
    from chapsym.prove import prove_all

    done = [] if done is None else done
    with _progress(label, len(ids)) as shown:

        def arrived(record: dict[str, Any]) -> None:
            done.append(record)
            shown(len(done))

        return prove_all(ids, jobs, arrived)


def _claims() -> dict[str, Any]:
    """Every claim that has a proof; a script that cannot be loaded is a failed proof."""
    from chapsym.prove import BrokenScript, load

    try:
        return load()
    except BrokenScript as error:
        _fail(str(error), 1)


def _tally(records: list[dict[str, Any]]) -> str:
    counts: dict[str, int] = {}
    for record in records:
        counts[record["verdict"]] = counts.get(record["verdict"], 0) + 1
    return f"{len(records)} claims: " + ", ".join(f"{n} {verdict}" for verdict, n in sorted(counts.items()))


@app.command()
def report(
    output: Annotated[
        Path, typer.Option("-o", "--output", metavar="FILE", help="A page (.html), or the list of errata (.md, .tex).")
    ] = Path("chapsym-report.html"),
    fresh: Annotated[bool, typer.Option("--fresh", help="Prove every claim again.")] = False,
    as_json: Json = False,
    kept_in: Records = None,
) -> None:
    """Write the page of all verdicts, or the short list of errata; what is stale or was never judged is proved.

    Example: chapsym report -o errata.tex
    """
    from chapsym import files
    from chapsym import report as reports

    if output.suffix not in reports.WRITERS:
        _fail(f"{str(output)!r}: the output must end in {' or '.join(reports.WRITERS)}", 2)
    try:
        files.check_destination(output)
        found = _register({} if fresh else _kept(kept_in), kept_in)
        text = reports.WRITERS[output.suffix](found, _versions())
        files.write_whole(output, lambda stream: stream.write(text.encode()))
    except files.CannotWrite as error:
        _fail(str(error), 2)
    if as_json:
        _print_json({"file": str(output), "counts": reports.counts(found), "claims": len(found)})
    else:
        print(f"wrote {output}: {_tally(found)}")
    failed = reports.unproved(found)
    if failed:
        _fail(f"not proved: {', '.join(failed)}", 1)


def _register(kept: dict[str, dict[str, Any]], kept_in: Path | None) -> list[dict[str, Any]]:
    """The record of every claim: the one that is kept while it is fresh and no failure, otherwise judged now."""
    from chapsym.prove import records, unproved
    from chapsym.prove.runner import downstream

    claims = _claims()
    stale = records.stale(kept, claims)
    fresh = {id: record for id, record in kept.items() if id not in stale}
    failed = unproved(fresh.values())
    wanted = [id for id in claims if id not in fresh or id in failed]
    if wanted:
        kept = kept | {record["id"]: record for record in _judge(wanted, claims, None, kept_in)}
    for id in claims:  # what uses a claim is said by other scripts than its own
        kept[id]["evidence"]["downstream"] = downstream(id, claims)
    return [kept[id] for id in claims]


def _versions() -> dict[str, str]:
    from importlib.metadata import version

    return {"chapsym": chapsym.__version__, "sympy": version("sympy"), "python-flint": version("python-flint")}


@app.command()
def codegen(
    check: Annotated[bool, typer.Option("--check", help="Compare with a fresh build; write nothing.")] = False,
    trust: Annotated[
        list[str] | None, typer.Option(help="Accept the new value of a kernel (or 'all') as its fingerprint.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Generate the kernels from the proved expressions, or check that they are what is derived.

    Example: chapsym codegen --check
    """
    from chapsym.codegen import build

    place = build.folder()
    if check:
        if trust:
            _fail("--trust writes fingerprints, so it does not go with --check", 2)
        problems = _unproved(build.KERNELS)
        try:
            problems += build.check(place)
        except Exception as error:  # whatever a broken derivation does
            problems.append(f"the derivation fails: {type(error).__name__}: {error}")
        if as_json:
            _print_json({"folder": str(place), "problems": problems, "kept": not problems})
        elif not problems:
            print(f"generated code is what is derived: {len(build.KERNELS)} kernels, bytes and values")
        if problems:
            _fail("; ".join(problems) + f". To mend: {build.MEND}", 1)
        return
    if not build.is_checkout(place):
        _fail("this chapsym is an installed copy: generate in a source checkout; here only --check applies", 2)
    try:
        build.check_names(trust or [])
    except ValueError as error:
        _fail(str(error), 2)
    unproved = _unproved(build.KERNELS)
    if unproved:
        _fail("; ".join(unproved), 1)
    try:
        written = build.generate(place, trust or [])
    except (ValueError, ArithmeticError) as error:
        _fail(str(error), 1)
    except OSError as error:
        _fail(f"{place} cannot be written: {error.strerror or error}", 2)
    if as_json:
        _print_json({"folder": str(place), "written": written})
    else:
        print(f"wrote {len(written)} files into {place.name}/")


def _unproved(kernels: Any) -> list[str]:
    """The claims that kernels name as their proof and that are not proved, one sentence each."""
    named = {id: kernel.name for kernel in kernels for id in kernel.claims}
    claims = _claims()
    missing = [
        f"{kernel} names the claim {id}, which no proof judges" for id, kernel in named.items() if id not in claims
    ]
    wanted = [id for id in claims if id in named]
    records = _judged("proving what the kernels come from", wanted)
    failed = [record["id"] for record in records if record["verdict"] == "open"]
    return missing + [f"{named[id]} comes from the claim {id}, which is not proved" for id in failed]


MassTensor = Annotated[str | None, typer.Option("--mass-tensor", metavar="J1,J2,J3", help="J of Sections 4 and 5.")]
Inertia = Annotated[str | None, typer.Option(metavar="I1,I2,I3", help="Principal moments instead, I1 = J2 + J3.")]
Contact = Annotated[str | None, typer.Option("--D", metavar="D", help="D = m rho^2.")]
Mass = Annotated[str | None, typer.Option(metavar="M", help="Mass, with --radius, instead of --D.")]
Radius = Annotated[str | None, typer.Option(metavar="RHO", help="Radius.")]


@app.command()
def step(
    momentum: Annotated[str, typer.Option(metavar="K1,K2,K3", help="The discrete momentum.")],
    gamma: Annotated[str, typer.Option(metavar="G1,G2,G3", help="The unit vertical, upwards, in the body.")],
    mass_tensor: MassTensor = None,
    inertia: Inertia = None,
    contact: Contact = None,
    mass: Mass = None,
    radius: Radius = None,
    digits: Annotated[int | None, typer.Option(min=1, max=100_000, help="Significant digits, by mpmath.")] = None,
    rung: Annotated[str | None, typer.Option(help="double: IEEE float64, the default.")] = None,
    ball: Annotated[int | None, typer.Option(min=2, max=1_000_000, help="Bits of an Arb enclosure.")] = None,
    as_json: Json = False,
) -> None:
    """Take one step of the map, on the small-rotation branch.

    Example: chapsym step --mass-tensor 1,2,4 --D 3 --momentum 1,-1/2,3/4 --gamma 2/7,3/7,6/7 --digits 50 --json
    """
    J, D = _ball_options(mass_tensor, inertia, contact, mass, radius)
    K, g = rationals(momentum, "--momentum", 3), rationals(gamma, "--gamma", 3)
    chosen = _rung(digits, rung, ball)
    from chapsym.dynamics import BadInput, StepNotTaken
    from chapsym.dynamics.precise import precise_step

    try:
        result = precise_step(J, D, K, g, chosen).write()
    except BadInput as error:
        _fail(str(error), 2)
    except StepNotTaken as error:
        _fail(str(error), 2)
    if as_json:
        _print_json(result)
        return
    print(f"q0        {result['q0']}")
    for name in ("q", "momentum", "gamma"):
        print(f"{name:9} " + "  ".join(str(x) for x in result[name]))


def _ball_options(
    mass_tensor: str | None, inertia: str | None, contact: str | None, mass: str | None, radius: str | None
) -> tuple[tuple[Fraction, ...], Fraction]:
    """J and D from the options, exactly."""
    if (mass_tensor is None) == (inertia is None):
        _fail("give either --mass-tensor J1,J2,J3 or --inertia I1,I2,I3", 2)
    if mass_tensor is not None:
        J = rationals(mass_tensor, "--mass-tensor", 3)
    else:
        moments = rationals(str(inertia), "--inertia", 3)
        J = mass_tensor_from(moments)
        if min(J) < 0:
            _fail(f"no body has the inertia {inertia}: each principal moment is at most the sum of the other two", 2)
    if contact is not None and (mass is not None or radius is not None):
        _fail("give either --D, or --mass and --radius", 2)
    if contact is not None:
        return J, rational(contact, "--D")
    if mass is None or radius is None:
        _fail("D is missing: give --D, or --mass and --radius", 2)
    m, rho = rational(mass, "--mass"), rational(radius, "--radius")
    if m <= 0 or rho <= 0:
        _fail("--mass and --radius must be positive", 2)
    return J, m * rho * rho


def _rung(digits: int | None, rung: str | None, ball: int | None) -> "Rung":
    """The rung of the precision ladder that the options name."""
    if sum(x is not None for x in (digits, rung, ball)) > 1:
        _fail("choose one of --digits, --rung and --ball", 2)
    from chapsym.numbers import Ball, Digits, Double

    if digits is not None:
        return Digits(digits)
    if ball is not None:
        return Ball(ball)
    if rung not in (None, "double"):
        _fail(f"--rung {rung}: the only rung so far is double; for more digits use --digits N or --ball BITS", 2)
    return Double()


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
            _fail(f'{scene} names no output: add -o OUT.npz, or output = "..." under [run]', 2)
        check_destination(destination)
        failure = None
        with _progress("rolling", wanted.run.steps) as shown:
            try:
                result = scenes.run(wanted, shown)
            except StepNotTaken as error:
                failure, result = error, error.trajectory
        scenes.save(result, destination)
    except BadInput as error:
        _fail(str(error), 2)
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
        _print_json(summary)
    else:
        print(f"{summary['steps']} steps, {summary['frames']} frames in {destination}")
        print("relative drift of <K,gamma>, <K,K>, <gamma,gamma>: " + ", ".join(f"{x:.1e}" for x in summary["drift"]))
    if failure is not None:
        _fail(f"{failure}; the {summary['steps']} steps before it are in {destination}", 2)


def _drift(run: Any) -> list[float]:
    """The largest change of each invariant, relative to the scale of the momentum."""
    from chapsym.dynamics import front

    size = float(abs(run.momentum[0]).max()) or 1.0
    invariants = front.invariants(run.momentum / size, run.gamma)
    return [float(x) for x in abs(invariants - invariants[0]).max(axis=0)]


@app.command()
def check(
    states: Annotated[int, typer.Option(min=1, help="States of each stratum.")] = 20,
    steps: Annotated[int, typer.Option(min=1000, help="Steps of the trajectory.")] = 100_000,
    seed: Annotated[int, typer.Option(min=0, help="Seed of the states.")] = 20071,
    as_json: Json = False,
) -> None:
    """Check the float64 map against an independent mpmath solution of the matrix equation (4.13).

    Example: chapsym check --states 100
    """
    from chapsym.studies import check as study

    done: list[Any] = []
    with _progress("checking", len(study.STRATA)) as shown:

        def arrived(row: Any) -> None:
            done.append(row)
            shown(len(done))

        rows = study.check(states, seed, on_row=arrived)
    moved = study.drift(steps)
    result = study.as_json(rows, moved)
    if as_json:
        _print_json(result)
    else:
        _print_check(rows, moved, study.BUDGET)
    if not result["kept"]:
        _fail("the float64 map is outside its budget", 1)


def _print_check(rows: list[Any], moved: Any, budget: float) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(title="float64 against mpmath: worst error in ulps")
    for name in ("stratum", "states", "q", "K", "gamma", "condition", f"share of {budget:g}·condition"):
        table.add_column(name, justify="left" if name == "stratum" else "right")
    for row in rows:
        errors = (row.rotation_ulps, row.momentum_ulps, row.gamma_ulps, row.condition)
        table.add_row(row.stratum, str(row.states), *(f"{x:.3g}" for x in errors), f"{row.of_budget:.2f}")
    console = Console(width=None if sys.stdout.isatty() else 120)
    console.print(table)
    print(
        f"over {moved.steps} steps <K,gamma>, <K,K>, <gamma,gamma> moved by "
        f"{moved.height:.1e}, {moved.squared:.1e}, {moved.unit:.1e}, budget {moved.budget:.1e}"
    )
    worst = max(rows, key=lambda row: row.of_budget)
    print(f"single steps use at most {worst.of_budget:.0%} of their budget against mpmath ({worst.stratum})")


if __name__ == "__main__":
    main()
