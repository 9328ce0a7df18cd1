"""`chapsym bench`: what the map costs beside what a user would take instead, measured in one process."""

from collections.abc import Callable
from dataclasses import asdict
from importlib import import_module
from typing import Any

from chapsym.studies.harness import Contender, NotComparable, Timing, machine

from .results import Curve, Reached, Result

__all__ = ["SECTIONS", "Contender", "Curve", "NotComparable", "Reached", "Result", "Timing", "as_json", "run"]

#: The sections; each has a module.
SECTIONS = (
    "goals", "trajectory", "batch", "steps", "calls", "plans", "dimensions", "digits", "memory", "work-precision",
    "long",
)  # fmt: skip
#: The section that takes a ball of one's own.
OWN = "trajectory"


def run(section: str, quick: bool, on_round: Callable[[str], None] = lambda text: None, **own: Any) -> Result:
    """Measures one section; `quick` is for a look, in seconds.  Raises NotComparable where two sides disagree.

    own: of the section `OWN`, the ball and its start, as `trajectory.Start`.
    """
    return import_module(f".{section.replace('-', '_')}", __name__).measure(quick, on_round, **own)


def as_json(results: dict[str, Result], quick: bool) -> dict[str, Any]:
    """The machine and all that was measured, as plain data."""
    sections = {
        name: asdict(found) | {"reach": [asdict(one) | {"met": one.met} for one in found.reach]}
        for name, found in results.items()
    }
    return {"machine": machine(), "quick": quick, "sections": sections}
