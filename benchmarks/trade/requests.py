"""Requests that the chooser has not seen: does it meet them, and what does it cost against the best possible choice?"""

import math
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from statistics import median

import numpy as np

from benchmarks import problems
from chapsym.accuracy import Accurate, Method, Request, accurate, methods, take
from chapsym.accuracy.answer import CHECKS, checks
from chapsym.dynamics import BadInput, kernels
from chapsym.files import Data
from chapsym.numbers import NAMED

from ..harness import Contender, Say, interleaved
from ..kernels import finite
from .frontiers import true_error, truth

SEED, COUNT, QUICK = 2007, 50, 5
#: The finest accuracy of most requests, and of one in FINER⁻¹.
COARSE, FINE, FINER = 1e-12, 1e-20, 0.25
#: A method whose steps would take longer than this many times the delivered run cannot be the best.
DEAREST = 1.2
#: Seconds below which no run is too long to try.
SHORT = 3e-3
ROUNDS = 3


@dataclass(frozen=True)
class Outcome:
    """A request, what the chooser made of it, and the best that could have been done.

    answer: or the sentence that refuses it.  error: the true one, at the worst of the times of comparison.
    best, seconds: the cheapest choice that would have done, and its time of the processor.
    """

    request: Request
    answer: Accurate | str
    error: float = math.inf
    best: str = ""
    seconds: float = math.inf

    @property
    def costs(self) -> tuple[float, float]:
        """Seconds of the processor for what was delivered, with its verification, and for everything."""
        if isinstance(self.answer, str):
            return math.inf, math.inf
        return self.answer.attempts[-1].seconds, self.answer.seconds

    def row(self) -> Data:
        """The row of the table."""
        chosen, estimate = "refused", math.inf
        if not isinstance(self.answer, str):
            chosen, estimate = _named(self.answer.choice.method, self.answer.choice.steps), self.answer.estimate
        delivered, total = self.costs
        return {
            "of": self.request.of, "s": self.request.time, "rad": self.request.angle, "wanted": self.request.accuracy,
            "chosen": chosen, "estimate": estimate, "error": self.error, "ms": delivered * 1e3, "in all": total * 1e3,
            "best": self.best, "ms of it": self.seconds * 1e3,
        }  # fmt: skip


def _named(method: Method, steps: int) -> str:
    return f"{method.label}, order {method.order}, {steps}"


def drawn(count: int, quick: bool) -> Iterator[Request]:
    """Random requests: 0.3 to 6 rad/s, 1 to 1000 s (20 s if quick), 1e-3 to 1e-12 or finer; conditions up to 100."""
    random = np.random.default_rng(SEED)
    for _ in range(count):
        ball, omega, gamma = problems.rolling(random)
        K = kernels.contact_momentum(omega, gamma, ball.mass_tensor, ball.D)
        seconds = float(10.0 ** random.uniform(0, 1.3 if quick else 3))
        finest = FINE if random.uniform() < FINER else COARSE
        accuracy = float(10.0 ** random.uniform(math.log10(finest), -3))
        yield Request(ball, K, gamma, seconds, accuracy, str(random.choice(["state", "contact"])))


def judge(request: Request) -> Outcome:
    """One request answered, its true error, and the best choice by brute force."""
    exact = truth(request)
    asked = request.ball, request.angular_momentum, request.gamma, request.time, request.accuracy
    try:
        answer = accurate(*asked, of=request.of, frames=CHECKS)
    except BadInput as error:
        return Outcome(request, str(error))
    best = best_choice(request, exact, max(DEAREST * answer.attempts[-1].seconds, SHORT))
    return Outcome(request, answer, true_error(request, answer.trajectory, exact), *best)


def best_choice(request: Request, exact: np.ndarray, dearest: float) -> tuple[str, float]:
    """The cheapest precision, order and number of steps whose true error is within the accuracy, and its seconds."""
    runs = []
    for method in (method for precision in NAMED.values() for method in methods(precision)):
        parts = checks(request, method)

        def error(steps: int, method: Method = method, parts: int = parts) -> float:
            return true_error(request, take(request, method, steps * parts, parts), exact)

        with suppress(BadInput):
            steps, _ = problems.fewest(error, request.accuracy, method.order, 1, dearest)
            if steps:
                run = partial(take, request, method, steps * parts, 1)
                runs.append(Contender(_named(method, steps * parts), run, 1, time.thread_time))
    times = interleaved(runs, ROUNDS).values()
    return min(((one.name, one.median) for one in times), key=lambda one: one[1], default=("none", math.inf))


class Outcomes:
    """The outcomes of random requests, of which some are met: their true error is within the accuracy."""

    def __init__(self, outcomes: list[Outcome]) -> None:
        self.outcomes = outcomes
        self.hits = sum(one.error <= one.request.accuracy for one in outcomes)
        self.title = f"random requests: {self.hits} of {len(outcomes)} met"

    def table(self) -> list[Data]:
        """A row for each request."""
        return [one.row() for one in self.outcomes]

    def sentences(self) -> list[str]:
        """Hits, and the cost against the best choice."""
        found = [f"{self.hits} of {len(self.outcomes)} within the accuracy"]
        found += [one.answer for one in self.outcomes if isinstance(one.answer, str)]
        if met := [one for one in self.outcomes if math.isfinite(one.seconds)]:
            run, whole = ([one.costs[i] / one.seconds for one in met] for i in (0, 1))
            found.append(f"what is delivered takes {median(run):.2f} times the best choice, at most {max(run):.2f}")
            found.append(f"with what was tried before {median(whole):.1f} times, at most {max(whole):.1f}")
        return found

    def as_json(self) -> Data:
        """The table and the hits as plain data."""
        rows = [{name: finite(value) for name, value in row.items()} for row in self.table()]
        found = {"title": self.title, "hits": self.hits, "count": len(self.outcomes)}
        return found | {"requests": rows, "notes": self.sentences()}


def measure(quick: bool, say: Say = lambda text: None, count: int = 0) -> Outcomes:
    """The outcomes of random requests: 5 short ones if quick, or 50."""
    wanted, found = count or (QUICK if quick else COUNT), []
    for i, request in enumerate(drawn(wanted, quick)):
        say(f"request {i + 1} of {wanted}: {request.accuracy:.1g} after {request.time:.3g} s")
        found.append(judge(request))
    return Outcomes(found)
