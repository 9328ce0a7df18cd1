"""The circle of a certificate of kind no-invariant-measure, for every parameter of its box."""

from fractions import Fraction
from itertools import pairwise

from .document import Data, check_work, scale
from .interval import Interval, Rejected
from .linear import Vector, times
from .step import Ball, Pair


def direction(t: Fraction) -> tuple[Fraction, Fraction]:
    """(cos φ, sin φ) for t = tan ½φ."""
    return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)


class Circle:
    """The circle of a certificate for every parameter of its box; raises Rejected unless the level is such a circle."""

    def __init__(self, data: Data):
        radius = Fraction(data["radius"])
        if radius < 0:
            raise Rejected("the radius must not be negative")
        J = [Fraction(x) for x in data["ball"]["J"]]
        D, height, level = (Fraction(data["ball"][name]) for name in ("D", "height", "level"))
        bits = scale(data["digits"], data["steps"], [*J, D, height, level])
        check_work(2 * data["steps"] + (data["branch"]["arcs"] if "branch" in data else 0), bits)
        self.ball = Ball.within(J, D, radius, bits)
        self.height, self.level = (Interval.about(x, bits, radius) for x in (height, level))
        if not self.height.sign:
            raise Rejected("the height is not proved to differ from 0")
        self.a, self.b, self.c = (i - 1 for i in data["axes"])
        self.weights = [1 / x for x in self.ball.contact]
        of_a, of_b, of_c = (self.weights[i] for i in (self.a, self.b, self.c))
        if not (of_a < of_b or of_b < of_a):
            raise Rejected("the three moments of inertia are not proved to be different")
        if not (of_c < self.level and self.level < of_a and self.level < of_b) and not (
            self.level < of_c and of_a < self.level and of_b < self.level
        ):
            raise Rejected("the level is not proved to be a circle around its axis")

    def point(self, cosine: Interval, sine: Interval) -> Vector:
        """The point of the circle in the direction (cosine, sine) of the plane (a, b), enclosed."""
        share = [w - self.weights[self.c] for w in (self.weights[self.a], self.weights[self.b])]
        square = (self.level - self.weights[self.c]) / (share[0] * (cosine * cosine) + share[1] * (sine * sine))
        gamma = [0 * square] * 3
        gamma[self.a], gamma[self.b] = square.sqrt() * cosine, square.sqrt() * sine
        gamma[self.c] = (1 - square).sqrt()
        return gamma

    def start(self, t: Fraction) -> Vector:
        """The point with t = tan ½φ."""
        return self.point(*(self.number(x) for x in direction(t)))

    def number(self, x: Fraction) -> Interval:
        """A rational number, enclosed."""
        return Interval.about(x, self.level.bits)

    def state(self, gamma: Vector) -> Pair:
        """The state (𝒦, γ), 𝒦 = hγ."""
        return times(self.height, gamma), gamma

    def sine(self, v: Vector, w: Vector) -> Interval:
        """A positive multiple of the sine of the angle from v to w in the plane (a, b)."""
        return v[self.a] * w[self.b] - v[self.b] * w[self.a]

    def direction(self, gammas: list[Vector]) -> int:
        """The common sign, 1 or -1, of the angles of all steps, each less than π; raises Rejected if not proved."""
        signs = {self.sine(v, w).sign for v, w in pairwise(gammas)}
        if len(signs) > 1 or 0 in signs:
            raise Rejected("the steps do not all turn in one direction by less than half a turn")
        return signs.pop()
