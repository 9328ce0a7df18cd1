"""The rounding error of straight-line code in float64: the lemma by which the roundings of a kernel are counted."""

import sympy as sp

from chapsym.codegen.rounding import DEEPEST, DIVISOR, MOST, UNIT
from chapsym.derive.quotient import Quotient
from chapsym.prove import Comparison, Equation, Proof, Theorem, claim, main

#: Exact numbers, the errors of the computed numbers, and the rounding error of the operation.
a, b, e, f, delta = NUMBERS = sp.symbols("a b e f delta")
FREE = Quotient(NUMBERS, [])
#: A bound for an error relative to its terms, and bounds for the terms of higher order of one operation, 16 and all.
m, one, sixteen, whole = sp.symbols("m one sixteen all")
AT = {one: sp.Rational(1, 2**19), sixteen: 1 + sp.Rational(2**10 + 1, 2**25), whole: MOST - 1, m: DEEPEST * UNIT * MOST}
ROUNDED = "each operation gives its exact result times 1 + δ, |δ| ≤ 2⁻⁵³: nothing over- or underflows"
WIDE = "no divisor is below 2⁻²⁵ of its terms, and n ≤ 256"
BOUND = "a number with n roundings is off by at most n 2⁻⁵³(1 + 2⁻¹⁰) of its terms"


@claim("rounding", r"\frac{a + e}{b + f}(1 + \delta) - \frac ab = \frac{eb - af + \delta b(a + e)}{b(b + f)}")
def rounding(p: Proof) -> None:
    """By induction along the text: n is 0 of an argument, max(α, β) + 1 of a sum, α + β + 1 of a product or quotient."""
    p.assume(ROUNDED)
    p.assume(WIDE)
    p.state(Theorem((), (ROUNDED, WIDE), (BOUND,)))
    p.say("The terms of a number x are |x| of an argument, terms(a) + terms(b) of a ± b, terms(a) terms(b) of ab, and")
    p.say("terms(a) terms(b)/b² of a/b: at least |x|.  With |e| ≤ α 2⁻⁵³M terms(a), |f| ≤ β 2⁻⁵³M terms(b):")
    x, y = a + e, b + f
    p.lemma(
        Equation("of a sum", [(x + y) * (1 + delta) - (a + b)], [e + f + delta * (a + b + e + f)], FREE),
        Equation("of a product", [x * y * (1 + delta) - a * b], [e * b + a * f + e * f + delta * x * y], FREE),
    )
    quotient = x * (1 + delta) / y - a / b
    p.printed(Equation("of a quotient", [quotient], [(e * b - a * f + delta * b * x) / (b * y)], FREE))
    p.say(
        "By the triangle inequality each is at most n 2⁻⁵³M(1 + 2⁻¹⁹) of the terms: what is beyond the first order has"
    )
    p.say("α 2⁻⁵³M ≤ 2⁻⁴⁵(1 + 2⁻¹⁰), and of a divisor |f|/|b| ≤ 2⁻⁴⁵(1 + 2⁻¹⁰)·2²⁵:")
    p.lemma(
        Comparison("m = 256·2⁻⁵³(1 + 2⁻¹⁰)", [sp.Eq(m, 256 * sp.Rational(1, 2**53) * (1 + whole))], AT),
        Comparison("1/(1 - 2²⁵m) + 3m ≤ 1 + 2⁻¹⁹", [1 / (1 - m / DIVISOR) + 3 * m <= 1 + one], AT),
        Comparison("(1 + 2⁻¹⁹)²⁵⁶ ≤ 1 + 2⁻¹⁰", [(1 + one) ** 16 <= sixteen, sixteen**16 <= 1 + whole], AT),
    )
    p.step(BOUND, ROUNDED, WIDE)
    p.control(Equation("of a product without af", [x * y * (1 + delta) - a * b], [e * b + e * f + delta * x * y], FREE))
    p.control(Equation("of a quotient with + af", [quotient], [(e * b + a * f + delta * b * x) / (b * y)], FREE))


if __name__ == "__main__":
    main(__file__)
