"""The rows of the matrix, and the whole of it, computed side by side on the cores."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from chapsym import jobs
from chapsym.dynamics.levels.frames import cores

from . import arrays, derived, elliptic, n_dim, reduced, runs, states, steps
from .cells import BUDGET, ORDER, Cell, Condition, cell
from .levels import NAMES, level

#: What each group is about, in the order of the table.
GROUPS = {
    "momentum": "One step: the size of the momentum",
    "rotation": "One step: large rotations",
    "fold": "One step: beside the fold of the branch",
    "D": "One step: D beside the inertia",
    "inertia": "One step: the shape of the body",
    "directions": "One step: directions of γ and of the momentum",
    "runs": "Ten steps of a trajectory, beside ten of the oracle",
    "batch": "The same in a batch of 4096",
    "order": "One step of the composition of order 8 (of order 4 when quick)",
    "reverse": "Ten steps, and back",
    "long": "Drift of ⟨𝒦,γ⟩, |𝒦|² and |γ|² in a long run",
    "extrapolate": "One long step, extrapolated",
    "derived": "ω, the energy, and 𝒦 of ω",
    "fold search": "Where the branch folds",
    "vertical": "One step of the reduced map G_h",
    "elliptic": "The curve in Jacobi's functions, and the exact top",
    "n = 4": "One step in four dimensions",
    "arrays": "What is given: made otherwise, the same bits",
    "input": "What is given: no numbers, no states",
}
#: Groups whose rows of one name are about the same run.
SHARED = ("runs", "batch", "reverse")
_DOUBLE = ("double",)
_BATCHED = ("single", "double", "quad")


def _conditions() -> list[Condition]:
    """All rows, in the order of the groups."""
    rows = [
        Condition(name, group, partial(steps.of, those), NAMES)
        for group, named in states.CONDITIONS.items()
        for name, those in named.items()
    ]
    starts = runs.starts()
    rows += [Condition(name, "runs", partial(runs.ten_steps, name), NAMES) for name in starts]
    rows += [Condition(name, "batch", partial(runs.ten_steps, name, balls=runs.BATCH), _BATCHED) for name in starts]
    rows += [Condition(name, "order", partial(runs.composed, name), NAMES) for name in starts]
    rows += [Condition(name, "reverse", partial(runs.way_back, name), _DOUBLE) for name in starts]
    rows += [Condition(f"ε = {size:g}", "long", partial(runs.long_run, size), NAMES) for size in (1e-3, 0.05, 0.4)]
    rows += [Condition(name, "extrapolate", partial(reduced.extrapolated, name), _DOUBLE) for name in reduced.LONG]
    rows += [
        Condition(f"{quantity}: {name}", "derived", partial(derived.of, quantity, name), _DOUBLE)
        for quantity in derived.QUANTITIES
        for name in derived.CONDITIONS
    ]
    rows += [Condition(name, "fold search", partial(reduced.fold_search, name), _DOUBLE) for name in reduced.FOLDS]
    rows += [Condition(name, "vertical", partial(reduced.vertical, name), _DOUBLE) for name in reduced.VERTICAL]
    rows += [
        Condition(f"{quantity}: {name}", "elliptic", partial(elliptic.of, quantity, name), _DOUBLE)
        for quantity in elliptic.QUANTITIES
        for name in elliptic.CONDITIONS
        if not (quantity != "increment" and name == "increments 1e-12")
    ]
    rows += [Condition(name, "n = 4", partial(n_dim.of, name), _DOUBLE) for name in n_dim.CONDITIONS]
    rows += [Condition(name, "arrays", partial(arrays.same, make), NAMES) for name, make in arrays.SAME.items()]
    rows += [Condition("float32", "arrays", arrays.float32, NAMES), Condition("empty", "arrays", arrays.empty, NAMES)]
    rows += [Condition("huge batch", "arrays", arrays.huge, NAMES)]
    return rows + [
        Condition(name, "input", partial(arrays.refusals, those), NAMES) for name, those in arrays.REFUSED_INPUT.items()
    ]


CONDITIONS = _conditions()


def row(index: int, precisions: Sequence[str], quick: bool) -> list[Cell]:
    """The cells of one condition, at those of the precisions that have its path."""
    condition = CONDITIONS[index]
    return [cell(condition, level(name), quick) for name in precisions if name in condition.levels]


def extremes(
    quick: bool = False, groups: Sequence[str] | None = None, on_row: Callable[[int], None] = lambda done: None
) -> list[Cell]:
    """All cells, row by row; `on_row` is told how many rows are done.

    quick: shorter runs and smaller batches; groups: which rows, all by default.
    """
    wanted = [i for i, condition in enumerate(CONDITIONS) if groups is None or condition.group in groups]
    tasks: dict[Any, list[int]] = {}  # rows with the same reference together: it is computed once
    for i in wanted:
        shares = CONDITIONS[i].group in SHARED
        tasks.setdefault(CONDITIONS[i].name if shares else i, []).append(i)
    found: dict[int, list[Cell]] = {}

    def chain(those: list[int]) -> jobs.Chain:
        found.update((yield jobs.Call(_some, (those, quick))))
        on_row(len(found))

    with jobs.processes(cores()) as crew:
        jobs.run(map(chain, tasks.values()), crew)
    return [one for index in wanted for one in found[index]]


def _some(indices: Sequence[int], quick: bool) -> dict[int, list[Cell]]:
    return {index: row(index, NAMES, quick) for index in indices}


def rows(groups: Sequence[str] | None = None) -> int:
    """How many rows there are in some groups, in all by default."""
    return sum(groups is None or condition.group in groups for condition in CONDITIONS)


def as_json(cells: Sequence[Cell], quick: bool) -> dict[str, Any]:
    """The matrix for --json."""
    counts = {verdict: sum(one.verdict == verdict for one in cells) for verdict in ORDER}
    return {
        "quick": quick,
        "budget_ulps": BUDGET,
        "rungs": [name for name in NAMES if any(one.rung == name for one in cells)],
        "groups": {name: title for name, title in GROUPS.items() if any(one.group == name for one in cells)},
        "counts": counts,
        "cells": [one.write() for one in cells],
    }
