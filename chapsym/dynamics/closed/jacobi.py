"""Jacobi's elliptic functions and their inverse in float64, from k and k': nothing cancels at k → 0 or k → 1."""

import numpy as np

from ..ball import Floats

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
