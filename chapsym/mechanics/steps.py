"""Steps of a method in the numbers of any precision; in enclosures each root is proved.

Balls for each number of a state would grow by a factor per step, like a rotated box.  So a set of states is
c + B r, with a point c, a nearly orthogonal matrix B and balls r, which the derivatives of a step move: R. Lohner, in
Computational Ordinary Differential Equations (1992) 425.
"""

from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import Any

import numpy as np
import sympy as sp
from flint import arb_mat

from chapsym.dynamics.errors import BadInput
from chapsym.dynamics.implicit import Equations, Vector
from chapsym.dynamics.kernels import Function, parts_of
from chapsym.numbers import Double, Enclosure, Precision

from .methods import Scheme

#: The state of a method: numbers, or in enclosures a set of them (see `Sets`).
State = Any
#: Why there is no step.
UNSOLVED = "has no solution near the last one"


class NotSolved(ArithmeticError):
    """A step that was not found; the message names it."""


class Steps:
    """A method at a precision: Newton's iteration for each step starts from the unknowns of the last step.

    Its kernels take the unknowns, with a given first guess, a state, and the constants, last the length of a step.
    """

    def __init__(
        self, scheme: Scheme, functions: Mapping[str, Function], level: Precision,
        unknowns: Sequence[float], fixed: Vector,
    ) -> None:  # fmt: skip
        self.scheme, self.functions, self.level, self.fixed = scheme, functions, level, fixed
        self.unknowns: Vector = unknowns
        self.equations = Equations(functions["residual"], functions["slope"], len(unknowns), 1.0)

    def number(self, value: sp.Rational) -> Any:
        """The number of a rational one of SymPy."""
        return self.level.number(Fraction(value.p, value.q))

    def of(self, name: str, unknowns: Vector, at: Vector) -> Vector:
        """The result of a kernel."""
        return [0 * self.fixed[-1] + x for x in parts_of(self.functions[name](*unknowns, *at, *self.fixed))]

    def root(self, at: Vector) -> Vector:
        """The unknowns at a state."""
        known = [*at, *self.fixed]
        try:
            self.unknowns = self.equations.at_level(self.unknowns, list(map(float, known)), Double())
            is_double = isinstance(self.level, Double)
            return self.unknowns if is_double else self.equations.at_level(self.unknowns, known, self.level)
        except BadInput:
            raise NotSolved(UNSOLVED) from None

    def after(self, root: Vector, at: Vector) -> Vector:
        """The next state by the unknowns of a step."""
        found = self.of("after", root, at)
        return self.scheme.step(at, found, self.fixed[-1], lambda x: self.of("after", self.root(x), x), self.number)

    def step(self, state: State) -> tuple[Vector, State]:
        """The position and velocity at the point of evaluation, and the next state."""
        root = self.root(state)
        return self.of("seen", root, state), self.after(root, state)

    def first(self, state: Vector) -> State:
        """A state as the argument of `step`."""
        return list(state)

    def numbers(self, state: State) -> Vector:
        """A state as numbers."""
        return state


class Sets(Steps):
    """The same in enclosures; a state is (c, B, r)."""

    level: Enclosure

    def first(self, state: Vector) -> State:
        """A state of balls."""
        size = len(state)
        unit = arb_mat(size, size, [int(i == j) for i in range(size) for j in range(size)])
        return [x.mid() for x in state], unit, arb_mat(size, 1, [x - x.mid() for x in state])

    def numbers(self, state: State) -> Vector:
        """A state as balls."""
        point, frame, box = state
        return [c + x for c, x in zip(point, (frame * box).entries(), strict=True)]

    def step(self, state: State) -> tuple[Vector, State]:
        """c moves as a point, and B r by the derivatives on the whole set."""
        point, frame, box = state
        size, at, middle = len(point), self.numbers(state), self.root(point)
        reached = self.after(middle, point)
        try:
            if any(x.rad() > 1 + abs(x.mid()) for x in at):
                raise NotSolved
            # The derivatives by the unknowns are regular on all of these, so that both roots are of one branch.
            root = [x.union(y) for x, y in zip(self.root(at), middle, strict=True)]
            rows = [np.array([x, *(int(i == j) for j in range(size))], object) for i, x in enumerate(at)]
            first, length = self._moved(root, rows), self.fixed[-1]
            moved = self.scheme.step(
                rows, first, length, lambda x: self._moved(self.root([row[0] for row in x]), x), self.number
            )
            turned = arb_mat([list(row[1:]) for row in moved]) * frame
            frame = arb_mat(_orthogonal(turned, box))
            point = [x.mid() for x in reached]
            inverse, rest = frame.inv(), arb_mat(size, 1, [x - c for x, c in zip(reached, point, strict=True)])
        except (NotSolved, ZeroDivisionError, np.linalg.LinAlgError):
            widest = max(float(x.rad()) for x in at)
            raise NotSolved(
                f"has an enclosure that has grown too wide, to a radius of {widest:.1g}: take more bits than "
                f"Enclosure({self.level.bits}), or fewer steps"
            ) from None
        return self.of("seen", root, at), (point, frame, (inverse * turned) * box + inverse * rest)

    def _moved(self, root: Vector, rows: Sequence[np.ndarray]) -> list[np.ndarray]:
        """The next rows after rows of a number and its derivatives by the first state.

        For the unknowns z, F(z, y) = 0: z' = -F_z⁻¹ F_y, and so that of G(z, y) is G_y - G_z F_z⁻¹ F_y.
        """
        at = [row[0] for row in rows]
        n, size = len(root), len(root) + len(at)
        table = np.array(self.of("turning", root, at), object).reshape(-1, size)
        f_z, f_y, g_z, g_y = (arb_mat(half.tolist()) for part in np.vsplit(table, [n]) for half in np.hsplit(part, [n]))
        by_first = (g_y - g_z * f_z.solve(f_y)) * arb_mat([list(row[1:]) for row in rows])
        values = self.of("after", root, at)
        return [np.array([x, *row], object) for x, row in zip(values, by_first.tolist(), strict=True)]


def _orthogonal(matrix: arb_mat, box: arb_mat) -> list[list[float]]:
    """A nearly orthogonal matrix along the columns of another, the longest of the set first."""
    middle = np.array(matrix.mid().tolist(), float)
    longest = np.argsort(-np.linalg.norm(middle, axis=0) * np.array([float(x.rad()) for x in box.entries()]))
    return np.linalg.qr(middle[:, longest])[0].tolist()
