"""Section 4: the momentum about the contact point (Propositions 1 and 2)."""

import sympy as sp

from chapsym.derive import ball
from chapsym.derive.ball import ALGEBRA, D, Gamma, J, K, Omega, OmegaT
from chapsym.derive.words import WordAlgebra, matrix_symbols
from chapsym.prove import Equation, Proof, claim, main


def equation(text: str, left: sp.Expr, right: sp.Expr, algebra: WordAlgebra = ALGEBRA) -> Equation:
    """One matrix equation between words."""
    return Equation(text, [left], [right], algebra)


def printed_forms() -> tuple[sp.Expr, sp.Expr]:
    """The two forms of (4.13)."""
    shifted = J + D / 2 * Gamma
    rest = D / 2 * (Gamma * Omega - OmegaT * Gamma)
    centre = Omega * J - J * OmegaT
    first = Omega * shifted - shifted * OmegaT + rest
    second = centre + D / 2 * (Omega * Gamma - Gamma * OmegaT) + rest
    return first, second


@claim(
    "prop-1",
    r"\mathcal K_k = \Omega_{k-1}^T\mathcal K_{k-1}\Omega_{k-1},\ \Gamma_k = \Omega_{k-1}^T\Gamma_{k-1}\Omega_{k-1},"
    r"\ \mathcal K_k = \Omega_k(J+\tfrac D2\Gamma_k)-(J+\tfrac D2\Gamma_k)\Omega_k^T"
    r"+\tfrac D2(\Gamma_k\Omega_k-\Omega_k^T\Gamma_k)"
    r"\equiv M_k+\tfrac D2(\Omega_k\Gamma_k-\Gamma_k\Omega_k^T)+\tfrac D2(\Gamma_k\Omega_k-\Omega_k^T\Gamma_k)",
    uses=["4.10", "4.11"],
)
def compact_form(p: Proof) -> None:
    """The closed equation is the conservation of one momentum, for every n."""
    p.assume("Γ is even in γ: (4.12) fixes γ_k up to a common sign, and (4.11) fixes the sign")
    p.say("The balance splits into a part with R_{k+1} and a part with R_{k-1}. In the symbols of their own steps:")
    now, before = ball.split_balance()
    p.show("part of the step k", now)
    p.show("part of the step k-1", before)
    first, second = printed_forms()
    p.printed(
        equation("(4.13), first form = the part of the step k", first, now),
        equation("(4.13), second form = the part of the step k", second, now),
        equation("the part of the step k-1 = -Ωᵀ𝒦_{k-1}Ω", before, -ball.carried(now)),
    )
    p.say("So 𝒦_k - Ωᵀ𝒦_{k-1}Ω is the balance itself: (4.12) and (4.10) say the same.")
    p.lemma(equation("Γ_k = ΩᵀΓ_{k-1}Ω from (4.11)", OmegaT * ball.gamma * ball.gammaT * Omega, ball.carried(Gamma)))
    p.lemma(equation("𝒦ᵀ = -𝒦", ALGEBRA.transpose(now), -now))
    mutated = first - D * (Gamma * Omega - OmegaT * Gamma)
    p.control(equation("the first form with -D/2 in its last term", mutated, now))
    p.control(equation("the first form with D in the place of D/2", first.subs(D, 2 * D), now))
    p.control(equation("the part of the step k-1 = -Ω𝒦Ωᵀ", before, -Omega * now * OmegaT))


@claim(
    "prop-2",
    r"\mathrm{tr}\,\mathcal K^s,\ \mathrm{tr}(\mathcal K^s\Gamma^l),\ \mathrm{tr}\,\Gamma = 1 "
    r"\text{ are preserved by every branch},\ s = 2,4,\dots,\ l\in\mathbb N",
    uses=["prop-1"],
)
def trace_integrals(p: Proof) -> None:
    """The trace integrals, for every n, every s and l, and whatever the branch."""
    X, XT, Y, YT = matrix_symbols("X X^T Y Y^T")
    algebra = WordAlgebra({**ALGEBRA.transposes, X: XT, XT: X, Y: YT, YT: Y}, ALGEBRA.rules)

    def carried(expr: sp.Expr) -> sp.Expr:
        return OmegaT * expr * Omega

    p.say("The only fact about the step is (4.12): 𝒦_k = Ωᵀ𝒦_{k-1}Ω, Γ_k = ΩᵀΓ_{k-1}Ω with ΩΩᵀ = 1.")
    p.lemma(
        equation("carrying is multiplicative: (ΩᵀXΩ)(ΩᵀYΩ) = ΩᵀXYΩ", carried(X) * carried(Y), carried(X * Y), algebra)
    )
    p.lemma(equation("it fixes the identity", carried(sp.S.One), sp.S.One, algebra))
    p.say("By induction (𝒦_k)^s(Γ_k)^l = Ωᵀ(𝒦_{k-1})^s(Γ_{k-1})^lΩ for all s, l; and the trace does not see Ω:")
    trace_free = equation("tr ΩᵀXΩ = tr X", algebra.trace(carried(X)), algebra.trace(X), algebra)
    p.lemma(trace_free)
    for s, l in [(2, 0), (2, 1), (2, 2), (4, 0), (4, 1), (6, 3)]:
        word = carried(K) ** s * carried(Gamma) ** l
        p.printed(equation(f"tr 𝒦^{s}Γ^{l}", algebra.trace(word), algebra.trace(K**s * Gamma**l), algebra))
    p.printed(equation("tr Γ", algebra.trace(carried(Gamma)), algebra.trace(Gamma), algebra))
    p.say("tr Γ = |γ|² = 1 by the choice of γ. Odd s give 0, as 𝒦 is skew and Γ symmetric, for l = 0.")
    p.control(
        equation("tr 𝒦²Γ with Γ_k = ΩΓΩᵀ", algebra.trace(carried(K) ** 2 * Omega * Gamma * OmegaT),
                 algebra.trace(K**2 * Gamma), algebra)
    )  # fmt: skip
    p.control(equation("tr ΩXΩ = tr X", algebra.trace(Omega * X * Omega), algebra.trace(X), algebra))


if __name__ == "__main__":
    main(__file__)
