"""Self-adjointness, on which compositions and reversal rest: with its ends swapped and ε reversed a step is undone.

The paper does not state this.  It follows from the symmetry of the discrete Lagrangian and the discrete constraint
under exchange of the ends of a step.
"""

import sympy as sp

from chapsym.derive import ball, principle, three
from chapsym.derive.ball import ALGEBRA, D, Gamma, K, Omega, OmegaT, gamma
from chapsym.derive.derivation import replaced
from chapsym.derive.principle import R1, R, r, r1
from chapsym.derive.words import Traces, WordAlgebra, matrix_symbols, unfolded
from chapsym.proofs import second_routes
from chapsym.prove import Equation, Identity, Proof, Theorem, claim, equations, main

equation = equations(ALGEBRA)


#: The reversed step: Ωᵀ replaces Ω, and the vertical is that at the end of the step.
RETURN = ALGEBRA.with_transposes({Omega: OmegaT, Gamma: OmegaT * Gamma * Omega, gamma: OmegaT * gamma})


def with_ends_swapped(expr: sp.Expr, vertical: sp.Expr = RETURN[Gamma]) -> sp.Expr:
    """The same function of the reversed step."""
    return ALGEBRA.normal(unfolded(expr).xreplace({Omega: OmegaT, OmegaT: Omega, Gamma: vertical}))


def momentum_back() -> sp.Symbol:
    """𝒦 of the reversed step, as a step of the certificate."""
    return replaced("momentum_back", "Ωᵀ for Ω and γ_+ = Ωᵀγ for γ", ball.momentum(), RETURN, ball.BOTH)


def vector_with_ends_swapped() -> sp.Matrix:
    """𝒦(q₀, -q, Ωᵀγ) for n = 3."""
    back = {three.q1: -three.q1, three.q2: -three.q2, three.q3: -three.q3}
    there = dict(zip(three.gamma, three.transported(three.gamma), strict=True))
    return sp.Matrix(three.momentum()).xreplace({**back, **there})


def in_free_parameters(n: int, sign: int = -1, last: int = 1) -> Identity:
    """𝒦(Ωᵀ, Ωᵀγ) = sign·Ωᵀ𝒦(Ω, γ)Ω from (4.13), Ω the Cayley transform of a free skew matrix; `last` mutates (4.13)."""
    turn, vertical, tensor, contact = second_routes.free_step(n)
    there = second_routes.momentum(turn, tensor, vertical, contact, last)
    back = second_routes.momentum(turn.T, tensor, turn.T @ vertical, contact, last)
    return second_routes.identity(f"n = {n}: 𝒦(Ωᵀ, Ωᵀγ) = -Ωᵀ𝒦(Ω, γ)Ω", back, sign * turn.T @ there @ turn)


BACK = "the step back takes the rotation Ωᵀ among those with its momentum"
SMALL = "on the small branch below its bound it does"


@claim(
    "self-adjoint",
    r"\mathcal K(\Omega^T, \Omega^T\gamma) = -\Omega^T\mathcal K(\Omega, \gamma)\Omega;"
    r"\ \Phi_{-\varepsilon}\circ\Phi_\varepsilon = 1",
    uses=["prop-1", "4.1", "4.9", "small-branch"],
)
def self_adjoint(p: Proof) -> None:
    """The step with ε reversed undoes the step, for every n and entry by entry for n = 3."""
    p.assume(
        "the step back takes the rotation Ωᵀ among those with its momentum; on the small-rotation branch it does where "
        "|𝒦| is below the bound of small-branch, which does not depend on γ"
    )
    p.state(Theorem((), (BACK,), ("Φ_{-ε}∘Φ_ε = 1, every n", SMALL)))
    p.say("Φ_ε: (K, γ) ↦ (ΩᵀKΩ, Ωᵀγ), and in space R ↦ RΩ, r ↦ r + Δr by (4.9), with Ω from 𝒦(Ω, γ) = εK.")
    p.say("The Lagrangian (4.1) and the constraint (4.9) do not know which end is first:")
    factor, both = principle.kinetic_factor(), principle.ALGEBRA
    forth, back = (principle.lagrangian(factor, *x) for x in ((R, R1, r, r1), (R1, R, r1, r)))
    p.lemma(equation("𝕃 with its ends exchanged is 𝕃", back, forth, Traces(both)))
    forth, back = (principle.discrete_constraint(*x) for x in ((R, R1, r, r1), (R1, R, r1, r)))
    p.lemma(equation("(4.9) with its ends exchanged is -(4.9)", back, -forth, both))
    p.say("Nor does 𝒦, up to its sign and to the frame; the step back has Ωᵀ and starts at Γ_+ = ΩᵀΓΩ:")
    momentum = ball.momentum()
    p.show("𝒦(Ω, Γ)", momentum)
    p.show("𝒦(Ωᵀ, Γ_+)", momentum_back())
    p.printed(equation("𝒦(Ωᵀ, Γ_+) = -Ωᵀ𝒦(Ω, Γ)Ω, every n", momentum_back(), -ball.carried(momentum)))
    p.say("With 𝒦(Ω, Γ) = εK the right side is -εK_+: so Φ_{-ε} at the end of the step has the solution Ωᵀ, and takes")
    p.printed(
        equation("K_+ = ΩᵀKΩ to ΩK_+Ωᵀ = K", Omega * (OmegaT * K * Omega) * OmegaT, K),
        equation("γ_+ = Ωᵀγ to Ωγ_+ = γ", Omega * (OmegaT * gamma), gamma),
    )
    p.say("and RΩ to RΩΩᵀ = R, and r by the opposite of Δr.")
    p.step("Φ_{-ε}∘Φ_ε = 1, every n", BACK, "prop-1", "4.1", "4.9")
    p.say(
        "Ω and Ωᵀ turn by one angle: with small-branch, Ωᵀ is the small rotation back where Ω is the one there.  Beyond"
    )
    p.say("its bound, just before a fold, it need not be.")
    p.step(SMALL, "small-branch")
    p.say("For n = 3 in Euler parameters, where Ωᵀ has -q:")
    carried = three.transported(sp.Matrix(three.momentum()))
    p.printed(Equation("𝒦⃗(q₀, -q, Ωᵀγ) = -Ωᵀ𝒦⃗(q₀, q, γ), n = 3", vector_with_ends_swapped(), -carried, three.RING))
    p.control(equation("𝒦(Ωᵀ, Γ_+) = +Ωᵀ𝒦(Ω, Γ)Ω", momentum_back(), ball.carried(momentum)))
    p.control(
        equation("the same with Γ in the place of Γ_+", with_ends_swapped(momentum, Gamma), -ball.carried(momentum))
    )
    # (4.13) mutated: the contact term with Γ at the start, instead of the mean over both ends.
    lopsided = ball.centre_momentum() + D * (Omega * Gamma - Gamma * OmegaT)
    p.control(equation("the same for ΩJ - JΩᵀ + D(ΩΓ - ΓΩᵀ)", with_ends_swapped(lopsided), -ball.carried(lopsided)))
    p.control(Equation("n = 3, with +Ωᵀ𝒦⃗", vector_with_ends_swapped(), carried, three.RING))
    p.route(
        "from (4.13) as printed, Ω the Cayley transform of a free skew matrix, n = 3 and n = 4",
        in_free_parameters(3),
        in_free_parameters(4),
    )
    p.control(second_routes.mutated("n = 3: with +Ωᵀ𝒦Ω", in_free_parameters(3, sign=1)))
    p.control(second_routes.mutated("n = 3: with (4.13) mutated", in_free_parameters(3, last=-1)))


@claim(
    "reversible",
    r"\varrho\Phi\varrho = \Phi^{-1} \text{ for } \varrho(\mathcal K, \gamma) = (-\mathcal K, \gamma)",
    uses=["self-adjoint"],
)
def reversible(p: Proof) -> None:
    """With the momentum reversed the ball rolls back over the states it came by, for every n."""
    p.assume("the step back takes the rotation Ωᵀ, as in self-adjoint")
    back = "ϱΦϱ = Φ⁻¹ for ϱ(𝒦, γ) = (-𝒦, γ), every n, and for a composition with c_i = c_{s+1-i}"
    p.state(Theorem((), (BACK,), (back,)))
    p.say("Φ: (𝒦, γ) ↦ (𝒦_+, γ_+) = (Ωᵀ𝒦Ω, Ωᵀγ) with 𝒦(Ω, γ) = 𝒦. From ϱ(𝒦_+, γ_+) = (-𝒦_+, γ_+) the step has Ωᵀ:")
    momentum = ball.momentum()
    p.printed(equation("𝒦(Ωᵀ, Γ_+) = -𝒦_+", momentum_back(), -ball.carried(momentum)))
    p.say("so that it leads to ϱ(𝒦, γ), with the attitude RΩΩᵀ = R:")
    p.printed(
        equation("Ω(-𝒦_+)Ωᵀ = -𝒦", Omega * (-OmegaT * K * Omega) * OmegaT, -K),
        equation("Ωγ_+ = γ", Omega * (OmegaT * gamma), gamma),
    )
    p.say("ϱϱ = 1, so ϱΦϱΦ = 1; and a composition with c_i = c_{s+1-i} inherits it, stage by stage.")
    p.step(back, BACK, "self-adjoint")
    p.say("The sign of γ is no reversal: 𝒦 depends on Γ = γγᵀ alone.")
    p.control(equation("ϱ(𝒦, γ) = (𝒦, -γ): 𝒦(Ωᵀ, Γ_+) = 𝒦_+", momentum_back(), ball.carried(momentum)))
    p.control(equation("the step back with Ω: Ωᵀ(-𝒦_+)Ω = -𝒦", OmegaT * (-OmegaT * K * Omega) * Omega, -K))


@claim(
    "momentum-integrals-composed",
    r"\Phi_{c_s\varepsilon}\circ\dots\circ\Phi_{c_1\varepsilon} \text{ preserves } \mathrm{tr}\,K^s,"
    r"\ \mathrm{tr}(K^s\Gamma^l),\ \mathrm{tr}\,\Gamma \text{ for every } c \text{ and every branch}",
    uses=["prop-2"],
)
def composed_integrals(p: Proof) -> None:
    """A composition keeps the trace integrals whatever its coefficients, for every n."""
    X, XT, Y, YT, S, ST = matrix_symbols("X X^T Y Y^T S S^T")
    algebra = WordAlgebra({**ALGEBRA.transposes, X: XT, Y: YT, S: ST}, {**ALGEBRA.rules, (S, ST): 1, (ST, S): 1})
    equation, trace = equations(algebra), algebra.trace

    def carried(expr: sp.Expr) -> sp.Expr:
        """An expression carried by two stages, with the rotations Ω and S."""
        return ST * OmegaT * expr * Omega * S

    p.say("The stage with c finds Ω from 𝒦(Ω, γ) = cεK and carries K itself: K ↦ ΩᵀKΩ, Γ ↦ ΩᵀΓΩ. Two stages, Ω and S:")
    p.printed(
        equation("(ΩS)ᵀ(ΩS) = 1: two turns are one", carried(sp.S.One), 1),
        equation("(SᵀΩᵀXΩS)(SᵀΩᵀYΩS) = SᵀΩᵀXYΩS", carried(X) * carried(Y), carried(X * Y)),
        equation("tr SᵀΩᵀXΩS = tr X", trace(carried(X)), trace(X)),
    )
    p.say("By induction every trace of words in K and Γ is kept, over any number of stages; among them")
    for s, l in [(2, 0), (2, 1), (4, 0), (4, 1)]:
        word = carried(K) ** s * carried(Gamma) ** l
        p.printed(equation(f"tr K^{s}Γ^{l}", trace(word), trace(K**s * Gamma**l)))
    stray = carried(K) ** 2 * OmegaT * Gamma * Omega
    p.control(equation("tr K²Γ with K after two stages and Γ after one", trace(stray), trace(K**2 * Gamma)))
    p.control(equation("tr SᵀΩXΩS = tr X", trace(ST * Omega * X * Omega * S), trace(X)))


if __name__ == "__main__":
    main(__file__)
