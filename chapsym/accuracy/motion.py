"""A ball in SI units: its continuous motion at equal times to an accuracy, or the map instead.

Each ball has long steps of order 12, as long as the accuracy allows; frames inside a step are interpolated
(`loops.following`).  The stated error is the sum of the errors of all steps, transported by the flow (`loops.carried`).
It is an estimate, since the size of the error of a step (`loops.following.left`) and its direction are estimates.  A
ball whose error is larger than the accuracy is followed again with shorter steps.

A ball for which the rounding of these steps is too large is followed in double-double, by long steps of order up to 24.
A run is compared with the motion by long steps in double precision, or with a run of a lower order, which starts a few
roundings away, to show the sensitivity of the ball to its start; the estimate is `LIKELY` times their difference.
Frames inside a step are reached from its start in double precision.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from chapsym.dynamics import Ball, Status, Trajectory, extrapolate, is_steady, kernels, native, trajectory
from chapsym.dynamics.attitudes import attitude_with, initial_attitude
from chapsym.dynamics.ball import (
    Asked,
    Floats,
    batch,
    brief,
    callback,
    checked_before,
    exact_array,
    is_flag,
    numbers,
    one_of,
    over_states,
    unit_vertical,
)
from chapsym.dynamics.enclosed_motion import of_motion
from chapsym.dynamics.errors import BadInput, StepNotTaken
from chapsym.dynamics.extrapolation import FEW, MOST_OF_PAIRS, loop_weights, of_some, stages_of
from chapsym.dynamics.levels.frames import Count, cores, share, watched
from chapsym.dynamics.levels.proved import lengths
from chapsym.dynamics.loops import double_double, expected, following, records
from chapsym.dynamics.loops.following import REPORTED, STEPS, UNTIL, follow, follow_alone
from chapsym.dynamics.loops.lanes import MOST_COLUMNS
from chapsym.dynamics.map import MOST_STEPS, flag, rolling_radius, seconds, whole_number
from chapsym.dynamics.results import finished, in_given_axes, of_balls, put_at
from chapsym.generated import contact_momentum
from chapsym.numbers import Digits, Enclosure, Precision, is_a

HERE = (0.0, 0.0)
#: Momenta in this range need no further checks.
ORDINARY = 1e-290, 1e290
#: The reach of a ball that stops.
UNKNOWN = np.full(1, np.nan)
#: The default accuracy: an error of this size is neither visible nor measurable.
DEFAULT = 1e-6
#: The finest accuracy of double precision, and the fraction of an accuracy that rounding may take.
FINEST, ROUNDING = 1e-12, 0.5
#: The largest number of runs of a ball by long steps, and the fraction of the accuracy at which those after the first
#: aim.
TRIES, AIM = 4, 0.4
#: The error of the start, in roundings, which then grow with the motion.
SENSITIVE = 16.0
#: The least factor that is applied to the error of a step at once.
FINER = 1e-6
#: The number of balls in a block of a core, and the seconds of a long step and of a frame.
TOGETHER, STEP, FRAME = 64, 1.5e-6, 2e-7
#: Nominal seconds up to which a run is not watched, and the largest reported part of a ball in progress.
QUICK, MOSTLY = 0.2, 0.99
#: The quantities that an accuracy may refer to.
PARTS = frozenset({"momentum", "gamma", "omega", "attitude", "contact"})
#: Quantities with errors as large as those of the attitude.
TURNED = frozenset({"momentum", "gamma", "attitude"})
#: The order of long steps with all columns.
EXTRAPOLATED = 2 * MOST_COLUMNS
#: The vertical in space; and the signs of the conjugate quaternion.
_UP, _INVERSE = np.array([0.0, 0.0, 1.0]), np.array([1.0, -1.0, -1.0, -1.0])
#: In double-double the error of c columns after t seconds is about DOUBLED^c (|ω|h)^(2c) (1 + |ω|t), within a factor of
#: five of the median of 40 random balls.  LONGEST is the longest trial step in radians, and MARGIN the fraction of the
#: accuracy at which the law aims.
DOUBLED, LONGEST, MARGIN = 0.0125, 2.0, 0.1
#: Runs have at least FEWEST columns, and are compared with runs of LESS columns fewer, also of high order.
FEWEST, LESS = 7, 2
#: The least part of the long steps in double precision; and the largest estimate of these, in accuracies, that is
#: compared with a run in double-double, if it is SMALL: of runs that are far from the motion any two may agree.
SHARE, NEAR, SMALL = 0.5, 100.0, 1e-3
#: The factor from the distance of two runs to the error estimate: if both are exact to rounding, it is one sample.
LIKELY = 4.0
#: The least number of times at which two runs are compared: at one time they may agree by chance, after different ways.
COMPARED = 32
#: The difference of the start of a verifying run from that of the run, in roundings.
ROUNDED = 2
#: A generic direction.
ASIDE = np.array([0.6, 0.64, 0.48])
#: The largest number of trial runs, and the least and the largest ratio of the steps of successive runs.
ATTEMPTS, LEAST_FINER, MOST_FINER = 8, 1.2, 4.0


@np.errstate(under="ignore")
def roll(
    ball: Ball,
    omega: ArrayLike,
    time_step: float,
    steps: int,
    *,
    gamma: ArrayLike | None = None,
    axes: Literal["body", "space"] = "body",
    every: int = 1,
    attitude: bool | ArrayLike = False,
    contact: bool = False,
    position: ArrayLike = HERE,
    accuracy: float | None = None,
    order: int | None = None,
    precision: str | Precision | None = None,
    map: bool = False,
    proved: bool = False,
    threads: int = 0,
    progress: Callable[[int], None] = lambda steps_done: None,
) -> Trajectory:
    """Rolls a ball without slipping (2.3), and keeps its state every `every` times `time_step` seconds.

    Parameters
    ----------
    ball : Ball
        One ball or a batch, (...).
    omega : array_like
        The angular velocity at the start in rad/s, shape (..., 3), in body axes (those of the inertia tensor) or in
        space axes.
    time_step : float
        In seconds: the duration is `steps` times `time_step`; the solver chooses its own steps.
    steps : int
        The number of time steps.
    gamma : array_like, optional
        The unit vertical, upwards, in body axes, shape (..., 3); by default from the attitude, or (0, 0, 1).
    axes : str, optional
        The axes of `omega`: "body" (the default) or "space".
    every : int, optional
        The number of time steps from one frame to the next; by default 1.
    attitude : bool or array_like, optional
        True (from the least rotation with R γ = e₃) or unit quaternions, body to space, (..., 4), to be followed.
    contact : bool, optional
        Whether to trace the contact point; it needs `ball.radius`, and implies the attitude.
    position : array_like, optional
        The contact point at the start in m, shape (..., 2); by default (0, 0).
    accuracy : float, optional
        The accuracy at every frame, by default 1e-6: of γ; of K, ω and the contact point, relative to |K|, the largest
        |ω| and the radius; and of the attitude in radians.  `error` of the result estimates the error that was reached:
        the errors of all steps, transported by the flow.  It is larger than the accuracy if a start is too near to a
        separatrix.
    order : int, optional
        As of `trajectory`; it replaces the motion by the map, as `map` does.
    precision : str or Precision, optional
        As of `trajectory`; it replaces the motion by the map, as `map` does.  On `Digits` and `Enclosure` 𝒦 is that
        of the numbers as given; what an attitude turns, γ or ω of the axes of space, has the digits of float64.
    map : bool, optional
        Whether to compute the map in steps of `time_step` instead of the motion, as `trajectory` does, with
        𝒦 = ε(Λω - D⟨ω,γ⟩γ).
    proved : bool, optional
        Whether `Trajectory.proved` bounds the error of every frame, compared with the motion of the ball that starts at
        the numbers of frame 0, by `certified_motion`, which takes a thousand times as long: a frame that is not reached
        in 600 s has inf.  With `map`, as `trajectory` does.  Only for one ball in principal axes.
    threads : int, optional
        As of `trajectory`.
    progress : callable, optional
        As of `trajectory`; with `proved`, also with all steps whenever the proof has taken one of its own.

    Returns
    -------
    Trajectory
        The states, for the motion with `error`.  In a batch, the others continue if a ball cannot be followed, and
        `status` shows which stopped.

    Raises
    ------
    StepNotTaken
        For one ball that cannot be followed.
    BadInput
        For arguments that no ball or run can have, and for an accuracy beyond double precision.

    References
    ----------
    Equation (2.3) of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.Ball.from_inertia((0.006, 0.007, 0.009), mass=2.0, radius=0.1)
    >>> run = chapsym.roll(ball, (3, -2, 1), 0.01, 100, contact=True)
    >>> float(run.time[-1]), run.contact[-1].round(5).tolist()
    (1.0, [-0.19825, -0.2945])
    >>> bool(run.error < 1e-6)
    True
    """
    callback(progress)
    axes = one_of(axes, "axes", "body", "space")
    spin, vertical, turned = _start(ball, omega, gamma, attitude, axes)
    place = None if position is HERE else numbers(position, "position", 2)
    if place is not None and place.ndim > 1:
        place = over_states(place, "position", batch(ball.principal, spin, vertical)[0])
    by_map = flag(map, "map") or order is not None or precision is not None
    if by_map and accuracy is not None:
        raise BadInput("accuracy is of the motion of the ball; leave out order, precision and map")
    if flag(proved, "proved") and (ball.axes is not None or not ball.is_one or spin.ndim > 1 or vertical.ndim > 1):
        raise BadInput("proved=True takes one ball in principal axes, and all vectors in these")
    try:
        if by_map and is_a(precision, Digits, Enclosure) and ball.axes is None:
            turned_before = axes == "space" and not (gamma is None and isinstance(turned, bool))
            momentum, upwards = _exact_momentum(
                ball, spin if turned_before else omega, vertical if gamma is None else gamma, time_step
            )
            run = trajectory(
                ball, momentum, upwards, steps, order=2 if order is None else order, every=every, attitude=turned,
                contact=contact, time_step=seconds(time_step), precision=precision, proved=proved, threads=threads,
                progress=progress,
            )  # fmt: skip
        else:
            run = _rolled(
                ball, spin, vertical, turned, flag(contact, "contact"), "double" if precision is None else precision,
                seconds(time_step), whole_number(steps, "steps", 0, MOST_STEPS), whole_number(every, "every", 1),
                2 if order is None else order, None if by_map else _accuracy(accuracy),
                whole_number(threads, "threads", 0), progress, bool(proved) and by_map,
            )  # fmt: skip
    except StepNotTaken as error:
        if contact and place is not None:
            error.trajectory = put_at(error.trajectory, place)
        raise
    if proved and not by_map:
        run = replace(run, proved=of_motion(run, progress=lambda sentence: progress(steps)))
    if contact and place is not None:
        run = put_at(run, place)
    return run


def _start(
    ball: Ball, omega: ArrayLike, gamma: ArrayLike | None, attitude: bool | ArrayLike, axes: str
) -> tuple[Floats, Floats, bool | Floats]:
    """ω and γ in body axes, and the first attitude."""
    spin = numbers(omega, "omega", 3)
    turned: bool | Floats = bool(attitude) if is_flag(attitude) else numbers(attitude, "attitude", 4)
    if gamma is not None or isinstance(turned, bool):
        vertical = unit_vertical((0.0, 0.0, 1.0) if gamma is None else gamma)
    else:
        length = np.sqrt((np.clip(turned, -2.0, 2.0) ** 2).sum(axis=-1, keepdims=True))
        if not (length > 0).all() or (np.abs(turned) > 2.0).any():
            raise BadInput("attitude must be unit quaternions (scalar first); divide by the length")
        vertical = kernels.rotate(turned / length * _INVERSE, _UP)
    if not is_a(ball, Ball):
        raise BadInput(f"ball must be a chapsym.Ball, not {type(ball).__name__}")
    if not (ball.is_one and spin.ndim == vertical.ndim == 1):
        batch(ball.principal, spin, vertical)  # so that an error names the arguments of this function
    if not isinstance(turned, bool):
        turned = initial_attitude(turned, vertical)
    if axes == "space":
        to_space = attitude_with(vertical) if isinstance(turned, bool) else turned
        spin = kernels.rotate(to_space * _INVERSE, spin)
    return spin, vertical, turned


def _exact_momentum(ball: Ball, omega: ArrayLike, gamma: ArrayLike, time_step: Any) -> tuple[np.ndarray, np.ndarray]:
    """𝒦 = ε(Λω - D⟨ω,γ⟩γ/⟨γ,γ⟩), as γ is divided by its length, and γ: in Fractions, from the numbers as given."""
    seconds(time_step)  # refuses others
    J, D, epsilon, spin, upwards = map(exact_array, (*ball.exact[:2], time_step, omega, gamma))
    along, length = ((x * upwards).sum(axis=-1, keepdims=True) for x in (spin, upwards))
    turning = (J.sum(axis=-1, keepdims=True) - J) * spin
    return epsilon * (turning + D[..., np.newaxis] * (spin - along / length * upwards)), upwards


@in_given_axes
def _rolled(
    ball: Ball, omega: Floats, gamma: Floats, attitude: bool | Floats, contact: bool, precision: str | Precision,
    epsilon: float, steps: int, every: int, order: int, accuracy: float | None, threads: int,
    progress: Callable[[int], None], proved: bool,
) -> Trajectory:  # fmt: skip
    """The map, or the motion to an accuracy as a trajectory of order 0, in principal axes."""
    K = _momentum(ball, omega, gamma, epsilon)
    if accuracy is None:
        return trajectory(
            ball, epsilon * K, gamma, steps, order=order, every=every, attitude=attitude, contact=contact,
            time_step=epsilon, precision=precision, proved=proved, threads=threads, progress=progress,
        )  # fmt: skip
    shape, (flat, g, J, D) = batch(ball, K, gamma)
    every, radius = min(every, steps + 1), rolling_radius(ball) if contact else ball.radius
    if radius is not None:
        radius = radius.reshape(1) if not shape else np.broadcast_to(radius, shape).reshape(-1).copy()
    if isinstance(attitude, bool):
        turned = attitude_with(g if shape else gamma).reshape(-1, 4) if contact or attitude else None
    else:
        turned = np.broadcast_to(attitude, (*shape, 4)).reshape(-1, 4)
    body = checked_before(J, D, radius)
    problem = Problem(body, flat, g, every * epsilon, steps // every, accuracy, turned, contact, threads=threads)
    found = moved(problem, lambda balls: progress(int(balls * steps)))
    taken = found.reached
    if every > 1:
        taken = np.where(found.reached == problem.frames, steps, found.reached * every)
    found.angular_momentum *= epsilon
    run = of_balls(
        shape, ball, np.arange(0, steps + 1, every), found.angular_momentum, found.gamma, found.attitude,
        found.contact, taken, found.status, time_step=epsilon, order=0, error=found.error.reshape(shape),
    )  # fmt: skip
    return finished(run, UNKNOWN)


def _momentum(ball: Ball, omega: Floats, gamma: Floats, epsilon: float) -> Floats:
    """K = Λω - D⟨ω,γ⟩γ; raises BadInput if float64 loses digits of K or 𝒦 = εK."""
    if ball.is_one and omega.ndim == gamma.ndim == 1:  # floats are faster for a single ball
        numbers_of = (*omega.tolist(), *gamma.tolist(), *ball.mass_tensor.tolist(), float(ball.D))
        several = contact_momentum(*numbers_of)
        K = np.array(several)
        size = max(map(abs, several))
        if ORDINARY[0] < size < ORDINARY[1] and ORDINARY[0] < epsilon * size < ORDINARY[1]:
            return K
    return kernels.momentum_in_range(ball, omega, gamma, epsilon)


def _accuracy(given: float | None) -> float:
    if given is None or (type(given) is float and given >= FINEST and given < math.inf):
        return DEFAULT if given is None else float(given)
    found = numbers(given, "accuracy")
    if found.ndim or not found >= FINEST:
        raise BadInput(
            f"accuracy must be one number from {FINEST:g} on, not {brief(given)}; "
            "`accurate` has more digits than float64"
        )
    return float(found)


@dataclass(eq=False)
class Motion:
    """n balls at frames + 1 equal times.

    angular_momentum: K in kg m²/s, (n, frames + 1, 3).  gamma: (n, frames + 1, 3).  attitude: (n, frames + 1, 4), or
    None.  contact: in m, from (0, 0), (n, frames + 1, 2), or None.
    reached: the last frame of each ball, (n,); later frames are NaN.  status: why it stopped, a `Status`, (n,).
    error: an estimate of the largest error of each ball at any frame, (n,), in the norm of `apart`.
    order, total: the order and the number of steps of each ball, (n,); 0 for a steady rotation, which needs none.
    """

    angular_momentum: Floats
    gamma: Floats
    attitude: Asked
    contact: Asked
    reached: np.ndarray
    status: np.ndarray
    error: Floats
    order: np.ndarray
    total: np.ndarray

    @property
    def steps(self) -> np.ndarray:
        """The largest number of steps between two frames, of each ball, (n,)."""
        return -(-self.total // max(self.gamma.shape[1] - 1, 1))

    def of(self, some: np.ndarray) -> Motion:
        """Some of the balls."""
        arrays: dict[str, Any] = {name: None if array is None else array[some] for name, array in vars(self).items()}
        return Motion(**arrays)

    def every(self, stride: int) -> Motion:
        """The motion with every `stride`-th frame."""
        names = "angular_momentum", "gamma", "attitude", "contact"
        frames: dict[str, Any] = {name: getattr(self, name) for name in names}
        kept = {name: np.ascontiguousarray(x[:, ::stride]) for name, x in frames.items() if x is not None}
        return replace(self, reached=self.reached // stride, **kept)

    def put(self, where: np.ndarray, other: Motion) -> None:
        """Copies other balls to the places `where`."""
        for name, array in vars(other).items():
            if array is not None:
                getattr(self, name)[where] = array


@dataclass(eq=False)
class Problem:
    """A problem: n balls from K and γ, at `frames` times, `interval` seconds apart, to an accuracy.

    attitude: (n, 4), or None if it is not followed.  contact: whether the contact point is followed.
    parts: the quantities of the accuracy; metres: whether it is in metres: relative errors and angles times the radius.
    """

    ball: Ball
    K: Floats
    gamma: Floats
    interval: float
    frames: int
    accuracy: float
    attitude: Asked
    contact: bool
    metres: bool = False
    parts: frozenset[str] = PARTS
    threads: int = 0

    def __post_init__(self) -> None:
        """Computes `units`, and `survey`, (FOUND, n), the estimates of `loops.expected` for each ball at the start."""
        ball, n = self.ball, len(self.K)
        #: The time of the last frame, in s.
        self.end = self.frames * self.interval
        #: The unit of each ball's error, (n,): 1, or the radius in m.
        self.units = np.empty(n)
        self.units[:] = ball.radius if self.metres and ball.radius is not None else 1.0
        self.survey: Floats = np.empty((expected.FOUND, n))
        survey = native.loop(expected.surveyed)
        #: The largest error of any ball by rounding alone, and whether some ball may rotate steadily.
        self.floor, self.single = survey(
            self.K, self.gamma, np.ascontiguousarray(ball.mass_tensor), ball.D, self.units, self.end, self.accuracy,
            self.survey,
        )  # fmt: skip

    def __len__(self) -> int:
        return len(self.K)

    def of(self, some: np.ndarray) -> Problem:
        """Some of the balls."""
        ball = self.ball
        few = checked_before(ball.mass_tensor[some], ball.D[some], None if ball.radius is None else ball.radius[some])
        attitude = None if self.attitude is None else self.attitude[some]
        return replace(self, ball=few, K=self.K[some], gamma=self.gamma[some], attitude=attitude)

    @property
    def rate(self) -> Floats:
        """|ω| at the start in rad/s, (n,)."""
        return self.survey[expected.RATE]

    @property
    def long_steps(self) -> float:
        """The approximate number of long steps of all balls."""
        with np.errstate(over="ignore", under="ignore"):  # of arguments that are refused
            return float((self.end / self.survey[expected.FIRST]).sum()) if self.frames else 0.0

    def nothing(self) -> Motion:
        """An empty motion, whose first frame is the start."""
        n, kept = len(self), self.frames + 1
        whole = np.zeros((4, n), np.int64)
        try:
            found = Motion(
                np.empty((n, kept, 3)), np.empty((n, kept, 3)),
                None if self.attitude is None else np.empty((n, kept, 4)),
                np.zeros((n, kept, 2)) if self.contact else None, whole[0], whole[1], np.zeros(n), whole[2], whole[3],
            )  # fmt: skip
        except (MemoryError, ValueError):
            raise BadInput(
                f"{kept} states of {n} balls do not fit into memory: keep fewer, by a larger `every`"
            ) from None
        found.angular_momentum[:, 0], found.gamma[:, 0] = self.K, self.gamma
        if found.attitude is not None:
            found.attitude[:, 0] = self.attitude
        return found


def nominal(problem: Problem) -> float:
    """The nominal seconds of one core for the motion."""
    return 1e-4 + problem.long_steps * STEP + problem.frames * len(problem) * FRAME


def moved(problem: Problem, progress: Callable[[float], None] = lambda done: None) -> Motion:
    """The motion to the accuracy, or BadInput if rounding alone is larger; `progress` gets the number of balls done."""
    if (steady := _check(problem)) is None:
        found = _follow(problem, progress)
    else:
        found = problem.nothing()
        some, others, done = np.flatnonzero(steady), np.flatnonzero(~steady), int(steady.sum())
        _spin(problem, some, found)
        progress(done)
        if len(others):
            found.put(others, _follow(problem.of(others), lambda part: progress(done + part)))
    return found


@np.errstate(all="ignore")  # of a ball at rest the axis is 0/0
def _spin(problem: Problem, some: np.ndarray, found: Motion) -> None:
    """Balls that rotate steadily, in closed form: about an axis fixed in body and space, along a straight line."""
    few = problem.of(some)
    omega, time = omega_of(few, few.K, few.gamma), np.arange(problem.frames + 1) * problem.interval
    rate = few.rate[:, np.newaxis]
    axis, half = np.where(rate > 0, omega / rate, 0.0)[:, np.newaxis], rate * time / 2
    turned = np.concatenate([np.cos(half)[..., np.newaxis], np.sin(half)[..., np.newaxis] * axis], axis=-1)
    back = turned * _INVERSE
    found.angular_momentum[some], found.gamma[some] = (
        kernels.rotate(back, np.broadcast_to(v[:, np.newaxis], (*half.shape, 3))) for v in (few.K, few.gamma)
    )
    if found.attitude is not None:
        found.attitude[some] = kernels.compose(np.broadcast_to(few.attitude[:, np.newaxis], turned.shape), turned)
    if found.contact is not None:
        assert few.ball.radius is not None
        centre = kernels.rotate(few.attitude, np.cross(omega, few.gamma))[:, :2] * few.ball.radius[:, np.newaxis]
        found.contact[some] = centre[:, np.newaxis] * time[:, np.newaxis]
    found.reached[some], found.error[some] = problem.frames, few.survey[expected.STILL]


#: The reason why a ball without inertia about an axis has no estimate of the error.
NO_INERTIA = (
    "the ball has a principal moment of 0, and no angular velocity where that axis is vertical, so that no accuracy "
    "can be stated; give that moment a small value"
)


def _check(problem: Problem) -> np.ndarray | None:
    """Which balls rotate steadily, None if none do; raises BadInput for an accuracy beyond double precision."""
    worst, steady = problem.floor, None
    if problem.single:
        steady = is_steady(problem.ball, problem.K, problem.gamma)
        worst = float(np.where(steady, problem.survey[expected.STILL], problem.survey[expected.FLOOR]).max())
    if worst > ROUNDING * problem.accuracy and (problem.survey[expected.CONDITION] >= expected.ENDLESS).any():
        raise BadInput(f"{NO_INERTIA}, or replace the motion by the map, map=True")
    if not math.isfinite(worst):
        raise BadInput("the ball turns too far for float64: |ω|T, or its condition, is beyond 1.8e308")
    if worst > ROUNDING * problem.accuracy:
        raise BadInput(
            f"an accuracy of {problem.accuracy:g} after {problem.end:g} s cannot be had in double precision: rounding "
            f"alone may leave {worst:.1g}; ask for {2.1 * worst:.1g}, or for less time"
        )
    return steady if steady is not None and steady.any() else None


def _follow(problem: Problem, progress: Callable[[float], None]) -> Motion:
    """Balls that do not rotate steadily."""
    found, accuracy = problem.nothing(), problem.accuracy
    if not problem.frames:
        found.error[:] = problem.survey[expected.FLOOR]
        return found
    done = 0.0

    def report(part: float, others: int = 0) -> None:
        """Reports the progress; a ball that is followed again does not count twice."""
        nonlocal done
        done = max(done, others + part)
        progress(done)

    first, allowed = problem.survey[expected.FIRST], problem.survey[expected.ALLOWED]
    worst, noise, started = _run(problem, first, allowed, found, report)
    if worst <= accuracy:
        progress(len(problem))
        return found
    first, allowed = first.copy(), allowed.copy()
    for attempt in range(1, TRIES):
        given_up = (found.reached < problem.frames) & (found.status == Status.TAKEN)
        some = np.flatnonzero((found.error > accuracy) & (noise <= ROUNDING * accuracy) | given_up)
        if not len(some):
            break
        more = np.minimum(np.maximum(AIM * accuracy / found.error[some], FINER), 0.5)
        allowed[some] *= more
        first[some] *= more ** (1 / (EXTRAPOLATED - 1))
        part, last = problem.of(some), attempt + 1 == TRIES
        again, further = part.nothing(), partial(report, others=len(problem) - len(some))
        _, noise[some], started[some] = _run(part, first[some], allowed[some], again, further, last)
        # If the steps are not shorter, they are as short as rounding allows.
        noise[some[(again.total <= found.total[some]) & ~given_up[some]]] = np.inf
        found.put(some, again)
    poor = np.flatnonzero((found.error > accuracy) & (SENSITIVE * started <= accuracy) | (found.status != Status.TAKEN))
    if len(poor):
        part, others = problem.of(poor), len(problem) - len(poor)
        of_start = np.nan_to_num(started[poor])
        # These are followed anew, which takes longer than all before: each run of them is counted from its beginning.
        other = doubled(part, found.of(poor), of_start, lambda done: progress(others + done))
        # Other estimates are of runs that are far from the motion; of two balls that stopped the later one is kept.
        later = (found.status[poor] != Status.TAKEN) & (other.reached >= found.reached[poor])
        better = (other.error <= accuracy) | later
        found.put(poor[better], other.of(better))
    progress(len(problem))
    return found


def _run(
    problem: Problem, first: Floats, allowed: Floats, found: Motion, progress: Callable[[float], None],
    patient: bool = False,
) -> tuple[float, Floats, Floats]:  # fmt: skip
    """Follows all balls into `found`; if `patient`, none is given up.

    Returns the largest error, and for each ball the estimated effect of roundings of the steps, and of the start.
    """
    n, ball, follows, traced = len(problem), problem.ball, problem.attitude is not None, problem.contact
    reported, reach, noise, started = np.zeros((n, REPORTED)), np.empty(n), np.empty(n), np.empty(n)
    reported[:, UNTIL] = 1.0
    frames = records.Frames(
        found.angular_momentum, found.gamma, np.empty((n, 0, 4)) if found.attitude is None else found.attitude,
        np.empty((n, 0, 2)) if found.contact is None else found.contact, follows, traced,
    )  # fmt: skip
    radius = ball.D if ball.radius is None or not traced else ball.radius
    balls = records.Balls(np.ascontiguousarray(ball.mass_tensor), ball.D, radius)
    ends = records.Ends(found.reached, found.status, reach)
    loop, width = (native.loop(follow_alone), 1) if n < FEW else (native.loop(follow), TOGETHER)
    shortest = first.item() if n == 1 else float(first.min(initial=problem.end))
    quick = n * (problem.end * STEP + problem.frames * FRAME * shortest) <= QUICK * shortest
    most, start = problem.survey[expected.MOST], problem.survey[expected.START]
    asked = following.Asked(first, allowed, most, start, problem.interval, patient)
    weights = loop_weights(MOST_COLUMNS)
    if n == 1 and quick:
        loop(frames, balls, asked, weights, ends, reported)
    else:

        def task(at: int) -> None:
            if count.stopped:
                return
            some = slice(at, at + width)
            parts = (of_some(record, some) for record in (frames, balls, asked))
            loop(*parts, weights, of_some(ends, some), reported[some])
            count.add(len(reach[some]))

        def look() -> None:
            """Reports the number of balls done, counting others by the fraction of their expected steps."""
            part = np.minimum(reported[:, STEPS] * first / problem.end, MOSTLY)
            progress(float(np.where(found.reached == problem.frames, 1.0, part).sum()))

        def stop() -> None:
            """Ends the work: a ball with UNTIL below 1 is given up."""
            count.stopped = True
            reported[:, UNTIL] = 0.0

        count, parts = Count(progress if quick else lambda done: None), range(0, n, width)
        workers = min(problem.threads or cores(), len(parts))
        if quick:
            share(task, parts, workers, count)
        else:
            watched(lambda: share(task, parts, workers, count), look, stop)
    found.order.fill(EXTRAPOLATED)
    asked_of = problem.parts
    turned = not asked_of or not asked_of.isdisjoint(TURNED)
    counted = turned, "omega" in asked_of, traced and "contact" in asked_of
    errors = found.error, noise, started
    worst = native.loop(expected.estimated)(problem.survey, reported, problem.units, *counted, *errors, found.total)
    return worst, noise, started


@np.errstate(over="ignore")
def steps_of(columns: int, angle: Any, unit: Any, accuracy: float) -> Any:
    """The long steps in double-double by the law: with `LESS` columns fewer, `MARGIN` of the accuracy is reached."""
    fewer = columns - LESS
    law = DOUBLED**fewer * (1 + angle) * unit
    return angle * np.maximum((law / (MARGIN * accuracy)) ** (0.5 / fewer), 1 / LONGEST)


def stages(columns: int) -> int:
    """The steps of the map in a long step in double-double and in that of the run it is compared with."""
    return stages_of(columns, double_double.FIRST) + stages_of(columns - LESS, double_double.FIRST)


def doubled(
    problem: Problem, long: Motion, started: Floats, progress: Callable[[float], None] = lambda part: None
) -> Motion:
    """Follows all balls in double-double until each is verified, with more steps for the others.

    long: the balls by long steps in double precision; started: the estimated effect of the rounding of the start, (n,).
    Steps and estimates of a ball depend only on the ball; balls of the same steps share a run.  A ball that more steps
    do not improve keeps its error: the effect of the start is larger than the accuracy.  Few frames are divided, to
    compare runs more often.
    """
    if (times := -(-COMPARED // problem.frames)) > 1:
        often = replace(problem, interval=problem.interval / times, frames=problem.frames * times)
        again = often.nothing()
        _run(often, often.survey[expected.FIRST], often.survey[expected.ALLOWED], again, lambda done: None, True)
        again.total[:] = np.maximum(again.total, long.total)
        return doubled(often, again, started, progress).every(times)
    n = len(problem)
    found, left, before = problem.nothing(), np.arange(n), np.full(n, np.inf)
    columns, steps = cheapest(problem, long.total)

    def still(taken: float, of: int) -> None:
        """Counts verified balls, and of those in a run the part of its steps; the callback may end the run."""
        progress(n - len(left) + of * min(taken, MOSTLY))

    for _ in range(ATTEMPTS):
        off, ways = np.empty(n), np.stack([columns, steps], axis=1)
        for way in np.unique(ways[left], axis=0):
            some = left[(ways[left] == way).all(axis=1)]
            few = problem.of(some), long.of(some), started[some]
            run, off[some] = _verified(*few, int(way[0]), int(way[1]), partial(still, of=len(some)))
            found.put(some, run)
        rounded = (off > before / 2) & (off <= SMALL * problem.units)
        left, before = left[(~(found.error <= problem.accuracy) & ~rounded)[left]], off
        progress(n - len(left))
        if not len(left):
            break
        more = (off[left] / (MARGIN * problem.accuracy)) ** (0.5 / (columns[left] - LESS))
        more = np.where(np.isfinite(off[left]), np.clip(more, LEAST_FINER, MOST_FINER), 2.0)
        steps[left] = shared(found.total[left] * more)
    return found


def cheapest(problem: Problem, total: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The columns with the fewest stages for the accuracy by the law, and the steps, for each ball."""
    angle, every = problem.rate * problem.end, range(FEWEST, MOST_OF_PAIRS + 1)
    law = np.array([steps_of(columns, angle, problem.units, problem.accuracy) for columns in every])
    steps = np.maximum(law, np.maximum(SHARE * total, COMPARED))
    best = (steps * np.array([[stages(columns)] for columns in every])).argmin(axis=0)
    return np.array(every)[best], shared(np.take_along_axis(steps, best[np.newaxis], axis=0)[0])


def shared(steps: Floats) -> np.ndarray:
    """Whole steps, rounded up to one of four numbers per power of two, so that balls share them."""
    part, exponent = np.frexp(steps)
    return np.maximum(np.ceil(np.ldexp(np.ceil(8 * part), exponent - 3)), 1).astype(np.int64)


def _verified(
    problem: Problem, long: Motion, started: Floats, columns: int, steps: int, progress: Callable[[float], None]
) -> tuple[Motion, Floats]:
    """The motion by at least `steps` steps, and its distance from another; infinite for a ball that stops.

    The other is the motion by long steps in double precision if the estimate of that is small enough.  If it is not,
    or too far, the other has fewer columns, and starts a few roundings away, to show the sensitivity of a
    ball to its start.
    """
    work = 2 * steps * len(problem)  # if another follows
    run = _long_steps(problem, columns, steps, lambda taken: progress(taken / work))
    off = apart(problem, long, run).max(axis=-1)
    near = long.error <= np.minimum(NEAR * problem.accuracy, SMALL * problem.units)
    rest = np.flatnonzero(~(near & (_stated(problem, started, off) + run.error <= problem.accuracy)))
    if len(rest):
        few, aside = problem.of(rest), ROUNDED * 2.0**-53 * lengths(problem.K[rest])[:, np.newaxis] * ASIDE
        moved_aside, again = replace(few, K=few.K + aside), steps * len(rest)
        other = _long_steps(moved_aside, columns - LESS, steps, lambda taken: progress((1 + taken / again) / 2))
        off[rest] = apart(few, run.of(rest), other).max(axis=-1)
        off[rest[other.status != Status.TAKEN]] = np.nan
    off = np.where(np.isnan(off), np.inf, off)
    run.error[:] = np.where(run.status == Status.TAKEN, _stated(problem, started, off) + run.error, np.nan)
    return run, off


def _stated(problem: Problem, started: Floats, off: Floats) -> Floats:
    """The error from the distance of two runs, and of the start and the last roundings."""
    return LIKELY * off + problem.survey[expected.FLOOR] + SENSITIVE * started


def _long_steps(problem: Problem, columns: int, steps: int, progress: Callable[[int], None]) -> Motion:
    """The frames by long steps in double-double, with the error of what is in double precision."""
    frames = problem.frames
    together, each = max(frames // steps, 1), -(-steps // frames)
    ends = frames if together == 1 else (frames - 1) // together
    run = extrapolate(
        problem.ball, problem.K, problem.gamma, Fraction(problem.interval) * together / each, ends * each,
        columns=columns, every=each, attitude=False if problem.attitude is None else problem.attitude,
        contact=problem.contact, precision="double-double", threads=problem.threads, progress=progress,
    )  # fmt: skip
    how = np.zeros(len(problem)), np.full(len(problem), 2 * columns), np.full(len(problem), ends * each)
    found = Motion(run.angular_momentum, run.gamma, run.attitude, run.contact, run.taken // each, run.status, *how)
    return found if together == 1 else _filled(problem, found, together)


def _filled(problem: Problem, ends: Motion, together: int) -> Motion:
    """All frames, from every `together`-th frame, by long steps in double precision from each of these."""
    some, count = np.flatnonzero(ends.status == Status.TAKEN), ends.gamma.shape[1]
    few, starts = problem.of(some).ball, ends.of(some)

    def flat(x: Any) -> Any:
        return None if x is None else x.reshape(-1, x.shape[-1])

    balls = (None if x is None else np.repeat(x, count, axis=0) for x in (few.mass_tensor, few.D, few.radius))
    K, gamma, attitude = (flat(x) for x in (starts.angular_momentum, starts.gamma, starts.attitude))
    part = replace(problem, ball=checked_before(*balls), K=K, gamma=gamma, frames=together, attitude=attitude)  # type: ignore[arg-type]
    inside = part.nothing()
    _run(part, part.survey[expected.FIRST], part.survey[expected.ALLOWED], inside, lambda done: None, True)
    if inside.contact is not None:
        inside.contact += flat(starts.contact)[:, np.newaxis]
    found = problem.nothing()
    for name in ("angular_momentum", "gamma", "attitude", "contact"):
        if (several := getattr(inside, name)) is not None:
            whole, rows = getattr(found, name), several[:, 1:].reshape(-1, count * together, several.shape[-1])
            whole[:, 1:] = np.nan
            whole[some, 1:] = rows[:, : problem.frames]
    found.status[:], found.order[:], found.total[:] = ends.status, ends.order, ends.total
    found.status[some] = inside.status.reshape(-1, count).max(axis=1, initial=Status.TAKEN)
    found.error[some] = inside.error.reshape(-1, count).max(axis=1, initial=0.0)
    found.reached[:] = np.where(found.status == Status.TAKEN, problem.frames, 0)
    return found


def omega_of(problem: Problem, K: Floats, gamma: Floats) -> Floats:
    """ω, (n, 3) or (n, frames, 3); NaN where K is NaN."""
    tensor, D = problem.ball.mass_tensor, problem.ball.D
    if K.ndim == 3:
        tensor, D = tensor[:, np.newaxis], D[:, np.newaxis]
    if not (missing := np.isnan(K)).any():
        return kernels.angular_velocity(K, gamma, tensor, D)
    omega = kernels.angular_velocity(np.where(missing, 0.0, K), np.where(missing, _UP, gamma), tensor, D)
    return np.where(missing, np.nan, omega)


@np.errstate(all="ignore")  # later frames are NaN
def apart(problem: Problem, run: Motion, other: Motion) -> Floats:
    """The distance of two runs at each frame, (n, frames).

    The largest of the requested parts: |ΔK|/|K|, |Δγ|, |Δω| over the largest |ω| of the ball, the angle
    between the attitudes in radians, and the distance of the contact points in radii; times the radius, if the accuracy
    is in metres.
    """
    radius = 1.0 if problem.ball.radius is None else problem.ball.radius[:, np.newaxis]
    K, L, gamma = run.angular_momentum, other.angular_momentum, run.gamma
    found, parts = [np.zeros(gamma.shape[:2])], problem.parts
    if "gamma" in parts:
        found.append(lengths(gamma - other.gamma))
    if "momentum" in parts:
        found.append(_over(lengths(K - L), lengths(problem.K)[:, np.newaxis]))
    if "omega" in parts:
        omega = omega_of(problem, K, gamma)
        off = lengths(omega - omega_of(problem, L, other.gamma))
        found.append(_over(off, np.nanmax(lengths(omega), axis=-1, keepdims=True)))
    if "attitude" in parts and problem.attitude is not None:
        q, p = run.attitude, other.attitude
        found.append(4 * np.arcsin(np.minimum(np.minimum(lengths(q - p), lengths(q + p)) / 2, 1.0)))
    if "contact" in parts and problem.contact:
        found.append(lengths(run.contact - other.contact) / radius)
    return np.asarray(np.max(found, axis=0) * (radius if problem.metres else 1.0))


def _over(a: Floats, size: Floats) -> Floats:
    """a / size; for a ball at rest a itself, which is 0."""
    return np.asarray(a / np.where(size > 0, size, 1.0))
