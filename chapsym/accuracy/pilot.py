"""A short run of the very ball with a few lengths of step: how large the error of each order is, and how it grows.

Compared with order 8 at a short step, in float64.  The error of an order p is a power law in the step, C εᵖ, from the
shortest step that rounding leaves alone; between the measured steps it is taken on a log-log scale.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from chapsym.dynamics import BadInput, Ball, StepNotTaken, Trajectory, kernels
from chapsym.dynamics.ball import Floats
from chapsym.numbers import NAMED

from .methods import Method, take
from .request import Request, distance, lengths

#: The pilot turns the ball by so many radians, or to the end.
ANGLE = 40.0
#: Lengths of steps, |ω|ε in radians, of each order; and of the reference, of order 8.
LENGTHS = {2: (0.15, 0.05, 0.015), 4: (0.4, 0.2, 0.1), 6: (0.5, 0.3, 0.15), 8: (0.6, 0.4, 0.2), 12: (2.5, 1.25, 0.8)}
REFERENCE = 0.05
#: Times at which the pilot is compared.
CHECKS = 16
#: A ball that takes no step of this length takes none.
SHORTEST = 1e-9
DOUBLE = NAMED["double"]
#: The growth in time is a power between these: a random walk, and more than the linear drift of an integrable ball.
GROWTH = (0.5, 1.5)
#: An error below so many floors is rounding.
ABOVE = 30.0


@dataclass(frozen=True)
class Law:
    """The error of an order at the end: (step in seconds, error), the longest step first, and the power beyond them."""

    order: int
    points: list[tuple[float, float]]

    def error(self, step: float) -> float:
        """The error that is expected of a step; infinite where it is longer than any that the pilot could take."""
        if not self.points or step > self.points[0][0] * 1.001:
            return math.inf
        for (long, above), (short, below) in zip(self.points, self.points[1:], strict=False):
            if step >= short:
                share = math.log(long / step) / math.log(long / short)
                return above * (below / above) ** share
        short, below = self.points[-1]
        return below * (step / short) ** self.order

    def step(self, error: float) -> float:
        """The longest step whose expected error is at most `error`; 0 if none is."""
        if not self.points:
            return 0.0
        low, high = 0.0, self.points[0][0]
        if self.error(high) <= error:
            return high
        short, below = self.points[-1]
        if below > error:
            return float(short * (error / below) ** (1 / self.order))
        low = short
        for _ in range(60):
            middle = math.sqrt(low * high)
            low, high = (middle, high) if self.error(middle) <= error else (low, middle)
        return low

    def scaled(self, factor: float) -> "Law":
        """The law with all errors multiplied."""
        return replace(self, points=[(h, e * factor) for h, e in self.points])


def surveyed(request: Request) -> Request:
    """The request with the rates and the condition of its ball, from a short run of order 4.

    Raises StepNotTaken if no step can be taken, and BadInput if the ball has no angular velocity.
    """
    at_start = float(lengths(_omega(request, request.angular_momentum, request.gamma)))
    if at_start == 0.0:
        return replace(request, condition=1.0)
    window, length = min(request.time, ANGLE / at_start), 0.2
    while True:
        try:
            run = take(request, Method(DOUBLE, 4), _multiple(window * at_start / length), CHECKS, window)
            break
        except StepNotTaken:
            length /= 2
            if length < SHORTEST:
                raise
    omega = _omega(request, run.angular_momentum(), run.gamma)
    rates, rolling = lengths(omega), lengths(np.cross(omega, run.gamma))
    ball, g = _scaled(request.ball)[0], run.gamma[:, :, np.newaxis]
    tensor, contact = ball.inertia, float(ball.D)
    values = np.linalg.eigvalsh(np.diag(tensor + contact) - contact * g * g.mT)
    condition = float((values[:, -1] / np.maximum(values[:, 0], 1e-300)).max())
    return replace(
        request, rate=float(rates.max()), speed=float(rates.mean()), rolling=float(rolling.mean()), condition=condition
    )


def _omega(request: Request, K: Floats, gamma: Floats) -> Floats:
    ball, moment = _scaled(request.ball)
    size = int(np.frexp(abs(K).max())[1])
    with np.errstate(all="ignore"):
        unit = kernels.angular_velocity(np.ldexp(K, -size), gamma, ball.mass_tensor, ball.D)
        omega = np.ldexp(unit, size - moment)
        turned = lengths(omega) * request.time
    if not np.isfinite(unit).all():
        raise BadInput("the ball has no angular velocity at this gamma: no inertia about the vertical")
    if not np.isfinite(turned).all():
        raise BadInput("the ball turns too fast for float64: |ω|, or |ω|T, is beyond 1.8e308; take other units")
    return omega


def _scaled(ball: Ball) -> tuple[Ball, int]:
    """The ball in units in which its largest moment is about 1, and the power of two that was left out."""
    power = int(np.frexp(ball.inertia.max() / 2 + ball.D / 2)[1])
    return Ball(np.ldexp(ball.mass_tensor, -power), np.ldexp(ball.D, -power)), power


def pilot(request: Request, orders: Iterable[int]) -> dict[int, Law]:
    """The laws of these orders, by float64; that of the exact top has no points."""
    window = min(request.time, ANGLE / request.rate) if request.rate else request.time
    counted = _multiple(window * request.rate / REFERENCE)
    exact = take(request, Method(DOUBLE, 8), counted, CHECKS, window)
    floor = request.floor(DOUBLE, 17 * counted, True) * window / request.time
    measured = {order: _measured(request, order, window, exact, floor) for order in orders}
    growth = [power for _, powers in measured.values() for power in powers]
    factor = (request.time / window) ** float(np.clip(np.median(growth), *GROWTH) if growth else 1.0)
    return {order: Law(order, points).scaled(factor) for order, (points, _) in measured.items()}


def _measured(
    request: Request, order: int, window: float, exact: Trajectory, floor: float
) -> tuple[list[tuple[float, float]], list[float]]:
    """The (step, error) of an order, falling, and the powers of time with which those errors grow."""
    points: list[tuple[float, float]] = []
    powers = []
    for length in LENGTHS.get(order, ()):
        steps = _multiple(window * request.rate / length)
        try:
            errors = distance(request, take(request, Method(DOUBLE, order), steps, CHECKS, window), exact)
        except StepNotTaken:
            continue
        worst, half = float(errors.max()), float(errors[: CHECKS // 2].max())
        if points and (worst < ABOVE * floor or worst >= points[-1][1] or window / steps >= points[-1][0]):
            break
        points.append((window / steps, max(worst, floor)))
        if worst > ABOVE * floor and half > 0:
            powers.append(math.log2(worst / half))
    return points, powers


def _multiple(steps: float) -> int:
    """A number of steps that the checks divide."""
    return CHECKS * max(1, math.ceil(steps / CHECKS))
