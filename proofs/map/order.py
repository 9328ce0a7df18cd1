"""The order of the compositions of the map: 4, 6 and 8, from the order conditions in a free algebra."""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import sympy as sp
from flint import arb, arb_mat, arb_series, ctx, fmpq, fmpq_mat

from chapsym.derive import composition
from chapsym.derive.composition import Word, defects
from chapsym.derive.quotient import Quotient
from chapsym.dynamics.coefficients import COMPOSITIONS
from chapsym.prove import Comparison, Equation, Fact, Proof, Zero, claim, in_field, main

#: t = ∛4 and Suzuki's c = 1/(4 - t), as (4 - t)(16 + 4t + t²) = 64 - t³ = 60.
t = sp.Symbol("t")
CUBE = t**3 - 4
SUZUKI = (16 + 4 * t + t**2) / 60
#: The permitted distance of the decimals from the solution: they have 40 digits.
OFF = Fraction(1, 10**40)
BITS = 400
METHOD = "Arb balls, interval Newton"


def palindrome(half: Sequence[Any]) -> list[Any]:
    """The palindrome c₁, ..., cₛ with this first half, up to the middle coefficient."""
    return [*half, *half[-2::-1]]


def ball(x: Fraction) -> arb:
    """A rational number as an Arb ball."""
    return arb(fmpq(x.numerator, x.denominator))


def isolated(half: Sequence[Fraction], order: int) -> list[arb] | None:
    """The unique palindrome of this order with the c₁ of `half` and other coefficients within `OFF` of those of `half`.

    By the interval Newton operator; None if this does not prove existence and uniqueness.
    """
    first, rest = ball(half[0]), [ball(x) for x in half[1:]]
    conditions = composition.lyndon(order)

    def missed(free: Sequence[Any]) -> list[Any]:
        found = defects(palindrome([first, *free]), order - 1)
        return [found[word] for word in conditions]

    box = [x + arb(0, 1) * ball(OFF) for x in rest]
    moved = ([arb_series([x, int(i == j)], 2) for i, x in enumerate(box)] for j in range(len(box)))
    columns = [[x[1] for x in missed(one)] for one in moved]
    try:
        change = arb_mat(columns).transpose().solve(arb_mat([[x] for x in missed(rest)]))
    except ZeroDivisionError:
        return None
    found = [x - change[i, 0] for i, x in enumerate(rest)]
    return [first, *found] if all(b.contains_interior(x) for b, x in zip(box, found, strict=True)) else None


def told_by(words: Sequence[Word], weight: int) -> Equation:
    """The statement that the coefficients at some words determine a Lie element of a weight: it is 0 if they are."""
    brackets, every = composition.brackets(weight), list(composition.words(weight))
    known, whole = (fmpq_mat([[x.get(word, 0) for word in of] for x in brackets]) for of in (words, every))
    combinations = (known.transpose() * known).solve(known.transpose() * whole).transpose().tolist()
    factors = sp.Matrix(sp.symbols(f"b1:{len(brackets) + 1}"))
    element = {word: factors.dot([x.get(word, 0) for x in brackets]) for word in every}
    told = [_combination(row, [element[word] for word in words]) for row in combinations]
    text = f"the Lyndon words {list(words)} tell the Lie elements of the weight {weight}"
    return Equation(text, element.values(), told, Quotient(factors))


def _combination(row: Sequence[fmpq], of: Sequence[sp.Expr]) -> sp.Expr:
    """A linear combination, unevaluated."""
    terms = [sp.Mul(sp.Rational(str(c)), x, evaluate=False) for c, x in zip(row, of, strict=True) if c != 0]
    return sp.Add(*terms, evaluate=False)


@claim(
    "composition-order",
    r"\Phi_{c_s\varepsilon}\circ\dots\circ\Phi_{c_1\varepsilon} \text{ has the order } 4, 6, 8"
    r"\text{, and no more for every self-adjoint } \Phi",
    uses=["self-adjoint", "small-branch"],
)
def order(p: Proof) -> None:
    """The compositions have the orders that they are used for: Suzuki's exactly, Kahan and Li's with one solution near."""
    p.say("Φ_ε is analytic in ε (small-branch) and 1 at ε = 0, so its series is that of exp(εX₁ + ε²X₂ + ...), and")
    p.say("Φ_{-ε}Φ_ε = 1 (self-adjoint) leaves X₁, X₃, X₅, ...; the flow is exp(εX₁). Where composition and flow agree")
    p.say("through the weight p in free letters X₁, X₃, ..., each weighing its index, the order is p for every such Φ;")
    p.say("where they differ in the next, there is a Φ with no more. That the ball is one is measured, not proved.")
    p.say("The logarithm of the composition is a Lie element (Baker, Campbell, Hausdorff); for a palindrome it is odd")
    p.say("in ε, as each factor with -ε is the inverse of the one with ε:")
    first, third = sp.Matrix([[0, 1], [0, 0]]), sp.Matrix([[0, 0], [1, 0]])
    letters = {"X1": str(first.tolist()), "X3": str(third.tolist())}
    p.witness("a self-adjoint Φ", letters, Fact("X₁X₃ ≠ X₃X₁ for these matrices", first * third != third * first))
    c, minus = sp.symbols("c d")
    through = max(COMPOSITIONS)
    there, back = (composition.step_series(x, through) for x in (c, minus))
    product = composition.product(there, back)
    unit = [sp.Integer(not word) for word in product]
    p.lemma(
        Equation(
            "Φ_{dε}Φ_{cε} = 1 through the weight 8 for d = -c",
            product.values(),
            unit,
            Quotient((c, minus), [c + minus]),
        )
    )
    p.say(
        "A Lie element of odd weight is 0 when its coefficients at Lyndon's words are, those that are smaller than all"
    )
    p.say("their proper ends: so the first defect is at one of them, and they are the conditions.")
    for weight in range(1, through, 2):
        words = [word for word in composition.lyndon(through) if sum(word) == weight]
        p.lemma(told_by(words, weight))
    p.control(told_by(words[:-1], 7))
    p.say("Order 4: c = 1/(4 - t) twice, 1 - 4c, c twice, with t = ∛4 (Suzuki), where the multiples of t³ - 4 vanish:")
    suzuki = palindrome([SUZUKI, SUZUKI, 1 - 4 * SUZUKI])
    p.lemma(in_field("c(4 - t) = 1", [SUZUKI * (4 - t)], [1], CUBE))
    exact = defects(suzuki, 4)
    p.printed(in_field("order 4: every word through the weight 4 vanishes", [*exact.values()], [0] * len(exact), CUBE))
    fifth = defects(suzuki, 5)[(5,)]
    inverse = sp.invert(sp.rem(sp.expand(fifth), CUBE, t), CUBE, t)
    p.printed(in_field("not 5: Σc⁵ has an inverse in the field Q(∛4)", [fifth * inverse], [1], CUBE))
    p.control(in_field("order 5: Σc⁵ = 0", [fifth], [0], CUBE))
    decimals = COMPOSITIONS[4].exact
    first, second, middle, off = sp.symbols("c1:4 o")
    at = {
        x: sp.Rational(v.numerator, v.denominator)
        for x, v in zip((first, second, middle, off), (*decimals[:3], OFF), strict=True)
    }
    changes = [(4 - 1 / (first - off)) ** 3 < 4, (4 - 1 / (first + off)) ** 3 > 4]
    p.lemma(Comparison("the decimals of c are off by less than 10⁻⁴⁰: t³ - 4 changes its sign", changes, at))
    near = [sp.Eq(first, second), middle - (1 - 4 * first) < 4 * off, middle - (1 - 4 * first) > -4 * off]
    p.lemma(Comparison("and the middle one is 1 - 4c of them, off by less than 4·10⁻⁴⁰", near, at))
    with ctx.workprec(BITS):
        for wanted in (6, 8):
            kahan_and_li(p, wanted)


def kahan_and_li(p: Proof, order: int) -> None:
    """The proof of one solution near the decimals, of no higher order."""
    half = COMPOSITIONS[order].exact[: len(COMPOSITIONS[order].half)]
    p.say(f"Order {order}: c₁ = {float(half[0])!r}..., one equation for each other coefficient (Kahan and Li):")
    text = f"order {order}, not {order + 1}: one solution with this c₁ within 10⁻⁴⁰ of the decimals, and there Σc^{order + 1} ≠ 0"
    p.printed(near(text, half, order))
    changed = [*half[:-1], half[-1] + Fraction(1, 10**38)]
    p.control(near(f"{text}, the 38th of the middle one changed", changed, order))


def near(text: str, half: Sequence[Fraction], order: int) -> Zero:
    """The statement that there is one solution near some decimals, of no higher order: as data, decided in balls."""
    found = isolated(half, order)
    names = sp.symbols(f"c1:{len(half) + 1}")
    definitions, equations = conditions(palindrome(names), order)
    point = {x: sp.Rational(v.numerator, v.denominator) for x, v in zip(names, half, strict=True)}
    missed = sum(c ** (order + 1) for c in palindrome(names))
    truth = found is not None and not sum(c ** (order + 1) for c in palindrome(found)).contains(0)
    off = sp.Rational(OFF.numerator, OFF.denominator)
    return Zero(text, names[1:], definitions, equations, [missed], point, off, truth, METHOD)


def conditions(coefficients: Sequence[sp.Symbol], order: int) -> tuple[list[tuple[sp.Symbol, sp.Expr]], list[sp.Expr]]:
    """The order conditions of a composition, and definitions of names for the coefficients of its partial products.

    The coefficient of a word in a product is the sum over all splittings of the word (composition.product).
    """
    wanted = composition.lyndon(order)
    prefixes = sorted({word[:i] for word in wanted for i in range(1, len(word) + 1)})
    known: dict[Word, sp.Expr] = {(): sp.S.One}
    definitions = []
    for k, c in enumerate(coefficients, 1):
        after: dict[Word, sp.Expr] = {(): sp.S.One}
        for word in prefixes:
            parted = ((known.get(word[:i], sp.S.Zero), word[i:]) for i in range(len(word) + 1))
            value = sum(left * c ** sum(right) / sp.factorial(len(right)) for left, right in parted)
            after[word] = sp.Symbol(f"s{k}_{''.join(map(str, word))}")
            definitions.append((after[word], value))
        known = after
    return definitions, [known[word] - int(word == (1,)) for word in wanted]


if __name__ == "__main__":
    main(__file__)
