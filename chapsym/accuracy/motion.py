"""The continuous motion of balls at equal times, to an accuracy: order and steps by a law, the result verified.

The error of an order p after t seconds is about c (|ω|h)^p (1 + |ω|t), with nearly the same c for every ball that is
not near a separatrix; of `extrapolate` c differs a thousandfold, and the law is a first guess.  So no pilot is needed.
A run is then compared with one of fewer steps, and by Richardson's rule its own error is their difference / (r^p - 1),
where r is the ratio of the steps; it is taken `SAFETY` times as large.  A run that fails teaches the law, and is taken
again with more steps.

Of many balls of one shape, taken by a composition, a sample is verified so.  The others are compared with a crude run
of the map: the distance tells, by the ratio of the two in the sample, the error of each.  A ball of which it tells too
much is verified, too.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from chapsym.dynamics import BadInput, Status, is_steady, kernels
from chapsym.dynamics.ball import Floats
from chapsym.dynamics.extrapolation import weights
from chapsym.dynamics.loops.lanes import MOST_COLUMNS
from chapsym.dynamics.native import is_compiled

from .problem import EXTRAPOLATED, Motion, Problem, Run, Stepping, apart, omega_of

#: The accuracy where none is asked for: nobody sees or measures an error of that size.
DEFAULT = 1e-6
#: What double precision can be asked for; rounding may take this part of an accuracy.
FINEST, ROUNDING = 1e-12, 0.5
#: c of each order, measured on balls of all shapes; and the part of the accuracy that the law is to give.
LAW, MARGIN = {2: 0.16, 4: 4.8e-3, 6: 1.9e-3, 8: 1.5e-5, EXTRAPOLATED: 3e-10}, 0.1
#: The largest |ω|h of a step of `extrapolate`, that of the comparison too: at 1.57 its steps of the map fold.
FARTHEST = 1.3
#: Stages of compositions, about a second of one ball, from which on `extrapolate` may take their place: its loop takes
#: ten seconds more to compile, once a machine.
WORTH = 10_000_000
#: Of a ball of a larger condition the roundings of its columns are not known.
CONDITIONED = 1e3
#: How many times as large as Richardson's rule says an error is taken to be, and by which ratio steps are compared.
SAFETY, RATIO = 4.0, 1.5
#: The steps of `extrapolate` are so long that their errors do not yet fall with its order; they are told by this one.
TOLD = 4
#: How many roundings beside the start a run begins that verifies another, and how far the crude one of a sweep does.
ROUNDED, BESIDE = 8, 1e-6
#: Runs that are tried, and how many times the steps of one, at least and at most, the next of the same order has.
ATTEMPTS, LEAST_FINER, MOST_FINER = 8, 1.2, 4.0
#: Balls whose steps differ by less than this ratio run abreast.
ALIKE = 1.3
#: So many balls are verified one by one; of more a sample of so many, the quickest and the slowest with it.
ALL, SAMPLE = 48, 16
#: Balls are of one shape where moments and D differ by less than this part.
SHAPED = 0.1
#: What a run costs with its verification, by its own work: by a sample, and of each ball.
SAMPLED, VERIFIED = 1.2, 2.0
#: The crude run of the others: its error by the law, and the times at which it is compared.
CRUDE, CHECKS = 0.05, 64
#: The part of the work that is the run itself, and not its verification.
OWN = 0.6
#: Roundings of the columns in a step of `extrapolate`: the sum of its |weights|.
WEIGHTS = float(sum(map(abs, weights(MOST_COLUMNS))))
#: Seconds of a stage, with the attitude and the contact point.
STAGE = 4e-8


def nominal(problem: Problem) -> float:
    """Seconds of one core for the motion and what it is compared with, by nominal prices."""
    stages = max(_cheapest(problem).stages, 1) * problem.frames * len(problem)
    return 1e-3 + stages * STAGE * (1 + 1 / RATIO if len(problem) <= ALL else RATIO)


def moved(problem: Problem, progress: Callable[[float], None] = lambda done: None) -> Motion:
    """The motion to the accuracy, verified; `progress` is called with the balls that are done, parts of them counted.

    Raises BadInput where rounding alone is more than the accuracy.
    """
    n, kept = len(problem), problem.frames + 1
    try:
        found = Motion(
            np.full((n, kept, 3), np.nan), np.full((n, kept, 3), np.nan),
            None if problem.attitude is None else np.full((n, kept, 4), np.nan),
            np.full((n, kept, 2), np.nan) if problem.contact else None,
            np.zeros(n, dtype=np.int64), np.zeros(n, dtype=np.int64), np.zeros(n),
            np.zeros(n, dtype=np.int64), np.zeros(n, dtype=np.int64),
        )  # fmt: skip
    except (MemoryError, ValueError):
        raise BadInput(f"{kept} states of {n} balls do not fit into memory: keep fewer, by a larger `every`") from None
    steady = _check(problem)
    if steady.any():
        _spin(problem, np.flatnonzero(steady), found)
    done = int(steady.sum())
    for group in _alike(problem, np.flatnonzero(~steady)):
        _follow(problem, group, found, lambda part, base=done: progress(base + part))  # type: ignore[misc]
        done += len(group)
        progress(done)
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
    found.reached[some], found.error[some] = problem.frames, _rounding(few, walks=False)


def _check(problem: Problem) -> np.ndarray:
    """Which balls rotate steadily; raises BadInput for an accuracy that double precision cannot have."""
    steady = is_steady(problem.ball, problem.K, problem.gamma)
    floor = np.where(steady, _rounding(problem, walks=False), _rounding(problem))
    worst = int(np.argmax(floor)) if len(floor) else 0
    if len(floor) and not np.isfinite(floor[worst]):
        raise BadInput("the ball turns too far for float64: |ω|T, or its condition, is beyond 1.8e308")
    if len(floor) and floor[worst] > ROUNDING * problem.accuracy:
        raise BadInput(
            f"an accuracy of {problem.accuracy:g} after {problem.end:g} s cannot be had in double precision: rounding "
            f"alone may leave {floor[worst]:.1g}; ask for {2.1 * floor[worst]:.1g}, or for less time"
        )
    return steady


@np.errstate(all="ignore")
def _rounding(problem: Problem, walks: bool = True, long_steps: int = 0) -> Floats:
    """What rounding may leave of each ball that is not sensitive: of its parameters, of the stages, and of long steps.

    That of J, D and K turns with the ball; ω along γ loses the digits of the condition of Λ - Dγγᵀ.
    """
    turned = problem.rate * problem.end
    condition = _condition(problem)
    walked = np.sqrt(1.0 + 40 * turned) if walks else 1.0  # the roundings of some forty stages a radian
    # Each long step has them, and from there on the ball turns otherwise.
    walked = walked + WEIGHTS * np.sqrt(long_steps * condition)
    turning = (1 + turned) * (2 * np.sqrt(condition) + walked)
    return np.asarray(2.0**-53 * (turning + 8 * condition) * problem.unit)


def _condition(problem: Problem) -> Floats:
    return np.asarray((problem.ball.inertia.max(axis=-1) + problem.ball.D) / problem.ball.inertia.min(axis=-1))


def _error(problem: Problem, order: int, step: float) -> Floats:
    """The error by the law, of each ball."""
    rate = problem.rate
    return np.asarray(LAW[order] * (rate * step) ** order * (1 + rate * problem.end) * problem.unit)


def _first(problem: Problem, order: int, factor: float = 1.0) -> Floats:
    """The steps between two frames by the law, times `factor`, of each ball; not rounded."""
    expected = factor * _error(problem, order, problem.interval)
    return np.asarray((expected / (MARGIN * problem.accuracy)) ** (1 / order))


def _cheapest(problem: Problem, factor: float = 1.0, far: bool = True) -> Stepping:
    """The order of the fewest stages that is expected to do for all balls; far: `EXTRAPOLATED` may be it."""
    found = [Stepping(p, _whole(problem, float(_first(problem, p, factor).max()))) for p in LAW if p != EXTRAPOLATED]
    work = min(method.stages for method in found) * problem.frames * len(problem)
    if far and work >= WORTH and EXTRAPOLATED in LAW and is_compiled():  # in plain Python it takes a batch ball by ball
        method = _extrapolated(problem, factor)
        rounding = _rounding(problem, long_steps=method.steps * problem.frames)
        if rounding.max() <= ROUNDING * problem.accuracy and _condition(problem).max() <= CONDITIONED:
            found.append(method)
    return min(found, key=lambda method: method.stages)


def _extrapolated(problem: Problem, factor: float = 1.0) -> Stepping:
    """That order with steps, and steps of the run that it is compared with, none of which is too long."""
    angle = float(problem.rate.max(initial=0.0)) * problem.interval
    steps = _whole(problem, float(_first(problem, EXTRAPOLATED, factor).max()))
    if steps > 1 or 2 * angle > FARTHEST:
        fewer = max(math.ceil(angle / FARTHEST), 1)
        steps = max(steps, 2 if fewer == 1 else math.ceil(RATIO * (fewer - 0.5)))
        steps += _fewer_steps(steps)[1] < fewer  # half is rounded to even
    return Stepping(EXTRAPOLATED, steps)


def _fewer_steps(steps: int) -> tuple[int, int]:
    """What a run is compared with: every so many frames, in so many steps from one to the next of these."""
    if steps == 1:
        return 2, 1
    return 1, 1 if steps == 2 else round(steps / RATIO)


def _whole(problem: Problem, steps: float) -> int:
    """Whole steps between two frames, so many that the last frame is one that can be compared.

    An error may grow a thousandfold within one frame.
    """
    return max(math.ceil(steps), 1 + problem.frames % 2)


def _alike(problem: Problem, some: np.ndarray) -> list[np.ndarray]:
    """Some balls in groups of those that take about as many steps: the indices of each."""
    steps = np.maximum(_first(problem, 8)[some], 1.0)
    level = np.ceil(np.log(steps) / math.log(ALIKE))
    return [some[level == one] for one in np.unique(level)]


def _follow(problem: Problem, group: np.ndarray, found: Motion, progress: Callable[[float], None]) -> None:
    """Puts the motion of balls that take about as many steps where it belongs.

    A sample tells of those of its shape, and of compositions, whose law is the same for all; others are verified.
    """
    odd = _of_other_shape(problem.of(group))
    one, other = (_cheapest(problem.of(group), far=far) for far in (True, False))
    if len(group) - odd.sum() <= ALL or VERIFIED * one.stages < SAMPLED * other.stages:
        _settle(problem, group, found, None, progress)
        return
    if odd.any():
        _settle(problem, group[odd], found, None, lambda part: None)
        group = group[~odd]
    order = group[np.argsort(problem.rate[group], kind="stable")]
    picked = np.unique(np.linspace(0, len(order) - 1, SAMPLE).astype(int))
    sample, others = order[picked], np.delete(order, picked)
    _settle(problem, sample, found, other, lambda part: None, far=False)
    if (fewer := _fewer(problem, sample, found)) is not None:
        _settle(problem, sample, found, fewer, lambda part: None, far=False)
    method = _worst(sample, found)
    rest = problem.of(others)
    run = rest.take(method, progress=lambda steps: progress(steps / (method.steps * problem.frames)))
    told = _by_sample(problem, sample, others, found, rest, run)
    _put(found, others, run, method, told)
    doubtful = others[~(told <= problem.accuracy) & (run.status == Status.TAKEN)]
    stopped = others[run.status != Status.TAKEN]
    for some in (doubtful, stopped):
        if len(some):
            _settle(problem, some, found, Stepping(method.order, math.ceil(ALIKE * method.steps)), lambda part: None)


@np.errstate(all="ignore")  # moments that are 0
def _of_other_shape(problem: Problem) -> np.ndarray:
    """Which balls have moments, relative to each other, that differ from those in the middle of all."""
    shape = np.column_stack([problem.ball.inertia, problem.ball.D])
    shape /= shape.sum(axis=-1, keepdims=True)
    middle = np.median(shape, axis=0)
    return np.asarray((np.abs(shape - middle) > SHAPED * middle).any(axis=-1))


def _worst(sample: np.ndarray, found: Motion) -> Stepping:
    """The method of the ball that needs most."""
    return max((Stepping(int(found.order[i]), int(found.steps[i])) for i in sample), key=lambda one: one.stages)


def _fewer(problem: Problem, sample: np.ndarray, found: Motion) -> Stepping | None:
    """Fewer steps of the same order that will do by what the sample showed; None if there are none."""
    method, error = _worst(sample, found), float(np.nanmax(found.error[sample], initial=0.0))
    allowed = SAFETY * MARGIN * problem.accuracy
    steps = _whole(problem, method.steps * (error / allowed) ** (1 / method.order))
    return Stepping(method.order, steps) if steps < method.steps else None


def _by_sample(
    problem: Problem, sample: np.ndarray, others: np.ndarray, found: Motion, rest: Problem, run: Run
) -> Floats:
    """The errors of the others, from the differences of all from a crude run and the errors of the sample.

    The crude run is of the map itself and of K and γ alone, which a batch takes at a tenth of the price.
    """
    rate = float(problem.rate[others].max())
    angle, length = rate * problem.interval, math.sqrt(CRUDE / (LAW[2] * (1 + rate * problem.end)))
    stride = min(max(math.ceil(length / angle), -(-problem.frames // CHECKS)), problem.frames)
    crude = Stepping(2, math.ceil(stride * angle / length))
    whole = problem.frames / (problem.frames // stride * stride)
    seen = []
    for one, states in ((problem.of(sample), _states(found, sample)), (rest, run)):
        state = replace(one, attitude=None, contact=False, metres=False, parts=frozenset({"momentum", "gamma"}))
        seen.append(apart(state, states, state.beside(BESIDE).take(crude, stride), stride).max(axis=-1) * whole)
    error = found.error[sample]
    with np.errstate(all="ignore"):
        ratio = float(np.nanmax(np.where(seen[0] > 0, error / seen[0], 0.0)))
        return np.asarray(np.maximum(seen[1] * ratio, np.nanmax(error)))


def _settle(
    problem: Problem, some: np.ndarray, found: Motion, first: Stepping | None, progress: Callable[[float], None],
    far: bool = True,
) -> None:  # fmt: skip
    """Runs some balls until each is verified, with more steps those that are not; puts each where it belongs.

    A ball that more steps do not help keeps the error that it has: rounding alone is larger than the accuracy.
    """
    method, left, factor = first or _cheapest(problem.of(some), far=far), some, 1.0
    before, gain = np.full(len(some), np.inf), 1.0
    for attempt in range(ATTEMPTS):
        part = problem.of(left)
        run = part.take(method, progress=lambda steps, one=method: progress(OWN * steps / (one.steps * problem.frames)))  # type: ignore[misc]
        error = _verified(part, method, run)
        there = error <= problem.accuracy
        if method.order != EXTRAPOLATED:  # for which there are compositions left
            there |= np.isfinite(before) & np.isfinite(error) & (error > before / gain)
        there |= attempt + 1 == ATTEMPTS
        told = np.where(run.status == Status.TAKEN, error, np.nan)
        _put(found, left[there], run.of(there), method, told[there])
        if there.all():
            return
        left, before, last = left[~there], error[~there], method
        if method.order == EXTRAPOLATED and attempt:  # its roundings are many, and its law is the least certain
            far, factor, before = False, 1.0, np.full(len(left), np.inf)
            method = _cheapest(problem.of(left), factor, far)
        elif np.isfinite(before).all():
            factor = max(factor, _learnt(problem.of(left), method, before))
            method = _more(method, _cheapest(problem.of(left), factor, far))
        else:  # a ball that stopped tells nothing
            method = Stepping(method.order, 2 * method.steps)
        # Of what more steps should gain half, in decades, shows that they help.
        gain = (method.steps / last.steps) ** (method.order / 2) if method.order == last.order else 2.0


def _learnt(problem: Problem, method: Stepping, error: Floats) -> float:
    """How many times as large as the law says the errors are."""
    expected = _error(problem, method.order, problem.interval / method.steps)
    return float((error / (SAFETY * expected)).max(initial=1.0))


def _more(method: Stepping, wanted: Stepping) -> Stepping:
    """What to try next: of the same order neither hardly more steps nor very many more."""
    if wanted.order != method.order:
        return wanted
    least, most = math.ceil(LEAST_FINER * method.steps), math.ceil(MOST_FINER * method.steps)
    return Stepping(method.order, min(max(wanted.steps, least), most))


def _share(ratio: float, order: int) -> float:
    """What part of the difference from a run whose steps are so many times as long the error is taken to be."""
    left = ratio ** (TOLD if order == EXTRAPOLATED else order) - 1
    return min(SAFETY / left, max(1.0, 2 / left))


def _verified(problem: Problem, method: Stepping, run: Run) -> Floats:
    """The error of each ball by a run of fewer steps, infinite if one has stopped; and what rounding may leave.

    That run starts a few roundings beside the other, so that a ball that is sensitive to its start shows it.
    """
    if not problem.frames:
        return _rounding(problem)
    stride, fewer = _fewer_steps(method.steps)
    share = _share(stride * method.steps / fewer, method.order)
    long_steps = method.steps * problem.frames if method.order == EXTRAPOLATED else 0
    beside = problem.beside((ROUNDED + WEIGHTS * math.sqrt(long_steps)) * 2.0**-53 / share)
    off = apart(problem, run, beside.take(Stepping(method.order, fewer), stride), stride).max(axis=-1)
    off = np.where(np.isnan(off), np.inf, off) * problem.frames / (problem.frames // stride * stride)
    return np.asarray(off * share + _rounding(problem, long_steps=long_steps))


def _states(found: Motion, some: np.ndarray) -> Motion:
    """Some balls of a motion."""
    arrays: dict[str, Any] = {name: None if array is None else array[some] for name, array in vars(found).items()}
    return Motion(**arrays)


def _put(found: Motion, where: np.ndarray, run: Run, method: Stepping, error: Floats) -> None:
    """Copies a run to its place."""
    found.angular_momentum[where], found.gamma[where] = run.angular_momentum, run.gamma
    if found.attitude is not None:
        found.attitude[where] = run.attitude
    if found.contact is not None:
        found.contact[where] = run.contact
    found.reached[where], found.status[where] = run.taken // method.steps, run.status
    found.error[where], found.order[where], found.steps[where] = error, method.order, method.steps
