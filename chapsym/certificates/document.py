"""The file of a certificate: one JSON object of strings and whole numbers, sealed by a digest."""

import json
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

from chapsym import checker
from chapsym.files import Data, write_text

from .balls import NotProved, shortest

#: The object of a certificate, or of a part of it.
Document = Data
#: The fields that are computed from the others.
MADE = ("format", "kind", "statement", "digest")


def stated(kind: str, **fields: object) -> Document:
    """The object of a certificate, with the statement of its numbers and its digest."""
    sentence = checker.statement({"kind": kind, **fields})
    document = {"format": checker.FORMAT, "kind": kind, "statement": sentence, **fields}
    return {**document, "digest": checker.digest(document)}


def accepted(document: Document) -> Document:
    """The object itself; raises checker.Rejected if the checker does not accept it."""
    checker.check(document)
    return document


def widest(radii: list[Fraction], found: Callable[[Fraction], Document], progress: Callable[[str], None]) -> Document:
    """The certificate with the largest possible radius, by bisection among radii; smaller radii are easier.

    Raises NotProved or checker.Rejected, as `found` for the smallest radius.
    """
    first, last, best = 0, len(radii) - 1, found(radii[-1])
    while first < last:
        middle = (first + last) // 2
        progress(f"trying the radius {shortest(radii[middle])}")
        try:
            last, best = middle, found(radii[middle])
        except (NotProved, checker.Rejected):
            first = middle + 1
    return best


def text(document: Document) -> str:
    """The text of the file."""
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def write(path: Path, document: Document) -> None:
    """Writes the file atomically; raises `chapsym.files.CannotWrite`."""
    write_text(path, text(document))
