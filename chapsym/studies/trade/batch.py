"""A batch of balls against the continuous ball: every precision, order and length of step, on one core."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from chapsym.accuracy import Method, take
from chapsym.accuracy.methods import EXTRAPOLATED
from chapsym.dynamics import Ball, StepNotTaken, extrapolate, kernels, trajectory
from chapsym.numbers import Digits

from ..harness import Contender, cores, interleaved
from .balls import END, LONGEST, STAGE, choices, name_of
from .frontier import Frontier, Point, digits_of
from .reference import sample
from .requests import true_error, truth

Say = Callable[[str], None]
#: Balls, and those of them whose error is taken.
BATCH, SHOWN = 256, 4


def measure(quick: bool, say: Say) -> Frontier:
    """A batch: digits of K and γ of some of its balls, the worst of them, and the time of a ball's simulated second."""
    one = replace(sample("state", END), accuracy=1e-30)
    random, n = np.random.default_rng(5), 32 if quick else BATCH
    turned = random.normal(scale=0.1, size=(n, 3))
    gamma = one.gamma + np.cross(turned, one.gamma)
    gamma /= np.sqrt((gamma * gamma).sum(axis=-1, keepdims=True))
    gamma /= np.sqrt((gamma * gamma).sum(axis=-1, keepdims=True))
    K = kernels.contact_momentum(np.array([3.0, -2.0, 1.0]) + turned, gamma, one.ball.mass_tensor, one.ball.D)
    some = [replace(one, angular_momentum=K[i], gamma=gamma[i]) for i in range(1 if quick else SHOWN)]
    say("batch: the references")
    exact = [truth(request, 20) for request in some]
    contenders, errors = [], {}
    for method, steps in choices(one, quick):
        if isinstance(method.precision, Digits) or steps * method.stages * n * STAGE[method.label] > LONGEST[quick] / 4:
            continue
        name = f"{name_of(method)} at {steps}"
        say(f"batch: {name}")
        try:
            errors[method, steps] = max(
                true_error(request, take(request, method, steps, 1), found)
                for request, found in zip(some, exact, strict=True)
            )
        except StepNotTaken:
            continue
        contenders.append(Contender(name, partial(_all, one.ball, K, gamma, method, steps), n))
    with cores(1):
        times = interleaved(contenders, 1 if quick else 3, lambda done: say(f"batch: round {done}"))
    points = []
    for (method, steps), error in errors.items():
        took = times[f"{name_of(method)} at {steps}"].median
        points.append(Point(name_of(method), one.rate * END / steps, took / steps, took / END, digits_of(error, 19)))
    note = f"{n} balls, one core; error: the worst of {len(some)} of them"
    return Frontier(f"a batch of {n}", f"correct digits of K/|K| and γ after {END:g} s", points, [note])


def _all(ball: Ball, K: np.ndarray, gamma: np.ndarray, method: Method, steps: int) -> None:
    if method.order == EXTRAPOLATED:
        extrapolate(ball, K, gamma, END / steps, steps)
        return
    trajectory(
        ball, END / steps * K, gamma, steps, order=method.order, every=steps, precision=method.precision, threads=1
    )  # fmt: skip
