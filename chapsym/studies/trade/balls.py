"""One ball against the continuous ball (2.3): every precision, order and length of step."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

from chapsym.accuracy import Method, Request, methods, take
from chapsym.accuracy.methods import CHECKS, EXACT, label_of
from chapsym.dynamics import StepNotTaken
from chapsym.numbers import NAMED, Digits, Precision

from ..harness import Contender, cores, interleaved
from .frontier import Frontier, Point, digits_of
from .reference import sample
from .requests import true_error, truth

Say = Callable[[str], None]
#: Seconds of simulated time.
END = 10.0
#: Lengths of steps, |ω|ε in radians: of a look, and all.
LENGTHS = {True: (0.4, 0.1, 0.03), False: (1.0, 0.7, 0.5, 0.35, 0.25, 0.18, 0.125, 0.09, 0.06, 0.04, 0.02, 0.01, 0.003)}
#: The most seconds that a run of a precision may be expected to take, by these seconds a stage.
STAGE = {"single": 5e-8, "double": 5e-8, "quad": 3e-7, "digits30": 3e-4, "digits50": 3e-4}
LONGEST = {True: 0.02, False: 1.0}
#: The digits of the reference.
DIGITS = 34


def measure(quick: bool, say: Say, of: str = "contact") -> Frontier:
    """One ball: digits of the contact point, or of the state, after END seconds, and the time of a simulated second."""
    request = replace(sample(of, END), accuracy=1e-30, frames=1)
    say(f"{of}: the reference")
    exact = truth(request, DIGITS)
    contenders, errors = [], {}
    for method, steps in choices(request, quick):
        name = f"{name_of(method)} at {steps}"
        say(f"{of}: {name}")
        try:
            errors[method, steps] = true_error(request, take(request, method, steps, CHECKS), exact)
        except StepNotTaken:
            continue
        contenders.append(Contender(name, partial(take, request, method, steps, 1), 1))
    with cores(1):
        times = interleaved(contenders, 1 if quick else 5, lambda done: say(f"{of}: round {done}"))
    points = []
    for (method, steps), error in errors.items():
        took = times[f"{name_of(method)} at {steps}"].median
        length = request.rate * END / steps
        points.append(Point(name_of(method), length, took / steps, took / END, digits_of(error, DIGITS)))
    what = "the contact point (m)" if of == "contact" else "K/|K| and γ"
    return Frontier(
        f"one ball, {of}",
        f"correct digits of {what} at the worst of {CHECKS} times in {END:g} s",
        points,
        [f"reference: the motion with {DIGITS} proved digits"],
    )


def choices(request: Request, quick: bool) -> Iterator[tuple[Method, int]]:
    """Every method and number of steps whose run is not too long."""
    precisions: list[Precision] = [*NAMED.values(), *([] if quick else [Digits(30), Digits(50)])]
    for precision in precisions:
        for method in methods(request, precision):
            if method.order == EXACT:
                continue
            for length in LENGTHS[quick]:
                steps = CHECKS * max(1, round(request.rate * request.time / length / CHECKS))
                if steps * method.stages * STAGE[label_of(precision)] <= LONGEST[quick]:
                    yield method, steps


def name_of(method: Method) -> str:
    """The precision and the order."""
    return f"{method.label}, order {method.order}"
