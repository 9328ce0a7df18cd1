"""Small and odd batches and compositions, with the contact point and without: nanoseconds a step of the map."""

from collections.abc import Callable
from functools import partial
from typing import Any

import chapsym
from chapsym.studies.harness import Contender, cores, interleaved

from .batch import State, states
from .results import Reached, Result
from .trajectory import EPSILONS

#: (order, balls): less than a register, one, a little more, a block, a little more, and many blocks; compositions.
CASES = [(2, balls) for balls in (2, 8, 9, 40, 41, 1000)] + [(order, 1000) for order in (4, 6, 8)]
RADIUS = 0.1
#: A state is kept every so many steps.
EVERY = 50
#: What the contact point may cost, to the same run without it, at the first of the EPSILONS and with many balls; and
#: a stage of order 8, to a step of the map.
MOST, STAGE = 2.2, 2.0


def rolled(state: State, steps: int, order: int, contact: bool) -> Any:
    """The public trajectory of the batch."""
    K, g, J, D = state
    ball = chapsym.Ball(J, D, RADIUS)
    return chapsym.trajectory(ball, K, g, steps, order=order, every=EVERY, threads=1, contact=contact)


def measure(quick: bool, on_round: Callable[[str], None] = lambda text: None) -> Result:
    """Times batches of each size and order, with the contact point and without."""
    work, rounds = (100_000, 3) if quick else (2_000_000, 21)
    rows: list[dict[str, Any]] = []
    for epsilon in EPSILONS:
        for order, balls in CASES:
            on_round(f"{balls} balls, order {order}, ε = {epsilon:g}")
            stages = len(chapsym.substeps(order))
            state, steps = states(balls, epsilon), max(2000 // balls + EVERY, work // max(balls, 40)) // stages
            with cores(1):
                timings = interleaved(
                    [
                        Contender(str(contact), partial(rolled, state, steps, order, contact), steps * stages * balls)
                        for contact in (False, True)
                    ],
                    rounds,
                )
            alone, followed = timings["False"], timings["True"]
            ratio, lower, upper = followed.ratio_to(alone)
            rows.append(
                {
                    "ε": epsilon, "order": order, "balls": balls, "ns a ball and step": alone.median * 1e9,
                    "with the contact point": followed.median * 1e9, "ratio": ratio, "quartiles": [lower, upper],
                }
            )  # fmt: skip
    of = {(row["ε"], row["order"], row["balls"]): row for row in rows}
    first = EPSILONS[0]
    reach = [
        Reached(
            f"1000 balls, ε = {first:g}: with the contact point / without", of[first, 2, 1000]["ratio"], MOST, False
        )
    ]
    for epsilon in EPSILONS:
        stage, step = (of[epsilon, order, 1000]["ns a ball and step"] for order in (8, 2))
        reach.append(Reached(f"1000 balls, ε = {epsilon:g}: a stage of order 8 / a step", stage / step, STAGE, False))
    return Result("small and odd batches and compositions, one core", rows, {}, reach)
