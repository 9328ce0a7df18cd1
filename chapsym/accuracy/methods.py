"""The ways to take a ball to the end: a precision and an order, each by one call of dynamics."""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from chapsym.dynamics import (
    BadInput,
    Trajectory,
    exact_top,
    extrapolate,
    substeps,
    trajectory,
)
from chapsym.dynamics.ball import Floats
from chapsym.dynamics.extrapolation import stages_of
from chapsym.numbers import NAMED, Digits, Double, DoubleDouble, Precision, Single

from .request import Request

#: Orders of `trajectory`; of `extrapolate`; and that of the exact top, which has no error of the step.
COMPOSED, EXTRAPOLATED, EXACT = (2, 4, 6, 8), 12, 0
#: Columns of the extrapolation: half of its order.
COLUMNS = EXTRAPOLATED // 2
#: Below this not all 106 bits of double-double, of a stage of a composition, are within the range of float64.
SMALLEST = 2.0**-900
#: Runs are compared at so many times at least: a difference that is small by chance at one is not so at all.
CHECKS, FEW = 16, 4


@dataclass(frozen=True)
class Method:
    """A precision and an order: 2, 4, 6, 8; 12 for `extrapolate`; 0 for `exact_top`, or a steady rotation."""

    precision: Precision
    order: int

    @property
    def label(self) -> str:
        """The precision's name, with its digits."""
        return label_of(self.precision)

    @property
    def summed(self) -> bool:
        """Whether 𝒦 and γ are summed with compensation, as float64's are in a composition."""
        return self.order != EXTRAPOLATED and isinstance(self.precision, Double)

    @property
    def walked(self) -> int:
        """How many roundings of 𝒦, γ and the attitude a step adds."""
        return 1 if self.order == EXTRAPOLATED else self.stages

    @property
    def stages(self) -> int:
        """Steps of the map in a step."""
        if self.order == EXTRAPOLATED:
            return stages_of(COLUMNS)
        return len(substeps(self.order or 2))


def label_of(precision: Precision) -> str:
    """What JSON and the measured prices call a precision: "double", "digits30"; "quad" for double-double."""
    if isinstance(precision, Digits):
        return f"digits{precision.count}"
    return "quad" if isinstance(precision, DoubleDouble) else type(precision).__name__.lower()


def methods(request: Request, precision: Precision) -> list[Method]:
    """All that can be asked of a precision for this request."""
    found = [Method(precision, order) for order in COMPOSED]
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
    least = FEW if method.order == EXTRAPOLATED else CHECKS
    return request.frames * -(-least // request.frames)


def take(request: Request, method: Method, steps: int, frames: int, time: float | None = None) -> Trajectory:
    """The ball after `frames` equal parts of `time` (the request's own, if None) in `steps` steps, a multiple of them.

    Raises StepNotTaken where the map has no step of this length.
    """
    end = request.time if time is None else time
    step, every = end / steps, steps // frames
    in_range(step, request.angular_momentum)
    body = request.body
    ball, K, g = request.ball, request.angular_momentum, request.gamma
    if method.order == EXTRAPOLATED:
        return _extrapolated(request, step, every, frames, body)
    if method.order == EXACT:
        top = exact_top(ball, step * K, g)
        run = trajectory(top.ball, top.momentum, g, steps, every=every, attitude=body, time_step=step)
        return top.restore(run)
    momentum: Any = step * K
    if not isinstance(
        method.precision, Double | Single
    ):  # T/n and its product with K, of which float64 has but 53 bits
        momentum = [Fraction(end) / steps * Fraction(float(x)) for x in K]
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


def _extrapolated(request: Request, step: float, every: int, frames: int, body: Any) -> Trajectory:
    """`extrapolate` as a trajectory of order 12."""
    found = extrapolate(
        request.ball, request.angular_momentum, request.gamma, step, frames * every, columns=COLUMNS, every=every,
        attitude=body, contact=request.of == "contact",
    )  # fmt: skip
    return Trajectory(
        request.ball, np.arange(frames + 1) * every, found.angular_momentum * step, found.gamma, found.attitude,
        found.contact, np.array(frames * every), found.status, step, EXTRAPOLATED,
    )  # fmt: skip
