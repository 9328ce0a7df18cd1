"""Balls followed to an accuracy by compositions of the map, where the roundings of long steps are too many.

The error of an order p after t seconds is about c (|ω|h)^p (1 + |ω|t), with nearly the same c for every ball that is
not near a separatrix.  A run is compared with one of fewer steps, and by Richardson's rule its own error is their
difference / (r^p - 1), where r is the ratio of the steps; it is taken `SAFETY` times as large.  A run that fails
teaches the law, and is taken again with more steps.  One whose predecessor, of half as many steps, has stopped is not
believed: errors do not yet fall as they should there, and may be alike by chance.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from chapsym.dynamics import Status, substeps
from chapsym.dynamics.ball import Floats
from chapsym.dynamics.loops.expected import FLOOR

from .problem import Motion, Problem, apart, nothing, put
from .request import lengths

#: c of each order, measured on balls of all shapes; and the part of the accuracy that the law is to give.
LAW, MARGIN = {2: 0.16, 4: 4.8e-3, 6: 1.9e-3, 8: 1.5e-5}, 0.1
#: How many times as large as Richardson's rule says an error is taken to be, and by which ratio steps are compared.
SAFETY, RATIO = 4.0, 1.5
#: How many roundings beside the start a run begins that verifies another.
ROUNDED = 8
#: A direction that nothing prefers.
ASIDE = np.array([0.6, 0.64, 0.48])
#: Runs that are tried, and how many times the steps of one, at least and at most, the next of the same order has.
ATTEMPTS, LEAST_FINER, MOST_FINER = 8, 1.2, 4.0


def composed(problem: Problem, progress: Callable[[float], None] = lambda part: None) -> Motion:
    """Runs all balls until each is verified, with more steps those that are not.

    Steps and estimates of a ball depend on it alone; balls of the same steps share a run.  A ball that more steps do
    not help keeps the error that it has: rounding alone is larger than the accuracy.
    """
    n = len(problem)
    found, left, factor, before = nothing(problem), np.arange(n), np.ones(n), np.full(n, np.inf)
    gain, stopped = np.ones(n), np.zeros(n, dtype=bool)
    found.order[:], found.steps[:] = cheapest(problem, factor)
    for attempt in range(ATTEMPTS):
        for order, steps in sorted(set(zip(found.order[left].tolist(), found.steps[left].tolist(), strict=True))):
            some = left[(found.order[left] == order) & (found.steps[left] == steps)]
            part = problem.of(some)
            run = part.take(order, steps)
            run.error[:] = _verified(part, order, steps, run)
            put(found, some, run)
        error = found.error[left]
        fell, error = np.isfinite(error), np.where(stopped[left], np.inf, error)
        found.error[left], stopped[left] = np.where(found.status[left] == Status.TAKEN, error, np.nan), ~fell
        there = error <= problem.accuracy
        there |= np.isfinite(before[left]) & np.isfinite(error) & (error > before[left] / gain[left])
        before[left], left = error, left[~there]
        progress(n - len(left))
        if not len(left) or attempt + 1 == ATTEMPTS:
            break
        part, order, steps = problem.of(left), found.order[left], found.steps[left]
        expected = _error(part, order, problem.interval / steps)
        known = np.isfinite(before[left])
        factor[left] = np.where(known, np.maximum(factor[left], before[left] / (SAFETY * expected)), factor[left])
        wanted, finer = cheapest(part, factor[left])
        least, most = LEAST_FINER * steps, MOST_FINER * steps
        finer = np.where(wanted == order, shared(np.minimum(np.maximum(finer, least), most)), finer)
        # One that stopped has no estimate of what it needs.
        found.order[left], found.steps[left] = np.where(known, wanted, order), np.where(known, finer, 2 * steps)
        # Of what more steps should gain half, in decades, shows that they help.
        gain[left] = np.where(found.order[left] == order, (found.steps[left] / steps) ** (order / 2), 2.0)
    return found


def _error(problem: Problem, order: Any, step: Any) -> Floats:
    """The error by the law, of each ball."""
    rate, law = problem.rate, np.vectorize(LAW.get, otypes=[float])(order)
    return np.asarray(law * (rate * step) ** order * (1 + rate * problem.end) * problem.units)


def cheapest(problem: Problem, factor: Floats) -> tuple[np.ndarray, np.ndarray]:
    """The order of the fewest stages that is expected to do, and its steps, of each ball, at `factor` times the law.

    The steps are so many that the last frame is one that can be compared: an error may grow a thousandfold within one.
    """
    found = []
    for order in LAW:
        expected = factor * _error(problem, order, problem.interval)
        found.append(shared((expected / (MARGIN * problem.accuracy)) ** (1 / order), 1 + problem.frames % 2))
    steps, stages = np.array(found), np.array([[len(substeps(order))] for order in LAW])
    best = (steps * stages).argmin(axis=0)
    return np.array(list(LAW))[best], np.take_along_axis(steps, best[np.newaxis], axis=0)[0]


def shared(steps: Floats, least: int = 1) -> np.ndarray:
    """Whole steps, rounded up to one of four numbers between powers of two: balls that need as many share them."""
    part, exponent = np.frexp(steps)
    return np.maximum(np.ceil(np.ldexp(np.ceil(8 * part), exponent - 3)), least).astype(np.int64)


def _verified(problem: Problem, order: int, steps: int, run: Motion) -> Floats:
    """The error of each ball by a run of fewer steps, infinite if one has stopped; and what rounding may leave.

    That run starts a few roundings beside the other, so that a ball that is sensitive to its start shows it.
    """
    stride, fewer = (2, 1) if steps == 1 else (1, 1 if steps == 2 else round(steps / RATIO))
    left = (stride * steps / fewer) ** order - 1
    share = min(SAFETY / left, max(1.0, 2 / left))
    moved = ROUNDED * 2.0**-53 / share * lengths(problem.K)[:, np.newaxis] * ASIDE
    beside = replace(problem, K=problem.K + moved).take(order, fewer, stride)
    off = apart(problem, run, beside, stride).max(axis=-1)
    off = np.where(np.isnan(off), np.inf, off) * problem.frames / (problem.frames // stride * stride)
    rounded = problem.survey[FLOOR]
    if run.contact is not None and problem.ball.radius is not None and "contact" in problem.parts:
        # The way of the contact point is a sum of as many terms as there are steps of the map, and each turns with the
        # attitude, which is a product of as many.
        way = np.nan_to_num(np.abs(run.contact)).max(axis=(-2, -1)) / problem.ball.radius + problem.rate * problem.end
        rounded = rounded + problem.units * way * 2.0**-53 * (problem.frames * len(substeps(order)) * steps) ** 0.5
    return np.asarray(off * share + rounded)
