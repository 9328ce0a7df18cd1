"""The discrete Lagrange-d'Alembert principle on E(n), for every n (Sections 3 and 4).

The derivation starts from three assumptions: the discrete Lagrangian, the continuous rolling constraint (for virtual
displacements) and the discrete rolling constraint (for the path).  The results are expressions in the noncommuting
symbols below, in the space frame at time k.  `ball.py` transforms them to the body frame.
"""

from collections.abc import Mapping

import sympy as sp

from .derivation import STEPS, allowed, dual, equations, rate, replaced, terms, written
from .words import WordAlgebra, matrix_symbols

# Attitudes and centres at times k-1, k, k+1; J is diagonal, gamma the unit normal in space.
R0, R, R1, R0T, RT, R1T = matrix_symbols("R_- R R_+ R_-^T R^T R_+^T")
r0, r, r1, r0T, rT, r1T = matrix_symbols("r_- r r_+ r_-^T r^T r_+^T")
J, gamma, gammaT = matrix_symbols("J gamma gamma^T")
# An infinitesimal rotation in space (skew), free increments, and the multipliers.
xi, dR, dRT, dr, drT = matrix_symbols("xi dR dR^T dr dr^T")
Lam, f, fT = matrix_symbols("Lambda f f^T")
omega_space = matrix_symbols("omega_s")[0]  # the angular velocity in space
m, rho, c = sp.symbols("m rho c")
D = sp.Symbol("D")  # m rho^2

TRANSPOSES = {
    **{R0: R0T, R: RT, R1: R1T, r0: r0T, r: rT, r1: r1T, dR: dRT, dr: drT, f: fT, gamma: gammaT},
    **{J: J, Lam: Lam, xi: -xi, omega_space: -omega_space},
}
ALGEBRA = WordAlgebra(TRANSPOSES, {pair: 1 for a, b in [(R0, R0T), (R, RT), (R1, R1T)] for pair in [(a, b), (b, a)]})
#: The algebra of the variation of the path, in which R_k need not be a rotation.
FREE = WordAlgebra(TRANSPOSES)


def rotational_term(a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """R_k J R_{k+1}ᵀ, whose trace is the rotational part of the discrete Lagrangian up to a factor."""
    return a * J * ALGEBRA.transpose(b)


def lagrangian(factor: sp.Expr, a: sp.Expr, b: sp.Expr, x: sp.Expr, y: sp.Expr) -> sp.Expr:
    """The matrix whose trace is 𝕃 = factor·Tr(R_k J R_{k+1}ᵀ) + (m/2)|r_{k+1} - r_k|²."""
    step = y - x
    return factor * rotational_term(a, b) + m / 2 * step * ALGEBRA.transpose(step)


def kinetic_factor() -> sp.Expr:
    """The factor that makes 𝕃/ε² tend to the kinetic energy, up to a constant.

    With U = R_{k+1} - R_k the rotational energy is ½ Tr(U J Uᵀ)/ε², and
    ½ Tr(U J Uᵀ) = Tr J - Tr(R_k J R_{k+1}ᵀ): the factor is the coefficient of the last trace.
    """
    step = R1 - R
    energy = ALGEBRA.trace(step * J * ALGEBRA.transpose(step) / 2)
    cross = ALGEBRA.trace(rotational_term(R, R1))
    return energy.coeff(cross)


def rolling_constraint(velocity: sp.Expr, rotation: sp.Expr) -> sp.Expr:
    """The continuous constraint (4.2), ṙ + ρ Ṙ Rᵀ γ, at the time k."""
    return velocity + rho * rotation * RT * gamma


def discrete_constraint(a: sp.Expr, b: sp.Expr, x: sp.Expr, y: sp.Expr) -> sp.Expr:
    """The discrete constraint (4.9), Δr + (ρ/2)(Ω̄ - Ω̄ᵀ)γ with Ω̄ = R_{k+1} R_kᵀ."""
    space_rotation = b * ALGEBRA.transpose(a)
    return y - x + rho / 2 * (space_rotation - ALGEBRA.transpose(space_rotation)) * gamma


def turning_step() -> sp.Symbol:
    """(4.9) without the term Δr."""
    rotational = discrete_constraint(R, R1, sp.S.Zero, sp.S.Zero)
    return written("turning_step", "(4.9) without Δr", rotational, ALGEBRA)


def variation() -> sp.Symbol:
    """δ𝕃(k-1, k) + δ𝕃(k, k+1) for free increments dR of R_k and dr of r_k, as a trace."""
    text = "tr of it is 𝕃(k-1,k) + 𝕃(k,k+1), 𝕃 = c Tr(R_k J R_{k+1}ᵀ) + (m/2)|r_{k+1} - r_k|²"
    action = written("action", text, lagrangian(c, R0, R, r0, r) + lagrangian(c, R, R1, r, r1), FREE)
    increments = FREE.with_transposes({**dict.fromkeys((R0, R1, r0, r1, J), sp.S.Zero), R: dR, r: dr})
    return rate("variation_c", "for increments dR of R_k and dr of r_k", action, increments)


def multiplier_equations(factor: sp.Expr) -> list[sp.Symbol]:
    """D₁𝕃 + D₂𝕃 - (multiplier terms), in R_k and in r_k; both vanish on solutions.

    The multipliers are a symmetric Λ for R Rᵀ = 1 and a column -f for the rolling constraint, so that the
    equation in r_k is m Δr_k - m Δr_{k-1} = f, as (4.4).
    """
    text = "tr of it: the constraint (4.2) times -f, and the increment of R Rᵀ/2 times Λ"
    holding = written("holding", text, -rolling_constraint(dr, dR) * fT + (dR * RT + R * dRT) * Lam / 2, FREE)
    return equations(_with_factor(variation(), factor), holding, {"R": dR, "r": dr}, ALGEBRA)


def momentum_balance(factor: sp.Expr) -> sp.Symbol:
    """The skew matrix that vanishes exactly when the principle holds, the multipliers eliminated.

    Virtual displacements are dR = ξR with ξ skew, and dr = -ρ ξ γ by the continuous constraint.  The principle
    is that the variation vanishes for every skew ξ.
    """
    constraint = rolling_constraint(dr, dR)
    rolling = written("rolling", "(4.2) for virtual displacements, dr + ρ dR Rᵀ γ: it vanishes", constraint, FREE)
    increments = allowed("", "dR = ξR", {dR: xi * R}, rolling, dr, ALGEBRA)
    work = replaced("work", "tr of it is the variation for dR = ξR and that dr", variation(), increments, ALGEBRA)
    return _with_factor(dual("balance_c", "it vanishes when the variation does for every skew ξ", work, xi), factor)


def _with_factor(of: sp.Symbol, factor: sp.Expr) -> sp.Symbol:
    """An expression with the factor c of the Lagrangian replaced by a value."""
    if factor == c:
        return of
    number = sp.Rational(factor)
    name = str(of).removesuffix("_c") + ("" if number == -1 else f"_at_{number.p}_{number.q}".replace("-", "m"))
    return replaced(name, f"for c = {number}", of, {c: number}, STEPS[of].algebra)


def reaction() -> sp.Expr:
    """m Δr_k - m Δr_{k-1}, in terms of the centres: the force f^k of (4.4)."""
    return m * (r1 - r) - m * (r - r0)


def rolling_reaction() -> sp.Symbol:
    """The reaction m Δr_k - m Δr_{k-1} under the discrete constraint."""
    force = written("reaction", "m Δr_k - m Δr_{k-1}", reaction(), ALGEBRA)
    return on_constraint("reaction_rolling", "on the discrete constraint", force)


def spatial_momentum(a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """m_k = R_{k+1} J R_kᵀ - R_k J R_{k+1}ᵀ, the momentum about the centre, in space."""
    half = rotational_term(b, a)
    return half - ALGEBRA.transpose(half)


def on_constraint(name: str, text: str, of: sp.Symbol, more: Mapping[sp.Symbol, sp.Expr] | None = None) -> sp.Symbol:
    """A letter with r_{k+1} and r_{k-1} replaced by (4.9), and the replacements `more`."""
    steps = (("k", "k+1", "after", (R, R1, r, r1), r1, -1), ("k-1", "k", "before", (R0, R, r0, r), r0, 1))
    centres = dict[sp.Symbol, sp.Expr]()
    for start, end, when, path, centre, sign in steps:
        constraint = discrete_constraint(*path)
        holds = written(f"rolls_{when}", f"(4.9) from {start} to {end}: it vanishes", constraint, ALGEBRA)
        rest = terms(f"rest_{when}", f"it without {centre}", holds, [centre], having=False)
        centres[centre] = sign * rest
    return replaced(name, text, of, {**(more or {}), **ALGEBRA.with_transposes(centres)}, ALGEBRA)
