"""The file of a certificate: one JSON object of strings and whole numbers, sealed by a digest."""

import hashlib
import json
from pathlib import Path
from typing import Any

from chapsym import checker
from chapsym.files import write_whole

FORMAT = "chapsym-certificate/1"


def sealed(kind: str, statement: str, **fields: Any) -> dict[str, Any]:
    """The object of a certificate, with its format, kind, statement and digest."""
    document = {"format": FORMAT, "kind": kind, "statement": statement, **fields}
    return {**document, "digest": digest(document)}


def stated(kind: str, **fields: Any) -> dict[str, Any]:
    """The object of a certificate, with the statement that its numbers make, and sealed."""
    return sealed(kind, checker.statement({"kind": kind, **fields}), **fields)


def digest(document: dict[str, Any]) -> str:
    """SHA-256, in hexadecimal, of the canonical JSON of all but the digest."""
    rest = {name: value for name, value in document.items() if name != "digest"}
    return hashlib.sha256(json.dumps(rest, sort_keys=True, separators=(",", ":")).encode("ascii")).hexdigest()


def text(document: dict[str, Any]) -> str:
    """The text of the file."""
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def write(path: Path, document: dict[str, Any]) -> None:
    """Writes the file whole; raises `chapsym.files.CannotWrite`."""
    write_whole(path, lambda stream: stream.write(text(document).encode()))
