"""Where each precision breaks: a matrix of conditions and precisions, every cell computed and judged.

A cell is `within` (its error is within the promise), `refused` (with a sentence), or `failed`.  Errors are in ulps of
the precision, against the oracle's matrix equation in mpmath or another reference that shares no formula with it.
The promise of a step is that of `check`, 4κ ulps, with κ the condition number of the state; those with guard digits
promise as if κ were 1.
"""

import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, replace
from functools import partial
from math import isfinite
from typing import NamedTuple

from chapsym import jobs
from chapsym.dynamics import BadInput, StepNotTaken
from chapsym.dynamics.levels.frames import cores
from chapsym.files import Data

from . import states, steps
from .judging import BUDGET, DOUBLE, FAILED, LEVELS, ORDER, Judge, Judged, Level, refused, worst

#: A condition at a precision, as JSON has it, but that numbers may be infinite.
Cell = Data


class Group(NamedTuple):
    """Rows of the matrix: what judges the items of each condition, and the columns that have this path.

    items: made when they are asked for, as most take a continuation.
    """

    title: str
    judge: Callable[..., Judged]
    items: Callable[[], Mapping[str, Sequence[object]]]
    levels: Sequence[Level] = LEVELS

    @property
    def rows(self) -> dict[str, list[Judge]]:
        """The judges of each condition."""
        return {name: [partial(self.judge, item) for item in those] for name, those in self.items().items()}


_BATCHED = tuple(level for level in LEVELS if not level.guarded)
_DOUBLE = (DOUBLE,)
_TITLES = {
    "momentum": "the size of the momentum", "rotation": "large rotations", "fold": "near the fold of the branch",
    "D": "D relative to the inertia", "inertia": "the shape of the body",
    "directions": "directions of γ and of the momentum",
}  # fmt: skip

#: The groups, in the order of the table.
GROUPS = {
    **{
        name: Group(f"One step: {title}", steps.judge, lambda name=name: states.conditions()[name])  # type: ignore[misc]
        for name, title in _TITLES.items()
    },
    "runs": Group("Ten steps of a trajectory, compared with ten of the oracle", steps.ten_steps, states.starts),
    "batch": Group("The same in a batch of 4096", partial(steps.ten_steps, balls=steps.BATCH), states.starts, _BATCHED),
    "order": Group(
        "One step of the composition of order 8 (of order 4 when quick)",
        steps.composed,
        lambda: states.starts() | {"at 0.8 of the fold": [steps.near_its_fold]},
    ),
    "reverse": Group("Ten steps, and back", steps.way_back, states.starts, _DOUBLE),
    "long": Group(
        "Drift of ⟨𝒦,γ⟩, |𝒦|² and |γ|² in a long run",
        steps.long_run,
        lambda: {f"ε = {size:g}": [size] for size in (1e-3, 0.05, 0.4)},
    ),
    "fold search": Group("Where the branch folds", steps.fold_search, states.folds, _DOUBLE),
    "vertical": Group("One step of the reduced map G_h", steps.vertical, states.upright_states, _DOUBLE),
}
#: Groups whose rows of one name are about the same run.
SHARED = ("runs", "batch", "reverse")


def judged(judge: Judge, level: Level, quick: bool) -> Judged:
    """The judgement of a call; a refusal is one, and any other exception is a failure."""
    try:
        return judge(level, quick)
    except (BadInput, StepNotTaken) as refusal:
        return refused(str(refusal))
    except Exception as error:
        return Judged(FAILED, reason=f"{type(error).__name__}: {str(error).splitlines()[0] if str(error) else ''}")


def cell(group: str, condition: str, judges: Sequence[Judge], level: Level, quick: bool) -> Cell:
    """The worst that is judged; a warning is a failure."""
    with warnings.catch_warnings(record=True) as said:
        warnings.simplefilter("always")
        found = worst([judged(judge, level, quick) for judge in judges])
    if said and found.verdict != FAILED:
        found = replace(found, verdict=FAILED, reason=f"it warns: {said[0].message}")
    return {"condition": condition, "group": group, "rung": level.key, **asdict(found)}


def row(group: str, condition: str, quick: bool) -> list[Cell]:
    """The cells of one condition, at the precisions that have its path."""
    found = GROUPS[group]
    return [cell(group, condition, found.rows[condition], level, quick) for level in found.levels]


def extremes(
    quick: bool = False, groups: Sequence[str] | None = None, on_row: Callable[[int], None] = lambda done: None
) -> list[Cell]:
    """All cells, row by row, computed side by side on the cores; `on_row` is called with the number of rows done.

    quick: shorter runs and smaller batches; groups: which rows, all by default.
    """
    wanted = _named(groups)
    tasks: dict[str | tuple[str, str], list[tuple[str, str]]] = {}  # rows of one reference together, computed once
    for group, condition in wanted:
        tasks.setdefault(condition if group in SHARED else (group, condition), []).append((group, condition))
    found: dict[tuple[str, str], list[Cell]] = {}

    def chain(those: list[tuple[str, str]]) -> jobs.Chain:
        found.update((yield jobs.Call(_some, (those, quick))))
        on_row(len(found))

    with jobs.processes(cores()) as crew:
        jobs.run(map(chain, tasks.values()), crew)
    return [one for name in wanted for one in found[name]]


def _some(those: Sequence[tuple[str, str]], quick: bool) -> dict[tuple[str, str], list[Cell]]:
    return {name: row(*name, quick) for name in those}


def _named(groups: Sequence[str] | None) -> list[tuple[str, str]]:
    """The rows of some groups, all by default, in the order of the table."""
    return [(name, one) for name, group in GROUPS.items() if groups is None or name in groups for one in group.rows]


def rows(groups: Sequence[str] | None = None) -> int:
    """The number of rows in some groups, in all by default."""
    return len(_named(groups))


def as_json(cells: Sequence[Cell], quick: bool) -> Data:
    """The matrix for --json, where no number is NaN or infinite."""
    return {
        "quick": quick,
        "budget_ulps": BUDGET,
        "rungs": [level.key for level in LEVELS if any(one["rung"] == level.key for one in cells)],
        "groups": {name: group.title for name, group in GROUPS.items() if any(one["group"] == name for one in cells)},
        "counts": {verdict: sum(one["verdict"] == verdict for one in cells) for verdict in ORDER},
        "cells": [
            {name: None if isinstance(x, float) and not isfinite(x) else x for name, x in one.items()} for one in cells
        ],
    }
