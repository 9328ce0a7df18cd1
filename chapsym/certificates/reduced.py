"""The reduced map G_h of an exact ball, 𝒦 = hγ: its level circles, and steps on them.

On the sphere a level ⟨γ,Λ⁻¹γ⟩ = l is two circles around a principal axis c.  With b the axis of the middle moment and
a the third one, the reflections γ_a → -γ_a and γ_b → -γ_b reverse G_h, and the rotation by π about c commutes with it.
Everything is computed at the precision of flint's context.
"""

from dataclasses import dataclass
from fractions import Fraction
from typing import cast

from flint import arb

from chapsym.checker.circle import direction
from chapsym.dynamics.errors import BadInput
from chapsym.dynamics.levels.balls import exact
from chapsym.dynamics.levels.proved_root import certified
from chapsym.generated import turn

from .balls import NotProved, near_root

Vector = tuple[arb, ...]
Axes = tuple[int, int, int]
#: Two levels, between which one is looked for.
Levels = tuple[Fraction, Fraction]
#: The number of steps in h from 0 that continue a root beyond the bound of `small-branch`.
CONTINUED = 16


@dataclass(frozen=True)
class Top:
    """A ball that rolls with 𝒦 = hγ: its exact mass tensor J, D = mρ² and vertical momentum h, in kg m²."""

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
        """The axes (a, b, c) of the circles at a level; raises BadInput if there are none."""
        near, far = self.sides()
        least, middle, most = (1 / self.moments[i] for i in near)
        if not least < level < most or level == middle:
            raise BadInput(
                f"the levels of circles are between 1/Λ = {least} and {most}, except {middle}, and {level} is not"
            )
        return near if level > middle else far


class Reduced:
    """G_h of a top at points, unproved: the checker proves that these are roots, and on which branch.

    If |h| is beyond the bound of lemma `small-branch`, `is_small` is False: each root is near those of the small
    branch, which is continued from h = 0.
    """

    def __init__(self, top: Top) -> None:
        J = [exact(x) for x in top.J]
        self.I = (J[1] + J[2], J[0] + J[2], J[0] + J[1])
        self.D, self.half = exact(top.D), exact(top.height) / 2
        self.is_small = certified(2 * abs(self.half), self.I) is not None

    def start(self, level: Fraction, axes: Axes, t: Fraction) -> Vector:
        """The point of a level circle with tan ½φ = t, φ the angle in the plane of (a, b), and γ_c positive."""
        a, b, c = axes
        cosine, sine = (exact(x) for x in direction(t))
        of_a, of_b, of_c = (1 / (self.I[i] + self.D) for i in axes)
        square = (exact(level) - of_c) / ((of_a - of_c) * cosine**2 + (of_b - of_c) * sine**2)
        gamma = [arb(0)] * 3
        gamma[a], gamma[b], gamma[c] = square.sqrt() * cosine, square.sqrt() * sine, (1 - square).sqrt()
        if not (square > 0 and gamma[c] > 0):
            raise NotProved("the level may be at the end of its range")
        return tuple(x.mid() for x in gamma)

    def root(self, gamma: Vector, near: Vector | None = None) -> Vector:
        """The Gibbs vector of the step from γ.

        near: beyond the bound, the Gibbs vector of a nearby γ; without it the root is continued from h = 0.
        """
        if self.is_small:
            return near_root(self._momentum(gamma), gamma, self.I, self.D)
        for part in range(1, CONTINUED + 1) if near is None else (CONTINUED,):
            momentum = tuple(arb(part) / CONTINUED * x for x in self._momentum(gamma))
            near = near_root(momentum, gamma, self.I, self.D, near)
        return cast(Vector, near)

    def orbit(self, level: Fraction, axes: Axes, t: Fraction, steps: int) -> tuple[list[Vector], list[Vector]]:
        """The Gibbs vectors of the steps from a start, and γ before, between and after them."""
        gibbs, gammas = list[Vector](), [self.start(level, axes, t)]
        for _ in range(steps):
            gibbs.append(self.root(gammas[-1], gibbs[-1] if gibbs else None))
            turned = zip(gammas[-1], turn(1, *gibbs[-1], *gammas[-1]), strict=True)
            gammas.append(tuple((x + y).mid() for x, y in turned))
        return gibbs, gammas

    def _momentum(self, gamma: Vector) -> Vector:
        return tuple(self.half * x for x in gamma)


def cross(x: Vector, y: Vector, axes: Axes) -> arb:
    """x_a y_b - x_b y_a: positive if y is ahead of x in the plane of (a, b), by less than a half turn."""
    a, b, _ = axes
    return x[a] * y[b] - x[b] * y[a]


def angle(x: Vector, y: Vector, axes: Axes) -> arb:
    """The angle from x to y in the plane of (a, b), in (-π, π)."""
    a, b, _ = axes
    return arb.atan2(cross(x, y, axes), x[a] * y[a] + x[b] * y[b])
