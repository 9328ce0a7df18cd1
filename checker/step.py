"""The step of the discrete Chaplygin ball, from its definition (Fedorov 2007, equations (5.1)-(5.3)).

Definition.  J = diag(J1, J2, J3) is the mass tensor, D = m·radius².  A state is (𝒦, γ), |γ| = 1.  The rotation Ω of a
step, about q by the angle θ, (q₀, q) = (cos ½θ, sin ½θ·axis), solves
    𝒦 = M + 2D q₀(q - ⟨γ, q⟩γ),   M₁ = 2((J2 + J3) q₀q₁ + (J2 - J3) q₂q₃) and so on in cyclic order;
the state after the step is (Ωᵀ𝒦, Ωᵀγ).

In the Gibbs vector u = q/q₀, with q₀² = 1/(1 + |u|²), I = diag(J2 + J3, J3 + J1, J1 + J2) and (u × Iu)₁ =
(I3 - I2)u₂u₃ = (J2 - J3)u₂u₃, this is 𝒦 = 2/(1 + |u|²)·(Iu + u × Iu + D(u - ⟨γ, u⟩γ)), that is, with Λ = I + D,
    F(u) = Λu - D⟨γ, u⟩γ + u × Iu - ½(1 + |u|²)𝒦 = 0.                                                            (1)
With U v = u × v, U³ = -|u|²U, the rotation about u by -θ, tan ½θ = |u|, is Ωᵀ = (1 + U)⁻¹(1 - U), where
    (1 + U)⁻¹w = w - (u × w - u × (u × w))/(1 + |u|²)   and so   Ωᵀv = 2(1 + U)⁻¹v - v.                            (2)
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from .interval import Interval, Rejected
from .linear import Matrix, Vector, cross, dot, minus, newton, plus, solve, times, transposed

#: A tangent vector (d𝒦, dγ), or a state (𝒦, γ).
Pair = tuple[Vector, Vector]


@dataclass(frozen=True)
class Ball:
    """The moments I = (J2 + J3, J3 + J1, J1 + J2) and D, as intervals: all balls with such values."""

    inertia: Vector
    D: Interval

    @classmethod
    def within(cls, J: Sequence[Fraction], D: Fraction, radius: Fraction, bits: int, top: bool = False) -> "Ball":
        """All balls with J and D within `radius` of these; raises Rejected unless J ≥ 0, I > 0 and D > 0 for all.

        top: whether D = 0 is allowed.
        """
        if min(J) < radius:
            raise Rejected("the mass tensor J must not be negative anywhere within the radius")
        mass = [Interval.about(x, bits, radius) for x in J]
        ball = cls([mass[i - 2] + mass[i - 1] for i in range(3)], Interval.about(D, bits, radius))
        if not (ball.D > 0 or (top and D == radius == 0)) or not all(x > 0 for x in ball.inertia):
            raise Rejected("D and the moments of inertia must be positive everywhere within the radius")
        return ball

    @property
    def contact(self) -> Vector:
        """Λ = I + D."""
        return [x + self.D for x in self.inertia]


def check_small_branch(ball: Ball, size: Interval) -> None:
    """Raises Rejected unless (1) has exactly one root with |u| < 1 for |𝒦| = `size` and every |γ| = 1.

    A root has ⟨u, F(u)⟩ = 0, and ⟨u, Λu - D⟨γ, u⟩γ⟩ ≥ ⟨u, Iu⟩ as |γ| = 1, D ≥ 0: so I_min|u| ≤ ½|𝒦|(1 + |u|²).  For
    x = |𝒦|/I_min < 1 this says |u| ≤ ϱ or |u| ≥ 1/ϱ, ϱ = tan(½ arcsin x) = x/(1 + √(1 - x²)) < 1.  On the ball |u| ≤ ϱ
    ⟨d, F′(u)d⟩ = ⟨d, Λd - D⟨γ, d⟩γ⟩ - ⟨u, d × Id⟩ - ⟨d, 𝒦⟩⟨u, d⟩ ≥ (I_min - ϱ(½(I_max - I_min) + |𝒦|))|d|², for
    |d × Id| = |d × (I - c)d| ≤ ½(I_max - I_min)|d|² with c in the middle: positive under the second condition, so F is
    strictly monotone there and has one root at most.  It has one: continued in t from u = 0 with t𝒦, 0 ≤ t ≤ 1 (F′ is
    regular and the gap between ϱ and 1/ϱ is never crossed).  This root, the small branch, depends smoothly on 𝒦 and γ.
    """
    for least in ball.inertia:
        if not size < least:
            raise Rejected("|𝒦| is not less than the least moment of inertia: the small branch is not proved")
        x = size / least
        bound = x / (1 + (1 - x * x).sqrt())
        for other in ball.inertia:  # for every pair, hence for the greatest and the least
            if not bound * ((other - least) / 2 + size) < least:
                raise Rejected("|𝒦| is beyond the bound within which the small branch is proved")


def gibbs_vector(ball: Ball, state: Pair, near: Vector) -> Vector:
    """The root u of (1) near a given vector, enclosed; raises Rejected unless it is proved and |u| < 1."""
    u = newton(lambda u: residual(ball, state, u), lambda u: jacobian(ball, state, u), near)
    if not dot(u, u) < 1:
        raise Rejected("a step does not have |u| < 1")
    return u


def residual(ball: Ball, state: Pair, u: Vector) -> Vector:
    """F(u) of (1)."""
    momentum, gamma = state
    force = plus(minus([L * x for L, x in zip(ball.contact, u, strict=True)], times(ball.D * dot(gamma, u), gamma)),
                 cross(u, [I * x for I, x in zip(ball.inertia, u, strict=True)]))  # fmt: skip
    return minus(force, times((1 + dot(u, u)) / 2, momentum))


def jacobian(ball: Ball, state: Pair, u: Vector) -> Matrix:
    """F′(u): d ↦ Λd - D⟨γ, d⟩γ + d × Iu + u × Id - ⟨u, d⟩𝒦; for d = e_i the products are e_i × (I - I_i)u."""
    momentum, gamma = state
    columns = []
    for i, own in enumerate(ball.inertia):
        bent = [(I - own) * x for I, x in zip(ball.inertia, u, strict=True)]
        column = [*plus(times(ball.D * gamma[i], gamma), times(u[i], momentum))]
        column[i] = column[i] - own - ball.D
        column[i - 2], column[i - 1] = column[i - 2] + bent[i - 1], column[i - 1] - bent[i - 2]
        columns.append([-x for x in column])
    return transposed(columns)


def halved(u: Vector, w: Vector) -> Vector:
    """(1 + U)⁻¹w by (2)."""
    once = cross(u, w)
    return minus(w, times(1 / (1 + dot(u, u)), minus(once, cross(u, once))))


def turned(u: Vector, v: Vector) -> Vector:
    """Ωᵀv by (2)."""
    return minus(times(2, halved(u, v)), v)


def moved(u: Vector, state: Pair) -> Pair:
    """(Ωᵀ𝒦, Ωᵀγ)."""
    return turned(u, state[0]), turned(u, state[1])


def source(ball: Ball, state: Pair, u: Vector, vector: Pair) -> Vector:
    """D(⟨dγ, u⟩γ + ⟨γ, u⟩dγ) + ½(1 + |u|²)d𝒦: minus the derivative of F(u) in the direction (d𝒦, dγ)."""
    gamma, (dk, dg) = state[1], vector
    force = plus(times(dot(dg, u), gamma), times(dot(gamma, u), dg))
    return plus(times(ball.D, force), times((1 + dot(u, u)) / 2, dk))


def tangents(ball: Ball, state: Pair, u: Vector, vectors: Sequence[Pair]) -> list[Pair]:
    """The derivative of the step, applied to tangent vectors (d𝒦, dγ).

    From (1): F′(u)du is `source`.  From ṽ + u × ṽ = v - u × v, which is (2) for ṽ = Ωᵀv:
    dṽ + u × dṽ = dv - u × dv - du × (v + ṽ), that is dṽ = Ωᵀdv - (1 + U)⁻¹(du × (v + ṽ)).
    """
    right = [source(ball, state, u, vector) for vector in vectors]
    du = transposed(solve(jacobian(ball, state, u), transposed(right)))
    both = [plus(v, turned(u, v)) for v in state]

    def move(of: Vector, dv: Vector, sum_: Vector) -> Vector:
        return minus(turned(u, dv), halved(u, cross(of, sum_)))

    return [(move(d, dk, both[0]), move(d, dg, both[1])) for d, (dk, dg) in zip(du, vectors, strict=True)]
