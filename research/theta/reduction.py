"""Every motion of the ball is one whose momentum is orthogonal to the vertical, in another time (Chaplygin).

Lemma `chaplygin-reduction`: with H₂ = ⟨K,ω⟩ and Λ = I + D, Λω = (Dγγᵀ + KKᵀ/H₂)ω.  In space this form is constant:
dppᵀ + cqqᵀ, d ≤ D ≤ c, with p and q orthonormal in the plane of K and γ.  So p' = p × ω, q' = q × ω and
Λω = dp⟨p,ω⟩ + cq⟨q,ω⟩: ω is a multiple of ω̃ with Λω̃ - dp⟨p,ω̃⟩ = q, of the ball with d in the place of D, the
vertical p and the momentum q.  ω = cYω̃ with Y = ⟨q,ω⟩ = H₂/(k₁cb/(1 - da) + k₂), K = k₁p + k₂q, a = ⟨p,Λ⁻¹p⟩ and
b = ⟨p,Λ⁻¹q⟩; Y is never 0.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from chapsym import generated
from chapsym.dynamics.flow.series import cross, dot
from chapsym.dynamics.levels.proved_root import TooWide

Vector = tuple[Any, ...]


def times(x: Sequence[Any], y: Sequence[Any]) -> Vector:
    """The products of the components."""
    return tuple(a * b for a, b in zip(x, y, strict=True))


@dataclass(frozen=True)
class Reduced:
    """p and q in the body at the start, γ = gₚp + g_q q, K = k₁p + k₂q, Λ, c, d, and H₂ = ⟨K,ω⟩."""

    p: Vector
    q: Vector
    gamma: Vector
    K: Vector
    inertia: Vector
    c: Any
    d: Any
    energy: Any

    @property
    def inverse(self) -> Vector:
        """Λ⁻¹."""
        return tuple(1 / x for x in self.inertia)

    @property
    def a(self) -> Any:
        """⟨p,Λ⁻¹p⟩ at the start."""
        return dot(times(self.inverse, self.p), self.p)

    @property
    def b(self) -> Any:
        """⟨p,Λ⁻¹q⟩ at the start."""
        return dot(times(self.inverse, self.p), self.q)

    def rates(self) -> tuple[Vector, Vector]:
        """p' and q' at the start, in the time T of ½√(det Λ·(1 - da)) dT = dt̃, ω̃ the angular velocity by t̃."""
        L1, L2, L3 = self.inertia
        lift = self.d * self.b / (1 - self.d * self.a)
        spin = times(self.inverse, [y + lift * x for x, y in zip(self.p, self.q, strict=True)])
        length = (L1 * L2 * L3 * (1 - self.d * self.a)).sqrt() / 2
        first, second = (tuple(length * x for x in cross(v, spin)) for v in (self.p, self.q))
        return first, second


def reduced(J: Sequence[Any], D: Any, K: Sequence[Any], gamma: Sequence[Any]) -> Reduced:
    """The reduction of a motion, in balls; raises TooWide where K may be parallel to γ, or D 0."""
    J1, J2, J3 = J
    inertia = (J2 + J3 + D, J1 + J3 + D, J1 + J2 + D)
    omega = generated.angular_velocity(*(*K, *gamma, *J, D))
    energy, h = dot(K, omega), dot(K, gamma)
    across = [x - h * y for x, y in zip(K, gamma, strict=True)]
    k = dot(across, across).sqrt()
    if not (k > 0 and energy > 0 and D > 0):
        raise TooWide
    e = [x / k for x in across]
    # The form in the axes γ and e, the eigenvector of its larger eigenvalue, and a quarter turn back the other.
    first, mixed, last = D + h * h / energy, h * k / energy, k * k / energy
    half = (first - last) / 2
    c = (first + last) / 2 + (half * half + mixed * mixed).sqrt()
    cosine, sine = (c - last, mixed) if half.mid() > 0 else (mixed, c - first)
    length = (cosine * cosine + sine * sine).sqrt()
    if length.contains(0):
        raise TooWide
    # Y > 0: the two times run the same way.
    length = -length if (cosine * dot(gamma, omega) + sine * dot(e, omega)).mid() < 0 else length
    cosine, sine = cosine / length, sine / length
    q = tuple(cosine * x + sine * y for x, y in zip(gamma, e, strict=True))
    p = tuple(sine * x - cosine * y for x, y in zip(gamma, e, strict=True))
    return Reduced(
        p, q, (sine, cosine), (h * sine - k * cosine, h * cosine + k * sine), inertia, c, D * k * k / energy / c, energy
    )
