"""The level l = 1/Λ₂ of the reduced map, and the levels near it: where what two ends of an orbit miss decides."""

from dataclasses import replace

import sympy as sp

from chapsym.derive import elliptic, gibbs
from chapsym.derive.elliptic import L1, L2, L3, l
from chapsym.derive.gibbs import I1, I2, I3, D
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import placed
from chapsym.proofs.map.gibbs import FREE
from chapsym.proofs.open import terms
from chapsym.proofs.open.orbits import half_momentum, turn
from chapsym.prove import Comparison, Equation, Proof, Theorem, claim, main

#: X = coth a, T = tanh ū, E² = (1 - T²)(X² - 1); γ = (C1 E, TX ∓ 1, C3 E)/(X ∓ T) at u = ū ∓ a, with C1² + C3² = 1.
X, T, E, r, h, S, Y, kappa = sp.symbols("X T E r h S Y kappa")
C1, C3 = (1 - r**2) / (1 + r**2), 2 * r / (1 + r**2)
#: Λ₂, from l = 1/Λ₂ = C1²/Λ₁ + C3²/Λ₃.
MIDDLE = L1 * L3 * (1 + r**2) ** 2 / (L3 * (1 - r**2) ** 2 + 4 * L1 * r**2)
ON_ARC = Quotient((X, T, E, r, L1, L3, D), [E**2 - (1 - T**2) * (X**2 - 1)])
LAMBDA, INVERSE = sp.diag(L1, MIDDLE, L3), sp.diag(1 / L1, 1 / MIDDLE, 1 / L3)
KAPPA = -C1 * C3 * MIDDLE * (L1 - L3) / (L1 * L3)
#: tanh ũ - tanh u.
RISE = 2 * X * (1 - T**2) / (X**2 - T**2)
#: S² = I₂² - h² + hϰY, Y = D(tanh ũ - tanh u).
ROOT = Quotient((S, I2, h, kappa, Y), [S**2 - I2**2 + h**2 - h * kappa * Y])


def place(sign: int) -> sp.Matrix:
    """γ at ū - a (sign -1) and at ū + a."""
    return sp.Matrix([C1 * E, T * X + sign, C3 * E]) / (X + sign * T)


def gibbs_vector(factor: int = 1) -> sp.Matrix:
    """The u of (5.10), a multiple of Λ⁻¹(γ~ + γ); the argument mutates it."""
    across = MIDDLE * E / (X**2 - 1)
    return factor * sp.Matrix([C1 * across / L1, T / X, C3 * across / L3]) / KAPPA


def cayley() -> Equation:
    """The equation for Ωᵀv by a vector product, for any Gibbs vector u; at v = γ it gives γ~."""
    u, v = gibbs.u, gibbs.v
    return Equation("Ωᵀv - v = (Ωᵀv + v) × u", turn(u) * v - v, (turn(u) * v + v).cross(u), FREE)


def rotated(factor: int = 1) -> Equation:
    """The statement that this u turns γ to γ~."""
    before, after = place(-1), place(1)
    return Equation("γ~ - γ = (γ~ + γ) × u", after - before, (after + before).cross(gibbs_vector(factor)), ON_ARC)


def momentum(contact: sp.Expr = D) -> Equation:
    """The equation for 𝒦 of this step times ϰX² + 1/ϰ; the argument mutates D."""
    inertia = placed(((I1, I2, I3), (LAMBDA - D * sp.eye(3)).diagonal()))
    step = 2 * half_momentum(gibbs_vector(), place(-1)).subs(inertia)
    right = (2 * (MIDDLE - D) * X + contact * RISE) * place(-1)
    return Equation("𝒦(ϰX² + 1/ϰ) = (2I₂X + D(tanh ũ - tanh u))γ", step * (KAPPA * X**2 + 1 / KAPPA), right, ON_ARC)


def from_the_chord() -> list[Equation]:
    """M and Ψ of lemma chord at l = 1/Λ₂, where k = 1 and sn = tanh, cn = dn = sech."""
    ring = Quotient((X, kappa, L1, L2, L3, h), [kappa**2 * L1 * L3 - (L1 - L2) * (L2 - L3)])
    modulus, g0, g1, g2, mu = (e.subs(l, 1 / L2) for e in elliptic.increment_parts())
    y, V = 1 / X**2, kappa / L2
    w, G, level = (1 - y) / X, g0 + g1 * y + g2 * y**2, 1 / L2 - mu * y
    M = (2 * w - h * G / V) / (y * level)
    return [
        Equation("k² = 1, V = ϰ/Λ₂, λ = sech²a/Λ₂", [modulus, g0, level], [1, V**2, (1 - y) / L2], ring),
        Equation("M = 2Λ₂X - h(ϰX² + 1/ϰ)", M, 2 * L2 * X - h * (kappa * X**2 + 1 / kappa), ring),
        Equation("Ψ = 2 tanh a + 2w/y = 2X", 2 / X + 2 * w / y, 2 * X, ring),
    ]


def root(sign: int = 1) -> Equation:
    """The larger X with h(ϰX² + 1/ϰ) - 2I₂X = Y; the argument mutates it."""
    at = (I2 + sign * S) / (h * kappa)
    text = "X = (I₂ + S)/(hϰ): F(X) = hϰX² - 2I₂X + h/ϰ = Y, F'(X) = 2S"
    return Equation(text, [h * kappa * at**2 - 2 * I2 * at + h / kappa, 2 * h * kappa * at - 2 * I2], [Y, 2 * S], ROOT)


def curve(sign: int = 1) -> Equation:
    """The relation without denominator; the argument mutates it."""
    F = sp.Symbol("F")
    left = (F - D * RISE) * (X**2 - T**2)
    right = X * (X * F - 2 * D) - T**2 * (F - 2 * sign * D * X)
    text = "(F - D(tanh ũ - tanh u))(X² - T²) = X(XF - 2D) - T²(F - 2DX)"
    return Equation(text, left, right, Quotient((X, T, F, D)))


def hyperbolic() -> Equation:
    """I₂/I₃ - 1 - ϰ² in terms of positive factors."""
    square = (I1 - I2) * (I2 - I3) / ((I1 + D) * (I3 + D))
    right = (I2 - I3) * (D * (I1 + I3 + D) + I2 * I3) / (I3 * (I1 + D) * (I3 + D))
    text = "I₂/I₃ - 1 - ϰ² = (I₂ - I₃)(D(I₁ + I₃ + D) + I₂I₃)/(I₃Λ₁Λ₃)"
    return Equation(text, I2 / I3 - 1 - square, right, Quotient((I1, I2, I3, D)))


@claim(
    "separatrix-map",
    r"l = \tfrac1{\Lambda_2}:\quad h\bigl(\varkappa X^2+\tfrac1\varkappa\bigr) = 2I_2X + D(\tanh\tilde u-\tanh u),\ "
    r"X = \coth\tfrac{\tilde u-u}2,\ \varkappa^2 = \tfrac{(\Lambda_1-\Lambda_2)(\Lambda_2-\Lambda_3)}{\Lambda_1\Lambda_3}",
    uses=("prop-3", "prop-4", "small-branch", "symmetries", "chord"),
)
def separatrix_map(p: Proof) -> None:
    """The reduced map on the arcs between the unstable rotations, in one line; its increments, and their limit."""
    p.assume("I₁ > I₂ > I₃ > 0, D > 0", *(x > 0 for x in (I1 - I2, I2 - I3, I3, D)))
    p.assume("0 < h below the bound of small-branch, so h < I₃, and ϰ > 0; h < 0 is the inverse map (self-adjoint)")
    p.say(
        "1. On |γ| = 1, l = 1/Λ₂ is γ₁²(1/Λ₂ - 1/Λ₁) = γ₃²(1/Λ₃ - 1/Λ₂): two circles through ±e₂, that is these two",
        "fixed points and four arcs γ = (C1 sech u, tanh u, C3 sech u), C1² + C3² = 1. Take C1C3 < 0 (else -u for u:",
        "symmetries). The arc is mapped to itself: l is kept (prop-3), and so is the arc along G_{th}, 0 ≤ t ≤ 1. No",
        "point of it is fixed: a Gibbs vector τγ with 𝒦 ∥ γ needs τ(Iγ - ⟨γ,Iγ⟩γ) + τ²γ × Iγ = 0, two orthogonal",
        "parts, so γ would be along an axis. Let u = ū - a, ũ = ū + a, a ≠ 0, X = coth a, T = tanh ū, E² = (1 -",
        "T²)(X² - 1): then γ, γ~ = (C1E, TX ∓ 1, C3E)/(X ∓ T), and",
    )
    for sign in (-1, 1):
        at = place(sign)
        p.lemma(Equation(f"|γ|² = 1, ⟨γ,Λ⁻¹γ⟩ = 1/Λ₂ at ū {'+' if sign > 0 else '-'} a",
                         [at.dot(at), at.dot(INVERSE * at)], [1, 1 / MIDDLE], ON_ARC))  # fmt: skip
    p.lemma(Equation("tanh ũ - tanh u = 2X(1 - T²)/(X² - T²)", place(1)[1] - place(-1)[1], RISE, ON_ARC))
    p.lemma(Equation("ϰ = -C1C3Λ₂(Λ₁ - Λ₃)/(Λ₁Λ₃)", KAPPA**2, (L1 - MIDDLE) * (MIDDLE - L3) / (L1 * L3), ON_ARC))
    p.say(
        "2. By prop-4 (5.10) the Gibbs vector of the step is a multiple of Λ⁻¹(γ~ + γ), and Ωᵀγ = γ~ says which: with",
        "ϰu = (C1E₁/Λ₁, T/X, C3E₁/Λ₃), E₁ = Λ₂E/(X² - 1),",
    )
    p.lemma(Equation("u × Λ⁻¹(γ~ + γ) = 0", gibbs_vector().cross(INVERSE * (place(1) + place(-1))), [0] * 3, ON_ARC))
    p.lemma(cayley())
    p.printed(rotated())
    p.say("and the relation is 𝒦 = hγ: the 𝒦 of this u (gibbs) is, for every X and T,")
    p.printed(momentum())
    p.route("from the lemma chord at k = 1: 2Λ₂X - h(ϰX² + 1/ϰ) = D(2X - tanh ũ + tanh u)", *from_the_chord())
    _increments(p)
    p.control(replace(rotated(2), text="the same with 2u"), replace(momentum(-D), text="the relation with -D"))
    p.control(replace(curve(-1), text="the same with F + 2DX"))
    p.control(replace(root(-1), text="the smaller root has F' = 2S, too"))


def _increments(p: Proof) -> None:
    p.say(
        "3. Let Y = D(tanh ũ - tanh u) > 0 and F(X) = hϰX² - 2I₂X + h/ϰ, so F(X) = Y. Where S² = I₂² - h² + hϰY, S >",
        "0,",
    )
    p.printed(root())
    p.say("the smaller root of F(X) = Y has -S for S. Let X₀ be the larger root of F(X) = 0. It is beyond 1, since")
    p.lemma(hyperbolic())
    p.say(
        "is positive: h²ϰ² < I₃²(I₂/I₃ - 1) < I₂², so hϰX₀ = I₂ + √(I₂² - h²) > I₂ > hϰ. Let c = 2 arcoth X₀. On the",
        "small branch X > X₀: X < 0 would give F(X) > 0 > Y; as F(X) = Y > 0, X is beyond X₀ or below the smaller",
        "root; at th, 0 < t ≤ 1, it is continuous, and as t → 0, ũ - u → 0, X → ∞, while the smaller root tends to 0.",
        "So every increment is in (0, c), and as u → ±∞, Y → 0 and ũ - u → c. At fixed u, F - Y grows with X from X₀",
        "on, as F' ≥ 2√(I₂² - h²) and Y falls with X: there is no other root beyond X₀.",
    )
    p.lemma(Equation("2/X - (tanh ũ - tanh u) = 2T²(X² - 1)/(X(X² - T²)) ≥ 0", 2 / X - RISE,
                     2 * T**2 * (X**2 - 1) / (X * (X**2 - T**2)), ON_ARC))  # fmt: skip
    p.say("In X and T, T² = X(XF - 2D)/(F - 2DX): for most parameters a curve of genus 2.")
    p.lemma(curve())
    values = {I1: 5, I2: 4, I3: 2, D: 1, h: "20/13", kappa: "1/3", X: 15}
    square, ratio = (I1 - I2) * (I2 - I3) / ((I1 + D) * (I3 + D)), h / I3
    facts = (
        Comparison("ϰ = 1/3, and 15 is X₀", [sp.Eq(square, kappa**2), sp.Eq(h * (kappa * X**2 + 1 / kappa), 2 * I2 * X)], values),
        Comparison("h is below the bound of small-branch: ϱ < 1/2, as h/I₃ < 4/5, and ½(½(I₁ - I₃) + h) < I₃",
                   [ratio < sp.Rational(4, 5), (I1 - I3) / 4 + h / 2 < I3], {x: values[x] for x in (I1, I3, h)}),
    )  # fmt: skip
    p.lemma(*facts)
    p.witness("J = (1/2, 3/2, 7/2), D = 1, h = 20/13", {str(x): str(v) for x, v in values.items()}, *facts)


UNIFORM = "increments on levels near 1/Λ₂ tend to those on it, with a summable bound"
PASSAGE = "q steps displace to the side of Δ(u) - β + o(1), uniformly for u in compact sets, where 2K - qc_k = β"


def bound_of_dn(sign: int = 1) -> Equation:
    """The bound of dn² from sn ≥ tanh, with k² = 1 - k'²."""
    t, k = sp.symbols("t k")
    return Equation(
        "1 - k²tanh² = sech² + k'²tanh²", 1 - (1 - k**2) * t**2, 1 - t**2 + sign * k**2 * t**2, Quotient((t, k))
    )


def without_the_mean(sign: int = -1) -> Equation:
    """With Z(u) = ε(u) - eu, e = E/K, the relation of chord is unchanged for ε, ε' = dn², in place of Z."""
    e, u, a, at_a, first, last, rest = sp.symbols("e u a epsilon_a epsilon_1 epsilon_2 w")
    psi, z = 2 * (at_a - e * a) + rest, last - e * (u + 2 * a) - (first - e * u)
    right = 2 * at_a + rest - (last - first)
    return Equation("Ψ - Z(u~) + Z(u) = 2ε(a) + 2w/y - ε(u~) + ε(u)", psi + sign * z, right,
                    Quotient((e, u, a, at_a, first, last, rest)))  # fmt: skip


@claim(
    "separatrix-limit",
    r"\Delta(u) = h_+(u)+h_+(-u),\ h_+ = \lim(u_n-nc):\quad \Delta \text{ is not constant} \Rightarrow "
    r"\text{levels with displacements of both signs in every neighbourhood of } l = \tfrac1{\Lambda_2}",
    uses=("separatrix-map", "chord", "locked-circle", "small-branch", "reversible", "symmetries"),
)
def separatrix_limit(p: Proof) -> None:
    """Near the separatrix the displacement by q steps has the sign of Δ less a constant; Δ compares the ends of an orbit on it."""
    p.assume("I₁ > I₂ > I₃ > 0, D > 0, 0 < h below the bound of small-branch; h < 0 is the inverse map")
    p.state(Theorem((), (terms.THREE, terms.SMALL_BRANCH, terms.NOT_CONSTANT), (terms.BOTH_SIGNS,)))
    p.say(
        "f is the map u ↦ ũ of separatrix-map, c the limit of its increments, g(u) = f(u) - u - c. On levels l > 1/Λ₂",
        "near 1/Λ₂ k < 1, f_k is the map u ↦ u~ of the circle, of period 4K, increasing, f_k(u + 2K) = f_k(u) + 2K",
        "(locked-circle). 1. Increments, uniformly. In chord the mean of dn² goes out, ε' = dn², ε(0) = 0:",
    )
    p.printed(without_the_mean())
    p.say(
        "so N_k(a) + D∫_u^{u+2a} dn² = 0, N_k = M - D(2ε + 2w/y), a = ½(f_k(u) - u). N_k is analytic in a > 0 and l",
        "near 1/Λ₂ (λ = sech²a/Λ₂ there), and N_1(a) = -F(coth a), with derivative (X² - 1)F'(X) > 0 where X > 1, F'",
        "> 0. Choose a₂ > c/2 with that at X = coth a₂, and a₁ < c/2 so small that -F(coth a₁) + 2D tanh a₁ < 0. Then",
        "there is an m > 0 with N_k' ≥ m on [a₁, a₂] for k near 1. The integral grows with a, and for one a it is",
        "largest where ū = 0, as dn² is even, of period 2K, and falls on [0, K]: so N_k + D∫dn² is negative at a₁,",
        "positive at a₂, and has one zero between, for every u. The small branch has it: at u = 0 it tends to that of",
        "the separatrix as k → 1, as G_h is continuous, and it is continuous in u, and never a₁ or a₂. Let N_k(c_k/2)",
        "= 0, c_k → c. Then m|f_k(u) - u - c_k| ≤ 2D∫_u^{u+2a} dn². And dn u ≤ Ce^{-|u|} for |u| ≤ K, with one C for",
        "all k: sn ≥ tanh as ∫ds/√((1-s²)(1-k²s²)) ≤ ∫ds/(1-s²),",
    )
    p.lemma(bound_of_dn())
    p.say(
        "and k' ≤ e^{π/2}e^{-K} (K + log k' ≤ π/2, DLMF 19.9.1). dn has period 2K: so |f_k(u) - u - c_k| ≤ C_R",
        "e^{-2|u|} for |u| ≤ K + R, every R; and f_k(u) - u - c_k → g(u), uniformly for u in compact sets. For k = 1",
        "|g(u)| ≤ Ce^{-2|u|}: h₊(u) = lim(uₙ - nc) = u + Σg(uₙ) exists, is continuous, h₊(f(u)) = h₊(u) + c.",
    )
    p.step(UNIFORM, terms.THREE, terms.SMALL_BRANCH, "separatrix-map", "chord", "small-branch", "locked-circle")
    p.say(
        "2. Half a passage. Let u₀ be in a compact set, and n → ∞ as k → 1 with uₙ ≤ K + R. Increments are at least",
        "2a₁: so Σ_{i<n}(u_{i+1} - u_i - c_k) has the summable bound C_R e^{-2|u_i|}, and each term tends to that of",
        "k = 1. Hence",
        "    uₙ = h₊(u₀) + nc_k + o(1), uniformly.",
        "3. The passage. f_k(-f_k(u)) = -u: the relation keeps its form if (u, u~) becomes (-u~, -u). So the orbit",
        "that goes back from 2K + u₀ is 2K - w_j, w_j the orbit from w₀ = -u₀. Let β = 2K - qc_k be bounded, n =",
        "⌊q/2⌋. Up to K u_i = ic_k + O(1), and nc_k = K + O(1): O(1) steps are beyond K, so uₙ < K + R for an R, and",
        "so is w_{q-n}. As f_k increases,",
        "    u_q > u₀ + 2K  <=>  uₙ > 2K - w_{q-n}  <=>  Δ(u₀) - β + o(1) > 0,  Δ(u₀) = h₊(u₀) + h₊(-u₀), and likewise for <.",
    )
    p.step(PASSAGE, UNIFORM, "reversible")
    p.say(
        "4. The levels. Let Δ(x) < β < Δ(y). For every large q there is a k with 2K - qc_k = β, as the left side is",
        "below β at a fixed k near 1 and tends to ∞ as k → 1; so k → 1 as q → ∞. For large q the displacement u_q -",
        "u₀ - 2K, p = 1, is negative at u₀ = x, positive at u₀ = y, and so it is on an interval of levels. They tend",
        "to 1/Λ₂ as q grows. By locked-circle every finite invariant measure on their circles is carried by finitely",
        "many points, and no finite measure that G_h keeps has a density that is positive almost everywhere near the",
        "level l = 1/Λ₂. Another order of the moments is the same with other names (symmetries).",
    )
    p.step(terms.BOTH_SIGNS, PASSAGE, terms.NOT_CONSTANT, "symmetries")
    plain = Quotient((X, D, h, kappa, I2))
    rate = sp.diff(2 * I2 * X - h * (kappa * X**2 + 1 / kappa), X) * (1 - X**2)
    p.lemma(Equation("d/da(-F(coth a)) = (X² - 1)(2hϰX - 2I₂)", rate, (X**2 - 1) * (2 * h * kappa * X - 2 * I2), plain))
    p.control(replace(bound_of_dn(-1), text="1 - k²tanh² = sech² - k'²tanh²"))
    p.control(replace(without_the_mean(1), text="the same with Ψ + Z(u~) - Z(u)"))


if __name__ == "__main__":
    main(__file__)
