"""The discrete Lagrange-d'Alembert principle on E(n), for every n (Sections 3 and 4).

Everything starts here from three ingredients: the discrete Lagrangian, the continuous rolling
constraint (which the virtual displacements satisfy) and the discrete rolling constraint (which
the path satisfies).  The results are expressions in the noncommuting symbols below, in the space
frame at the time k.  `ball.py` carries them to the body frame.
"""

import sympy as sp

from .words import WordAlgebra, matrix_symbols

# Attitudes and centres at times k-1, k, k+1; J is diagonal, gamma the unit normal in space.
R0, R, R1, R0T, RT, R1T = matrix_symbols("R_- R R_+ R_-^T R^T R_+^T")
r0, r, r1, r0T, rT, r1T = matrix_symbols("r_- r r_+ r_-^T r^T r_+^T")
J, gamma, gammaT = matrix_symbols("J gamma gamma^T")
# An infinitesimal rotation in space (skew), free increments, and the multipliers.
xi, dR, dRT, dr, drT = matrix_symbols("xi dR dR^T dr dr^T")
Lam, f, fT = matrix_symbols("Lambda f f^T")
m, rho, s, c = sp.symbols("m rho s c")
D = sp.Symbol("D")  # m rho^2

ALGEBRA = WordAlgebra(
    {
        **{R0: R0T, R0T: R0, R: RT, RT: R, R1: R1T, R1T: R1},
        **{r0: r0T, r0T: r0, r: rT, rT: r, r1: r1T, r1T: r1},
        **{dR: dRT, dRT: dR, dr: drT, drT: dr, f: fT, fT: f, gamma: gammaT, gammaT: gamma},
        **{J: J, Lam: Lam, xi: -xi},
    },
    {pair: 1 for a, b in [(R0, R0T), (R, RT), (R1, R1T)] for pair in [(a, b), (b, a)]},
)


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
    ½ Tr(U J Uᵀ) = Tr J - Tr(R_k J R_{k+1}ᵀ): the coefficient is read off.
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


def action_variation(factor: sp.Expr) -> sp.Expr:
    """δ𝕃(k-1, k) + δ𝕃(k, k+1) for free increments dR of R_k and dr of r_k, as a trace."""
    action = lagrangian(factor, R0, R, r0, r) + lagrangian(factor, R, R1, r, r1)
    moved = {R: R + s * dR, RT: RT + s * dRT, r: r + s * dr, rT: rT + s * drT}
    return ALGEBRA.trace(sp.expand(action.xreplace(moved)).coeff(s, 1))


def gradient(variation: sp.Expr, increment: sp.Symbol) -> sp.Expr:
    """G with variation = tr(Gᵀ · increment) + (terms without it), for a trace expression."""
    total = sp.S.Zero
    transposed = ALGEBRA.transposes[increment]
    for term in sp.Add.make_args(sp.expand(variation)):
        if term.has(transposed):
            term = ALGEBRA.transpose(term)
        coefficient, word = sp.Mul(*term.args_cnc()[0]), term.args_cnc()[1]
        if increment in word:
            at = word.index(increment)
            total += coefficient * ALGEBRA.transpose(sp.Mul(*(word[at + 1 :] + word[:at])))
    return ALGEBRA.normal(total)


def multiplier_equations(factor: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """D₁𝕃 + D₂𝕃 - (multiplier terms), in R_k and in r_k; both vanish on solutions.

    The multipliers are a symmetric Λ for R Rᵀ = 1 and a column for the rolling constraint.  That
    column is called -f, so that the equation in r_k reads m Δr_k - m Δr_{k-1} = f, as (4.4).
    """
    variation = action_variation(factor)
    holding = ALGEBRA.trace(-rolling_constraint(dr, dR) * fT + (dR * RT + R * dRT) * Lam / 2)
    return (
        ALGEBRA.normal(gradient(variation, dR) - gradient(holding, dR)),
        ALGEBRA.normal(gradient(variation, dr) - gradient(holding, dr)),
    )


def momentum_balance(factor: sp.Expr) -> sp.Expr:
    """The skew matrix that vanishes exactly when the principle holds, the multipliers eliminated.

    Virtual displacements: dR = ξR with ξ skew, and dr the one that the continuous constraint
    gives, -ρ ξ γ.  The principle says that the variation vanishes for every skew ξ.
    """
    rotation = xi * R
    displacement = -rolling_constraint(0, rotation)
    virtual = {dR: rotation, dRT: ALGEBRA.transpose(rotation), dr: displacement, drT: ALGEBRA.transpose(displacement)}
    return ALGEBRA.dual_of_skew(action_variation(factor).xreplace(virtual), xi)


def reaction() -> sp.Expr:
    """m Δr_k - m Δr_{k-1}, in terms of the centres: the force f^k of (4.4)."""
    return m * (r1 - r) - m * (r - r0)


def spatial_momentum(a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """m_k = R_{k+1} J R_kᵀ - R_k J R_{k+1}ᵀ, the momentum about the centre, in space."""
    half = rotational_term(b, a)
    return half - ALGEBRA.transpose(half)


def on_constraint(expr: sp.Expr) -> sp.Expr:
    """Replaces r_{k+1} and r_{k-1} by what the discrete constraint (4.9) makes of them."""
    after = r1 - discrete_constraint(R, R1, r, r1)
    before = r0 + discrete_constraint(R0, R, r0, r)
    places = {r1: after, r1T: ALGEBRA.transpose(after), r0: before, r0T: ALGEBRA.transpose(before)}
    return ALGEBRA.normal(sp.expand(expr.xreplace(places)))
