"""The file of a certificate: one JSON object of strings and whole numbers, sealed by a digest."""

import json
import math
import time
from collections.abc import Callable, Iterable
from fractions import Fraction
from pathlib import Path

from chapsym import checker
from chapsym.dynamics.errors import LimitReached
from chapsym.files import Data, write_text
from chapsym.workers import Processes

from .balls import NotProved, shortest

#: The object of a certificate, or of a part of it.
Document = Data
#: What a sentence on the progress is passed to.
Say = Callable[[str], None]
#: The fields that are computed from the others.
MADE = ("format", "kind", "statement", "digest")


def stated(kind: str, **fields: object) -> Document:
    """The object of a certificate, with the statement of its numbers and its digest."""
    sentence = checker.statement({"kind": kind, **fields})
    document = {"format": checker.FORMAT, "kind": kind, "statement": sentence, **fields}
    return {**document, "digest": checker.digest(document)}


def accepted(document: Document, seconds: float = math.inf) -> Document:
    """The object itself; raises checker.Rejected if the checker does not accept it.

    Where the seconds are limited the checker has a process of its own, which ends with them: raises TimeoutError.
    """
    if seconds == math.inf:
        checker.check(document)
    else:
        with Processes(1) as pool:
            pool.submit(checker.check, document).result(max(seconds, 0.0))
    return document


def first_accepted(
    trials: Iterable[int], made: Callable[[int], Document], progress: Say, limit: float, less: str
) -> Document:
    """The first certificate that the checker accepts, of those made for it with each of these numbers of bits.

    less: what a user can do who has no more time.  Raises checker.Rejected, as the last is, and LimitReached if none is
    accepted after `limit` s.
    """
    until, why = time.monotonic() + limit, checker.Rejected("no bits are tried")
    for bits in trials:
        progress(f"the checker tries {bits} bits")
        try:
            return accepted(made(bits), until - time.monotonic())
        except checker.Rejected as error:
            why = error
        except TimeoutError:
            clause = f"the checker had not ended at the limit, with {bits} bits; raise it, or {less}"
            raise LimitReached(clause) from None
    raise why


def widest(radii: list[Fraction], found: Callable[[Fraction], Document], progress: Say) -> Document:
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
