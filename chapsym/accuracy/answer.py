"""One ball to an accuracy: long steps in double precision, or in double-double, each with its own error estimate."""

from __future__ import annotations

import math
import time as clock
from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from chapsym.dynamics import BadInput, Ball, Status, StepNotTaken, Trajectory, extrapolate, trajectory
from chapsym.dynamics.attitudes import attitude_with, initial_attitude
from chapsym.dynamics.ball import Floats, batch, callback, checked_before, is_flag, numbers, one_of, unit_vertical
from chapsym.dynamics.certified import exactly
from chapsym.dynamics.coefficients import substeps
from chapsym.dynamics.extrapolation import MOST_OF_PAIRS, Extrapolated, stages_of, weights
from chapsym.dynamics.levels.proved import lengths
from chapsym.dynamics.loops.double_double import FIRST
from chapsym.dynamics.loops.expected import CONDITION, ENDLESS
from chapsym.dynamics.map import MOST_STEPS as MOST_FRAMES
from chapsym.dynamics.map import time_limit, until, whole_number
from chapsym.dynamics.results import some_frames
from chapsym.numbers import NAMED, Digits, Double, DoubleDouble, Pair, Precision, Single, brief, in_words, pairs

from . import motion
from .motion import FEWEST, LESS, LIKELY, MARGIN, Motion, Problem

#: The quantities that an accuracy may refer to.
NORMS = ("state", "contact")
#: The digits of the coefficients of compositions, and of the times of a run.
LEAST = 1e-30
#: The orders of `trajectory`, the highest of `extrapolate` in double-double, and that of a steady rotation.
COMPOSED, OF_PAIRS, STEADY = (2, 4, 6, 8), 2 * MOST_OF_PAIRS, 0
#: The least number whose 106 bits, in a stage of a composition in double-double, are within the range of float64.
SMALLEST = 2.0**-900
#: The least number of times at which runs are compared: a difference may be small by chance at a single time.
CHECKS, FEW = 16, 4


@dataclass(frozen=True, eq=False)
class Request:
    """The continuous ball (2.3) from K (kg m²/s) and γ for `time` seconds, to an absolute `accuracy` at every frame.

    of: "state", the larger of |ΔK|/|K| and |Δγ|; or "contact", the distance in metres.  A followed attitude counts,
    too: its angle in radians, or, in metres, this angle times the radius.
    frames: the number of equal time intervals.
    attitude: True, or a unit quaternion to be followed.
    """

    ball: Ball
    angular_momentum: Floats
    gamma: Floats
    time: float
    accuracy: float
    of: str = "state"
    frames: int = 1
    attitude: bool | Floats = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "angular_momentum", numbers(self.angular_momentum, "angular_momentum", 3))
        object.__setattr__(self, "gamma", unit_vertical(self.gamma))
        shape, (_, g, *_) = batch(self.ball, self.angular_momentum, self.gamma)
        if shape:
            raise BadInput("an accuracy is asked for one ball; a batch takes steps that you choose")
        for name in ("time", "accuracy"):
            object.__setattr__(self, name, _positive(getattr(self, name), name))
        object.__setattr__(self, "of", one_of(self.of, "of", *NORMS))
        if self.of == "contact" and self.ball.radius is None:
            raise BadInput("the contact point needs the radius: give the ball its mass and radius")
        object.__setattr__(self, "frames", whole_number(self.frames, "frames", 1, MOST_FRAMES))
        if self.accuracy < LEAST:
            raise BadInput(f"accuracy must be at least {LEAST:g}: the compositions' coefficients have 40 digits")
        followed = bool(self.attitude) if is_flag(self.attitude) else initial_attitude(self.attitude, g[0])
        object.__setattr__(self, "attitude", followed)
        if self.body is True:
            # The run computes the least rotation at its own precision.  For γ upside down, components whose squares
            # underflow in float64 select another half turn at a precision of wider range.
            object.__setattr__(self, "gamma", np.where(abs(self.gamma) < 1e-150, 0.0, self.gamma))

    @property
    def body(self) -> bool | Floats:
        """The followed attitude, as the argument of `trajectory`."""
        return True if self.attitude is False and self.of == "contact" else self.attitude

    @cached_property
    def problem(self) -> Problem:
        """The request as a problem for double precision."""
        ball, metres, attitude = self.ball, self.of == "contact", self.attitude
        start = None if self.body is False else attitude_with(self.gamma) if isinstance(attitude, bool) else attitude
        given = (ball.mass_tensor, ball.D, ball.radius, self.angular_momentum, self.gamma, start)
        one: Any = [None if x is None else np.array(x)[np.newaxis] for x in given]
        tensor, D, radius, K, gamma, first = one
        parts = {"contact"} if metres else {"momentum", "gamma"}
        return Problem(
            checked_before(tensor, D, radius), K, gamma, self.time / self.frames, self.frames, self.accuracy, first,
            metres, metres, frozenset(parts if attitude is False else parts | {"attitude"}),
        )  # fmt: skip

    @property
    def rate(self) -> float:
        """|ω| at the start, in rad/s; raises BadInput if K does not determine it."""
        rate = float(self.problem.rate[0])
        if not math.isfinite(rate) and self.condition >= ENDLESS:
            raise BadInput("the ball has no angular velocity at this gamma: no inertia about the vertical")
        if not math.isfinite(rate * self.time):
            raise BadInput("the ball turns too fast for float64: |ω|, or |ω|T, is beyond 1.8e308; take other units")
        return rate

    @property
    def condition(self) -> float:
        """An upper bound of the condition number of Λ - Dγγᵀ."""
        return float(self.problem.survey[CONDITION, 0])

    @property
    def angle(self) -> float:
        """The approximate angle that the ball turns, in radians."""
        return self.rate * self.time

    @property
    def unit(self) -> float:
        """The norm of a relative error 1 of the motion: 1, or the radius in metres."""
        return float(self.ball.radius) if self.of == "contact" else 1.0  # type: ignore[arg-type]


def _positive(value: ArrayLike, name: str) -> float:
    found = numbers(value, name)
    if found.ndim or not found > 0:
        raise BadInput(f"{name} must be one positive number, not {brief(value)}")
    return float(found)


def distance(request: Request, run: Trajectory, other: Trajectory) -> Floats:
    """The distance of two runs with the same frames in the norm of the request, at each frame but the first, (frames,).

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


def _rest(run: Trajectory, name: str) -> Floats | float:
    """The low halves of double-double numbers."""
    return 0.0 if run.low is None else getattr(run.low, name)


def exact_values(request: Request, run: Trajectory, name: str) -> np.ndarray:
    """`contact`, `gamma`, `attitude`, or `momentum` over the time step: floats, or Fractions where they fall short."""
    high = getattr(run, name)
    if run.low is None and high.dtype != object:
        return np.asarray(high.astype(float) / (run.time_step if name == "momentum" else 1.0))
    whole = exactly(run, name)
    return np.asarray(whole * (int(run.index[-1]) / Fraction(request.time)) if name == "momentum" else whole)


@dataclass(frozen=True)
class Method:
    """A precision and an order: 2 to 8; from 10 on for `extrapolate`; 0 for a steady rotation."""

    precision: Precision
    order: int

    @property
    def label(self) -> str:
        """The name of the precision, with its digits."""
        return label_of(self.precision)

    @property
    def columns(self) -> int:
        """The columns of `extrapolate`; 0 for the other methods."""
        return self.order // 2 if self.order > COMPOSED[-1] else 0

    @property
    def stages(self) -> int:
        """Steps of the map in a step."""
        if self.columns:
            return stages_of(self.columns, FIRST if isinstance(self.precision, DoubleDouble) else 0)
        return len(substeps(self.order or 2))


def label_of(precision: Precision) -> str:
    """The name of a precision in JSON and in the measured prices: "double", "digits30"; "quad" for double-double."""
    if isinstance(precision, Digits):
        return f"digits{precision.count}"
    return "quad" if isinstance(precision, DoubleDouble) else type(precision).__name__.lower()


def methods(precision: Precision) -> list[Method]:
    """All methods at a precision."""
    found = [Method(precision, order) for order in COMPOSED]
    if precision == NAMED["double-double"]:
        found.append(Method(precision, OF_PAIRS))
    if precision == NAMED["double"]:
        found.append(Method(precision, motion.EXTRAPOLATED))
    return found


def checks(request: Request, method: Method) -> int:
    """The number of equal times at which two runs are compared, a multiple of the frames: few for long steps."""
    least = FEW if method.columns else CHECKS
    return request.frames * -(-least // request.frames)


def take(
    request: Request, method: Method, steps: int, frames: int, progress: Callable[[int], None] = lambda done: None
) -> Trajectory:
    """The ball after `frames` equal parts of the time, in `steps` steps, a multiple of `frames`.

    progress: called with the steps done.  Raises StepNotTaken if the map has no step of this length.
    """
    exactly, every = Fraction(request.time) / steps, steps // frames
    step = request.time / steps
    in_range(step, request.angular_momentum)
    if method.columns:
        return _extrapolated(request, method, exactly, every, frames, progress)
    momentum: Any = step * request.angular_momentum
    if not isinstance(method.precision, Double | Single):  # of T/n and its product with K float64 has but 53 bits
        momentum = [exactly * Fraction(float(x)) for x in request.angular_momentum]
    return trajectory(
        request.ball, momentum, request.gamma, steps, order=method.order, every=every, attitude=request.body,
        contact=request.of == "contact", time_step=step, precision=method.precision, progress=progress,
    )  # fmt: skip


def in_range(step: float, K: Floats) -> None:
    """Raises BadInput if the step or εK is so small that float64 loses digits of it, which no comparison shows."""
    largest = float(abs(K).max())
    if step < SMALLEST or 0.0 < step * largest < SMALLEST:
        what = "a step of ε = T/n" if step < SMALLEST else "εK"
        raise BadInput(f"{what} is below {SMALLEST:.0e}, where float64 loses digits; take other units of time or mass")


def _extrapolated(
    request: Request, method: Method, step: Fraction, every: int, frames: int, progress: Callable[[int], None]
) -> Trajectory:
    """`extrapolate` as a trajectory."""
    of_pairs = isinstance(method.precision, DoubleDouble)
    found = extrapolate(
        request.ball, request.angular_momentum, request.gamma, step if of_pairs else float(step), frames * every,
        columns=method.columns, every=every, attitude=request.body, contact=request.of == "contact",
        precision=method.precision, progress=progress,
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


#: Nominal seconds of a stage in double-double.
STAGE = 3e-7
#: The assumed unit roundoff of double-double: a few units of its last place.
ROUNDED = 2.0**-103
#: The relative change of K at the start by which the growth of errors is measured; and the fraction of the expected
#: rounding error that grows so: of 95 runs from one start near an unstable rotation the largest had 1/50.
MOVED, GROWING = 2.0**-45, 1 / 16
MOST_STEPS = 2**53


@dataclass(frozen=True)
class Choice:
    """A method, the number of its steps, their mean length in seconds, and nominal seconds with its verification."""

    method: Method
    steps: int
    time_step: float
    seconds: float

    def sentence(self) -> str:
        """The choice as text."""
        order = f"order {self.method.order}" if self.method.order != STEADY else "steady rotation"
        order = f"extrapolated to {order}" if self.method.columns else order
        return f"{in_words(self.method.label)}, {order}, {self.steps} steps of {self.time_step:.6g} s"


@dataclass(frozen=True)
class Attempt:
    """A choice, its estimated error (infinite if a step could not be taken), and its processor seconds."""

    choice: Choice
    estimate: float
    seconds: float


@dataclass(frozen=True, eq=False)
class Accurate:
    """A run that meets its request.

    Attributes
    ----------
    trajectory : Trajectory
        The states at the requested times; its order is 12 or more for long steps, 0 for a steady rotation.
    request : Request
        The request.
    attempts : list of Attempt
        All attempts; the last one is the result.
    seconds : float
        The processor seconds of all attempts.

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.Ball((1, 2, 4), 3)
    >>> found = chapsym.accurate(ball, (1, -0.5, 0.75), (2/7, 3/7, 6/7), 10, 1e-9, frames=4)
    >>> found.trajectory.time.tolist()
    [0.0, 2.5, 5.0, 7.5, 10.0]
    >>> found.estimate < 1e-9
    True
    """

    trajectory: Trajectory
    request: Request
    attempts: list[Attempt]
    seconds: float

    @property
    def choice(self) -> Choice:
        """The choice of the last attempt: precision, order and steps."""
        return self.attempts[-1].choice

    @property
    def estimate(self) -> float:
        """The estimate of the largest error at the requested times, in the norm of the request."""
        return self.attempts[-1].estimate

    def final(self) -> dict[str, list[float] | list[str]]:
        """K, γ and the contact point at the end: floats, or decimal strings of numbers with more digits."""
        names = {"angular_momentum": "momentum", "gamma": "gamma", "contact": "contact"}
        run, precision = self.trajectory, self.choice.method.precision
        there = {quantity: name for quantity, name in names.items() if getattr(run, name) is not None}
        values = {quantity: exact_values(self.request, run, name)[-1] for quantity, name in there.items()}
        if isinstance(precision, Single | Double):
            return {quantity: [float(x) for x in v] for quantity, v in values.items()}
        written = Digits(precision.digits)
        return {quantity: [written.write(written.number(x)) for x in v] for quantity, v in values.items()}


def accurate(
    ball: Ball,
    angular_momentum: ArrayLike,
    gamma: ArrayLike,
    time: float,
    accuracy: float,
    *,
    of: str = "state",
    frames: int = 1,
    attitude: bool | ArrayLike = False,
    limit: float = 600.0,
    progress: Callable[[str], None] = lambda text: None,
) -> Accurate:
    """Follows the continuous ball (2.3) for `time` seconds to an absolute `accuracy`, by the cheapest method.

    In double precision the error is estimated as by `roll`; if that is not accurate enough, long steps in double-double
    are compared with steps of a lower order.

    Parameters
    ----------
    ball : Ball
        One ball.
    angular_momentum : array_like
        K in kg m²/s, shape (3,).
    gamma : array_like
        The unit vertical, upwards, shape (3,).
    time : float
        The duration of the motion, in seconds.
    accuracy : float
        The largest error, in the norm `of`.
    of : str, optional
        "state" (the default), the larger of |ΔK|/|K| and |Δγ|; or "contact", the distance of the contact points in
        metres (it needs `ball.radius`).
    frames : int, optional
        The number of equal intervals of `time`, by default 1; the accuracy refers to the end of each.
    attitude : bool or array_like, optional
        True or a unit quaternion, (4,), to be followed; its angle counts, too.
    limit : float, optional
        Seconds after which it stops at its next report of progress, by default 600; it does not begin if it is
        expected to take longer.
    progress : callable, optional
        Called with a sentence on the method before each attempt, and on its progress.

    Returns
    -------
    Accurate
        The trajectory, and an estimate of its error.

    Raises
    ------
    BadInput
        For a request that cannot be met: if it takes longer than the limit, or is finer than every precision.

    References
    ----------
    Equation (2.3) of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.Ball((1, 2, 4), 3)
    >>> found = chapsym.accurate(ball, (1, -0.5, 0.75), (2/7, 3/7, 6/7), 10, 1e-20)
    >>> found.choice.sentence()
    'double-double, extrapolated to order 24, 4 steps of 2.5 s'
    >>> [x[:20] for x in found.final()["gamma"]]
    ['0.844567313551555566', '-0.53533087692888346', '0.011265215792919715']
    """
    callback(progress)
    request = Request(ball, angular_momentum, gamma, time, accuracy, of, frames, attitude)  # type: ignore[arg-type]
    return answered(request, limit, progress)


def answered(request: Request, limit: float, progress: Callable[[str], None]) -> Accurate:
    """`accurate` of a request."""
    started, say = clock.process_time(), until(limit, progress)
    problem, choice = _foreseen(request, limit)
    say(choice.sentence())
    attempts: list[Attempt] = []
    if problem is not None:
        found = motion.moved(problem, lambda part: say(f"{choice.sentence()}: {part:.0%}"))
        if found.status[0] == Status.TAKEN:
            steps = max(int(found.total[0]), 1)
            made = Choice(Method(NAMED["double"], int(found.order[0])), steps, request.time / steps, choice.seconds)
            attempts.append(Attempt(made, float(found.error[0]), clock.process_time() - started))
            if found.error[0] <= request.accuracy:
                run = _as_trajectory(request, found)
                return Accurate(run, request, attempts, clock.process_time() - started)
        say(_doubled(request, limit).sentence())
    run = _by_double_double(request, limit, attempts, say)
    return Accurate(run, request, attempts, clock.process_time() - started)


def foreseen(request: Request, limit: float) -> Choice:
    """The choice that `answered` would try first; raises BadInput likewise."""
    return _foreseen(request, limit)[1]


def _foreseen(request: Request, limit: float) -> tuple[Problem | None, Choice]:
    """The problem in double precision, None if that lacks the accuracy, and the first choice."""
    limit = time_limit(limit)
    in_range(request.time, request.angular_momentum)
    problem = request.problem
    if request.accuracy >= motion.FINEST * request.unit and problem.floor <= motion.ROUNDING * request.accuracy:
        steps, method = max(round(problem.long_steps), 1), Method(NAMED["double"], motion.EXTRAPOLATED)
        return problem, _within(Choice(method, steps, request.time / steps, motion.nominal(problem)), limit)
    return None, _doubled(request, limit)


def _as_trajectory(request: Request, found: Motion) -> Trajectory:
    """A motion as a trajectory whose time step is the time between its frames."""
    step = request.time / request.frames
    return Trajectory(
        request.ball, np.arange(request.frames + 1), found.angular_momentum[0] * step, found.gamma[0],
        None if found.attitude is None else found.attitude[0], None if found.contact is None else found.contact[0],
        np.array(request.frames), found.status[0], step, int(found.order[0]),
    )  # fmt: skip


def _within(choice: Choice, limit: float) -> Choice:
    """The choice, if it is within the seconds left; else raises BadInput."""
    if choice.seconds > limit:
        raise BadInput(
            f"the cheapest run ({choice.sentence()}) would take about {choice.seconds:.2g} s, "
            f"but the limit is {limit:g} s; ask for less accuracy or time, or raise the limit"
        )
    return choice


def _doubled(request: Request, limit: float, finer: float = 1.0, noisy: float = 1.0) -> Choice:
    """Long steps in double-double with the fewest stages, `finer` times as many as by the law.

    noisy: the factor from the expected to the observed rounding error.
    Raises BadInput if rounding alone is larger than the accuracy, or the steps are too many, or take too long.
    """
    precision, found = NAMED["double-double"], []
    for columns in range(FEWEST, MOST_OF_PAIRS + 1):
        method = Method(precision, 2 * columns)
        wanted = finer * motion.steps_of(columns, request.angle, request.unit, request.accuracy)
        if not wanted < MOST_STEPS:
            continue
        every = checks(request, method)
        steps = every * max(1, math.ceil(wanted / every))
        seconds = steps * motion.stages(columns) * STAGE
        if noisy * _rounded(request, columns, steps) <= motion.ROUNDING * request.accuracy:
            found.append(Choice(method, steps, request.time / steps, seconds))
    if not found and request.condition >= ENDLESS:
        raise BadInput(motion.NO_INERTIA)
    if not found:
        raise BadInput(
            f"an accuracy of {request.accuracy:g} after {request.time:g} s cannot be had: it takes too many steps, "
            "or rounding alone is larger at every precision"
        )
    return _within(min(found, key=lambda choice: choice.seconds), limit)


def _rounded(request: Request, columns: int, steps: int) -> float:
    """The expected rounding error of long steps in double-double, amplified by their weights."""
    # No comparison shows the rounding of J, D, K and γ; the factor is the least one that covered about twenty random
    # balls.
    shared = 2 * ROUNDED * math.sqrt(request.condition) * (1 + request.angle) * request.unit
    path = request.angle if request.of == "contact" else 0.0
    weight = float(sum(map(abs, weights(columns, FIRST))))
    return shared + ROUNDED * weight * math.sqrt(request.condition * steps) * (1 + path) * request.unit


def _by_double_double(
    request: Request, limit: float, attempts: list[Attempt], progress: Callable[[str], None]
) -> Trajectory:
    """Long steps in double-double, verified by a run with fewer columns, and shortened until they are accurate."""
    finer, noisy, before, K = 1.0, 1.0, math.inf, request.angular_momentum
    nearby = replace(request, angular_momentum=K + MOVED * lengths(K) * motion.ASIDE)
    # In most motions an error of the start grows as one of the rate does.
    usual = MOVED * math.sqrt(request.condition) * (1 + request.angle) * request.unit
    for _ in range(motion.ATTEMPTS):
        started = clock.process_time()
        choice = _doubled(request, limit, finer, noisy)
        method, every = choice.method, checks(request, choice.method)
        fewer, apart, longer = Method(method.precision, method.order - 2 * LESS), math.inf, 2.0

        def report(before: int, done: int, choice: Choice = choice) -> None:
            """Reports the completed part of the run and of its comparison run."""
            progress(f"{choice.sentence()}: {(before + done) / (3 * choice.steps):.0%}")

        try:
            run = take(request, method, choice.steps, every, partial(report, 0))
            other = take(request, fewer, choice.steps, every, partial(report, choice.steps))
            moved = take(nearby, fewer, choice.steps, every, partial(report, 2 * choice.steps))
            apart, grown = (float(distance(request, x, other).max()) for x in (run, moved))
            noisy = max(noisy, GROWING * grown / usual)
            longer = (apart / (MARGIN * request.accuracy)) ** (1 / fewer.order)
        except StepNotTaken as error:
            if error.status == Status.NO_INERTIA:
                raise BadInput(f"the ball cannot be followed: {error}") from None
        rounded = _rounded(request, method.columns, choice.steps)
        estimate = LIKELY * apart + noisy * rounded  # with the largest observed noise: one sample may be small
        attempts.append(Attempt(choice, estimate, clock.process_time() - started))
        if estimate <= request.accuracy:
            return some_frames(run, slice(None, None, every // request.frames))
        if before / 2 < apart < math.inf:  # amplified roundings: fewer columns have less
            noisy = max(noisy, LIKELY * apart / rounded)
        else:
            finer *= min(max(motion.LEAST_FINER, longer), motion.MOST_FINER)
        before = apart
    best = min(one.estimate for one in attempts)
    raise BadInput(
        f"no run was verified to {request.accuracy:g} in {motion.ATTEMPTS} attempts; the best differed by {best:.2g}"
    )
