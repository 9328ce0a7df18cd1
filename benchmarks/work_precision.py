"""Work and precision: the time to an error at t = 100, of the map and of integrators of the continuous ball."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache, partial
from itertools import pairwise

import numpy as np

import chapsym
from chapsym import generated
from chapsym.studies.harness import Contender, Timing, cores, installed, interleaved

from . import continuous
from .results import Curve, Reached, Result
from .trajectory import GAMMA, MASS_TENSOR, MOMENTUM, D

END = 100.0
STATE = np.concatenate([MOMENTUM, GAMMA])
TARGETS = (1e-3, 1e-6, 1e-9, 1e-12)
#: Ratios to heyoka.py for one ball that a composition of order 8 had when the project began.
BEFORE = (1.7, 2.6, 3.0, 3.9)
HEYOKA = "heyoka.py"
#: Balls of one call of chapsym where a batch is timed: what the call itself costs is divided among them.
BALLS = 16
#: The least relative tolerance that solve_ivp takes is a hundred roundings.
SMALLEST_RTOL = 2.3e-14
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


@cache
def _ball() -> chapsym.Ball:
    """Made once, as heyoka.py's integrator is."""
    return chapsym.Ball(MASS_TENSOR, D)


def the_map(y: np.ndarray, end: float, steps: float, order: int = 2, balls: int = 1) -> np.ndarray:
    """chapsym's map, or its composition of a higher order, with 𝒦 = εK; the first of the balls of one call."""
    epsilon, count = end / steps, int(steps)
    K, g = epsilon * np.tile(y[:3], (balls, 1)), np.tile(y[3:], (balls, 1))
    if balls == 1:
        K, g = K[0], g[0]
    run = chapsym.trajectory(_ball(), K, g, count, order=order, every=count)
    return np.concatenate([x[..., -1, :].reshape(-1, 3)[0] for x in (run.momentum / epsilon, run.gamma)])


def extrapolated(y: np.ndarray, end: float, steps: float) -> np.ndarray:
    """The continuous ball to order 12: the rotation of each long step extrapolated from steps of the map."""
    run = chapsym.extrapolate(_ball(), y[:3], y[3:], end / steps, int(steps))
    return np.concatenate([run.angular_momentum, run.gamma])


def methods(quick: bool) -> tuple[list[Method], dict[str, str]]:
    """The methods that can run here, and why the others cannot."""
    tolerances = tuple(10.0**-k for k in ((3, 6, 9, 12) if quick else range(2, 14)))
    refined = tuple(250.0 * 2**k for k in ((0, 3, 6) if quick else range(0, 11)))
    longer = tuple(250.0 * 4**k for k in (range(0, 4) if quick else range(0, 9)))
    found = [
        Method("numba RK4", continuous.rk4, refined),
        Method("chapsym, order 2", the_map, longer),
    ]
    missing = {}
    for order, first in ((4, 250.0), (6, 125.0), (8, 62.0)):
        sweep = tuple(round(first * 2 ** (k / 2)) for k in (range(0, 9, 4) if quick else range(0, 17)))
        found.append(Method(f"chapsym, order {order}", partial(the_map, order=order), sweep))
        several = partial(the_map, order=order, balls=BALLS)
        found.append(Method(f"chapsym, order {order}, batch", several, sweep, BALLS))
    long_steps = tuple(round(50.0 * 2 ** (k / 4)) for k in (range(0, 13, 6) if quick else range(0, 15)))
    found.append(Method("chapsym.extrapolate", extrapolated, long_steps))
    if reason := installed("scipy"):
        missing["SciPy DOP853, LSODA"] = reason
    else:
        found.append(Method("SciPy DOP853", continuous.dop853, (*tolerances, SMALLEST_RTOL)))
        found.append(Method("SciPy LSODA", continuous.lsoda, tolerances))
    if reason := installed("heyoka"):
        missing[HEYOKA] = reason
    else:
        found.append(Method(HEYOKA, continuous.taylor, tolerances))
        found.append(Method(f"{HEYOKA}, batch", continuous.taylor_batch, tolerances, continuous.LANES))
    return found, missing


def reference() -> tuple[np.ndarray, str]:
    """The state at t = 100 to more than float64, and what it is."""
    exact = np.array([float(x) for x in continuous.reference(STATE, END)])
    return exact, f"reference: the motion with {continuous.DIGITS} proved digits"


def integrals(y: np.ndarray) -> np.ndarray:
    """⟨K,γ⟩, ⟨K,K⟩ and the energy, (3,)."""
    height, square, _ = generated.invariants(*y)
    return np.array([height, square, generated.energy(*y, *continuous.BALL)])


def swept(
    sweep: list[Method], exact: np.ndarray, rounds: int, on_round: Callable[[str], None]
) -> dict[str, list[Point]]:
    """Every control of every method, interleaved on one core; a step that is too long to be taken is left out."""
    kept, contenders = integrals(STATE), []
    ends: dict[tuple[str, float], np.ndarray] = {}
    for method in sweep:
        for control in method.controls:
            try:
                ends[method.name, control] = method.peer(STATE, END, control)  # compiles, too
            except chapsym.StepNotTaken:
                continue
            run = partial(method.peer, STATE, END, control)
            contenders.append(Contender(f"{method.name} at {control:g}", run, method.balls))
    with cores(1):
        timed = interleaved(contenders, rounds, lambda done: on_round(f"work-precision: round {done} of {rounds}"))
    return {
        method.name: [
            point(control, ends[method.name, control], timed[f"{method.name} at {control:g}"], exact, kept)
            for control in method.controls
            if (method.name, control) in ends
        ]
        for method in sweep
    }


def point(control: float, end: np.ndarray, timing: Timing, exact: np.ndarray, kept: np.ndarray) -> Point:
    height, square, energy = map(float, abs(integrals(end) / kept - 1))
    return Point(control, timing.median, float(abs(end - exact).max()), (height, square, energy))


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


def integral_error_at(points: list[Point], target: float) -> tuple[float | None, ...]:
    """The errors of the integrals in the first run whose trajectory error is at most `target`."""
    return next((p.integrals for p in points if p.error <= target), (None, None, None))


def measure(quick: bool, on_round: Callable[[str], None] = lambda text: None) -> Result:
    """The sweep of all methods; ratios are to heyoka.py for one ball, or to numba RK4 where it is not installed."""
    on_round("work-precision: the reference solution")
    exact, confirmed = reference()
    sweep, missing = methods(quick)
    on_round("work-precision: compiling")
    points = swept(sweep, exact, 2 if quick else 9, on_round)
    home = HEYOKA if HEYOKA in points else "numba RK4"
    rows = []
    for name, found in points.items():
        for target in TARGETS:
            took, base = time_to(found, target), time_to(points[home], target)
            rows.append({
                "name": name, "error": target, "µs": took and took * 1e6,
                f"to {home}": took / base if took and base else None,
                **dict(zip(INTEGRALS, integral_error_at(found, target), strict=True)),
            })  # fmt: skip
    curves = [
        Curve(panel, name, [p.seconds * 1e6 for p in found], [value(p) for p in found])
        for name, found in points.items()
        for panel, value in PANELS.items()
    ]
    best = [_best(rows, target, wanted) for target, wanted in zip(TARGETS, BEFORE, strict=True)]
    return Result("time to an error at t = 100, one core", rows, missing, [r for r in best if r], curves, [confirmed])


PANELS: dict[str, Callable[[Point], float]] = {
    "error of K and γ": lambda p: p.error,
    "largest error of <K,γ>, <K,K>, energy": lambda p: max(p.integrals),
    "largest error of <K,γ>, <K,K>": lambda p: max(p.integrals[:2]),
}


def _best(rows: list[dict], target: float, wanted: float) -> Reached | None:
    """chapsym's best ratio to heyoka.py at this error, if both reach it."""
    column = f"to {HEYOKA}"
    ratios = {
        row["name"]: row[column]
        for row in rows
        if row["name"].startswith("chapsym")
        and "batch" not in row["name"]
        and row["error"] == target
        and row.get(column)
    }
    if not ratios:
        return None
    name = min(ratios, key=ratios.__getitem__)
    return Reached(f"{name} / {HEYOKA} at error {target:g}", ratios[name], wanted, False)
