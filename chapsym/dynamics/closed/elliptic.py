"""The invariant curve of the reduced map in Jacobi's functions (5.7, 5.8), and the increment on it (5.15)."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import inf
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import is_a

from ..ball import Ball, Floats, common_shape, in_principal_axes, numbers, unit_vertical
from ..errors import BadInput
from ..shown import Brief

#: Steps of the arithmetic-geometric mean: each doubles the digits, from k' = 1e-300 on.
MOST_MEANS = 20
#: Below this k' Gauss' descent loses digits, and the sums over pulses are short.
NEAR_SEPARATRIX = 0.5
#: Carlson's duplication stops where the three arguments agree to this: the error is its sixth power.
SPREAD = 2e-3


def _means(complement: float) -> tuple[list[float], list[float]]:
    """aₙ and cₙ = (aₙ₋₁ - bₙ₋₁)/2 of the arithmetic-geometric mean of 1 and k'."""
    a, b = 1.0, complement
    means, halves = [a], [0.0]
    while abs(a - b) > 2.0**-27 * a and len(means) < MOST_MEANS:
        a, b, c = (a + b) / 2.0, float(np.sqrt(a * b)), (a - b) / 2.0
        means.append(a)
        halves.append(c)
    # One more step, in which c is below an ulp: c²/(4a).
    means.append((a + b) / 2.0)
    halves.append((a - b) / 2.0)
    return means, halves


def quarter_period(complement: float) -> float:
    """K(k) = π/(2 AGM(1, k')); infinite for k' = 0."""
    if complement == 0.0:
        return float("inf")
    return float(np.pi / (2.0 * _means(complement)[0][-1]))


def jacobi(u: Floats, modulus: float, complement: float) -> tuple[Floats, Floats, Floats]:
    """sn, cn, dn of real u, shapes (...), with k = `modulus` and k' = `complement`; errors of a few ulps of 1."""
    quarter = quarter_period(complement)
    turns = np.zeros_like(u) if complement == 0.0 else np.round(u / (2.0 * quarter))
    reduced = u - 2.0 * quarter * turns if complement > 0.0 else u
    sn, cn, dn = (_descent if complement > NEAR_SEPARATRIX else _pulses)(reduced, modulus, complement)
    sign = np.where(turns % 2 == 0, 1.0, -1.0)
    return sign * sn, sign * cn, dn


def _descent(u: Floats, modulus: float, complement: float) -> tuple[Floats, Floats, Floats]:
    """Gauss' descent: φ = 2ⁿaₙu, then sin(2φₙ₋₁ - φₙ) = (cₙ/aₙ) sin φₙ back to φ₀ = am u."""
    means, halves = _means(complement)
    phi = np.ldexp(means[-1] * u, len(means) - 1)
    for a, c in zip(means[:0:-1], halves[:0:-1], strict=True):
        phi = (phi + np.arcsin(c / a * np.sin(phi))) / 2.0
    sn, cn = np.sin(phi), np.cos(phi)
    return sn, cn, np.sqrt(complement * complement + (modulus * cn) ** 2)


@np.errstate(under="ignore")
def _pulses(u: Floats, modulus: float, complement: float) -> tuple[Floats, Floats, Floats]:
    """Sums over the pulses at u = 2mK, the Fourier series turned by Poisson's formula: one pulse for k = 1.

    dn = s Σ sech s(u - 2mK), k cn = s Σ (-1)ᵐ sech s(u - 2mK), k sn = s Σ (-1)ᵐ tanh s(u - 2mK), s = π/(2K').
    """
    quarter = quarter_period(complement)
    scale = np.pi / (2.0 * quarter_period(modulus))
    most = 0 if complement == 0.0 else int(np.ceil(20.0 / (scale * quarter))) + 1
    sn, cn, dn = np.tanh(scale * u), *(2 * (1.0 / np.cosh(np.clip(scale * u, -700.0, 700.0)),))
    for m in range(1, most + 1):
        sign = -1.0 if m % 2 else 1.0
        for centre in (2.0 * m * quarter, -2.0 * m * quarter):
            pulse = 1.0 / np.cosh(np.clip(scale * (u - centre), -700.0, 700.0))
            cn, dn = cn + sign * pulse, dn + pulse
        # The tanh of m and -m together: sinh 2su / (cosh s(u-2mK) cosh s(u+2mK)), small for m > 0.
        far = 2.0 * scale * m * 2.0 * quarter
        sn = sn + sign * 2.0 * _far_pair(2.0 * scale * u, far)
    return scale / modulus * sn, scale / modulus * cn, scale * dn


def _far_pair(x: Floats, far: float) -> Floats:
    """sinh x/(cosh x + cosh f) for f ≥ 2|x|, by exponentials that do not overflow."""
    size = np.abs(x)
    ahead, behind = np.exp(size - far), np.exp(-size - far)
    return np.asarray(-np.sign(x) * ahead * np.expm1(-2.0 * size) / (1.0 + np.exp(-2.0 * far) + ahead + behind))


def argument(sn: Floats, cn: Floats, dn: Floats, quarter: float) -> Floats:
    """u in [-2K, 2K] from its three functions: sn·R_F(cn², dn², 1) (Carlson), reflected where cn < 0."""
    u = sn * carlson(cn * cn, dn * dn, np.ones_like(sn))
    return np.asarray(np.where(cn < 0.0, np.copysign(2.0 * quarter, sn) - u, u))


def carlson(x: Floats, y: Floats, z: Floats) -> Floats:
    """R_F(x, y, z) = ½∫₀^∞ dt/√((t+x)(t+y)(t+z)) for x, y, z ≥ 0, at most one of them 0 (Carlson 1995)."""
    for _ in range(200):
        mean = (x + y + z) / 3.0
        if (np.maximum(np.abs(x - mean), np.maximum(np.abs(y - mean), np.abs(z - mean))) <= SPREAD * mean).all():
            break
        root = np.sqrt(x * y) + np.sqrt(y * z) + np.sqrt(z * x)
        x, y, z = (x + root) / 4.0, (y + root) / 4.0, (z + root) / 4.0
    mean = (x + y + z) / 3.0
    a, b = 1.0 - x / mean, 1.0 - y / mean
    c = -a - b
    second, third = a * b - c * c, a * b * c
    series = 1.0 - second / 10.0 + third / 14.0 + second * second / 24.0 - 3.0 * second * third / 44.0
    return np.asarray(series / np.sqrt(mean))


#: The largest accepted distance from the curve of a γ for `argument`; near the separatrix roundings of a run grow 1/k'
#: times, and are accepted up to 1/k' = 10⁶: beyond, they lead from curve to curve, and to the other side of it.
ON_CURVE, NEAREST = 1e-9, 1e-6
MOST_CORRECTIONS = 60
#: The relative size of the last correction of the increment, since Newton's iteration squares it.
SETTLED = 1e-9


def _beyond_separatrix(ball: Ball, g: Floats, order: np.ndarray) -> float:
    """Λ_b l - 1, whose sign is the side of the separatrix: a difference, of the exact numbers that are given."""
    J, D = list(map(Fraction, ball.mass_tensor.tolist())), Fraction(float(ball.D))
    first, middle, last = order

    def part(i: int) -> Fraction:
        return Fraction(float(g[i])) ** 2 * abs(J[i] - J[middle]) / (sum(J, D) - J[i])

    try:
        return float(part(last) - part(first))
    except (ZeroDivisionError, OverflowError):  # which is refused
        return inf


@dataclass(frozen=True, eq=False, repr=False)
class Curve(Brief):
    """The level ⟨γ,Λ⁻¹γ⟩ = l on the sphere: γ = (C_a cn u, C_b sn u, C_c dn u) on the axes (a, b, c), for one ball.

    `Curve.through` makes it from a ball and a γ.

    Attributes
    ----------
    ball : Ball
        The ball.
    axes : tuple of int
        The components with cn, sn and dn: by decreasing Λ if l > 1/Λ_b, b the middle axis, else by increasing Λ.
    amplitudes : tuple of float
        C_a, C_b > 0 and C_c, whose sign selects the half of the sphere.
    modulus, complement : float
        k and k' = √(1 - k²); k' has full relative accuracy, also near the separatrix k = 1.
    level : float
        l.
    rate : float
        V of (5.13-V) with its sign, so that u' = V along γ' = γ × Λ⁻¹γ.
    inertia : tuple of float
        (Λ_a, Λ_b, Λ_c).
    gaps : tuple of float
        (Λ_b - Λ_c, Λ_a - Λ_c, Λ_a - Λ_b), computed from J, so that a large D does not cancel.
    slack : float
        F = 1 - Dl, as a sum of positive terms (lemma `stable-inverse`).

    References
    ----------
    Equations (5.7) and (5.8) of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> curve = chapsym.Curve.through(chapsym.Ball((1, 2, 4), 3), (0.6, 0, 0.8))
    >>> round(curve.period, 6), curve.point([0.0, 1.0]).round(6).tolist()
    (6.613503, [[0.6, 0.0, 0.8], [0.336949, 0.573255, 0.74689]])
    """

    ball: Ball
    axes: tuple[int, int, int]
    amplitudes: tuple[float, float, float]
    modulus: float
    complement: float
    level: float
    rate: float
    inertia: tuple[float, float, float]
    gaps: tuple[float, float, float]
    slack: float

    @classmethod
    def through(cls, ball: Ball, gamma: ArrayLike) -> Self:
        """The curve through a unit γ.

        Parameters
        ----------
        ball : Ball
            One ball.
        gamma : array_like
            γ, (3,).

        Returns
        -------
        Curve

        Raises
        ------
        BadInput
            For a batch of balls, for a γ that the map fixes, and for a curve beyond the range of float64.
        """
        in_principal_axes(ball)
        g = unit_vertical(gamma)
        if not ball.is_one or g.shape != (3,):
            raise BadInput("a curve is of one ball and one gamma, not of a batch")
        with np.errstate(all="ignore"):  # what overflows is refused
            curve = cls._found(ball, g)
        sizes = np.abs([*curve.amplitudes, curve.rate, curve.slack, curve.level])
        if not (np.isfinite([*sizes, curve.modulus, curve.complement]).all() and sizes.all()):
            raise BadInput("float64 cannot hold the curve through this gamma: the moments of inertia are too far apart")
        return curve

    @classmethod
    def _found(cls, ball: Ball, g: Floats) -> Self:
        moments, tensor = ball.inertia + ball.D, ball.mass_tensor
        order = np.argsort(tensor, kind="stable")  # the largest moment first
        if not across(tensor, moments, g).any():
            raise BadInput("the map fixes this gamma (a principal axis, or a ball with equal moments): it is no curve")
        side = _beyond_separatrix(ball, g, order)
        a, b, c = (int(i) for i in (order if side >= 0 else order[::-1]))
        La, Lb, Lc = (float(moments[i]) for i in (a, b, c))
        gaps = float(tensor[c] - tensor[b]), float(tensor[c] - tensor[a]), float(tensor[b] - tensor[a])
        bc, ac, ab = map(abs, gaps)
        # |1 - Λ_c l| and |Λ_a l - 1|: sums of terms of one sign.
        upper = g[a] ** 2 * ac / La + g[b] ** 2 * bc / Lb
        lower = g[b] ** 2 * ab / Lb + g[c] ** 2 * ac / Lc
        k2 = ab * upper / (bc * lower)
        complement = np.sqrt(ac * abs(side) / (bc * lower))
        amplitudes = (
            float(np.sqrt(La * upper / ac)),
            float(np.sqrt(Lb * upper / bc)),
            float(np.copysign(np.sqrt(Lc * lower / ac), g[c])),
        )
        parity = 1.0 if (b - a) % 3 == 1 else -1.0
        unit = int(np.frexp(max(La, Lb, Lc))[1])  # whose third power may be out of range
        ma, mb, mc = np.ldexp((La, Lb, Lc), -unit)
        size = np.ldexp(np.sqrt(np.ldexp(bc, -unit) * lower / (ma * mb * mc)), -unit)
        rate = -parity * np.sign(gaps[1]) * np.sign(amplitudes[2]) * size
        level, slack = float((g * g / moments).sum()), float((g * g * ball.inertia / moments).sum())
        return cls(
            ball, (a, b, c), amplitudes, float(min(np.sqrt(k2), 1.0)), float(complement), level, float(rate),
            (La, Lb, Lc), gaps, slack,
        )  # fmt: skip

    @property
    def mu(self) -> float:
        """μ = (1 - Λ_c l)/(Λ_b - Λ_c) of (5.14-Pi1)."""
        return self.amplitudes[1] ** 2 / self.inertia[1]

    @property
    def period(self) -> float:
        """The period 4K(k) of γ in u; infinite on the separatrix."""
        return 4.0 * quarter_period(self.complement)

    @np.errstate(under="ignore")
    def point(self, u: ArrayLike) -> Floats:
        """γ(u), shape (..., 3), for real u, (...): each period costs about 3e-15 of accuracy."""
        sn, cn, dn = jacobi(numbers(u, "u"), self.modulus, self.complement)
        gamma = np.empty((*sn.shape, 3))
        for axis, amplitude, value in zip(self.axes, self.amplitudes, (cn, sn, dn), strict=True):
            gamma[..., axis] = amplitude * value
        return gamma

    def argument(self, gamma: ArrayLike) -> Floats:
        """u in [-2K, 2K] with γ(u) = γ, for γ on the curve.

        An error of γ along the curve, divided by |dγ/du|, is an error of u.

        Parameters
        ----------
        gamma : array_like
            Shape (..., 3).

        Returns
        -------
        numpy.ndarray
            Shape (...).

        Raises
        ------
        BadInput
            For a γ off the curve.
        """
        g = unit_vertical(gamma)
        with np.errstate(all="ignore"):  # what overflows is off the curve
            cn, sn, dn = (g[..., axis] / size for axis, size in zip(self.axes, self.amplitudes, strict=True))
            u = argument(sn, cn, np.abs(dn), quarter_period(self.complement))
        if g.size and np.abs(self.point(np.nan_to_num(u)) - g).max() * max(self.complement, NEAREST) > ON_CURVE:
            raise BadInput("gamma is not on this curve: its ⟨γ,Λ⁻¹γ⟩ or its half of the sphere is another one")
        return u


def across(tensor: Floats, moments: Floats, g: Floats) -> Floats:
    """γ × Λ⁻¹γ, (..., 3), by Λ₂ - Λ₃ = J₃ - J₂, ..., in which a large D does not cancel."""
    b, c = np.roll(np.arange(3), -1), np.roll(np.arange(3), -2)
    gaps = tensor[..., c] - tensor[..., b]
    return np.asarray(g[..., b] * g[..., c] * (gaps / moments[..., b] / moments[..., c]))


def _parts(curve: Curve, sn: Floats, cn: Floats, dn: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """w = sn cn dn, λ = l - μ sn², G/V² = 1 + α sn² - β sn⁴ (5.14), and d(G/V²)/dδu, of the half increment."""
    La, Lb, Lc = curve.inertia
    bc, ac, _ = curve.gaps
    Ca, _, Cc = curve.amplitudes
    level, y, w = curve.level, sn * sn, sn * cn * dn
    lower = Cc * Cc * ac / Lc  # Λ_a l - 1
    alpha = (2.0 * La * (Lc * level) - (La + Lc - Lb)) / (bc * lower)
    beta = (Lc / bc) * (Ca * Ca * (ac / bc)) / lower
    return w, level - curve.mu * y, 1.0 + y * (alpha - beta * y), 2.0 * w * (alpha - 2.0 * beta * y)


def height_of(curve: Curve, half: ArrayLike, mean: ArrayLike = 0.0) -> tuple[Floats, Floats]:
    """The h of the step from γ(ū - δu) to γ(ū + δu), and its derivative in δu at a fixed u = ū - δu.

    (5.15) as corrected, h G𝒟 = 2Vw(𝒟 - D(l - μ sn²δu)), solved for h.  half: δu; mean: ū; shapes (...).
    """
    delta, centre = numbers(half, "half"), numbers(mean, "mean")
    sn, cn, dn = jacobi(delta, curve.modulus, curve.complement)
    s, c, d = jacobi(centre, curve.modulus, curve.complement)
    w, lam, shape, shape_rate = _parts(curve, sn, cn, dn)
    k2, y = curve.modulus**2, sn * sn
    scale = 1.0 - k2 * s * s * y
    contact = float(curve.ball.D)
    # 1 - Dλ/𝒟 without the 1 - Dl that cancels for D ≫ J.
    rolled = (curve.slack + y * (contact * curve.mu - k2 * s * s)) / scale
    height = 2.0 * w * rolled / (curve.rate * shape)
    # d/dδu of w, λ and 𝒟; ū moves with δu.
    w_rate = cn * cn * dn * dn - y * (dn * dn + k2 * cn * cn)
    lam_rate = -2.0 * curve.mu * w
    scale_rate = -2.0 * k2 * s * (c * d * y + s * w)
    rolled_rate = -contact * (lam_rate - lam * scale_rate / scale) / scale
    slope = 2.0 / (curve.rate * shape) * (w_rate * rolled + w * rolled_rate - w * rolled * shape_rate / shape)
    return height, slope


@np.errstate(all="ignore")  # what overflows is off the branch
def increment(curve: Curve, height: ArrayLike, u: ArrayLike) -> Floats:
    """The increment 2δu of the step u ↦ u + 2δu of G_h from γ(u), on the branch with δu = 0 at h = 0.

    Solves (5.15) as corrected for δu by Newton's iteration from δu = Vh/(2(1 - Dl)), the rate of the continuous ball.
    For D = 0 the increment does not depend on u (5.15-euler).

    Parameters
    ----------
    curve : Curve
        The curve of γ.
    height : array_like
        h in kg m², (...).
    u : array_like
        The argument of each γ, (...).

    Returns
    -------
    numpy.ndarray
        2δu, (...).

    Raises
    ------
    BadInput
        If the iteration leaves the branch, as beyond its fold; in a batch that entry is NaN.

    References
    ----------
    Equation (5.15) of Fedorov (2007), as corrected.

    Examples
    --------
    >>> import chapsym
    >>> curve = chapsym.Curve.through(chapsym.Ball((1, 2, 4), 3), (0.6, 0, 0.8))
    >>> chapsym.increment(curve, [0.1, 100.0], 0.0).round(8).tolist()
    [-0.00687438, nan]
    """
    if not is_a(curve, Curve):
        raise BadInput(f"curve must be a chapsym.Curve, not {type(curve).__name__}")
    h, start = numbers(height, "height"), numbers(u, "u")
    shape = common_shape([h.shape, start.shape], "height and u")
    h, start = np.broadcast_to(h, shape), np.broadcast_to(start, shape)
    half = np.asarray(curve.rate * h / (2.0 * curve.slack))
    settled, lost = np.zeros(half.shape, dtype=bool), np.zeros(half.shape, dtype=bool)
    for _ in range(MOST_CORRECTIONS):
        half, lost = np.where(np.isfinite(half), half, 0.0), lost | ~np.isfinite(half)
        found, slope = height_of(curve, half, start + half)
        lost |= ~settled & ~(slope * curve.rate > 0.0)
        correction = np.divide(h - found, slope, out=np.zeros_like(half), where=~(settled | lost))
        half = half + correction
        settled |= ~lost & (np.abs(correction) <= SETTLED * np.abs(half))
        if (settled | lost).all():
            break
    half = np.where(settled, half, np.nan)
    if not half.ndim and not settled:
        raise BadInput("no increment was found on the small-rotation branch for this height; take a smaller one")
    return np.asarray(2.0 * half)
