"""Runs and steps at any precision: Digits(n) in mpmath's numbers, Enclosure(bits) in Arb's balls."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Any

from chapsym.numbers import Digits, Enclosure
from chapsym.numbers.precisions import flint_bits

from ..coefficients import COMPOSITIONS
from ..errors import BadInput, Status, StepNotTaken, TooWide
from .frames import Balls, Frames
from .start import Exact, magnitude

#: What a ball starts from: `_given`.
Given = tuple[Exact, Exact, Exact, Fraction, Exact, Any, float]
#: Steps of a ball between two calls of `progress`.
CHUNK = 200
#: Steps between two looks at the radii.
LOOK = 16
#: Times that more bits may not help before it is given up: a root that cannot be proved with some may be with more.
MOST_STUCK = 4
#: How often over a root may lose the bits that the conditioning costs.
CONDITION = 3
#: The most bits beyond those that are asked for.
MOST_GUARD = 2**22


def run(
    precision: Digits | Enclosure, balls: Balls, steps: int, every: int, frames: Frames, order: int,
    progress: Callable[[int], None],
) -> list[int]:  # fmt: skip
    """Takes `steps` steps of every ball into `frames`, one ball after the other; frame 0 is written anew.

    Returns for each ball how many rotations are not proved to be the branch's, but selected (`ArbBall.selected`).

    Enclosure(bits): with as many bits more as the radii grow by, which is measured, so that `bits` are left at the end.
    """
    from .balls import DigitsBall  # 40 ms, with mpmath and flint

    done, selected = 0, list[int]()
    for i in range(len(balls.D)):
        given = _given(balls, i, frames, order)
        way = _Way(frames, i, steps, every, partial(lambda before, step: progress(before + step), done))
        if isinstance(precision, Enclosure):
            selected.append(_enclosed(precision, given, way))
        else:
            ball = DigitsBall(precision, *given, steps=steps)
            with flint_bits(ball.precision):
                way.take(ball, precision.context.prec)
        done += int(frames.taken[i])
    return selected


def _given(balls: Balls, i: int, frames: Frames, order: int) -> Given:
    """𝒦, γ, J and D, exactly; the exact coefficients, the attitude (empty: the least rotation) and the radius."""
    attitude = None
    if frames.with_body:
        attitude = () if frames.least else tuple(map(Fraction, frames.attitude[i, 0]))
    momentum, gamma, tensor = (list(map(Fraction, x[i])) for x in (balls.momentum, balls.gamma, balls.mass_tensor))
    if balls.rest is not None:
        momentum = [x + Fraction(y) for x, y in zip(momentum, balls.rest[i], strict=True)]
    return momentum, gamma, tensor, Fraction(balls.D[i]), COMPOSITIONS[order].exact, attitude, float(balls.radius[i])


@dataclass(frozen=True, eq=False)
class _Way:
    """The steps of one ball, and the frames that they fill."""

    frames: Frames
    i: int
    steps: int
    every: int
    progress: Callable[[int], None]

    def take(self, ball: Any, bits: int, enough: Callable[[int], bool] = lambda step: True) -> None:
        """Takes the steps and writes the frames, with this many bits; stops early where `enough` says no."""
        f, i = self.frames, self.i
        kept = (f.momentum, f.gamma, *((f.attitude, f.contact) if f.with_body else ()))
        f.taken[i] = 0
        for array in kept:
            array[i, 1:] = math.nan
        for step in range(self.steps + 1):
            if step:
                try:
                    ball.step()
                except StepNotTaken as stop:
                    f.status[i], f.reach[i] = stop.status, stop.reach
                    return
                f.taken[i] = step
                if not enough(step):
                    return
            if step % self.every == 0:
                for array, values in zip(kept, ball.frame(bits), strict=False):
                    array[i, step // self.every] = values
            if step and (step % CHUNK == 0 or step == self.steps):
                self.progress(step)


def _enclosed(precision: Enclosure, given: Given, way: _Way) -> int:
    """The run with more bits until `precision.bits` are left, or BadInput; returns how many rotations were selected."""
    guard, before, stuck = precision.guard, (0, -math.inf), 0
    _, lost = magnitude(*given[2:4])
    while guard <= MOST_GUARD:
        bits = precision.bits + guard
        step, left, selected = _attempt(bits, precision.bits, given, way)
        if left >= precision.bits:
            return selected
        stuck = stuck + 1 if (step, left) <= before and guard > CONDITION * lost else 0
        if stuck == MOST_STUCK:
            break
        # What a step has cost, and a little more, for all steps.
        cost = (bits - left) / step if step else 0.0
        guard, before = max(2 * guard, math.ceil(1.1 * cost * way.steps) + precision.guard), (step, left)
    raise BadInput(
        f"the balls grow too much: after step {step} of {way.steps}, {bits} bits leave less than {precision.bits};"
        " take fewer or shorter steps"
    )


def _attempt(bits: int, wanted: int, given: Given, way: _Way) -> tuple[int, float, int]:
    """Runs with this many bits while those that are wanted are left.

    Returns the step where they were last looked at, the bits left there, and how many rotations were selected.  None
    are left where a step could not be proved.
    """
    from .balls import ArbBall

    seen: tuple[int, float] = (0, math.inf)
    with flint_bits(bits):
        ball = ArbBall(bits, *given)

        def enough(step: int) -> bool:
            nonlocal seen
            if step % LOOK and step % way.every and step != way.steps:
                return True
            seen = (step, ball.bits())
            return seen[1] >= wanted

        try:
            way.take(ball, wanted, enough)
        except TooWide:
            return seen[0] + 1, 0.0, ball.selected
        f, i = way.frames, way.i
        if f.status[i] != Status.TAKEN:
            seen = (int(f.taken[i]), ball.bits())
    if seen[1] < wanted:
        f.status[i], f.reach[i] = Status.TAKEN, 1.0  # of balls that were too wide to tell
    return *seen, ball.selected
