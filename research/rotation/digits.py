"""How many digits a plateau needs, and the cost of a step at a number of digits."""

from collections.abc import Sequence
from statistics import median
from time import process_time

from flint import arb, ctx

from chapsym.dynamics import BadInput
from chapsym.files import Data

from .circle import Given, Level, number
from .plateau import decades, plateau, symmetric_starts

#: Digits above those that the displacement has, from which the search for the fewest goes down; and where it ends.
ABOVE, FEWEST = 15, 4
#: Steps that are timed together, and how often.
TIMED, REPEATS = 60, 5


def measured(tensor: Sequence[Given], D: Given, height: Given, steps: int, turns: int, in_height: bool = False) -> Data:
    """`plateau`, with the fewest working digits at which it is seen."""
    found = plateau(tensor, D, height, steps, turns, in_height)
    return {**found, "needed": needed(found)}


def needed(found: Data) -> int:
    """The fewest digits from which on the two displacements are seen: each off by less than half of it."""
    digits = ABOVE - decades(abs(number(found["displacement"][0])))
    while digits > FEWEST and seen(found, digits - 1):
        digits -= 1
    return digits


def seen(found: Data, digits: int) -> bool:
    """Whether both symmetric orbits are displaced as they should be, computed with this many digits."""
    with ctx.workdps(digits):
        level = Level(found["tensor"], found["D"], found["height"], found["level"])
        steps, turns = found["steps"], found["half_turns"]
        try:
            got = [level.displacement(x, steps, turns) for x in symmetric_starts(level, steps)]
        except BadInput:  # the secant method has no digits left for the second start
            return False
    true = [number(x) for x in found["displacement"]]
    return all(abs(x - y) < abs(y) / 2 for x, y in zip(got, true, strict=True))


def times(tensor: Sequence[Given], D: Given, height: Given, level: Given, digits: Sequence[int]) -> list[Data]:
    """Seconds of a processor for a step on the sphere at this many digits: the median of some runs."""
    found = []
    for n in digits:
        with ctx.workdps(n):
            at = Level(tensor, D, height, level)
            found.append({"digits": n, "seconds": float(f"{median(_run(at) for _ in range(REPEATS)):.3g}")})
    return found


def _run(level: Level) -> float:
    gamma, start = level.point(arb(1)), process_time()
    for _ in range(TIMED):
        gamma = level.step(gamma)
    return (process_time() - start) / TIMED
