"""Choices measured: points of time against digits, the frontier among them, and the choices that are dominated."""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from chapsym.dynamics import BadInput, StepNotTaken
from chapsym.files import Data

from ..harness import Run
from ..results import timed

Say = Callable[[str], None]
#: The digits of the table's rows.
EVERY = (3, 6, 9, 12, 15, 18, 21, 24, 27, 30, 50, 100)


@dataclass(frozen=True, eq=False)
class Choice:
    """A choice to measure: its name (precision and order), how its error is found, and a run of a number of steps.

    step: |ω|ε in radians; time: of the run, in seconds of the ball.
    """

    name: str
    step: float
    steps: int
    time: float
    error: Callable[[], float]
    run: Run


@dataclass(frozen=True)
class Point:
    """One choice: its name, its step, what it costs and how many digits it gives.

    per_step, per_time: seconds a step, and a unit of simulated time, of one ball.  digits: -log₁₀ of the error.
    """

    name: str
    step: float
    per_step: float
    per_time: float
    digits: float


@dataclass(frozen=True)
class Frontier:
    """The results of a section: all points, and the notes on them.

    question: what the digits are of.  notes: the reference and how it was confirmed.
    """

    title: str
    question: str
    points: list[Point]
    notes: list[str]

    @property
    def best(self) -> list[Point]:
        """The points that no other one beats in both, from the cheapest."""
        return [p for p in self._sorted() if not any(dominates(q, p) for q in self.points)]

    @property
    def dominated(self) -> dict[str, str]:
        """Every choice that has no point on the frontier, and one that takes no longer for as many digits."""
        best, found = self.best, {}
        for name in dict.fromkeys(p.name for p in self.points if p.name not in {q.name for q in best}):
            finest = max((p for p in self.points if p.name == name), key=lambda p: p.digits)
            found[name] = next(p.name for p in best if dominates(p, finest))
        return found

    def _sorted(self) -> list[Point]:
        return sorted(self.points, key=lambda p: (p.per_time, -p.digits))

    def cheapest(self, digits: float) -> Point | None:
        """The cheapest point with at least this many digits, or None."""
        return next((p for p in self._sorted() if p.digits >= digits), None)

    def table(self) -> list[Data]:
        """The cheapest choice for each number of digits that some choice gives."""
        return [
            {
                "digits": digits, "cheapest": p.name, "|ω|ε": p.step, "µs a step": p.per_step * 1e6,
                "µs a unit of time": p.per_time * 1e6, "has": p.digits,
            }
            for digits in EVERY
            if (p := self.cheapest(digits)) is not None
        ]  # fmt: skip

    def sentences(self) -> list[str]:
        """The sentences on dominated points, and the notes."""
        named = [f"dominated: {name} (by {better})" for name, better in self.dominated.items()]
        return [self.question, *named, *self.notes]

    def as_json(self) -> Data:
        """The section as plain data; the points carry whether they are on the frontier."""
        points = [vars(p) | {"frontier": p in self.best} for p in self.points]
        clause = {"title": self.title, "question": self.question, "points": points}
        return clause | {"dominated": self.dominated, "notes": self.notes}


def dominates(p: Point, q: Point) -> bool:
    """Whether p gives as many digits in as little time, and more of one or less of the other."""
    no_worse = p.per_time <= q.per_time and p.digits >= q.digits
    return no_worse and (p.per_time < q.per_time or p.digits > q.digits)


def digits_of(error: float, most: float) -> float:
    """-log₁₀ of an error, between 0 and what the reference can tell."""
    return float(min(most, max(0.0, -math.log10(error)))) if error > 0 else most


def frontier(
    title: str, question: str, notes: list[str], choices: Iterable[Choice], most: float, rounds: int, say: Say,
    balls: int = 1,
) -> Frontier:  # fmt: skip
    """Measures choices, on one core, each for a number of balls; those whose steps are not taken are left out.

    most: the digits that the reference can tell.
    """
    digits, notes = {}, [*notes]
    for one in choices:
        say(f"{title}: {one.name}, {one.steps} steps")
        try:
            digits[one] = digits_of(one.error(), most)
        except StepNotTaken:
            continue
        except BadInput as error:
            notes.append(f"{one.name}: {error}")
    runs = {f"{one.name} at {one.steps}": (one.run, balls) for one in digits}
    points = []
    for one, timing in zip(digits, timed(runs, rounds, say, title).values(), strict=True):
        points.append(Point(one.name, one.step, timing.median / one.steps, timing.median / one.time, digits[one]))
    return Frontier(title, question, points, notes)
