"""The reduced map G_h of an exact ball, 𝒦 = hγ, in Arb's balls: its level circles, and steps that are proved.

On the sphere a level ⟨γ,Λ⁻¹γ⟩ = l is two circles around a principal axis c.  With b the axis of the middle moment and
a the third one, the reflections γ_a → -γ_a and γ_b → -γ_b reverse G_h, and the rotation by π about c commutes with it.
Everything is computed at the precision of flint's context.
"""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from flint import arb

from chapsym.dynamics.errors import BadInput
from chapsym.dynamics.levels.proved_root import MATRIX_BITS, certified, newton_enclosure, upper
from chapsym.generated import gibbs_residual, turn

from .balls import NotProved, ball, near_root

Vector = tuple[Any, ...]
Axes = tuple[int, int, int]


@dataclass(frozen=True)
class Top:
    """A ball that rolls with 𝒦 = hγ, exactly: its mass tensor J, D = mρ² and the height h, in kg m²."""

    J: tuple[Fraction, Fraction, Fraction]
    D: Fraction
    height: Fraction

    def __post_init__(self) -> None:
        if min(self.J) < 0 or sorted(self.J)[1] == 0:
            raise BadInput("the mass tensor of a ball has entries J ≥ 0, of which at most one is 0")
        if self.D < 0:
            raise BadInput("D = mρ² must not be negative")

    @property
    def moments(self) -> tuple[Fraction, ...]:
        """Λ = I + D, with I = (J2 + J3, J1 + J3, J1 + J2)."""
        return tuple(sum(self.J) - x + self.D for x in self.J)

    def sides(self) -> tuple[Axes, Axes]:
        """The axes (a, b, c) of the circles around the axis of the smallest moment, and around that of the largest."""
        order = sorted(range(3), key=lambda i: self.J[i])
        return (order[0], order[1], order[2]), (order[2], order[1], order[0])

    def axes_of(self, level: Fraction) -> Axes:
        """The axes (a, b, c) of the circles at a level; raises BadInput where there is none."""
        near, far = self.sides()
        least, middle, most = (1 / self.moments[i] for i in near)
        if not least < level < most or level == middle:
            raise BadInput(
                f"the levels of circles are between 1/Λ = {least} and {most}, without {middle}; {level} is none of them"
            )
        return near if level > middle else far


class Reduced:
    """G_h for all J, D and h within `radius` of a top; with radius 0 for that top.

    Raises BadInput where |h| is beyond the bound of lemma `small-branch`: there no step is proved.
    """

    def __init__(self, top: Top, radius: Fraction = Fraction(0)) -> None:
        J = [ball(x, radius) for x in top.J]
        self.I = (J[1] + J[2], J[0] + J[2], J[0] + J[1])
        self.D, self.half = ball(top.D, radius), ball(top.height, radius) / 2
        bound = certified(2 * abs(self.half), self.I)
        if bound is None:
            raise BadInput(
                f"|h| = {abs(top.height)} is beyond the bound of lemma small-branch for the moments of inertia "
                f"{', '.join(str(x - top.D) for x in top.moments)}; take a smaller height"
            )
        self.inner, self.slope = bound

    def start(self, level: Any, axes: Axes, zero: str) -> Vector:
        """The point of a level circle with γ_a = 0 (zero "a") or γ_b = 0 ("b"), the other one and γ_c positive."""
        a, b, c = axes
        left = b if zero == "a" else a
        L, M = self.I[left] + self.D, self.I[c] + self.D
        gap = self.I[c] - self.I[left]
        gamma = [arb(0)] * 3
        gamma[left], gamma[c] = (L * (M * level - 1) / gap).sqrt(), (M * (1 - L * level) / gap).sqrt()
        if not (gamma[left] > 0 and gamma[c] > 0):
            raise NotProved("the level may be at the end of its range")
        return tuple(gamma)

    def root(self, gamma: Vector) -> Vector:
        """The Gibbs vector of the step from the middle of γ, for the middle parameters: to rounding, no proof."""
        return near_root(self._momentum(gamma), gamma, self.I, self.D)

    def image(self, u: Vector, gamma: Vector) -> tuple[Vector, Vector]:
        """Encloses the Gibbs vectors and G_h of all γ in a box, for all parameters; u: a point near these vectors.

        Lemma `small-branch` holds for these parameters: a root with |u| < 1 is the small branch's, and the one.
        """
        if not upper(u) <= self.inner:
            raise NotProved("the Gibbs vector is not within the bound of lemma small-branch")
        state = (*self._momentum(gamma), *gamma, *self.I, self.D)
        v = newton_enclosure(u, gibbs_residual(*(*u, *state)), self.slope, state, 2 * MATRIX_BITS)
        return v, tuple(x + y for x, y in zip(gamma, turn(1, *v, *gamma), strict=True))

    def _momentum(self, gamma: Vector) -> Vector:
        return tuple(self.half * x for x in gamma)


def cross(x: Vector, y: Vector, axes: Axes) -> Any:
    """x_a y_b - x_b y_a: positive where y is ahead of x in the plane of (a, b), by less than a half turn."""
    a, b, _ = axes
    return x[a] * y[b] - x[b] * y[a]


def angle(x: Vector, y: Vector, axes: Axes) -> Any:
    """The angle from x to y in the plane of (a, b), in (-π, π)."""
    a, b, _ = axes
    return arb.atan2(cross(x, y, axes), x[a] * y[a] + x[b] * y[b])
