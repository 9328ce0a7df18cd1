"""The file of a certificate: one JSON object of strings and whole numbers, sealed by a digest."""

import hashlib
import json
from collections.abc import Callable, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

from chapsym import checker
from chapsym.files import write_whole

FORMAT = "chapsym-certificate/1"
#: What is made of the other fields of a file.
MADE = ("format", "kind", "statement", "digest")


def sealed(kind: str, statement: str, **fields: Any) -> dict[str, Any]:
    """The object of a certificate, with its format, kind, statement and digest."""
    document = {"format": FORMAT, "kind": kind, "statement": statement, **fields}
    return {**document, "digest": digest(document)}


def stated(kind: str, **fields: Any) -> dict[str, Any]:
    """The object of a certificate, with the statement that its numbers make, and sealed."""
    return sealed(kind, checker.statement({"kind": kind, **fields}), **fields)


def widest(radii: Sequence[Fraction], found: Callable[[Fraction], dict[str, Any] | None]) -> dict[str, Any] | None:
    """What is found with the largest of radii that fall, by halving, as smaller ones are easier; None if none is."""
    first, last, best = 0, len(radii) - 1, found(radii[-1])
    while best is not None and first < last:
        middle = (first + last) // 2
        other = found(radii[middle])
        first, last, best = (middle + 1, last, best) if other is None else (first, middle, other)
    return best


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
