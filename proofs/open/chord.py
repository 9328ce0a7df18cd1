"""The relation for the increment as one between the ends of a chord, in Jacobi's zeta function: to first order, a rotation."""

import sympy as sp

from chapsym.derive import elliptic
from chapsym.derive.elliptic import HALF, MEAN, U, k2
from chapsym.derive.quotient import Quotient
from chapsym.proofs.paper.s5_increment import RATIO, SCALE, SMALL_W, TWO, D, G, V, Y, level, part, true_relation, w, y
from chapsym.prove import Equation, Proof, Theorem, claim, main

PAIR = elliptic.ring(U, HALF)
#: z = Z(u~) - Z(u), and the values P₀, P₁, A₁, A₂ of Ψ, Ψ', A', A'' at D = 0; all to second order in D.
z, P0, P1, A1, A2 = sp.symbols("z P0 P1 A1 A2")
SECOND_ORDER = Quotient((D, z, P0, P1, A1, A2), [D**3])


def addition(sign: int = 1) -> Equation:
    """Z(u + v) = Z(u) + Z(v) - k² sn u sn v sn(u + v), differentiated in u; v is the argument of HALF."""
    whole = elliptic.added(U, HALF, 1)
    right = elliptic.derivative(-sign * k2 * U.sn * HALF.sn * whole.sn, U)
    mark = "-" if sign > 0 else "+"
    return Equation(f"dn²(u+v) - dn²u = d/du ({mark}k² sn u sn v sn(u+v))", whole.dn**2 - U.dn**2, right, PAIR)


def chord_of_zeta() -> sp.Expr:
    """Z(ū + a) - Z(ū - a) - 2Z(a), from the addition theorem twice."""
    return -k2 * MEAN.sn * HALF.sn * sum(elliptic.added(MEAN, HALF, sign).sn for sign in (1, -1))


def half_increment(second: sp.Expr = A2 / 2) -> sp.Expr:
    """a - a₀ to second order in D; the argument mutates the coefficient from A''."""
    first = A1 * (P0 - z)
    return D * first + D**2 * (A1 * P1 * first + second * (P0 - z) ** 2)


def coordinate(a: sp.Expr) -> sp.Expr:
    """m = D(Ψ(a) - z) with Ψ = P₀ + P₁(a - a₀)."""
    return D * (P0 + P1 * a - z)


CURVE = "0 < k < 1, h > 0, λ, V, w, 𝒟 are not 0"
BRANCH = "M(a₀) = 0, M'(a₀) ≠ 0, and a = δu is the root near a₀"
RELATION = "the map on its curve is M(δu) = D(Ψ(δu) - Z(u~) + Z(u))"
EXPANSION = "u~ - u = 2a₀ + D(c₁ - 2A'z) + D²(c₂ + c₃z + A''z²) + O(D³), z = Z(u~) - Z(u), uniformly in z"
SHAPE = "Ψ(a) - Z(u~) + Z(u) = 2w/(y𝒟)"


@claim(
    "chord",
    r"M(\delta u) = D\,(\Psi(\delta u) - Z(u_{k+1}) + Z(u_k)),\ "
    r"M = \tfrac{2w - hG/V}{\mathrm{sn}^2\,(l - \mu\,\mathrm{sn}^2)},\ \Psi = 2Z + \tfrac{2w}{\mathrm{sn}^2}",
    uses=["5.15", "5.12-scaling", "5.13"],
)
def chord(p: Proof) -> None:
    """The map on its curve is a relation between Z(u~) - Z(u) and u~ - u; to first order in D it is a rotation."""
    p.assume("0 < k < 1, h > 0; (5.15) as corrected; a = δu, y = sn²a, w = sn cn dn a; λ = l - μy, V, w, 𝒟 are not 0")
    p.assume(
        "to first order: M(a₀) = 0, M'(a₀) ≠ 0, and a is the root near a₀, as on the small branch whose root at D = 0 is a₀"
    )
    p.state(Theorem((), (CURVE, BRANCH), (RELATION, EXPANSION)))
    p.say("Z is Jacobi's zeta function: odd, of period 2K, Z' = dn² - E/K. Its addition theorem Z(u+v) = Z(u) + Z(v) -")
    p.say("k² sn u sn v sn(u+v) is an identity at u = 0, and its derivative by u is one:")
    p.lemma(addition())
    p.say("With (ū, a) and with (ū, -a), and the difference of both, as Z is odd: Z(ū+a) - Z(ū-a) = 2Z(a) - k² sn ū sn")
    p.say("a (sn(ū+a) + sn(ū-a)), that is 2Z(a) + (2w/y)(1 - 1/𝒟):")
    shape = 2 * RATIO * (1 - 1 / elliptic.denominator())
    p.printed(Equation("-k² sn ū sn a (sn(ū+a) + sn(ū-a)) = (2w/y)(1 - 1/𝒟)", chord_of_zeta(), shape, TWO))
    p.lemma(Equation("w/y = cn dn/sn", SMALL_W / Y, RATIO, TWO))
    p.say("With Ψ = 2Z + 2w/y that is Ψ(a) - Z(u~) + Z(u) = 2w/(y𝒟).")
    p.step(SHAPE, CURVE)
    p.say("And (5.15), T = 0, says 1/𝒟 = (1 - G/(2Vw))/(Dλ):")
    M, whole = (2 * w - G / V) / (y * level), V * y * level * SCALE
    p.printed(
        part("M(a) - D·2w/(y𝒟) = -T/(Vyλ𝒟), M = (2w - G/V)/(yλ)", M - 2 * D * w / (y * SCALE), -true_relation() / whole)
    )
    p.say("So M(a) = D(Ψ(a) - Z(u~) + Z(u)) is the map, for D = 0 as well.  For 𝒦 = hγ it is (5.15) with Λ/h, D/h, lh")
    p.say("(5.12-scaling), where V, G, λ get the factors h, h², h: T/h is hG𝒟 - 2Vw(𝒟 - Dλ), and M has hG in the place")
    p.say("of G.")
    h = sp.Symbol("h")
    scaled = {V: h * V, G: h**2 * G, level: h * level, D: D / h}
    height = Quotient((h, SCALE, G, V, D, y, w, level))
    p.lemma(
        Equation("T scaled", [true_relation().xreplace(scaled)],
                 [h * (h * G * SCALE - 2 * V * w * (SCALE - D * level))], height),
        )  # fmt: skip
    p.step(RELATION, SHAPE, CURVE, "5.15", "5.12-scaling", "5.13")
    p.say("Let M(a₀) = 0 and M'(a₀) ≠ 0, and A the inverse of M near 0. As z = Z(u~) - Z(u) is bounded, a = A(D(Ψ(a) -")
    p.say("z)) has one solution near a₀ for |D| small, analytic in D and z, and uniformly in z, modulo D³, it is")
    a = half_increment()
    p.printed(
        Equation("a = a₀ + A'm + ½A''m² at a = a₀ + DA'(Ψ₀-z) + D²(A'²Ψ₀'(Ψ₀-z) + ½A''(Ψ₀-z)²)",
                 [A1 * coordinate(a) + A2 / 2 * coordinate(a) ** 2], [a], SECOND_ORDER),
    )  # fmt: skip
    p.say("So u~ - u = 2a = const - 2DA'z + D²(const + const·z + A''z²) + O(D³), the constants those of the curve.")
    p.lemma(
        Equation("the coefficient of D²z² in 2a is A''", sp.expand(2 * a).coeff(D, 2).coeff(z, 2), A2, SECOND_ORDER)
    )
    p.step(EXPANSION, RELATION, BRANCH)
    p.say("z is a difference along the orbit: with v = u + 2DA'(0)Z(u) the map is v~ = v + const + O(D²), a rotation")
    p.say("on every curve, resonant or not.  What tells it from one is of the order D², and the sum of z² along an")
    p.say("orbit.")
    p.control(addition(-1))
    wrong = Equation("the same with 1/𝒟 - 1", chord_of_zeta(), -shape, TWO)
    p.control(wrong)
    p.control(
        part("M with G/(2V)", (2 * w - G / (2 * V)) / (y * level) - 2 * D * w / (y * SCALE), -true_relation() / whole)
    )
    b = half_increment(A2)
    p.control(Equation("a with A'' for ½A''", A1 * coordinate(b) + A2 / 2 * coordinate(b) ** 2, b, SECOND_ORDER))


if __name__ == "__main__":
    main(__file__)
