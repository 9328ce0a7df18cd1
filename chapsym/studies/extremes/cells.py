"""A cell of the matrix: what was computed, what was promised, and the verdict."""

import warnings
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass, replace
from math import isfinite
from typing import Any

from .levels import KNOWN, Level, finite, mp, number, radius

WITHIN, REFUSED, FAILED = "within", "refused", "failed"
#: From bad to worse.
ORDER = (WITHIN, REFUSED, FAILED)
#: Ulps that are promised, times what the condition asks for; as in `check`: 8 roundings of half an ulp.
BUDGET = 4.0

#: An error above this, relatively, leaves no digit: then a refusal would be right.
NO_DIGIT = 0.1


@dataclass(frozen=True)
class Judged:
    """One comparison, or the worst of several.

    ulps: the error in ulps of the precision, promised: how many were; digits: correct decimal digits, relative.
    condition: κ of the state, or of what was computed from it.  reason: one line, for all that is not `within`.
    """

    verdict: str
    ulps: float | None = None
    promised: float | None = None
    digits: float | None = None
    condition: float | None = None
    reason: str = ""


@dataclass(frozen=True)
class Condition:
    """A row: `judge` takes a level and whether to be quick; `levels` are the columns that have this path."""

    name: str
    group: str
    judge: Callable[[Level, bool], Judged]
    levels: tuple[str, ...]


@dataclass(frozen=True)
class Cell:
    """A condition at a precision."""

    condition: str
    group: str
    rung: str
    verdict: str
    ulps: float | None
    promised: float | None
    digits: float | None
    condition_number: float | None
    reason: str

    def write(self) -> dict[str, Any]:
        """The cell for JSON, where no number is NaN or infinite."""
        fields = asdict(self)
        return {name: None if isinstance(x, float) and not isfinite(x) else x for name, x in fields.items()}


def cell(condition: Condition, level: Level, quick: bool) -> Cell:
    """The cell, computed; an exception that is no refusal is a failure, whatever it is, and so is a warning."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        try:
            found = condition.judge(level, quick)
        except Exception as error:
            found = Judged(FAILED, reason=f"{type(error).__name__}: {str(error).splitlines()[0] if str(error) else ''}")
    if said and found.verdict != FAILED:
        found = replace(found, verdict=FAILED, reason=f"it warns: {said[0].message}")
    return Cell(
        condition.name, condition.group, level.name, found.verdict, found.ulps, found.promised, found.digits,
        found.condition, found.reason,
    )  # fmt: skip


def worst(found: Sequence[Judged]) -> Judged:
    """The worst verdict, and of the same the one that comes nearest to its promise."""

    def badness(one: Judged) -> tuple[int, float]:
        share = one.ulps / one.promised if one.ulps is not None and one.promised else 0.0
        return ORDER.index(one.verdict), share

    return max(found, key=badness)


@dataclass(frozen=True)
class Compared:
    """A vector beside the truth, with the error that is promised in ulps of its size."""

    name: str
    found: Iterable[Any]
    truth: Sequence[Any]
    promised: float
    size: Any = None  # of the vector: its largest component, unless it is said


def compared(level: Level, vectors: Sequence[Compared], condition: float | None = None) -> Judged:
    """Every vector beside its truth, in ulps of the precision; a ball must contain it, and its radius is its error."""
    return worst([_one(level, vector, condition) for vector in vectors])


def _one(level: Level, vector: Compared, condition: float | None) -> Judged:
    found = [*vector.found]
    if not finite(found):
        return Judged(FAILED, reason=f"{vector.name} is not finite, and no reason is given")
    largest = max((abs(x) for x in vector.truth), default=mp.zero)
    size = largest if vector.size is None else vector.size
    away = [abs(number(x) - t) for x, t in zip(found, vector.truth, strict=True)]
    radii = [radius(x) for x in found]
    error = max([*away, *radii])
    spacing = level.spacing(size)
    ulps = float(error / spacing) if spacing else 0.0 if error == 0 else float("inf")
    digits = float(-mp.log10(error / size)) if error and size else None
    told = ""
    if any(r and a > r + KNOWN * size for a, r in zip(away, radii, strict=True)):
        told = f"the ball of {vector.name} excludes the truth"
    elif ulps > vector.promised:
        told = f"{vector.name} is wrong by {ulps:.3g} ulps; {vector.promised:.3g} are promised"
    elif error > number(NO_DIGIT) * size and error > spacing:
        told = f"no digit of {vector.name} is right, as {vector.promised:.3g} ulps are all that is promised"
    return Judged(FAILED if told else WITHIN, ulps, vector.promised, digits, condition, told)
