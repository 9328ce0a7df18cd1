"""Section 5: vertical momentum, the reduced map G_h and its integral (Proposition 3)."""

from dataclasses import replace

import sympy as sp

from chapsym.derive import continuous, three, vertical
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import J1, J2, J3, D, gamma, q, q0, q1, q2, q3
from chapsym.derive.vertical import RING, h, sigma
from chapsym.proofs import glossary, second_routes
from chapsym.proofs.glossary import Symbols
from chapsym.proofs.paper.s5_rotation import half_momentum
from chapsym.prove import Equation, Point, Proof, claim, equations, main, rational_point

equation = equations(RING)

#: Two rational states with 𝒦 = hγ of physical balls (J ≥ 0, tr J ≤ D), found by search, with rotation angles below and
#: above 90°.
SMALL = {q0: "4/5", q1: "2/5", q2: "1/5", q3: "2/5", J1: 1, J2: 5, J3: 2, D: 14, sigma: "484/25"}
LARGE = {q0: "1/5", q1: "2/5", q2: "2/5", q3: "4/5", J1: 1, J2: 2, J3: 4, D: 10, sigma: "148/25"}


#: ⟨q, left⟩ = 2q₀⟨q, Λq⟩ and left(q₀ = 0) = 2 q×Λq leave 𝒦 = 0 when the left side vanishes: see prop-3.
NOT_ZERO = "σ ≠ 0, which h ≠ 0 implies for a real q: σ = 0 makes the left side of (5.4) vanish, and then 𝒦 = hγ = 0"


def vertical_state() -> list[Equation]:
    """The conditions for (q, σ) to be a state with 𝒦 = hγ: unit Euler parameters, and |γ| = 1 for γ = left/σ."""
    return [
        equation("|q|² + q₀² = 1", q0**2 + q.dot(q), 1),
        equation("|γ| = 1", vertical.gamma_now().dot(vertical.gamma_now()), 1),
    ]


def vertical_symbols() -> Symbols:
    """The symbols for vertical momentum (Section 5): γ and γ~ in terms of q and σ."""
    return {
        **{name: glossary.ball()[name] for name in (r"\Lambda", "D", r"\mathbf q", "q_0")},
        r"\sigma": (sigma, "h + 2D⟨γ, q₀q⟩ (5.6 as corrected)"),
        r"\gamma": (sp.Matrix(vertical.gamma_now()), "(2/σ)(q₀Λq + q×Λq), the vertical in the body (5.6)"),
        r"\tilde\gamma": (sp.Matrix(vertical.gamma_next()), "(2/σ)(q₀Λq - q×Λq), the next vertical (5.6)"),
        "h": (vertical.height(), "of 𝒦 = hγ: here σ - 2D⟨γ, q₀q⟩ (5.4)"),
    }


def vertical_point(state: dict) -> Point:
    """The state as a point, with the values γ, γ~ and h that follow from it."""
    point = rational_point(state, vertical_state())
    here, there = (point.evaluate(x) for x in (vertical.gamma_now(), vertical.gamma_next()))
    seen = {"γ": f"({', '.join(map(str, here))})", "γ~": f"({', '.join(map(str, there))})"}
    return replace(point, values={**point.values, **seen, "h": str(point.evaluate(vertical.height()))})


def printed_vector(sign: int) -> sp.Matrix:
    """The vector of (5.6) as printed, without 2/σ; `sign` is that of the second terms."""
    return half_momentum(J1 + D / 2, J2 + D / 2, J3 + D / 2, sign)


@claim(
    "5.4",
    r"\text{for } \vec{\mathcal K} \parallel \gamma:\quad 2(\dots)^T = [h + D q_0\langle\gamma,\mathbf q\rangle]\gamma,"
    r"\ \widehat J = J + \tfrac D2 I",
    uses=["5.2"],
)
def vertical_relation(p: Proof) -> None:
    """The relation between γ and q when the momentum is vertical: a factor 2 is missing."""
    p.slips("serious")
    p.reads(
        glossary.ball(),
        ("h", h, "of 𝒦 = hγ (5.4)"),
        (r"(\dots)^T", printed_vector(+1), "the vector that is printed"),
        (r"\widehat J", sp.diag(J1, J2, J3) + D / 2 * sp.eye(3), "J + (D/2) I (5.4)"),
        ("J", sp.diag(J1, J2, J3), "the mass tensor (5.2)"),
        ("I", sp.eye(3), "the unit matrix"),
        ("0", sp.Matrix(three.momentum()) - h * gamma, "𝒦 - hγ, which vanishes"),
    )
    p.assume("|γ| = 1, |q|² + q₀² = 1", *three.UNITS)
    p.assume("the equations are judged modulo 𝒦 - hγ = 0")
    ring = Quotient((h, *three.RING.symbols), three.RING.relations)
    left = 2 * printed_vector(+1)
    p.lemma(Equation("the left side: 𝒦 of a ball with Ĵ and D = 0", left, vertical.left_side(), ring))
    p.show("left side - 𝒦 = γ times", vertical.excess())
    balance = sp.Matrix(three.momentum()) - h * gamma

    def relation(text: str, factor: int) -> Equation:
        return Equation(text, left - (h + factor * D * q0 * gamma.dot(q)) * gamma, balance, ring)

    p.printed(relation("left side = [h + D q₀⟨γ,q⟩]γ", 1))
    p.corrected(
        r"2(\dots)^T = [h + 2D q_0\langle\gamma,\mathbf q\rangle]\gamma", relation("left side = [h + 2D q₀⟨γ,q⟩]γ", 2)
    )
    values = {k: sp.Rational(v) for k, v in SMALL.items()}
    now = vertical.gamma_now().xreplace(values)
    height = vertical.height().xreplace(values)
    p.say(f"At the counterexample 𝒦 = hγ exactly, with h = {height}, γ = {list(now)}.")
    point = {**{k: v for k, v in SMALL.items() if k != sigma}, **dict(zip(gamma, now, strict=True)), h: height}
    hypotheses = [
        Equation("|γ| = 1", gamma.dot(gamma), 1, ring),
        Equation("|q|² + q₀² = 1", q0**2 + q.dot(q), 1, ring),
        Equation("𝒦 = hγ", three.momentum(), h * gamma, ring),
    ]
    p.counterexample(rational_point(point, hypotheses))
    p.control(relation("left side = [h - 2D q₀⟨γ,q⟩]γ", -2))
    p.control(relation("left side = [h + 4D q₀⟨γ,q⟩]γ", 4))


@claim("5.6-sigma", r"\sigma_k = h + D\langle\gamma_k, q_0\mathbf q\rangle", uses=["5.4"])
def sigma_definition(p: Proof) -> None:
    """σ inherits the missing factor 2 of (5.4)."""
    p.slips("serious", "5.4")
    p.assume(NOT_ZERO, sp.Ne(sigma, 0))
    p.say("σ is the factor for which the left side of (5.4) is σγ; h and γ are written in q, σ.")
    now = vertical.gamma_now()
    momentum = sp.Matrix(three.momentum()).xreplace(dict(zip(gamma, now, strict=True)))
    height, square = momentum.dot(now), vertical.left_side().dot(vertical.left_side())
    unit = Quotient(RING.symbols, [*RING.relations, sp.expand(square - sigma**2)])
    p.reads(
        vertical_symbols(),
        ("h", height, "⟨𝒦,γ⟩, as 𝒦 = hγ (5.4)"),
        {r"\sigma_k": vertical_symbols()[r"\sigma"]},
        {r"\gamma_k": vertical_symbols()[r"\gamma"]},
    )
    p.say("h is ⟨𝒦(q,γ),γ⟩, as 𝒦 = hγ and |γ| = 1:")

    def formula(text: str, factor: int) -> Equation:
        return Equation(text, sigma, height + factor * D * q0 * now.dot(q), unit)

    p.printed(formula("σ = h + D⟨γ, q₀q⟩", 1))
    p.corrected(r"\sigma_k = h + 2D\langle\gamma_k, q_0\mathbf q\rangle", formula("σ = h + 2D⟨γ, q₀q⟩", 2))
    p.counterexample(vertical_point(SMALL))
    p.control(formula("σ = h - 2D⟨γ, q₀q⟩", -2))


@claim(
    "5.6",
    r"\gamma_k = \tfrac2{\sigma_k}(\dots+\dots)^T,\ "
    r"\gamma_{k+1} = -\Omega_k^T\gamma_k \equiv \tfrac2{\sigma_k}(\dots-\dots)^T",
    uses=["5.4", "5.3", "5.1"],
)
def consecutive_verticals(p: Proof) -> None:
    """γ_k and γ_(k+1) in Euler parameters: the vectors are right, the sign of Ωᵀ is not."""
    p.slips("typo")
    p.reads(
        vertical_symbols(),
        {r"\sigma_k": vertical_symbols()[r"\sigma"]},
        {r"\gamma_k": vertical_symbols()[r"\gamma"]},
        {r"\gamma_{k+1}": vertical_symbols()[r"\tilde\gamma"]},
        (r"\Omega_k", sp.Matrix(three.rotation()), "the rotation by the Euler parameters (5.1 as corrected)"),
        (r"(\dots+\dots)^T", printed_vector(+1), "the vector that is printed for γ_k"),
        (r"(\dots-\dots)^T", printed_vector(-1), "the vector that is printed for γ_(k+1)"),
    )
    p.assume(NOT_ZERO, sp.Ne(sigma, 0))
    now = vertical.gamma_now()
    turned = sp.Matrix(three.rotation()).T * now
    p.printed(equation("γ_k as printed", 2 / sigma * printed_vector(+1), now))
    second = list(2 / sigma * printed_vector(-1))
    p.lemma(equation("the vector for γ_{k+1} is the derived Ωᵀγ_k", second, vertical.gamma_next()))
    p.printed(
        equation("γ_{k+1} = -Ωᵀγ_k", vertical.gamma_next(), -turned),
        equation("-Ωᵀγ_k = (2/σ)(... - ...)", -turned, second),
    )
    p.corrected(
        r"\gamma_{k+1} = \Omega_k^T\gamma_k \equiv \tfrac2{\sigma_k}(\dots-\dots)^T",
        equation("γ_{k+1} = Ωᵀγ_k", vertical.gamma_next(), turned),
        equation("Ωᵀγ_k = (2/σ)(... - ...)", turned, second),
    )
    p.counterexample(vertical_point(SMALL))
    p.control(equation("Ωγ_k = (2/σ)(... - ...)", sp.Matrix(three.rotation()) * now, second))


@claim(
    "prop-3",
    r"\langle\gamma,\Lambda^{-1}\gamma\rangle = l,\ \text{an integral of every branch of }\mathcal G_h",
    uses=["5.4", "5.6", "5.3"],
)
def quadratic_integral(p: Proof) -> None:
    """The quadratic integral of the reduced map, for every branch and every h."""
    p.infers("Where σ ≠ 0, from the identity; where σ = 0, from ⟨q, left⟩ = 0, in words.")
    p.assume("Λ = diag(J₂+J₃+D, ...) is positive, as for every ball", *(x > 0 for x in three.lam().diagonal()))
    p.assume("q is real; (5.4) and (5.6) as corrected")
    inverse = continuous.inverse_inertia()
    now, after = vertical.gamma_now(), vertical.gamma_next()
    p.say("σ ≠ 0: both verticals are functions of q, σ on |q|² + q₀² = 1, |γ| = 1; no branch is chosen.")
    p.reads(
        (r"\Lambda", three.lam(), "diag(J2 + J3 + D, J1 + J3 + D, J1 + J2 + D), J the mass tensor (5.2)"),
        (r"\gamma", after, "γ_(k+1), after a step (5.6 as corrected)"),
        ("l", now.dot(inverse * now), "⟨γ_k,Λ⁻¹γ_k⟩, before the step (5.6)"),
    )
    p.printed(equation("⟨γ_k, Λ⁻¹γ_k⟩ = ⟨γ_{k+1}, Λ⁻¹γ_{k+1}⟩", now.dot(inverse * now), after.dot(inverse * after)))
    any_inertia = Quotient((*gamma, *vertical.INERTIA), [])
    p.lemma(Equation("⟨γ, adj(Λ)γ⟩ = det(Λ)⟨γ, Λ⁻¹γ⟩", [vertical.weighted_square()],
                     [vertical.LAMBDA.det() * gamma.dot(vertical.LAMBDA.inv() * gamma)], any_inertia))  # fmt: skip
    p.say("σ = 0 (only for h = 0): ⟨q, left⟩ = 2q₀⟨q,Λq⟩ = 0, so q = 0 (Ω = 1) or q₀ = 0 and then q×Λq = 0.")
    lam, left = three.lam(), sp.Matrix(vertical.left_side())
    p.lemma(equation("⟨q, left⟩ = 2q₀⟨q, Λq⟩", q.dot(left), 2 * q0 * q.dot(lam * q)))
    rotation = sp.Matrix(three.rotation())
    half_turn, crossed = rotation.subs(q0, 0), q.cross(lam * q)
    p.lemma(equation("left at q₀ = 0 is 2 q×Λq", left.subs(q0, 0), 2 * crossed))
    commutator = half_turn.T * lam - lam * half_turn.T
    p.lemma(
        Equation(
            "at q₀ = 0 the entries of [Ωᵀ, Λ] are twice those of q×Λq, so Ω commutes with Λ",
            [commutator[1, 2], commutator[2, 0], commutator[0, 1]], list(2 * crossed), RING,
        )
    )  # fmt: skip
    p.control(equation("⟨γ, γ_next⟩ = 1", now.dot(after), 1))
    p.control(equation("⟨γ, Λγ⟩ is an integral", now.dot(lam * now), after.dot(lam * after)))
    wrong = vertical.gamma_now().subs(q0, 2 * q0)
    p.control(equation("the integral with 2q₀ in γ_k", wrong.dot(inverse * wrong), after.dot(inverse * after)))
    p.route(
        "Ω, |γ| = 1, D and h are free and 𝒦 = hγ with (4.13), linear in J, is solved for the ball (q₀q₁q₂q₃ ≠ 0)",
        *second_routes.quadratic_integral(),
    )
    p.control(second_routes.mutated("⟨γ, Λγ⟩ is an integral", second_routes.quadratic_integral(power=1)[2]))
    p.control(second_routes.mutated("the integral with γ~ = Ωγ", second_routes.quadratic_integral(backwards=True)[2]))


if __name__ == "__main__":
    main(__file__)
