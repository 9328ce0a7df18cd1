"""The results of a section of the benchmarks: a table, the figures to reach, and the lines of a figure."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, field

from chapsym.files import Data

from .harness import Contender, Run, Say, Timing, cores, interleaved

#: A unit of time, of seconds.
UNITS = {"ns": 1e9, "µs": 1e6, "ms": 1e3}


@dataclass(frozen=True)
class Result:
    """The results of a section.

    rows: the table, dictionaries with the same keys; missing: the peers that could not run, and why;
    reach: what the project set out to reach, `Reached`; curves: what the figure draws.
    """

    title: str
    rows: list[Data]
    missing: dict[str, str] = field(default_factory=dict)
    reach: "list[Reached]" = field(default_factory=list)
    curves: list["Curve"] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def table(self) -> list[Data]:
        """The rows."""
        return self.rows

    def sentences(self) -> list[str]:
        """The figures to reach, the peers that are missing, the notes."""
        reach = [
            f"{one.what}: {one.value:.3g} (wanted: {one.bound}): {'reached' if one.met else 'NOT reached'}"
            for one in self.reach
        ]
        return [*reach, *(f"{name}: {reason}" for name, reason in self.missing.items()), *self.notes]

    def as_json(self) -> Data:
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
        """The bound that is wanted, in words."""
        return f"{'at least' if self.at_least else 'at most'} {self.wanted:.3g}"


@dataclass(frozen=True)
class Curve:
    """A line of a log-log figure, in one of its panels."""

    panel: str
    label: str
    x: list[float]
    y: list[float]


def ratio_columns(timing: Timing, reference: Timing, label: str) -> Data:
    """The columns of a table that compare a side with the reference."""
    middle, lower, upper = timing.ratio_to(reference)
    return {f"to {label}": middle, "quartiles": [lower, upper]}


def timed(sides: Mapping[str, tuple[Run, int]], rounds: int, say: Say, what: str) -> dict[str, Timing]:
    """Times sides, each with the units of its work, together on one core; `what`: of them, for the progress."""
    contenders = [Contender(name, run, work) for name, (run, work) in sides.items()]
    with cores(1):
        return interleaved(contenders, rounds, lambda done: say(f"{what}: round {done} of {rounds}"))


def beside(
    timings: Mapping[str, Timing], home: str, unit: str, columns: Data, differs: object = None, label: str = ""
) -> list[Data]:
    """The rows of a table: each side's time in a unit, and its ratio to one of them.

    differs: by how much the sides differ, all or each by its name.  label: what the table calls `home`.
    """
    rows = []
    for name, timing in timings.items():
        row = {"name": name, **columns, unit: timing.median * UNITS[unit.split()[0]]}
        row |= ratio_columns(timing, timings[home], label or home)
        if differs is not None:
            row["differs by"] = differs[name] if isinstance(differs, Mapping) else differs
        rows.append(row)
    return rows
