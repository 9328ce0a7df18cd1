"""A certificate of the distance of a run of the map in float64 from the exact orbit."""

import math
from decimal import ROUND_CEILING, Context
from fractions import Fraction

import numpy as np

from chapsym import checker
from chapsym.dynamics import BadInput, Trajectory
from chapsym.numbers import Double

from .balls import shortest
from .document import Document, Say, first_accepted, stated

KIND = "map-run"
#: Bits for numbers of size 1 and their bounds, and bits per step, in the order of the trials.
GUARD, A_STEP = 128, (2.5, 4.0, 8.0, 24.0)


def map_run(run: Trajectory, progress: Say = lambda sentence: None, limit: float = math.inf) -> Document:
    """The certificate of a run of one ball in float64 with proved bounds, accepted by the checker.

    The checker follows the orbit from the start in integers and compares each frame with it.  Raises BadInput for other
    runs, and if the checker proves too little, and LimitReached if it has accepted none after `limit` s.
    """
    if run.order != 2 or not isinstance(run.precision, Double) or run.status.shape or run.proved is None:
        raise BadInput("a certificate is of one ball, of the map itself, in double precision with proved=True")
    bounds = np.stack([run.proved.momentum, run.proved.gamma])
    if not np.isfinite(bounds).all():
        raise BadInput(f"the bounds are proved up to step {run.proved.steps} only: take a run that ends there")
    steps = int(run.index[-1])
    check_steps(steps)
    small = min(float(x) for x in (*run.ball.mass_tensor, run.ball.D, *bounds[:, 1:].ravel(), 1.0) if x > 0)
    bits = (GUARD + math.ceil(a_step * steps - math.log2(small)) for a_step in A_STEP)
    try:
        return first_accepted(bits, lambda n: _document(run, n), progress, limit, "take fewer steps")
    except checker.Rejected as error:
        raise BadInput(f"the checker does not prove the bounds of this run: {error}") from None


def check_steps(last: int) -> None:
    """Raises BadInput if the checker does not follow as many steps as the last frame is at."""
    most = checker.document.MOST_STEPS
    if not 0 < last <= most:
        raise BadInput(f"the checker follows 1 to {most} steps, and the last frame of the run is at {last}")


def _document(run: Trajectory, bits: int) -> Document:
    """The unchecked certificate, for a checker with this many bits."""
    assert run.proved is not None
    rows = zip(run.index, run.momentum, run.gamma, run.proved.momentum, run.proved.gamma, strict=True)
    (_, K, g, *_), *after = rows
    ball = {"J": _exact(run.ball.mass_tensor), "D": shortest(Fraction(float(run.ball.D)))}
    frames = [
        {"step": int(i), **_state(k, v), "bounds": {"momentum": _above(off), "gamma": _above(turned)}}
        for i, k, v, off, turned in after
    ]
    return stated(KIND, ball=ball, start=_state(K, g), bits=bits, frames=frames)


def _state(momentum: np.ndarray, gamma: np.ndarray) -> dict[str, list[str]]:
    return {"momentum": _exact(momentum), "gamma": _exact(gamma)}


def _exact(v: np.ndarray) -> list[str]:
    return [shortest(Fraction(x)) for x in v.tolist()]


def _above(bound: float) -> str:
    """A bound, rounded up to three digits."""
    shown = Context(prec=3, rounding=ROUND_CEILING).create_decimal_from_float(float(bound))
    return f"{shown:.2e}".replace("+", "")
