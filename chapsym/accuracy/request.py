"""What is asked for, the norm in which it is asked, and what rounding alone leaves of it."""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np

from chapsym.dynamics import BadInput, Ball, Trajectory, kernels
from chapsym.dynamics.attitudes import initial_attitude
from chapsym.dynamics.ball import Floats, batch, numbers, unit_vertical
from chapsym.dynamics.certified import exactly
from chapsym.dynamics.trajectories import whole_number

#: What the accuracy may be of.
NORMS = ("state", "contact")
#: The coefficients of the compositions have 40 digits, and the times of a run are as exact as they.
FINEST = 1e-30


@dataclass(frozen=True, eq=False)
class Request:
    """The continuous ball (2.3) from K (kg m²/s) and γ for `time` seconds, to an absolute `accuracy` at every frame.

    of: "state", the larger of |ΔK|/|K| and |Δγ|; or "contact", the distance in metres.  An attitude that is asked for
    counts, too: its angle in radians, or how far that moves the surface, in metres.
    frames: how many equal times, the last of them the end.  attitude: True, or a unit quaternion to be followed.
    """

    ball: Ball
    angular_momentum: Floats
    gamma: Floats
    time: float
    accuracy: float
    of: str = "state"
    frames: int = 1
    attitude: Any = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "angular_momentum", numbers(self.angular_momentum, "angular_momentum", 3))
        object.__setattr__(self, "gamma", unit_vertical(self.gamma))
        shape, (_, g, *_) = batch(self.ball, self.angular_momentum, self.gamma)
        if shape:
            raise BadInput("an accuracy is asked for one ball; a batch takes steps that you choose")
        for name in ("time", "accuracy"):
            object.__setattr__(self, name, _positive(getattr(self, name), name))
        if not isinstance(self.of, str) or self.of not in NORMS:
            raise BadInput(f'of must be "state" or "contact", not {self.of!r}')
        if self.of == "contact" and self.ball.radius is None:
            raise BadInput("the contact point needs the radius: give the ball its mass and radius")
        object.__setattr__(self, "frames", whole_number(self.frames, "frames", 1))
        if self.accuracy < FINEST:
            raise BadInput(f"accuracy must be at least {FINEST:g}: the compositions' coefficients have 40 digits")
        if isinstance(self.attitude, bool | np.bool_):
            object.__setattr__(self, "attitude", bool(self.attitude))
        else:
            object.__setattr__(self, "attitude", initial_attitude(self.attitude, g[0]))
        if self.body is True:
            # Left to the run: every precision makes the least rotation in its own numbers.  What squares to nothing
            # turns one of wider range by another half turn than float64, where γ is upside down.
            object.__setattr__(self, "gamma", np.where(abs(self.gamma) < 1e-150, 0.0, self.gamma))

    @property
    def body(self) -> Any:
        """The attitude that a run follows, as `trajectory` takes it."""
        return True if self.attitude is False and self.of == "contact" else self.attitude

    @cached_property
    def rate(self) -> float:
        """|ω| at the start, in rad/s; raises BadInput for what has none."""
        K, gamma = self.angular_momentum, self.gamma
        ball, moment = self._scaled()
        size = int(np.frexp(abs(K).max())[1])
        with np.errstate(all="ignore"):
            unit = kernels.angular_velocity(np.ldexp(K, -size), gamma, ball.mass_tensor, ball.D)
            rate = float(lengths(np.ldexp(unit, size - moment)))
            turned = rate * self.time
        if not np.isfinite(unit).all():
            raise BadInput("the ball has no angular velocity at this gamma: no inertia about the vertical")
        if not math.isfinite(turned):
            raise BadInput("the ball turns too fast for float64: |ω|, or |ω|T, is beyond 1.8e308; take other units")
        return rate

    @cached_property
    def condition(self) -> float:
        """Of Λ - Dγγᵀ, at most."""
        ball = self._scaled()[0]
        least = float(ball.inertia.min())
        return float(ball.inertia.max() + ball.D) / least if least > 0 else math.inf

    def _scaled(self) -> tuple[Ball, int]:
        """The ball in units in which its largest moment is about 1, and the power of two that was left out."""
        ball = self.ball
        power = int(np.frexp(ball.inertia.max() / 2 + ball.D / 2)[1])
        return Ball(np.ldexp(ball.mass_tensor, -power), np.ldexp(ball.D, -power)), power

    @property
    def angle(self) -> float:
        """About how far the ball turns, in radians."""
        return self.rate * self.time

    @property
    def unit(self) -> float:
        """What a relative error of the motion comes to in the norm: 1, or the radius in metres."""
        return float(self.ball.radius) if self.of == "contact" else 1.0  # type: ignore[arg-type]


def _positive(value: Any, name: str) -> float:
    found = numbers(value, name)
    if found.ndim or not found > 0:
        raise BadInput(f"{name} must be one positive number, not {value!r}")
    return float(found)


def distance(request: Request, run: Trajectory, other: Trajectory) -> Floats:
    """How far apart two runs of the same steps are in the request's norm, at each frame but the first, (frames,).

    Both are in float64 or in double-double.
    """
    if request.of == "contact":
        found = lengths(_difference(run, other, "contact"))
    else:
        size = float(lengths(request.angular_momentum)) or 1.0
        momentum, gamma = (lengths(_difference(run, other, name)) for name in ("momentum", "gamma"))
        found = np.maximum(momentum / size, gamma)
    if request.attitude is False:
        return found
    return np.maximum(found, 2 * request.unit * lengths(_difference(run, other, "attitude")))


def _difference(run: Trajectory, other: Trajectory, name: str) -> Floats:
    off = (getattr(run, name) - getattr(other, name)) + (_rest(run, name) - _rest(other, name))
    return np.asarray(off / run.time_step if name == "momentum" else off)[1:]


def _rest(run: Trajectory, name: str) -> Any:
    """What double-double numbers have beyond float64."""
    return 0.0 if run.low is None else getattr(run.low, name)


def lengths(v: np.ndarray) -> Floats:
    """The lengths of vectors, (..., n) floats or Fractions, whose squares float64 need not hold; (...)."""
    v = v.astype(float)
    largest = abs(v).max(axis=-1, keepdims=True)
    unit = v / np.where(largest > 0, largest, 1.0)
    return np.asarray(np.sqrt((unit * unit).sum(axis=-1)) * largest[..., 0])


def exact_values(request: Request, run: Trajectory, name: str) -> np.ndarray:
    """`contact`, `gamma`, `attitude`, or `momentum` over the time step: floats, or Fractions where they fall short."""
    high = getattr(run, name)
    if run.low is None and high.dtype != object:
        return np.asarray(high.astype(float) / (run.time_step if name == "momentum" else 1.0))
    whole = exactly(run, name)
    return np.asarray(whole * (int(run.index[-1]) / Fraction(request.time)) if name == "momentum" else whole)
