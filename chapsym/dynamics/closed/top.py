"""The Moser-Veselov discrete Euler top in closed form: each step adds the same increment to Jacobi's u.

This holds for D = 0 and any 𝒦 (5.15-euler).  It also holds for D > 0 and vertical momentum 𝒦 = hγ if two J are equal:
then k = 0, the curve is a circle, and (5.15) as corrected does not depend on ū.  For three different J and D > 0 the
increment varies.  The increment over the period is the rotation number; in double-double it suffices for 10¹⁴ steps and
more.

The attitude: for γ along 𝒦 and b = γ × Λ⁻¹γ, R b/|b| is normal to 𝒦, which is fixed in space, and rotates about it.
Along the continuous motion the angle of this rotation is ∫⟨b,Λ⁻¹b⟩/|b|² dt = cu + P(u), P periodic (lemma
`top-precession`); the discrete top differs by a twist that is the same at each step (lemma `top-commutes`).  So the
angle after k steps is kΨ + P(u_k) - P(u₀), and one step of the map gives Ψ.  For two equal J nothing depends on u and
P = 0, also for vertical momentum with D > 0.

`exact_top` is an exact discretisation by a modified momentum: a change of |𝒦| makes the increment of the discrete top
equal to that of the continuous motion, and the constant twist is corrected on output.  A ball with vertical momentum is
such a top, with the mass tensor J + D/2 (lemma `vertical-top`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Self

import numpy as np
from numpy.typing import ArrayLike

from chapsym.generated import curve_increment, precession_parts, turn
from chapsym.numbers import Enclosure, is_a

from .. import kernels
from ..attitudes import first_attitudes
from ..ball import Ball, Floats, batch, in_principal_axes, inertia_of, is_followed, numbers, unit_vertical
from ..errors import BadInput, Status, StepNotTaken
from ..loops.vectors import cross, dot
from ..map import step_numbers, step_of_run
from ..results import Trajectory, finished, of_balls
from ..shown import Brief
from . import turns
from .elliptic import Curve, across, height_of, increment
from .vertical import step_vertical

if TYPE_CHECKING:
    from flint import arb

#: Working bits of a step: moments may be equal to 1e-15, and Λl - 1 may be as small as SMALLEST_TURN².
BITS = 512
#: A direction of 𝒦 that moves by less than this while the body turns by 1 radian is left to `trajectory`.
SMALLEST_TURN = 1e-40
#: The largest distance of the step of the map from the point of the curve; a larger one means another branch.
AGREEMENT = 1e-9
#: The first and the largest number of terms of the series of P, which is doubled until the last terms are rounding.
FEWEST, MOST = 16, 4096
ROUNDING = 2.0**-52
#: The largest |𝒦 - hγ|, relative to the largest component: the rounding of hγ.
VERTICAL = 2.0**-52
#: The largest relative deviation of a momentum from the vertical in `exact_top` of a ball with D > 0.
NEARLY_VERTICAL = 1e-12
#: Nodes of Gauss' quadrature for the twist: 24 give all digits for every step below the fold.
NODES = 32


@dataclass(frozen=True, eq=False, repr=False)
class TopMotion(Brief):
    """The motion of one Moser-Veselov top, or of a ball with vertical momentum and two equal J.

    `TopMotion.free` and `TopMotion.vertical` make it.

    Attributes
    ----------
    curve : Curve
        The curve of 𝒦/|𝒦| (of γ if 𝒦 = hγ).
    size : float
        The factor from its points to 𝒦, in kg m².
    start : float
        u at step 0.
    direction : numpy.ndarray
        The given point at step 0.
    turns : tuple of float
        The signed increment of u over the period 4K(k), as a pair: `rotation_number` and its rest.
    exact : ExactCurve
        The same motion in Arb's numbers.

    References
    ----------
    Equation (5.7) of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> motion = chapsym.TopMotion.free(chapsym.Ball((1, 2, 4), 0), (0.1, 0.2, 0.3))
    >>> round(motion.rotation_number, 12), motion.momenta([0, 10**9])[1].round(6).tolist()
    (-0.007241633201, [0.200138, -0.049305, 0.312272])
    """

    curve: Curve
    size: float
    start: float
    direction: Floats
    turns: tuple[float, float]
    exact: ExactCurve

    @classmethod
    @np.errstate(under="ignore")
    def free(cls, ball: Ball, momentum: ArrayLike) -> Self:
        """The top with D = 0.

        Parameters
        ----------
        ball : Ball
            One ball with D = 0.
        momentum : array_like
            𝒦, (3,), in kg m².

        Returns
        -------
        TopMotion

        Raises
        ------
        BadInput
            For D > 0, for a batch, and if 𝒦 is constant in the body (`is_steady`) or on a separatrix.
        StepNotTaken
            As `step_vertical` does.
        """
        K = numbers(momentum, "momentum", 3)
        _one(ball, K)
        if float(ball.D) != 0.0:
            raise BadInput("a ball with D > 0 is no free top")
        if (largest := float(np.abs(K).max())) == 0.0:
            raise BadInput("the momentum must not vanish: a ball at rest stays where it is")
        exponent = int(np.frexp(largest)[1])
        scaled = np.ldexp(K, -exponent)
        length = float(np.sqrt(scaled @ scaled))
        return cls._through(ball, float(np.ldexp(length, exponent)), scaled / length, K)

    @classmethod
    def vertical(cls, ball: Ball, height: float, gamma: ArrayLike) -> Self:
        """The ball with 𝒦 = hγ, if D = 0 or two J are equal.

        Parameters
        ----------
        ball : Ball
            One ball.
        height : float
            h in kg m².
        gamma : array_like
            γ, (3,); it is divided by its length.

        Returns
        -------
        TopMotion

        Raises
        ------
        BadInput
            For other balls, and as `free` does.
        StepNotTaken
            As `step_vertical` does.
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
    def _through(cls, ball: Ball, size: float, axis: Floats, momentum: Floats | None) -> Self:
        """The motion from a direction; momentum: the 𝒦 that defines it exactly, or None if it is exact."""
        unit = axis / np.sqrt(axis @ axis)
        if not moves(ball.mass_tensor, ball.D, unit):
            raise BadInput("the map fixes this direction of the momentum, or nearly so; it has no curve")
        curve = Curve.through(ball, unit)
        if curve.complement == 0.0:
            raise BadInput("on the separatrix the period is infinite; run `trajectory`")
        start = float(curve.argument(unit))
        step = step_vertical(ball, size, unit)  # raises if there is no step
        half = float(increment(curve, size, start)) / 2.0
        if np.abs(curve.point(start + 2.0 * half) - step.gamma).max() > AGREEMENT:
            raise BadInput("the step of the map is not on the branch of the increment; take a shorter time step")
        with Enclosure(BITS).working():
            exact = ExactCurve.of(curve, axis, momentum, size, 2.0 * half, step.rotation)
            found = as_pair(exact.increment / (4 * exact.quarter))
            curve = exact.nearest()
        return cls(curve, size, float(exact.start.mid()), axis, found, exact)

    @property
    def rotation_number(self) -> float:
        """The increment of a step over the period: turns on the curve per step, with the sign of du."""
        return self.turns[0]

    def phase(self, index: ArrayLike) -> Floats:
        """u at the step numbers `index`, (frames,), in [start - 2K, start + 2K]."""
        high, low = self.turns
        part = turns.fraction(np.asarray(high), np.asarray(low), step_numbers(index))
        return self.start + self.curve.period * part

    def directions(self, index: ArrayLike) -> Floats:
        """𝒦/|𝒦| (γ if 𝒦 = hγ) at the step numbers, (frames, 3)."""
        points = self.curve.point(self.phase(index))
        points[np.asarray(index) == 0] = self.direction
        return points

    def momenta(self, index: ArrayLike) -> Floats:
        """𝒦 at the step numbers in kg m², (frames, 3)."""
        return self.size * self.directions(index)

    @cached_property
    def precession(self) -> tuple[tuple[float, float], Floats]:
        """Ψ/(2π) as a pair, between -1/2 and 1/2, and P(u) = Σ series_j sin(jπu/K), j = 1, 2, ...

        Returns
        -------
        (float, float), numpy.ndarray
            The pair, and the series of P.

        Raises
        ------
        BadInput
            If the top is so near to the separatrix that the series has too many terms.
        """
        with Enclosure(BITS).working():
            mean = _mean(self.exact)
        return mean, _series(self)

    def rotations(self, index: ArrayLike) -> Floats:
        """Unit quaternions Q with R_k = R₀Q_k at the step numbers, (frames, 4), scalar part ≥ 0."""
        index = step_numbers(index)
        (high, low), _ = self.precession
        angle = 2.0 * np.pi * turns.fraction(np.asarray(high), np.asarray(low), index)
        angle = angle + self._wave(self.phase(index)) - self._wave(np.asarray(self.start))
        here = self.directions(index)
        first = self.direction / np.sqrt(self.direction @ self.direction)
        # The least rotation from the present direction to the first one, then a rotation about the first one.
        middle = first + here
        length = np.sqrt((middle * middle).sum(axis=-1, keepdims=True))
        least = np.concatenate([(middle @ first)[:, np.newaxis], np.cross(here, first)], axis=-1) / length
        tensor, moments, _ = _scaled(self)
        before = across(tensor, moments, first)
        after = kernels.rotate(least, across(tensor, moments, here))
        rest = angle - np.arctan2(np.cross(before, after) @ first, after @ before)
        about = np.concatenate([np.cos(rest / 2.0)[:, np.newaxis], np.sin(rest / 2.0)[:, np.newaxis] * first], axis=-1)
        whole = kernels.compose(about, least)
        whole *= np.where(whole[:, :1] < 0.0, -1.0, 1.0) / np.sqrt((whole * whole).sum(axis=-1, keepdims=True))
        whole[index == 0] = [1.0, 0.0, 0.0, 0.0]
        return whole

    def _wave(self, u: Floats) -> Floats:
        """P(u) by Clenshaw's recurrence."""
        x = 4.0 * np.pi * u / self.curve.period
        twice, b, c = 2.0 * np.cos(x), np.zeros_like(x), np.zeros_like(x)
        for a in self.precession[1][::-1]:
            b, c = a + twice * b - c, b
        return np.asarray(b * np.sin(x))


def moves(tensor: Floats, contact: Floats, direction: Floats) -> np.ndarray:
    """Whether a direction of 𝒦 moves in the body by more than SMALLEST_TURN, (...)."""
    with np.errstate(all="ignore"):  # an overflow moves
        J, moments, _ = _in_units(tensor, inertia_of(tensor) + contact[..., np.newaxis])
        return np.asarray(np.abs(across(J, moments, direction)).max(axis=-1) > SMALLEST_TURN)


def _in_units(tensor: Floats, moments: Floats) -> tuple[Floats, Floats, np.ndarray]:
    """J and Λ in units of 2^exponent, so that the largest Λ is about 1 and squares of γ × Λ⁻¹γ stay in range."""
    exponent = np.frexp(moments.max(axis=-1))[1]
    return np.ldexp(tensor, -exponent[..., np.newaxis]), np.ldexp(moments, -exponent[..., np.newaxis]), exponent


def _one(ball: Ball, vector: Floats) -> None:
    if in_principal_axes(ball).D.shape or ball.mass_tensor.shape != (3,) or vector.shape != (3,):
        raise BadInput("this motion is of one ball, one momentum and one gamma, not of a batch")


@dataclass(frozen=True, eq=False)
class ExactCurve:
    """A motion in Arb's numbers; 𝒦 and the mass tensor are taken as exact.

    moments: Λ in the order of the curve; direction: the unit vector of 𝒦, (3,); gibbs: the Gibbs vector of the first
    step; after: the next direction.  level: l; rate: V with its sign; k2: k²; quarter: K(k).
    start: u at the direction; increment: the signed increment of u.
    """

    curve: Curve
    moments: list[arb]
    direction: list[arb]
    gibbs: list[arb]
    after: list[arb]
    level: arb
    rate: arb
    k2: arb
    quarter: arb
    start: arb
    increment: arb

    @classmethod
    def of(
        cls, curve: Curve, axis: Floats, momentum: Floats | None, size: float, near: float, rotation: Floats
    ) -> Self:
        """The motion by the increment and the rotation of the first step in float64: Gibbs vector by Newton, then u."""
        from flint import acb, arb

        from ..levels.proved_root import refined

        tensor, contact = [arb(float(x)) for x in curve.ball.mass_tensor], arb(float(curve.ball.D))
        moments = [tensor[(i + 1) % 3] + tensor[(i + 2) % 3] + contact for i in curve.axes]
        vector = [arb(float(x)) for x in (axis if momentum is None else momentum)]
        length = sum((x * x for x in vector), arb(0)).sqrt()
        direction = [x / length for x in vector]
        height = arb(size) if momentum is None else length
        level = sum((direction[i] ** 2 / m for i, m in zip(curve.axes, moments, strict=True)), arb(0))
        k2, square, *_ = curve_increment(*(*moments, level))
        k2 = k2 if curve.modulus > 0.0 else arb(0)
        if not k2 < 1:
            raise BadInput("the motion is on the other side of the separatrix by a rounding; run `trajectory`")
        known, K = tuple(arb(float(x)) for x in rotation), tuple(height * x for x in direction)
        if (q := refined(known, K, tuple(direction), tuple(tensor), (contact,))) is None:
            raise BadInput("the step is at the fold of its branch; take a shorter time step")
        gibbs = [(x / q[0]).mid() for x in q[1:]]
        after = [x + y for x, y in zip(direction, turn(arb(1), *gibbs, *direction), strict=True)]
        quarter = acb(k2).elliptic_k().real
        start, end = (acb.elliptic_f(acb(amplitude(curve, moments, v)), acb(k2)).real for v in (direction, after))
        whole = round((near - float(end - start)) / float(4 * quarter))
        rate = square.sqrt() * (1 if curve.rate > 0.0 else -1)
        increment = end - start + 4 * quarter * whole
        return cls(curve, moments, direction, gibbs, after, level, rate, k2, quarter, start, increment)

    def nearest(self) -> Curve:
        """The curve in floats, rounded from these: near the separatrix a rounded direction would have another k'."""
        La, Lb, Lc = self.moments
        upper, lower = abs(1 - Lc * self.level), abs(La * self.level - 1)
        bc, ac = abs(Lb - Lc), abs(La - Lc)
        Ca, Cb, Cc = (float(x.sqrt()) for x in (La * upper / ac, Lb * upper / bc, Lc * lower / ac))
        return replace(
            self.curve, amplitudes=(Ca, Cb, math.copysign(Cc, self.curve.amplitudes[2])), rate=float(self.rate),
            modulus=float(self.k2.sqrt()), complement=float((1 - self.k2).sqrt()), level=float(self.level),
        )  # fmt: skip


def amplitude(curve: Curve, moments: list[arb], direction: list[arb]) -> arb:
    """The amplitude φ = am u of a point of the curve, with C_b/C_a of (5.8)."""
    from flint import arb

    first, second, third = moments
    a, b, _ = curve.axes
    stretch = (second * (first - third) / (first * (second - third))).sqrt()
    return arb.atan2(direction[b], stretch * direction[a])


def as_pair(value: arb) -> tuple[float, float]:
    """An Arb number as the nearest pair of floats."""
    from flint import arb

    high = float(value.mid())
    return high, float((value.mid() - arb(high)).mid())


def _scaled(motion: TopMotion) -> tuple[Floats, Floats, float]:
    """J, Λ and V in units in which the largest Λ is about 1."""
    ball = motion.curve.ball
    tensor, moments, exponent = _in_units(ball.mass_tensor, ball.inertia + ball.D)
    return tensor, moments, float(np.ldexp(motion.curve.rate, exponent))


def _series(motion: TopMotion) -> Floats:
    """The sines of P from the rate at equal steps of u over half the period."""
    if (curve := motion.curve).modulus == 0.0:
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


def _mean(exact: ExactCurve) -> tuple[float, float]:
    """Ψ/(2π): the angle of the first step, less P(u₁) - P(u₀) by Legendre's integrals of the third kind."""
    from flint import acb, arb

    d, after = exact.direction, exact.after
    moments = dict(zip(exact.curve.axes, exact.moments, strict=True))
    before, moved = ([*cross(v, [x / moments[i] for i, x in enumerate(v)])] for v in (d, after))
    there = [x + y for x, y in zip(moved, turn(arb(-1), *exact.gibbs, *moved), strict=True)]  # the inverse rotation
    angle = arb.atan2(dot(d, cross(before, there)), dot(before, there))
    if exact.curve.modulus > 0.0:
        p0, p1, n0, n1 = precession_parts(*(*exact.moments, exact.level))
        n, factor = -p1 / p0, (n0 / p0 - n1 / p1) / exact.rate
        ends = [amplitude(exact.curve, exact.moments, v) for v in (d, after)]
        turned = ends[1] - ends[0]
        turned -= 2 * arb.pi() * round(float(turned / (2 * arb.pi())))
        third = [acb.elliptic_pi_inc(acb(n), acb(x), acb(exact.k2)).real for x in (ends[0], ends[0] + turned)]
        whole = acb.elliptic_pi(acb(n), acb(exact.k2)).real
        angle -= factor * (third[1] - third[0] - exact.increment * whole / exact.quarter)
    high, low = as_pair(angle / (2 * arb.pi()))
    return high - round(high), low


def is_top(ball: Ball, momentum: ArrayLike, gamma: ArrayLike) -> np.ndarray:
    """Which states `top_frames` supports: the free top, and vertical 𝒦 on a ball with two equal J.

    D = 0, or 𝒦 = hγ up to rounding and two J equal; in both cases 𝒦 must move in the body (otherwise see `is_steady`).
    Two J that differ by an ulp are different.  A 𝒦 that differs from hγ by its rounding is taken as vertical, which
    changes the start by a rounding, as a run of the map does, too.

    Parameters
    ----------
    ball : Ball
        One ball or a batch.
    momentum, gamma : array_like
        𝒦 (kg m²) and γ, (..., 3); they broadcast with the balls.

    Returns
    -------
    numpy.ndarray
        Of bool, (...).

    Raises
    ------
    BadInput
        As `step` does.

    Examples
    --------
    >>> import chapsym
    >>> chapsym.is_top(chapsym.Ball((1, 2, 4), [0, 3]), (0.1, 0.2, 0.3), (0, 0, 1)).tolist()
    [True, False]
    """
    shape, (K, g, J, D) = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
    return _is_top(K, g, J, D).reshape(shape)


def _is_top(K: Floats, g: Floats, J: Floats, D: Floats) -> np.ndarray:
    size = np.abs(K).max(axis=-1)
    with np.errstate(all="ignore"):
        scaled = K / size[:, np.newaxis]
        height = (scaled * g).sum(axis=-1)
        upright = np.abs(scaled - height[:, np.newaxis] * g).max(axis=-1) <= VERTICAL
    pairs = sum((J[:, i] == J[:, (i + 1) % 3]).astype(int) for i in range(3))
    return moves(J, D, scaled) & ((D == 0.0) | (upright & (pairs == 1)))


@np.errstate(under="ignore")
def top_frames(
    ball: Ball, momentum: ArrayLike, gamma: ArrayLike, index: ArrayLike, *, attitude: bool | ArrayLike = False,
    time_step: float | None = None,
) -> Trajectory:  # fmt: skip
    """The states of `trajectory` at the step numbers `index`, in closed form, for states with `is_top`.

    𝒦 follows from Jacobi's functions of u₀ + k δ (5.7, 5.15-euler), γ and the attitude from the precession about 𝒦
    (lemmas `top-precession`, `top-commutes`), with k δ and k Ψ in double-double.  Cost and error do not depend on the
    step numbers, for k below 10¹⁴.  The error is some ulps; near the separatrix it grows with the period, and for γ and
    the attitude up to 1/k' ulps, since |b| is at most k' while the top is near its unstable axis.  γ is divided by its
    length, as at the higher precisions.  The sign of the quaternion of an attitude is such that the rotation since
    frame 0 has a positive scalar part.

    Parameters
    ----------
    ball : Ball
        One ball or a batch.
    momentum, gamma : array_like
        𝒦 (kg m²) and γ, (..., 3), as for `trajectory`.
    index : array_like
        Ascending whole numbers from 0 on, (frames,).
    attitude, time_step
        As for `trajectory`.

    Returns
    -------
    Trajectory
        As of `trajectory`, without the contact point; in a batch `status` shows which balls are beyond the fold.

    Raises
    ------
    BadInput
        As `trajectory` does, and for a ball that is no such top, is on a separatrix or too near to one.
    StepNotTaken
        For one ball beyond the fold.

    References
    ----------
    Equation (5.7) of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> run = chapsym.top_frames(chapsym.Ball((1, 2, 4), 0), (0.1, 0.2, 0.3), (0, 0, 1), [0, 10**9])
    >>> run.momentum[1].round(6).tolist()
    [0.200138, -0.049305, 0.312272]
    """
    numbered = step_numbers(index)
    time_step = step_of_run(time_step, int(numbered[-1]))
    shape, (K, g, J, D) = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
    if not _is_top(K, g, J, D).all():
        raise BadInput(
            "this is no top whose frames are known at once: D must be 0, or two J equal and momentum along gamma, "
            "and it must not be steady (`is_steady`); run `trajectory`"
        )
    follow = is_followed(attitude)
    balls, frames = len(D), len(numbered)
    momenta, verticals = np.full((2, balls, frames, 3), np.nan)
    turned = np.full((balls, frames, 4), np.nan)
    status, reach = np.zeros(balls, dtype=np.int64), np.ones(balls)
    momenta[:, numbered == 0], verticals[:, numbered == 0] = K[:, np.newaxis], g[:, np.newaxis]
    turned[:, numbered == 0] = [1.0, 0.0, 0.0, 0.0]
    later = numbered > 0
    for i in range(balls):
        try:
            motion = motion_of(Ball(J[i], D[i]), K[i], g[i])
        except StepNotTaken as stopped:
            status[i], reach[i] = stopped.status, stopped.reach
            continue
        momenta[i, later] = motion.momenta(numbered)[later]
        if follow or D[i] == 0.0:
            turned[i, later] = motion.rotations(numbered)[later]
        directions = kernels.transport(turned[i], g[i]) if D[i] == 0.0 else motion.directions(numbered)
        verticals[i, later] = directions[later]
    attitudes = None
    if follow:
        first = first_attitudes(attitude, g, shape)[:, np.newaxis]
        taken = np.isfinite(turned).all(axis=-1)
        attitudes = np.full_like(turned, np.nan)
        attitudes[taken] = kernels.compose(np.broadcast_to(first, turned.shape)[taken], turned[taken])
    arrays = momenta, verticals, attitudes, None, np.where(status == Status.TAKEN, numbered[-1], 0), status
    return finished(of_balls(shape, ball, numbered, *arrays, time_step=time_step), reach)


def motion_of(ball: Ball, K: Floats, g: Floats) -> TopMotion:
    """The motion of one ball that `is_top`; raises as `TopMotion` does."""
    if float(ball.D) == 0.0:
        return TopMotion.free(ball, K)
    return TopMotion.vertical(ball, float(K @ g) / float(np.sqrt(g @ g)), g)


@dataclass(frozen=True, eq=False, repr=False)
class ExactTop(Brief):
    """A top with D = 0 whose discrete motion is the continuous motion of `origin`, sampled once per step.

    Attributes
    ----------
    ball : Ball
        The top, with the mass tensor J + D/2.
    momentum : numpy.ndarray
        Its 𝒦 in kg m², (3,), along that of `origin`.
    twist : float
        The rotation about 𝒦 that remains to be added to each step, in radians.
    origin : Ball
        The ball.
    size : float
        The component of its εK along 𝒦, in kg m².

    Examples
    --------
    >>> import chapsym
    >>> top = chapsym.exact_top(chapsym.Ball((1, 2, 4), 3), (0.06, 0, 0.08), (0.6, 0, 0.8))
    >>> top.ball.mass_tensor.tolist(), top.size
    ([2.5, 3.5, 5.5], 0.1)
    """

    ball: Ball
    momentum: Floats
    twist: float
    origin: Ball
    size: float

    def restore(self, run: Trajectory) -> Trajectory:
        """The continuous motion of `origin`, εK, γ and the attitude, from a trajectory of `ball` with `momentum`.

        Step k is rotated by k `twist` about 𝒦, so that no error accumulates.

        Parameters
        ----------
        run : Trajectory
            A run of `ball` with `momentum`, from the γ for which this top was made.

        Returns
        -------
        Trajectory
            Without the contact point, whose discrete steps are chords.  The order is 0: the steps are no composition of
            the map.

        Raises
        ------
        BadInput
            For a run of another ball, momentum or order, or from a γ that this top was not made for.

        Examples
        --------
        >>> import chapsym
        >>> top = chapsym.exact_top(chapsym.Ball((1, 2, 4), 3), (0.06, 0, 0.08), (0.6, 0, 0.8))
        >>> run = chapsym.trajectory(top.ball, top.momentum, (0.6, 0, 0.8), 100)
        >>> top.restore(run).order
        0
        """
        momentum = run.momentum[0] if is_a(run, Trajectory) and run.momentum.ndim == 2 else None
        if momentum is None or run.ball is not self.ball or not (momentum == self.momentum).all() or run.order != 2:
            raise BadInput(
                "this is no trajectory of the exact top: run `trajectory(top.ball, top.momentum, gamma, ...)`"
            )
        scaled = np.ldexp(run.momentum, -np.frexp(np.abs(momentum).max())[1])  # squares stay in range
        size = np.sqrt((scaled**2).sum(axis=-1, keepdims=True))
        off = np.abs(np.cross(scaled[0], run.gamma[0])).max()
        if float(self.origin.D) > 0.0 and off > NEARLY_VERTICAL * size[0, 0]:
            raise BadInput("this run does not start at the gamma along the momentum, for which the exact top was made")
        axis = np.sign(self.size) * scaled / size  # γ itself if D > 0, though 𝒦 may point downwards
        half = run.index * (self.twist / 2)
        turned = np.concatenate([np.cos(half)[:, np.newaxis], np.sin(half)[:, np.newaxis] * axis], axis=-1)
        attitude = None if run.attitude is None else kernels.compose(run.attitude, turned)
        gamma = kernels.transport(turned, run.gamma)
        return Trajectory(
            self.origin, run.index, self.size * axis, gamma, attitude, None, run.taken, run.status, run.time_step, 0
        )


@np.errstate(all="ignore")  # an overflow is refused
def exact_top(ball: Ball, momentum: ArrayLike, gamma: ArrayLike) -> ExactTop:
    """The top whose discrete motion from γ is the continuous motion of `ball` with the momentum εK.

    `trajectory(top.ball, top.momentum, gamma, steps)` costs the same as the map, and `top.restore` of this trajectory
    has only rounding errors, for every ε up to the fold of the top's branch.

    Parameters
    ----------
    ball : Ball
        One ball.
    momentum : array_like
        εK in kg m², (3,), for one step; for D > 0 it must be along γ.
    gamma : array_like
        γ, unit, (3,).

    Returns
    -------
    ExactTop

    Raises
    ------
    BadInput
        For a batch, for D > 0 with a momentum that is not vertical, and for a step beyond the fold.

    Examples
    --------
    >>> import chapsym
    >>> ball, gamma = chapsym.Ball((1, 2, 4), 3), (0.6, 0, 0.8)
    >>> for steps in (10, 100):
    ...     top = chapsym.exact_top(ball, (6 / steps, 0, 8 / steps), gamma)
    ...     print(top.restore(chapsym.trajectory(top.ball, top.momentum, gamma, steps)).gamma[-1].round(9).tolist())
    [0.467253142, -0.434625512, 0.769918935]
    [0.467253142, -0.434625512, 0.769918935]
    """
    K, g = numbers(momentum, "momentum", 3), unit_vertical(gamma)
    if (in_principal_axes(ball).D.shape, ball.mass_tensor.shape, K.shape, g.shape) != ((), (3,), (3,), (3,)):
        raise BadInput("an exact top is made for one ball, one momentum and one gamma")
    if (largest := float(np.abs(K).max())) == 0.0:
        raise BadInput("the momentum must not vanish: a ball at rest stays where it is")
    contact, unit = float(ball.D), K / largest
    size = largest * float(np.sqrt(unit @ unit))
    if contact > 0.0:
        size = float(K @ g)
        if np.abs(K - size * g).max() > NEARLY_VERTICAL * abs(size):
            raise BadInput("for D > 0 only a motion with vertical momentum is a top's: momentum must be along gamma")
    axis = g if contact > 0.0 else K / size
    top = Ball(ball.mass_tensor + contact / 2, 0.0)
    # In units in which the largest moment is about 1, products of three moments stay in range.
    exponent = int(np.frexp(top.inertia.max())[1])
    moments = np.ldexp(ball.inertia, -exponent)
    # 1 - Dl as a sum of positive terms.
    free = moments / (moments + np.ldexp(contact, -exponent))
    speed = float(np.ldexp(size, -exponent) / (axis * axis * free).sum())
    if not np.isfinite(speed) or speed == 0.0:
        raise BadInput("float64 cannot hold this top: its moments of inertia and its momentum are too far apart")
    unit_top = Ball(np.ldexp(top.mass_tensor, -exponent), 0.0)
    fixed = not across(unit_top.mass_tensor, unit_top.inertia, axis).any()
    tau, twist = (_fixed if fixed else _moving)(unit_top, axis, speed)
    return ExactTop(top, np.ldexp(tau, exponent) * axis, twist, ball, size)


def _fixed(top: Ball, axis: Floats, speed: float) -> tuple[float, float]:
    """A rotation about a principal axis: 𝒦 = Λ sin θ for the rotation angle θ = speed/Λ."""
    level = float((axis * axis / top.inertia).sum())
    if abs(speed * level) >= np.pi / 2:
        raise BadInput("a step of more than 90° about this axis is beyond the branch of the top; take a shorter one")
    return float(np.sin(speed * level) / level), 0.0


def _moving(top: Ball, axis: Floats, speed: float) -> tuple[float, float]:
    """The momentum of the top with the increment of the continuous motion, and the twist that is left."""
    curve = Curve.through(top, axis)
    advance = curve.rate * speed
    tau, slope = (float(x) for x in height_of(curve, advance / 2))
    start = float(curve.argument(axis))
    ahead = curve.point(start + advance)
    try:
        step = step_vertical(top, tau, axis)
    except StepNotTaken:
        step = None
    far = abs(advance) > curve.period / 2  # the heights of half steps recur after half a period, beyond the fold
    if step is None or far or not slope * curve.rate > 0.0 or not np.abs(step.gamma - ahead).max() <= AGREEMENT:
        raise BadInput("the continuous motion of this step is beyond the branch of the top; take a shorter time step")
    before, there = (across(top.mass_tensor, top.inertia, v) for v in (axis, step.gamma))
    after = kernels.rotate(step.rotation, there)
    discrete = np.arctan2(axis @ np.cross(before, after), before @ after)
    twist = _turn(curve, start, advance, speed) - float(discrete)
    return tau, float(np.remainder(twist + np.pi, 2 * np.pi) - np.pi)


def _turn(curve: Curve, start: float, advance: float, speed: float) -> float:
    """The angle about γ by which R(γ × Λ⁻¹γ) turns in one step: the integral of H⟨b,Λ⁻¹b⟩/|b|², b = γ × Λ⁻¹γ."""
    nodes, weights = np.polynomial.legendre.leggauss(NODES)
    top = curve.ball
    turned = across(top.mass_tensor, top.inertia, curve.point(start + advance * (nodes + 1) / 2))
    rates = (turned * turned / top.inertia).sum(axis=-1) / (turned * turned).sum(axis=-1)
    return speed * float(weights @ rates) / 2
