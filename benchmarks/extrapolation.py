"""`extrapolate` as a whole call beside heyoka.py's: the time to an error at t = 100, of one ball and of eight."""

from collections.abc import Callable
from functools import cache, partial

import numpy as np

import chapsym
from chapsym.studies.harness import Contender, cores, installed, interleaved

from . import continuous
from .calls import repeat
from .results import Reached, Result
from .trajectory import MASS_TENSOR, D
from .work_precision import END, HEYOKA, STATE, TARGETS, Method, point, reference, time_to

#: What a call may take, to heyoka.py's of as many balls.
MOST = 0.8
RADIUS = 0.1
EXTRAPOLATE = "chapsym.extrapolate"
#: Calls in a row of each side.
CALLS = 5


@cache
def _start(balls: int) -> tuple[chapsym.Ball, np.ndarray, np.ndarray]:
    """The ball and the states, made once, as heyoka.py's integrators are."""
    return chapsym.Ball(MASS_TENSOR, D, RADIUS), np.tile(STATE[:3], (balls, 1)), np.tile(STATE[3:], (balls, 1))


def one(y: np.ndarray, end: float, steps: float, columns: int = 6, contact: bool = False) -> np.ndarray:
    """`extrapolate` for one ball."""
    run = chapsym.extrapolate(_start(1)[0], y[:3], y[3:], end / steps, int(steps), columns=columns, contact=contact)
    return np.concatenate([run.angular_momentum, run.gamma])


def several(y: np.ndarray, end: float, steps: float, columns: int = 6, contact: bool = False) -> np.ndarray:
    """The same for as many balls as heyoka.py's batch, all from the same state; the state of the first."""
    run = chapsym.extrapolate(
        *_start(continuous.LANES), end / steps, int(steps), columns=columns, contact=contact, threads=1
    )
    return np.concatenate([run.angular_momentum[0], run.gamma[0]])


def methods(quick: bool) -> tuple[list[Method], dict[str, str]]:
    """The sides with their steps or tolerances, and why one is missing."""
    steps = tuple(round(26.0 * 2 ** (k / 6)) for k in (range(0, 17, 4) if quick else range(17)))
    tolerances = tuple(10.0 ** (-k / 2) for k in (range(3, 30, 6) if quick else range(3, 30)))
    eight = continuous.LANES
    found = [
        Method(EXTRAPOLATE, one, steps),
        Method(f"{EXTRAPOLATE}, 5 columns", partial(one, columns=5), steps),
        Method(f"{EXTRAPOLATE}, with the contact point", partial(one, contact=True), steps),
        Method(f"{EXTRAPOLATE}, batch", several, steps, eight),
        Method(f"{EXTRAPOLATE}, batch, 5 columns", partial(several, columns=5), steps, eight),
        Method(f"{EXTRAPOLATE}, batch, with the contact point", partial(several, contact=True), steps, eight),
    ]
    if reason := installed("heyoka"):
        return found, {HEYOKA: reason}
    batch = Method(f"{HEYOKA}, batch", continuous.taylor_batch, tolerances, eight)
    return [*found, Method(HEYOKA, continuous.taylor, tolerances), batch], {}


def measure(quick: bool, on_round: Callable[[str], None] = lambda text: None) -> Result:
    """Times whole calls, a few of each side in a row; ratios are to heyoka.py's call of as many balls."""
    on_round("extrapolation: the reference solution")
    exact, confirmed = reference()
    sweep, missing = methods(quick)
    ends, contenders = {}, []
    for method in sweep:
        for control in method.controls:
            try:
                ends[method.name, control] = method.peer(STATE, END, control)
            except chapsym.StepNotTaken:
                continue
            run = partial(repeat, partial(method.peer, STATE, END, control), CALLS)
            contenders.append(Contender(f"{method.name} at {control:g}", run, CALLS * method.balls))
    with cores(1):
        timed = interleaved(contenders, 3 if quick else 41, lambda done: on_round(f"extrapolation: round {done}"))
    kept = np.ones(3)  # the integrals are in the section work-precision
    points = {
        m.name: [
            point(c, ends[m.name, c], timed[f"{m.name} at {c:g}"], exact, kept)
            for c in m.controls
            if (m.name, c) in ends
        ]
        for m in sweep
    }
    rows, reach = [], []
    for target in TARGETS:
        best: dict[str, float] = {}
        for method in sweep:
            took = time_to(points[method.name], target)
            home = HEYOKA if method.balls == 1 else f"{HEYOKA}, batch"
            base = time_to(points[home], target) if home in points else None
            ratio = took / base if took and base else None
            rows.append({"error": target, "name": method.name, "µs a ball": took and took * 1e6, f"to {HEYOKA}": ratio})
            if ratio and method.name.startswith(EXTRAPOLATE) and "contact" not in method.name:
                best[home] = min(ratio, best.get(home, ratio))
        reach += [
            Reached(f"{EXTRAPOLATE}, the better / {home} at error {target:g}", ratio, MOST, False)
            for home, ratio in best.items()
        ]
    return Result("whole calls to an error at t = 100, one core", rows, missing, reach, [], [confirmed])
