"""The ways to take a ball to the end: a precision and an order, each by one call of dynamics."""

from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np

from chapsym.dynamics import BadInput, Trajectory, extrapolate, substeps, trajectory
from chapsym.dynamics.ball import Floats
from chapsym.dynamics.extrapolation import MOST_OF_PAIRS, Extrapolated, stages_of
from chapsym.dynamics.loops.double_double import FIRST
from chapsym.numbers import NAMED, Digits, Double, DoubleDouble, Pair, Precision, Single, pairs

from .problem import EXTRAPOLATED
from .request import Request

#: Orders of `trajectory`; that of `extrapolate` in double-double, at most; and that of a steady rotation.
COMPOSED, OF_PAIRS, STEADY = (2, 4, 6, 8), 2 * MOST_OF_PAIRS, 0
#: Below this not all 106 bits of double-double, of a stage of a composition, are within the range of float64.
SMALLEST = 2.0**-900
#: Runs are compared at so many times at least: a difference that is small by chance at one is not so at all.
CHECKS, FEW = 16, 4


@dataclass(frozen=True)
class Method:
    """A precision and an order: 2 to 8; from 10 on that of `extrapolate`; 0 for a steady rotation."""

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


def methods(precision: Precision) -> list[Method]:
    """All that can be asked of a precision."""
    found = [Method(precision, order) for order in COMPOSED]
    if precision == NAMED["double-double"]:
        found.append(Method(precision, OF_PAIRS))
    if precision == NAMED["double"]:
        found.append(Method(precision, EXTRAPOLATED))
    return found


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
    if method.columns:
        return _extrapolated(request, method, exactly, every, frames)
    momentum: Any = step * request.angular_momentum
    if not isinstance(method.precision, Double | Single):  # of T/n and its product with K float64 has but 53 bits
        momentum = [exactly * Fraction(float(x)) for x in request.angular_momentum]
    return trajectory(
        request.ball, momentum, request.gamma, steps, order=method.order, every=every, attitude=request.body,
        contact=request.of == "contact", time_step=step, precision=method.precision,
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

    def run(of: Extrapolated, momentum: Floats) -> Trajectory:
        return Trajectory(
            request.ball, np.arange(frames + 1) * every, momentum, of.gamma, of.attitude, of.contact,
            np.array(frames * every), found.status, float(step), method.order, method.precision,
        )  # fmt: skip

    if found.low is None:
        return run(found, found.angular_momentum * float(step))
    high, low = pairs.multiply(found.angular_momentum, found.low.angular_momentum, *Pair.of(step).halves())
    return replace(run(found, high), low=run(found.low, low))
