"""Section 5: the reduced map on its invariant curve: the curve, the increment, measures, and the circle."""

import sympy as sp
from sympy.core.relational import Relational

from chapsym.derive import continuous, elliptic, solutions, three, vertical
from chapsym.derive.elliptic import HALF, L1, L2, L3, LAMBDA, U, k2, l
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import RING, D, gamma, placed, q, q0
from chapsym.derive.vertical import h, sigma
from chapsym.proofs.paper.s5_increment import (
    PARTS,
    SCALE,
    G,
    V,
    curve_equation,
    level,
    part,
    quotients,
    step_point,
    true_g,
    true_relation,
    w,
    y,
)
from chapsym.proofs.paper.s5_vertical import SMALL
from chapsym.prove import COMPLEX, REAL, Comparison, Count, Equation, Fact, Proof, claim, equations, main

equation = equations(RING)

REGULAR = "Λ1, Λ2, Λ3 are different, and l is none of 1/Λ1, 1/Λ2, 1/Λ3"


@claim(
    "5.6-curve",
    r"\text{the curve } \mathcal E:\ \gamma_1^2+\gamma_2^2+\gamma_3^2 = 1,\ "
    r"\Lambda_1^{-1}\gamma_1^2+\Lambda_2^{-1}\gamma_2^2+\Lambda_3^{-1}\gamma_3^2 = l,\ \text{covers the curve } \mathcal E_0:\ "
    r"w^2 = -(z-\Lambda_1^{-1})(z-\Lambda_2^{-1})(z-\Lambda_3^{-1})(z-l),\ \text{4-fold, unramified}",
    ["prop-3", "5.8-modulus"],
)
def invariant_curve(p: Proof) -> None:
    """The invariant curve covers the quartic by z and w = const·γ₁γ₂γ₃(z-l)²: four sign changes, none with a fixed point."""
    p.infers(
        "Each fibre has four points, at infinity and at the roots, too, by counting signs and zeros: so nothing is ramified."
    )
    roots = [1 / lam for lam in LAMBDA]
    gaps = (L1 - L2, L2 - L3, L3 - L1)
    p.assume(REGULAR, *(sp.Ne(x, 0) for x in (*gaps, *(l - root for root in roots))))
    z = sp.Symbol("z")
    squares = [
        (z - roots[i]) * (l - roots[j]) * (l - roots[k]) / ((z - l) * (roots[i] - roots[j]) * (roots[i] - roots[k]))
        for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1))
    ]
    ring = Quotient((z, l, *LAMBDA))
    p.say(
        "On the curve the squares γ_i² lie on a line; z on it is chosen so that γ_i² = 0 at z = 1/Λ_i and ∞ at z = l:"
    )
    p.show("γ₁²", squares[0])
    p.printed(Equation("|γ|² = 1 for every z", sum(squares), 1, ring))
    p.printed(Equation("⟨γ,Λ⁻¹γ⟩ = l for every z", sum(s * a for s, a in zip(squares, roots, strict=True)), l, ring))
    scale = (roots[0] - roots[1]) * (roots[1] - roots[2]) * (roots[2] - roots[0]) / sp.prod(l - a for a in roots)
    p.say("w = γ₁γ₂γ₃ (z - l)² Π_{i<j}(1/Λ_i - 1/Λ_j)/Π(l - 1/Λ_i) is real where γ is, and")
    quartic = -sp.prod(z - a for a in roots) * (z - l)
    whole = sp.prod(squares) * (z - l) ** 4 * scale**2
    p.reads(
        {rf"\Lambda_{i + 1}": (lam, "an entry of Λ (5.2)") for i, lam in enumerate(LAMBDA)},
        {rf"\gamma_{i + 1}^2": (of, "its square on the curve, as a function of z") for i, of in enumerate(squares)},
        ("l", l, "the level (5.5)"),
        ("z", z, "a coordinate of the line on which the squares are"),
        ("w^2", whole, "the square of γ₁γ₂γ₃ (z - l)² Π_{i<j}(1/Λ_i - 1/Λ_j)/Π(l - 1/Λ_i)"),
    )
    p.printed(Equation("w² = -(z-1/Λ1)(z-1/Λ2)(z-1/Λ3)(z-l)", whole, quartic, ring))
    p.say(
        "A point (z, w) fixes γ_i² and γ₁γ₂γ₃: four γ, from one by changing two of the four signs of (1, γ₁, γ₂, γ₃) in P³.",
        "A change of two signs has a fixed point only where two of the four coordinates vanish:",
        "No two of γ₁², γ₂², γ₃² vanish at one z: γ_i² does at z = 1/Λ_i alone, where γ_j² is a product of differences",
    )
    pairs = [(i, j, 3 - i - j) for i in range(3) for j in range(3) if i != j]
    p.lemma(Equation("γ_j² = (l - 1/Λ_k)/(1/Λ_j - 1/Λ_k) at z = 1/Λ_i", [squares[j].subs(z, roots[i]) for i, j, _ in pairs],
                     [(l - roots[k]) / (roots[j] - roots[k]) for _, j, k in pairs], ring))  # fmt: skip
    p.say(
        "and two of them do not vanish at infinity (z = l), where each γ_i² has a simple pole with a non-zero coefficient:"
    )
    residues = [sp.factor((s * (z - l)).subs(z, l)) for s in squares]
    p.lemma(Equation("the poles: Π(l - 1/Λ)/((1/Λ_i - 1/Λ_j)(1/Λ_i - 1/Λ_k))", residues,
                     [sp.prod(l - a for a in roots) / sp.prod(a - b for b in roots if b != a) for a in roots], ring))  # fmt: skip
    p.say("So every fibre has four points.  The modulus of (5.8) is a cross-ratio of the four roots:")
    first, second, third = roots
    ratio = (first - second) * (l - third) / ((first - l) * (second - third))
    p.lemma(Equation("k² is the cross-ratio of 1/Λ1, 1/Λ2, l, 1/Λ3", ratio, elliptic.squared_modulus(), ring))
    point = {L1: 4, L2: 2, L3: 1, l: sp.Rational(5, 8), z: sp.Rational(3, 8)}
    at = [s.subs(point) for s in squares]
    p.witness(
        "generic",
        {"Λ": "(4, 2, 1)", "l": "5/8", "z": "3/8", "γ_i²": str(at)},
        Fact("they add up to 1", sum(at) == 1),
        Fact("and are positive: a real point", min(at) > 0),
    )
    p.control(Equation("w² = +(z-1/Λ1)(z-1/Λ2)(z-1/Λ3)(z-l)", whole, -quartic, ring))
    p.control(Equation("⟨γ,Λγ⟩ = l", sum(s * lam for s, lam in zip(squares, LAMBDA, strict=True)), l, ring))
    together = sp.solve([(z - first), (z - second).subs(L2, L1)], z)
    p.control(Fact("no two of γ₁², γ₂² vanish at one z when Λ1 = Λ2", not together))


# Two verticals on a curve with the same increment: T is linear in x = sn²ū, as 𝒟 = 1 - k² x y.
x1, x2 = sp.symbols("x1 x2")
SPREAD = Quotient((k2, x1, x2, *PARTS.symbols), PARTS.relations)


def relation_at(x: sp.Expr) -> sp.Expr:
    """T at sn²ū = x."""
    return true_relation().subs(SCALE, 1 - k2 * x * y)


@claim(
    "5.9",
    r"u_{k+1} = u_k+\Delta u_k(u_k,l),\text{ and } \Delta u_k \text{ depends on } u_k \text{ for } D\ne0",
    ["5.15", "prop-3", "5.7"],
)
def one_dimensional_map(p: Proof) -> None:
    """The reduced map on a curve is u + Δu(u, l); for D ≠ 0 an increment serves one value of sn²ū only."""
    p.infers(
        "If Δu did not depend on u, T = 0 at two points with different sn²ū would make D = 0, by the two identities."
    )
    p.assume("(5.15) as corrected, T = G𝒟 - 2Vw(𝒟 - Dλ) = 0 with λ = l - μ sn²δu; a branch is chosen")
    p.assume(
        "V, y = sn²δu, 𝒟 and λ = Π1𝒟 = ¼⟨s,Λ⁻¹s⟩𝒟, s = γ + γ~, are not 0: s ≠ 0 and δu is no half period of sn",
        *(sp.Ne(x, 0) for x in (V, y, SCALE, level)),
    )
    p.assume("0 < k² < 1", *elliptic.MODULUS)
    p.say(
        "Nor is w = sn cn dn δu: cn δu = 0 or dn δu = 0 would leave T = G𝒟 with G ≠ 0, as dn²δu - k²cn²δu = 1 - k² ≠ 0:"
    )
    p.lemma(
        curve_equation("cn δu = 0: G = (C3²/Λ3²) dn²δu", true_g().subs(HALF.cn, 0), quotients()[2] * HALF.dn**2),
        curve_equation(
            "dn δu = 0: G = (C1²/(k²Λ1²)) cn²δu", true_g().subs(HALF.dn, 0), quotients()[0] / k2 * HALF.cn**2
        ),
        curve_equation("dn²δu - k²cn²δu = 1 - k²", HALF.dn**2 - k2 * HALF.cn**2, 1 - k2),
    )
    p.say("l is kept (prop-3) and u is the coordinate on its curve (5.7): the map is u + Δu(u, l).")
    p.say("Let one δu solve T = 0 at two points of the curve, x1 = sn²ū1 and x2 = sn²ū2:")
    same = [relation_at(x1), relation_at(x2)]
    p.printed(
        Equation(
            "T(x1) - T(x2) = -k²y(G - 2Vw)(x1 - x2)", same[0] - same[1], -k2 * y * (G - 2 * V * w) * (x1 - x2), SPREAD
        ),
        Equation("T = 2VwDλ where G = 2Vw", relation_at(x1).subs(G, 2 * V * w), 2 * V * w * D * level, SPREAD),
    )
    p.say("So x1 ≠ x2 would make G = 2Vw and then 2VwDλ = 0, which is excluded when D ≠ 0: Δu is not constant.")
    state = step_point()
    there = {
        name: state.evaluate(value)
        for name, value in (("T", true_relation()), ("2VwDλ", 2 * V * w * D * level), ("G - 2Vw", G - 2 * V * w))
    }
    p.witness(
        "generic", state.values,
        Fact("the hypotheses of a step hold", not state.failures()),
        Fact("T = 0, 2VwDλ ≠ 0 and G ≠ 2Vw", there["T"] == 0 != there["2VwDλ"] and there["G - 2Vw"] != 0),
    )  # fmt: skip
    p.control(part("T does not depend on 𝒟, so on ū", sp.diff(true_relation(), SCALE), 0 * w))
    p.control(Equation("T(x1) = T(x2)", same[0], same[1], SPREAD))


def at_height() -> list[sp.Expr]:
    """(5.2) with 𝒦 = hγ."""
    return [e.xreplace(placed((three.K, h * gamma))) for e in solutions.equations()]


@claim(
    "remark-4",
    r"D=0: \Delta u_k \text{ is constant};\ D\ne0: \sigma_k \text{ is not constant on the orbits of } \mathcal G_h",
    ["5.15-euler", "5.11", "5.9"],
)
def structure(p: Proof) -> None:
    """Without rolling the increment is constant; with it σ changes along orbits, on every branch."""
    p.infers(
        "Constant for D = 0, as T = 0 does not have ū; not constant: at one state no real next step has the σ of the step before."
    )
    p.assume("(5.6) with σ as corrected; the branch of the next step is any, real or complex")
    p.printed(
        part("D = 0: T = 𝒟(G - 2Vw), without ū but for 𝒟", true_relation(contact=sp.S.Zero), SCALE * (G - 2 * V * w))
    )
    p.say("D = 0: σ = h + 2Dq₀⟨γ,q⟩ = h is constant, too.  D > 0, an exact state and all its successors:")
    state = {symbol: sp.Rational(value) for symbol, value in SMALL.items()}
    ball = tuple(state[x] for x in (three.J1, three.J2, three.J3))
    height = vertical.height().xreplace(state)
    here = vertical.gamma_now().xreplace(state)
    there = vertical.gamma_next().xreplace(state)
    p.say(
        f"J = {ball}, D = {state[D]}, (q₀, q) = (4, 2, 1, 2)/5: γ = {list(here)}, h = {height}, σ = {state[sigma]}; γ~ = {list(there)}."
    )
    p.lemma(
        Comparison(
            "h and γ~ at that state",
            [sp.Eq(a, b) for a, b in zip((vertical.height(), *vertical.gamma_next()), (height, *there), strict=True)],
            state,
        )
    )
    # 2Dq₀⟨γ,q⟩ = (σ - h)(q₀² + |q|²): the solution for this γ has the given σ.
    keeps = 2 * D * q0 * gamma.dot(q) - (sigma - h) * solutions.NORM

    def steps(text: str, start: sp.Matrix, *relations: Relational) -> Count:
        values = placed((three.MASSES, ball), ([D, h, sigma], [state[D], height, state[sigma]]), (gamma, start))
        return Count(text, at_height(), solutions.POINT, values, relations, RING, [keeps])

    all_of_them = (sp.Eq(REAL, 2), sp.Eq(COMPLEX, 8))
    p.printed(steps("γ~ has 8 next steps, 2 of them real; none has the σ of the step before", there, *all_of_them))
    flat = {**state, D: sp.S.Zero}
    p.witness("D = 0", {"σ": "h"}, Fact("σ = h", vertical.height().xreplace(flat) == state[sigma]))
    p.control(steps("the same for the step's own γ", here, sp.Eq(COMPLEX, 8)))
    p.control(part("T = 𝒟(G - 2Vw) for every D", true_relation(), SCALE * (G - 2 * V * w)))


@claim(
    "5.9-liouville",
    r"u_k=f(s_k),\ u_{k+1}=f(s_k+\Delta s) \iff \tfrac{\partial u_{k+1}}{\partial u_k}=\tfrac{\mu(u_k)}{\mu(u_{k+1})},\ "
    r"df/ds=1/\mu \iff \mathcal G_h \text{ preserves a measure on } S^2",
    ["5.9", "prop-3"],
)
def invariant_density(p: Proof) -> None:
    """A constant increment in some parameter, an invariant density on the curves, and one on the sphere are the same."""
    p.infers("The chain rule, the substitution s = ∫μ du, and the area in the coordinates (l, u).")
    p.assume(
        "regular levels l, where u is a coordinate; a branch of the map that is a diffeomorphism of each; densities positive and smooth"
    )
    p.assume("Δs is constant on a curve; it may depend on l. f and μ are smooth and positive in u and in l together")
    p.assume(
        "s is a coordinate of the circle, as u is: f(s + S) = f(s) + the period of u. On the line alone there is an f for "
        "every step without a fixed point: any increasing one from [0, Δs] to [u, u~], continued by the step"
    )
    s, shift = sp.symbols("s c")
    f = sp.Function("f")
    p.say(
        "u = f(s), u~ = f(s + c) with f' = 1/μ(f): du~/du = f'(s+c)/f'(s), by the chain rule.  With f1, f2, μ1, μ2 for"
    )
    p.say("f' and μ(f) at s and s + c, f1μ1 = 1 = f2μ2:")
    now, after, first, second = sp.symbols("mu1 mu2 f1 f2")
    slope = sp.diff(f(s + shift), s).doit() / sp.diff(f(s), s)
    slope = slope.subs({sp.diff(f(s + shift), s).doit(): second, sp.diff(f(s), s): first})
    densities = Quotient((now, after, first, second), [first * now - 1, second * after - 1])
    p.printed(Equation("du~/du = μ(u)/μ(u~)", slope, now / after, densities))
    p.say("The other way round s = ∫μ du: ds~ = μ(u~)du~ = μ(u)du = ds, so s~ - s is constant on the curve.")
    p.say("μ = 1/f' has the period of u exactly when f(s + S) = f(s) + that period, with S = ∫μ du over the circle.")
    p.lemma(Equation("μ(u~) du~/du = μ(u) for that slope", after * slope, now, densities))
    p.say("On the sphere: (l, u) ↦ (l, u~) has the Jacobian ∂u~/∂u.  The area is a function of l times dl du:")
    a, b, c = elliptic.squared_amplitudes()
    ring = elliptic.ring(U)
    p.say("γ = (C1 cn, C2 sn, C3 dn): γ_u = c γ×Λ⁻¹γ, with one c for all three components and every u, as")
    p.lemma(Equation("C1²(1/Λ1 - 1/Λ3) = -C2²(1/Λ3 - 1/Λ2)", a * (1 / L1 - 1 / L3), -b * (1 / L3 - 1 / L2), ring))
    modulus = elliptic.squared_modulus()
    third = c * modulus * (1 / L3 - 1 / L1)
    p.lemma(Equation("k²C3²(1/Λ3 - 1/Λ1) = C2²(1/Λ2 - 1/Λ1)", third, b * (1 / L2 - 1 / L1), ring))
    change, factor = sp.Matrix(sp.symbols("b1:4")), sp.Symbol("c")
    level_of = gamma.dot(sp.diag(*[1 / lam for lam in LAMBDA]) * gamma)
    moved = change.dot(sp.diag(*[1 / lam for lam in LAMBDA]) * gamma)
    sphere = Quotient(
        (factor, *change, *gamma, *LAMBDA),
        [three.UNIT_VERTICAL, gamma.dot(change), sp.numer(sp.together(2 * moved - 1))],
    )
    direction = factor * gamma.cross(sp.diag(*[1 / lam for lam in LAMBDA]) * gamma)
    area = gamma.dot(direction.cross(change))
    p.printed(Equation("⟨γ, γ_u×γ_l⟩ = -c/2, for |γ| = 1, ⟨γ,γ_l⟩ = 0, ⟨Λ⁻¹γ,γ_l⟩ = ½", area, -factor / 2, sphere))
    p.say("So m dA = m c(l)/2 dl du up to sign is preserved exactly when m(γ(l,u)) is a density μ on every curve.")
    at = dict(zip((*gamma, *LAMBDA), (sp.Rational(2, 3), sp.Rational(1, 3), sp.Rational(2, 3), 6, 5, 2), strict=True))
    p.witness(
        "generic",
        {"γ": "(2, 1, 2)/3", "Λ": "(6, 5, 2)"},
        Fact("l is regular", level_of.subs(at) not in (sp.Rational(1, n) for n in (6, 5, 2))),
    )
    p.control(Equation("du~/du = μ(u~)/μ(u)", slope, after / now, densities))
    without = Quotient(sphere.symbols, sphere.relations[:2])
    p.control(Equation("⟨γ, γ_u×γ_l⟩ = -c/2 without ⟨Λ⁻¹γ,γ_l⟩ = ½", area, -factor / 2, without))


@claim(
    "5.9-circle",
    r"\text{the restriction of (5.9) to the real axis is a diffeomorphism of a circle}",
    ["5.9", "5.3-at-least-2"],
)
def circle(p: Proof) -> None:
    """A diffeomorphism of the circle when |h| is small; for large |h| there may be no real step at all."""
    p.infers(
        "The theorem on implicit functions along a compact curve; a map C¹-close to the identity that keeps a circle is a diffeomorphism of it."
    )
    p.slips("reading")
    p.assume("Λ1, Λ2, Λ3 different, l regular: each real component of the curve is a circle, u mod its real period")
    p.assume("J_i + J_j > 0, D ≥ 0 (2.13), so that F > 0", *three.MOMENTS)
    p.say(
        "h = 0 has the solution q = 0, where ∂𝒦/∂q = 2B(γ) is regular on the whole curve, as F = 1 - Dl is constant on it:"
    )
    inertia = sp.Matrix(three.contact_inertia())
    jacobian = sp.Matrix(three.momentum()).jacobian(q).xreplace({**dict.fromkeys(q, 0), q0: 1})
    factor = continuous.rolling_factor()
    level_of = gamma.dot(continuous.inverse_inertia() * gamma)

    def images(text: str, contact: int, height: sp.Expr, relation: Relational) -> Count:
        vertical_turn = ("2/7", "3/7", "6/7")
        point = placed((three.MASSES, (1, 2, 4)), ([D, h], [contact, height]), (gamma, vertical_turn))
        return Count(text, at_height(), solutions.POINT, point, [relation], RING)

    p.printed(images("the number of real q with 𝒦 = hγ", 7, sp.Integer(40), REAL >= 1))
    p.under(
        "|h| small enough, on the small branch",
        equation("∂𝒦/∂q = 2B(γ) at q = 0", jacobian, 2 * inertia),
        equation("det B = det Λ · F", inertia.det(), three.lam().det() * factor),
        equation("F = 1 - D⟨γ,Λ⁻¹γ⟩", factor, 1 - D * level_of),
        images("the same γ with h = 1/10 has 4 real solutions, D = 3", 3, sp.Rational(1, 10), sp.Eq(REAL, 4)),
    )
    p.say(
        "F = ⟨Iγ,Λ⁻¹γ⟩ > 0.  So q(γ, h) is analytic near h = 0 along the compact curve (implicit functions), q = O(h):"
    )
    p.say("u ↦ u + Δu is C¹-close to the identity, keeps the circle and has a positive derivative: a diffeomorphism.")
    p.control(equation("det B = det Λ", inertia.det(), three.lam().det()))
    p.control(images("γ has 4 images at h = 40, too", 7, sp.Integer(40), sp.Eq(REAL, 4)))


if __name__ == "__main__":
    main(__file__)
