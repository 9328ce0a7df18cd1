"""The attitude of the Moser-Veselov top at every step at once.

R b/|b|, b = γ × Λ⁻¹γ for γ along 𝒦, is across 𝒦, which is fixed in space, and turns about it.  Along the continuous
motion its angle is ∫⟨b,Λ⁻¹b⟩/|b|² dt = cu + P(u), P periodic (lemma `top-precession`); the discrete top differs by a
twist that is the same each step (lemma `top-commutes`).  So its angle after k steps is kΨ + P(u_k) - P(u₀), and one
step of the map tells Ψ.  For two equal J nothing depends on u, P = 0; so it is for vertical momentum with D > 0, too.
"""

from dataclasses import dataclass
from typing import Any, Self

import numpy as np

from chapsym.generated import gibbs_newton, precession_parts, turn
from chapsym.numbers import Enclosure

from .. import kernels
from ..ball import Floats
from ..errors import BadInput
from . import turns
from .elliptic import across
from .top import BITS, MOST_CORRECTIONS, SETTLED, ExactCurve, TopMotion, amplitude, as_pair

#: Terms of the series of P: twice as many, until the last ones are rounding.
FEWEST, MOST = 16, 4096
ROUNDING = 2.0**-52


@dataclass(frozen=True, eq=False)
class Precession:
    """The rotations from the first attitude of a top to the later ones.

    turns: Ψ/(2π) as a pair, between -1/2 and 1/2; series: P(u) = Σ series_j sin(jπu/K), j = 1, 2, ...
    """

    motion: TopMotion
    turns: tuple[float, float]
    series: Floats

    @classmethod
    def of(cls, motion: TopMotion) -> Self:
        """Of a motion; raises BadInput so near to the separatrix that the series has too many terms."""
        exact = motion.exact
        with Enclosure(BITS).working():
            mean = _mean(exact, motion.first)
        return cls(motion, mean, _series(motion))

    def rotations(self, index: np.ndarray) -> Floats:
        """Unit quaternions Q with R_k = R₀Q_k at the step numbers, (frames, 4), the scalar ≥ 0."""
        motion, high = self.motion, self.turns
        u = motion.phase(index)
        angle = 2.0 * np.pi * turns.fraction(np.asarray(high[0]), np.asarray(high[1]), index)
        angle = angle + self.wave(u) - self.wave(np.asarray(motion.start))
        here = motion.directions(index)
        first = motion.direction / np.sqrt(motion.direction @ motion.direction)
        # The least rotation from the direction now to the first one, and the rest about that.
        middle = first + here
        length = np.sqrt((middle * middle).sum(axis=-1))
        least = (
            np.concatenate([(middle @ first)[:, np.newaxis], np.cross(here, first)], axis=-1) / length[:, np.newaxis]
        )
        tensor, moments, _ = _scaled(motion)
        before = across(tensor, moments, first)
        after = kernels.rotate(least, across(tensor, moments, here))
        rest = angle - np.arctan2(np.cross(before, after) @ first, after @ before)
        about = np.concatenate([np.cos(rest / 2.0)[:, np.newaxis], np.sin(rest / 2.0)[:, np.newaxis] * first], axis=-1)
        whole = kernels.compose(about, least)
        whole *= np.where(whole[:, :1] < 0.0, -1.0, 1.0) / np.sqrt((whole * whole).sum(axis=-1, keepdims=True))
        whole[index == 0] = [1.0, 0.0, 0.0, 0.0]
        return whole

    def wave(self, u: Floats) -> Floats:
        """P(u) by Clenshaw's recurrence."""
        x = 4.0 * np.pi * u / self.motion.curve.period
        twice, b, c = 2.0 * np.cos(x), np.zeros_like(x), np.zeros_like(x)
        for a in self.series[::-1]:
            b, c = a + twice * b - c, b
        return np.asarray(b * np.sin(x))


def _scaled(motion: TopMotion) -> tuple[Floats, Floats, float]:
    """J, Λ and V in units in which the largest Λ is about 1: squares of γ × Λ⁻¹γ stay in range."""
    ball = motion.curve.ball
    moments = ball.inertia + ball.D
    exponent = int(np.frexp(moments.max())[1])
    return np.ldexp(ball.mass_tensor, -exponent), np.ldexp(moments, -exponent), float(
        np.ldexp(motion.curve.rate, exponent)
    )  # fmt: skip


def _series(motion: TopMotion) -> Floats:
    """The sines of P from the rate at equal steps of u over half the period."""
    curve = motion.curve
    if curve.modulus == 0.0:
        return np.zeros(0)
    count, (tensor, moments, unit) = FEWEST, _scaled(motion)
    while count <= MOST:
        u = np.arange(2 * count) * (curve.period / (4 * count))
        turned = across(tensor, moments, curve.point(u))
        rate = (turned * turned / moments).sum(axis=-1) / (turned * turned).sum(axis=-1) / unit
        waves = np.fft.rfft(rate).real[1:count] / count
        noise = ROUNDING / curve.complement * np.abs(rate).max()  # b is as short as k' near the unstable axis
        if np.abs(waves[-(count // 4) :]).max() <= noise:
            order = np.arange(1, count)
            felt = np.flatnonzero(np.abs(waves) > noise / 4.0)
            return (waves * curve.period / (4.0 * np.pi * order))[: felt.max(initial=-1) + 1]
        count *= 2
    raise BadInput("the motion is too near to the separatrix for its attitude at once; run `trajectory`")


def _mean(exact: ExactCurve, rotation: Floats) -> tuple[float, float]:
    """Ψ/(2π): the angle of the first step, less P(u₁) - P(u₀) by Legendre's integrals of the third kind."""
    from flint import acb, arb

    u = _gibbs_vector(exact, [arb(float(x)) / arb(float(rotation[0])) for x in rotation[1:]])
    d = exact.direction
    moments = dict(zip(exact.curve.axes, exact.moments, strict=True))
    after = [x + y for x, y in zip(d, turn(arb(1), *u, *d), strict=True)]
    before, moved = (_across([x / moments[i] for i, x in enumerate(v)], v) for v in (d, after))
    there = [x + y for x, y in zip(moved, turn(arb(-1), *u, *moved), strict=True)]  # the inverse rotation
    angle = arb.atan2(_dot(d, _across(there, before)), _dot(before, there))
    if exact.curve.modulus > 0.0:
        p0, p1, n0, n1 = precession_parts(*(*exact.moments, exact.level))
        n, factor = -p1 / p0, (n0 / p0 - n1 / p1) / exact.rate
        ends = [amplitude(exact.curve, exact.moments, v) for v in (d, after)]
        turned = ends[1] - ends[0]
        turned -= 2 * arb.pi() * round(float(turned / (2 * arb.pi())))
        third = [acb.elliptic_pi_inc(acb(n), acb(x), acb(exact.k2)).real for x in (ends[0], ends[0] + turned)]
        whole = acb.elliptic_pi(acb(n), acb(exact.k2)).real
        angle -= factor * (third[1] - third[0] - 2 * exact.half * whole / exact.quarter)
    high, low = as_pair(angle / (2 * arb.pi()))
    return high - round(high), low


def _gibbs_vector(exact: ExactCurve, u: list[Any]) -> list[Any]:
    """The Gibbs vector of the first step by Newton's iteration from float64."""
    inertia = [exact.tensor[(i + 1) % 3] + exact.tensor[(i + 2) % 3] for i in range(3)]
    half = [exact.height * x / 2 for x in exact.direction]
    for _ in range(MOST_CORRECTIONS):
        p0, p1, p2, p3, *_ = gibbs_newton(*(*u, *half, *exact.direction, *inertia, exact.contact))
        found = [(x / p0).mid() for x in (p1, p2, p3)]
        moved = max(abs(float(x - y)) for x, y in zip(found, u, strict=True))
        u = found
        if moved <= SETTLED * max(abs(float(x)) for x in u):
            return u
    raise BadInput("the step is at the fold of its branch; take a shorter time step")


def _across(x: list[Any], y: list[Any]) -> list[Any]:
    """y × x."""
    return [y[(i + 1) % 3] * x[(i + 2) % 3] - y[(i + 2) % 3] * x[(i + 1) % 3] for i in range(3)]


def _dot(x: list[Any], y: list[Any]) -> Any:
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]
