"""From small D to almost every D: what is analytic and not 0 for small D is 0 almost nowhere."""

from dataclasses import replace

import sympy as sp

from chapsym.derive import elliptic
from chapsym.derive.elliptic import L1, L2, L3, k2, l
from chapsym.derive.quotient import Quotient
from chapsym.proofs.open import terms
from chapsym.proofs.open.resonance import at_a_level
from chapsym.prove import Equation, Fact, Proof, Theorem, claim, main

h, b, V, D, x, alpha, beta, mu = sp.symbols("h b V D x alpha beta mu")
#: The ring to first order in h; x = sn²ū.
SLOW = Quotient((h, b, V, D, x, l, k2, alpha, beta, mu), [h**2])


def slow_relation() -> sp.Expr:
    """(hG𝒟 - 2Vw(𝒟 - Dλ))/h at the half increment a = hb: (5.15) as corrected."""
    a = h * b
    s, c, d = a - (1 + k2) * a**3 / 6, 1 - a**2 / 2, 1 - k2 * a**2 / 2
    y = s**2
    scale, G = 1 - k2 * x * y, V**2 * (1 + alpha * y - beta * y**2)
    return sp.expand((h * G * scale - 2 * V * s * c * d * (scale - D * (l - mu * y))) / h)


def rate_increases(contact: sp.Expr = D) -> Equation:
    """r'/r for r = V/(1 - Dl), in V²: the argument mutates D."""
    square = (L2 - L3) * (L1 * l - 1) / (L1 * L2 * L3) / (1 - D * l) ** 2
    right = L1 / (2 * (L1 * l - 1)) + contact / (1 - D * l)
    text = "r'/r = Λ1/(2(Λ1l - 1)) + D/(1 - Dl), r² = V²/(1 - Dl)²"
    return Equation(text, sp.diff(square, l) / square / 2, right, Quotient((L1, L2, L3, l, D)))


SLOW_STEP = "u~ = u + hr + O(h²) with r = V/(1 - Dl) > 0, which increases with l"
STRIPS = "connected strips of (D, h), one for each q ≥ q₀, cover h < h₀, and on each Δ(D, h) is analytic"
NOT_ZERO = "Δ is 0 on a set of measure 0 at most"


@claim(
    "almost-every",
    r"\text{for almost every } (D, h),\ D>0,\ 0<h<h_0(D),\ \mathcal G_h \text{ has an interval of levels on which } "
    r"\mathcal G_h^q \text{ displaces by one half turn and more, and by one half turn and less}",
    uses=["plateaus", "resonance", "5.15", "small-branch", "5.9-circle", "self-adjoint", "symmetries"],
)
def almost_every(p: Proof) -> None:
    """For every ball with three different moments and almost every D and small h, there are levels with displacements of both signs."""
    p.assume(
        "I1 > I2 > I3 > 0 fixed, Λ = I + D, 0 < D < D̂ with any D̂; 0 < h < h₀(I, D̂); the small branch; measure in the plane (D, h)"
    )
    p.state(Theorem((terms.FOR_ALMOST_ALL,), (terms.THREE, terms.SMALL_BRANCH), (terms.BOTH_SIGNS,)))
    p.say("Let l = (1-t)/Λ2 + t/Λ3 with t in a fixed interval [t₁, t₂] inside (0, 1), so that k stays away from 0 and")
    p.say("1. G_h is analytic in u, l, D, h (small-branch), for h = 0 the identity, so u~ = u + hr + h²e(u, l, D, h):")
    p.say("modulo h²")
    slow = V**2 - 2 * V * b * (1 - D * l)
    p.printed(Equation("(hG𝒟 - 2Vw(𝒟 - Dλ))/h at a = hb is V² - 2Vb(1 - Dl)", slow_relation(), slow, SLOW))
    p.say("so 2a = hr + O(h²) with r = V/(1 - Dl), V > 0 by the choice of u, 1 - Dl > 0 (5.9-circle); and r increases")
    p.say("with l:")
    p.printed(rate_increases())
    p.say("both terms positive.")
    p.step(SLOW_STEP, terms.THREE, terms.SMALL_BRANCH, "small-branch", "5.15", "5.9-circle")
    p.say(
        "K decreases with l (plateaus). Let δ(u; l, D, h) = u_q - u - 2K, the displacement beyond one half turn. While",
        "qh is bounded the derivatives of u_q obey v~ = v(1 + h²e_u) + hr' + h²e_l by l, and likewise by h: so ∂δ/∂l =",
        "qhr' - 2K' + O(h), where δ = 0 equal to 2K(r'/r - K'/K) + O(h) > 0, and ∂δ/∂h = qr + O(1) > 0, for h small.",
        "Hence the (D, h) with δ(0; l₁, D, h) < 0 < δ(0; l₂, D, h), 0 < D < D̂, form a strip h₋(D) < h < h₊(D),",
        "connected, for each q ≥ q₀, where q₀ is such that they are below h₀. On it δ(0; l*, D, h) = 0 has one solution",
        "l*(D, h), analytic; so Δ(D, h) = δ(K/q; l*, D, h) is analytic on it. Every (D, h) with h small is in a strip,",
        "as q need only be between 2K/(hr) at l₂ and at l₁ up to O(1), c/h apart.",
    )
    p.step(STRIPS, SLOW_STEP, "plateaus", terms.FOR_ALMOST_ALL)
    p.say(
        "For D → 0 at fixed h it is 2A''D²(f(0) - f(K/q)) + O(D³) by resonance, with A'' > 0 by plateaus: not 0. So Δ"
    )
    p.say("is 0 on a set of measure 0 of the strip at most.")
    p.step(NOT_ZERO, STRIPS, "resonance", "plateaus")
    p.say(
        "Where Δ ≠ 0, δ is 0 at one point of the circle l* and not at another; as ∂δ/∂l > 0 there is an interval of",
        "levels, with l* at one end, on which δ has both signs. A (D, h) without such levels is a zero of Δ for all of",
        "its c/h strips. For h < 0 it is the inverse map (self-adjoint): its displacement is -δ∘F⁻¹, of both signs as",
        "well.",
        "Another order of the moments is the same with other names (symmetries).",
    )
    p.step(terms.BOTH_SIGNS, STRIPS, NOT_ZERO, terms.FOR_ALMOST_ALL, "self-adjoint", "symmetries")
    p.witness("a level", {"Λ": "(6, 5, 2)", "l": "3/10", "D": "3/2"},
              Fact("V² > 0, 0 < k² < 1 and 0 < Dl < 1", all(0 < e < 1 for e in (*at_a_level(), sp.Rational(9, 20)))))  # fmt: skip
    p.lemma(
        Equation("at 1/Λ2 is k² = 1, at 1/Λ3 is k² = 0", [elliptic.squared_modulus().subs(l, 1 / e) for e in (L2, L3)], [1, 0],
                 Quotient((L1, L2, L3)))
    )  # fmt: skip
    p.control(Equation("the same with 1 + Dl", slow_relation(), V**2 - 2 * V * b * (1 + D * l), SLOW))
    p.control(replace(rate_increases(contact=-D), text="r'/r with - D/(1 - Dl)"))


if __name__ == "__main__":
    main(__file__)
