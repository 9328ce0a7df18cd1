"""`chapsym bench`: what the map costs, compared with what a user would take instead, measured in one process."""

from importlib import import_module

from .harness import Contender, NotComparable, Say, Timing
from .results import Curve, Reached, Result

__all__ = ["SECTIONS", "Contender", "Curve", "NotComparable", "Reached", "Result", "Timing", "run"]

NAME, TITLE = "bench", "Speed compared with other methods"
ABOUT = (
    "The map compared with other ways, all in one process and interleaved. Ratios are of medians; times depend on the "
    "machine and on what else it does."
)
#: The sections, each of which has a module; those that are measured by default, and those that have a figure.
SECTIONS = DEFAULT = (
    "goals", "trajectory", "batch", "steps", "calls", "plans", "dimensions", "digits", "memory", "work-precision",
    "long",
)  # fmt: skip
DRAWN = ("work-precision", "long")


def run(section: str, quick: bool, on_round: Say = lambda text: None, **own: object) -> Result:
    """Measures one section; `quick` takes seconds.  Raises NotComparable where two sides disagree.

    own: of the section `trajectory`, the ball and its start, as `trajectory.Start`.
    """
    return import_module(f".{section.replace('-', '_')}", __name__).measure(quick, on_round, **own)
