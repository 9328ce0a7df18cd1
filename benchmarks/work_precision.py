"""Work and precision: the time to an error at t = 100, of the map and of integrators of the continuous ball."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from functools import cache, partial
from itertools import pairwise, product
from typing import Any

import numpy as np

import chapsym
from chapsym import generated
from chapsym.files import Data

from . import continuous
from .harness import Say, installed
from .results import Curve, Reached, Result, timed
from .trajectory import GAMMA, MASS_TENSOR, MOMENTUM, D

END = 100.0
STATE = np.concatenate([MOMENTUM, GAMMA])
TARGETS = (1e-3, 1e-6, 1e-9, 1e-12)
HEYOKA, EXTRAPOLATE = "heyoka.py", "chapsym.extrapolate"
#: The largest ratio of the fastest of chapsym to heyoka.py for as many balls.
MOST = 0.8
RADIUS = 0.1
#: Balls of one call of chapsym where a batch is timed: what the call itself costs is divided among them.
BALLS = 16
#: The least relative tolerance that solve_ivp takes is a hundred roundings.
SMALLEST_RTOL = 2.3e-14
PROVED = f"reference: the motion with {continuous.DIGITS} proved digits"
SCIPY = "SciPy's right side is plain Python on floats"
INTEGRALS = ("<K,γ>", "<K,K>", "energy")


@dataclass(frozen=True)
class Method:
    """A peer with the controls (tolerances, or numbers of steps) of its sweep, from coarse to fine; it does `balls`."""

    name: str
    peer: continuous.Peer
    controls: tuple[float, ...]
    balls: int = 1


@dataclass(frozen=True)
class Point:
    """One run: seconds a ball, the largest error of K and γ, and of the integrals, relative to their size."""

    control: float
    seconds: float
    error: float
    integrals: tuple[float, float, float]


Points = dict[str, list[Point]]


@cache
def _start(balls: int) -> tuple[chapsym.Ball, np.ndarray, np.ndarray]:
    """The ball, K and γ, made once, as heyoka.py's integrators are."""
    K, g = (np.tile(x, (balls, 1)) if balls > 1 else x for x in (MOMENTUM, GAMMA))
    return chapsym.Ball(MASS_TENSOR, D, RADIUS), K, g


def the_map(y: np.ndarray, end: float, steps: float, order: int = 2, balls: int = 1) -> np.ndarray:
    """chapsym's map, or its composition of a higher order, with 𝒦 = εK; the first of the balls of one call."""
    (ball, K, g), epsilon, count = _start(balls), end / steps, int(steps)
    run = chapsym.trajectory(ball, epsilon * K, g, count, order=order, every=count)
    return np.concatenate([x[..., -1, :].reshape(-1, 3)[0] for x in (run.momentum / epsilon, run.gamma)])


def extrapolated(y: np.ndarray, end: float, steps: float, balls: int = 1, **options: Any) -> np.ndarray:
    """The continuous ball to order 12: the rotation of each long step extrapolated from steps of the map."""
    run = chapsym.extrapolate(*_start(balls), end / steps, int(steps), threads=1, **options)
    return np.concatenate([x.reshape(-1, 3)[0] for x in (run.angular_momentum, run.gamma)])


def methods(quick: bool) -> tuple[list[Method], dict[str, str]]:
    """The methods that can run here, and why the others cannot."""
    tolerances = tuple(10.0**-k for k in ((3, 6, 9, 12) if quick else range(2, 14)))
    longer = tuple(250.0 * 4**k for k in (range(0, 4) if quick else range(0, 9)))
    found, missing = [Method("chapsym, order 2", the_map, longer)], {}
    for order, first in ((4, 250.0), (6, 125.0), (8, 62.0)):
        sweep = tuple(round(first * 2 ** (k / 2)) for k in (range(0, 9, 4) if quick else range(0, 17)))
        found.append(Method(f"chapsym, order {order}", partial(the_map, order=order), sweep))
        several = partial(the_map, order=order, balls=BALLS)
        found.append(Method(f"chapsym, order {order}, batch", several, sweep, BALLS))
    long_steps = tuple(round(26.0 * 2 ** (k / 4)) for k in (range(0, 13, 6) if quick else range(0, 15)))
    kinds = ("", 6, False), (", 5 columns", 5, False), (", with the contact point", 6, True)
    for (balls, batch), (name, columns, contact) in product(((1, ""), (continuous.LANES, ", batch")), kinds):
        peer = partial(extrapolated, balls=balls, columns=columns, contact=contact)
        found.append(Method(f"{EXTRAPOLATE}{name}{batch}", peer, long_steps, balls))
    if reason := installed("scipy"):
        missing["SciPy DOP853, LSODA"] = reason
    else:
        found.append(Method("SciPy DOP853", continuous.dop853, (*tolerances, SMALLEST_RTOL)))
        found.append(Method("SciPy LSODA", continuous.lsoda, tolerances))
    if reason := installed("heyoka"):
        missing[HEYOKA] = reason
    else:
        found.append(Method(HEYOKA, continuous.taylor, tolerances))
        found.append(Method(f"{HEYOKA}, batch", partial(continuous.taylor, kind="batch"), tolerances, continuous.LANES))
    return found, missing


def integrals(y: np.ndarray) -> np.ndarray:
    """⟨K,γ⟩, ⟨K,K⟩ and the energy, (3,)."""
    height, square, _ = generated.invariants(*y)
    return np.array([height, square, generated.energy(*y, *continuous.BALL)])


def swept(sweep: list[Method], exact: np.ndarray, rounds: int, on_round: Say) -> Points:
    """Every control of every method, interleaved on one core; a step that is too long to be taken is left out."""
    sides, ends = {}, {}
    for method, control in [(one, control) for one in sweep for control in one.controls]:
        run = partial(method.peer, STATE, END, control)
        with suppress(chapsym.StepNotTaken):
            if np.isfinite(end := run()).all():  # a batch does not raise
                side = f"{method.name} at {control:g}"
                sides[side], ends[side] = (run, method.balls), (method.name, control, end)
    timings = timed(sides, rounds, on_round, "work-precision")
    points: Points = {method.name: [] for method in sweep}
    for side, (name, control, end) in ends.items():
        height, square, energy = map(float, abs(integrals(end) / integrals(STATE) - 1))
        error = float(abs(end - exact).max())
        points[name].append(Point(control, timings[side].median, error, (height, square, energy)))
    return points


def time_to(points: list[Point], target: float) -> float | None:
    """The least time at which the error is at most `target`, between two runs on a log-log scale; None if none is.

    A run that is more exact than asked, and takes less time, counts, too.
    """
    times = [p.seconds for p in points if p.error <= target]
    for coarse, fine in pairwise(points):
        if fine.error <= target < coarse.error:
            share = np.log(coarse.error / target) / np.log(coarse.error / fine.error)
            times.append(float(coarse.seconds * (fine.seconds / coarse.seconds) ** share))
    return min(times, default=None)


def measure(quick: bool, on_round: Say = lambda text: None) -> Result:
    """The sweep of all methods; ratios are to heyoka.py, for one ball or, of a batch, for eight."""
    on_round("work-precision: the reference solution")
    exact = continuous.reference(STATE, END)
    sweep, missing = methods(quick)
    points = swept(sweep, exact, 2 if quick else 9, on_round)
    rows: list[Data] = []
    reach = []
    for target in TARGETS:
        best: dict[str, float] = {}
        for method in sweep:
            found, home = points[method.name], HEYOKA if method.balls == 1 else f"{HEYOKA}, batch"
            took, base = time_to(found, target), time_to(points.get(home, []), target)
            ratio = took / base if took and base else None
            kept = next((p.integrals for p in found if p.error <= target), (None, None, None))
            rows.append({
                "name": method.name, "error": target, "µs": took and took * 1e6, f"to {HEYOKA}": ratio,
                **dict(zip(INTEGRALS, kept, strict=True)),
            })  # fmt: skip
            if ratio and method.name.startswith("chapsym") and "contact" not in method.name:
                best[home] = min(ratio, best.get(home, ratio))
        reach += [
            Reached(f"the fastest of chapsym / {home} at error {target:g}", ratio, MOST, False)
            for home, ratio in best.items()
        ]
    curves = [
        Curve(panel, name, [p.seconds * 1e6 for p in found], [value(p) for p in found])
        for name, found in points.items()
        for panel, value in PANELS.items()
    ]
    return Result("time to an error at t = 100, one core", rows, missing, reach, curves, [PROVED, SCIPY])


PANELS: dict[str, Callable[[Point], float]] = {
    "error of K and γ": lambda p: p.error,
    "largest error of <K,γ>, <K,K>, energy": lambda p: max(p.integrals),
    "largest error of <K,γ>, <K,K>": lambda p: max(p.integrals[:2]),
}
