"""The attempts of one request: each is run, compared with longer steps, and what it teaches corrects the next."""

import math
import time as clock
from dataclasses import dataclass, field, replace

from chapsym.dynamics import BadInput, Status, StepNotTaken, Trajectory
from chapsym.dynamics.levels.double import SHORT_RUN
from chapsym.numbers import Double

from .choice import Choice, choices, finer
from .methods import COMPOSED, EXTRAPOLATED, Method, checks, methods, take
from .pilot import Law, pilot
from .prices import Prices
from .request import Request, distance

#: The next attempt of a method has at least so many times the steps.
PROGRESS = 1.3
#: Below this, in seconds, no pilot of the extrapolation pays.
PILOT = 5e-4
#: From this on, in seconds, the first few choices are timed on the ball itself, each for this part of its run.
TRIAL, FIRST, PART = 5e-3, 3, 0.05
#: A trial takes about so many seconds at most; and prices are right to this factor.
LONGEST, SURELY = 0.05, 10.0
#: If rounding is more than this part of a difference, shorter steps do not help.
FLOORS = 4.0
#: How many roundings beside the start a run in float64 begins that verifies another: a ball that is sensitive shows it.
ROUNDED = 8
#: No expectation is corrected by more than this at once: the difference of a coarse run may be anything.
MOST_CORRECTED = 1e4


@dataclass(frozen=True)
class Attempt:
    """A choice, the estimate of its error (infinite if a step could not be taken), and the seconds of the processor."""

    choice: Choice
    estimate: float
    seconds: float


@dataclass
class Search:
    """What the attempts have taught so far.

    least: of each method that was tried, the steps that its next coarse run must have.  barred: methods that failed.
    paid: how much dearer the steps of a method are for this ball than the prices say.  last: the finest run so far.
    """

    request: Request
    laws: dict[int, Law]
    prices: Prices
    attempts: list[Attempt] = field(default_factory=list)
    least: dict[Method, int] = field(default_factory=dict)
    barred: frozenset[Method] = frozenset()
    paid: dict[Method, float] = field(default_factory=dict)
    last: tuple[Method, int, Trajectory] | None = None

    def consider_extrapolation(self) -> None:
        """Pilots the extrapolation too, where what else there is costs more than that."""
        found = choices(self.request, self.laws, self.prices)
        if not (found and found[0].seconds < PILOT):
            self.laws |= pilot(self.request, (EXTRAPOLATED,))

    def choose(self, left: float, limit: float) -> Choice:
        """The cheapest choice; raises BadInput if there is none, or none within the seconds that are left."""
        request, found = self.request, choices(self.request, self.laws, self.prices, self.least, self.barred)
        if found and found[0].seconds < SURELY * left:
            found = self._timed(found)
        if not found:
            raise BadInput(
                f"an accuracy of {request.accuracy:g} after {request.time:g} s cannot be had: it takes too many steps, "
                "or rounding alone is larger at every precision"
            )
        if found[0].seconds > left:
            raise BadInput(
                f"the cheapest run ({found[0].sentence()}) would take about {found[0].seconds:.2g} s, "
                f"but the limit is {limit:g} s; ask for less accuracy or time, or raise the limit"
            )
        return found[0]

    def _timed(self, found: list[Choice]) -> list[Choice]:
        """The choices, the cheapest first, where it matters by the times of this very ball."""
        if not found or found[0].seconds < TRIAL:
            return found
        for choice in found[:FIRST]:
            if choice.method not in self.paid and choice.seconds < found[0].seconds * 4:
                self.paid[choice.method] = self._trial(choice)
        repriced = [replace(one, seconds=one.seconds * self.paid.get(one.method, 1.0)) for one in found]
        return sorted(repriced, key=lambda one: one.seconds)

    def _trial(self, choice: Choice) -> float:
        """How many times the price the steps of a choice cost, by a short run."""
        method, request = choice.method, self.request
        least = -(-2 * SHORT_RUN // method.stages)  # enough that the compiled loop is taken
        part = min(PART, LONGEST / choice.seconds)
        steps = min(choice.steps, max(least, int(part * choice.steps)))
        price = self.prices.of(method, request.with_body, request.rate * choice.time_step)
        try:
            take(request, method, 1, 1, choice.time_step)
            started = clock.thread_time()
            take(request, method, steps, 1, steps * choice.time_step)
        except StepNotTaken:
            return 1.0
        took = clock.thread_time() - started - self.prices.call(method, request.with_body)
        return max(took / steps / price, 0.1) if price else 1.0

    def attempt(self, choice: Choice) -> Trajectory | None:
        """Runs and compares; returns the run if it is verified, and learns from it if not."""
        request, method = self.request, choice.method
        started = clock.thread_time()
        coarse = None
        beside = self.request
        if isinstance(method.precision, Double):
            beside = request.beside(ROUNDED)
        elif self.last is not None and self.last[0] == method and choice.coarse <= self.last[1]:
            _, n, coarse = self.last
            steps = finer(request, method, n)
            choice = replace(choice, coarse=n, steps=steps, time_step=request.time / steps)
        try:
            coarse = coarse or take(beside, method, choice.coarse, checks(request, method))
            run = take(request, method, choice.steps, checks(request, method))
        except StepNotTaken as error:
            if error.status == Status.NO_INERTIA:
                raise BadInput(f"the ball cannot be followed: {error}") from None
            self.attempts.append(Attempt(choice, math.inf, clock.thread_time() - started))
            self.least[method] = choice.steps
            return None
        apart = float(distance(request, run, coarse).max())
        floor = request.floor(method.precision, choice.steps * method.walked, method.summed)
        self.attempts.append(Attempt(choice, apart + floor, clock.thread_time() - started))
        if apart + floor <= request.accuracy:
            return run
        self.last = (method, choice.steps, run)
        self._learn(choice, apart, floor)
        return None

    def _learn(self, choice: Choice, apart: float, floor: float) -> None:
        """Corrects the laws by what was measured, and bars what cannot be better for rounding."""
        method = choice.method
        believed = self.laws[method.order].error(self.request.time / choice.coarse)
        if 0 < believed < math.inf:
            factor = min(max(apart / believed, 1.0), MOST_CORRECTED)
            self.laws = {order: law.scaled(factor) for order, law in self.laws.items()}
        self.least[method] = math.ceil(PROGRESS * choice.coarse)
        if floor * FLOORS > apart or self._stuck(choice):
            composed = [m for m in methods(self.request, method.precision) if m.order in COMPOSED]
            self.barred |= frozenset(composed if method.order in COMPOSED else [method])

    def _stuck(self, choice: Choice) -> bool:
        """Whether an earlier attempt of the same method, with steps longer enough, was nearly as good."""
        now = self.attempts[-1].estimate
        return any(
            (choice.steps / one.choice.steps) ** (choice.method.order or 2) >= 4 and now > 0.5 * one.estimate
            for one in self.attempts[:-1]
            if one.choice.method == choice.method and math.isfinite(one.estimate)
        )
