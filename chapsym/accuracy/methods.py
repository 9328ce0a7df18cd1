"""The ways to take a ball to the end: a precision and an order, each by one call of dynamics."""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from chapsym.dynamics import BadInput, Trajectory, exact_top, extrapolate, substeps, trajectory
from chapsym.dynamics.ball import Floats
from chapsym.dynamics.extrapolation import MOST_OF_PAIRS, stages_of
from chapsym.dynamics.loops.double_double_long import FIRST
from chapsym.dynamics.results import Low
from chapsym.numbers import NAMED, Digits, Double, DoubleDouble, Pair, Precision, Single, pairs

from .problem import EXTRAPOLATED
from .request import Request

#: Orders of `trajectory`; that of `extrapolate` in double-double, at most; and that of the exact top, whose steps have
#: no error.
COMPOSED, OF_PAIRS, EXACT = (2, 4, 6, 8), 2 * MOST_OF_PAIRS, 0
#: Below this not all 106 bits of double-double, of a stage of a composition, are within the range of float64.
SMALLEST = 2.0**-900
#: Runs are compared at so many times at least: a difference that is small by chance at one is not so at all.
CHECKS, FEW = 16, 4


@dataclass(frozen=True)
class Method:
    """A precision and an order: 2 to 8; from 10 on that of `extrapolate`; 0 for `exact_top`, or a steady rotation."""

    precision: Precision
    order: int

    @property
    def label(self) -> str:
        """The precision's name, with its digits."""
        return label_of(self.precision)

    @property
    def columns(self) -> int:
        """Of `extrapolate`; 0 for the others."""
        return self.order // 2 if self.order > COMPOSED[-1] else 0

    @property
    def stages(self) -> int:
        """Steps of the map in a step."""
        if self.columns:
            return stages_of(self.columns, FIRST if isinstance(self.precision, DoubleDouble) else 0)
        return len(substeps(self.order or 2))


def label_of(precision: Precision) -> str:
    """What JSON and the measured prices call a precision: "double", "digits30"; "quad" for double-double."""
    if isinstance(precision, Digits):
        return f"digits{precision.count}"
    return "quad" if isinstance(precision, DoubleDouble) else type(precision).__name__.lower()


def methods(request: Request, precision: Precision) -> list[Method]:
    """All that can be asked of a precision for this request."""
    found = [Method(precision, order) for order in COMPOSED]
    if precision == NAMED["double-double"]:
        found.append(Method(precision, OF_PAIRS))
    if precision == NAMED["double"]:
        found.append(Method(precision, EXTRAPOLATED))
        if request.of == "state" and _is_top(request):
            found.append(Method(precision, EXACT))
    return found


def _is_top(request: Request) -> bool:
    step = 1e-3 * request.time / (1.0 + request.angle)
    try:
        exact_top(request.ball, step * request.angular_momentum, request.gamma)
    except BadInput:
        return False
    return True


def checks(request: Request, method: Method) -> int:
    """The equal times at which two runs are compared, a multiple of the frames: few where the steps are long."""
    least = FEW if method.columns else CHECKS
    return request.frames * -(-least // request.frames)


def take(request: Request, method: Method, steps: int, frames: int) -> Trajectory:
    """The ball after `frames` equal parts of the time in `steps` steps, a multiple of them.

    Raises StepNotTaken where the map has no step of this length.
    """
    exactly, every = Fraction(request.time) / steps, steps // frames
    step = request.time / steps
    in_range(step, request.angular_momentum)
    body = request.body
    ball, K, g = request.ball, request.angular_momentum, request.gamma
    if method.columns:
        return _extrapolated(request, method, exactly, every, frames)
    if method.order == EXACT:
        top = exact_top(ball, step * K, g)
        run = trajectory(top.ball, top.momentum, g, steps, every=every, attitude=body, time_step=step)
        return top.restore(run)
    momentum: Any = step * K
    if not isinstance(method.precision, Double | Single):  # of T/n and its product with K float64 has but 53 bits
        momentum = [exactly * Fraction(float(x)) for x in K]
    return trajectory(
        ball, momentum, g, steps, order=method.order, every=every, attitude=body, contact=request.of == "contact",
        time_step=step, precision=method.precision,
    )  # fmt: skip


def in_range(step: float, K: Floats) -> None:
    """Raises BadInput where the step or εK is so small that float64 loses digits of it that no comparison shows."""
    largest = float(abs(K).max())
    if step < SMALLEST or 0.0 < step * largest < SMALLEST:
        what = "a step of ε = T/n" if step < SMALLEST else "εK"
        raise BadInput(f"{what} is below {SMALLEST:.0e}, where float64 loses digits; take other units of time or mass")


def _extrapolated(request: Request, method: Method, step: Fraction, every: int, frames: int) -> Trajectory:
    """`extrapolate` as a trajectory."""
    of_pairs = isinstance(method.precision, DoubleDouble)
    found = extrapolate(
        request.ball, request.angular_momentum, request.gamma, step if of_pairs else float(step), frames * every,
        columns=method.columns, every=every, attitude=request.body, contact=request.of == "contact",
        precision=method.precision,
    )  # fmt: skip
    momentum, low = found.angular_momentum * float(step), None
    if found.low is not None:
        momentum, rest = pairs.multiply(found.angular_momentum, found.low.angular_momentum, *Pair.of(step).halves())
        low = Low(rest, found.low.gamma, found.low.attitude, found.low.contact)
    return Trajectory(
        request.ball, np.arange(frames + 1) * every, momentum, found.gamma, found.attitude, found.contact,
        np.array(frames * every), found.status, float(step), method.order, method.precision, low,
    )  # fmt: skip
