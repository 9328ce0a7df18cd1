"""What a section of the benchmarks found: a table, the figures to reach, and the lines of a figure."""

from dataclasses import dataclass, field
from typing import Any

from chapsym.studies.harness import Timing


@dataclass(frozen=True)
class Result:
    """What a section found.

    rows: the table, dictionaries with the same keys; missing: the peers that could not run, and why;
    reach: what the project set out to reach, `Reached`; curves: what the figure draws.
    """

    title: str
    rows: list[dict[str, Any]]
    missing: dict[str, str] = field(default_factory=dict)
    reach: "list[Reached]" = field(default_factory=list)
    curves: list["Curve"] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Reached:
    """A figure to reach: `value` must be at least (or at most) `wanted`."""

    what: str
    value: float
    wanted: float
    at_least: bool

    @property
    def met(self) -> bool:
        """Whether it was reached in this run."""
        return self.value >= self.wanted if self.at_least else self.value <= self.wanted


@dataclass(frozen=True)
class Curve:
    """A line of a log-log figure, in one of its panels."""

    panel: str
    label: str
    x: list[float]
    y: list[float]


def ratio_columns(timing: Timing, reference: Timing, label: str) -> dict[str, Any]:
    """The columns of a table that compare a side with the reference."""
    middle, lower, upper = timing.ratio_to(reference)
    return {f"to {label}": middle, "quartiles": [lower, upper]}
