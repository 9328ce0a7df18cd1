"""`chapsym bench`: what the map costs beside what a user would take instead, measured in one process."""

from collections.abc import Callable
from importlib import import_module
from typing import Any

from chapsym.studies.harness import Contender, NotComparable, Timing, machine

from .results import Curve, Reached, Result

__all__ = ["SECTIONS", "Contender", "Curve", "NotComparable", "Reached", "Result", "Timing", "as_json", "run"]

#: The sections, by the module that measures each.
SECTIONS = {
    "trajectory": "trajectory",
    "batch": "batch",
    "memory": "memory",
    "plans": "plans",
    "calls": "calls",
    "lanes": "lanes",
    "beyond": "beyond",
    "first-call": "first_call",
    "long": "long_runs",
    "work-precision": "work_precision",
    "extrapolation": "extrapolation",
    "dimensions": "dimensions",
    "digits": "digits",
    "commands": "commands",
}


#: The section that takes a ball of one's own.
OWN = "trajectory"


def run(section: str, quick: bool, on_round: Callable[[str], None] = lambda text: None, **own: Any) -> Result:
    """Measures one section; `quick` is for a look, in seconds.  Raises NotComparable where two sides disagree.

    own: of the section `OWN`, the ball and its start, as `trajectory.Start`.
    """
    return import_module(f".{SECTIONS[section]}", __name__).measure(quick, on_round, **own)


def as_json(results: dict[str, Result], quick: bool) -> dict[str, Any]:
    """The machine and all that was measured, as plain data."""
    return {"machine": machine(), "quick": quick, "sections": {name: _plain(found) for name, found in results.items()}}


def _plain(found: Result) -> dict[str, Any]:
    return {
        "title": found.title,
        "rows": found.rows,
        "missing": found.missing,
        "reach": [vars(r) | {"met": r.met} for r in found.reach],
        "curves": [vars(c) for c in found.curves],
        "notes": found.notes,
    }
