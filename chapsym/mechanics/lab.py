"""Measurements of a method on a system: energy over many steps, constraints, order, cost."""

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import asdict, dataclass, field, fields, replace
from itertools import pairwise
from typing import Any

import numpy as np
import sympy as sp

from chapsym.prove.trees import Data

from .judged import Verdict, verdicts
from .methods import Scheme
from .motion import Motion, NotSolved, Runner, check_callback, whole_number
from .system import System

#: The fraction of the steps at each end whose means are compared, and the number of stored points of the energy.
END, KEPT = 10, 240
#: The number of steps that are examined.
MOST = 1_000_000
#: Steps on which the order is measured, and differences that are rounding; steps forth and back.
SHORT, ROUNDING, BACK = 16, 1e-12, 100
#: The numbers of parts of a step for the error against work, and for the reference.
CUT, FINE = (1, 2, 4, 8, 16), 256


@dataclass(frozen=True)
class Cell:
    """The measurements of a method on a system.

    Attributes
    ----------
    system, method : str
    steps : int
        The requested number of steps.
    length : float
        Of a step.
    energy : float
        The energy at the first step, to which the other figures of the energy refer.
    oscillation : float
        The range of the energy in the first tenth of the steps.
    drift : float
        The mean energy of the last tenth less that of the first.
    constraint, places : float
        The largest |A v + b| of the constraints on velocities, and the largest value of the holonomic ones, at the
        point of a step where the method is evaluated.
    kept : bool
        Whether there are constraints on velocities that an equation of the method sets to 0 there: then they are proved
        to hold, and the figure is rounding.
    halved : float or None
        The drift over the same time in steps of half the length, if requested: an error of the method decreases by its
        order, an error of the model does not.
    order : float or None
        The order of the position by the errors of halved steps; None if rounding hides it.
    returns : float or None
        The distance of the position from its start after some steps, reversed velocities, and as many steps: 0 up to
        rounding if the method is reversible by q, v -> q, -v.
    integrals : dict of str to float
        The range of each recorded quantity of the system, over all steps.
    microseconds : float
        Processor time per step.
    failed : str or None
        Why there are no figures: the step without a solution.
    curve : list of [float, float]
        Time and energy.
    work : list of [float, float]
        Processor time in µs of a run with shorter steps, and the distance of its last position from that of much
        shorter steps.
    verdicts : dict of str to Verdict
        The result of `verdicts`, if requested.
    """

    system: str
    method: str
    steps: int
    length: float
    energy: float = math.nan
    oscillation: float = math.nan
    drift: float = math.nan
    constraint: float = math.nan
    places: float = math.nan
    kept: bool = False
    halved: float | None = None
    order: float | None = None
    returns: float | None = None
    integrals: dict[str, float] = field(default_factory=dict)
    microseconds: float = math.nan
    failed: str | None = None
    curve: tuple[tuple[float, float], ...] = ()
    work: tuple[tuple[float, float], ...] = ()
    verdicts: dict[str, Verdict] = field(default_factory=dict)

    def data(self) -> Data:
        """The cell for JSON, which has no NaN."""
        return _finite(asdict(self))

    @classmethod
    def of(cls, data: Data) -> "Cell":
        """The cell with these data."""
        curves = {name: tuple((float(x), float(y)) for x, y in data.get(name, ())) for name in ("curve", "work")}
        decided = {name: Verdict(**one) for name, one in data.get("verdicts", {}).items()}
        unknown = {x.name: math.nan for x in fields(cls) if x.default is math.nan and data[x.name] is None}
        return cls(**{**data, **curves, "verdicts": decided, **unknown})


@np.errstate(all="ignore")  # no figure for a number that is not finite
def measured(
    system: System, method: str, steps: int = 100_000, length: float | None = None, halve: bool = False,
    decide: bool = False, progress: Callable[[int, int], None] = lambda done, of: None,
) -> Cell:  # fmt: skip
    """Measures a method on a system.

    Parameters
    ----------
    system : System
    method : str
        One of METHODS.
    steps : int, optional
    length : float, optional
        The time of a step; by default that of the system.
    halve : bool, optional
        Whether the drift is also measured with steps of half the length.
    decide : bool, optional
        Whether properties are also decided exactly, as far as possible.
    progress : callable, optional
        Called now and then with the numbers of steps taken and to be taken.

    Returns
    -------
    Cell

    Examples
    --------
    >>> from sympy import symbols
    >>> from chapsym.mechanics import System, dot, measured
    >>> x, y, z = symbols("x y z")
    >>> free = sum(dot(q) ** 2 for q in (x, y, z)) / 2
    >>> particle = System("particle", (x, y, z), free, [dot(z) - y * dot(x)], start={dot(x): 1, dot(y): "1/2"})
    >>> cell = measured(particle, "dla", 1000)
    >>> cell.kept, round(cell.order, 1)
    (True, 2.0)
    """
    runner = Runner(system, method)
    steps = whole_number(steps, "steps")
    check_callback(progress)
    h = system.length(length)
    first = Cell(system.name, method, steps, h, kept=keeps(system, runner.scheme))
    if decide:
        first = replace(first, verdicts=verdicts(system, runner.scheme))
    try:
        runner.march(1, h)  # what is compiled once
        whole, every = 3 * steps if halve else steps, -(-steps // MOST)
        motion = runner.march(steps, h, every, progress=lambda done: progress(done, whole))
    except NotSolved as error:
        return replace(first, failed=str(error))
    half = None
    if halve:
        with suppress(NotSolved):
            shorter = runner.march(2 * steps, h / 2, 2 * every, progress=lambda done: progress(steps + done, whole))
            half = _figures(shorter)["drift"]
    order = returns = None
    with suppress(NotSolved):
        order = _order(runner, h)
    with suppress(NotSolved):
        returns = _returns(runner, h)
    micro, work = 1e6 * motion.seconds / steps, tuple[tuple[float, float], ...]()
    with suppress(NotSolved):
        exact = _place(runner, h, FINE)
        work = tuple((SHORT * k * micro, float(np.abs(_place(runner, h, k) - exact).max())) for k in CUT)
    figures = _figures(motion)
    return replace(first, **figures, order=order, returns=returns, halved=half, microseconds=micro, work=work)


def keeps(system: System, scheme: Scheme) -> bool:
    """Whether an equation of the method makes the velocities satisfy the constraints, at each step or after it."""
    rows = list(system.rows * sp.Matrix(system.velocities) + system.offsets)[: len(system.constraints)]
    here = dict(zip((*system.coordinates, *system.velocities), (*scheme.place, *scheme.velocity), strict=True))
    after = dict(zip(scheme.state, scheme.after, strict=True)) if not scheme.stages else {}
    found = [row.xreplace(here) for row in rows]  # of the state alone it may be said of the next state
    return bool(found) and all(
        _said(row, scheme) or (not row.free_symbols & set(scheme.unknowns) and _said(row.xreplace(after), scheme))
        for row in found
    )


def _said(row: sp.Expr, scheme: Scheme) -> bool:
    """Whether a method sets an expression to 0, as it stands or expanded."""
    if row == 0 or row in scheme.residual:
        return True
    expanded = sp.expand(row)
    return any(sp.expand(e) == expanded for e in scheme.residual if e.free_symbols == row.free_symbols)


def _finite(data: Any) -> Any:
    """Data with None for numbers that are not finite."""
    if isinstance(data, dict):
        return {k: _finite(v) for k, v in data.items()}
    if isinstance(data, tuple | list):
        return type(data)(map(_finite, data))
    return None if isinstance(data, float) and not math.isfinite(data) else data


def _figures(motion: Motion) -> Data:
    energy, part = motion.energy, max(1, len(motion.energy) // END)
    some = np.linspace(0, len(energy) - 1, min(KEPT, len(energy))).astype(int)
    return {
        "energy": float(energy[0]),
        "oscillation": float(np.ptp(energy[:part])),
        "drift": float(energy[-part:].mean() - energy[:part].mean()),
        "constraint": float(motion.constraint.max()),
        "places": float(motion.places.max()),
        "integrals": {name: float(np.ptp(values)) for name, values in motion.integrals.items()},
        "curve": tuple((float(motion.time[i]), float(energy[i])) for i in some),
    }


def _returns(runner: Runner, h: float) -> float:
    """The distance of the position from its start after steps forth and back."""
    there = runner.march(BACK, h).final
    back = runner.march(BACK, h, start=runner.turned(there, h)).final
    n = len(runner.system.coordinates)
    return float(np.abs(back[:n] - runner.system.beginning[0]).max())


def _order(runner: Runner, h: float) -> float | None:
    """The power of the step with which the place changes, from a step, its half and its quarter; None by rounding."""
    ends = [_place(runner, h, k) for k in (1, 2, 4)]
    first, second = (np.abs(a - b).max() for a, b in pairwise(ends))
    return float(np.log2(first / second)) if first > second > ROUNDING * np.abs(ends[-1]).max() else None


def _place(runner: Runner, h: float, k: int) -> np.ndarray:
    """The position after some steps, each divided into k."""
    return runner.march(SHORT * k, h / k).final[: len(runner.system.coordinates)]
