"""Runs and steps at any precision: Digits(n) in mpmath's numbers, Enclosure(bits) in Arb's balls."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import partial
from typing import Any

from chapsym.numbers import Digits, Enclosure

from ..coefficients import COMPOSITIONS
from ..errors import BadInput, Status, StepNotTaken
from .frames import Balls, Frames
from .start import Exact, magnitude

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
    done, selected, bits = 0, [], precision.bits if isinstance(precision, Enclosure) else precision.context.prec
    for i in range(len(balls.D)):
        first = frames.attitude[i, 0].copy() if frames.with_body else None
        so_far = partial(lambda before, step: progress(before + step), done)
        way = _Way(balls, i, steps, every, frames, order, bits, so_far, first)
        if isinstance(precision, Enclosure):
            selected.append(_run_ball(precision, way))
        else:
            from flint import ctx  # 40 ms with mpmath

            from .balls import DigitsBall

            ball = DigitsBall(precision, *way.given, steps=steps)
            with ctx.workprec(ball.precision):
                way.take(ball)
        done += int(frames.taken[i])
    return selected


@dataclass(frozen=True, eq=False)
class _Way:
    """The remaining work for one ball."""

    balls: Balls
    i: int
    steps: int
    every: int
    frames: Frames
    order: int
    bits: int
    progress: Callable[[int], None]
    attitude: Any  # that frame 0 was given, in float64

    @property
    def given(
        self,
    ) -> tuple[Exact, Exact, Exact, Fraction, Exact, Any, float]:
        """𝒦, γ, J and D, exactly; the exact coefficients, the attitude (empty: the least rotation) and the radius."""
        b, i = self.balls, self.i
        attitude = None
        if self.frames.with_body:
            attitude = () if self.frames.least else tuple(map(Fraction, self.attitude))
        stages = COMPOSITIONS[self.order].exact
        momentum, gamma, tensor = (list(map(Fraction, x[i])) for x in (b.momentum, b.gamma, b.mass_tensor))
        if b.rest is not None:
            momentum = [x + Fraction(y) for x, y in zip(momentum, b.rest[i], strict=True)]
        return momentum, gamma, tensor, Fraction(b.D[i]), stages, attitude, float(b.radius[i])

    def take(self, ball: Any, enough: Callable[[int], bool] = lambda step: True) -> None:
        """Takes the steps and writes the frames; stops early where `enough` says no."""
        frames, i = self.frames, self.i
        frames.taken[i] = 0
        frames.momentum[i, 1:], frames.gamma[i, 1:] = math.nan, math.nan
        frames.attitude[i, 1:], frames.contact[i, 1:] = math.nan, math.nan
        write(frames, i, 0, ball.frame(self.bits))
        for step in range(1, self.steps + 1):
            try:
                ball.step()
            except StepNotTaken as stop:
                frames.status[i], frames.reach[i] = stop.status, stop.reach
                return
            frames.taken[i] = step
            if not enough(step):
                return
            if step % self.every == 0:
                write(frames, i, step // self.every, ball.frame(self.bits))
            if step % CHUNK == 0 or step == self.steps:
                self.progress(step)


def _run_ball(precision: Enclosure, way: _Way) -> int:
    """Repeats the run with more bits until `precision.bits` are left; raises BadInput where more do not help.

    Returns how many rotations were selected.
    """
    guard, before, stuck = precision.guard, (0, -math.inf), 0
    _, lost = magnitude(*way.given[2:4])
    while guard <= MOST_GUARD:
        bits = precision.bits + guard
        step, left, selected = _attempt(bits, way)
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


def _attempt(bits: int, way: _Way) -> tuple[int, float, int]:
    """Runs with so many bits while enough are left.

    Returns the step where they were last looked at, the bits left there, and how many rotations were selected.  None
    are left where a step could not be proved.
    """
    from flint import ctx

    from .balls import ArbBall
    from .proved_root import TooWide

    seen: tuple[int, float] = (0, math.inf)
    with ctx.workprec(bits):
        ball = ArbBall(bits, *way.given)

        def enough(step: int) -> bool:
            nonlocal seen
            if step % LOOK and step % way.every and step != way.steps:
                return True
            seen = (step, ball.bits())
            return seen[1] >= way.bits

        try:
            way.take(ball, enough)
        except TooWide:
            return seen[0] + 1, 0.0, ball.selected
        if way.frames.status[way.i] != Status.TAKEN:
            seen = (int(way.frames.taken[way.i]), ball.bits())
    if seen[1] < way.bits:
        way.frames.status[way.i], way.frames.reach[way.i] = Status.TAKEN, 1.0  # of balls that were too wide to tell
    return *seen, ball.selected


def write(frames: Frames, i: int, at: int, values: tuple[Any, Any, Any, Any]) -> None:
    """One frame of one ball: 𝒦, γ, and the attitude and the contact point where there are any."""
    momentum, gamma, attitude, contact = values
    frames.momentum[i, at], frames.gamma[i, at] = momentum, gamma
    if frames.with_body:
        frames.attitude[i, at], frames.contact[i, at] = attitude, contact
