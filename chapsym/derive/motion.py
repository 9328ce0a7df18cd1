"""The continuous ball on E(n), for every n (Section 2): d'Alembert's principle and time derivatives of words.

In the body frame: ω = R⁻¹Ṙ (skew), v = R⁻¹ṙ, γ = R⁻¹γ⃗.  γ is directed from the centre to the plane; then the rolling
condition is v + ρωγ = 0 (claims 2.1 and 2.9).
"""

from collections.abc import Mapping

import sympy as sp

from . import derivation
from .derivation import dual, replaced, written
from .words import WordAlgebra, matrix_symbols

omega, alpha, J, Gamma, K = matrix_symbols("omega alpha J Gamma K")  # alpha is dω/dt
gamma, gammaT, v, vT, a, aT, F, FT = matrix_symbols("gamma gamma^T v v^T a a^T F F^T")  # a is dv/dt
eta = matrix_symbols("eta")[0]
m, rho, D = sp.symbols("m rho D")

ALGEBRA = WordAlgebra(
    {**{omega: -omega, alpha: -alpha, eta: -eta, J: J, Gamma: Gamma, K: -K}, **{gamma: gammaT, v: vT, a: aT, F: FT}},
    {(gamma, gammaT): Gamma, (gammaT, gamma): 1, (Gamma, gamma): gamma, (gammaT, Gamma): gammaT, (Gamma, Gamma): Gamma},
)

#: d/dt of the letters: Ṙ = Rω makes γ̇ = -ωγ for a γ fixed in space.
RATES: dict[sp.Symbol, sp.Expr] = {
    **ALGEBRA.with_transposes({omega: alpha, v: a, J: sp.S.Zero, gamma: -omega * gamma}),
    Gamma: Gamma * omega - omega * Gamma,
}


def rate(expr: sp.Expr, rates: Mapping[sp.Symbol, sp.Expr] = RATES) -> sp.Expr:
    """The time derivative of a sum of words; every letter must have a rate."""
    return ALGEBRA.rate(expr, rates)


def commutator(x: sp.Expr, y: sp.Expr) -> sp.Expr:
    """[x, y] = xy - yx."""
    return x * y - y * x


def centre_momentum() -> sp.Symbol:
    """M: the skew matrix with ∂L/∂Ṙ · Rη = -½ tr(M η) for every skew η, from L = ½ tr(Ṙ J Ṙᵀ)."""
    slope = written("impulse", "tr of it is ∂L/∂Ṙ · Rη, L = ½ tr(Ṙ J Ṙᵀ)", omega * J * ALGEBRA.transpose(eta), ALGEBRA)
    return written("M", "∂L/∂Ṙ · Rη = -½ tr(η M)", -dual("impulse_dual", "½ tr(η it)", slope, eta), ALGEBRA)


def contact_momentum() -> sp.Symbol:
    """K about the contact point P: M + mv ∧ (C - P), with C - P = -ργ, v = -ρωγ and m = D/ρ²."""
    lever = ALGEBRA.wedge(D / rho**2 * rolling_velocity(), -rho * gamma)
    return written("K_contact", "M + mv ∧ (-ργ), v = -ρωγ and m = D/ρ²", centre_momentum() + lever, ALGEBRA)


def rolling_velocity() -> sp.Expr:
    """v = -ρωγ."""
    return -rho * omega * gamma


def inertial_force() -> sp.Symbol:
    """F = m(v̇ + ωv): the reaction of the plane, (2.11)."""
    return written("force", "m r̈ in the body", m * (a + omega * v), ALGEBRA)


def on_rolling(name: str, of: sp.Symbol, more: Mapping[sp.Symbol, sp.Expr] | None = None) -> sp.Symbol:
    """A letter with v and v̇ replaced by their values under the rolling condition, and the replacements `more`."""
    velocity = written("velocity", "v of the rolling condition, v + ρωγ = 0", rolling_velocity(), ALGEBRA)
    acceleration = derivation.rate("acceleration", "its derivative: γ̇ = -ωγ, ω̇ = α", velocity, RATES)
    places = ALGEBRA.with_transposes({v: velocity, a: acceleration})
    return replaced(name, "on the rolling condition", of, places | dict(more or {}), ALGEBRA)


def dalembert() -> sp.Symbol:
    """The skew matrix that vanishes exactly when d'Alembert's principle holds.

    tr(R̈ J δRᵀ) + ⟨m r̈, δr⟩ = 0 for δR = Rη and δr = -ρRηγ, every skew η, with
    R̈ = R(ω̇ + ω²) and r̈ = R(v̇ + ωv).
    """
    work = (alpha + omega * omega) * J * ALGEBRA.transpose(eta)
    work += -rho * eta * gamma * ALGEBRA.transpose(inertial_force())
    total = written("virtual_work", "tr of it is tr(R̈ J δRᵀ) + ⟨m r̈, δr⟩ for δR = Rη, δr = -ρRηγ", work, ALGEBRA)
    resisting = dual("resisting", "½ tr(η it) is that work", total, eta)
    return written("principle", "it vanishes when that work does for every skew η", -resisting, ALGEBRA)


def eliminated() -> sp.Symbol:
    """The principle with D = mρ², in which the velocity and the reaction are eliminated."""
    return on_rolling("principle_rolling", dalembert(), {m: D / rho**2})
