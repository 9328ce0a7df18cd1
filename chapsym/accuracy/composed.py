"""Balls followed to an accuracy by compositions of the map, where the roundings of long steps are too many.

The error of an order p after t seconds is about c (|ω|h)^p (1 + |ω|t), with nearly the same c for every ball that is
not near a separatrix.  A run is compared with one of fewer steps, and by Richardson's rule its own error is their
difference / (r^p - 1), where r is the ratio of the steps; it is taken `SAFETY` times as large.  A run that fails
teaches the law, and is taken again with more steps.
"""

import math
from collections.abc import Callable

import numpy as np

from chapsym.dynamics import Status
from chapsym.dynamics.ball import Floats
from chapsym.dynamics.loops.expected import FLOOR

from .problem import Motion, Problem, Run, Stepping, apart

#: c of each order, measured on balls of all shapes; and the part of the accuracy that the law is to give.
LAW, MARGIN = {2: 0.16, 4: 4.8e-3, 6: 1.9e-3, 8: 1.5e-5}, 0.1
#: How many times as large as Richardson's rule says an error is taken to be, and by which ratio steps are compared.
SAFETY, RATIO = 4.0, 1.5
#: How many roundings beside the start a run begins that verifies another.
ROUNDED = 8
#: Runs that are tried, and how many times the steps of one, at least and at most, the next of the same order has.
ATTEMPTS, LEAST_FINER, MOST_FINER = 8, 1.2, 4.0


def composed(
    problem: Problem, some: np.ndarray, found: Motion, progress: Callable[[float], None] = lambda part: None
) -> None:
    """Runs some balls until each is verified, with more steps those that are not; puts each where it belongs.

    A ball that more steps do not help keeps the error that it has: rounding alone is larger than the accuracy.
    """
    method, left, factor = cheapest(problem.of(some)), some, 1.0
    before, gain = np.full(len(some), np.inf), 1.0
    for attempt in range(ATTEMPTS):
        part = problem.of(left)
        run = part.take(method)
        error = _verified(part, method, run)
        there = (error <= problem.accuracy) | (attempt + 1 == ATTEMPTS)
        there |= np.isfinite(before) & np.isfinite(error) & (error > before / gain)
        told = np.where(run.status == Status.TAKEN, error, np.nan)
        _put(found, left[there], run.of(there), method, told[there])
        progress(len(some) - len(left) + there.sum())
        if there.all():
            return
        left, before, last = left[~there], error[~there], method
        if np.isfinite(before).all():
            part = problem.of(left)
            expected = _error(part, method.order, problem.interval / method.steps)
            factor = max(factor, float((before / (SAFETY * expected)).max(initial=1.0)))
            method = _more(method, cheapest(part, factor))
        else:  # a ball that stopped has no estimate
            method = Stepping(method.order, 2 * method.steps)
        # Of what more steps should gain half, in decades, shows that they help.
        gain = (method.steps / last.steps) ** (method.order / 2) if method.order == last.order else 2.0


def _error(problem: Problem, order: int, step: float) -> Floats:
    """The error by the law, of each ball."""
    rate = problem.rate
    return np.asarray(LAW[order] * (rate * step) ** order * (1 + rate * problem.end) * problem.unit)


def cheapest(problem: Problem, factor: float = 1.0) -> Stepping:
    """The order of the fewest stages that is expected to do for all balls, with errors `factor` times the law.

    The steps are so many that the last frame is one that can be compared: an error may grow a thousandfold within one.
    """
    least, found = 1 + problem.frames % 2, []
    for order in LAW:
        expected = factor * _error(problem, order, problem.interval)
        steps = float(((expected / (MARGIN * problem.accuracy)) ** (1 / order)).max())
        found.append(Stepping(order, max(math.ceil(steps), least)))
    return min(found, key=lambda method: method.stages)


def _more(method: Stepping, wanted: Stepping) -> Stepping:
    """What to try next: of the same order neither hardly more steps nor very many more."""
    if wanted.order != method.order:
        return wanted
    least, most = math.ceil(LEAST_FINER * method.steps), math.ceil(MOST_FINER * method.steps)
    return Stepping(method.order, min(max(wanted.steps, least), most))


def _verified(problem: Problem, method: Stepping, run: Run) -> Floats:
    """The error of each ball by a run of fewer steps, infinite if one has stopped; and what rounding may leave.

    That run starts a few roundings beside the other, so that a ball that is sensitive to its start shows it.
    """
    stride, fewer = (2, 1) if method.steps == 1 else (1, 1 if method.steps == 2 else round(method.steps / RATIO))
    left = (stride * method.steps / fewer) ** method.order - 1
    share = min(SAFETY / left, max(1.0, 2 / left))
    beside = problem.beside(ROUNDED * 2.0**-53 / share).take(Stepping(method.order, fewer), stride)
    off = apart(problem, run, beside, stride).max(axis=-1)
    off = np.where(np.isnan(off), np.inf, off) * problem.frames / (problem.frames // stride * stride)
    rounded = problem.survey[FLOOR]
    if run.contact is not None and problem.ball.radius is not None and "contact" in problem.parts:
        # The way of the contact point is a sum of as many terms as there are steps of the map, and each turns with the
        # attitude, which is a product of as many.
        way = np.nan_to_num(np.abs(run.contact)).max(axis=(-2, -1)) / problem.ball.radius + problem.rate * problem.end
        rounded = rounded + problem.units * way * 2.0**-53 * (problem.frames * method.stages) ** 0.5
    return np.asarray(off * share + rounded)


def _put(found: Motion, where: np.ndarray, run: Run, method: Stepping, error: Floats) -> None:
    """Copies a run to its place."""
    found.angular_momentum[where], found.gamma[where] = run.angular_momentum, run.gamma
    if found.attitude is not None:
        found.attitude[where] = run.attitude
    if found.contact is not None:
        found.contact[where] = run.contact
    found.reached[where], found.status[where] = run.taken // method.steps, run.status
    found.error[where], found.order[where], found.steps[where] = error, method.order, method.steps
