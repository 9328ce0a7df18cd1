"""chapsym prove: judge the printed claims; and what other commands need of the verdicts."""

import json
import sys
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout, suppress
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated

import typer

from chapsym import files

from .app import app
from .options import Json, Own, Records, argument, takes
from .output import Data, counted, fail, note, print_json, progress_bar, put

if TYPE_CHECKING:
    from chapsym.prove import Claim, Register


@app.command()
def prove(
    ids: Annotated[list[str] | None, argument("[ID ...]", "Claims; all if none is named.")] = None,
    as_json: Json = False,
    listing: Annotated[bool, typer.Option("--list", help="List the claims that have a proof.")] = False,
    explain: Annotated[bool, typer.Option("--explain", help="Print the whole argument.")] = False,
    jobs: Annotated[int | None, takes("N", "Processes; one for each core by default.", min=1)] = None,
    certificates: Annotated[
        Path | None, takes("DIR", "Write what was decided as ID.json, for the checker; lemmas, too, if no ID is named.")
    ] = None,
    own: Own = None,
    rocq: Annotated[
        Path | None,
        takes("DIR", "Write the same as theorems of Rocq (Coq 8.16), with a Makefile that has them judged."),
    ] = None,
    kept_in: Records = None,
) -> None:
    """Judge claims, those of the paper or your own: run their proofs, side by side, and keep the verdicts.

    Example: chapsym prove prop-4 5.11 --explain
    """
    from chapsym.checker import file_name
    from chapsym.prove import unproved
    from chapsym.prove.rocq import former, write
    from chapsym.prove.runner import explain as argument

    register = register_from(own)
    claims = all_claims(register, lemmas=True)
    if unknown := [id for id in ids or [] if id not in claims]:
        named = f" --register {files.pasted(own)}" if own else ""
        others = "" if own else ", and --register FOLDER judges claims of your own"
        known = f"chapsym prove --list{named} names those that are judged{others}"
        fail(f"no proof judges the claim {unknown[0]!r}; {known}", 2)
    if listing:
        _list_claims(claims, as_json, kept_in, register)
        return
    for place in filter(None, (certificates, rocq)):
        files.made(place)
    if rocq:
        former(rocq)  # refuses a folder with other files
    everything = claims if certificates or rocq else all_claims(register)
    with TemporaryDirectory() as spare:
        folder = certificates or (Path(spare) if rocq else None)
        records = judge_and_keep(list(dict.fromkeys(ids or everything)), jobs, kept_in, folder, register)
        if rocq and folder:
            kept = [file for record in records if (file := folder / file_name(record["id"])).exists()]
            written = write((json.loads(file.read_text(encoding="utf-8")) for file in kept), rocq)
            counts = f"claims: {written.claims}, theorems: {written.theorems.total()}"
            note(f"for Rocq in {rocq}: {counts}; make -C {files.pasted(rocq)} -j2 has them judged")
    # The whole register is as it should be with the paper's open questions open; a claim that is named must be proved.
    failed = [record["id"] for record in records if record["verdict"] == "open"] if ids else unproved(records)
    if as_json:
        print_json({"claims": records})
    elif explain:
        put(*"\n\n".join(map(argument, records)).split("\n"))
    else:
        for record in records:
            title = f"{record['evidence']['title']}  ({record['seconds']:.2f} s)"
            put(f"{record['id']:18} {record['verdict']:12} {title}")
            if record["evidence"]["settled"]:
                put(f"{'':18} settled {record['evidence']['settled']['text']}")
            for problem in record["evidence"]["problems"]:
                put(f"{'':18} problem: {problem}")
            if record["evidence"]["problems"]:
                put(f"{'':18} its proof: {claims[record['id']].place}")
        print(tally(records))
        for id in ids or []:
            if parts := sorted(other for other in claims.keys() - set(ids or []) if other.startswith(f"{id}-")):
                note(f"{id} has parts that are judged apart: {', '.join(parts)}")
    if certificates:
        carried = [record["evidence"]["carried"] for record in records if record["evidence"]["carried"]]
        judged = counted(sum(c["statements"] for c in carried), "statement")
        others = counted(sum(sum(c["sentences"].values()) for c in carried), "sentence")
        note(f"certificates in {certificates}: {judged} that the checker accepted, {others} that it did not judge")
    if failed:
        fail(f"not proved: {', '.join(failed)}", 1)


def _list_claims(claims: dict[str, "Claim"], as_json: bool, kept_in: Path | None, register: "Register") -> None:
    """Every claim with its recorded verdict, and whether the inputs of the verdict have changed."""
    from chapsym.prove import records

    kept = kept_records(kept_in, register)
    old = records.stale(kept, claims)
    rows = [
        {"id": id, "title": claim.title, "verdict": kept[id]["verdict"] if id in kept else None, "stale": id in old}
        for id, claim in claims.items()
    ]
    if as_json:
        print_json({"claims": rows})
        return
    for row in rows:
        state = "stale" if row["stale"] else row["verdict"] or "not judged"
        put(f"{row['id']:18} {state:12} {row['title']}")
    if old:
        are = "is" if len(old) == 1 else "are"
        print(f"{counted(len(old), 'record')} {are} stale: the derivation has changed; chapsym prove judges anew")


def judge_and_keep(
    wanted: list[str], jobs: int | None, kept_in: Path | None, certificates: Path | None, register: "Register"
) -> list[Data]:
    """Proves the claims, stores their records and certificates, and reports changed verdicts."""
    from chapsym.prove import prove_all, records

    claims, path = all_claims(register, lemmas=True), kept_in or records.default_path(register)
    kept = kept_records(kept_in, register)
    arrived: list[Data] = []

    def keep(record: Data) -> None:
        arrived.append(record)
        shown(len(arrived))
        with suppress(OSError):  # which is said at the end
            records.append(path, record, claims)

    try:
        with suppress(files.CannotWrite):
            records.update(path, [], claims)  # with a last line that is whole
    except records.BrokenRecords as error:
        fail(str(error), 2)
    try:
        with progress_bar("proving", len(wanted)) as shown:
            judged = prove_all(wanted, jobs, keep, folder=certificates, register=register)
    finally:  # an interrupt keeps what was finished, and puts it in order
        try:
            records.update(path, arrived, claims)
        except (files.CannotWrite, records.BrokenRecords) as error:
            note(f"the verdicts are not kept: {error}")
    for record in judged:
        before = kept.get(record["id"], record)["verdict"]
        if before != record["verdict"]:
            note(f"{record['id']} was {before}, and is {record['verdict']} now")
    return judged


def records_of(
    claims: dict[str, "Claim"], kept: dict[str, Data], kept_in: Path | None, register: "Register"
) -> list[Data]:
    """The record of every claim: the stored one if it is fresh and no failure, otherwise a new one."""
    from chapsym.prove import records, unproved
    from chapsym.prove.runner import downstream

    stale = records.stale(kept, claims)
    fresh = {id: record for id, record in kept.items() if id not in stale}
    failed = unproved(fresh.values())
    if wanted := [id for id in claims if id not in fresh or id in failed]:
        kept = kept | {record["id"]: record for record in judge_and_keep(wanted, None, kept_in, None, register)}
    for id in claims:  # what uses a claim is said by other scripts than its own
        kept[id]["evidence"]["downstream"] = downstream(id, claims)
    return [kept[id] for id in claims]


def kept_records(kept_in: Path | None, register: "Register") -> dict[str, Data]:
    """The stored records of a register, by id."""
    from chapsym.prove import records

    try:
        return records.read(kept_in or records.default_path(register))
    except records.BrokenRecords as error:
        fail(str(error), 2)
    except OSError as error:
        fail(f"the records {error.filename} cannot be read: {error.strerror}", 2)


def register_from(named: str | None) -> "Register":
    """The register that --register names; that of chapsym if none is named."""
    from chapsym.prove import PROOFS, Register

    return PROOFS if named is None else Register(named)


def all_claims(register: "Register", lemmas: bool = False) -> "dict[str, Claim]":
    """The claims of a register, and its lemmas if asked."""
    from chapsym.prove import load

    with reading():
        return load(lemmas, register)


@contextmanager
def reading() -> Iterator[None]:
    """A context for reading a register: one that cannot be loaded is a failed proof; what it prints is no output."""
    from chapsym.prove import BrokenScript, NoRegister

    try:
        with redirect_stdout(sys.stderr):
            yield
    except NoRegister as error:
        fail(str(error), 2)
    except BrokenScript as error:
        fail(str(error), 1)


def tally(records: list[Data]) -> str:
    """The number of claims with each verdict."""
    counts = Counter(record["verdict"] for record in records)
    return f"{counted(len(records), 'claim')}: " + ", ".join(f"{n} {verdict}" for verdict, n in sorted(counts.items()))
