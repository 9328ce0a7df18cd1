"""`chapsym trade`: what speed costs in accuracy, measured, and whether the chooser meets what is asked of it.

A section is measured to an object with a `title`, the rows of a `table()`, `sentences()` under it, and `as_json()`.
"""

from collections.abc import Callable
from functools import partial
from typing import Any

from benchmarks.kernels import Kernels
from chapsym.studies.harness import NotComparable, machine

from . import frontiers, requests
from .frontier import Frontier, Point

__all__ = ["DRAWN", "SECTIONS", "Frontier", "NotComparable", "Point", "as_json", "measure", "missed"]

#: The sections that have a frontier, and all of them; each measures quickly or in full, and says what it does.
DRAWN: dict[str, Callable[..., Any]] = {
    "rounding": frontiers.rounding,
    "contact": partial(frontiers.one_ball, "contact"),
    "state": partial(frontiers.one_ball, "state"),
    "batch": frontiers.batch,
    "n4": partial(frontiers.four, 1),
    "n4-batch": partial(frontiers.four, frontiers.BATCH_N),
}
SECTIONS: dict[str, Callable[..., Any]] = {**DRAWN, "requests": requests.measure, "kernels": Kernels}


def measure(section: str, quick: bool, say: Callable[[str], None] = lambda text: None) -> Any:
    """Measures a section; raises NotComparable where a reference is not confirmed."""
    return SECTIONS[section](quick, say)


def missed(found: dict[str, Any]) -> str | None:
    """The sentence of what is not as it should be: a request that was not met."""
    for one in found.values():
        if isinstance(one, requests.Outcomes) and one.hits < len(one.outcomes):
            return f"{len(one.outcomes) - one.hits} of {len(one.outcomes)} requests were not met"
    return None


def as_json(found: dict[str, Any], quick: bool) -> dict[str, Any]:
    """The machine and all that was measured, as plain data."""
    return {"machine": machine(), "quick": quick, "sections": {name: one.as_json() for name, one in found.items()}}
