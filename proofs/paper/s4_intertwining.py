"""Section 4: the intertwining relations of Remark 3."""

import sympy as sp

from chapsym.derive import ball, three
from chapsym.derive.ball import ALGEBRA, D, Gamma, J, Omega, OmegaT
from chapsym.derive.words import evaluate
from chapsym.proofs import second_routes
from chapsym.proofs.glossary import Symbols
from chapsym.prove import Equation, Proof, claim, equations, main

equation = equations(ALGEBRA)


def one_step_symbols() -> Symbols:
    """The symbols of one step: its rotation and its vertical (Remark 3)."""
    return {
        "J": (ball.J, "the mass tensor, diagonal (4.1)"),
        "D": (ball.D, "mρ² (4.13)"),
        r"\Omega_{k-1}": (ball.Omega, "the rotation of the step, in the body (4.6)"),
        r"\Gamma_{k-1}": (ball.Gamma, "γγᵀ before the step (4.9)"),
        r"\Gamma_k": (ball.carried(ball.Gamma), "ΩᵀΓΩ: γγᵀ after the step (4.11)"),
    }


def printed_relations(sign: int = 1) -> tuple[sp.Expr, sp.Expr]:
    """The right sides of the relations for 𝒦_{k-1} and 𝒦_k; `sign` mutates the term of Γ_k."""
    mean = J + D / 2 * (Gamma + sign * ball.carried(Gamma))
    return Omega * mean - mean * OmegaT, mean * Omega - OmegaT * mean


def entries(expr: sp.Expr) -> list[sp.Expr]:
    """The nine entries of the relation for n = 3, in Euler parameters."""
    rotation = sp.Matrix(three.rotation())
    values = {Omega: rotation, OmegaT: rotation.T, J: three.J, Gamma: three.gamma * three.gamma.T, D: three.D}
    return list(evaluate(expr, values))


@claim(
    "remark-3",
    r"\mathcal K_{k-1} = \Omega_{k-1}(J+\tfrac D2(\Gamma_{k-1}+\Gamma_k)) - (J+\tfrac D2(\Gamma_{k-1}+\Gamma_k))"
    r"\Omega_{k-1}^T,\ \mathcal K_k = (J+\tfrac D2(\Gamma_{k-1}+\Gamma_k))\Omega_{k-1} "
    r"- \Omega_{k-1}^T(J+\tfrac D2(\Gamma_{k-1}+\Gamma_k))",
    uses=["prop-1"],
)
def intertwining(p: Proof) -> None:
    """The subsequent momenta intertwine, for every n and entry by entry for n = 3."""
    momentum = ball.momentum()
    p.say("𝒦_{k-1} in Ω = Ω_{k-1}, Γ = Γ_{k-1}; Γ_k = ΩᵀΓΩ; ΩΩᵀ = ΩᵀΩ = 1:")
    p.show("𝒦_{k-1}", momentum)
    p.show("𝒦_k = Ωᵀ𝒦_{k-1}Ω", ball.carried(momentum))
    p.reads(
        one_step_symbols(),
        (r"\mathcal K_{k-1}", momentum, "𝒦 of the step (4.13), by the derivation"),
        (r"\mathcal K_k", ball.carried(momentum), "Ωᵀ𝒦_(k-1)Ω (4.12)"),
    )
    before, after = printed_relations()
    p.show("right side for 𝒦_{k-1}", ALGEBRA.normal(before))
    p.show("right side for 𝒦_k", ALGEBRA.normal(after))
    p.printed(
        equation("the relation for 𝒦_{k-1}, every n", before, momentum),
        equation("the relation for 𝒦_k, every n", after, ball.carried(momentum)),
    )
    p.say("For n = 3 the same with the matrix of Euler parameters, modulo |q|² + q₀² = 1:")
    p.lemma(Equation("the relation for 𝒦_{k-1}, n = 3, nine entries", entries(before), entries(momentum), three.RING))
    carried = entries(ball.carried(momentum))
    p.lemma(Equation("the relation for 𝒦_k, n = 3, nine entries", entries(after), carried, three.RING))
    wrong_before, wrong_after = printed_relations(sign=-1)
    p.control(equation("the relation for 𝒦_{k-1} with Γ_{k-1} - Γ_k", wrong_before, momentum))
    p.control(equation("the relation for 𝒦_k with Γ_{k-1} - Γ_k", wrong_after, ball.carried(momentum)))
    p.control(Equation("the two relations exchanged, n = 3", entries(after), entries(momentum), three.RING))
    p.route(
        "from (4.13) as printed, Ω the Cayley transform of a free skew matrix, n = 3 and n = 4",
        *second_routes.intertwining(3),
        *second_routes.intertwining(4),
    )
    for text, relations in [
        ("Γ_{k-1} - Γ_k", second_routes.intertwining(3, sign=-1)),
        ("the momenta exchanged", second_routes.intertwining(3, swapped=True)),
    ]:
        for time, relation in zip(("k-1", "k"), relations, strict=True):
            p.control(second_routes.mutated(f"n = 3: the relation for 𝒦_{{{time}}} with {text}", relation))


if __name__ == "__main__":
    main(__file__)
