"""Short calls, warm, one core: microseconds of a call of 1, 10 and 1000 steps, by a function and by a `Stepper`."""

import time
from functools import partial
from itertools import product

import numpy as np

import chapsym

from .harness import Contender, NotComparable, Run, Say, cores, interleaved
from .results import Reached, Result, beside
from .trajectory import GAMMA, MASS_TENSOR, MOMENTUM, D

#: |𝒦|, and the radius.
EPSILON, RADIUS = 0.05, 0.1
#: Steps of a call, and what a call of a Stepper is to cost at most, in µs.
CALLS = {1: 3.0, 10: 5.0, 1000: None}
PLAIN, STEPPER, FRAMES = "chapsym.trajectory", "Stepper.step", "Stepper.trajectory"
#: A new momentum, a step, and the state that it leads to, as a control loop has it.
STEP, LOOP = "chapsym.step", "Stepper: momentum, step, momentum and gamma"


def repeated(name: str, run: Run, seconds: float) -> Contender:
    """As many calls in a row as take this many seconds."""

    def calls(count: int) -> None:
        for _ in range(count):
            run()

    calls(3)
    start = time.thread_time()
    calls(3)
    count = max(1, round(3 * seconds / max(time.thread_time() - start, 1e-6)))
    return Contender(name, partial(calls, count), count, time.thread_time)


def sides(steps: int, contact: bool) -> dict[str, Run]:
    """A call of `steps` steps by each way; those of a Stepper go on from where it is."""
    ball, K = chapsym.Ball(MASS_TENSOR, D, RADIUS), EPSILON * MOMENTUM
    moved, framed, looped = (chapsym.Stepper(ball, K, GAMMA, contact=contact) for _ in range(3))
    found: dict[str, Run] = {
        PLAIN: partial(chapsym.trajectory, ball, K, GAMMA, steps, contact=contact),
        STEPPER: partial(moved.step, steps),
        FRAMES: partial(framed.trajectory, steps),
    }
    if steps == 1 and not contact:
        found |= {STEP: partial(chapsym.step, ball, K, GAMMA), LOOP: partial(ticked, looped, K)}
    return found


def ticked(stepper: chapsym.Stepper, momentum: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """One tick of a control loop."""
    stepper.momentum = momentum
    stepper.step()
    return stepper.momentum, stepper.gamma


def compare(steps: int, contact: bool) -> None:
    """Raises NotComparable unless both give the same states, to the bit."""
    ways = sides(steps, contact)
    runs = [ways[name]() for name in (PLAIN, FRAMES)]
    for name in ("momentum", "gamma", *(["contact"] if contact else [])):
        if not np.array_equal(*(getattr(run, name) for run in runs)):
            raise NotComparable(f"{FRAMES} differs from {PLAIN} after {steps} steps, in the {name}")


def measure(quick: bool, on_round: Say = lambda text: None) -> Result:
    """Times calls of each length, with the contact point and without."""
    seconds, rounds = (0.005, 5) if quick else (0.05, 21)
    rows, reach = [], []
    for contact, (steps, wanted) in product((False, True), CALLS.items()):
        setting = f"steps = {steps}" + (", with the contact point" if contact else "")
        on_round(f"calls, {setting}")
        compare(steps, contact)
        with cores(1):
            timings = interleaved([repeated(*side, seconds) for side in sides(steps, contact).items()], rounds)
        rows += beside(timings, PLAIN, "µs a call", {"steps": steps, "contact": contact})
        if wanted:
            reach.append(Reached(f"µs of {STEPPER}, {setting}", timings[STEPPER].median * 1e6, wanted, False))
    return Result("short calls, one core", rows, {}, reach)
