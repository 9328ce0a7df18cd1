"""Requests that the chooser has not seen: does it meet them, and what does it cost against the best possible choice?"""

import contextlib
import math
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from statistics import median
from typing import Any

import numpy as np

from chapsym.accuracy import Accurate, Method, Request, accurate, methods, take
from chapsym.accuracy.methods import CHECKS, checks
from chapsym.accuracy.request import exact_values, lengths
from chapsym.dynamics import BadInput, Ball, StepNotTaken, Trajectory, kernels
from chapsym.numbers import NAMED

from .reference import continuous, sample

SEED, COUNT, QUICK = 2007, 50, 5
#: The finest accuracy of most requests, and of one in FINER⁻¹.
COARSE, FINE, FINER = 1e-12, 1e-20, 0.25
#: The reference has so many digits beyond the accuracy, and those that the flow may cost.
BEYOND = 3
#: The best choice is found to this factor in the number of steps.
GRID = 2**0.125
#: A method whose steps would take longer than so many times the delivered run cannot be the best.
DEAREST = 1.2
RUNS = 3
#: Seconds below which no run is too long to try.
SHORT = 3e-3


@dataclass(frozen=True)
class Outcome:
    """A request, what the chooser made of it, and the best that could have been done.

    error: the true one, at the worst of the times of comparison.  delivered, total: seconds of the processor for what
    was delivered, with its verification, and for everything.  best, seconds: the cheapest choice that would have done.
    """

    request: Request
    answer: Accurate | None
    refused: str | None
    error: float
    delivered: float
    total: float
    best: str
    seconds: float

    @property
    def chosen(self) -> str:
        """What the chooser chose."""
        if self.answer is None:
            return "refused"
        choice = self.answer.choice
        return f"{choice.method.label}, order {choice.method.order}, {choice.steps}"

    @property
    def hit(self) -> bool:
        """Whether the true error is within the accuracy."""
        return self.error <= self.request.accuracy


def drawn(count: int, seed: int = SEED, quick: bool = False) -> Iterator[Request]:
    """Random requests: 0.3 to 6 rad/s, 1 to 1000 s (20 s for a look), 1e-3 to 1e-12 or finer; conditions up to 100."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        tensor = 10.0 ** random.uniform(-3, -1.5, 3)
        mass, radius = random.uniform(0.2, 8.0), random.uniform(0.03, 0.2)
        ball = Ball.from_mass_tensor(tensor, mass=mass, radius=radius)
        gamma, direction = (x / np.sqrt(x @ x) for x in random.normal(size=(2, 3)))
        gamma /= np.sqrt(gamma @ gamma)
        omega = direction * 10.0 ** random.uniform(-0.5, 0.8)
        K = kernels.contact_momentum(omega, gamma, ball.mass_tensor, ball.D)
        seconds = float(10.0 ** random.uniform(0, 1.3 if quick else 3))
        finest = FINE if random.uniform() < FINER else COARSE
        accuracy = float(10.0 ** random.uniform(math.log10(finest), -3))
        yield Request(ball, K, gamma, seconds, accuracy, str(random.choice(["state", "contact"])))


def truth(request: Request, digits: int = 0) -> np.ndarray:
    """K, γ and the contact point at the times of comparison, (checks + 1, 8) Fractions."""
    wanted = digits or math.ceil(-math.log10(request.accuracy) + math.log10(1 + request.angle)) + BEYOND
    times = [Fraction(request.time) * k / CHECKS for k in range(CHECKS + 1)]
    attitude = None if isinstance(request.attitude, bool | np.bool_) else request.attitude
    return continuous(request.ball, request.angular_momentum, request.gamma, attitude, times, wanted)


def true_error(request: Request, run: Trajectory, exact: np.ndarray) -> float:
    """The error of a run in the request's norm, at the worst time of comparison that is a frame of the run."""
    exact = exact[:: CHECKS // (len(run.index) - 1)]
    if request.of == "contact":
        return float(lengths(exact_values(request, run, "contact") - exact[:, 6:]).max())
    size = float(lengths(request.angular_momentum))
    momentum = lengths(exact_values(request, run, "momentum") - exact[:, :3]) / size
    return float(max(momentum.max(), lengths(exact_values(request, run, "gamma") - exact[:, 3:6]).max()))


def judge(request: Request, compare: bool = True) -> Outcome:
    """One request answered, its true error, and (with `compare`) the best choice by brute force."""
    exact = truth(request)
    try:
        answer = accurate(
            request.ball, request.angular_momentum, request.gamma, request.time, request.accuracy, of=request.of,
            frames=CHECKS,
        )  # fmt: skip
    except BadInput as error:
        return Outcome(request, None, str(error), math.inf, math.inf, math.inf, "", math.inf)
    delivered, run = answer.attempts[-1].seconds, answer.trajectory
    best, seconds = best_choice(request, exact, delivered) if compare else ("", math.nan)
    return Outcome(request, answer, None, true_error(request, run, exact), delivered, answer.seconds, best, seconds)


def best_choice(request: Request, exact: np.ndarray, delivered: float) -> tuple[str, float]:
    """The cheapest precision, order and number of steps whose true error is within the accuracy, and its seconds."""
    found = []
    for precision in NAMED.values():
        for method in methods(request, precision):
            steps = _fewest(request, method, exact, max(DEAREST * delivered, SHORT))
            if steps:
                took = seconds_of(lambda: take(request, method, steps, 1))  # noqa: B023
                found.append((took, f"{method.label}, order {method.order}, {steps}"))
    return (min(found)[1], min(found)[0]) if found else ("none", math.inf)


def _fewest(request: Request, method: Method, exact: np.ndarray, dearest: float) -> int:
    """The fewest steps that are accurate enough; 0 if none are within the time."""

    def good(power: int) -> bool | None:
        started = time.thread_time()
        try:
            run = take(request, method, steps(power), checks(request, method))
        except (StepNotTaken, BadInput):
            return False
        took = time.thread_time() - started
        if true_error(request, run, exact) <= request.accuracy:
            return True
        return None if took > dearest else False

    def steps(power: int) -> int:
        return checks(request, method) * math.ceil(GRID**power)

    high = 0
    while not (found := good(high)):
        if found is None or GRID**high > 1e7:
            return 0
        high += 8
    low = max(high - 8, -1)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if good(middle) else (middle, high)
    return steps(high)


def seconds_of(run: Callable[[], Any]) -> float:
    """The median time of the processor."""
    taken = []
    for _ in range(RUNS):
        start = time.thread_time()
        run()
        taken.append(time.thread_time() - start)
    return median(taken)


@dataclass(frozen=True)
class Outcomes:
    """The outcomes of random requests."""

    outcomes: list[Outcome]

    @property
    def hits(self) -> int:
        """How many were met."""
        return sum(one.hit for one in self.outcomes)

    @property
    def title(self) -> str:
        """The title of the table."""
        return f"random requests: {self.hits} of {len(self.outcomes)} met"

    def table(self) -> list[dict[str, Any]]:
        """A row for each request."""
        return [
            {
                "of": one.request.of, "s": one.request.time, "rad": one.request.angle, "wanted": one.request.accuracy,
                "chosen": one.chosen, "estimate": one.answer.estimate if one.answer else math.inf, "error": one.error,
                "ms": one.delivered * 1e3, "in all": one.total * 1e3, "best": one.best, "ms of it": one.seconds * 1e3,
            }
            for one in self.outcomes
        ]  # fmt: skip

    def ratios(self) -> tuple[list[float], list[float]]:
        """The time of the delivered run, and of everything, to that of the best choice; the first sorted."""
        met = [one for one in self.outcomes if one.answer and math.isfinite(one.seconds)]
        return sorted(one.delivered / one.seconds for one in met), sorted(one.total / one.seconds for one in met)

    def sentences(self) -> list[str]:
        """Hits, and the cost against the best choice."""
        (run, whole), told = self.ratios(), [one.refused for one in self.outcomes if one.refused]
        found = [f"{self.hits} of {len(self.outcomes)} within the accuracy", *told]
        if run:
            found.append(f"what is delivered takes {median(run):.2f} times the best choice, at most {run[-1]:.2f}")
            found.append(f"with what was tried before {median(whole):.1f} times, at most {whole[-1]:.1f}")
        return found

    def as_json(self) -> dict[str, Any]:
        """The table and the hits as plain data."""
        rows = [
            {k: v if isinstance(v, str) or abs(v) < 1e300 else None for k, v in sorted(row.items(), key=_is_text)}
            for row in self.table()
        ]
        return {
            "title": self.title,
            "hits": self.hits,
            "count": len(self.outcomes),
            "requests": rows,
            "notes": self.sentences(),
        }


def _is_text(item: tuple[str, Any]) -> bool:
    return isinstance(item[1], str)


def measure(quick: bool, say: Callable[[str], None] = lambda text: None, seed: int = SEED, count: int = 0) -> Outcomes:
    """The outcomes of random requests: 5 short ones for a look, or 50."""
    wanted = count or (QUICK if quick else COUNT)
    say("loading the loops")
    warm()
    found = []
    for i, request in enumerate(drawn(wanted, seed, quick)):
        say(f"request {i + 1} of {wanted}: {request.accuracy:.1g} after {request.time:.3g} s")
        found.append(judge(request))
    return Outcomes(found)


def warm() -> None:
    """Loads the compiled loops, which a short first run would do without."""
    for of in ("state", "contact"):
        request = sample(of, 1.0)
        for precision in NAMED.values():
            for method in methods(request, precision):
                with contextlib.suppress(StepNotTaken, BadInput):
                    take(request, method, 4000 // method.stages, 1)
