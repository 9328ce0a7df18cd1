"""The sections that have a frontier: rounding alone, one ball and a batch against the continuous ball."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from chapsym.accuracy import Method, Request, methods, take
from chapsym.accuracy.answer import CHECKS, label_of
from chapsym.accuracy.motion import EXTRAPOLATED
from chapsym.dynamics import Ball, Trajectory, extrapolate, kernels, trajectory
from chapsym.dynamics.certified import exactly
from chapsym.numbers import NAMED, Digits, Enclosure, Precision

from ..harness import Run
from .frontier import Choice, Frontier, Say, frontier
from .reference import sample, true_error, truth

#: The measurement of rounding alone: |ω|ε in radians, the reference, and the precisions.
STEP, FINEST = 0.1, Digits(120)
PRECISIONS: tuple[Precision, ...] = (
    *NAMED.values(), Digits(30), Digits(50), Digits(100), Enclosure(100), Enclosure(300),
)  # fmt: skip
#: How many steps of the cheap precisions make up a run that is timed: enough for a millisecond.
TIMED = {NAMED["single"]: 20_000, NAMED["double"]: 20_000, NAMED["double-double"]: 4_000}
#: Seconds of simulated time of one ball, and of a batch.
END = 10.0
#: Lengths of steps, |ω|ε in radians: quick and full.
LENGTHS = {True: (0.4, 0.1, 0.03), False: (1.0, 0.7, 0.5, 0.35, 0.25, 0.18, 0.125, 0.09, 0.06, 0.04, 0.02, 0.01, 0.003)}
#: The most seconds that a run of a precision may be expected to take, by these seconds a stage.
STAGE = {"single": 5e-8, "double": 5e-8, "quad": 3e-7, "digits30": 3e-4, "digits50": 3e-4}
LONGEST = {True: 0.02, False: 1.0}
#: The digits of the reference of one ball, and of a batch, as K and γ of its balls are floats.
DIGITS, OF_BATCH = 34, 19
#: Balls of a batch, and those of them whose error is taken.
BATCH, SHOWN = 256, 4


def rounding(quick: bool, say: Say) -> Frontier:
    """The digits that are left of 𝒦 and γ after some steps of the map, at each precision, and the time of a step."""
    request, steps = sample("state", 1.0), 50 if quick else 400
    epsilon = STEP / request.rate
    run = partial(trajectory, request.ball, epsilon * request.angular_momentum, request.gamma)
    say(f"rounding: the reference at {FINEST.count} digits")
    exact = ends(run(steps, every=steps, precision=FINEST))
    size = float(sum(x * x for x in exact[:3])) ** 0.5

    def choice(precision: Precision) -> Choice:
        name = f"ball{precision.bits}" if isinstance(precision, Enclosure) else label_of(precision)
        timed = TIMED.get(precision, steps)

        def error() -> float:
            apart = abs(ends(run(steps, every=steps, precision=precision)) - exact).astype(float)
            return float(max(apart[:3].max() / size, apart[3:].max()))

        timed_run = partial(run, timed, every=timed, precision=precision)
        return Choice(f"{name}, order 2", STEP, timed, timed * epsilon, error, timed_run)

    question = f"correct digits of 𝒦/|𝒦| and γ of the map after {steps} steps"
    notes = [f"{steps} steps of |ω|ε = {STEP:g}; reference: the same steps at {FINEST.count} digits"]
    rounds = 1 if quick else 5
    return frontier("rounding alone", question, notes, map(choice, PRECISIONS), FINEST.count, rounds, say)


def proved(quick: bool, say: Say) -> Frontier:
    """The digits of 𝒦 and γ that are proved after some steps of the map, and the time of a step with its proof."""
    request, steps = sample("state", 1.0), 50 if quick else 400
    epsilon = STEP / request.rate
    momentum = epsilon * request.angular_momentum
    size = float(np.linalg.norm(momentum))
    run = partial(trajectory, request.ball, momentum, request.gamma)

    def choice(precision: Precision) -> Choice:
        enclosed = isinstance(precision, Enclosure)
        timed = steps if enclosed else TIMED[NAMED["double-double"]]
        ask = partial(run, precision=precision, proved=not enclosed)

        def error() -> float:
            found = ask(steps, every=steps)
            if (bounds := found.proved) is None:
                radii = [[float(x.rad()) for x in v[-1]] for v in (found.momentum, found.gamma)]
                return max(max(radii[0]) / size, *radii[1])
            return float(max(bounds.momentum[-1] / size, bounds.gamma[-1]))

        name = f"ball{precision.bits}" if isinstance(precision, Enclosure) else label_of(precision)
        return Choice(f"{name}, proved", STEP, timed, timed * epsilon, error, partial(ask, timed, every=timed))

    question = f"proved digits of 𝒦/|𝒦| and γ of the map after {steps} steps"
    notes = [f"{steps} steps of |ω|ε = {STEP:g}"]
    precisions = (NAMED["double"], NAMED["double-double"], Enclosure(100), Enclosure(300))
    return frontier("proved", question, notes, map(choice, precisions), FINEST.count, 1 if quick else 5, say)


def ends(run: Trajectory) -> np.ndarray:
    """𝒦 and γ of the last frame, six Fractions (the middles of balls)."""
    return np.concatenate([exactly(run, name)[-1] for name in ("momentum", "gamma")])


def one_ball(of: str, quick: bool, say: Say) -> Frontier:
    """One ball: digits of the contact point, or of the state, after END seconds, and the time of a simulated second."""
    request = replace(sample(of, END), accuracy=1e-30, frames=1)
    say(f"{of}: the reference")
    exact = truth(request, DIGITS)
    choices = (
        _choice(
            request, method, steps,
            lambda method=method, steps=steps: true_error(request, take(request, method, steps, CHECKS), exact),  # type: ignore[misc]
            partial(take, request, method, steps, 1),
        )
        for method, steps in ways(request, quick)
    )  # fmt: skip
    what = "the contact point (m)" if of == "contact" else "K/|K| and γ"
    question = f"correct digits of {what} at the worst of {CHECKS} times in {END:g} s"
    notes = [f"reference: the motion with {DIGITS} proved digits"]
    return frontier(f"one ball, {of}", question, notes, choices, DIGITS, 1 if quick else 5, say)


def _choice(request: Request, method: Method, steps: int, error: Callable[[], float], run: Run) -> Choice:
    return Choice(name_of(method), request.rate * END / steps, steps, END, error, run)


def name_of(method: Method) -> str:
    """The precision and the order."""
    return f"{method.label}, order {method.order}"


def ways(request: Request, quick: bool, balls: int = 1) -> Iterator[tuple[Method, int]]:
    """Every method and number of steps whose run is not too long; of a batch a quarter of that, and no Digits."""
    digits: list[Precision] = [] if quick or balls > 1 else [Digits(30), Digits(50)]
    longest = LONGEST[quick] / (4 * balls if balls > 1 else 1)
    for precision in (*NAMED.values(), *digits):
        for method in methods(precision):
            for length in LENGTHS[quick]:
                steps = CHECKS * max(1, round(request.rate * request.time / length / CHECKS))
                if steps * method.stages * STAGE[label_of(precision)] <= longest:
                    yield method, steps


def batch(quick: bool, say: Say) -> Frontier:
    """A batch: digits of K and γ of some of its balls, the worst of them, and the time of a ball's simulated second."""
    one = replace(sample("state", END), accuracy=1e-30)
    random, n = np.random.default_rng(5), 32 if quick else BATCH
    turned = random.normal(scale=0.1, size=(n, 3))
    gamma = one.gamma + np.cross(turned, one.gamma)
    for _ in range(2):  # the second takes the rounding of the first away
        gamma /= np.sqrt((gamma * gamma).sum(axis=-1, keepdims=True))
    K = kernels.contact_momentum(np.array([3.0, -2.0, 1.0]) + turned, gamma, one.ball.mass_tensor, one.ball.D)
    some = [replace(one, angular_momentum=K[i], gamma=gamma[i]) for i in range(1 if quick else SHOWN)]
    say("batch: the references")
    exact = [truth(request, 20) for request in some]

    def error(method: Method, steps: int) -> float:
        runs = [take(request, method, steps, 1) for request in some]
        return max(map(true_error, some, runs, exact))

    choices = (
        _choice(one, method, steps, partial(error, method, steps), partial(_all, one.ball, K, gamma, method, steps))
        for method, steps in ways(one, quick, n)
    )
    question = f"correct digits of K/|K| and γ after {END:g} s"
    notes = [f"{n} balls, one core; error: the worst of {len(some)} of them"]
    return frontier(f"a batch of {n}", question, notes, choices, OF_BATCH, 1 if quick else 3, say, n)


def _all(ball: Ball, K: np.ndarray, gamma: np.ndarray, method: Method, steps: int) -> None:
    if method.order == EXTRAPOLATED:
        extrapolate(ball, K, gamma, END / steps, steps)
        return
    order, precision = method.order, method.precision
    trajectory(ball, END / steps * K, gamma, steps, order=order, every=steps, precision=precision, threads=1)
