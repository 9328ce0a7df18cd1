"""The Moser-Veselov discrete Euler top, every state at once: each step adds the same increment to Jacobi's u.

So it is for D = 0 (5.15-euler), 𝒦 any, and for vertical momentum 𝒦 = hγ and D > 0 where two J are equal: k = 0, the
curve is a circle, and (5.15) as corrected does not know ū.  For three different J and D > 0 the increment changes.
The increment over the period is the rotation number; as a double-double number it is good for 10¹⁴ steps and more.
"""

import math
from dataclasses import dataclass, replace
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from chapsym.generated import curve_increment
from chapsym.numbers import Enclosure

from ..ball import Ball, Floats, in_principal_axes, inertia_of, numbers, unit_vertical
from ..errors import BadInput
from ..trajectories import step_numbers
from . import turns
from .elliptic import Curve, increment
from .jacobi import jacobi
from .vertical import step_vertical

#: Bits in which the increment is found: moments may be equal to 1e-15, and Λl - 1 as small as SMALLEST_TURN².
BITS = 512
MOST_CORRECTIONS = 12
#: The increment is found when a correction is below this, relatively.
SETTLED = 2.0**-130
#: A direction of 𝒦 that moves less than this while the body turns by 1 is left to `trajectory`.
SMALLEST_TURN = 1e-40
#: How far the step of the map may be from where the increment leads: more is another branch.
AGREEMENT = 1e-9


@dataclass(frozen=True, eq=False)
class TopMotion:
    """The motion of one Moser-Veselov top, or of a ball with vertical momentum and two equal J.

    curve: the curve of 𝒦/|𝒦| (of γ where 𝒦 = hγ); size: what makes 𝒦 of its points, in kg m².
    start: u at the step 0; direction: the point there, as it was given.
    turns: the increment of u over the period 4K(k), with its sign, as a pair: `rotation_number` and what it lacks.
    exact: the same motion in Arb's numbers; first: the rotation of the first step.
    """

    curve: Curve
    size: float
    start: float
    direction: Floats
    turns: tuple[float, float]
    exact: "ExactCurve"
    first: Floats

    @classmethod
    def free(cls, ball: Ball, momentum: ArrayLike) -> Self:
        """The top with D = 0 and 𝒦, (3,), in kg m².

        Raises BadInput for D > 0, a batch, and where 𝒦 stays (`is_steady`) or is on a separatrix, and StepNotTaken as
        `step_vertical` does.
        """
        K = numbers(momentum, "momentum", 3)
        _one(ball, K)
        if float(ball.D) != 0.0:
            raise BadInput("a ball with D > 0 is no free top")
        largest = float(np.abs(K).max())
        if largest == 0.0:
            raise BadInput("the momentum must not vanish: a ball at rest stays where it is")
        exponent = int(np.frexp(largest)[1])
        scaled = np.ldexp(K, -exponent)
        length = float(np.sqrt(scaled @ scaled))
        return cls._through(ball, float(np.ldexp(length, exponent)), scaled / length, (scaled, exponent))

    @classmethod
    def vertical(cls, ball: Ball, height: float, gamma: ArrayLike) -> Self:
        """The ball with 𝒦 = hγ, h in kg m², γ (3,) divided by its length, where D = 0 or two J are equal.

        Raises BadInput for other balls and as `free` does.
        """
        h, g = numbers(height, "height"), unit_vertical(gamma)
        _one(ball, g)
        J = ball.mass_tensor
        if h.shape or h == 0.0:
            raise BadInput("height must be one number that is not 0: a ball at rest stays where it is")
        if float(ball.D) > 0.0 and len(set(J.tolist())) != 2:
            raise BadInput("for D > 0 the increment is the same for every step only where two J are equal")
        return cls._through(ball, float(h), g, None)

    @classmethod
    def _through(cls, ball: Ball, size: float, axis: Floats, scaled: tuple[Floats, int] | None) -> Self:
        """From the direction, and the 𝒦 = vector·2^exponent that gives it exactly; else the direction is exact."""
        unit = axis / np.sqrt(axis @ axis)
        if not moves(ball.mass_tensor, ball.D, unit):
            raise BadInput("the map fixes this direction of the momentum, or nearly so; it has no curve")
        curve = Curve.through(ball, unit)
        if curve.complement == 0.0:
            raise BadInput("on the separatrix the period is infinite; run `trajectory`")
        start = float(curve.argument(unit))
        step = step_vertical(ball, size, unit)  # raises where there is none
        half = float(increment(curve, size, start)) / 2.0
        if np.abs(curve.point(start + 2.0 * half) - step.gamma).max() > AGREEMENT:
            raise BadInput("the step of the map is not on the branch of the increment; take a shorter time step")
        with Enclosure(BITS).working():
            exact = ExactCurve.of(curve, axis, scaled, size, half)
            found = as_pair(exact.half / (2 * exact.quarter))
            curve = exact.nearest()
        return cls(curve, size, float(exact.start.mid()), axis, found, exact, step.rotation)

    @property
    def rotation_number(self) -> float:
        """The increment of a step over the period: turns on the curve a step, with the sign of u's motion."""
        return self.turns[0]

    def phase(self, index: ArrayLike) -> Floats:
        """u at the step numbers `index`, (frames,), in [start - 2K, start + 2K]."""
        high, low = self.turns
        part = turns.fraction(np.asarray(high), np.asarray(low), step_numbers(index))
        return self.start + self.curve.period * part

    def directions(self, index: ArrayLike) -> Floats:
        """𝒦/|𝒦| (γ where 𝒦 = hγ) at the step numbers, (frames, 3)."""
        points = self.curve.point(self.phase(index))
        points[np.asarray(index) == 0] = self.direction
        return points

    def momenta(self, index: ArrayLike) -> Floats:
        """𝒦 at the step numbers in kg m², (frames, 3)."""
        return self.size * self.directions(index)


def moves(tensor: Floats, contact: Floats, direction: Floats) -> np.ndarray:
    """Whether a direction of 𝒦 moves in the body by more than SMALLEST_TURN, (...)."""
    moments = inertia_of(tensor) + contact[..., np.newaxis]
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):  # what overflows moves
        spin = direction * (moments.max(axis=-1, keepdims=True) / moments)
        gaps = np.roll(tensor, -2, axis=-1) - np.roll(tensor, -1, axis=-1)
        b, c = np.roll(direction, -1, axis=-1), np.roll(spin, -2, axis=-1)
        turned = b * c * gaps / np.roll(moments, -1, axis=-1)
    return np.asarray(np.abs(turned).max(axis=-1) > SMALLEST_TURN)


def _one(ball: Ball, vector: Floats) -> None:
    if in_principal_axes(ball).D.shape or ball.mass_tensor.shape != (3,) or vector.shape != (3,):
        raise BadInput("this motion is of one ball, one momentum and one gamma, not of a batch")


@dataclass(frozen=True, eq=False)
class ExactCurve:
    """What a motion is in Arb's numbers, with 𝒦 and the mass tensor taken as exact.

    moments: Λ in the order of the curve; direction: of 𝒦, unit, (3,); height: 𝒦 = height·direction, in kg m².
    level: l; rate: V with its sign; k2: k²; start: u at the direction; half: δu, with its sign; quarter: K(k).
    """

    curve: Curve
    tensor: list[Any]
    contact: Any
    moments: list[Any]
    direction: list[Any]
    height: Any
    level: Any
    rate: Any
    k2: Any
    start: Any
    half: Any
    quarter: Any

    @classmethod
    def of(cls, curve: Curve, axis: Floats, scaled: tuple[Floats, int] | None, size: float, half: float) -> Self:
        """s = sn δu from (5.15) as corrected at 𝒟 = 1, by Newton from float64; δu = s R_F(cn², dn², 1)."""
        from flint import acb, arb

        tensor, contact = [arb(float(x)) for x in curve.ball.mass_tensor], arb(float(curve.ball.D))
        moments = [tensor[(i + 1) % 3] + tensor[(i + 2) % 3] + contact for i in curve.axes]
        vector = [arb(float(x)) for x in (axis if scaled is None else scaled[0])]
        length = sum((x * x for x in vector), arb(0)).sqrt()
        direction = [x / length for x in vector]
        height = arb(size) if scaled is None else length * arb(2) ** scaled[1]
        squares = (direction[i] ** 2 / m for i, m in zip(curve.axes, moments, strict=True))
        level = sum(squares, arb(0))
        k2, *G, mu = curve_increment(*(*moments, level))
        k2 = k2 if curve.modulus > 0.0 else arb(0)
        first = float(jacobi(np.asarray(abs(half)), curve.modulus, curve.complement)[0])
        s = _sine(k2, G, (1 - contact * level, contact * mu), abs(height), arb(first))
        found = s * acb.elliptic_rf(acb(1 - s * s), acb(1 - k2 * s * s), acb(1)).real
        rate = G[0].sqrt() * (1 if curve.rate > 0.0 else -1)
        found *= 1 if size * curve.rate > 0.0 else -1
        if not k2 < 1:
            raise BadInput("the motion is on the other side of the separatrix by a rounding; run `trajectory`")
        start = acb.elliptic_f(acb(amplitude(curve, moments, direction)), acb(k2)).real
        return cls(
            curve, tensor, contact, moments, direction, height, level, rate, k2, start, found,
            acb(k2).elliptic_k().real,
        )  # fmt: skip

    def nearest(self) -> Curve:
        """The curve with numbers rounded from these: next to the separatrix roundings of a direction are of its k'."""
        La, Lb, Lc = self.moments
        upper, lower = abs(1 - Lc * self.level), abs(La * self.level - 1)
        bc, ac = abs(Lb - Lc), abs(La - Lc)
        squares = La * upper / ac, Lb * upper / bc, Lc * lower / ac
        Ca, Cb, Cc = (float(square.sqrt()) for square in squares)
        return replace(
            self.curve, amplitudes=(Ca, Cb, math.copysign(Cc, self.curve.amplitudes[2])), rate=float(self.rate),
            modulus=float(self.k2.sqrt()), complement=float((1 - self.k2).sqrt()), level=float(self.level),
        )  # fmt: skip


def amplitude(curve: Curve, moments: list[Any], direction: list[Any]) -> Any:
    """φ = am u of a point of the curve, with C_b/C_a of (5.8)."""
    from flint import arb

    first, second, third = moments
    a, b, _ = curve.axes
    stretch = (second * (first - third) / (first * (second - third))).sqrt()
    return arb.atan2(direction[b], stretch * direction[a])


def as_pair(value: Any) -> tuple[float, float]:
    """An Arb number as the nearest pair of floats."""
    from flint import arb

    high = float(value.mid())
    return high, float((value.mid() - arb(high)).mid())


def _sine(k2: Any, G: list[Any], rolled: tuple[Any, Any], h: Any, s: Any) -> Any:
    """The s with 2V s cn dn (F + Dμ s²) = h(G₀ + G₁s² + G₂s⁴), by Newton's iteration from a float64."""
    V, (slack, slope) = G[0].sqrt(), rolled
    for _ in range(MOST_CORRECTIONS):
        y = s * s
        c, d = (1 - y).sqrt(), (1 - k2 * y).sqrt()
        w, rate = s * c * d, c * d - y * d / c - k2 * y * c / d
        value = 2 * V * w * (slack + slope * y) - h * (G[0] + y * (G[1] + y * G[2]))
        change = 2 * V * (rate * (slack + slope * y) + w * 2 * slope * s) - 2 * h * s * (G[1] + 2 * y * G[2])
        correction = (value / change).mid()
        s = (s - correction).mid()
        if abs(float(correction)) <= SETTLED * float(s):
            return s
    raise BadInput("the increment is at the fold of its branch; take a shorter time step")
