"""Section 5: the relation for the increment of the reduced map, and its algebraic form (5.14 to 5.16)."""

from dataclasses import replace

import sympy as sp

from chapsym.derive import elliptic
from chapsym.derive.elliptic import HALF, L1, L2, L3, LAMBDA, MEAN, U, k2, l
from chapsym.derive.quotient import Quotient
from chapsym.proofs import second_routes
from chapsym.proofs.glossary import Symbols
from chapsym.proofs.paper.s5_elliptic import (
    ARGUMENT,
    BALL,
    SQUARE,
    TWO,
    V,
    curve_symbols,
    level_symbols,
    on_ball,
    printed_squares,
)
from chapsym.prove import Comparison, Equation, Point, Proof, claim, equations, main, rational_point


def on_curve(expr: sp.Expr) -> sp.Expr:
    """An expression with l in terms of the modulus, so that k² is free."""
    return sp.sympify(expr).subs(l, elliptic.level())


def curve_equation(text: str, left: sp.Expr, right: sp.Expr) -> Equation:
    """An equation in sn, cn, dn of ū and δu, with l in terms of k²."""
    return Equation(text, on_curve(left), on_curve(right), TWO)


#: The assumptions of the paper on the curve; l is given by k² and Λ, between 1/Λ2 and 1/Λ3.
ON_CURVES = (*elliptic.MODULUS, *elliptic.ORDER[:3])

#: In all that follows h = 1 (5.12-scaling), y = sn²δu, and w = sn cn dn of δu.
D, Y = sp.Symbol("D"), HALF.sn**2
SMALL_W = HALF.sn * HALF.cn * HALF.dn
MU = (1 - L3 * l) / (L2 - L3)
V_SQUARED = (L2 - L3) * (L1 * l - 1) / (L1 * L2 * L3)
RATIO = HALF.cn * HALF.dn / HALF.sn
#: sn²δu as a free symbol; and the ring of Λ and l alone.
ANY = sp.Symbol("y")
BY_LEVEL = Quotient((*LAMBDA, l, ANY), [])


def quotients() -> list[sp.Expr]:
    """C1²/Λ1², C2²/Λ2², C3²/Λ3²."""
    return [c / lam**2 for c, lam in zip(elliptic.squared_amplitudes(), LAMBDA, strict=True)]


def g_at(y: sp.Expr | int) -> sp.Expr:
    """G at sn²δu = y with the squares of (5.8) as corrected and k² of (5.8), in terms of Λ and l."""
    (a, b, c), modulus = printed_squares(-1), (L1 - L2) * (1 - L3 * l) / ((L2 - L3) * (L1 * l - 1))
    first, second, third = a / L1**2 / modulus, b / L2**2 / modulus, c / L3**2
    return (1 - y) * (first - second * (1 - modulus * y)) + third * (1 - modulus * y)


def true_g() -> sp.Expr:
    """The correct G: with k² under the second term, too."""
    a, b, c = quotients()
    return a / k2 * HALF.cn**2 - b / k2 * HALF.cn**2 * HALF.dn**2 + c * HALF.dn**2


def written_out() -> sp.Expr:
    """The terms of Π2𝒟² that the paper prints there and omits here."""
    a, b, c = quotients()
    return a * MEAN.cn**2 * HALF.cn**2 + b * MEAN.sn**2 * HALF.cn**2 * HALF.dn**2 + c * MEAN.dn**2 * HALF.dn**2


@claim(
    "5.14-Pi1",
    r"\Pi_1 = \tfrac1{\mathcal D}(\tfrac{C_1^2}{\Lambda_1}+\tfrac{C_3^2}{\Lambda_3}"
    r"-\tfrac{C_2^2}{\Lambda_2}\mathrm{sn}^2\delta u) \equiv \tfrac1{\mathcal D}(l-\mu\,\mathrm{sn}^2\delta u),\ "
    r"\mu = \tfrac{1-\Lambda_3l}{\Lambda_2-\Lambda_3}",
    uses=["5.13", "5.8"],
)
def first_form(p: Proof) -> None:
    """Π1 in Jacobi's functions."""
    p.reads(
        level_symbols(),
        (r"\Pi_1", on_curve(elliptic.quarter_form(1)), "¼⟨γ~+γ, Λ⁻¹(γ~+γ)⟩ (5.11)"),
        (r"\mu", on_curve(MU), "(1 - Λ3 l)/(Λ2 - Λ3) (5.14)"),
    )
    p.assume("C3 with the correction of (5.8)")
    p.assume("0 < k² < 1, Λ1 > Λ2 > Λ3 > 0", *ON_CURVES)
    a, b, c = (square / lam for square, lam in zip(elliptic.squared_amplitudes(), LAMBDA, strict=True))
    p.printed(
        curve_equation("Π1 = (l - μ sn²δu)/𝒟", elliptic.quarter_form(1), (l - MU * Y) / elliptic.denominator()),
        curve_equation("C1²/Λ1 + C3²/Λ3 - (C2²/Λ2) sn²δu = l - μ sn²δu", a + c - b * Y, l - MU * Y),
    )
    p.lemma(Equation("μ by Λ and l", elliptic.increment_parts()[4:], [MU], BY_LEVEL))
    p.control(curve_equation("Π1 = (l + μ sn²δu)/𝒟", elliptic.quarter_form(1), (l + MU * Y) / elliptic.denominator()))


@claim(
    "5.14-Pi2",
    r"\Pi_2 = \tfrac1{\mathcal D^2}(\dots) \equiv \tfrac1{\mathcal D^2}\bigl(\tfrac G{\mathrm{sn}^2\delta u}\mathcal D"
    r"-V^2\tfrac{\mathrm{cn}^2\delta u\,\mathrm{dn}^2\delta u}{\mathrm{sn}^2\delta u}\bigr)",
    uses=["5.13", "5.14-G"],
)
def second_form(p: Proof) -> None:
    """Π2 in terms of G."""
    p.reads(
        level_symbols(),
        (r"\Pi_2", on_curve(elliptic.quarter_form(2)), "¼⟨γ~+γ, Λ⁻²(γ~+γ)⟩ (5.14)"),
        ("G", on_curve(true_g()), "the function G of δu (5.14-G as corrected)"),
        ("V^2", on_curve(V_SQUARED), "(Λ2 - Λ3)(Λ1 l - 1)/(Λ1Λ2Λ3) (5.13)"),
        (r"\dots", on_curve(written_out()), "C1²/Λ1² cn²ū cn²δu + C2²/Λ2² sn²ū cn²δu dn²δu + C3²/Λ3² dn²ū dn²δu"),
    )
    p.assume("G with the correction of (5.14-G)")
    p.assume("0 < k² < 1, Λ1 > Λ2 > Λ3 > 0", *ON_CURVES)
    middle = written_out()
    square = elliptic.denominator() ** 2
    right = true_g() / Y * elliptic.denominator() - V_SQUARED * RATIO**2
    p.printed(
        curve_equation("Π2 = (C1²/Λ1² cn²ū cn²δu + ...)/𝒟²", elliptic.quarter_form(2), middle / square),
        curve_equation("Π2 𝒟² = G𝒟/sn² - V² cn² dn²/sn²", elliptic.quarter_form(2) * square, right),
    )
    wrong = true_g() / Y * elliptic.denominator() + V_SQUARED * RATIO**2
    p.control(curve_equation("Π2 𝒟² = G𝒟/sn² + V² cn² dn²/sn²", elliptic.quarter_form(2) * square, wrong))


def derived_g() -> sp.Expr:
    """G as it follows from Π2."""
    return (elliptic.quarter_form(2) * elliptic.denominator() ** 2 + V_SQUARED * RATIO**2) * Y / elliptic.denominator()


@claim(
    "5.14-G",
    r"G = \tfrac{C_1^2}{k^2\Lambda_1^2}\mathrm{cn}^2\delta u-\tfrac{C_2^2}{\Lambda_2^2}\mathrm{cn}^2\delta u\,"
    r"\mathrm{dn}^2\delta u+\tfrac{C_3^2}{\Lambda_3^2}\mathrm{dn}^2\delta u",
    uses=["5.8", "5.8-modulus"],
)
def g_function(p: Proof) -> None:
    """G: k² is missing under its second term."""
    p.slips("typo")
    p.reads(level_symbols() | {"G": (on_curve(derived_g()), "what Π2 𝒟² = G𝒟/sn² - V² cn² dn²/sn² makes of it (5.14)")})
    p.assume("0 < k² < 1, Λ1 > Λ2 > Λ3 > 0", *ON_CURVES)
    p.say("G is what Π2 𝒟² = G𝒟/sn² - V² cn² dn²/sn² makes of it, an identity in sn²ū:")
    a, b, c = quotients()
    derived = derived_g()

    def printed(under: sp.Expr) -> sp.Expr:
        return a / k2 * HALF.cn**2 - b / under * HALF.cn**2 * HALF.dn**2 + c * HALF.dn**2

    p.printed(curve_equation("G as printed", printed(sp.S.One), derived))
    p.corrected(
        r"G = \tfrac{C_1^2}{k^2\Lambda_1^2}\mathrm{cn}^2\delta u-\tfrac{C_2^2}{k^2\Lambda_2^2}\mathrm{cn}^2\delta u\,"
        r"\mathrm{dn}^2\delta u+\tfrac{C_3^2}{\Lambda_3^2}\mathrm{dn}^2\delta u",
        curve_equation("G with k² under the second term", printed(k2), derived),
    )
    parts, (zero, one, minus) = elliptic.increment_parts()[1:4], map(g_at, (0, 1, -1))
    p.lemma(Equation("G₀, G₁, G₂ by Λ and l: from G at sn²δu = 0, 1, -1", parts,
                     [zero, (one - minus) / 2, (one + minus) / 2 - zero], BY_LEVEL),
            Equation("G = G₀ + G₁ y + G₂ y² at y = sn²δu", g_at(ANY), sum(g * ANY**n for n, g in enumerate(parts)), BY_LEVEL))  # fmt: skip
    p.counterexample(curve_point())
    p.control(curve_equation("G with k² under the third term", printed(k2) + c * HALF.dn**2 * (1 / k2 - 1), derived))


def curve_point() -> Point:
    """Λ = (8,7,6), l = 25/168: k² = 9/16, V = 1/42; sn δu = 4/5, ū = 0."""
    values = {**BALL, **SQUARE, **dict(zip(HALF, ARGUMENT, strict=True)), MEAN.sn: 0, MEAN.cn: 1, MEAN.dn: 1}
    free = elliptic.ring(HALF)
    relations = Equation("the relations of δu", HALF.relations(), [sp.S.Zero] * 2, free)
    return rational_point(values, [relations, on_ball()])


def coefficient(expr: sp.Expr, power: int) -> sp.Expr:
    """The coefficient of sn^(2·power) δu in G/V², where cn² and dn² are expressed by sn²."""
    y = sp.Symbol("y")
    in_y = sp.expand(expr).subs({HALF.cn**2: 1 - y, HALF.dn**2: 1 - k2 * y})
    return sp.together(sp.expand(in_y).coeff(y, power) / V_SQUARED)


@claim(
    "5.14-alpha",
    r"G \equiv V^2(1+\alpha\,\mathrm{sn}^2-\beta\,\mathrm{sn}^4),\ "
    r"\alpha = \frac{2\Lambda_1\Lambda_3-(\Lambda_1+\Lambda_3-\Lambda_2)}{(\Lambda_2-\Lambda_3)(\Lambda_1l-1)}",
    uses=["5.14-G"],
)
def alpha(p: Proof) -> None:
    """α: l is missing beside 2Λ1Λ3 in the numerator."""
    p.slips("typo")
    derived, last = (sp.factor(on_curve(coefficient(true_g(), power))) for power in (1, 2))
    p.reads(
        level_symbols(),
        (r"\alpha", derived, "the coefficient of sn² in G/V² (5.14)"),
        (r"\beta", -last, "that of sn⁴, less its sign (5.14)"),
        ("G", on_curve(true_g()), "the function G of δu (5.14-G as corrected)"),
        ("V^2", on_curve(V_SQUARED), "(Λ2 - Λ3)(Λ1 l - 1)/(Λ1Λ2Λ3) (5.13)"),
        (r"\mathrm{sn}^2", Y, "sn² of δu"),
        (r"\mathrm{sn}^4", Y**2, "sn⁴ of δu"),
    )
    p.assume("0 < k² < 1, Λ1 > Λ2 > Λ3 > 0", *ON_CURVES)
    p.lemma(curve_equation("the constant term of G/V² is 1", coefficient(true_g(), 0), sp.S.One))
    p.show("α", derived)
    below = (L2 - L3) * (L1 * l - 1)
    whole = V_SQUARED * (1 + derived * Y + last * Y**2)
    p.printed(curve_equation("G = V²(1 + α sn² - β sn⁴)", true_g(), whole))
    p.printed(curve_equation("α as printed", (2 * L1 * L3 - (L1 + L3 - L2)) / below, derived))
    p.corrected(
        r"\alpha = \frac{2\Lambda_1\Lambda_3l-(\Lambda_1+\Lambda_3-\Lambda_2)}{(\Lambda_2-\Lambda_3)(\Lambda_1l-1)}",
        curve_equation("α with 2Λ1Λ3 l", (2 * L1 * L3 * l - (L1 + L3 - L2)) / below, derived),
    )
    p.counterexample(curve_point())
    p.control(curve_equation("α with Λ1Λ3 l", (L1 * L3 * l - (L1 + L3 - L2)) / below, derived))


@claim(
    "5.14-beta",
    r"\beta = \frac{\Lambda_1\Lambda_3}{(\Lambda_2-\Lambda_3)^2}\frac{1-\Lambda_3l}{\Lambda_1l-1}",
    uses=["5.14-G"],
)
def beta(p: Proof) -> None:
    """β, for the G that is right."""
    p.reads(
        level_symbols()
        | {r"\beta": (on_curve(-coefficient(true_g(), 2)), "the coefficient of sn⁴ in G/V², less its sign (5.14)")}
    )
    p.assume("G with the correction of (5.14-G)")
    p.assume("0 < k² < 1, Λ1 > Λ2 > Λ3 > 0", *ON_CURVES)
    printed = L1 * L3 / (L2 - L3) ** 2 * (1 - L3 * l) / (L1 * l - 1)
    p.printed(curve_equation("-β is the coefficient of sn⁴ in G/V²", -printed, coefficient(true_g(), 2)))
    p.control(curve_equation("β with the other sign", printed, coefficient(true_g(), 2)))


# The relation for the increment in terms of its parts: 𝒟, G, V, D and, for δu, y = sn², e = cn² dn², w = sn cn dn,
# λ = l - μ sn².  Of the relations between these only w² = y e is needed, besides 5.14-Pi1 and 5.14-Pi2.
SCALE, G, y, e, w, level = sp.symbols("Dscr G y e w lam")
PARTS = Quotient((SCALE, G, V, D, y, e, w, level), [w**2 - y * e])


part = equations(PARTS)


def true_relation(contact: sp.Expr = D, root: sp.Expr = V) -> sp.Expr:
    """T = G𝒟 - 2Vw(𝒟 - Dλ): the relation for the increment is T = 0."""
    return G * SCALE - 2 * root * w * (SCALE - contact * level)


#: 1/σ = 1 - DΠ1 (5.11, h = 1), W = 2𝒟/ϰ = V cn dn/sn (5.13-V) and Π2𝒟² (5.14-Pi2).
INVERSE, W, SECOND = 1 - D * level / SCALE, V * w / y, G * SCALE / y - V**2 * e / y


#: The sign that the printed V² does not determine.
SIGN = "the sign of V is that of -C1 C2 C3 (5.13-V)"


def part_symbols() -> Symbols:
    """The symbols of the parts of the relation."""
    return {
        r"\mathcal D": (SCALE, "1 - k² sn²ū sn²δu (5.13)"),
        "G": (G, "of (5.14-G) as corrected"),
        "V": (V, "of (5.13-V)"),
        "w": (w, "sn cn dn of δu"),
        "D": (D, "mρ²"),
        "d": (D, "D, the only thing that (5.11) can make it"),
    }


def step_point(mean: str = "12/13") -> Point:
    """The curve of `curve_point`, sn δu = 4/5, sn ū, and the D with T = 0: 4.78 at 12/13, for a physical ball."""
    point = {**BALL, **SQUARE, **dict(zip(HALF, ARGUMENT, strict=True)), MEAN.sn: mean}
    point = {symbol: sp.Rational(value) for symbol, value in point.items()}
    values = {
        **{SCALE: elliptic.denominator(), G: true_g(), y: Y, e: (HALF.cn * HALF.dn) ** 2},
        **{w: SMALL_W, level: l - MU * Y, V: sp.Rational(1, 42)},
    }
    exact = {symbol: sp.sympify(value).xreplace(point) for symbol, value in values.items()}
    exact[D] = sp.solve(true_relation().subs(exact), D)[0]
    square = V_SQUARED.xreplace(point)
    hypotheses = [
        part("w² = y e", w**2, y * e),
        part("V² of (5.13-V)", V**2, square),
        part("T = 0", true_relation(), 0 * w),
    ]
    found = rational_point(exact, hypotheses)
    made_of = {"Λ": "(8, 7, 6)", "l": "25/168", "k²": "9/16", "sn δu": "4/5", "sn ū": mean}
    return replace(found, values={**made_of, **found.values})


#: The ring of ϰ = 2σ/(1 + root), root² = 1 - σ²Π2 and 1/σ = 1 - DΠ1 (prop-4), for any Π1 and Π2.
ROOT, FIRST, OTHER = sp.symbols("root P1 P2")
BY_PROP_4 = Quotient((ROOT, SCALE, D, FIRST, OTHER, *HALF), [(ROOT**2 - 1) * (1 - D * FIRST) ** 2 + OTHER])
by_prop_4 = equations(BY_PROP_4)


#: The constant of (5.14) and (5.15), which the paper does not define.
CONSTANT = sp.Symbol("d")


def no_constant(relation: sp.Expr) -> list[Comparison]:
    """The statements that a relation of degree 2 in d has no common root d, or d = cD, at two steps: resultant ≠ 0."""
    renamed = {x: sp.Symbol(f"{x.name}2") for x in PARTS.symbols}
    places = dict(step_point().exact) | {renamed[x]: v for x, v in step_point("3/5").exact.items()}
    steps = [sp.Eq(true_relation().xreplace(names), 0) for names in ({}, renamed)]
    found = []
    for name, unknown in (("d", CONSTANT), ("c with d = cD", CONSTANT * D)):
        whole = sp.expand(relation.subs(CONSTANT, unknown))
        (a, b, c), (a2, b2, c2) = (
            [whole.coeff(CONSTANT, i).xreplace(names) for i in (0, 1, 2)] for names in ({}, renamed)
        )
        resultant = (a * c2 - c * a2) ** 2 - (a * b2 - b * a2) * (b * c2 - c * b2)
        found.append(Comparison(f"no constant {name} serves two steps", [*steps, sp.Ne(resultant, 0)], places))
    return found


@claim(
    "5.14",
    r"(1-\tfrac d2\Pi_1)\sqrt{\mathcal D^2-\Pi_2\mathcal D^2} = V\tfrac{\mathrm{cn}\delta u\,\mathrm{dn}\delta u}"
    r"{\mathrm{sn}\delta u} - \mathcal D(1-\tfrac d2\Pi_1)",
    uses=["5.13-V", "5.14-Pi1", "5.14-Pi2", "prop-4"],
)
def before_squaring(p: Proof) -> None:
    """The relation before squaring: d stands for D (h = 1), its factor ½ must be 1, and σ² is missing under the root."""
    p.infers("The corrected equation, with one of the two signs, is equivalent to T = 0, and by prop-4 to the map.")
    p.slips("serious", "prop-4")
    p.assume("sn δu, 𝒟 and 1 - DΠ1 do not vanish", *(sp.Ne(x, 0) for x in (HALF.sn, SCALE, 1 - D * FIRST)))
    p.assume("h = 1 (5.12-scaling); d is D, the only thing (5.11) can make it")
    p.assume(SIGN)
    p.say("With 1/σ = 1 - DΠ1 (5.11) and 2𝒟/ϰ = V cn dn/sn =: W, prop-4 reads ±√(1 - σ²Π2) = σW/𝒟 - 1. Squared:")
    inverse, half = 1 - D * FIRST, 1 - D / 2 * FIRST
    ratio = SCALE * (1 + ROOT) * inverse
    p.reads(
        {name: part_symbols()[name] for name in (r"\mathcal D", "D", "d")},
        (r"\Pi_1", FIRST, "¼⟨s,Λ⁻¹s⟩, s = γ~ + γ (5.14-Pi1)"),
        (r"\Pi_2", OTHER, "¼⟨s,Λ⁻²s⟩ (5.14-Pi2)"),
        {rf"\mathrm{{{name}}}\delta u": (x, f"{name} δu (5.7)") for name, x in HALF._asdict().items()},
        (
            "V",
            ratio * HALF.sn / (HALF.cn * HALF.dn),
            "W sn/(cn dn) of δu, W = 2𝒟/ϰ (5.13-V), 2/ϰ = (1 + root)/σ (prop-4)",
        ),
    )
    p.printed(
        by_prop_4(
            "(1-(D/2)Π1)²(𝒟² - Π2𝒟²) = (V cn dn/sn δu - 𝒟(1-(D/2)Π1))²",
            half**2 * (SCALE**2 - OTHER * SCALE**2), (ratio - SCALE * half) ** 2,
        )
    )  # fmt: skip
    p.corrected(
        r"\pm\sqrt{(1-D\Pi_1)^2\mathcal D^2-\Pi_2\mathcal D^2} = V\tfrac{\mathrm{cn}\delta u\,\mathrm{dn}\delta u}"
        r"{\mathrm{sn}\delta u} - \mathcal D(1-D\Pi_1)",
        by_prop_4(
            "(1-DΠ1)²𝒟² - Π2𝒟² = (V cn dn/sn δu - 𝒟(1-DΠ1))²",
            inverse**2 * SCALE**2 - OTHER * SCALE**2, (ratio - SCALE * inverse) ** 2,
        ),
    )  # fmt: skip
    squared, half = (W - SCALE * INVERSE) ** 2 - INVERSE**2 * SCALE**2 + SECOND, 1 - D / 2 * level / SCALE
    p.lemma(part("(V cn dn/sn δu - 𝒟(1-DΠ1))² - (1-DΠ1)²𝒟² + Π2𝒟² = T/sn²δu", squared, true_relation() / y))
    p.lemma(by_prop_4("σW/𝒟 - 1 is the root", ratio / (inverse * SCALE) - 1, ROOT))
    p.say("Nor does any other constant in the place of d, at two steps of this curve with different ū and D:")
    other = 1 - CONSTANT / 2 * level / SCALE
    p.lemma(*no_constant(other**2 * (SCALE**2 - SECOND) - (W - SCALE * other) ** 2))
    step = step_point()
    at = {ROOT: W / (INVERSE * SCALE) - 1, FIRST: level / SCALE, OTHER: SECOND / SCALE**2}
    at = {x: sp.cancel(value.subs(step.exact)) for x, value in at.items()} | {x: step.exact[x] for x in (SCALE, D)}
    at |= {x: sp.Rational(value) for x, value in zip(HALF, ARGUMENT, strict=True)}
    p.counterexample(replace(step, exact=at, hypotheses=[by_prop_4("root² = 1 - σ²Π2", BY_PROP_4.relations[0], 0)]))
    p.control(part("the same with D/2", (W - SCALE * half) ** 2 - half**2 * SCALE**2 + SECOND, true_relation() / y))


@claim(
    "5.15",
    r"-\tfrac{d^2}4\tfrac{(l-\mu\,\mathrm{sn}^2)^2}{\mathcal D^2}(G\mathcal D-V^2\mathrm{cn}^2\mathrm{dn}^2)"
    r"+d\tfrac{l-\mu\,\mathrm{sn}^2}{\mathcal D}((G\mathcal D-V^2\mathrm{cn}^2\mathrm{dn}^2)-Vw\mathcal D)"
    r"+\mathcal D(2Vw-G) = 0",
    uses=["5.14"],
)
def relation_for_the_increment(p: Proof) -> None:
    """The relation for the increment is linear in 𝒟, for both signs of the root, with no extraneous solution."""
    p.infers("T = 0 is equivalent to the map, by prop-4 and (5.14), for both signs of the root.")
    p.slips("serious", "5.14")
    p.assume("sn δu, 𝒟 and σ are finite and not 0", *(sp.Ne(x, 0) for x in (y, SCALE, INVERSE)))
    p.assume("h = 1; w = sn cn dn of δu; G as corrected; d is D")
    p.assume(SIGN)
    p.say("From prop-4 as corrected: (2σ/ϰ - 1)² = 1 - σ²Π2, 2σ/ϰ = σW/𝒟. The V² terms cancel, and one factor σ:")
    statement = (W / (INVERSE * SCALE) - 1) ** 2 - 1 + SECOND / (INVERSE * SCALE) ** 2
    factor = 1 / (INVERSE * SCALE) ** 2 / y
    inside = G * SCALE - V**2 * e
    printed = -(CONSTANT**2) / 4 * level**2 / SCALE**2 * inside
    printed += CONSTANT * level / SCALE * (inside - V * w * SCALE) + SCALE * (2 * V * w - G)
    slope = sp.Symbol("mu")
    whole = equations(Quotient((*PARTS.symbols, slope), PARTS.relations))
    p.reads(
        part_symbols(),
        (r"\mu", slope, "(1 - Λ₃l)/(Λ₂ - Λ₃) (5.14-Pi1)"),
        ("l", level + slope * y, "λ + μ sn²δu, λ the l - μ sn²δu of (5.14-Pi1)"),
        (r"\mathrm{sn}^2", y, "sn²δu"),
        (r"\mathrm{sn}^2\delta u", y, "sn²δu"),
        (r"\mathrm{cn}^2\mathrm{dn}^2", e, "cn²δu dn²δu"),
        ("0", statement / factor, "((2σ/ϰ-1)² - (1-σ²Π2))·𝒟² sn²δu/σ², which vanishes (prop-4 as corrected)"),
    )
    p.printed(whole("the printed relation, d = D", printed.subs(CONSTANT, D), 0 * w))
    p.lemma(*no_constant(printed))
    p.corrected(
        r"G\,\mathcal D = 2Vw\,(\mathcal D - D(l-\mu\,\mathrm{sn}^2\delta u)),\ \text{which is linear in }\mathrm{sn}^2\bar u",
        whole(
            "T = ((2σ/ϰ-1)² - (1-σ²Π2))·𝒟² sn²δu/σ², T = G𝒟 - 2Vw(𝒟 - D(l-μ sn²δu))",
            true_relation(),
            statement / factor,
        ),
    )
    p.say("𝒟 is 1 - k² sn²ū sn²δu: so T = 0 says that it is 2VwD(l - μ sn²δu)/(2Vw - G).")
    p.say("So T = 0 is equivalent to the map, for both signs of the root. It is linear in sn²ū: the increment fixes")
    p.say("sn²ū by an explicit formula, and ū ↦ δu is the inverse of that function. It depends on u through D only.")
    p.counterexample(step_point())
    p.control(part("the same with D/2 in T", statement, factor * true_relation(contact=D / 2)))
    p.control(part("the same with -V in T", statement, factor * true_relation(root=-V)))
    p.route(
        "on the sphere, every two points of a curve: sn² of δu, ū and w are rational in γ, γ~ "
        "by the addition theorem for ũ ± u; C1², C2², C3², k², G, μ typed as in the paper, corrected",
        *second_routes.increment(),
    )
    p.route(
        "every step of the map with 𝒦 = γ, from (4.13), solved for the ball (q₀q₁q₂q₃ ≠ 0)",
        *second_routes.increment_of_the_map(),
    )
    p.control(second_routes.mutated("T with 2D", second_routes.relation_for_the_increment(contact=2)))
    p.control(second_routes.mutated("T with -V", second_routes.relation_for_the_increment(sign=-1)))
    wrong = second_routes.increment_of_the_map(part=2)[2]
    p.control(second_routes.mutated("with 2D in σ at every step with 𝒦 = γ", wrong))


@claim("5.15-euler", r"d = 0:\ G = 2Vw,\ \text{so that the increment does not depend on } u", uses=["5.15"])
def euler_increment(p: Proof) -> None:
    """Without rolling the increment is constant."""
    p.infers("𝒟 is not 0, so the increment solves G = 2Vw, in which ū does not occur.")
    p.assume("𝒟 ≠ 0", sp.Ne(SCALE, 0))
    p.assume("(5.15) as corrected")
    p.assume(SIGN)
    factored, without = SCALE * (G - 2 * V * w), true_relation(contact=sp.S.Zero)
    p.reads(part_symbols() | {"d": (sp.S.Zero, "D, in this case"), "0": (without / SCALE, "T/𝒟 for D = 0 (5.15)")})
    p.printed(part("T/𝒟 at D = 0 is G - 2Vw, and ū is in 𝒟 only", without / SCALE, factored / SCALE))
    p.control(part("the same for any D", true_relation(), factored))


@claim(
    "5.16",
    r"\mathcal D = \tfrac1{[1-k^2\mathrm{sn}^2u\,\mathrm{sn}^2\delta u]^2}(k^2\mathrm{sn}^2u\,\mathrm{sn}^2\delta u"
    r"(2-(k^2+1)\mathrm{sn}^2\delta u-k^2\mathrm{sn}^4\delta u)+2k^2\mathrm{sn}^2\delta u\,w(\delta u)W(u)"
    r"+k^2\mathrm{sn}^4\delta u[1-k^2\mathrm{sn}^2u]-1)",
    uses=["5.13"],
)
def denominator_of_u(p: Proof) -> None:
    """𝒟 as a function of u and δu: the sign of the whole and three coefficients are wrong."""
    p.slips("serious")
    p.reads(
        curve_symbols()
        | {r"\mathcal D": (1 - k2 * elliptic.added(U, HALF, 1).sn ** 2 * HALF.sn**2, "1 - k² sn²(u+δu) sn²δu (5.13)")}
    )
    p.assume("0 < k² < 1", *elliptic.MODULUS)
    p.say("sn ū = sn(u + δu) by the addition formula, into 𝒟 = 1 - k² sn²ū sn²δu.")
    ring = elliptic.ring(U, HALF)
    derived = 1 - k2 * elliptic.added(U, HALF, 1).sn ** 2 * HALF.sn**2
    x, y, big = U.sn**2, HALF.sn**2, U.sn * U.cn * U.dn
    below = (1 - k2 * x * y) ** 2
    printed = k2 * x * y * (2 - (k2 + 1) * y - k2 * y**2) + 2 * k2 * y * SMALL_W * big + k2 * y**2 * (1 - k2 * x) - 1
    true = 1 - k2 * x * y * (3 - 2 * (k2 + 1) * y + k2 * y**2) - 2 * k2 * y * SMALL_W * big - k2 * y**2
    p.printed(Equation("𝒟 as printed", printed / below, derived, ring))
    p.corrected(
        r"\mathcal D = \tfrac1{[1-k^2\mathrm{sn}^2u\,\mathrm{sn}^2\delta u]^2}(1-k^2\mathrm{sn}^2u\,\mathrm{sn}^2\delta u"
        r"(3-2(k^2+1)\mathrm{sn}^2\delta u+k^2\mathrm{sn}^4\delta u)-2k^2\mathrm{sn}^2\delta u\,w(\delta u)W(u)"
        r"-k^2\mathrm{sn}^4\delta u)",
        Equation("𝒟 with the corrected bracket", true / below, derived, ring),
    )
    values = {k2: "9/16", U.sn: "4/5", U.cn: "3/5", U.dn: "4/5", HALF.sn: "4/5", HALF.cn: "3/5", HALF.dn: "4/5"}
    relations = Equation("the relations", U.relations() + HALF.relations(), [sp.S.Zero] * 4, ring)
    p.counterexample(rational_point(values, [relations]))
    p.control(Equation("the printed bracket with its sign changed", -printed / below, derived, ring))


P, Q = sp.symbols("p q")
E1, E2, E3 = (2 - k2) / 3, (2 * k2 - 1) / 3, -(1 + k2) / 3
WEIERSTRASS = Quotient((P, Q, k2), [sp.expand(Q**2 - 4 * (P - E1) * (P - E2) * (P - E3))])
equation = equations(WEIERSTRASS)


@claim(
    "5.16-weierstrass-e",
    r"e_1 = \tfrac13(2-k^2),\ e_2 = \tfrac13(2k^2-1),\ e_3 = -\tfrac13(1+k^2),\ "
    r"\mathrm{sn}^2 = \tfrac1{p-e_3},\ \mathrm{cn}^2 = \tfrac{p-e_1}{p-e_3},\ \mathrm{dn}^2 = \tfrac{p-e_2}{p-e_3}",
)
def weierstrass_form(p: Proof) -> None:
    """Jacobi's functions by Weierstrass' ones, with e1 - e3 = 1."""
    square, cosine, delta = 1 / (P - E3), (P - E1) / (P - E3), (P - E2) / (P - E3)
    p.reads(
        ("k^2", k2, "the square of the modulus (5.8)"),
        ("p", P, "Weierstrass' function of δu"),
        {f"e_{i + 1}": (x, "a root of (p-e₁)(p-e₂)(p-e₃); their sum is 0") for i, x in enumerate((E1, E2, E3))},
        (r"\mathrm{sn}^2", square, "1/(p - e₃), which solves (d sn²/du)² = 4 sn² cn² dn²"),
        (r"\mathrm{cn}^2", 1 - square, "1 - sn²"),
        (r"\mathrm{dn}^2", 1 - k2 * square, "1 - k² sn²"),
    )
    p.lemma(equation("e1 + e2 + e3 = 0", E1 + E2 + E3, 0))
    p.printed(equation("cn² = 1 - sn²", cosine, 1 - square), equation("dn² = 1 - k² sn²", delta, 1 - k2 * square))
    p.assume("0 < k² < 1", *elliptic.MODULUS)
    p.say("and d/du sn² = 2 sn cn dn agrees with dp/du = q: (2 sn cn dn)² = (dsn²/dp)² q².")
    rate = sp.diff(square, P)
    p.lemma(equation("4 sn² cn² dn² = (d sn²/dp)² q²", 4 * square * cosine * delta, rate**2 * Q**2))
    p.control(equation("dn² = 1 - sn²", delta, 1 - square))


@claim("5.16-weierstrass-w", r"w(\delta u) = \tfrac12\tfrac q{(p-e_3)^3}", uses=["5.16-weierstrass-e"])
def weierstrass_w(p: Proof) -> None:
    """w = sn cn dn: the power and the sign are wrong."""
    p.slips("typo")
    p.say("w = ½ d(sn²)/du = ½ (d sn²/dp) q, with sn² = 1/(p - e3) and q = dp/du:")
    derived = sp.diff(1 / (P - E3), P) * Q / 2
    p.say("Or, with y = sn²: y(p - e3) = 1, and its derivative y'(p - e3) + yq = 0; then w = y'/2:")
    square, slope = sp.symbols("y y1")
    by_rates = Quotient((square, slope, P, Q, k2), [square * (P - E3) - 1, slope * (P - E3) + square * Q])
    p.reads(
        (r"w(\delta u)", slope / 2, "½ d(sn²)/du, y' being the rate of y = sn²"),
        ("p", P, "Weierstrass' function of δu"),
        ("q", Q, "its derivative"),
        ("e_3", E3, "-(1 + k²)/3"),
    )
    p.printed(Equation("w = ½q/(p-e3)³", Q / (2 * (P - E3) ** 3), slope / 2, by_rates))
    p.corrected(
        r"w(\delta u) = -\tfrac12\tfrac q{(p-e_3)^2}",
        Equation("w = -½q/(p-e3)²", slope / 2, -Q / (2 * (P - E3) ** 2), by_rates),
    )
    p.lemma(equation("w² = sn² cn² dn²", derived**2, (P - E1) * (P - E2) / (P - E3) ** 3))
    p.assume("0 < k² < 1", *elliptic.MODULUS)
    p.say("k² = 9/16, sn = 4/5, cn = 3/5, dn = 4/5: p = e3 + 25/16, q = -2 cn dn/sn³, w = 48/125.")
    values = {k2: "9/16", P: sp.Rational(25, 16) - sp.Rational(25, 48), Q: sp.Rational(-2 * 12 * 125, 25 * 64)}
    values |= {square: "16/25", slope: "96/125"}
    curve = equation("q² = 4(p-e1)(p-e2)(p-e3)", Q**2, 4 * (P - E1) * (P - E2) * (P - E3))
    p.counterexample(rational_point(values, [curve]))
    p.control(equation("w = ½q/(p-e3)²", Q / (2 * (P - E3) ** 2), derived))


@claim(
    "5.16-integral",
    r"\delta u^{(j)} = \int_\infty^{P^{(j)}}\frac{dp}{2\sqrt{(p-e_1)(p-e_2)(p-e_3)}}",
    uses=["5.16-weierstrass-e", "5.15"],
)
def increment_integral(p: Proof) -> None:
    """The increment as an integral on the curve, from p = ∞, where δu = 0; with the positive root it is -δu."""
    p.infers("A function with dp/dδu = q and a pole at 0 is the inverse of the integral from infinity.")
    p.slips("convention")
    p.assume("δu up to periods, as for every integral on the curve")
    p.assume("0 < k² < 1", *elliptic.MODULUS)
    p.say("p = e3 + 1/sn²δu; p' = dp/dδu from sn' = cn dn:")
    value = E3 + 1 / HALF.sn**2
    slope = elliptic.derivative(value, HALF)
    p.show("p'", slope)
    cubic = sp.prod(value - e for e in (E1, E2, E3))
    p.say("The integral is δu when dp/dδu is 2√(...).  The paper does not say which root; the positive one, r > 0:")
    root = sp.Symbol("root")
    p.assume("0 < δu < a quarter of the period: sn, cn and dn of δu are positive", *(x > 0 for x in (root, *HALF)))
    ring = Quotient((root, *HALF, k2), [*HALF.relations(), root**2 * HALF.sn**6 - (HALF.cn * HALF.dn) ** 2])
    p.lemma(Equation("r² = (p-e1)(p-e2)(p-e3)", root**2, cubic, ring))
    p.printed(Equation("dp/dδu = 2r", slope, 2 * root, ring))
    on_curve = -2 * SMALL_W * (value - E3) ** 2
    p.under(
        "2√(…) is q at the point P = (p, q), w(δu) = -½q/(p-e3)² (5.16-weierstrass-w): negative for small δu > 0",
        Equation("q² = 4(p-e1)(p-e2)(p-e3)", on_curve**2, 4 * cubic, ring),
        Equation("dp/dδu = q", slope, on_curve, ring),
    )
    p.lemma(Equation("p → ∞ as δu → 0: 1/(p - e3) = sn²δu", 1 / (value - E3), HALF.sn**2, ring))
    point = {**SQUARE, **dict(zip(HALF, ARGUMENT, strict=True)), root: "15/16"}
    p.counterexample(rational_point(point, [Equation("r² = (p-e1)(p-e2)(p-e3)", root**2, cubic, ring)]))
    p.control(Equation("dp/dδu = -2r, whatever the sign of cn δu", slope, -2 * root, ring))
    p.control(Equation("(dp/dδu)² = (p-e1)(p-e2)(p-e3)", slope**2, cubic, ring))
    other = 4 * sp.prod(value - E3 + E2 - root for root in (E1, E2, E3))
    p.control(Equation("the same with e2 for e3 in p", slope**2, other, ring))


if __name__ == "__main__":
    main(__file__)
