"""The continuous ball in three dimensions (Section 2): momentum, angular velocity, energy."""

from functools import cache

import sympy as sp

from . import ball, limits, three
from .limits import RING, omega
from .words import evaluate


@cache
def momentum() -> sp.ImmutableMatrix:
    """K(ω, γ) = Λω - D⟨ω,γ⟩γ (2.13 for n = 3), the limit of 𝒦/ε: B(γ) ω."""
    limit = limits.momentum().limit
    values = {ball.omega: omega.hat(), ball.J: three.J, ball.Gamma: three.gamma * three.gamma.T}
    vector = three.axial(evaluate(limit, values))
    inertia = sp.Matrix(three.contact_inertia())
    if (vector - inertia * omega).applyfunc(sp.expand) != sp.zeros(3, 1):
        raise ArithmeticError("the limit of the discrete momentum is not B(γ) ω")
    return sp.ImmutableMatrix(inertia * omega)


def momentum_steps() -> tuple[three.Steps, sp.Matrix]:
    """K in steps, as Iω + γ × D(ω × γ): rounding errors of ω × γ do not affect ⟨K,γ⟩."""
    return three.carried_steps(omega)


@cache
def inverse_inertia() -> sp.ImmutableMatrix:
    """Λ⁻¹, with Λ from the discrete momentum."""
    return sp.ImmutableMatrix(three.lam().inv())


def rolling_factor() -> sp.Expr:
    """F = ⟨Iγ, Λ⁻¹γ⟩ with I = Λ - D: 1 - D⟨γ, Λ⁻¹γ⟩ without cancellation."""
    central = three.lam() - three.D * sp.eye(3)
    return (central * three.gamma).dot(inverse_inertia() * three.gamma)


@cache
def vertical_rate() -> sp.Expr:
    """⟨ω, γ⟩ as a function of K, γ, from Λω = K + D⟨ω,γ⟩γ; the denominator is F."""
    rate = sp.Symbol("rate")
    body = inverse_inertia() * (three.K + three.D * rate * three.gamma)
    slope = sp.diff(three.gamma.dot(body) - rate, rate)
    if not RING.is_zero(slope + rolling_factor()):
        raise ArithmeticError("1 - D<gamma, Lambda^-1 gamma> is not F")
    return three.gamma.dot(inverse_inertia() * three.K) / rolling_factor()


@cache
def angular_velocity() -> sp.ImmutableMatrix:
    """ω(K, γ) = Λ⁻¹(K + D⟨ω,γ⟩γ)."""
    return sp.ImmutableMatrix(inverse_inertia() * (three.K + three.D * vertical_rate() * three.gamma))


@cache
def energy() -> sp.Expr:
    """The kinetic energy ½⟨K, ω⟩ as a function of K, γ, as a sum of non-negative terms."""
    quadratic = three.K.dot(inverse_inertia() * three.K)
    lifted = three.D * vertical_rate() * three.gamma.dot(inverse_inertia() * three.K)
    if not RING.is_zero(three.K.dot(sp.Matrix(angular_velocity())) - quadratic - lifted):
        raise ArithmeticError("<K, omega> is not the sum of its two parts")
    return (quadratic + lifted) / 2


def lagrangian_energy() -> sp.Expr:
    """½ m|v|² + ½⟨Iω, ω⟩ of the rolling ball; |v|² = ρ²|ω × γ|² for both signs in (2.1)."""
    central = three.lam() - three.D * sp.eye(3)
    slip = omega.cross(three.gamma)
    return three.D * slip.dot(slip) / 2 + omega.dot(central * omega) / 2
