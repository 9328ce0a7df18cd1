"""Where q steps are p half turns, the reduced map is a rotation to first order in D, and to second order it never is."""

import sympy as sp

from chapsym.derive import elliptic
from chapsym.derive.elliptic import HALF, L1, L2, L3, U, k2, l
from chapsym.derive.quotient import Quotient
from chapsym.proofs import second_routes
from chapsym.proofs.open import terms
from chapsym.proofs.open.chord import PAIR
from chapsym.prove import Equation, Fact, Identity, Proof, Theorem, claim, main
from chapsym.prove.polynomials import Ratio, parameters

#: Z(u+v) - Z(u) - Z(v), and cn dn/sn of v.
SPREAD = -k2 * U.sn * HALF.sn * elliptic.added(U, HALF, 1).sn
POLE = HALF.cn * HALF.dn / HALF.sn


def square(pole: sp.Expr = POLE, sign: int = -1) -> Equation:
    """(Z(u+v) - Z(u) - Z(v) - cn dn/sn)² in terms of dn² at both ends; the arguments mutate it."""
    ends = U.dn**2 + elliptic.added(U, HALF, 1).dn ** 2
    marks = "-" if pole == POLE else "+", "-" if sign < 0 else "+"
    left, right = "(-k² sn u sn v sn(u+v) {} cn dn/sn(v))²", "cn² dn²/sn²(v) + 1 + dn²v {} (dn²u + dn²(u+v))"
    text = f"{left.format(marks[0])} = {right.format(marks[1])}"
    return Equation(text, (SPREAD - pole) ** 2, POLE**2 + 1 + HALF.dn**2 + sign * ends, PAIR)


def product_of_poles(sign: int = 1) -> Identity:
    """The equation 1/(sinh x sinh y) = (coth x + coth y)/sinh(x + y), with X = e^x and Y = e^y."""

    def sinh(e: Ratio) -> Ratio:
        return (e - 1 / e) / 2

    def coth(e: Ratio) -> Ratio:
        return (e + 1 / e) / (e - 1 / e)

    X, Y = parameters("X Y")
    right = (coth(X) + sign * coth(Y)) / sinh(X * Y)
    return second_routes.identity("1/(sinh x sinh y) = (coth x + coth y)/sinh(x+y)", 1 / (sinh(X) * sinh(Y)), right)


def chords_of_a_polygon(most: int, weight: int = 2) -> Equation:
    """Σ over r mod q of 2 - 2cos(2πpr/q) = 2q for all q ≤ most, times w - 1, for w = e^{2πip/q}: w^q = 1 and w ≠ 1."""
    w = sp.Symbol("w")
    sums = [(w - 1) * sum(weight - w**r - w ** (q - r) for r in range(q)) for q in range(2, most + 1)]
    wanted = [2 * q * (w - 1) - (1 + w) * (w**q - 1) for q in range(2, most + 1)]
    text = f"(w - 1)Σ_r ({weight} - w^r - w^{{q-r}}) = 2q(w - 1) - (1 + w)(w^q - 1), r mod q, q = 2..{most}"
    return Equation(text, sums, wanted, Quotient((w,)))


def in_fourier_series(p: Proof) -> None:
    """Σz² a second time, from the Fourier series of Z: the same coefficients, by telescoping."""
    p.say("Z = (π/K) Σ sin(nθ)/sinh(nη), θ = πu/K, η = πK'/K; over the orbit the harmonics N = mq of z² remain,")
    p.say("q-fold, and the coefficient of e^{iNθ} in z² is -(π/2K)² Σ_n (2 - 2cos(2πpn/q))/(sinh nη sinh(N-n)η), n ≠")
    p.say("0, N. The product is (coth nη - coth(n-N)η)/sinh Nη: within a class of n mod N the sum telescopes to 2/sinh")
    p.say("Nη, and the weights, 0 in the class of 0, add up to 2N. So it is -(π/K)²N/sinh Nη, and the one of -2dn² =")
    p.say("-2Z' - 2E/K over q points, divided by q, is -(π/K)²N/sinh Nη, too.")
    p.route(
        "from the Fourier series of Z; Σ_r (2 - 2cos(2πpr/q)) = 2q for q = 2..12, r mod q, by w = e^{2πip/q}, w^q = 1, w ≠ 1",
        product_of_poles(),
        chords_of_a_polygon(12),
    )
    p.control(second_routes.mutated("(coth x - coth y)/sinh(x+y)", product_of_poles(-1)))
    p.control(chords_of_a_polygon(12, 1))


CHORD = "0 < k < 1 with M(a₀) = 0, M'(a₀) ≠ 0 as in chord; p ≠ 0, q ≥ 2 without common factor"
NEAR = "δ = u_q - u_0 - 2Kp is O(D²) at some u₀, as D → 0 with Λ, l, h such that 2a₀q = 2Kp + O(D)"
SQUARES = "δ = const + D²A''Σz² + O(D³) over the orbit of a rotation, with Σz = 0 in the sum"
SUM = "δ = const - 2A''D²Σdn²(u₀ + 2Kj/q) + O(D³), A'' = -M''/M'³"
NOT_CONSTANT = "Σdn²(u₀ + 2Kj/q) is greatest at u₀ = 0, less at K/q, and strictly monotone between them, mod 2K/q"


@claim(
    "resonance",
    r"2a_0q = 2Kp + O(D),\ \delta = O(D^2) \text{ at some } u_0:\quad \delta = u_q - u_0 - 2Kp = c - 2A''(0)\,D^2\sum_{j=0}^{q-1}\mathrm{dn}^2\bigl(u_0+\tfrac{2Kj}q\bigr)+O(D^3),"
    r"\quad A''(0) = -\frac{M''(a_0)}{M'(a_0)^3}",
    uses=["chord"],
)
def resonance(p: Proof) -> None:
    """At a resonance the displacement after q steps is D² times a function of u₀ that is never constant, up to O(D³)."""
    p.assume(
        "chord: Λ1 > Λ2 > Λ3, 1/Λ2 < l < 1/Λ3, so that 0 < k < 1, M(a₀) = 0, M'(a₀) ≠ 0; p ≠ 0, q ≥ 2 without common factor"
    )
    p.assume("δ = u_q - u_0 - 2Kp is O(D²) at some u₀, as D → 0 with Λ, l, h such that 2a₀q = 2Kp + O(D)")
    p.state(Theorem((), (CHORD, NEAR), (SUM, NOT_CONSTANT)))
    p.say("By chord u~ - u = 2a = 2a₀ + D(c₁ - 2A'z) + D²(c₂ + c₃z + A''z²) + O(D³) with z = Z(u~) - Z(u), c_i of the")
    p.say("curve. Over q steps δ = O(D), and Σz = Z(u_q) - Z(u_0) = Z(u_0 + δ) - Z(u_0) = O(δ), as 2K is a period of")
    p.say("Z. So δ = const + O(D²): as it is O(D²) at one u₀, it is at all, and then Σz = O(D²). To second order")
    p.say(
        "    δ = const + D²A'' Σz² + O(D³), in Σz² the orbit u_0 + 2Kpj/q of a rotation: the points u_0 + 2Kj/q mod 2K."
    )
    p.step(SQUARES, CHORD, NEAR, "chord")
    p.say("The squares, with c = Z(v) + cn dn/sn(v) and v = 2Kp/q (v is no multiple of 2K, as q ≥ 2):")
    p.printed(square())
    p.say("that is (z - c)² = c' - dn²u - dn²u~ by the addition theorem. With Σz = 0 on the orbit: Σz² = const -")
    p.say("2Σdn².")
    M1, M2 = sp.symbols("M1 M2")
    inverse = Quotient((M1, M2))
    twice = -M2 / M1**3 * M1**2 + M2 / M1
    p.lemma(Equation("A(M(a)) = a twice differentiated, at A' = 1/M', A'' = -M''/M'³", twice, 0, inverse))
    p.step(SUM, SQUARES)
    p.say("f(u) = Σ_j dn²(u + 2Kj/q) has the periods 2K/q, 2iK' and in a cell one pole, double, at iK', as dn² has in")
    p.say("its own and the q shifts of iK' differ: f is not constant. f' has order 3, so its zeros are those that it")
    p.say("must have, as it is odd: 0, K/q, K/q + iK'. On the real axis f is strictly monotone between 0 and K/q, mod")
    p.say("2K/q. By the Fourier series of dn², with η = πK'/K: f = qE/K + q(π/K)² Σ_{m≥1} mq cos(mqπu/K)/sinh(mqη),")
    p.say("all harmonics of one sign: f has its maximum at 0, its minimum at K/q, and f(0) - f(K/q) is 2q(π/K)² times")
    p.say("the sum of mq/sinh(mqη) over odd m. So, if A'' ≠ 0, the displacement is extreme near u₀ = 0, where γ_b = 0,")
    p.say("and near K/q,")
    p.say("which for odd q is u₀ = K, where γ_a = 0, mod 2K/q. It differs there by 2A''D²(f(0) - f(K/q)) + O(D³),")
    p.say("least at γ_b = 0 where A'' > 0.")
    p.step(NOT_CONSTANT, CHORD)
    in_fourier_series(p)
    p.control(square(pole=-POLE))
    p.control(square(sign=1))


def slow_parts() -> tuple[sp.Expr, sp.Expr, Quotient]:
    """(2w - hG/V)/h and yλ/h² at a = hb to first order in h, and the ring in which h² = 0."""
    h, b, V, alpha, beta, mu = sp.symbols("h b V alpha beta mu")
    a = h * b
    s, c, d = a - (1 + k2) * a**3 / 6, 1 - a**2 / 2, 1 - k2 * a**2 / 2
    y = s**2
    above, below = 2 * s * c * d - h * V * (1 + alpha * y - beta * y**2), y * (l - mu * y)
    return sp.expand(above / h), sp.expand(below / h**2), Quotient((h, b, V, l, k2, alpha, beta, mu), [h**2])


WIDTH = "near a level with 2a₀q = 2Kp, A'' ≠ 0, ω' ≠ 0 there are, for D small, levels with displacements of both signs"
TWIST = "for h small, A'' > 0 and ω' > 0 on an interval of levels, where ω = a₀/K takes rational values p/q > 0"


@claim(
    "plateaus",
    r"h \text{ small},\ 0 < D < D_0(h): \text{ on an interval of levels } l \text{ of a length} \ge cD^2,\ "
    r"\mathcal G_h^q \text{ displaces by } p \text{ half turns and more, and by } p \text{ half turns and less}",
    uses=["resonance", "5.9-circle", "small-branch", "self-adjoint", "symmetries"],
)
def plateaus(p: Proof) -> None:
    """For every ball with three different moments, every small h and every smaller D there are levels with displacements of both signs."""
    p.assume(
        "Λ1 > Λ2 > Λ3 fixed and D → 0, or I1 > I2 > I3 fixed and Λ = I + D: all below is uniform in Λ near its limit"
    )
    p.assume("0 < h < h₀ for some h₀ that depends on Λ; the small branch")
    p.state(Theorem((terms.FOR_SMALL,), (terms.THREE, terms.SMALL_BRANCH), (terms.BOTH_SIGNS,)))
    p.say("1. Let a level l₀ have 2a₀q = 2Kp, A'' ≠ 0 and let ω(l) = a₀/K have ω' ≠ 0 there. δ at u₀ = 0 plus δ at u₀")
    p.say("= K/q is 4q(a₀ - Kp/q) + O(D), which changes its sign within |l - l₀| ≤ CD: it is 0 at some l*. By the")
    p.say("first order of resonance δ is const + O(D²) there, hence O(D²), and δ = ±A''D²(f(0) - f(K/q)) + O(D³) at")
    p.say("the two points: of opposite signs for D small enough. As ∂δ/∂l = 2qK ω' + O(D), they stay so on an interval")
    p.say("around l* of a length that is A''D²(f(0) - f(K/q))/(qK|ω'|) to leading order: the width of the plateau p/q.")
    p.step(WIDTH, "resonance", terms.THREE)
    p.say("2. Both hypotheses hold for small h. M = (2w - hG/V)/(yλ), with (5.14-alpha) and a = hb, modulo h²:")
    above, below, ring = slow_parts()
    b, V = sp.symbols("b V")
    p.printed(
        Equation("(2w - hG/V)/h = 2b - V", above, 2 * b - V, ring), Equation("yλ/h² = b²l", below, b**2 * l, ring)
    )
    P = (2 * b - V) / (b**2 * l)
    plain = Quotient((b, V, l))
    at = {b: V / 2}
    p.say("So hM(hb) = (2b - V)/(b²l) + O(h²), with its derivatives, for b in a compact set of b > 0; at the zero b =")
    p.say("V/2")
    p.printed(
        Equation("the first derivative is 8/(lV²)", sp.diff(P, b).subs(at), 8 / (l * V**2), plain),
        Equation("the second is -64/(lV³)", sp.diff(P, b, 2).subs(at), -64 / (l * V**3), plain),
        Equation("A''(0) = h³l²V³/8 to leading order", 64 / (l * V**3) / (8 / (l * V**2)) ** 3, l**2 * V**3 / 8, plain),
    )
    p.say("so M' > 0, M'' < 0, A'' > 0; 2a₀ → 0 with h is the increment of the small branch (5.9-circle), V > 0 by the")
    p.say("choice of u. ω = a₀/K = hV/(2K) + O(h³), with its derivative by l, on a compact interval of 1/Λ2 < l <")
    p.say("1/Λ3. V/K increases:")
    level = Quotient((L1, L2, L3, l))
    rate, slope = sp.diff((L2 - L3) * (L1 * l - 1) / (L1 * L2 * L3), l), sp.diff(elliptic.squared_modulus(), l)
    falling = -(L1 - L2) * (L1 - L3) / ((L2 - L3) * (L1 * l - 1) ** 2)
    p.printed(
        Equation("dV²/dl = (Λ2 - Λ3)/(Λ2Λ3) > 0", rate, (L2 - L3) / (L2 * L3), level),
        Equation("dk²/dl = -(Λ1-Λ2)(Λ1-Λ3)/((Λ2-Λ3)(Λ1l-1)²) < 0", slope, falling, level),
    )
    p.say("and K increases with k. So ω' > 0 for h small, ω takes an interval of values, with rational ones p/q among")
    p.say("them.")
    p.step(TWIST, terms.THREE, terms.SMALL_BRANCH, "5.9-circle", "small-branch")
    p.say(
        "1. applies to each of these: h₀ and the interval of l are chosen first, then h, then p/q, then D₀. For h < 0"
    )
    p.say("it is the inverse map (self-adjoint): its displacement is -δ∘F⁻¹, of both signs as well.")
    p.say("Another order of the moments is the same with other names (symmetries).")
    p.step(terms.BOTH_SIGNS, WIDTH, TWIST, terms.FOR_SMALL, "self-adjoint", "symmetries")
    p.witness("a level", {"Λ": "(6, 5, 2)", "l": "3/10", "V²": "1/25", "k²": "1/6"},
              Fact("V² > 0 and 0 < k² < 1", all(0 < x < 1 for x in at_a_level())))  # fmt: skip
    p.control(Equation("(2w - hG/V)/h = b - V", above, b - V, ring))
    p.control(Equation("dk²/dl > 0", slope, -falling, level))
    p.control(Equation("A'' = +M''/M'³", -64 / (l * V**3) / (8 / (l * V**2)) ** 3, l**2 * V**3 / 8, plain))


def at_a_level() -> list[sp.Expr]:
    """V² and k² for Λ = (6, 5, 2), l = 3/10."""
    values = {L1: 6, L2: 5, L3: 2, l: sp.Rational(3, 10)}
    return [sp.sympify(e).subs(values) for e in ((L2 - L3) * (L1 * l - 1) / (L1 * L2 * L3), elliptic.squared_modulus())]


if __name__ == "__main__":
    main(__file__)
