"""`chapsym trade`: the cost of speed in accuracy, measured, and whether the chooser meets its requests."""

from collections.abc import Callable
from functools import partial
from typing import Any

from benchmarks.kernels import Kernels
from chapsym.files import Data

from ..harness import NotComparable, Say
from . import frontiers, requests
from .frontiers import Frontier, Point

__all__ = ["DRAWN", "SECTIONS", "Frontier", "NotComparable", "Point", "missed", "run"]

NAME, TITLE = "trade", "Speed against accuracy"
ABOUT = "Time of the processor against correct digits, for every precision level, order and length of step."
#: The sections that have a frontier, which are measured by default, and all of them.
DRAWN: dict[str, Callable[..., object]] = {
    "rounding": partial(frontiers.of_map, False),
    "proved": partial(frontiers.of_map, True),
    "contact": partial(frontiers.one_ball, "contact"),
    "state": partial(frontiers.one_ball, "state"),
    "batch": frontiers.batch,
}
DEFAULT = tuple(DRAWN)
SECTIONS: dict[str, Callable[..., object]] = {**DRAWN, "requests": requests.measure, "kernels": Kernels}


def run(section: str, quick: bool, say: Say = lambda text: None) -> Any:
    """Measures a section; raises NotComparable where a reference is not confirmed."""
    return SECTIONS[section](quick, say)


def missed(found: Data) -> str | None:
    """The sentence of what is not as it should be: a request that was not met."""
    for one in found.values():
        if isinstance(one, requests.Outcomes) and one.hits < len(one.outcomes):
            return f"{len(one.outcomes) - one.hits} of {len(one.outcomes)} requests were not met"
    return None
