"""To an accuracy: choose, run, compare the run with one of longer steps, and escalate until the difference is small.

A run is delivered only if its difference from one with longer steps, by theory with 4 to 64 times its error, and what
rounding is expected to leave are together within the accuracy, at every time at which the two are compared.  So the
error is within the accuracy if the shorter steps at least halve it.
"""

from __future__ import annotations

import time as clock
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from chapsym.dynamics import BadInput, Ball, StepNotTaken, Trajectory
from chapsym.dynamics.results import some_frames
from chapsym.numbers import Digits, Double, Single

from .choice import Choice
from .methods import COMPOSED, EXACT, checks
from .pilot import pilot, surveyed
from .prices import Prices, load_prices
from .request import Request, exact_values
from .search import Attempt, Search

#: A run that fails for a reason that is not foreseen is tried so many times.
MOST_ATTEMPTS = 12


@dataclass(frozen=True, eq=False)
class Accurate:
    """A run that meets its request.

    trajectory: at the times asked for, with order 12 for `extrapolate` and 0 for `exact_top`.
    choice: precision, order and step.  estimate: of the error, at the worst of the times, in the norm of the request,
    by comparison with longer steps; in float64 the other run starts 8 roundings beside this one, so that what a start
    that is sensitive makes of rounding is seen.  Where rounding is all that is left, the estimate is one draw of it:
    the error may be a few times that.
    attempts: all that was tried, the last of them the one that is delivered.
    seconds: of the processor, for everything: the pilot, all attempts, their verification.
    """

    trajectory: Trajectory
    request: Request
    attempts: list[Attempt]
    seconds: float

    @property
    def choice(self) -> Choice:
        """What was delivered."""
        return self.attempts[-1].choice

    def final(self) -> dict[str, list[Any]]:
        """K, γ and the contact point at the end: floats, or decimal strings where a float would not hold them."""
        names = {"angular_momentum": "momentum", "gamma": "gamma", "contact": "contact"}
        run, precision = self.trajectory, self.choice.method.precision
        there = {told: name for told, name in names.items() if getattr(run, name) is not None}
        values = {told: exact_values(self.request, run, name)[-1] for told, name in there.items()}
        if isinstance(precision, Single | Double):
            return {told: [float(x) for x in v] for told, v in values.items()}
        written = Digits(precision.digits)
        return {told: [written.write(written.number(x)) for x in v] for told, v in values.items()}

    @property
    def estimate(self) -> float:
        """Of the error, by comparison."""
        return self.attempts[-1].estimate


def accurate(
    ball: Ball,
    angular_momentum: ArrayLike,
    gamma: ArrayLike,
    time: float,
    accuracy: float,
    *,
    of: str = "state",
    frames: int = 1,
    attitude: bool | ArrayLike = False,
    limit: float = 600.0,
    prices: Prices | None = None,
    progress: Callable[[str], None] = lambda text: None,
) -> Accurate:
    """Follows the continuous ball (2.3) for `time` seconds to an absolute `accuracy`, at the least expected cost.

    angular_momentum: K in kg m²/s, (3,); gamma: the unit vertical, upwards, (3,).
    of: "state", the larger of |ΔK|/|K| and |Δγ|; or "contact", the distance of the contact points in metres (it needs
    `ball.radius`).  frames: how many equal times, the last of them `time`; the accuracy is promised at each.
    attitude: True or a unit quaternion, (4,), to be followed; it is not part of the norm.
    limit: seconds that the run may be expected to take.  prices: of this machine; `load_prices` by default.

    The result is verified on the run itself (see `Accurate`).  Raises BadInput for a request that cannot be met: one
    that would take longer than the limit, or that is finer than every precision.
    """
    started = clock.thread_time()
    request = Request(ball, angular_momentum, gamma, time, accuracy, of, frames, attitude)  # type: ignore[arg-type]
    search = _search(request, limit, prices, progress)
    request = search.request
    for _ in range(MOST_ATTEMPTS):
        choice = search.choose(limit - (clock.thread_time() - started), limit)
        progress(choice.sentence())
        run = search.attempt(choice)
        if run is not None:
            kept = some_frames(run, slice(None, None, checks(request, choice.method) // request.frames))
            return Accurate(kept, request, search.attempts, clock.thread_time() - started)
    best = min(one.estimate for one in search.attempts)
    raise BadInput(f"no run was verified to {accuracy:g} in {MOST_ATTEMPTS} attempts; the best differed by {best:.2g}")


def foreseen(
    ball: Ball,
    angular_momentum: ArrayLike,
    gamma: ArrayLike,
    time: float,
    accuracy: float,
    *,
    of: str = "state",
    frames: int = 1,
    attitude: bool | ArrayLike = False,
    limit: float = 600.0,
    prices: Prices | None = None,
    progress: Callable[[str], None] = lambda text: None,
) -> Choice:
    """What `accurate` would try first, by a pilot run alone; arguments and errors as there."""
    request = Request(ball, angular_momentum, gamma, time, accuracy, of, frames, attitude)  # type: ignore[arg-type]
    return _search(request, limit, prices, progress).choose(limit, limit)


def _search(request: Request, limit: Any, prices: Prices | None, progress: Callable[[str], None]) -> Search:
    """The choices that a survey and a pilot run leave."""
    number = isinstance(limit, int | float | np.integer | np.floating) and not isinstance(limit, bool)
    if not number or not limit > 0:
        raise BadInput(f"limit must be a positive number of seconds, not {limit!r}")
    prices = prices or load_prices(progress)
    progress("a pilot run")
    try:
        request = surveyed(request)
        search = Search(request, pilot(request, (EXACT, *COMPOSED)), prices)
        search.consider_extrapolation()
    except StepNotTaken as error:
        raise BadInput(f"the ball cannot be followed at all: {error.status.sentence}") from None
    return search
