"""n = 4: the map on SO(4) × S³ is of order 2, in float64; its reference is its own step, halved and extrapolated."""

from collections.abc import Callable
from functools import partial
from itertools import pairwise

import numpy as np

from chapsym.dynamics import BallN, trajectory_n
from chapsym.dynamics.ball import Floats

from ..harness import Contender, NotComparable, cores, interleaved
from .frontier import Frontier, Point, digits_of

END = 2.0
BALL = ((1.0, 2.0, 0.5, 3.0), 3.0)
GAMMA = np.array([0.1, 0.1, 0.7, 0.7])
#: |K| is 0.36 and the least moment 1.5: steps up to 1 are taken.
STEPS = {True: (16, 64, 256), False: (16, 32, 64, 128, 256, 512, 1024, 2048, 4096)}
#: Numbers of steps of the reference, whose errors are even power series in the step.
REFERENCES = {True: (64, 128, 256, 512), False: (256, 512, 1024, 2048)}
BATCH = 64


def measure(quick: bool, say: Callable[[str], None], balls: int = 1) -> Frontier:
    """Digits of K and γ after END units of time, and the time of a unit for each ball of so many."""
    say("n = 4: the reference")
    exact, agreed = _reference(REFERENCES[quick])
    contenders, errors = [], {}
    for steps in STEPS[quick]:
        say(f"n = 4: {steps} steps")
        errors[steps] = float(abs(_end(1, steps) - exact).max())
        contenders.append(Contender(str(steps), partial(_end, balls, steps), balls))
    with cores(1):
        times = interleaved(contenders, 1 if quick else 3, lambda done: say(f"n = 4: round {done}"))
    points = []
    for steps in STEPS[quick]:
        took = times[str(steps)].median
        points.append(Point("double, order 2", END / steps, took / steps, took / END, digits_of(errors[steps], 13.0)))
    note = f"reference: {REFERENCES[quick]} steps extrapolated; with a column less it differs by {agreed:.0e}"
    title = "n = 4, one ball" if balls == 1 else f"n = 4, a batch of {balls}"
    return Frontier(title, f"correct digits of K and γ after {END:g} units of time", points, [note])


def _end(balls: int, steps: int) -> Floats:
    """K and γ at the end, flat, of the first of the balls."""
    K = np.zeros((4, 4))
    K[1, 0], K[3, 2], K[2, 0] = 0.3, -0.2, 0.1
    ball = BallN(mass_tensor=np.array(BALL[0]), D=np.array(BALL[1]))
    start = np.broadcast_to((K - K.T) * (END / steps), (balls, 4, 4))
    run = trajectory_n(ball, start, np.broadcast_to(GAMMA, (balls, 4)), steps, every=steps)
    return np.concatenate([(run.momentum[0, -1] * (steps / END)).ravel(), run.gamma[0, -1]])


def _reference(counts: tuple[int, ...]) -> tuple[Floats, float]:
    """Richardson's extrapolation in the square of the step; raises NotComparable if it does not settle."""
    row = [_end(1, n) for n in counts]
    before = row[-1]
    for k in range(1, len(counts)):
        row = [b + (b - a) / (4.0**k - 1) for a, b in pairwise(row)]
        before, last = row[-1], before
    agreed = float(abs(before - last).max())
    if not agreed < 1e-9:
        raise NotComparable(f"the reference of n = 4 does not settle: {agreed:.0e}")
    return before, agreed
