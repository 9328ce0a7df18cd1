"""The choice: of the precisions and orders that are expected to be accurate enough, the cheapest."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from chapsym.renamed import in_words

from .methods import EXACT, EXTRAPOLATED, Method, checks, methods
from .pilot import Law
from .prices import PRECISIONS, Prices
from .request import Request

#: How many times longer the steps are with which a run is compared, for orders up to 4 and above: by theory their
#: error is 4 to 64 times larger.  Less tells too little: long steps may have errors that do not fall evenly.
LONGER = (2.0, math.sqrt(2.0))
#: The longer steps are to have this part of the accuracy: the expectation may be off.
MARGIN = 0.4
#: The part of the accuracy that rounding may take.
ROUNDING = 0.5
#: The step of the exact top, in radians: far enough from the fold, and cheap.
TOP = 0.2
#: Runs of more steps are refused.
MOST_STEPS = 2**53


@dataclass(frozen=True)
class Choice:
    """A method, the steps of the run that is delivered, those of the run that it is compared with, and the cost.

    time_step: of the run that is delivered, in seconds.  expected: the error that is expected of it.
    seconds: of the processor, expected for both runs.
    """

    method: Method
    steps: int
    coarse: int
    time_step: float
    expected: float
    seconds: float

    def sentence(self) -> str:
        """The choice for a reader."""
        named = {EXACT: "the exact top", EXTRAPOLATED: "extrapolated to order 12"}
        order = named.get(self.method.order, f"order {self.method.order}")
        return f"{in_words(self.method.label)}, {order}, {self.steps} steps of {self.time_step:.6g} s"


def choices(
    request: Request, laws: Mapping[int, Law], prices: Prices, least: Mapping[Method, int] | None = None,
    barred: frozenset[Method] = frozenset(),
) -> list[Choice]:  # fmt: skip
    """All methods that are expected to reach the accuracy, the cheapest first.

    least: of a method that was tried, the number of steps that it must exceed.  barred: what has failed.
    """
    found = [
        choice
        for precision in PRECISIONS
        for method in methods(request, precision)
        if method not in barred
        and method.order in laws
        and (choice := _one(request, method, laws[method.order], prices, (least or {}).get(method, 0)))
    ]
    return sorted(found, key=lambda choice: choice.seconds)


def _one(request: Request, method: Method, law: Law, prices: Prices, least: int) -> Choice | None:
    """The longest step that is expected to do, or None."""
    step = TOP / max(request.rate, 1 / request.time) if method.order == EXACT else law.step(MARGIN * request.accuracy)
    if not step > 0 or request.time / step > MOST_STEPS:
        return None
    coarse = multiple(request, method, max(request.time / step, least))
    steps = finer(request, method, coarse)
    if request.floor(method.precision, steps * method.walked, method.summed) > ROUNDING * request.accuracy:
        return None
    cost = 0.0
    for n in (coarse, steps):
        price = prices.of(method, request.with_body, max(request.rate * request.time / n, 1e-12))
        if price is None:
            return None
        cost += n * price + prices.call(method, request.with_body)
    expected = 0.0 if method.order == EXACT else law.error(request.time / steps)
    return Choice(method, steps, coarse, request.time / steps, expected, cost)


def multiple(request: Request, method: Method, steps: float) -> int:
    """The least number of steps from `steps` on that the checks divide."""
    every = checks(request, method)
    return every * max(1, math.ceil(steps / every))


def finer(request: Request, method: Method, coarse: int) -> int:
    """The steps of the run that is delivered, for one of `coarse` steps that it is compared with."""
    return multiple(request, method, coarse * LONGER[method.order > 4])
