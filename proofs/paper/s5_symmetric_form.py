"""Section 5: the symmetric form of the reduced map (Proposition 4) and what it needs."""

import sympy as sp

from chapsym.derive import three, vertical
from chapsym.derive.continuous import inverse_inertia
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import J1, J2, J3, D, q, q0
from chapsym.derive.vertical import RING, sigma
from chapsym.proofs import second_routes
from chapsym.proofs.paper.s5_vertical import LARGE, NOT_ZERO, SMALL, vertical_point, vertical_symbols
from chapsym.prove import Comparison, Equation, Proof, claim, equations, main

equation = equations(RING)


def difference() -> sp.Matrix:
    """γ~ - γ in q, σ."""
    return (vertical.gamma_next() - vertical.gamma_now()).applyfunc(sp.factor)


def first_form() -> sp.Expr:
    """⟨γ+γ~, Λ⁻¹(γ+γ~)⟩."""
    return vertical.total().dot(inverse_inertia() * vertical.total())


def second_form() -> sp.Expr:
    """⟨γ+γ~, Λ⁻²(γ+γ~)⟩."""
    return vertical.total().dot(inverse_inertia() ** 2 * vertical.total())


def square_of_root(text: str, factor: sp.Expr) -> Equation:
    """The equation (2q₀² - 1)² = 1 - factor·⟨γ+γ~, Λ⁻²(γ+γ~)⟩, which a formula for the root implies."""
    return equation(text, (2 * q0**2 - 1) ** 2, 1 - factor * second_form())


def closed_sigma(text: str, factor: sp.Expr) -> Equation:
    """The equation σ = h/(1 - factor·⟨γ+γ~, Λ⁻¹(γ+γ~)⟩), multiplied out."""
    return equation(text, sigma * (1 - factor * first_form()), vertical.height())


def solved_sigma(text: str, factor: sp.Expr) -> Equation:
    """The equation of `closed_sigma` as printed, solved for σ."""
    return equation(text, sigma, vertical.height() / (1 - factor * first_form()))


def symmetric(text: str, factor: sp.Expr) -> Equation:
    """The equation γ~ - γ = factor·(γ+γ~) × Λ⁻¹(γ+γ~)."""
    return equation(text, difference(), factor * vertical.total().cross(inverse_inertia() * vertical.total()))


@claim(
    "5.12",
    r"\tilde\gamma+\gamma = \tfrac{4q_0}\sigma\Lambda\mathbf q,\ \tilde\gamma-\gamma = \tfrac4\sigma\Lambda\mathbf q\times\mathbf q",
    uses=["5.6"],
)
def sum_and_difference(p: Proof) -> None:
    """Sum and difference of consecutive verticals."""
    p.reads(vertical_symbols())
    p.assume(NOT_ZERO, sp.Ne(sigma, 0))
    p.lemma(equation("γ~ + γ = (4q₀/σ)Λq", vertical.total(), 4 * q0 / sigma * three.lam() * q))
    p.printed(equation("γ~ - γ = (4/σ)Λq×q", difference(), 4 / sigma * (three.lam() * q).cross(q)))
    p.control(equation("γ~ - γ = (4/σ)q×Λq", difference(), 4 / sigma * q.cross(three.lam() * q)))


@claim(
    "5.12-kappa",
    r"\tilde\gamma-\gamma = \tfrac\sigma{4q_0^2}(\tilde\gamma+\gamma)\times\Lambda^{-1}(\tilde\gamma+\gamma)",
    uses=["5.12"],
)
def kappa_in_q0(p: Proof) -> None:
    """The symmetric form with ϰ = σ/q₀²."""
    p.reads(vertical_symbols())
    p.assume(NOT_ZERO, sp.Ne(sigma, 0))
    p.assume("q₀ ≠ 0: at a rotation by π the sum γ~ + γ vanishes", sp.Ne(q0, 0))
    p.printed(symmetric("γ~ - γ = σ/(4q₀²)·(γ~+γ)×Λ⁻¹(γ~+γ)", sigma / (4 * q0**2)))
    p.control(symmetric("the same with σ/(2q₀²)", sigma / (2 * q0**2)))
    p.control(symmetric("the same with -σ/(4q₀²)", -sigma / (4 * q0**2)))


@claim(
    "5.12-q0",
    r"2q_0^2 = 1+\sqrt{1-\tfrac14\langle\Lambda^{-1}(\tilde\gamma+\gamma),\Lambda^{-1}(\tilde\gamma+\gamma)\rangle}",
    uses=["5.12"],
)
def q0_from_sum(p: Proof) -> None:
    """q₀ as a function of the sum: σ² is missing under the root, and the root has two signs."""
    p.slips("serious")
    p.reads(vertical_symbols())
    p.assume(NOT_ZERO, sp.Ne(sigma, 0))
    p.assume("q₀ ≠ 0: at a rotation by π the sum γ~ + γ vanishes", sp.Ne(q0, 0))
    p.say("By (5.12) |q|² = (σ²/16q₀²)⟨γ~+γ, Λ⁻²(γ~+γ)⟩, and |q|² = 1 - q₀²: a quadratic equation for q₀².")
    p.printed(square_of_root("(2q₀²-1)² = 1 - ¼⟨s, Λ⁻²s⟩, s = γ~+γ", sp.Rational(1, 4)))
    p.corrected(
        r"2q_0^2 = 1\pm\sqrt{1-\tfrac{\sigma^2}4\langle\tilde\gamma+\gamma,\Lambda^{-2}(\tilde\gamma+\gamma)\rangle},"
        r"\ + \text{ for } \theta\le\tfrac\pi2,\ - \text{ for } \theta\ge\tfrac\pi2",
        square_of_root("(2q₀²-1)² = 1 - (σ²/4)⟨s, Λ⁻²s⟩", sigma**2 / 4),
    )
    for name, state in [("below", SMALL), ("above", LARGE)]:
        p.say(f"A rotation by an angle {name} 90°:")
        p.counterexample(vertical_point(state))
    p.say("2q₀² - 1 = cos θ, so the sign of the root is that of cos θ; the second state needs the minus sign:")
    p.lemma(*_signs())
    p.control(square_of_root("(2q₀²-1)² = 1 - (σ/4)⟨s, Λ⁻²s⟩", sigma / 4))
    p.control(square_of_root("(2q₀²-1)² = 1 + (σ²/4)⟨s, Λ⁻²s⟩", -(sigma**2) / 4))


def _signs() -> tuple[Comparison, Comparison]:
    """The signs of 2q₀² - 1 at the two rational states."""
    return (
        Comparison("2q₀² > 1 at the first state", [2 * q0**2 > 1], SMALL),
        Comparison("2q₀² < 1 at the second", [2 * q0**2 < 1], LARGE),
    )


@claim(
    "5.12-sigma",
    r"\sigma = h+D\langle\gamma,\tfrac\sigma4\Lambda^{-1}(\tilde\gamma+\gamma)\rangle,\ "
    r"\langle\gamma,\Lambda^{-1}(\tilde\gamma+\gamma)\rangle = "
    r"\tfrac12\langle\gamma+\tilde\gamma,\Lambda^{-1}(\gamma+\tilde\gamma)\rangle",
    uses=["5.6-sigma", "5.12", "prop-3"],
)
def sigma_equation(p: Proof) -> None:
    """The equation that σ solves has the missing factor 2; the relation that closes it holds."""
    p.slips("serious", "5.6-sigma")
    p.reads(vertical_symbols())
    p.assume(NOT_ZERO, sp.Ne(sigma, 0))
    lifted = D * sigma / 4 * vertical.gamma_now().dot(inverse_inertia() * vertical.total())
    p.printed(
        equation(
            "⟨γ, Λ⁻¹s⟩ = ½⟨s, Λ⁻¹s⟩", vertical.gamma_now().dot(inverse_inertia() * vertical.total()), first_form() / 2
        )
    )
    p.printed(equation("σ = h + D⟨γ, (σ/4)Λ⁻¹s⟩, s = γ~ + γ", sigma, vertical.height() + lifted))
    p.corrected(
        r"\sigma = h+2D\langle\gamma,\tfrac\sigma4\Lambda^{-1}(\tilde\gamma+\gamma)\rangle",
        equation("σ = h + 2D⟨γ, (σ/4)Λ⁻¹s⟩, s = γ~ + γ", sigma, vertical.height() + 2 * lifted),
    )
    p.counterexample(vertical_point(SMALL))
    p.control(equation("σ = h - 2D⟨γ, (σ/4)Λ⁻¹s⟩, s = γ~ + γ", sigma, vertical.height() - 2 * lifted))


@claim(
    "5.11",
    r"\sigma = \frac h{1-\frac D8\langle\tilde\gamma+\gamma,\Lambda^{-1}(\tilde\gamma+\gamma)\rangle}",
    uses=["5.12-sigma"],
)
def sigma_of_sum(p: Proof) -> None:
    """σ as a function of the sum: D/8 must be D/4."""
    p.slips("serious", "5.12-sigma")
    p.reads(vertical_symbols())
    p.assume("h ≠ 0; then σ ≠ 0 and the denominator is h/σ, which does not vanish", sp.Ne(vertical.height(), 0))
    p.printed(closed_sigma("σ(1 - (D/8)⟨s, Λ⁻¹s⟩) = h, s = γ~ + γ", D / 8))
    p.corrected(
        r"\sigma = \frac h{1-\frac D4\langle\tilde\gamma+\gamma,\Lambda^{-1}(\tilde\gamma+\gamma)\rangle}",
        solved_sigma("σ = h/(1 - (D/4)⟨s, Λ⁻¹s⟩)", D / 4),
    )
    p.counterexample(vertical_point(SMALL))
    p.counterexample(vertical_point(LARGE))
    p.control(closed_sigma("σ(1 + (D/4)⟨s, Λ⁻¹s⟩) = h", -D / 4))
    p.control(closed_sigma("σ(1 - (D/2)⟨s, Λ⁻¹s⟩) = h", D / 2))


@claim(
    "prop-4",
    r"\tilde\gamma-\gamma = \tfrac\varkappa4(\tilde\gamma+\gamma)\times\Lambda^{-1}(\tilde\gamma+\gamma),\ "
    r"\varkappa = \frac{2\sigma}{1+\sqrt{1-\frac14\langle\tilde\gamma+\gamma,\Lambda^{-2}(\tilde\gamma+\gamma)\rangle}},\ "
    r"\sigma \text{ by (5.11)}",
    uses=["5.12", "5.12-kappa", "5.12-q0", "5.11"],
)
def symmetric_form(p: Proof) -> None:
    """The symmetric form holds with other ϰ and σ, and with both signs of the root."""
    p.slips("serious", "5.11", "5.12-q0")
    p.reads(vertical_symbols() | {r"\varkappa": (sigma / q0**2, "σ/q₀² (5.12-kappa)")})
    p.assume("h ≠ 0 and q₀ ≠ 0 (no rotation by π)", sp.Ne(vertical.height(), 0), sp.Ne(q0, 0))
    p.assume("Λ is positive, as for every ball", *(x > 0 for x in three.lam().diagonal()))
    p.printed(symmetric("5.10 with ϰ = σ/q₀²", sigma / (4 * q0**2)))
    p.say("Where the vector product is not 0, (5.10) leaves one ϰ, σ/q₀². The printed formula for it says")
    p.say("2σ/ϰ - 1 = √(...), that is 2q₀² - 1 = √(1 - ¼⟨s, Λ⁻²s⟩) with s = γ~ + γ; squared it is polynomial:")
    p.printed(
        square_of_root("ϰ: (2q₀²-1)² = 1 - ¼⟨s, Λ⁻²s⟩, s = γ~ + γ", sp.Rational(1, 4)),
        closed_sigma("σ: σ(1 - (D/8)⟨s, Λ⁻¹s⟩) = h, s = γ~ + γ", D / 8),
    )
    p.corrected(
        r"\varkappa = \frac{2\sigma}{1\pm\sqrt{1-\frac{\sigma^2}4\langle\tilde\gamma+\gamma,"
        r"\Lambda^{-2}(\tilde\gamma+\gamma)\rangle}},\ "
        r"\sigma = \frac h{1-\frac D4\langle\tilde\gamma+\gamma,\Lambda^{-1}(\tilde\gamma+\gamma)\rangle},"
        r"\ \text{with the sign of }\cos\theta",
        square_of_root("ϰ: (2q₀²-1)² = 1 - (σ²/4)⟨s, Λ⁻²s⟩", sigma**2 / 4),
        solved_sigma("σ: σ = h/(1 - (D/4)⟨s, Λ⁻¹s⟩)", D / 4),
    )
    for name, state in [("below", SMALL), ("above", LARGE)]:
        p.say(f"A state with the rotation angle {name} 90°: the sign of the root is that of 2q₀² - 1 = cos θ.")
        p.counterexample(vertical_point(state))
        product = vertical.total().cross(inverse_inertia() * vertical.total())
        p.lemma(Comparison("the vector product in (5.10) is not zero there", [sp.Ne(product[0], 0)], state))
    p.say("The two states need the two signs of the root:")
    p.lemma(*_signs())
    _converse(p)
    p.control(symmetric("5.10 with ϰ = 2σ/q₀²", sigma / (2 * q0**2)))
    p.control(symmetric("5.10 with Λ⁻¹s×s", -sigma / (4 * q0**2)))
    p.control(square_of_root("ϰ with σ in the place of σ²", sigma / 4))
    p.control(closed_sigma("σ with the sign of D flipped", -D / 4))
    p.route(
        "every step with 𝒦 = hγ satisfies the corrected form: Ω, |γ| = 1, D and h are free, "
        "𝒦 = hγ with (4.13) is solved for the ball (q₀q₁q₂q₃ ≠ 0)",
        *second_routes.symmetric_form(),
    )
    p.route(
        "the converse: γ on the unit sphere, u = (ϰ/4)Λ⁻¹s, ϰ and D are free, and σ is solved for",
        *second_routes.steps_of_the_symmetric_form(),
    )
    p.control(second_routes.mutated("σ with D/8, as printed", second_routes.symmetric_form(part=8)[2]))
    p.control(
        second_routes.mutated("cos²θ = 1 - ¼⟨s, Λ⁻²s⟩, as printed", second_routes.symmetric_form(under_root=0)[3])
    )
    p.control(second_routes.mutated("(5.10) with ϰ/2", second_routes.symmetric_form(factor=2)[4]))
    wrong = second_routes.steps_of_the_symmetric_form(part=8)[4]
    p.control(second_routes.mutated("the converse with D/8 in σ: 𝒦 = hγ", wrong))


@claim("5.12-scaling", r"h = 1 \text{ by rescaling of } \Lambda \text{ and } D", uses=["prop-4"])
def rescaling(p: Proof) -> None:
    """The map depends on Λ/h and D/h only."""
    p.infers("The step of the ball scaled by s, at h/s, is that of the ball at h: s = h gives 1.")
    p.assume("h > 0 (for h < 0 turn γ round: (-h, -γ) is the same momentum)", vertical.height() > 0)
    p.assume("prop-4 as corrected")
    scale = sp.Symbol("s")
    ring = Quotient((scale, *RING.symbols), RING.relations)
    changed = {x: x / scale for x in (J1, J2, J3, D, sigma)}

    def rescaled(expr: sp.Expr) -> sp.Expr:
        return expr.xreplace(changed)

    p.say("J, D, σ ↦ J/s, D/s, σ/s, with the same q: γ and γ~ stay, h becomes h/s, so that s = h gives 1.")
    now, after, lam = vertical.gamma_now(), vertical.gamma_next(), three.lam()
    p.printed(
        Equation("Λ becomes Λ/s", lam.applyfunc(rescaled), lam / scale, ring),
        Equation("γ stays", now.applyfunc(rescaled), now, ring),
        Equation("γ~ stays", after.applyfunc(rescaled), after, ring),
        Equation("h becomes h/s", rescaled(vertical.height()), vertical.height() / scale, ring),
    )
    root = sigma**2 / 4 * second_form()
    p.lemma(Equation("in (5.10) ϰΛ⁻¹ stays", rescaled(sigma / q0**2 / lam[0, 0]), sigma / q0**2 / lam[0, 0], ring))
    p.lemma(Equation("and under its root (σ²/4)⟨s,Λ⁻²s⟩", rescaled(root), root, ring))
    printed = second_form() / 4
    p.say("With the printed root, without σ², the scaling would not be one: that is the control.")
    p.control(Equation("¼⟨s,Λ⁻²s⟩ stays", rescaled(printed), printed, ring))
    p.control(Equation("h stays", rescaled(vertical.height()), vertical.height(), ring))


def _converse(p: Proof) -> None:
    """The proof that every solution of the corrected form is a step of the map: q = (σ/4q₀)Λ⁻¹s solves (5.4)."""
    p.say("The converse: let s and d = (ϰ/4)s×Λ⁻¹s satisfy the corrected form, ϰ = σ/q₀², and put")
    p.say("q = (σ/4q₀)Λ⁻¹s, γ = (s-d)/2, γ~ = (s+d)/2. Then |q|² + q₀² = 1 is the formula for ϰ, and")
    s = sp.Matrix(sp.symbols("s1:4"))
    free = Quotient((*s, sigma, q0, J1, J2, J3, D))
    d = sigma / (4 * q0**2) * s.cross(inverse_inertia() * s)
    vector = sigma / (4 * q0) * inverse_inertia() * s
    left = 2 * (q0 * three.lam() * vector + vector.cross(three.lam() * vector))
    right = 2 * (q0 * three.lam() * vector - vector.cross(three.lam() * vector))
    p.lemma(Equation("the left side of (5.4) at that q is σγ", left, sigma * (s - d) / 2, free))
    p.lemma(Equation("and σΩᵀγ = 2(q₀Λq - q×Λq) is σγ~", right, sigma * (s + d) / 2, free))
    p.lemma(Equation("|γ~| = |γ|: ⟨s, d⟩ = 0", s.dot(d), 0, free))
    lifted = 2 * D * q0 * ((s - d) / 2).dot(vector)
    p.lemma(
        Equation(
            "2Dq₀⟨γ,q⟩ = (D/4)σ⟨s, Λ⁻¹s⟩, the formula for σ", lifted, D / 4 * sigma * s.dot(inverse_inertia() * s), free
        )
    )
    p.control(Equation("the same with D/8", lifted, D / 8 * sigma * s.dot(inverse_inertia() * s), free))


if __name__ == "__main__":
    main(__file__)
