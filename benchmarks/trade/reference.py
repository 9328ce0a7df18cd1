"""The continuous ball (2.3) with its contact point, to proved digits: it shares no formula of motion with the map."""

import math
from collections.abc import Sequence
from fractions import Fraction

import numpy as np

from chapsym.accuracy import Request
from chapsym.accuracy.answer import CHECKS, exact_values
from chapsym.accuracy.motion import lengths
from chapsym.dynamics import Ball, Trajectory, certified_motion
from chapsym.dynamics.ball import Floats
from chapsym.dynamics.levels.start import fraction

from ..harness import NotComparable

#: Seconds after which there is no reference.
LONGEST = 3600.0
#: The digits of the reference beyond the accuracy and those that the flow may cost.
BEYOND = 3


def sample(of: str, time: float) -> Request:
    """The ball of docs/first.toml, on which methods are compared."""
    ball = Ball.from_inertia((0.006, 0.007, 0.009), mass=2.0, radius=0.1)
    K, g = np.array([0.0446, -0.0346, 0.0313]), np.array([2.0, 3.0, 6.0]) / 7
    return Request(ball, K, g, time, 1e-6, of)


def continuous(
    ball: Ball, angular_momentum: Floats, gamma: Floats, attitude: Floats | None, times: Sequence[Fraction], digits: int
) -> np.ndarray:
    """K (kg m²/s), γ and the contact point (m) at ascending times (s): Fractions, (times, 8).

    attitude: a quaternion, body to space; None for the least rotation that turns γ up.  All floats are taken as exact.
    digits: of the state, at every time, as `certified_motion` proves them.  Raises NotComparable without them.
    """
    found = certified_motion(ball, angular_momentum, gamma, times, digits, attitude=attitude, limit=LONGEST)
    if found.stopped is not None:
        raise NotComparable(found.stopped)
    contact = found.contact if found.contact is not None else np.zeros((len(times), 2), int)
    rows = np.hstack([found.angular_momentum, found.gamma, contact])
    return np.vectorize(lambda x: fraction(x) if x else Fraction(0), otypes=[object])(rows)


def truth(request: Request, digits: int = 0) -> np.ndarray:
    """K, γ and the contact point at the times of comparison, (checks + 1, 8) Fractions."""
    wanted = digits or math.ceil(-math.log10(request.accuracy) + math.log10(1 + request.angle)) + BEYOND
    times = [Fraction(request.time) * k / CHECKS for k in range(CHECKS + 1)]
    attitude = None if isinstance(request.attitude, bool | np.bool_) else request.attitude
    return continuous(request.ball, request.angular_momentum, request.gamma, attitude, times, wanted)


def true_error(request: Request, run: Trajectory, exact: np.ndarray) -> float:
    """The error of a run in the request's norm, at the worst time of comparison that is a frame of the run."""
    exact = exact[:: CHECKS // (len(run.index) - 1)]
    if request.of == "contact":
        return float(lengths(exact_values(request, run, "contact") - exact[:, 6:]).max())
    size = float(lengths(request.angular_momentum))
    momentum = lengths(exact_values(request, run, "momentum") - exact[:, :3]) / size
    return float(max(momentum.max(), lengths(exact_values(request, run, "gamma") - exact[:, 3:6]).max()))
