"""Rounding alone: each precision against the next but finer numbers, on the same steps of the map."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

from chapsym.accuracy.methods import label_of
from chapsym.dynamics import BadInput, Trajectory, trajectory
from chapsym.dynamics.certified import exactly
from chapsym.numbers import NAMED, Digits, Enclosure, Precision

from ..harness import Contender, cores, interleaved
from .frontier import Frontier, Point, digits_of
from .reference import sample

#: |ω|ε in radians.
STEP = 0.1
FINEST = Digits(120)
PRECISIONS: tuple[Precision, ...] = (
    *NAMED.values(),
    Digits(30),
    Digits(50),
    Digits(100),
    Enclosure(100),
    Enclosure(300),
)
#: How many steps of the cheap precisions make up a run that is timed: enough for a millisecond.
TIMED = {"single": 20_000, "double": 20_000, "quad": 4_000}


def measure(quick: bool, say: Callable[[str], None]) -> Frontier:
    """The digits that are left of 𝒦 and γ after some steps of the map, at each precision, and the time of a step."""
    request, steps, order = sample("state", 1.0), 50 if quick else 400, 2
    epsilon, missing = STEP / request.rate, []
    run = partial(trajectory, request.ball, epsilon * request.angular_momentum, request.gamma, order=order)
    say(f"rounding: the reference at {FINEST.count} digits, order {order}")
    exact = ends(run(steps, every=steps, precision=FINEST))
    contenders, digits = [], {}
    for precision in PRECISIONS:
        name = f"{_name(precision)}, order {order}"
        say(f"rounding: {name}")
        try:
            digits[name] = digits_of(_apart(ends(run(steps, every=steps, precision=precision)), exact), FINEST.count)
        except BadInput as error:
            missing.append(f"{name}: {error}")
            continue
        timed = TIMED.get(_name(precision), steps)
        contenders.append(Contender(name, partial(run, timed, every=timed, precision=precision), timed))
    with cores(1):
        times = interleaved(contenders, 1 if quick else 5, lambda done: say(f"rounding: round {done}"))
    points = [
        Point(name, STEP, times[name].median, times[name].median * request.rate / STEP, digits[name]) for name in digits
    ]
    notes = [f"{steps} steps of |ω|ε = {STEP:g}; reference: the same steps at {FINEST.count} digits", *missing]
    return Frontier("rounding alone", f"correct digits of 𝒦/|𝒦| and γ of the map after {steps} steps", points, notes)


def ends(run: Trajectory) -> np.ndarray:
    """𝒦 and γ of the last frame, six Fractions (the middles of balls)."""
    return np.concatenate([exactly(run, name)[-1] for name in ("momentum", "gamma")])


def _apart(a: np.ndarray, b: np.ndarray) -> float:
    """The largest error of 𝒦/|𝒦| and γ."""
    size = float(sum(x * x for x in b[:3])) ** 0.5
    errors = abs(a - b).astype(float)
    return float(max(errors[:3].max() / size, errors[3:].max()))


def _name(precision: Any) -> str:
    return f"ball{precision.bits}" if isinstance(precision, Enclosure) else label_of(precision)
