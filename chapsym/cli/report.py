"""chapsym report: the page of verdicts, and the short lists of errata."""

from pathlib import Path
from typing import Annotated, Any

import typer

import chapsym

from .app import app
from .options import Json, Records
from .output import fail, print_json
from .prove import all_claims, judge_and_keep, kept_records, tally


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
        fail(f"{str(output)!r}: the output must end in {' or '.join(reports.WRITERS)}", 2)
    try:
        files.check_destination(output)
        found = _register({} if fresh else kept_records(kept_in), kept_in)
        text = reports.WRITERS[output.suffix](found, _versions())
        files.write_whole(output, lambda stream: stream.write(text.encode()))
    except files.CannotWrite as error:
        fail(str(error), 2)
    if as_json:
        print_json({"file": str(output), "counts": reports.counts(found), "claims": len(found)})
    else:
        print(f"wrote {output}: {tally(found)}")
    failed = reports.unproved(found)
    if failed:
        fail(f"not proved: {', '.join(failed)}", 1)


def _register(kept: dict[str, dict[str, Any]], kept_in: Path | None) -> list[dict[str, Any]]:
    """The record of every claim: the one that is kept while it is fresh and no failure, otherwise judged now."""
    from chapsym.prove import records, unproved
    from chapsym.prove.runner import downstream

    claims = all_claims()
    stale = records.stale(kept, claims)
    fresh = {id: record for id, record in kept.items() if id not in stale}
    failed = unproved(fresh.values())
    wanted = [id for id in claims if id not in fresh or id in failed]
    if wanted:
        kept = kept | {record["id"]: record for record in judge_and_keep(wanted, claims, None, kept_in)}
    for id in claims:  # what uses a claim is said by other scripts than its own
        kept[id]["evidence"]["downstream"] = downstream(id, claims)
    return [kept[id] for id in claims]


def _versions() -> dict[str, str]:
    from importlib.metadata import version

    return {"chapsym": chapsym.__version__, "sympy": version("sympy"), "python-flint": version("python-flint")}
