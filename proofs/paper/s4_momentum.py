"""Section 4: the momentum about the contact point (Propositions 1 and 2)."""

import sympy as sp

from chapsym.derive import ball, principle, three
from chapsym.derive.ball import ALGEBRA, D, Gamma, J, K, Omega, OmegaT
from chapsym.derive.derivation import replaced
from chapsym.derive.words import Traces, WordAlgebra, matrix_symbols, unfolded
from chapsym.proofs import second_routes
from chapsym.proofs.paper.s4_principle import step_symbols
from chapsym.prove import Comparison, Equation, Proof, claim, equations, main

equation = equations(ALGEBRA)


def printed_forms() -> tuple[sp.Expr, sp.Expr]:
    """The two forms of (4.13)."""
    shifted = J + D / 2 * Gamma
    rest = D / 2 * (Gamma * Omega - OmegaT * Gamma)
    centre = Omega * J - J * OmegaT
    first = Omega * shifted - shifted * OmegaT + rest
    second = centre + D / 2 * (Omega * Gamma - Gamma * OmegaT) + rest
    return first, second


#: Words of a step in the attitudes at its ends; and those of the step before.
NOW, BEFORE = ball.in_attitudes(True), ball.in_attitudes(False)
#: The expression that vanishes along every path.
BALANCE = {"0": (ball.body_balance(), "the principle in the body, on the discrete constraint, by the derivation")}


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
    p.assume("𝕃 with the correction of (4.1)")
    p.assume("Γ is even in γ: (4.12) fixes γ_k up to a common sign, and (4.11) fixes the sign")
    p.reads(
        step_symbols(),
        (r"\mathcal K_k", ball.momentum_in_space(now=True), "𝒦 of the step k, by the derivation"),
        (r"\mathcal K_{k-1}", ball.momentum_in_space(now=False), "that of the step k-1"),
        BALANCE,
    )
    p.say("The balance splits into a part with R_{k+1} and a part with R_{k-1}. In the symbols of their own steps:")
    now, before = ball.split_balance()
    p.show("part of the step k", now)
    p.show("part of the step k-1", before)
    first, second = printed_forms()
    p.lemma(
        equation("(4.13), first form = the part of the step k", first, now),
        equation("(4.13), second form = the part of the step k", second, now),
        equation("the part of the step k-1 = -Ωᵀ𝒦_{k-1}Ω", before, -ball.carried(now)),
    )
    p.say("So 𝒦_k - Ωᵀ𝒦_{k-1}Ω is the balance itself: (4.12) and (4.10) say the same.")
    step = principle.R0T * principle.R
    carried = principle.RT * principle.R0 * ball.momentum_in_space(now=False) * step
    conserved = ball.momentum_in_space(now=True) - carried
    p.printed(
        Equation("𝒦_k - Ωᵀ𝒦_{k-1}Ω = the balance in the body", conserved, ball.body_balance(), ball.BOTH),
        *(Equation(f"(4.13), {name} form, in the attitudes", form.xreplace(NOW), ball.momentum_in_space(now=True), ball.BOTH)
          for name, form in (("first", first), ("second", second))),
    )  # fmt: skip
    turned = step * ball.momentum_in_space(now=False) * principle.RT * principle.R0
    p.control(
        Equation(
            "𝒦_k - Ω𝒦_{k-1}Ωᵀ = the balance in the body",
            ball.momentum_in_space(now=True) - turned, ball.body_balance(), ball.BOTH,
        )
    )  # fmt: skip
    p.lemma(equation("Γ_k = ΩᵀΓ_{k-1}Ω from (4.11)", OmegaT * ball.gamma * ball.gammaT * Omega, ball.carried(Gamma)))
    p.lemma(equation("𝒦ᵀ = -𝒦", ALGEBRA.transpose(now), -now))
    mutated = first - D * (Gamma * Omega - OmegaT * Gamma)
    p.control(equation("the first form with -D/2 in its last term", mutated, now))
    p.control(equation("the first form with D in the place of D/2", first.subs(D, 2 * D), now))
    p.control(equation("the part of the step k-1 = -Ω𝒦Ωᵀ", before, -Omega * now * OmegaT))
    p.route(
        "from the action to (4.13) in free parameters, every turn without the eigenvalue -1: "
        "n = 3 in any axes of space, n = 4 in those of the body where the step begins",
        *map(second_routes.principle, (3, 4)),
        *second_routes.conservation(3, any_axes=True),
        *second_routes.conservation(4, any_axes=False)[:1],
    )
    wrong = second_routes.conservation(3, any_axes=False, last=-1)[1]
    p.control(second_routes.mutated("n = 3: (4.12) with -D/2 in the last term of the first form", wrong))
    wrong = second_routes.conservation(3, any_axes=False, naive=True)[1]
    p.control(second_routes.mutated("n = 3: (4.12) for the naive constraint before (4.9)", wrong))


@claim(
    "prop-1-proof",
    r"M_k+\tfrac D2[\Omega_k\Gamma_k+\Gamma_k\Omega_k]-\tfrac D2[\Omega_k^T\Gamma_k+\Gamma_k\Omega_k^T]"
    r"=\Omega_{k-1}^TM_{k-1}\Omega_{k-1}+\tfrac D2[\Gamma_{k-1}\Omega_{k-1}+\Omega_{k-1}^T\Gamma_{k-1}\Omega_{k-1}^2]"
    r"-\tfrac D2[(\Omega_{k-1}^T)^2\Gamma_{k-1}\Omega_{k-1}+\Omega_{k-1}^T\Gamma_{k-1}]",
    uses=["4.10", "4.11"],
)
def inside_the_proof(p: Proof) -> None:
    """The display inside the proof of Proposition 1."""
    p.reads(step_symbols() | BALANCE)
    p.say("Left - right is the balance, in the attitudes; in the symbols of its own step each side is one part of it:")
    now, before = ball.split_balance()
    centre = Omega * J - J * OmegaT
    left = centre + D / 2 * (Omega * Gamma + Gamma * Omega) - D / 2 * (OmegaT * Gamma + Gamma * OmegaT)

    def right(sign: int = 1) -> sp.Expr:
        lifted = Gamma * Omega + OmegaT * Gamma * Omega**2 - sign * (OmegaT**2 * Gamma * Omega + OmegaT * Gamma)
        return ball.carried(centre) + D / 2 * lifted

    both = left.xreplace(NOW) - right().xreplace(BEFORE)
    p.printed(Equation("left - right = the balance in the body", both, ball.body_balance(), ball.BOTH))
    p.lemma(
        equation("the left side = the part of the balance that belongs to the step k", left, now),
        equation("the right side = minus the part that belongs to the step k-1", right(), -before),
    )
    p.control(equation("the right side with its last bracket added", right(-1), -before))


@claim(
    "4.14",
    r"M_k = \Omega_{k-1}^TM_{k-1}\Omega_{k-1},\ M_k = \Omega_kJ-J\Omega_k^T;\quad "
    r"M_{k-1} = \Omega_{k-1}J-J\Omega_{k-1}^T,\ M_k = J\Omega_{k-1}-\Omega_{k-1}^TJ",
    uses=["prop-1"],
)
def discrete_euler_top(p: Proof) -> None:
    """The discrete Euler top is the case D = 0, with its intertwining relations."""

    def without(name: str, of: sp.Symbol) -> sp.Symbol:
        return replaced(name, "for D = 0", of, {D: sp.S.Zero}, ball.BOTH)

    balance = without("top_balance", ball.body_balance())
    now, before = (without(f"top_{i}", ball.momentum_in_space(now=not i)) for i in range(2))
    p.reads(
        step_symbols(),
        ("M_k", now, "𝒦_k for D = 0, by the derivation"),
        ("M_{k-1}", before, "𝒦_(k-1) for D = 0, by the derivation"),
        ("0", balance, "the principle in the body for D = 0, by the derivation"),
    )
    centre, swapped = Omega * J - J * OmegaT, J * Omega - OmegaT * J
    step, back = principle.R0T * principle.R, principle.RT * principle.R0
    own = equations(ball.BOTH)
    p.printed(
        own("M_k - Ω_{k-1}ᵀM_{k-1}Ω_{k-1} is the balance at D = 0", now - back * before * step, balance),
        own("𝒦_k at D = 0 is M_k = Ω_kJ - JΩ_kᵀ", now, centre.xreplace(NOW)),
        own("𝒦_{k-1} at D = 0 is M_{k-1}, that a step before", before, centre.xreplace(BEFORE)),
        own("M_k - (JΩ_{k-1} - Ω_{k-1}ᵀJ) is the balance", now - swapped.xreplace(BEFORE), balance),
    )
    p.lemma(equation("Ωᵀ(ΩJ - JΩᵀ)Ω = JΩ - ΩᵀJ", ball.carried(centre), swapped))
    p.control(equation("Ωᵀ(ΩJ - JΩᵀ)Ω = ΩJ - JΩᵀ", ball.carried(centre), centre))


@claim("4.13-multivalued", r"\text{(4.13), in general, has several solutions } \Omega_k", uses=["prop-1"])
def several_solutions(p: Proof) -> None:
    """Two rational rotations with the same momentum at the same vertical, for a ball with D > 0."""
    p.infers("In general: shown by one example, and so for all that are near it.")
    p.say("n = 3: turns about e₁ with cos θ = ±7/25, sin θ = 24/25, at γ = e₂, J = (1,2,4), D = 8, by Euler parameters")
    first, second = (three.q0, *three.q), sp.symbols("p0:4")
    values = three.placed(
        (first, ("4/5", "3/5", 0, 0)), (second, ("3/5", "4/5", 0, 0)), (three.gamma, (0, 1, 0)),
        ((three.J1, three.J2, three.J3, three.D), (1, 2, 4, 8)),
    )  # fmt: skip
    at = {symbol: sp.Rational(value) for symbol, value in values.items()}
    momentum = sp.Matrix(three.momentum())
    other = momentum.xreplace(dict(zip(first, second, strict=True)))
    p.show("𝒦 of the first", momentum.xreplace(at))
    p.printed(
        Comparison("both are rotations", [sp.Eq(sum(x**2 for x in turn), 1) for turn in (first, second)], at),
        Comparison("they differ: q₀² = ¼(1 + tr Ω)", [sp.Ne(first[0] ** 2, second[0] ** 2)], at),
        Comparison("(4.13) gives the same 𝒦⃗", [sp.Eq(a, b) for a, b in zip(momentum, other, strict=True)], at),
    )
    p.witness("generic", {"Ω": "a turn about e1 by cos θ = ±7/25, sin θ = 24/25", "γ": "e2", "J": "(1,2,4)", "D": "8"})
    p.lemma(Comparison("𝒦⃗ is not 0", [sp.Ne(momentum[0], 0)], at))
    X, XT = matrix_symbols("X X^T")
    other = unfolded(ball.momentum()).xreplace({Omega: X, OmegaT: XT})
    algebra = WordAlgebra({**ALGEBRA.transposes, X: XT}, {**ALGEBRA.rules, (X, XT): 1, (XT, X): 1})
    p.control(equation("any two rotations have the same 𝒦", other, ball.momentum(), algebra))


@claim(
    "prop-2",
    r"\mathrm{tr}\,\mathcal K_k^s = \mathrm{tr}\,\mathcal K_{k-1}^s,\ "
    r"\mathrm{tr}(\mathcal K_k^s\Gamma_k^l) = \mathrm{tr}(\mathcal K_{k-1}^s\Gamma_{k-1}^l),\ "
    r"\mathrm{tr}\,\Gamma \text{ stays 1, for every branch and all even } s \text{ and natural } l",
    uses=["prop-1"],
)
def trace_integrals(p: Proof) -> None:
    """The trace integrals, for every n, every s and l, and whatever the branch."""
    p.infers("By induction on the exponents, for every s and l. Odd powers of a skew matrix have the trace 0.")
    X, XT, Y, YT = matrix_symbols("X X^T Y Y^T")
    algebra = WordAlgebra({**ALGEBRA.transposes, X: XT, Y: YT}, ALGEBRA.rules)
    carried = ball.carried
    p.say("The only fact about the step is (4.12): 𝒦_k = Ωᵀ𝒦_{k-1}Ω, Γ_k = ΩᵀΓ_{k-1}Ω with ΩΩᵀ = 1.")
    p.lemma(
        equation("carrying is multiplicative: (ΩᵀXΩ)(ΩᵀYΩ) = ΩᵀXYΩ", carried(X) * carried(Y), carried(X * Y), algebra)
    )
    p.lemma(equation("it fixes the identity", carried(sp.S.One), 1, algebra))
    p.say("By induction (𝒦_k)^s(Γ_k)^l = Ωᵀ(𝒦_{k-1})^s(Γ_{k-1})^lΩ for all s, l; and the trace does not see Ω:")
    traces = Traces(algebra)
    p.reads(
        (r"\mathcal K_{k-1}^s", X, "any matrix in its place"),
        (r"\mathcal K_k^s", carried(X), "Ωᵀ𝒦_(k-1)^sΩ, as carrying is multiplicative"),
        (r"\Gamma_{k-1}^l", Y, "any matrix in its place"),
        (r"\Gamma_k^l", carried(Y), "ΩᵀΓ_(k-1)^lΩ, as carrying is multiplicative"),
    )
    p.printed(
        equation("tr ΩᵀXΩ = tr X", carried(X), X, traces),
        equation("tr (ΩᵀXΩ ΩᵀYΩ) = tr XY", carried(X) * carried(Y), X * Y, traces),
        equation("tr Γ", carried(Gamma), Gamma, traces),
    )
    p.say("tr Γ = |γ|² = 1 by the choice of γ. Odd s give 0, as 𝒦 is skew and Γ symmetric, for l = 0:")
    p.lemma(equation("tr 𝒦³ = 0", K**3, 0, traces))
    p.control(equation("tr 𝒦²Γ with Γ_k = ΩΓΩᵀ", carried(K) ** 2 * Omega * Gamma * OmegaT, K**2 * Gamma, traces))
    p.control(equation("tr ΩXΩ = tr X", Omega * X * Omega, X, traces))


if __name__ == "__main__":
    main(__file__)
