"""The boxes that contain the steps of a certificate, with a margin for the proof in another arithmetic."""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from chapsym.checker import measure
from chapsym.checker.document import Data
from chapsym.checker.interval import Interval
from chapsym.checker.linear import Vector, cross, dot, minus, times
from chapsym.checker.step import Ball, gibbs_vector, jacobian, residual

#: The unit of a row of an approximate inverse derivative; and the largest error of its product with the derivative.
ROW, KAPPA = Fraction(1, 10**8), Fraction(1, 10**5)


@dataclass(frozen=True)
class Box:
    """The vectors within a radius of decimal numbers."""

    centre: list[Fraction]
    radius: Fraction

    def end(self, sign: int) -> list[Fraction]:
        """The vector of the least or the greatest entries."""
        return [x + sign * self.radius for x in self.centre]


@dataclass(frozen=True)
class Step:
    """The boxes of u and the next γ, and their proof: bounds of F(centre of u) and of |u - centre|, and rows."""

    u: Box
    after: Box
    residual: Fraction
    distance: Fraction
    rows: list[list[Fraction]]


class Walk:
    """The orbits of a certificate in boxes; raises `chapsym.checker.Rejected` if it proves nothing."""

    def __init__(self, data: Data):
        self.data, self.circle, self.radius = data, measure.Circle(data), Fraction(data["radius"])
        self.J = [Fraction(x) for x in data["ball"]["J"]]
        self.D, self.height, self.level = (Fraction(data["ball"][name]) for name in ("D", "height", "level"))
        self.digits = len(str(self.radius.denominator)) + 6
        moments = [self.J[i - 2] + self.J[i - 1] for i in range(3)]
        least, most = min(moments) - 3 * self.radius, max(moments) + 3 * self.radius
        size = abs(self.height) + 2 * self.radius
        bound = next(x for x in (Fraction(i, 1000) for i in range(1, 1000)) if size * (1 + x * x) < 2 * least * x)
        self.growth = (least - bound * ((most - least) / 2 + size)) // ROW * ROW
        #: a, b, k, rho, m of `tame` in Steps.v.
        self.tame = (least, most, size, bound, self.growth)

    def enclosed(self, x: Fraction, radius: Fraction = Fraction(0)) -> Interval:
        """The numbers within a radius."""
        return Interval.enclosing(x - radius, x + radius, self.circle.level.bits)

    def box(self, v: Vector) -> Box:
        """A box that contains these intervals, slightly larger."""
        ends = [(Fraction(x.lo, 2**x.bits), Fraction(x.hi, 2**x.bits)) for x in v]
        centre = [round((lo + hi) / 2, self.digits) for lo, hi in ends]
        return Box(centre, roomy(max(max(c - lo, hi - c) for (lo, hi), c in zip(ends, centre, strict=True))))

    def step(self, before: Box, near: Sequence[str]) -> Step:
        """A step from a box, with a Gibbs vector near the numbers of the file."""
        ball, height = self.circle.ball, self.circle.height
        middle = Ball([x.point() for x in ball.inertia], ball.D.point())
        point = [self.enclosed(x).point() for x in before.centre]
        root = gibbs_vector(middle, (times(height.point(), point), point), [self.enclosed(Fraction(x)) for x in near])
        centre = self.box(root).centre
        at, gamma = [self.enclosed(x) for x in centre], [self.enclosed(x, before.radius) for x in before.centre]
        state = (times(height, gamma), gamma)
        missed = roomy(max(Fraction(x.most, 2**x.bits) for x in residual(ball, state, at)))
        distance = roomy(2 * missed / self.growth)
        rows = inverse([[Fraction(x.lo + x.hi, 2 << x.bits) for x in row] for row in jacobian(ball, state, at)])
        radius = roomy(max(sum(map(abs, row), Fraction(0)) for row in rows) * missed + 2 * KAPPA * distance)
        u = [self.enclosed(x, radius) for x in centre]
        once = cross(u, gamma)
        turned = minus(gamma, times(2 / (1 + dot(u, u)), minus(once, cross(u, once))))
        return Step(Box(centre, radius), self.box(turned), missed, distance, rows)

    def orbit(self, zero: int, steps: Sequence[Data]) -> tuple[Box, list[Step]]:
        """The start with γ_zero = 0, and the steps."""
        start = self.box(self.circle.start(Fraction(zero == self.circle.a)))
        found: list[Step] = []
        for given in steps:
            found.append(self.step(found[-1].after if found else start, given["u"]))
        return start, found

    def vector(self, box: Box) -> Vector:
        """The interval vector of a box."""
        return [self.enclosed(x, box.radius) for x in box.centre]


def roomy(x: Fraction) -> Fraction:
    """A few percent more than a positive number, with two digits."""
    unit = Fraction(1)
    while unit > x / 10:
        unit /= 10
    return -(-x * 103 // (100 * unit)) * unit


def inverse(matrix: Sequence[Any]) -> list[list[Fraction]]:
    """An approximate inverse of a 3 × 3 matrix."""
    columns: list[Any] = [cross(matrix[i - 2], matrix[i - 1]) for i in range(3)]
    det = dot(matrix[0], columns[0])
    return [[round(columns[j][i] / det / ROW) * ROW for j in range(3)] for i in range(3)]
