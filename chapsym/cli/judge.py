"""chapsym judge: how far the trajectories of an engine are from a certified motion."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from .app import app
from .options import Json, argument, takes, writes
from .output import Data, fail, print_json, put, telling

if TYPE_CHECKING:
    from chapsym.studies.judge import Convergence

#: Said of a table without an attitude, of which only height and slip can be judged.
NONE = ", without an attitude, from which its motion would begin"


@app.command()
def judge(
    results: Annotated[list[Path], argument("RESULT.csv ...", "Of one engine, each with its step; or of chapsym.")],
    against: Annotated[
        Path | None, takes("CASE", "A .json of benchmarks/rolling/data, or a scene, .toml, with its start.")
    ] = None,
    body: Annotated[
        Path | None, takes("BODY", "A ball, .toml, .urdf, .sdf or .xml, that starts as the first row does.")
    ] = None,
    output: Annotated[Path | None, writes("FILE", "The curves: .svg, .png, .pdf, or a page: .html.")] = None,
    as_json: Json = False,
) -> None:
    """Judge an engine: how far its ball is from where a ball that rolls without slipping is.

    The columns are time, x, y, z, qw, qx, qy, qz and, for energy and momentum, vx, vy, vz, wx, wy, wz: m, s, rad, z up.
    A table without an attitude is judged by what it has.
    Three files or more, with steps in one ratio, give the order, and the error that no step removes.  Other names of
    columns, and the form t x y z qx qy qz qw without names, are known.  Where the first row is in another convention
    than the motion (quaternion, axes, units), one sentence says so, and there is no verdict.

    Example: chapsym judge mine.csv --body mine.urdf
    """
    from chapsym.studies.comparable import SOFT, case_of_body, case_of_scene, check_axes, check_start
    from chapsym.studies.foreign import table_of
    from chapsym.studies.judge import convergence, departure, read_case, sentence, summary

    if (against is None) == (body is None):
        fail("give either --against, a case or a scene, or --body, a ball that starts as the first row does", 2)
    if output is not None:
        from chapsym.studies.judge_drawing import check_output, save

        check_output(output)
    tables = [table_of(file) for file in results]  # before a motion is certified, which may take a minute
    with telling() as progress:
        if body is not None:
            tables = [table.from_zero() for table in tables]
            case = case_of_body(body, min(tables, key=lambda table: len(table.times)), progress)
        else:
            assert against is not None
            case = case_of_scene(against, progress) if against.suffix == ".toml" else read_case(against)
    runs = [table.at(case.time) for table in tables]
    for run in runs:
        if against is not None or len(runs) > 1:  # one with a body has its own start
            check_start(case, run, SOFT if against is None else 0.0)
        check_axes(case, run)
    found = [departure(case, run) for run in runs]
    known: dict[str, Convergence] = {}
    if len(runs) > 2:
        known = {name: convergence(case, runs, name) for name in ("path", "attitude") if name in found[0]}
    elif len(runs) == 2:
        fail("give one result, or three or more with steps in one ratio: two do not tell an order", 2)
    if output is not None:
        save(output, case, runs, found, known)
    pairs = list(zip(runs, found, strict=True))
    if as_json:
        rows = [{"file": x.file, "time_step": x.step, "departure": summary(one, case.time)} for x, one in pairs]
        print_json({"case": case.name, "results": rows, "convergence": {name: vars(x) for name, x in known.items()}})
        return
    for run, one in pairs:
        step = "" if run.step is None else f", step {run.step:g} s"
        put(f"{run.file}{step}, against {case.name}{NONE if case.own else ''}:")
        for line in lines(summary(one, case.time), "" if body is None else " after the first row"):
            print(f"  {line}")
    for name, several in known.items():
        put(f"{name}: {sentence(several, 'm' if name == 'path' else 'degrees')}")
    if output is not None:
        put(f"wrote {output}")


def lines(summary: Data, since: str) -> list[str]:
    """A line for each part; since: of the times, unless they are those of the table."""
    from chapsym.studies.judge import limit_of

    found = []
    for name, part in summary.items():
        after = ""
        if "limit" in part:
            limit = limit_of(name)
            late = part["departs"]
            after = f"within {limit}" if late is None else f"beyond {limit} from {late:g} s{since} on"
        found.append(f"{name:9} at most {part['greatest']:<10.3g} {part['unit']:8} {after}".rstrip())
    return found
