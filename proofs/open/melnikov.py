"""The change of the energy by X₃ along the separatrix near vertical momentum, in closed form: not 0, for every ball."""

from dataclasses import replace

import sympy as sp

from chapsym.derive import gibbs, modified
from chapsym.derive.elliptic import L1, L2, L3
from chapsym.derive.gibbs import I1, I2, I3, v
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import UNIT_VERTICAL, D, gamma, placed
from chapsym.proofs.open import terms
from chapsym.proofs.open.separatrix import C1, C3, KAPPA, MIDDLE, r
from chapsym.prove import Equation, Proof, Theorem, claim, main

LAMBDA, INVERSE = sp.diag(L1, L2, L3), sp.diag(1 / L1, 1 / L2, 1 / L3)
INERTIA = LAMBDA - D * sp.eye(3)
#: e ⊥ γ is horizontal; K = h(γ + se), to first order in s; ω₀ = cΛ⁻¹γ, h = cF.
e, (s, c) = gibbs.e, sp.symbols("s c")
BESIDE = Quotient((*gamma, *e, *v, L1, L2, L3, D, s, c), [UNIT_VERTICAL, gamma.dot(e), s**2])
SPIN = c * INVERSE * gamma
FALL = gamma.cross(SPIN)
TURN = c * INVERSE * FALL
F = 1 - D * gamma.dot(INVERSE * gamma)
#: The separatrix: γ = (C1 σ, T, C3 σ), σ = sech, T = tanh; ν = 1/ϰ; E = e^{iντ}, N = iν.
T, sigma, E, N = sp.symbols("T sigma E N")
ON_ARC = Quotient((T, sigma, r, L1, L3), [T**2 + sigma**2 - 1])


def lift(factor: int = 1) -> Equation:
    """F⟨γ,ω'⟩ to first order in s; the argument mutates it."""
    spin = SPIN + s * c * (F * INVERSE * e + D * (INVERSE * gamma).dot(e) * INVERSE * gamma)
    left = (INVERSE * gamma).dot((INERTIA * spin).cross(spin))
    return Equation("⟨Λ⁻¹γ, Iω × ω⟩ = -sF⟨ω₀',e⟩", left, -factor * s * F * TURN.dot(e), BESIDE)


def beside() -> list[Equation]:
    """ω, ω' and ⟨γ,ω'⟩ on K = h(γ + se)."""
    change = F * INVERSE * e + D * (INVERSE * gamma).dot(e) * INVERSE * gamma
    solved = F * INVERSE * v + D * (INVERSE * gamma).dot(v) * INVERSE * gamma
    contact = sp.Matrix(gibbs.contact_inertia()).subs(placed(((I1, I2, I3), INERTIA.diagonal())))
    return [
        Equation("x = Λ⁻¹v + (D/F)⟨Λ⁻¹γ,v⟩Λ⁻¹γ: B(γ)x = v", contact * solved, F * v, BESIDE),
        Equation(
            "at v = h(γ + se) that is ω, h = cF",
            solved.subs(placed((v, c * (gamma + s * e)))),
            SPIN + s * c * change,
            BESIDE,
        ),
        Equation("F⟨γ,x⟩ = ⟨Λ⁻¹γ,v⟩", gamma.dot(solved), (INVERSE * gamma).dot(v), BESIDE),
        Equation("B(γ)ω₀' = Iω₀ × ω₀, ω₀' = cΛ⁻¹γ'", contact * TURN, (INERTIA * SPIN).cross(SPIN), BESIDE),
    ]


def on_the_arc(factor: int = 1) -> Equation:
    """b = γ × Λ⁻¹γ on the separatrix; the argument mutates ⟨b,Λ⁻¹b⟩."""
    inverse = sp.diag(1 / L1, 1 / MIDDLE, 1 / L3)
    at = sp.Matrix([C1 * sigma, T, C3 * sigma])
    b = at.cross(inverse * at)
    square = KAPPA**2 * sigma**2 / MIDDLE**2
    return Equation("|b|² = ϰ²σ²/Λ₂², ⟨b,Λ⁻¹b⟩ = ϰ²σ²/Λ₂³, b₂ = ϰσ²/Λ₂", [b.dot(b), b.dot(inverse * b), b[1]],
                    [square, factor * square / MIDDLE, KAPPA * sigma**2 / MIDDLE], ON_ARC)  # fmt: skip


def derivative(of: sp.Expr) -> sp.Expr:
    """d/dτ of σ = sech τ, T = tanh τ, E = e^{iντ}."""
    return -sigma * T * sp.diff(of, sigma) + (1 - T**2) * sp.diff(of, T) + N * E * sp.diff(of, E)


def by_parts(part: int = 3) -> list[Equation]:
    """Integration by parts: σ² d(σE)/dτ in terms of σ³E, and σ³ of σ; the argument mutates the first."""
    ring = Quotient((T, sigma, E, N), [T**2 + sigma**2 - 1])
    left, right = sigma**2 * derivative(sigma * E), (derivative(sigma**3 * E) + 2 * N * sigma**3 * E) / part
    return [
        Equation("σ²(σE)' = ⅓(σ³E)' + ⅔iνσ³E", left, right, ring),
        Equation("σ'' = σ - 2σ³", derivative(derivative(sigma)), sigma - 2 * sigma**3, ring),
    ]


@claim(
    "melnikov",
    r"\frac d{ds}\Big|_0\int X_3(H)\,dt = -\frac\pi{12}D\,\Omega^4\frac{1+\varkappa^2}{\cosh(\pi/2\varkappa)}\sin\varphi,\quad "
    r"K = h(\gamma + se),\ l = \tfrac1{\Lambda_2},\ \Omega = \tfrac h{I_2}",
    uses=("modified-energy", "stable-inverse", "top-precession", "separatrix-map"),
)
def melnikov(p: Proof) -> None:
    """Along the separatrix, with a momentum that is nearly vertical, the energy gains a sine of the phase that is never 0."""
    p.assume(
        "I₁ > I₂ > I₃ > 0, D > 0, Λ = I + D, h > 0; the integral is the one to first order in s, along the orbit with s = 0"
    )
    p.say("1. Beside vertical momentum. e is a horizontal unit vector, fixed in space as K and γ are. With F = 1 - Dl:")
    p.lemma(*beside())
    p.say("So ω₀ = cΛ⁻¹γ is that of K = hγ, and the first order of ⟨γ,ω'⟩ in X₃(H) = (D/4)⟨γ,ω'⟩⟨γ',ω'⟩ is")
    p.show("X₃(H)", modified.energy_rate())
    p.printed(lift())
    p.say(
        "divided by F, and ⟨γ,ω₀'⟩ = 0: X₃(H) = -s(D/4)⟨ω₀',e⟩⟨γ',ω₀'⟩ + O(s²).",
        "2. The separatrix. With b = γ × Λ⁻¹γ, γ' = cb, ⟨γ',ω₀'⟩ = c³⟨b,Λ⁻¹b⟩. On γ = (C1σ, T, C3σ), C1C3 < 0, T =",
        "tanh, σ = sech,",
    )
    p.printed(on_the_arc())
    p.say(
        "so with Ω = c/Λ₂ = h/I₂ (F = I₂/Λ₂): T' = cb₂ says that the argument is τ = λt, λ = ϰΩ; ⟨γ',ω₀'⟩ = λ²Ωσ².",
        "The horizontal part W of ω₀ in space has the length c|b| = λσ, and turns with b (γ × W = γ'), at the rate",
        "c⟨b,Λ⁻¹b⟩/|b|² = Ω (top-precession): W = λσe^{iΩt} in the horizontal plane as the complex numbers, γ × W =",
        "iW. Its derivative in space is the horizontal part of ω₀', as the derivative of ω in the body is that in",
        "space. So with ν = Ω/λ = 1/ϰ",
        "    ∫X₃(H)dt = s Re(e^{-iφ}Z), φ the angle of e, Z = -(D/4)λ³Ω ∫σ² d(σe^{iντ}),",
    )
    p.lemma(*by_parts())
    p.say(
        "∫σ³e^{iντ}dτ = ½(1 + ν²)∫σe^{iντ}dτ and ∫σe^{iντ}dτ = π/cosh(πν/2): so Z = -(D/4)λ³Ω·⅔iν·½(1 +",
        "ν²)π/cosh(πν/2), that is Z = -i(π/12)DΩ⁴(1 + ϰ²)/cosh(π/2ϰ), as ν = 1/ϰ and λ = ϰΩ: not 0 for any D > 0 and",
        "any three different moments.",
    )
    big, k = sp.symbols("Omega kappa")
    amplitude = (k * big) ** 3 * big / k * (1 + 1 / k**2)
    p.lemma(Equation("λ³Ων(1 + ν²) = Ω⁴(1 + ϰ²)", amplitude, big**4 * (1 + k**2), Quotient((big, k))))
    p.measure(
        "Λ = (6, 5, 3), D = 1, h = 13/10, K = h(γ ± 1e-6 e), Simpson's rule: the amplitude is 5.83028e-5, the closed form 5.83029e-5."
    )
    p.control(replace(lift(2), text="twice the first order"), replace(on_the_arc(2), text="twice ⟨b,Λ⁻¹b⟩"))
    p.control(replace(by_parts(2)[0], text="σ²(σE)' with ½"))


TORI = "near vertical momentum the levels of H are tori, on which the first return to a circle is a rotation by ρ(l, s)"
CLOSED = "for every large n there is s₀ > 0, and for 0 < s < s₀ there is an l_s near 1/Λ₂ with ρ(l_s, s) = 4πn"


def precession(low: sp.Expr = L2 * L3) -> Equation:
    """det(Λ)⟨b,Λ⁻¹b⟩ - Λ₂Λ₃|b|², on the sphere; the argument mutates Λ₂Λ₃."""
    b, (x, y, z) = gamma.cross(INVERSE * gamma), gamma
    ring = Quotient((*gamma, L1, L2, L3), [UNIT_VERTICAL])
    right = x**2 * y**2 * (1 / L1 - 1 / L2) ** 2 * L2 * (L1 - L3) + x**2 * z**2 * (1 / L1 - 1 / L3) ** 2 * L3 * (
        L1 - L2
    )
    text = "Λ₁Λ₂Λ₃⟨b,Λ⁻¹b⟩ - Λ₂Λ₃|b|² = γ₁²(γ₂²(1/Λ₁ - 1/Λ₂)²Λ₂(Λ₁ - Λ₃) + γ₃²(1/Λ₁ - 1/Λ₃)²Λ₃(Λ₁ - Λ₂))"
    return Equation(text, L1 * L2 * L3 * b.dot(INVERSE * b) - low * b.dot(b), right, ring)


@claim(
    "energy-orbits",
    r"I_1>I_2>I_3,\ D>0 \ \Rightarrow\ \text{the continuous ball has closed orbits with } \oint X_3(H)\,dt \ne 0",
    uses=("melnikov", "modified-measure", "top-precession", "separatrix-limit"),
)
def energy_orbits(p: Proof) -> None:
    """Every ball with three different moments and D > 0 has closed orbits along which X₃ changes the energy."""
    p.assume("I₁ > I₂ > I₃ > 0, D > 0, Λ = I + D; h > 0", L1 > L2, L2 > L3, L3 > 0)
    p.state(Theorem((), (terms.ROLLS, terms.THREE, terms.MOMENTS), (terms.DRIFT,)))
    p.say(
        "The moments may be named in this order: an odd renaming P is a reflection, γ ↦ Pγ, ω ↦ -Pω, K ↦ -PK, which takes",
        "motions to motions, and X₃(H) stays as it is.",
        "1. Tori. On |K|² = h²(1 + s²), ⟨K,γ⟩ = h let K = h(γ + se): the frames (e, γ × e, γ) make it SO(3), and the",
        "continuous ball a flow on it, analytic in s, s = 0 among them: γ' = γ × ω, e' = e × ω, ω = B(γ)⁻¹h(γ + se).",
        "It keeps H, and a measure with a smooth positive density (2.6, modified-measure). For s = 0 H is ½h²l/(1 -",
        "Dl), and rotations about γ commute with the flow: for 1/Λ₂ < l < 1/Λ₃ the states with this l, γ₃ > 0 are a",
        "torus, a circle of γ times one of e. dH is not 0 there: so for l in a compact set and s small the states",
        "with H = ½h²l/(1 - Dl) near by are a torus. It is cut by γ₂ = 0, γ₁ > 0 in a circle, across the flow, with",
        "the angle φ of e as coordinate. The first return keeps a smooth positive measure of this circle: so it is a",
        "rotation by ρ(l, s) in another coordinate, ρ continuous. If ρ = 0 mod 2π every orbit on the torus is closed",
        "after one return.",
    )
    p.step(TORI, terms.ROLLS, terms.THREE, "modified-measure")
    p.say(
        "2. s = 0. W, the horizontal part of ω₀ in space, is not 0 and turns at the rate",
        "c⟨b,Λ⁻¹b⟩/|b|² (top-precession), with",
    )
    p.printed(precession())
    p.say(
        "≥ 0, so at least by c/Λ₁. Half a period of γ takes it to (-γ₁, -γ₂, γ₃), a symmetry, as S B(γ)Sᵀ = B(Sγ): W turns by",
        "the same angle ϑ(l) in each half, and ρ(l, 0) = 2ϑ(l). As the period tends to ∞ as l → 1/Λ₂, so does ϑ: near",
        "1/Λ₂ there are l₁, l₂ with ϑ - 2πn of opposite signs, for all large n. For each n there is s₀ > 0, so",
        "that for 0 < s < s₀ there is an l_s between with ρ(l_s, s) = 4πn.",
    )
    p.step(CLOSED, TORI, "top-precession")
    p.say(
        "3. The integral. On this torus X₃(H) is s times its first order, as in melnikov, and O(s²); over one return,",
        "in bounded time, the orbit is within O(s) of that with s = 0 and this l, φ. So ∮X₃(H)dt = s",
        "Re(e^{-iφ}Z(l_s)) + O(s²), Z(l) = -(D/4)∫⟨γ',ω₀'⟩dW over a period. The two halves differ by e^{iϑ}, which",
        "is 1 + o(1) at l_s as s → 0, so Z(l_s) is 2Z_half(l_s) + o(1). And |Z_half(l)| → |Z| of melnikov as l → 1/Λ₂: centred at",
        "γ₂ = 0, the integrand tends to that of the separatrix on bounded times, and ⟨γ',ω₀'⟩ ≤ C|b|² ≤ C'(1 - γ₂²) ≤",
        "C''e^{-2λ't} up to a quarter of the period, since cn² ≤ dn², and dn has that bound (separatrix-limit). With",
        "l₁, l₂ so near to 1/Λ₂ that |Z_half| ≥ ½|Z| between them, and φ such that Re(e^{-iφ}Z(l_s)) = |Z(l_s)|,",
        "∮X₃(H)dt ≥ s|Z| + o(s) > 0 for small s > 0. So step 1 to 4 of 6-open, which need one closed orbit with",
        "∮X₃(H)dt ≠ 0, hold for every such ball, near this orbit.",
    )
    p.step(terms.DRIFT, CLOSED, terms.MOMENTS, "melnikov", "separatrix-limit")
    p.measure(
        "Λ = (6, 5, 3), D = 1, h = 13/10, s = 1e-6, e at the angle φ = 1 from W: orbits with T = 101.82, 121.47, 140.94 are closed "
        "after one return; the second, with ϑ an even multiple of π, has ∮X₃(H)dt = -1.0054e-4 s (2|Z| sin 1 = 9.81e-5), the "
        "others 2e-12 s."
    )
    p.control(replace(precession(L1 * L2), text="the same with Λ₁Λ₂|b|²"))
    p.control(replace(precession(L1 * L3), text="the same with Λ₁Λ₃|b|²"))


if __name__ == "__main__":
    main(__file__)
