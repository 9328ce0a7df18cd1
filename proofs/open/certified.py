"""The certificates of the proofs: verdicts of the independent checker on files, and on copies with one number changed.

A copy gets a new digest and the statement for its numbers: it must be rejected by arithmetic, not by its digest.
"""

import copy
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from chapsym import checker
from chapsym.checker.document import Data
from chapsym.prove import Fact, Proof

FOLDER = Path(__file__).parents[1].joinpath("certificates")


def files(kind: str) -> tuple[Path, ...]:
    """The certificates of a kind, by name, and the unreadable files, so that these are reported."""
    return tuple(file for file in sorted(FOLDER.glob("*.json")) if _kind(file) in (kind, None))


def _kind(file: Path) -> str | None:
    found = _read(file)
    return None if found is None else str(found.get("kind"))


def _read(file: Path) -> Data | None:
    try:
        return checker.read(file)
    except (checker.Unreadable, checker.Rejected):
        return None


def has_branch(file: Path) -> bool:
    """Whether a certificate proves a branch of the step over its circle, beyond the bound of lemma small-branch."""
    return "branch" in (_read(file) or {})


def present(p: Proof, found: Sequence[Path], kind: str) -> list[Data]:
    """Adds the checker's verdicts on files to the evidence; returns the accepted data, with the fewest steps first."""
    if not found:
        p.problems.append(f"there is no certificate of kind {kind}")
    accepted = []
    for file in found:
        try:
            data = checker.read(file)
            verdict = checker.check(data)
        except (checker.Rejected, checker.Unreadable) as error:
            p.certificate(file.name, str(error), "", accepted=False)
            continue
        p.certificate(file.name, verdict.statement, data["digest"], accepted=verdict.kind == kind)
        accepted.append(data)
    return sorted(accepted, key=lambda data: data.get("steps", 0))


def changed(text: str, data: Data, place: Sequence[str | int], value: object) -> Fact:
    """The statement that the checker accepts a copy with another number at `place` and a new digest."""
    whole = copy.deepcopy(dict(data))
    inside: Any = whole
    for name in place[:-1]:
        inside = inside[name]
    if inside[place[-1]] == value:
        raise ValueError(f"nothing is changed: {text}")
    inside[place[-1]] = value
    whole["statement"] = checker.statement(whole)
    whole["digest"] = checker.digest(whole)
    try:
        checker.check(whole)
    except checker.Rejected:
        return Fact(text, False, "the checker")
    return Fact(text, True, "the checker")


def other_digit(decimal: str, place: int = -1) -> str:
    """A decimal with another digit at this place."""
    digits = list(decimal)
    digits[place] = str((int(digits[place]) + 1) % 10)
    return "".join(digits)
