"""A level circle on which q steps go both beyond and short of p half turns: what an invariant measure can be there."""

from dataclasses import replace

import sympy as sp

from chapsym.derive import three
from chapsym.derive.elliptic import L1, L2, L3, LAMBDA, l
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import gamma
from chapsym.proofs.open import terms
from chapsym.proofs.paper.s5_reduced_map import REGULAR
from chapsym.prove import Equation, Fact, Proof, Theorem, claim, main, no, there_is

ON_LEVEL = Quotient(
    (*gamma, *LAMBDA, l),
    [three.UNIT_VERTICAL, sp.numer(sp.together(sum(g**2 / lam for g, lam in zip(gamma, LAMBDA, strict=True)) - l))],
)


def projected(last: sp.Expr = 1 / L3) -> Equation:
    """The level in the plane of two axes: an ellipse about 0."""
    a, b, _ = gamma
    form = a**2 * (1 / L1 - last) + b**2 * (1 / L2 - last)
    return Equation("γ_a²(1/Λ_a - 1/Λ_c) + γ_b²(1/Λ_b - 1/Λ_c) = l - 1/Λ_c", form, l - 1 / L3, ON_LEVEL)


def area(factor: int = 1) -> Equation:
    """The area in the coordinates (l, ψ): positive and finite on the open half γ_c > 0, off the axis c."""
    r, c, s, t = sp.symbols("r c s t")
    plane = Quotient((r, c, s, t, L1, L2, L3), [c**2 + s**2 - 1, r**2 + t**2 - 1])
    gap = c**2 * (1 / L1 - 1 / L3) + s**2 * (1 / L2 - 1 / L3)
    point = sp.Matrix([r * c, r * s, t])
    by_r, by_angle = sp.Matrix([c, s, -r / t]), sp.Matrix([-r * s, r * c, 0])
    by_level = by_r / (2 * r * gap)
    return Equation("⟨γ, γ_l × γ_ψ⟩ = 1/(2γ_c (cos²ψ(1/Λ_a - 1/Λ_c) + sin²ψ(1/Λ_b - 1/Λ_c)))",
                    [factor * point.dot(by_level.cross(by_angle))], [1 / (2 * t * gap)], plane)  # fmt: skip


def displacement(sign: int = 1) -> Equation:
    """(-1)^p (γ_a⁰γ_b - γ_b⁰γ_a) is r⁰r sin(ψ - ψ⁰ - pπ), at p = 1."""
    r, r0, c, s, c0, s0 = sp.symbols("r r0 c s c0 s0")
    plane = Quotient((r, r0, c, s, c0, s0))
    turned = -(r0 * c0 * r * s - r0 * s0 * r * c)
    return Equation("-(γ_a⁰γ_b - γ_b⁰γ_a) = r⁰r sin(ψ - ψ⁰ - π)", turned, sign * r0 * r * (c * s0 - s * c0), plane)


def infinite_density(power: int = -1) -> Equation:
    """μ(f(x))f'(x) = μ(x) for f(x) = x/2, which fixes 0, and μ a power of x."""
    x = sp.Symbol("x")
    mu = x**power
    return Equation(f"μ(x/2)/2 = μ(x) for μ = x^{power}", mu.subs(x, x / 2) / 2, mu, Quotient((x,)))


CIRCLE = "on the half γ_c > 0 of a level G_h is an analytic diffeomorphism g of a circle, with a lift g~"
SHIFT = "F = g~^q - pπ has a displacement δ = F - 1 of period π, and R, the rotation by π about c, commutes with g"
OTHER_HALF = "on the half γ_c < 0 q steps turn by more and by less than -p half turns, too"
STATED = Theorem(
    (),
    (terms.MOMENTS, terms.THREE, terms.SMALL_BRANCH, terms.BOTH_SIGNS),
    (terms.CARRIED, there_is(terms.INFINITE), there_is(terms.LINE), no(terms.PARAMETER), no(terms.MEASURE)),
)


@claim(
    "locked-circle",
    r"\delta = \tilde{\mathcal G}_h^q - 1 - p\pi \text{ takes both signs on a level circle} \Rightarrow "
    r"\text{every finite invariant measure of } \mathcal G_h \text{ on it is carried by finitely many periodic points}",
    uses=["symmetries", "small-branch", "self-adjoint", "prop-3", "5.9-liouville"],
)
def locked_circle(p: Proof) -> None:
    """Displacements of both signs leave a circle no invariant density, and an interval of such levels none to the sphere."""
    p.assume("J_i + J_j > 0, D ≥ 0; |h| below the bound of small-branch, G_h on the small branch")
    p.assume(
        f"{REGULAR}; c is the axis with 1/Λ_c at the end of the 1/Λ's on the side of l, (a, b) the others; γ_c > 0"
    )
    p.assume(
        "an invariant measure is a Borel measure ν ≥ 0 with ν(G_h⁻¹E) = ν(E), finite on the circle (on the sphere)"
    )
    p.state(STATED)
    p.say("1. The circle. By small-branch the root is unique, regular and so analytic in (γ, h): G_h is an analytic")
    p.say("map of the sphere, and G_{-h} its inverse (self-adjoint). It keeps l (prop-3), and the path G_{th}, 0 ≤ t ≤")
    p.say("1, from the identity keeps each component of the level. These are two circles: in the plane of (γ_a, γ_b)")
    p.printed(projected())
    p.say("where the three differences have one sign. So the polar angle ψ of (γ_a, γ_b) is a coordinate of the circle")
    p.say("C with γ_c > 0, g = G_h|C is an analytic diffeomorphism that keeps the orientation, and the path gives it a")
    p.say("lift g~.")
    p.step(CIRCLE, terms.MOMENTS, terms.THREE, terms.SMALL_BRANCH, "small-branch", "self-adjoint", "prop-3")
    p.say("2. R, the rotation by π about c, is ψ ↦ ψ + π on C and commutes with G_{th} (symmetries): g~(ψ + π) = g~(ψ)")
    p.say("+ π. Let F = g~^q - pπ, a lift of f = R^p g^q, and δ = F - 1, of period π. The sign is read from two points")
    p.say("of the plane:")
    p.printed(displacement())
    p.say("The half turns that the steps complete are counted: p where δ > 0, p - 1 where δ < 0, p and ψ in the sense")
    p.say("of the motion.")
    p.step(SHIFT, CIRCLE, "symmetries")
    p.say("3. If δ takes both signs it has a zero: there R^p g^q = 1 and g^{2q} = 1, as R² = 1. It is analytic and not")
    p.say("0, so it has finitely many zeros on C. On an open arc I between two of them, next to each other, f has no")
    p.say("fixed point, and F moves all of I in one sense: I is the disjoint union of f^{2n}[x, f²(x)) over all")
    p.say("integers n. An invariant ν is invariant under f² = g^{2q}: these half-open arcs have one measure, and ν(I)")
    p.say("is finite: so ν(I) = 0. Hence ν is carried by the zeros of δ, points of period 2q at most (q for even p),")
    p.say("and has no density.")
    p.step(terms.CARRIED, SHIFT, terms.BOTH_SIGNS)
    p.say("Finite is needed. Near a fixed point f(x) = x/2 leaves dx/x invariant:")
    p.lemma(infinite_density())
    p.say(
        "And as g commutes with F it permutes the zeros and the arcs. Let g^m be the first power that takes I to itself.",
        "It has no fixed point in I: f^{2m} = (g^m)^{2q} has none. So I/g^m is a circle; a positive smooth density on",
        "it, lifted to I and carried along by g, is invariant under g, positive and smooth, and infinite on each arc.",
    )
    p.step(there_is(terms.INFINITE), SHIFT, terms.BOTH_SIGNS)
    p.say("Nor is there a real u = f(s), f a homeomorphism onto the lift of C, f(s + S) = f(s) + the period of u, with")
    p.say("u_{k+1} = f(s_k + Δs) (5.9-liouville): at a zero of δ 2q steps are p turns, so 2qΔs = pS, 2q steps are p")
    p.say("turns everywhere, F² = 1, and δ would be 0.")
    p.step(no(terms.PARAMETER), SHIFT, terms.BOTH_SIGNS, "5.9-liouville")
    p.say("Without S there is one: as F has a fixed point and p ≥ 1, the rotation number of g~ is not 0, and g~ has no")
    p.say(
        "fixed point. The line modulo g~ is then a real analytic circle, and one of s modulo 1 is analytically the same:"
    )
    p.say("f is this map, lifted to the lines, with Δs = 1.")
    p.step(there_is(terms.LINE), SHIFT, terms.BOTH_SIGNS)
    p.say("4. The half γ_c < 0: there G_h(-γ) = -G_h⁻¹(γ) (symmetries), and what G_h^q does beyond -p half turns is")
    p.say("F⁻¹ - 1 = -δ∘F⁻¹: both signs as well.")
    p.step(OTHER_HALF, SHIFT, terms.BOTH_SIGNS, "symmetries")
    p.say("5. The sphere. δ is continuous in l, ψ and in the parameters J, D, h: what has both signs strictly has them")
    p.say("nearby. On an open interval O of levels with both signs let 𝒜 = {l ∈ O} ⊂ S² and let ν = ρ dA be finite and")
    p.say("invariant. By")
    p.printed(area())
    p.say("ν has the density ρ·|that| in (l, ψ) on each half of 𝒜, integrable over ψ for almost every l (Fubini). As")
    p.say("G_h keeps l, ν({l ∈ E, ψ ∈ B}) = ν({l ∈ E} ∩ G_h⁻¹{ψ ∈ B}) for every Borel set E ⊂ O and each of the")
    p.say("countably many arcs B with rational ends: for almost every l the density is that of a finite invariant")
    p.say("measure on the circle, so it is 0 by 3. Hence ρ = 0 almost everywhere on 𝒜: no finite invariant measure has")
    p.say("a density that is positive almost everywhere. Where ρ is continuous and positive near one circle,")
    p.say("invariance holds at every point, and this circle alone contradicts it. Not excluded are point masses on")
    p.say("periodic orbits, and densities that vanish on all such 𝒜.")
    p.step(no(terms.MEASURE), terms.CARRIED, OTHER_HALF, terms.BOTH_SIGNS)
    at = dict(zip((*LAMBDA, l), (6, 5, 2, sp.Rational(3, 10)), strict=True))
    gaps = [sp.sympify(e).subs(at) for e in (1 / L3 - 1 / L1, 1 / L3 - 1 / L2, 1 / L3 - l)]
    p.witness("a level", {"Λ": "(6, 5, 2)", "l": "3/10"}, Fact("three differences of one sign", min(gaps) > 0))
    p.control(replace(projected(last=1 / L2), text="the same ellipse with 1/Λ_b for 1/Λ_c on the left"))
    p.control(replace(area(factor=2), text="twice ⟨γ, γ_l × γ_ψ⟩ is the same"))
    p.control(replace(displacement(-1), text="the displacement with the other sign"))
    p.control(infinite_density(power=0))


if __name__ == "__main__":
    main(__file__)
