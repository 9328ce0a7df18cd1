"""The continuous ball on E(n), for every n (Section 2): d'Alembert's principle and time derivatives of words.

In the frame of the body: ω = R⁻¹Ṙ (skew), v = R⁻¹ṙ, γ = R⁻¹γ⃗, and γ is directed from the centre to the
plane, for which the rolling condition reads v + ρωγ = 0 (claims 2.1 and 2.9).
"""

from collections.abc import Mapping

import sympy as sp

from .words import WordAlgebra, matrix_symbols

omega, alpha, J, Gamma, K = matrix_symbols("omega alpha J Gamma K")  # alpha is dω/dt
gamma, gammaT, v, vT, a, aT, F, FT = matrix_symbols("gamma gamma^T v v^T a a^T F F^T")  # a is dv/dt
eta = matrix_symbols("eta")[0]
m, rho, D = sp.symbols("m rho D")

ALGEBRA = WordAlgebra(
    {
        **{omega: -omega, alpha: -alpha, eta: -eta, J: J, Gamma: Gamma, K: -K},
        **{gamma: gammaT, gammaT: gamma, v: vT, vT: v, a: aT, aT: a, F: FT, FT: F},
    },
    {(gamma, gammaT): Gamma, (gammaT, gamma): 1, (Gamma, gamma): gamma, (gammaT, Gamma): gammaT, (Gamma, Gamma): Gamma},
)

#: d/dt of the letters: Ṙ = Rω makes γ̇ = -ωγ for a γ fixed in space.
RATES: dict[sp.Symbol, sp.Expr] = {
    **{omega: alpha, v: a, vT: aT, J: sp.S.Zero},
    **{gamma: -omega * gamma, gammaT: gammaT * omega, Gamma: Gamma * omega - omega * Gamma},
}


def rate(expr: sp.Expr, rates: Mapping[sp.Symbol, sp.Expr] = RATES) -> sp.Expr:
    """d/dt of a sum of words, by Leibniz' rule; every letter must have a rate."""
    total = sp.S.Zero
    for term in sp.Add.make_args(ALGEBRA.normal(expr)):
        commuting, letters = term.args_cnc()
        word = [base for letter in letters for base in [letter.as_base_exp()[0]] * int(letter.as_base_exp()[1])]
        for i, letter in enumerate(word):
            total += sp.Mul(*commuting) * sp.Mul(*word[:i]) * rates[letter] * sp.Mul(*word[i + 1 :])
    return ALGEBRA.normal(total)


def commutator(x: sp.Expr, y: sp.Expr) -> sp.Expr:
    """[x, y] = xy - yx."""
    return x * y - y * x


def centre_momentum() -> sp.Expr:
    """M: the skew matrix with ∂L/∂Ṙ · Rη = -½ tr(M η) for every skew η, from L = ½ tr(Ṙ J Ṙᵀ)."""
    return -ALGEBRA.dual_of_skew(ALGEBRA.trace(omega * J * ALGEBRA.transpose(eta)), eta)


def contact_momentum() -> sp.Expr:
    """K = M + D(Γω + ωΓ), as printed in (2.13)."""
    return centre_momentum() + D * (Gamma * omega + omega * Gamma)


def rolling_velocity() -> sp.Expr:
    """v = -ρωγ."""
    return -rho * omega * gamma


def inertial_force() -> sp.Expr:
    """F = m(v̇ + ωv): the force that the plane must exert, (2.11)."""
    return m * (a + omega * v)


def on_rolling(expr: sp.Expr) -> sp.Expr:
    """Replaces v and v̇ by what the rolling condition makes of them."""
    velocity = rolling_velocity()
    acceleration = rate(velocity)
    places = {v: velocity, vT: ALGEBRA.transpose(velocity), a: acceleration, aT: ALGEBRA.transpose(acceleration)}
    return ALGEBRA.normal(sp.expand(expr.xreplace(places)))


def dalembert() -> sp.Expr:
    """The skew matrix that vanishes exactly when d'Alembert's principle holds.

    tr(R̈ J δRᵀ) + ⟨m r̈, δr⟩ = 0 for δR = Rη and δr = -ρRηγ, every skew η, with
    R̈ = R(ω̇ + ω²) and r̈ = R(v̇ + ωv).
    """
    force = inertial_force()
    work = (alpha + omega * omega) * J * ALGEBRA.transpose(eta)
    work += -rho * eta * gamma * ALGEBRA.transpose(force)
    return -ALGEBRA.dual_of_skew(work, eta)
