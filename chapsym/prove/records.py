"""Verdict records: a JSON Lines file, each line with the fingerprint of the inputs of its proof.

A record is fresh while the proof script, the imported derivations, the rules of evidence and the deciding libraries are
unchanged.  A fresh record can be shown; a stale one is proved again.
"""

import hashlib
import importlib.metadata
import json
import os
from collections.abc import Iterable
from functools import cache
from pathlib import Path

import platformdirs

from chapsym import files, sources

from .claims import Claim
from .evidence import Verdict
from .registers import PROOFS, Register
from .trees import Data

#: The libraries on which verdicts depend besides this package.
LIBRARIES = ("sympy", "python-flint", "numpy")
#: The keys that a record and its evidence have at least.
KEYS = {"id", "verdict", "printed", "corrected", "evidence", "seconds"}
KEYS_OF_EVIDENCE = {"title", "fingerprint", "open_in_paper"}

#: Modules that run, print and store records, which do not change a verdict.
_BESIDES = {"chapsym.prove.runner", "chapsym.prove.records", "chapsym.prove.registers"}


class BrokenRecords(ValueError):
    """The file is not a readable file of records."""


def default_path(register: Register = PROOFS) -> Path:
    """The default file of records: CHAPSYM_RECORDS, or else a file in the user's cache.

    Records of other registers than chapsym's are in separate files next to it.
    """
    named = os.environ.get("CHAPSYM_RECORDS")
    path = Path(named) if named else platformdirs.user_cache_path("chapsym") / "verdicts.jsonl"
    return path if register == PROOFS else path.parent / f"{path.stem}-{register.key}.jsonl"


def fingerprint(claim: Claim) -> str:
    """A hash of all inputs of the verdict of the claim: sources, files, and the versions of the libraries."""
    text, examples = _of_module(claim.prove.__module__), claim.examples_file
    if not claim.files and not examples:
        return text
    digest = hashlib.sha256(text.encode())
    for file in (*claim.files, *([examples] if examples else [])):
        digest.update(file.name.encode() + b"\n" + (file.read_bytes() if file.is_file() else b"missing"))
    return digest.hexdigest()[:16]


@cache
def _of_module(module: str) -> str:
    versions = "".join(f"{library} {importlib.metadata.version(library)}\n" for library in LIBRARIES)
    return sources.fingerprint(module, _BESIDES, versions)


def read(path: Path) -> dict[str, Data]:
    """The records of a file, by id; none if there is no file.  An unfinished last line is ignored.

    Raises BrokenRecords, with the first invalid line, if it is not such a file.
    """
    records = {}
    if path.exists() and not path.is_dir() and not path.is_file():
        raise BrokenRecords(f"{path} is not a file of verdict records: it is a device or a pipe")
    try:
        text = path.read_text(encoding="utf-8") if path.exists() else ""
    except UnicodeDecodeError as error:
        raise BrokenRecords(f"{path} is not a file of verdict records: it is no text ({error.reason})") from error
    *lines, last = text.split("\n")
    if last and (_parsed(last) or not lines):  # otherwise the computer stopped while it was added
        lines.append(last)
    for number, line in enumerate(lines, start=1):
        if (record := _parsed(line)) is None:
            raise BrokenRecords(f"line {number} of {path} is not a verdict record; delete the file to start anew")
        records[record["id"]] = record
    return records


def _parsed(line: str) -> Data | None:
    """The record in a line; None if there is none."""
    try:
        record = json.loads(line)
    except (ValueError, RecursionError):
        return None
    whole = isinstance(record, dict) and record.keys() >= KEYS
    evidence = record["evidence"] if whole and record["verdict"] in [*Verdict] else None
    return record if isinstance(evidence, dict) and evidence.keys() >= KEYS_OF_EVIDENCE else None


def update(path: Path, records: Iterable[Data], claims: dict[str, Claim]) -> None:
    """Replaces old records by new ones, in the order of the claims; records of unknown claims are removed.

    The file is written atomically; raises CannotWrite if this fails, and BrokenRecords if it has records of other
    claims only, which would be lost.  Simultaneous updates keep the records of both.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with files.alone(path.parent):
            there = read(path)
            if there and not there.keys() & claims.keys():
                one = next(iter(there))
                raise BrokenRecords(
                    f"{path} holds verdicts on other claims, such as {one}; give --records another file"
                )
            known = there | {record["id"]: record for record in records}
            lines = [json.dumps(known[id], ensure_ascii=False) + "\n" for id in claims if id in known]
            files.write_whole(path, lambda stream: stream.writelines(map(files.encoded, lines)))
    except OSError as error:
        raise files.CannotWrite(f"{path} cannot be written: {error.strerror or error}") from None


def append(path: Path, record: Data, claims: dict[str, Claim]) -> None:
    """Adds a complete record, or nothing, to a file of `update`; the last record of a claim counts.

    Nothing to a file that another command, of other claims, has begun meanwhile.
    """
    line = files.encoded(json.dumps(record, ensure_ascii=False) + "\n")
    with files.alone(path.parent), path.open("ab", buffering=0) as stream, path.open("rb") as there:
        first = _parsed(there.readline().decode("utf-8", "replace"))
        if first and first["id"] not in claims:
            return
        before = os.fstat(stream.fileno()).st_size
        if stream.write(line) != len(line):  # a full disk
            stream.truncate(before)


def stale(records: dict[str, Data], claims: dict[str, Claim]) -> list[str]:
    """The ids whose record was made with another derivation, or other libraries, than the present ones."""
    made = {id: record["evidence"]["fingerprint"] for id, record in records.items() if id in claims}
    return [id for id, found in made.items() if found != fingerprint(claims[id])]
