"""chapsym report: the page of verdicts, and the short lists of errata."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

import chapsym

from .app import app
from .options import STUDIES, Json, Own, Records, takes, writes
from .output import Data, check_apart, fail, print_json, put
from .prove import all_claims, kept_records, reading, records_of, register_from, tally

if TYPE_CHECKING:
    from chapsym.prove import Claim
    from chapsym.report.errata import Entry
    from chapsym.report.questions import Checked, Evidence


@app.command()
def report(
    output: Annotated[Path, writes("FILE", "A page (.html), or the list of errata (.md, .tex, .json).")] = Path(
        "chapsym-report.html"
    ),
    fresh: Annotated[bool, typer.Option("--fresh", help="Prove every claim again.")] = False,
    studies: Annotated[
        Path | None, takes("DIR", "The page of the open questions, with the studies in DIR.", "--open")
    ] = None,
    as_json: Json = False,
    own: Own = None,
    kept_in: Records = None,
) -> None:
    """Write the page of all verdicts, or the short list of errata; what is stale or was never judged is proved.

    Example: chapsym report -o errata.tex
    """
    from chapsym import files
    from chapsym import report as reports

    if output.suffix not in reports.WRITERS:
        fail(f"{str(output)!r}: the output must end in {' or '.join(reports.WRITERS)}", 2)
    check_apart(output, kept_in)
    if studies is not None and own is not None:
        both = "--open shows the open questions of Fedorov's paper, and --register claims of your own"
        fail(f"{both}: give one of them", 2)
    register = register_from(own)
    if studies is not None:
        _open_questions(output, studies, {} if fresh else kept_records(kept_in, register), kept_in, as_json)
        return
    files.check_destination(output)
    earlier = _earlier_errata(output) if output.suffix == ".json" else {}
    claims = all_claims(register)
    found = records_of(claims, {} if fresh else kept_records(kept_in, register), kept_in, register)
    source = reports.FEDOROV
    if own is not None:
        with reading():
            source = reports.own(own, register.setting("PAPER", ""), register.setting("NOTE", ""))
            sections = register.sections(claims.values())
        for record in found:
            record["evidence"]["section"] = sections[record["id"]]
    files.write_text(output, reports.WRITERS[output.suffix](found, _versions(), earlier, source))
    if as_json:
        print_json({"file": str(output), "counts": reports.counts(found), "claims": len(found)})
    else:
        put(f"wrote {output}: {tally(found)}")
    if failed := reports.unproved(found):
        fail(f"not proved: {', '.join(failed)}", 1)


def _earlier_errata(path: Path) -> Mapping[str, "Entry"]:
    """The entries of the list that is written again, which keep their earlier states; none if there is no file."""
    from chapsym import files
    from chapsym.report import NotErrata, entries

    try:
        return entries(files.text_of(path)) if path.exists() else {}
    except (files.CannotRead, NotErrata) as error:
        fail(f"{path} is there and cannot be gone on with: {error}; name another file, or delete it to start anew", 2)


def _open_questions(output: Path, folder: Path, kept: dict[str, Data], kept_in: Path | None, as_json: bool) -> None:
    """Writes the page about what the paper left open: proofs, certificates, and the studies that the folder has."""
    from chapsym import files
    from chapsym.report import questions

    if output.suffix != ".html":
        fail(f"{str(output)!r}: the page of the open questions must end in .html", 2)
    if not folder.is_dir():
        fail(f"there is no folder {folder}; chapsym study NAME -o {files.pasted(folder)} makes it", 2)
    register = register_from(None)
    everything = all_claims(register, lemmas=True)
    wanted = {id: everything[id] for id in _behind(list(questions.QUESTIONS), everything)}
    files.check_destination(output)
    found = records_of(wanted, kept, kept_in, register)
    evidence = [one for name in STUDIES if (one := _evidence(name, folder)) is not None]
    files.write_text(output, questions.html(found, _certificates(), evidence, _versions()))
    verdicts = {record["id"]: record["verdict"] for record in found if record["id"] in questions.QUESTIONS}
    if as_json:
        print_json({"file": str(output), "verdicts": verdicts, "studies": [one.name for one in evidence]})
    else:
        clause = ", ".join(f"{id} {verdict}" for id, verdict in verdicts.items())
        put(f"wrote {output}: {clause}; studies: {', '.join(one.name for one in evidence) or 'none'}")


def _behind(questions: list[str], claims: dict[str, "Claim"]) -> list[str]:
    """The questions, and the lemmas of our own that their proofs use, directly or through others."""
    from chapsym.proofs import LEMMAS

    reached = list(questions)
    for id in reached:  # grows while it is read
        reached += [used for used in claims[id].uses if used in LEMMAS and used not in reached]
    return reached


def _evidence(name: str, folder: Path) -> "Evidence | None":
    """The evidence of a study in the folder; None if there is none."""
    from chapsym import files
    from chapsym.report.questions import Evidence
    from chapsym.studies.checkout import in_checkout

    data = folder / f"{name}.json"
    if not data.is_file():
        return None
    module = in_checkout("research", name)
    try:
        found = json.loads(files.text_of(data))
        drawn = [(caption, folder / file) for file, caption in module.CAPTIONS.items() if (folder / file).is_file()]
        figures = [(caption, files.text_of(path)) for caption, path in drawn]
        return Evidence(name, module.TITLE, module.sentences(found), figures)
    except (files.CannotRead, ArithmeticError, LookupError, ValueError, TypeError, RecursionError) as error:
        fail(f"{data} cannot be read as what chapsym study {name} -o writes: {type(error).__name__}: {error}", 2)


def _certificates() -> "list[Checked]":
    """Every certificate that the proofs rest on, as the separate checker judges it now."""
    from chapsym import checker, proofs
    from chapsym.report.questions import Checked

    judged = []
    for path in sorted((Path(proofs.__path__[0]) / "certificates").glob("*.json")):
        data = checker.read(path)
        if data.get("kind") == "motion":  # an example: no proof rests on it
            continue
        try:
            judged.append(Checked(path.name, data, checker.check(data).numbers))
        except checker.Rejected as error:
            judged.append(Checked(path.name, data, {}, str(error)))
    return judged


def _versions() -> dict[str, str]:
    from importlib.metadata import version

    return {"chapsym": chapsym.__version__, "sympy": version("sympy"), "python-flint": version("python-flint")}
