"""What may stand in a scene in the place of a number: a range, which makes a sweep."""

from collections.abc import Callable
from dataclasses import dataclass
from math import prod
from typing import Any, Literal

import numpy as np

from chapsym.dynamics.ball import Floats

from .units import Dimension, number

#: More balls than this are refused before anything is made.
MOST_BALLS = 10_000_000


@dataclass(frozen=True)
class Range:
    """kind: "linspace" (a, b, n) and "grid" (values) span a dimension of the sweep; "random" (a, b) and "normal"
    (mean, deviation) draw once for each ball.  values: in SI.  count: of those that span a dimension, else 0.
    """

    kind: Literal["linspace", "grid", "random", "normal"]
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
        with np.errstate(over="ignore", invalid="ignore"):  # what has no finite value is refused by its name
            return np.linspace(first, last, self.count)

    def draw(self, count: int, generator: np.random.Generator) -> Floats:
        """`count` values of a range that is drawn; sums and products only, so that machines agree."""
        first, second = self.values
        if self.kind == "random":
            return first + (second - first) * generator.random(count)
        return first + second * generator.standard_normal(count)


Value = float | Range


def value(given: Any, dimension: Dimension) -> Value:
    """A number, a text with a unit, or a table that is a range; raises ValueError with what would be right."""
    if not isinstance(given, dict):
        return number(given, dimension)
    if len(given) != 1 or (kind := next(iter(given))) not in _READ:
        told = ", ".join(map(str, given)) or "nothing"
        raise ValueError(
            f"a range is one of {{ linspace = [a, b, n] }}, {{ grid = [v1, v2, ...] }}, {{ random = [a, b] }} and "
            f"{{ normal = [mean, deviation] }}, but the table has {told[:40]}"
        )
    numbers = given[kind]
    if not isinstance(numbers, list | tuple):
        raise ValueError(f"{kind} takes a list of numbers in brackets")
    return _READ[kind](numbers, lambda x: number(x, dimension))


def _linspace(given: Any, read: Callable[[Any], float]) -> Range:
    if len(given) != 3 or isinstance(given[2], bool) or not isinstance(given[2], int) or given[2] < 1:
        raise ValueError("linspace takes [a, b, n]: the first value, the last, and how many (a whole number from 1 on)")
    if given[2] > MOST_BALLS:
        raise ValueError(f"linspace of {given[2]} values: a sweep has {MOST_BALLS} balls at most")
    return Range("linspace", (read(given[0]), read(given[1])), given[2])


def _grid(given: Any, read: Callable[[Any], float]) -> Range:
    if not given:
        raise ValueError("grid takes one value or more")
    return Range("grid", tuple(map(read, given)), len(given))


def _random(given: Any, read: Callable[[Any], float]) -> Range:
    if len(given) != 2:
        raise ValueError("random takes [a, b]: the draws lie between them")
    found = Range("random", (read(given[0]), read(given[1])))
    if not found.values[0] <= found.values[1]:
        raise ValueError("random takes [a, b] with a at most b")
    return found


def _normal(given: Any, read: Callable[[Any], float]) -> Range:
    if len(given) != 2:
        raise ValueError("normal takes [mean, deviation]")
    found = Range("normal", (read(given[0]), read(given[1])))
    if found.values[1] < 0:
        raise ValueError("normal takes [mean, deviation] with a deviation that is not negative")
    return found


_READ: dict[str, Callable[[Any, Callable[[Any], float]], Range]] = {
    "linspace": _linspace, "grid": _grid, "random": _random, "normal": _normal,
}  # fmt: skip


def ranges_in(value: Any, key: str) -> dict[str, Range]:
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

    Each drawn range has a stream of random numbers of its own, told by `seed`, `stream` and its key, so that another
    range added to a scene changes no draw.  Raises ValueError for more than `MOST_BALLS` balls.
    """

    ranges: dict[str, Range]
    samples: int
    seed: int
    stream: str

    def __post_init__(self) -> None:
        if len(self) > MOST_BALLS:
            raise ValueError(f"the ranges make {len(self)} balls; a sweep has {MOST_BALLS} at most")

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
        axis = 0
        for key, one in self.ranges.items():
            if one.drawn:
                spawned = np.random.SeedSequence(self.seed, spawn_key=tuple(f"{self.stream}/{key}".encode()))
                found[key] = one.draw(len(self), np.random.Generator(np.random.PCG64(spawned)))
                continue
            along = one.grid().reshape([-1 if i == axis else 1 for i in range(len(self.shape))])
            found[key] = np.broadcast_to(along, self.shape).reshape(-1)
            axis += 1
        return found
