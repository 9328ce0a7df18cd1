"""Runs in n dimensions at N digits: the midpoints of Arb's matrices, with guard bits, and mpmath's numbers outside.

A stage starts from the float64 rotation of the continuation, which says which branch it is; Newton's iteration gives it
its digits.  A rotation Ω is kept as E = Ω - 1, as in `so_n`.
"""

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from flint import arb, arb_mat, ctx

from chapsym.numbers import Digits

from ..ball import Floats
from ..errors import Status, StepNotTaken
from ..levels.balls import GUARD, in_context
from . import so_n
from .branch_n import small_rotation, top

#: Corrections of Newton from a float64 rotation: each doubles the digits.
MOST_ROUNDS = 100


class DigitsBallN:
    """A ball under way; moments are divided by a power of two, exactly, so that the largest is about 1.

    Every method is to be called with the precision `bits` set.
    """

    def __init__(self, context: Any, bits: int, state: dict[str, Floats], i: int, stages: Sequence[Fraction]) -> None:
        g, J, D = (state[name][i] for name in ("gamma", "mass_tensor", "D"))
        self.context, self.bits, self.n = context, bits, len(g)
        self.exponent = int(np.frexp(top(J, D))[1])
        self.stages = [arb(c.numerator) / c.denominator for c in stages]
        self.rough = np.ldexp(J, -self.exponent)[np.newaxis], np.ldexp(D, -self.exponent)[np.newaxis]
        scale = arb(2) ** -self.exponent
        self.k = _matrix(state["momentum"][i]) * scale
        self.J = _matrix(np.diag(J)) * scale
        self.half = arb(float(D)) * scale / 2
        self.g = _matrix(g[:, np.newaxis])
        self.g = (self.g * (1 / _square(self.g).sqrt())).mid()
        self.one = _matrix(np.eye(self.n))
        self.basis = [_matrix(x) for x in so_n.from_coordinates(np.eye(self.n * (self.n - 1) // 2), self.n)]
        self.with_body = "attitude" in state
        if self.with_body:
            self.R = _matrix(state["attitude"][i]) - self.one
            for _ in range(bits.bit_length()):  # Newton and Schulz, from float64
                self.R = self._orthogonal(self.R)[0]
            self.R = self.R + self.one
            self.spot = _matrix(state["contact"][i][:, np.newaxis] if "contact" in state else np.zeros((self.n - 1, 1)))
        self.rho = arb(float(state["radius"][i])) if "radius" in state else arb(0)

    def step(self) -> None:
        """Takes a step, stage by stage; raises StepNotTaken."""
        for c in self.stages:
            E = self._rotation(self.k * c)
            if self.with_body:
                stride = (self.R * (E - E.transpose()) * self.g * (self.rho / 2)).entries()[:-1]
                self.spot = (self.spot + arb_mat(self.n - 1, 1, stride)).mid()
                self.R = (self.R + self.R * E).mid()
            self.g = (self.g + E.transpose() * self.g).mid()
            first = self.k * E
            half = first + E.transpose() * first * arb(0.5)
            self.k = (self.k + (half - half.transpose())).mid()  # exactly skew

    def _rotation(self, k: Any) -> Any:
        """Ω - 1 of the small-rotation branch for the momentum k; raises StepNotTaken."""
        rough, status, reach = small_rotation(_floats(k), _floats(self.g)[..., 0], *self.rough)
        if status[0] != Status.TAKEN:
            raise StepNotTaken(Status(int(status[0])), float(reach[0]))
        E = _matrix(rough[0])
        for _ in range(MOST_ROUNDS):
            E, off = self._orthogonal(E)
            slope = arb_mat([_below(self._momentum((E + self.one) * basis)) for basis in self.basis]).transpose()
            gap = _below(k - self._momentum(E))
            try:
                x = slope.solve(arb_mat(len(gap), 1, gap)).entries()
            except ZeroDivisionError:
                break
            xi = sum((basis * y for basis, y in zip(self.basis, x, strict=True)), 0 * self.one)
            turn = xi + xi * xi * arb(0.5)
            E = (E + turn + E * turn).mid()
            # What is left is about the square of the correction.
            if _square(xi).mid() + off <= arb(2) ** (-self.bits - GUARD) * _square(E).mid():
                return E
        raise StepNotTaken(Status.NOT_CONVERGED, 1.0)

    def _momentum(self, X: Any) -> Any:
        """`so_n.momentum` in Arb's matrices."""
        c = (X - X.transpose()) * self.g * self.half
        half = X * self.J + c * self.g.transpose()
        return half - half.transpose()

    def _orthogonal(self, E: Any) -> tuple[Any, Any]:
        """`so_n.orthogonal` in Arb's matrices, and how far E was, squared."""
        defect = E + E.transpose() + E.transpose() * E
        return (E - (defect + E * defect) * arb(0.5)).mid(), _square(defect).mid()

    def frame(self) -> dict[str, Any]:
        """What moves, in the numbers that were asked for."""
        now = {"momentum": self._given(self.k, self.exponent), "gamma": self._given(self.g)[:, 0]}
        if self.with_body:
            now |= {"attitude": self._given(self.R), "contact": self._given(self.spot)[:, 0]}
        return now

    def _given(self, x: Any, shift: int = 0) -> Any:
        """Rounded to the digits that were asked for, and their guard."""
        out = [in_context(self.context, y, self.context.prec, shift) for y in x.entries()]
        return np.array(out, dtype=object).reshape(x.nrows(), x.ncols())


def _matrix(x: Floats) -> Any:
    return arb_mat(np.asarray(x, dtype=float).tolist())


def _below(x: Any) -> list[Any]:
    """The coordinates of a skew matrix."""
    return [x[i, j] for i in range(x.nrows()) for j in range(i)]


def _square(x: Any) -> Any:
    """The sum of the squares of the entries."""
    return sum(y * y for y in x.entries())


def _floats(x: Any) -> Floats:
    """A batch of one matrix, in float64."""
    return np.array([float(y) for y in x.entries()]).reshape(1, x.nrows(), x.ncols())


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
    # The roundings of the steps add up to the square of their number, as frequencies drift.
    bits = precision.context.prec + 2 * math.ceil(math.log2(steps * len(stages) + 1)) + GUARD
    for i in range(balls):
        with ctx.workprec(bits):
            ball = DigitsBallN(precision.context, bits, state, i, stages)
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
