"""Runs in n dimensions at N digits: the text of the compiled loops in plain Python, on mpmath's numbers.

A stage starts from the float64 rotation of the continuation, which says which branch it is.  Newton's iteration, by the
text that float64 has (`loops.rotation_n`), gives it its digits.
"""

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from chapsym.numbers import Digits

from ..ball import Floats
from ..errors import Status, StepNotTaken
from ..loops import rotation_n
from .branch_n import small_rotation, top

#: Corrections of Newton from a float64 rotation: each doubles the digits.
MOST_ROUNDS = 100


class DigitsBallN:
    """A ball under way; moments are divided by a power of two, exactly, so that the largest is about 1."""

    def __init__(self, precision: Digits, state: dict[str, Floats], i: int, stages: Sequence[Fraction], steps: int):
        J, D = state["mass_tensor"][i], state["D"][i]
        exponent = int(np.frexp(top(J, D))[1])
        self.scale, self.home, self.stages = Fraction(2) ** exponent, precision.context, stages
        # The roundings of the steps add up to the square of their number, as frequencies drift.
        self.precision = precision.guarded(math.ceil(2 * math.log10(steps * len(stages) + 1)))
        self.tiny = self.precision.number(Fraction(1, 10 ** (self.precision.carried + 4)))
        self.k, self.J, self.D = (self._numbers(x, 1 / self.scale) for x in (state["momentum"][i], J, D))
        self.rough = np.ldexp(J, -exponent)[np.newaxis], np.ldexp(D, -exponent)[np.newaxis]
        g = self._numbers(state["gamma"][i])
        self.g = g / self.precision.sqrt((g * g).sum())
        self.with_body = "attitude" in state
        self.R = self.spot = None
        if self.with_body:
            self.R = self._numbers(state["attitude"][i])
            for _ in range(math.ceil(math.log2(self.precision.carried))):  # Newton and Schulz, from float64
                self.R = (3 * self.R - self.R @ self.R.T @ self.R) / 2
            self.spot = self._numbers(state.get("contact", np.zeros((i + 1, len(g) - 1)))[i])
        self.rho = self._numbers(state.get("radius", np.zeros(i + 1))[i])

    def _numbers(self, x: Floats, scale: Fraction = Fraction(1)) -> Any:
        """Exactly the floats, times a power of two; one number, or an array."""
        made = [self.precision.number(Fraction(float(y)) * scale) for y in np.ravel(x)]
        return np.array(made, dtype=object).reshape(np.shape(x)) if np.ndim(x) else made[0]

    def step(self) -> None:
        """Takes a step, stage by stage; raises StepNotTaken."""
        n = len(self.g)
        W, v = np.empty((n, n), dtype=object), np.empty(n, dtype=object)
        for c in self.stages:
            E = self._rotation(self.k * self.precision.number(c))
            if self.with_body:
                rotation_n.roll(E, self.g, self.R, self.spot, self.rho, v, W)
            rotation_n.move(E, self.k, self.g, W, v)

    def _rotation(self, k: Any) -> Any:
        """Ω - 1 of the small-rotation branch for the momentum k; raises StepNotTaken."""
        n, size = len(self.g), len(self.g) * (len(self.g) - 1) // 2
        rough_k, rough_g = (x.astype(float)[np.newaxis] for x in (k, self.g))
        rough, status, reach = small_rotation(rough_k, rough_g, *self.rough)
        if status[0] != Status.TAKEN:
            raise StepNotTaken(Status(int(status[0])), float(reach[0]))
        E, O, W = (self._numbers(rough[0]), *np.empty((2, n, n), dtype=object))
        T, r, (h, c) = np.empty((size, size), object), np.empty(size, object), np.empty((2, n), object)
        for _ in range(MOST_ROUNDS):
            off = rotation_n.polish(E, W, c)
            rotation_n.gap(E, k, self.g, self.J, self.D, c, r)
            rotation_n.slope(E, self.g, self.J, self.D, O, h, c, T)
            rotation_n.solve(T, r)
            change, extent = rotation_n.turn(E, r, O, W, c)
            # What is left is about the square of the correction.
            if change + off <= self.tiny * extent:
                return E
        raise StepNotTaken(Status.NOT_CONVERGED, 1.0)

    def frame(self) -> dict[str, Any]:
        """What moves, in the numbers that were asked for."""
        scale = self.precision.number(self.scale)
        now = {"momentum": self.k * scale, "gamma": self.g, "attitude": self.R, "contact": self.spot}
        return {name: self._given(x) for name, x in now.items() if x is not None}

    def _given(self, x: Any) -> Any:
        """Rounded to the digits that were asked for, and their guard."""
        return np.array([+self.home.mpf(y) for y in x.flat], dtype=object).reshape(x.shape)


def run(
    precision: Digits,
    state: dict[str, Floats],
    frames: dict[str, Any],
    stages: Sequence[Fraction],
    steps: int,
    every: int,
) -> tuple[np.ndarray, np.ndarray, Floats]:
    """`run_n.run` at N digits: writes the frames, of objects, and returns (taken, status, reach), (b,)."""
    balls = len(state["gamma"])
    taken, status, reach = np.zeros(balls, dtype=np.int64), np.zeros(balls, dtype=np.int64), np.ones(balls)
    for i in range(balls):
        ball = DigitsBallN(precision, state, i, stages, steps)
        for step in range(steps + 1):
            try:
                if step:
                    ball.step()
            except StepNotTaken as stop:
                status[i], reach[i] = stop.status, stop.reach
                break
            taken[i] = step
            if step % every == 0:
                now = ball.frame()
                for name, array in frames.items():
                    array[i, step // every] = now[name]
    return taken, status, reach
