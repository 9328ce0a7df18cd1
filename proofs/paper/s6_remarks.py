"""Section 6: the energy for vertical momentum, and the symmetries of the discrete system."""

import sympy as sp

from chapsym.derive import continuous, principle, three, vertical
from chapsym.derive.principle import ALGEBRA, R1, R, r, r1
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import D, K
from chapsym.derive.vertical import RING, h
from chapsym.derive.words import Traces, WordAlgebra, matrix_symbols
from chapsym.prove import Equation, Proof, claim, main


@claim(
    "6-vertical-energy",
    r"\text{in the case } \mathcal K\parallel\gamma \text{ the energy is preserved}:\ E_{k+1} = E_k",
    ["prop-3", "2.5"],
)
def vertical_energy(p: Proof) -> None:
    """For vertical momentum the energy is a function of the integral l and of h."""
    p.infers("For 𝒦 = hγ the energy is a function of h and l, and both are kept by every branch.")
    p.assume("the energy is (2.5), as corrected or as printed; prop-3 needs σ ≠ 0, as there")
    form = three.gamma.dot(continuous.inverse_inertia() * three.gamma)
    on_vertical = dict(zip(K, h * three.gamma, strict=True))
    ring = Quotient((h, *three.RING.symbols), three.RING.relations)
    energy = 2 * continuous.energy().xreplace(on_vertical)
    quadratic = K.dot(continuous.inverse_inertia() * K).xreplace(on_vertical)
    p.printed(Equation("𝒦 = hγ: ⟨𝒦,ω⟩ = h²l/(1 - Dl), l = ⟨γ,Λ⁻¹γ⟩", energy, h**2 * form / (1 - D * form), ring))
    p.lemma(
        Equation(
            "(2.5) as printed: h²l(1 - 2Dl)/(1 - Dl)",
            2 * quadratic - energy,
            h**2 * form * (1 - 2 * D * form) / (1 - D * form),
            ring,
        )
    )
    inverse = continuous.inverse_inertia()
    now, after = (x.dot(inverse * x) for x in (vertical.gamma_now(), vertical.gamma_next()))
    at = Quotient((h, *RING.symbols), RING.relations)
    before, later = (h**2 * level / (1 - D * level) for level in (now, after))
    meaning = "h²l/(1 - Dl), ⟨𝒦,ω⟩ for 𝒦 = hγ"
    p.reads({"E_k": (before, f"{meaning}, before a step"), "E_{k+1}": (later, f"{meaning}, after it")})
    p.printed(Equation("h²l/(1 - Dl) at γ~ is that at γ, for every branch", later, before, at))
    p.control(Equation("𝒦 = hγ: ⟨𝒦,ω⟩ = h²l", energy, h**2 * form, ring))
    wrong = vertical.gamma_next().dot(three.lam() * vertical.gamma_next())
    p.control(Equation("⟨γ,Λγ⟩ is kept", wrong, vertical.gamma_now().dot(three.lam() * vertical.gamma_now()), RING))


@claim(
    "6-LR",
    r"\mathbb L \text{ is left-invariant and (4.9) right-invariant under } SO(n)\times\mathbb R^n: \text{a discrete LR system}",
    ["4.1", "4.9"],
)
def left_right(p: Proof) -> None:
    """The discrete Lagrangian is left-invariant, the discrete constraint right-invariant, for every n."""
    p.infers("That such a Lagrangian with such a constraint is called a discrete LR system is a definition.")
    p.assume(
        "the group is the direct product SO(n) × Rⁿ: (S, a) acts by (SR, a + r) from the left, (RS, r + a) from the right"
    )
    S, ST, a, aT = matrix_symbols("S S^T a a^T")
    algebra = WordAlgebra({**ALGEBRA.transposes, S: ST, a: aT}, {**ALGEBRA.rules, (S, ST): 1, (ST, S): 1})
    left, right = (algebra.with_transposes(places) for places in ({R: S * R, R1: S * R1}, {R: R * S, R1: R1 * S}))
    moved = algebra.with_transposes({r: r + a, r1: r1 + a})

    def lagrangian(places: dict, factor: sp.Expr) -> sp.Expr:
        """The matrix whose trace is 𝕃 after the action."""
        return principle.lagrangian(factor, R, R1, r, r1).xreplace({**places, **moved})

    def constraint(places: dict) -> sp.Expr:
        return sp.expand(principle.discrete_constraint(R, R1, r, r1).xreplace({**places, **moved}))

    for name, factor in (("as corrected", principle.kinetic_factor()), ("as printed", sp.Rational(1, 2))):
        here = principle.lagrangian(factor, R, R1, r, r1)
        p.printed(Equation(f"𝕃 {name} is left-invariant", lagrangian(left, factor), here, Traces(algebra)))
        p.control(Equation(f"𝕃 {name} is right-invariant", lagrangian(right, factor), here, Traces(algebra)))
    start = principle.discrete_constraint(R, R1, r, r1)
    p.printed(Equation("(4.9) is right-invariant", constraint(right), start, algebra))
    p.say("The forms of the distribution, δr + ρ δR Rᵀγ, are right-invariant, too: δR Rᵀ does not see R ↦ RS.")
    turn, shift = matrix_symbols("dR dr")
    form = principle.rolling_constraint(shift, turn)
    p.lemma(Equation("δr + ρ δR Rᵀγ is right-invariant", form.xreplace({**right, turn: turn * S}), form, algebra))
    p.control(Equation("(4.9) is left-invariant", constraint(left), start, algebra))


if __name__ == "__main__":
    main(__file__)
