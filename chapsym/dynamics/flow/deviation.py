"""Bounds of the distance of the motion from polynomials in time, proved from their defects in the equations.

The motion: R turns with the angular velocity ω of the body, B(γ)ω + a = K, B(γ) = I + D(1 - γγᵀ), where K = Rᵀk and
γ = Rᵀe₃ are fixed in space, and a, the angular momentum of a rotor, in the body.  Time is τ in [0, 1], and k and a are
those of the step: times its length.

The polynomials: p(τ), the direction of a quaternion, and w(τ).  With P the rotation of p, K and γ those of P,
    ε = 2 vec(p̄e)/|p|², e = p' - ½ p∘w:  P turns with w + ε;     κ = B(γ)w + a - K.

Lemma (by hand).  The motion is R = P·Rot with Rot the rotation of the quaternion (1, ξ).  With A = B⁻¹C,
Cξ = (Iw + a) × ξ - I(w × ξ), X ≥ |ξ|, X ≤ ¼, β ≥ ‖B⁻¹‖, s = 5βσX ≤ ½, σ = ½(I_max - I_min) and W ≥ |w|
    |ξ' - Aξ| ≤ q = ½(θ + |ε| + (δ + |ε|)X(1 + X)),     θ = β(8σX²W + 2X²|a| + 5σXδ + |κ|),
    δ = (sW + 2βX|a| + β|κ|)/(1 - s).
1. In the axes of P the angular velocity is ϖ = Rot ω.  As B(γ) of the motion is Rotᵀ(S + B)Rot with S = Rot I Rotᵀ - I,
   and K of the motion is RotᵀK, (B + S)ϖ = K - Rot a = Bw - κ - (Rot - 1)a.  So d = ϖ - w has
   (B + S)d = -Sw - κ - (Rot - 1)a.
2. Rot - 1 = N with |N| ≤ 2X and |N - 2[ξ]ₓ| ≤ 2X².  S is the same for I less any number, so for ‖I‖ ≤ σ:
   |S| ≤ 4σX + 4σX² ≤ 5σX, and S is 2([ξ]ₓI - I[ξ]ₓ) up to 8σX².  The latter with w, and 2ξ × a of Na, are -2Cξ.
3. So |d| ≤ δ, and |d - 2Aξ| ≤ θ; with ‖A‖ ≤ α this makes |d| ≤ 2αX + θ.
4. The quaternion Q of Rot has Q' = ½(d - ε)∘Q, so that ξ' = ½(Δ + Δ × ξ + ⟨Δ,ξ⟩ξ) with Δ = d - ε.
If |SAS⁻¹| ≤ L with S diagonal, its entries from s to 1, and M is a matrix of polynomials with M(0) = 1 and
|M' - AM| ≤ η, then from |ξ(0)| ≤ r (Gronwall, for Sξ)
    |ξ| ≤ (r + q)exp(L)/s ≤ X, which proves that X was large enough, and |ξ(1) - M(1)ξ(0)| ≤ (q + ηr)exp(L)/s.

A function of τ in [0, 1] is contained in a polynomial in Arb's balls, on which the kernels run unchanged.
"""

from collections.abc import Iterable, Sequence
from typing import NamedTuple, TypeVar

import numpy as np
from flint import arb, arb_mat, arb_poly, arb_series

from chapsym import generated

from ..errors import TooWide
from ..levels.proved_root import Vector, highest, lowest, upper
from ..loops.branch import moments
from ..loops.vectors import cross, dot_four
from .series import Series, bend

Polynomials = Sequence[arb_poly]
#: The arguments of the kernels: at one time, over a whole step, or as series.
Entry = TypeVar("Entry", arb, arb_poly, arb_series)

#: The ball of all τ.
UNIT = arb(0.5, 0.5)
#: Pieces of a step on which the size of A is bounded separately.
PIECES = 8
#: Sums of entries below this are ignored in the choice of S.
FLAT = 1e-9
#: The factor of the first trial bound of |ξ|.
ROOM = 1.5


def cut(polynomials: Iterable[arb_poly], degree: int) -> list[arb_poly]:
    """Polynomials of a lower degree that contain these on [0, 1]: the constants enclose the truncated terms."""
    found = []
    for poly in polynomials:
        coefficients = poly.coeffs()  # python-flint 0.7 has no `truncate`
        beyond = arb_poly(coefficients[degree + 1 :])(UNIT).abs_upper()
        found.append(arb_poly(coefficients[: degree + 1]) + arb(0, beyond))
    return found


def bound(vector: Iterable[arb_poly]) -> arb:
    """An upper bound of the length of a vector of polynomials on [0, 1]."""
    return upper(x(UNIT) for x in vector)


def exact(poly: arb_poly | arb_series) -> arb_poly:
    """The midpoints."""
    return arb_poly([x.mid() for x in poly.coeffs()])


class Body(NamedTuple):
    """J, D and I in balls; a, of a rotor, in the unit of time of ω."""

    J: Vector
    D: arb
    rotor: Vector

    @property
    def inertia(self) -> Vector:
        """The moments about the centre."""
        return moments(self.J)

    def during(self, length: arb) -> "Body":
        """The body with a in the unit of time of a step of this length."""
        return self._replace(rotor=tuple(length * x for x in self.rotor))

    def bent(self, w: Sequence[Entry], x: Sequence[Entry]) -> list[Entry]:
        """Cx."""
        return [y + z for y, z in zip(bend(self.J, w, x), cross(self.rotor, x), strict=True)]


class Defects(NamedTuple):
    """The defects of polynomials in the equations, as polynomials: e, κ with R replaced by |p|²R, and |p|² - 1.

    R: |p|²R row by row; unit: encloses 1/|p|².
    """

    e: Polynomials
    kappa: Polynomials
    off: arb_poly
    unit: arb
    R: Polynomials


def defects(p: Polynomials, w: Polynomials, k: Vector, body: Body, degree: int) -> Defects:
    """The defects of exact polynomials p and w, R cut to a degree; raises TooWide where |p| may be far from 1."""
    off = dot_four(p, p) - 1
    if not (most := bound([off])) < 0.5:
        raise TooWide
    unit = 1 / (1 + arb(0, most))
    turned = generated.compose(*(*p, 0, *w))
    e = [x.derivative() - y * arb(0.5) for x, y in zip(p, turned, strict=True)]
    R = cut(generated.rotation(*p), degree)
    K = [R[i] * k[0] + R[i + 3] * k[1] + R[i + 6] * k[2] for i in range(3)]
    carried = generated.contact_momentum(*(*w, *R[6:], *body.J, body.D))
    kappa = [x + s - y for x, s, y in zip(carried, body.rotor, K, strict=True)]
    return Defects(e, kappa, off, unit, R)


class Step(NamedTuple):
    """The effect of a step on ξ: M, an enclosure of ξ(1) - Mξ(0), and a bound of |ξ| on [0, 1].

    slip: a bound of |ϖ - w|.
    """

    M: arb_mat
    more: arb
    within: arb
    slip: arb


def deviation(series: Series, w: Polynomials, size: arb, found: Defects, body: Body, start: arb) -> Step:
    """The lemma, for |ξ(0)| ≤ start; call it at the precision of matrices.  Raises TooWide.

    series: gives M, unproved floats.  w: the exact polynomials.  size: a bound of |k|.
    """
    degree = series.a.shape[1] - 1
    omega, gamma = cut(w, degree), cut([x * found.unit for x in found.R[6:]], degree)
    e, off = bound(found.e), bound([found.off])
    epsilon = (2 * e * found.unit.sqrt()).abs_upper()
    weights = _weights(series)
    inverse, growth, largest, W = _sizes(omega, gamma, body, weights)
    M = [[arb_poly(series.Phi[:, i, j].tolist()) for j in range(3)] for i in range(3)]
    eta = (inverse * _slip(M, omega, gamma, body)).abs_upper()
    # With |p|² = 1 + η the computed value has the error (2η + η²)Dγ × (w × γ) - ηK.
    kappa = bound(found.kappa) + (2 * off + off * off) * body.D * W + off * size
    I = body.inertia
    sigma = ((highest(*I) - lowest(*I)) / 2).abs_upper()
    stretch = (growth.exp() / arb(min(weights))).abs_upper()
    X = (ROOM * (start + epsilon + inverse * kappa) * stretch).abs_upper()
    s = 5 * inverse * sigma * X
    if not (X <= 0.25 and s <= 0.5):
        raise TooWide
    rotor = upper(body.rotor)
    crude = (s * W + inverse * (2 * X * rotor + kappa)) / (1 - s)
    beyond = inverse * (8 * sigma * X * X * W + 2 * X * X * rotor + 5 * sigma * X * crude + kappa)
    slip = (2 * largest * X + beyond).abs_upper()
    q = ((beyond + epsilon + (slip + epsilon) * X * (1 + X)) / 2).abs_upper()
    if not (start + q) * stretch <= X:
        raise TooWide
    ends = [sum((c for c in x.coeffs()), arb(0)) for row in M for x in row]
    return Step(arb_mat(3, 3, ends), ((q + eta * start) * stretch).abs_upper(), X, slip)


def _weights(series: Series) -> list[float]:
    """The entries of S, powers of 2, that make the rows and columns of A about equally large (Osborne).

    The least entry is bounded below so that exp(L)/s is smallest: a ball with two equal moments has a column of zeros.
    """
    whole = np.abs(series.A).sum(axis=0)
    size, found = whole * (1 - np.eye(3)), np.zeros(3)
    for i in 3 * (0, 1, 2):
        scaled = size * 2.0 ** (found[:, np.newaxis] - found)
        found[i] += np.round(np.log2((scaled[:, i].sum() + FLAT) / (scaled[i].sum() + FLAT)) / 2)
    found -= found.max()

    def stretch(least: int) -> float:
        powers = np.maximum(found, least)
        return float(np.linalg.norm(whole * 2.0 ** (powers[:, np.newaxis] - powers)) - least * np.log(2))

    least = min(range(int(found.min()), 1), key=stretch)
    return [float(x) for x in 2.0 ** np.maximum(found, least)]


def _sizes(w: Polynomials, gamma: Polynomials, body: Body, S: Sequence[float]) -> tuple[arb, arb, arb, arb]:
    """Bounds of ‖B⁻¹‖, of the integral of |SAS⁻¹|, of |A| and of |w| on [0, 1]."""
    inverse, growth, largest, W = arb(0), arb(0), arb(0), arb(0)
    for i in range(PIECES):
        time = (arb(i) + UNIT) / PIECES
        v, g = [x(time) for x in w], [x(time) for x in gamma]
        columns = [generated.angular_velocity(*(*x, *g, *body.J, body.D)) for x in _UNITS]
        inverse = inverse.max(upper([x for column in columns for x in column]))
        A = [generated.angular_velocity(*(*body.bent(v, x), *g, *body.J, body.D)) for x in _UNITS]
        largest = largest.max(upper([x for column in A for x in column]))
        weighted = [x * (row / by) for column, by in zip(A, S, strict=True) for x, row in zip(column, S, strict=True)]
        growth += upper(weighted) / PIECES
        W = W.max(upper(v))
    if not (inverse.is_finite() and growth.is_finite()):
        raise TooWide
    return inverse.abs_upper(), growth.abs_upper(), largest.abs_upper(), W.abs_upper()


def _slip(M: Sequence[Polynomials], w: Polynomials, gamma: Polynomials, body: Body) -> arb:
    """A bound of BM' - CM."""
    left = []
    for j in range(3):
        x = [M[i][j] for i in range(3)]
        rate = [y.derivative() for y in x]
        carried = generated.contact_momentum(*(*rate, *gamma, *body.J, body.D))
        left += [y - z for y, z in zip(carried, body.bent(w, x), strict=True)]
    return bound(left)


_UNITS: tuple[Vector, ...] = tuple(tuple(arb(int(i == j)) for j in range(3)) for i in range(3))
