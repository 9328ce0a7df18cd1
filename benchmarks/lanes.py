"""Small and odd batches, with the contact point and without: nanoseconds a ball and step on one core."""

from collections.abc import Callable
from functools import partial
from typing import Any

import chapsym
from chapsym.studies.harness import Contender, cores, interleaved

from .batch import State, states
from .results import Reached, Result
from .trajectory import EPSILONS

#: Balls: less than a register, one, a little more, a block, a little more, and many blocks.
BALLS = (2, 8, 9, 40, 41, 1000)
RADIUS = 0.1
#: A state is kept every so many steps.
EVERY = 50
#: What the contact point may cost, to the same run without it, at the first of the EPSILONS and with many balls.
MOST = 2.2


def rolled(state: State, steps: int, contact: bool) -> Any:
    """The public trajectory of the batch."""
    K, g, J, D = state
    return chapsym.trajectory(chapsym.Ball(J, D, RADIUS), K, g, steps, every=EVERY, threads=1, contact=contact)


def measure(quick: bool, on_round: Callable[[str], None] = lambda text: None) -> Result:
    """Times batches of each size, with the contact point and without."""
    work, rounds = (100_000, 3) if quick else (2_000_000, 21)
    rows: list[dict[str, Any]] = []
    reach: list[Reached] = []
    for epsilon in EPSILONS:
        for balls in BALLS:
            on_round(f"{balls} balls, ε = {epsilon:g}")
            state, steps = states(balls, epsilon), max(2000 // balls + EVERY, work // max(balls, 40))
            with cores(1):
                timings = interleaved(
                    [
                        Contender(str(contact), partial(rolled, state, steps, contact), steps * balls)
                        for contact in (False, True)
                    ],
                    rounds,
                )
            alone, followed = timings["False"], timings["True"]
            ratio, lower, upper = followed.ratio_to(alone)
            rows.append(
                {
                    "ε": epsilon, "balls": balls, "ns a ball and step": alone.median * 1e9,
                    "with the contact point": followed.median * 1e9, "ratio": ratio, "quartiles": [lower, upper],
                }
            )  # fmt: skip
        if not reach:
            reach.append(
                Reached(f"{balls} balls, ε = {epsilon:g}: with the contact point / without", ratio, MOST, False)
            )
    return Result("small and odd batches, one core", rows, {}, reach)
