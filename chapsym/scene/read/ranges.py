"""Ranges, which replace numbers in a scene and define a sweep."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import prod
from typing import Literal, get_args

import numpy as np

from chapsym.dynamics.ball import Floats

from .units import Dimension, number

#: The largest number of balls, checked before any is made.
MOST_BALLS = 10_000_000
Kind = Literal["linspace", "grid", "random", "normal"]


@dataclass(frozen=True)
class Range:
    """kind: "linspace" (a, b, n) and "grid" (values) span a dimension of the sweep; "random" (a, b) and "normal"
    (mean, deviation) draw once for each ball.  values: in SI.  count: of those that span a dimension, else 0.
    """

    kind: Kind
    values: tuple[float, ...]
    count: int = 0

    @property
    def drawn(self) -> bool:
        """Whether its values are random."""
        return not self.count

    def grid(self) -> Floats:
        """The values of a range that spans a dimension, (count,)."""
        if self.kind == "grid":
            return np.array(self.values)
        first, last = self.values
        with np.errstate(over="ignore", invalid="ignore"):  # values that are not finite are refused by name
            return np.linspace(first, last, self.count)

    def draw(self, count: int, generator: np.random.Generator) -> Floats:
        """`count` random values of a range, by sums and products only, so that machines agree."""
        first, second = self.values
        if self.kind == "random":
            return first + (second - first) * generator.random(count)
        return first + second * generator.standard_normal(count)


Value = float | Range


def value(given: object, dimension: Dimension) -> Value:
    """A number, a string with a unit, or a range as a table; raises ValueError with what would be right."""
    if not isinstance(given, dict):
        return number(given, dimension)
    if len(given) != 1 or (kind := next(iter(given))) not in get_args(Kind):
        clause = ", ".join(map(str, given)) or "nothing"
        raise ValueError(
            f"a range is one of {{ linspace = [a, b, n] }}, {{ grid = [v1, v2, ...] }}, {{ random = [a, b] }} and "
            f"{{ normal = [mean, deviation] }}, but the table has {clause[:40]}"
        )
    numbers = given[kind]
    if not isinstance(numbers, list | tuple):
        raise ValueError(f"{kind} takes a list of numbers in brackets")
    return _range(kind, numbers, lambda x: number(x, dimension))


def _range(kind: Kind, given: Sequence[object], read: Callable[[object], float]) -> Range:
    """The range of a list of numbers; raises ValueError with the arguments of the kind."""
    if kind == "linspace":
        if len(given) != 3 or isinstance(given[2], bool) or not isinstance(given[2], int) or given[2] < 1:
            clause = "the first value, the last, and how many (a whole number from 1 on)"
            raise ValueError(f"linspace takes [a, b, n]: {clause}")
        if given[2] > MOST_BALLS:
            raise ValueError(f"linspace of {given[2]} values: a sweep has {MOST_BALLS} balls at most")
        return Range(kind, (read(given[0]), read(given[1])), given[2])
    if kind == "grid":
        if not given:
            raise ValueError("grid takes one value or more")
        return Range(kind, tuple(map(read, given)), len(given))
    takes, where = ("[a, b]", ": the draws lie between them") if kind == "random" else ("[mean, deviation]", "")
    if len(given) != 2:
        raise ValueError(f"{kind} takes {takes}{where}")
    first, second = map(read, given)
    if kind == "random" and not first <= second:
        raise ValueError(f"random takes {takes} with a at most b")
    if kind == "normal" and second < 0:
        raise ValueError(f"normal takes {takes} with a deviation that is not negative")
    return Range(kind, (first, second))


def ranges_in(value: object, key: str) -> dict[str, Range]:
    """The ranges in a value of a scene, nested lists and all, by dotted key; numbers of lists count from 1 on."""
    if isinstance(value, Range):
        return {key: value}
    found: dict[str, Range] = {}
    if isinstance(value, tuple):
        for i, part in enumerate(value, start=1):
            found |= ranges_in(part, f"{key}.{i}")
    return found


@dataclass(frozen=True, eq=False)
class Sweep:
    """The values of some ranges for every ball: the product of those that span a dimension, the last of them the
    fastest, times `samples` where any is drawn.

    Each drawn range has a stream of random numbers of its own, given by `seed`, `stream` and its key, so that another
    range added to a scene changes no draw.  Raises ValueError for more than `MOST_BALLS` balls.
    """

    ranges: dict[str, Range]
    samples: int
    seed: int
    stream: str

    def __post_init__(self) -> None:
        if (balls := prod(self.shape)) > MOST_BALLS:  # may be more than `len` can return
            made = float(min(balls, 10**300))
            raise ValueError(f"the ranges make {made:.10g} balls; a sweep has {MOST_BALLS} at most")

    @property
    def shape(self) -> tuple[int, ...]:
        """The numbers of values along each dimension, and the samples last."""
        spans = tuple(one.count for one in self.ranges.values() if not one.drawn)
        return (*spans, self.samples if any(one.drawn for one in self.ranges.values()) else 1)

    def __len__(self) -> int:
        return prod(self.shape)

    def values(self) -> dict[str, Floats]:
        """The value of each range for each ball, (balls,), by key."""
        found: dict[str, Floats] = {}
        places = iter(np.unravel_index(np.arange(len(self)), self.shape))
        for key, one in self.ranges.items():
            if one.drawn:
                spawned = np.random.SeedSequence(self.seed, spawn_key=tuple(f"{self.stream}/{key}".encode()))
                found[key] = one.draw(len(self), np.random.Generator(np.random.PCG64(spawned)))
            else:
                found[key] = one.grid()[next(places)]
        return found
