"""The continuous motion of balls at equal times, to an accuracy: long steps of order 12, each ball with its own.

The steps are as long as the accuracy allows; frames inside are interpolated (`loops.following`).  The error that is
stated is what the flow makes of the errors of all steps together (`loops.carried`).  It is an estimate in that the size
of the error of a step (`loops.following.left`) and its direction are.  A ball whose error is larger than the accuracy
is followed again with shorter steps; where the roundings of long steps are too many, by compositions of the map
(`composed`).
"""

import math
from collections.abc import Callable

import numpy as np

from chapsym.dynamics import BadInput, Status, is_steady, kernels, native
from chapsym.dynamics.ball import Floats
from chapsym.dynamics.extrapolation import FEW, loop_weights
from chapsym.dynamics.levels.frames import Count, cores, share
from chapsym.dynamics.loops.expected import ALLOWED, FIRST, FLOOR, MOST, START, STILL, estimated
from chapsym.dynamics.loops.following import REPORTED, STEPS, follow
from chapsym.dynamics.loops.lanes import MOST_COLUMNS

from .composed import composed
from .problem import EXTRAPOLATED, Motion, Problem, nothing, of, omega_of, put

#: The accuracy where none is asked for: nobody sees or measures an error of that size.
DEFAULT = 1e-6
#: What double precision can be asked for; rounding may take this part of an accuracy.
FINEST, ROUNDING = 1e-12, 0.5
#: How many times a ball is followed by long steps, at most, and what part of the accuracy those after the first aim
#: at.
ATTEMPTS, AIM = 4, 0.4
#: How many roundings of the start those of a composition are, after which they grow as it does.
SENSITIVE = 16.0
#: By what part, at least, the error of a step is lowered at once.
FINER = 1e-6
#: Balls that a core takes at once, and seconds of a long step and of a frame.
TOGETHER, STEP, FRAME = 64, 1.5e-6, 2e-7


def nominal(problem: Problem) -> float:
    """Seconds of one core for the motion, by nominal prices."""
    return 1e-4 + problem.expected * STEP + problem.frames * len(problem) * FRAME


def moved(problem: Problem, progress: Callable[[float], None] = lambda done: None) -> Motion:
    """The motion to the accuracy, or BadInput where rounding alone is more; `progress` is of the balls done."""
    steady = _check(problem)
    if steady is None:
        found = _follow(problem, progress)
    else:
        found = nothing(problem)
        some, others, done = np.flatnonzero(steady), np.flatnonzero(~steady), int(steady.sum())
        _spin(problem, some, found)
        progress(done)
        if len(others):
            put(found, others, _follow(problem.of(others), lambda part: progress(done + part)))
    found.steps[:] = -(-found.total // max(problem.frames, 1))
    return found


@np.errstate(all="ignore")  # of a ball at rest the axis is 0/0
def _spin(problem: Problem, some: np.ndarray, found: Motion) -> None:
    """Balls that rotate steadily, at once: about an axis that is fixed in body and space, along a straight line."""
    few = problem.of(some)
    omega, time = omega_of(few, few.K, few.gamma), np.arange(problem.frames + 1) * problem.interval
    rate = few.rate[:, np.newaxis]
    axis, half = np.where(rate > 0, omega / rate, 0.0)[:, np.newaxis], rate * time / 2
    turned = np.concatenate([np.cos(half)[..., np.newaxis], np.sin(half)[..., np.newaxis] * axis], axis=-1)
    back = turned * [1.0, -1.0, -1.0, -1.0]
    found.angular_momentum[some], found.gamma[some] = (
        kernels.rotate(back, np.broadcast_to(v[:, np.newaxis], (*half.shape, 3))) for v in (few.K, few.gamma)
    )
    if found.attitude is not None:
        first = np.broadcast_to(few.attitude[:, np.newaxis], turned.shape)
        found.attitude[some] = kernels.compose(first, turned)
    if found.contact is not None:
        assert few.ball.radius is not None
        centre = kernels.rotate(few.attitude, np.cross(omega, few.gamma))[:, :2] * few.ball.radius[:, np.newaxis]
        found.contact[some] = centre[:, np.newaxis] * time[:, np.newaxis]
    found.reached[some], found.error[some] = problem.frames, few.survey[STILL]


def _check(problem: Problem) -> np.ndarray | None:
    """Which balls rotate steadily, None if none do; raises BadInput for what double precision cannot have."""
    worst, steady = problem.floor, None
    if problem.single:
        steady = is_steady(problem.ball, problem.K, problem.gamma)
        worst = float(np.where(steady, problem.survey[STILL], problem.survey[FLOOR]).max())
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
    found, accuracy = nothing(problem), problem.accuracy
    if not problem.frames:
        found.error[:] = problem.survey[FLOOR]
        return found
    worst, noise, started = _run(problem, problem.survey[FIRST], problem.survey[ALLOWED], found, progress)
    if worst <= accuracy:
        return found
    first, allowed = problem.survey[FIRST].copy(), problem.survey[ALLOWED].copy()
    for attempt in range(1, ATTEMPTS):
        given_up = (found.reached < problem.frames) & (found.status == Status.TAKEN)
        some = np.flatnonzero((found.error > accuracy) & (noise <= ROUNDING * accuracy) | given_up)
        if not len(some):
            break
        more = np.minimum(np.maximum(AIM * accuracy / found.error[some], FINER), 0.5)
        allowed[some] *= more
        first[some] *= more ** (1 / (EXTRAPOLATED - 1))
        part, last = problem.of(some), attempt + 1 == ATTEMPTS
        again = nothing(part)
        _, noise[some], started[some] = _run(part, first[some], allowed[some], again, lambda done: None, last)
        # Where the steps are not shorter, they are as short as rounding lets them be.
        noise[some[(again.total <= found.total[some]) & ~given_up[some]]] = np.inf
        put(found, some, again)
    poor = np.flatnonzero((found.error > accuracy) & (SENSITIVE * started <= accuracy) | (found.status != Status.TAKEN))
    if len(poor):
        part = problem.of(poor)
        other = composed(part)
        other.error[:] += np.nan_to_num(SENSITIVE * started[poor])
        # That estimate may miss how sensitive a ball is: it is believed where it is within the accuracy, or alone.
        better = (other.error <= accuracy) | (found.status[poor] != Status.TAKEN)
        put(found, poor[better], of(other, better))
    return found


def _run(
    problem: Problem, first: Floats, allowed: Floats, found: Motion, progress: Callable[[float], None],
    patient: bool = False,
) -> tuple[float, Floats, Floats]:  # fmt: skip
    """Follows all balls into `found`, where `patient` none is given up.

    Returns the largest error, and what roundings of the steps, and of the start, may have made of all.
    """
    n, ball = len(problem), problem.ball
    reported, reach, none = np.zeros((n, REPORTED)), np.empty(n), np.empty((n, 0, 4))
    follows, traced = problem.attitude is not None, problem.contact
    frames = (
        found.angular_momentum, found.gamma, none if found.attitude is None else found.attitude,
        none if found.contact is None else found.contact, np.ascontiguousarray(ball.mass_tensor), ball.D,
        ball.D if ball.radius is None or not traced else ball.radius,
    )  # fmt: skip
    ends = reported, found.reached, found.status, reach
    few, loop = n < FEW, native.loop(follow)
    width = 1 if few else TOGETHER
    asked, weights = (first, allowed, problem.survey[MOST], problem.survey[START]), loop_weights(MOST_COLUMNS)
    if n == 1:
        loop(few, *frames, problem.interval, *asked, patient, follows, traced, *weights, *ends)
        progress(1)
    else:

        def task(at: int) -> None:
            some = slice(at, at + width)
            balls, wanted, found = ([x[some] for x in arrays] for arrays in (frames, asked, ends))
            loop(few, *balls, problem.interval, *wanted, patient, follows, traced, *weights, *found)
            count.add(len(found[-1]))

        count, parts = Count(progress), range(0, n, width)
        share(task, parts, min(problem.threads or cores(), len(parts)), count)
    found.order[:], found.total[:] = EXTRAPOLATED, reported[:, STEPS]
    (noise, started), asked_of = np.empty((2, n)), problem.parts
    turned = not asked_of or bool(asked_of & {"momentum", "gamma", "attitude"})
    counted = turned, "omega" in asked_of, traced and "contact" in asked_of
    worst = native.loop(estimated)(problem.survey, reported, problem.units, *counted, found.error, noise, started)
    return worst, noise, started
