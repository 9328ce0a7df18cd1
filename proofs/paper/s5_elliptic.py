"""Section 5: the invariant curve in Jacobi's functions, and the symmetric form on it (5.7 to 5.13)."""

from itertools import chain

import sympy as sp

from chapsym.derive import elliptic
from chapsym.derive.elliptic import HALF, L1, L2, L3, LAMBDA, MEAN, Jacobi, U, k2, l
from chapsym.derive.quotient import Quotient
from chapsym.proofs.examples import EXAMPLES
from chapsym.proofs.glossary import Symbols
from chapsym.prove import Equation, Proof, claim, equations, main, rational_point

C1, C2, C3, V = sp.symbols("C1 C2 C3 V")
ON_CURVE = elliptic.ring(U)
equation = equations(ON_CURVE)
TWO = elliptic.ring(MEAN, HALF, amplitudes=(C1, C2, C3, V))

#: A curve of a physical ball (J ≥ 0, tr J ≤ D) with rational k, and an argument with rational sn, cn, dn.
BALL = {L1: 8, L2: 7, L3: 6, l: "25/168"}
SQUARE = {k2: "9/16"}
ARGUMENT = ("4/5", "3/5", "4/5")


def functions(values: Jacobi, argument: str) -> Symbols:
    """Jacobi's functions of an argument, and their printed powers."""
    found: Symbols = {}
    for name, value in values._asdict().items():
        for power in (1, 2, 4):
            exponent = "" if power == 1 else f"^{power}"
            found[rf"\mathrm{{{name}}}{exponent}{argument}"] = value**power, f"{name}{exponent} of the argument (5.7)"
    return found


def curve_symbols() -> Symbols:
    """The symbols of the curve (Section 5): Λ, the modulus, and Jacobi's functions of u, ū and δu."""
    return {
        r"\Lambda_1": (L1, "the first entry of Λ (5.2)"),
        r"\Lambda_2": (L2, "the second entry of Λ (5.2)"),
        r"\Lambda_3": (L3, "the third entry of Λ (5.2)"),
        "k^2": (k2, "the square of the modulus (5.8)"),
        **functions(HALF, r"\delta u"),
        **functions(MEAN, r"\bar u"),
        **functions(U, "u"),
        r"w(\delta u)": (HALF.sn * HALF.cn * HALF.dn, "sn cn dn of δu (5.15)"),
        "W(u)": (U.sn * U.cn * U.dn, "sn cn dn of u (5.16)"),
        r"\mathcal D": (elliptic.denominator(), "1 - k² sn²ū sn²δu (5.13)"),
    }


def level_symbols() -> Symbols:
    """The symbols of the curve, with the level l and the squares of C_i in terms of k² and Λ."""
    return curve_symbols() | {
        "l": (elliptic.level(), "the level ⟨γ, Λ⁻¹γ⟩, by k² and Λ (5.8)"),
        **{f"C_{i + 1}^2": (c.subs(elliptic.l, elliptic.level()), f"the square of C_{i + 1} (5.8 as corrected)")
           for i, c in enumerate(elliptic.squared_amplitudes())},
    }  # fmt: skip


def on_ball() -> Equation:
    """The statement that k² is that of the curve (5.8-modulus)."""
    return equation("k² of (5.8-modulus)", k2, elliptic.squared_modulus())


def printed_squares(sign: int = 1) -> list[sp.Expr]:
    """C1², C2², C3² of (5.8) as printed; the sign is that of C3²."""
    return [L1 * (1 - L3 * l) / (L1 - L3), L2 * (1 - L3 * l) / (L2 - L3), sign * L3 * (1 - L1 * l) / (L1 - L3)]


#: Letters for a curve with rational amplitudes, with an example of their own.
ROOTED = dict(zip((L1, L2, L3, l, k2, C1, C2, C3), sp.symbols("l1:4 lv kk size1:4"), strict=True)) | dict(
    zip((*HALF, *MEAN), sp.symbols("sn1 cn1 dn1 sn2 cn2 dn2"), strict=True)
)
#: Relations of the amplitudes of γ = (C1 cn, C2 sn, C3 dn): |γ|² = 1 and ⟨γ,Λ⁻¹γ⟩ = l at sn = 0; the second relation
#: at sn² = 1, where C3² dn² = 1 - C2² by the first; and k² from the first.
AMPLITUDES = [
    C1**2 + C3**2 - 1,
    L3 * C1**2 + L1 * C3**2 - l * L1 * L3,
    L3 * C2**2 + L2 * (1 - C2**2) - l * L2 * L3,
    C2**2 - C1**2 - k2 * C3**2,
]
#: The assumptions of the paper.
POSITIVE = [relation.xreplace(ROOTED) for relation in (*elliptic.ORDER, C1 > 0, C2 > 0, C3 > 0)]


def rooted(text: str, left: list[sp.Expr], right: list[sp.Expr], last: int = 3, *arguments: Jacobi) -> Equation:
    """An equation in the letters `ROOTED`, modulo the first `last` relations of the amplitudes."""
    relations = [*AMPLITUDES[:last], *chain(*(x.relations() for x in arguments))]

    def letters(of: list[sp.Expr]) -> list[sp.Expr]:
        return [sp.sympify(x, strict=True).xreplace(ROOTED) for x in of]

    return Equation(text, letters(left), letters(right), Quotient(tuple(ROOTED.values()), letters(relations)))


def amplitude_symbols() -> Symbols:
    """The symbols Λ, the level, and the positive amplitudes."""
    return {
        **{rf"\Lambda_{i + 1}": (ROOTED[x], "an entry of Λ (5.2)") for i, x in enumerate(LAMBDA)},
        "l": (ROOTED[l], "the level ⟨γ, Λ⁻¹γ⟩ (5.5)"),
        **{
            f"C_{i + 1}": (ROOTED[c], f"the amplitude of γ_{i + 1} (5.7), positive") for i, c in enumerate((C1, C2, C3))
        },
    }


@claim(
    "5.8",
    r"C_1 = \sqrt{\tfrac{\Lambda_1(1-\Lambda_3l)}{\Lambda_1-\Lambda_3}},\ "
    r"C_2 = \sqrt{\tfrac{\Lambda_2(1-\Lambda_3l)}{\Lambda_2-\Lambda_3}},\ "
    r"C_3 = \sqrt{\tfrac{\Lambda_3(1-\Lambda_1l)}{\Lambda_1-\Lambda_3}}",
    uses=["prop-3"],
)
def amplitudes(p: Proof) -> None:
    """The amplitudes: the sign under the root of C3 is misprinted."""
    p.infers("Both equations for every u are linear in C₁², C₂², C₃² and fix them.")
    p.slips("typo")
    p.assume("1/Λ1 < 1/Λ2 < l < 1/Λ3, so that Λ1 l > 1 and the printed C3 is imaginary; C1, C2, C3 > 0", *POSITIVE)
    p.say(
        "|γ|² = 1 and ⟨γ,Λ⁻¹γ⟩ = l for γ = (C1 cn, C2 sn, C3 dn) and every u determine the squares.  sn = 0 gives two",
        "equations for C1² and C3²; sn² = 1, where C3² dn² = 1 - C2² by the first, gives one for C2²:",
    )
    for name, square in zip(("C1²", "C2²", "C3²"), elliptic.squared_amplitudes(), strict=True):
        p.show(name, square)
    p.reads(amplitude_symbols())
    for i, (c, square) in enumerate(zip((C1, C2, C3), printed_squares(), strict=True)):
        p.printed(rooted(f"C{i + 1}² as printed", [c**2], [square]))
    p.corrected(
        r"C_3 = \sqrt{\tfrac{\Lambda_3(\Lambda_1l-1)}{\Lambda_1-\Lambda_3}}",
        rooted("C3² with Λ1 l - 1", [C3**2], printed_squares(-1)[2:]),
    )
    p.lemma(equation("the squares are those that solve for them", printed_squares(-1), elliptic.squared_amplitudes()))
    curve = rooted("they are on the curve", AMPLITUDES, [sp.S.Zero] * 4)
    p.counterexample(rational_point({x: EXAMPLES.numbers[x] for x in ROOTED.values()}, [curve]))
    p.control(rooted("the squares with C1, C2 exchanged", [C2**2, C1**2], printed_squares()[:2]))


@claim(
    "5.8-modulus",
    r"k^2 = \frac{(\Lambda_1-\Lambda_2)(1-\Lambda_3l)}{(\Lambda_2-\Lambda_3)(\Lambda_1l-1)}",
    uses=["5.8"],
)
def modulus(p: Proof) -> None:
    """The modulus."""
    first, second, third = printed_squares(-1)
    made = (second - first) / third
    p.reads(
        curve_symbols(),
        ("l", l, "the level ⟨γ, Λ⁻¹γ⟩ (5.5)"),
        ("k^2", made, "the square of the modulus: (C2² - C1²)/C3², so that |γ|² = 1 for every u (5.7, 5.8)"),
    )
    printed = (L1 - L2) * (1 - L3 * l) / ((L2 - L3) * (L1 * l - 1))
    p.say("The coefficient of sn² in |γ|² is C2² - C1² - k²C3²; it is 0.")
    p.printed(equation("k² as printed", printed, made))
    p.assume("1/Λ1 < 1/Λ2 < l < 1/Λ3", *elliptic.ORDER)
    p.say("0 < k² < 1 where the paper works: 1 - k² has the sign of Λ2 l - 1.")
    complement = (L1 - L3) * (L2 * l - 1) / ((L2 - L3) * (L1 * l - 1))
    p.lemma(equation("1 - k² = (Λ1-Λ3)(Λ2 l-1)/((Λ2-Λ3)(Λ1 l-1))", 1 - printed, complement))
    p.control(equation("1/k² in its place", 1 / printed, made))


@claim(
    "5.7",
    r"\gamma_1 = C_1\,\mathrm{cn}(u|k),\ \gamma_2 = C_2\,\mathrm{sn}(u|k),\ \gamma_3 = C_3\,\mathrm{dn}(u|k):\ "
    r"\gamma_1^2+\gamma_2^2+\gamma_3^2 = 1,\ "
    r"\Lambda_1^{-1}\gamma_1^2+\Lambda_2^{-1}\gamma_2^2+\Lambda_3^{-1}\gamma_3^2 = l",
    uses=["5.8", "5.8-modulus"],
)
def parameterisation(p: Proof) -> None:
    """The Jacobi parameterisation runs on the invariant curve."""
    p.infers(
        "Both equations hold for every u, so the printed γ is on the curve; that it goes through a whole component is not decided."
    )
    p.assume("C3 with the correction of (5.8)")
    p.assume("1/Λ1 < 1/Λ2 < l < 1/Λ3; C1, C2, C3 > 0", *POSITIVE)
    vector = [C1 * HALF.cn, C2 * HALF.sn, C3 * HALF.dn]
    p.reads(
        amplitude_symbols()
        | {rf"\gamma_{i + 1}": (x.xreplace(ROOTED), "as it is printed (5.7)") for i, x in enumerate(vector)}
        | {rf"\mathrm{{{name}}}(u|k)": (ROOTED[x], f"{name} u") for name, x in HALF._asdict().items()}
    )
    squares, inverse = [x**2 for x in vector], [x**2 / lam for x, lam in zip(vector, LAMBDA, strict=True)]

    def on_curve(text: str, left: list[sp.Expr], to: sp.Expr) -> Equation:
        return rooted(text, [sum(left)], [to], 4, HALF)

    p.printed(on_curve("|γ|² = 1", squares, sp.S.One), on_curve("⟨γ,Λ⁻¹γ⟩ = l", inverse, l))
    p.control(on_curve("|γ|² = 1 with the printed C3", [squares[0], squares[1], -squares[2]], sp.S.One))


def pair() -> tuple[list[sp.Expr], list[sp.Expr]]:
    """γ = γ(ū - δu) and γ~ = γ(ū + δu)."""
    before, after = (elliptic.added(MEAN, HALF, sign) for sign in (-1, 1))
    return [C1 * before.cn, C2 * before.sn, C3 * before.dn], [C1 * after.cn, C2 * after.sn, C3 * after.dn]


@claim(
    "5.13",
    r"\tilde\gamma_1-\gamma_1 = \tfrac{2C_1}{\mathcal D}\mathrm{sn}\bar u\,\mathrm{dn}\bar u\,\mathrm{sn}\delta u\,"
    r"\mathrm{dn}\delta u,\ \tilde\gamma_1+\gamma_1 = \tfrac{2C_1}{\mathcal D}\mathrm{cn}\bar u\,\mathrm{cn}\delta u",
    uses=["5.7"],
)
def sums_and_differences(p: Proof) -> None:
    """Sums and differences by the addition formulas: the sign of the first difference is misprinted."""
    p.slips("typo")
    p.reads(
        curve_symbols(),
        ("C_1", C1, "the first amplitude (5.8)"),
        (r"\gamma_1", pair()[0][0], "C1 cn(ū - δu) (5.7)"),
        (r"\tilde\gamma_1", pair()[1][0], "C1 cn(ū + δu) (5.7)"),
    )
    p.assume("0 < k² < 1", *elliptic.MODULUS)
    p.assume("1/Λ1 < 1/Λ2 < l < 1/Λ3", *elliptic.ORDER)
    _addition(p)
    now, after = pair()
    product = MEAN.sn * MEAN.dn * HALF.sn * HALF.dn
    size = 2 * C1 / elliptic.denominator()
    p.printed(Equation("γ~1 + γ1 = (2C1/𝒟) cn ū cn δu", after[0] + now[0], size * MEAN.cn * HALF.cn, TWO))
    p.say("The similar expressions for the other components, which the paper does not print:")
    for i, name, sum_of, difference_of in (
        (1, "2", MEAN.sn * HALF.cn * HALF.dn, MEAN.cn * MEAN.dn * HALF.sn),
        (2, "3", MEAN.dn * HALF.dn, -k2 * MEAN.sn * MEAN.cn * HALF.sn * HALF.cn),
    ):
        whole = 2 * (C1, C2, C3)[i] / elliptic.denominator()
        p.lemma(
            Equation(f"γ~{name} + γ{name} = (2C{name}/𝒟)({sum_of})", after[i] + now[i], whole * sum_of, TWO),
            Equation(
                f"γ~{name} - γ{name} = (2C{name}/𝒟)({difference_of})", after[i] - now[i], whole * difference_of, TWO
            ),
        )

    def difference(text: str, sign: int) -> Equation:
        return Equation(text, after[0] - now[0], sign * size * product, TWO)

    p.printed(difference("γ~1 - γ1 = (2C1/𝒟) sn ū dn ū sn δu dn δu", 1))
    p.corrected(
        r"\tilde\gamma_1-\gamma_1 = -\tfrac{2C_1}{\mathcal D}\mathrm{sn}\bar u\,\mathrm{dn}\bar u\,\mathrm{sn}\delta u\,"
        r"\mathrm{dn}\delta u",
        difference("γ~1 - γ1 = -(2C1/𝒟) sn ū dn ū sn δu dn δu", -1),
    )
    relations = [Equation("the relations of sn, cn, dn", MEAN.relations() + HALF.relations(), [sp.S.Zero] * 4, TWO)]
    p.say("C1 is a factor of both sides; at the point 1 stands for it.")
    values = {**BALL, **SQUARE, **dict(zip((*MEAN, *HALF), ARGUMENT * 2, strict=True))}
    p.counterexample(rational_point({**values, C1: 1}, [*relations, on_ball()]))
    p.control(difference("γ~1 - γ1 = -(4C1/𝒟) sn ū dn ū sn δu dn δu", -2))
    wrong = elliptic.added(MEAN, HALF, 1).sn * elliptic.denominator()
    by_x, by_y = elliptic.derivative(wrong, MEAN), elliptic.derivative(wrong, HALF)
    p.control(Equation("sn(x + y) without 𝒟", by_x, by_y, TWO))


def _addition(p: Proof) -> None:
    """The proof of the addition formulas, from the derivatives of sn, cn, dn and their values at 0."""
    p.say("The addition formulas, for x = ū and y = δu: their right sides have equal derivatives by x and by y,")
    for name, whole, own in zip(Jacobi._fields, elliptic.added(MEAN, HALF, 1), MEAN, strict=True):
        by_x, by_y = (elliptic.derivative(whole, argument) for argument in (MEAN, HALF))
        p.lemma(Equation(f"that of {name}(x + y)", by_x, by_y, TWO))
        at_zero = whole.subs(dict(zip(HALF, (0, 1, 1), strict=True)))
        if at_zero != own:
            raise ArithmeticError(f"the right side for {name}(x + y) is not {name}(x) at y = 0")
    p.say("and at y = 0, where sn = 0 and cn = dn = 1, they are sn x, cn x and dn x.")
    p.infers(
        "A function of x and y with equal derivatives by both is one of x + y, which y = 0 gives: the addition formulas."
    )


@claim(
    "5.13-V",
    r"\frac{2\mathcal D}\varkappa = V\frac{\mathrm{cn}\delta u\,\mathrm{dn}\delta u}{\mathrm{sn}\delta u},\ "
    r"V^2 = \frac{(\Lambda_2-\Lambda_3)(\Lambda_1l-1)}{\Lambda_1\Lambda_2\Lambda_3}",
    uses=["5.13", "5.8", "prop-4"],
)
def increment_and_kappa(p: Proof) -> None:
    """What (5.10) says of the increment, in each of its three components."""
    p.assume("sn δu, cn δu and dn δu are not 0", *(sp.Ne(ROOTED[x], 0) for x in HALF))
    p.assume("1/Λ1 < 1/Λ2 < l < 1/Λ3; C1, C2, C3 > 0", *POSITIVE)
    p.assume("the sign of V is that of -C1 C2 C3, which the printed V² leaves open")
    now, after = pair()
    total = [a + b for a, b in zip(now, after, strict=True)]
    scaled = [t / lam for t, lam in zip(total, LAMBDA, strict=True)]
    product = sp.Matrix(total).cross(sp.Matrix(scaled))
    ratio, printed = HALF.cn * HALF.dn / HALF.sn, (L2 - L3) * (L1 * l - 1) / (L1 * L2 * L3)
    factors = [
        -C2 * C3 / C1 * (L2 - L3) / (L2 * L3),
        -C1 * C3 / C2 * (L1 - L3) / (L1 * L3),
        -C1 * C2 / (C3 * k2) * (L1 - L2) / (L1 * L2),
    ]
    kappas = [4 * (after[i] - now[i]) / product[i] for i in range(3)]

    def said(i: int, factor: sp.Expr) -> Equation:
        text = f"2𝒟/ϰ = V cn δu dn δu/sn δu for the ϰ of component {i + 1} of γ~ - γ = (ϰ/4)s×Λ⁻¹s, and its V"
        return rooted(text, [2 * elliptic.denominator() / kappas[i]], [factor * ratio], 0, MEAN, HALF)

    p.say("Each component of (5.10) gives ϰ by itself; V is for them", *(f"    {factor}" for factor in factors))
    p.reads(
        amplitude_symbols(),
        {name: (value.xreplace(ROOTED), meaning) for name, (value, meaning) in functions(HALF, r"\delta u").items()},
        (r"\mathcal D", elliptic.denominator().xreplace(ROOTED), "1 - k² sn²ū sn²δu (5.13)"),
        (r"\varkappa", kappas[0].xreplace(ROOTED), "that of the first component of (5.10), by (5.13 as corrected)"),
        ("V", factors[0].xreplace(ROOTED), "-(C₂C₃/C₁)(1/Λ₃ - 1/Λ₂)"),
    )
    first, *others = (said(i, factor) for i, factor in enumerate(factors))
    p.printed(first, rooted("V² as printed", [factors[0] ** 2], [printed]))
    p.lemma(*others)
    p.lemma(
        *(rooted(f"the V of component {i} is that of component 1", [factors[i - 1]], [factors[0]], 4) for i in (2, 3))
    )
    p.control(said(0, -factors[0]))
    p.control(rooted("V² with Λ1 - Λ3", [factors[0] ** 2], [printed * (L1 - L3) / (L2 - L3)]))


if __name__ == "__main__":
    main(__file__)
