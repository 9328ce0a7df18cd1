"""What a section of the benchmarks found: a table, the figures to reach, and the lines of a figure."""

from dataclasses import asdict, dataclass, field
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

    def table(self) -> list[dict[str, Any]]:
        """The rows."""
        return self.rows

    def sentences(self) -> list[str]:
        """The figures to reach, the peers that are missing, the notes."""
        reach = [
            f"{one.what}: {one.value:.3g} (wanted: {one.bound}): {'reached' if one.met else 'NOT reached'}"
            for one in self.reach
        ]
        return [*reach, *(f"{name}: {reason}" for name, reason in self.missing.items()), *self.notes]

    def as_json(self) -> dict[str, Any]:
        """All of it, as plain data."""
        return asdict(self) | {"reach": [asdict(one) | {"met": one.met} for one in self.reach]}


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

    @property
    def bound(self) -> str:
        """What is wanted, in words."""
        return f"{'at least' if self.at_least else 'at most'} {self.wanted:.3g}"


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
