"""The two ends of the separatrix do not fit: for every h ≠ 0 below the bound, and every D > 0 but a closed discrete set."""

from dataclasses import replace

import sympy as sp

from chapsym.derive.quotient import Quotient
from chapsym.proofs.open import terms
from chapsym.proofs.open.separatrix import X
from chapsym.prove import Equation, Proof, Theorem, claim, main

#: tanh of v and of c; the values of F', F'' at X.
t, s, F1, F2 = sp.symbols("t s F1 F2")
ENDS = Quotient((t, s))
SLOPES = Quotient((X, F1, F2))
SMALL_D = "Δ(0) - Δ(c/2) is not 0 for small D > 0"


def square_of_a_chord(sign: int = 1) -> Equation:
    """(tanh(v + c) - tanh v)² as a telescoping part and a summed part."""
    later = (t + s) / (1 + t * s)
    right = sign * 2 * (later - t) / s - (1 - t**2) - (1 - later**2)
    text = "z² = 2 coth(c) z - sech²v - sech²(v + c), z = tanh(v + c) - tanh v"
    return Equation(text, (later - t) ** 2, right, ENDS)


def second_derivative(sign: int = 1) -> Equation:
    """A'' for coth A(Y) = X, F(X) = Y: d/dY = (1/F') d/dX; F'' is a separate symbol."""
    first = -1 / ((X**2 - 1) * F1)
    found = (sp.diff(first, X) + sp.diff(first, F1) * F2) / F1
    right = 2 * X / ((X**2 - 1) ** 2 * F1**2) + sign * F2 / ((X**2 - 1) * F1**3)
    text = "A' = -1/((X² - 1)F'), A'' = 2X/((X² - 1)²F'²) + F''/((X² - 1)F'³)"
    return Equation(text, found, right, SLOPES)


@claim(
    "separatrix",
    r"I_1>I_2>I_3,\ 0<|h| \text{ below the bound}:\ \text{for all } D>0 \text{ but a set without limit points in } "
    r"[0,\infty) \text{ no finite measure with an almost everywhere positive density is invariant under } \mathcal G_h",
    uses=("separatrix-map", "separatrix-limit", "locked-circle", "self-adjoint"),
)
def separatrix(p: Proof) -> None:
    """For every ball with three different moments, every h below the bound, all D > 0 but a closed discrete set: no such measure."""
    p.assume("I₁ > I₂ > I₃ > 0 and h fixed, Λ = I + D; h > 0, as h < 0 is the inverse map (self-adjoint)")
    p.assume("other names of the moments: an exchange of 1 and 3 takes the map of h to that of -h (symmetries)")
    p.assume("h is below the bound of small-branch, which does not depend on D; the small branch")
    p.state(Theorem((terms.BUT_DISCRETE,), (terms.THREE, terms.SMALL_BRANCH), (terms.BOTH_SIGNS,)))
    p.say(
        "Let f be the map of separatrix-map, with c, X₀, F, and Δ = h₊(u) + h₊(-u) of separatrix-limit, for this D.",
        "1. Second order. With Y_i = Dz_i, z_i = tanh u_{i+1} - tanh u_i, the increment is 2A(Y_i), coth A(Y) = X,",
        "F(X) = Y. As f(-f(u)) = -u, the orbit of u backwards is the one of -u forwards, mirrored: Δ(u) = Σ(2A(Y_i) -",
        "2A(0)) over the whole orbit, i from -∞ to ∞. There Σz_i = 2, the difference of the ends of tanh, and |z_i| ≤",
        "Ce^{-2|u_i|}:",
        "    Δ(u) = 4A'(0)D + A''(0)D²Σz_i² + O(D³), where",
    )
    p.printed(second_derivative())
    p.say(
        "and F' > 0, F'' = 2hϰ > 0, X₀ > 1 at X = X₀ (separatrix-map): A''(0) > 0. To leading order u_i = u + ic, c",
        "at D = 0, and",
    )
    p.printed(square_of_a_chord())
    p.say(
        "so Σz_i² = 4 coth c - 2Σ_j sech²(u + jc) + O(D). As ∫sech²x e^{-iξx}dx = πξ/sinh(πξ/2), Poisson's sum is",
        "    Σ_j sech²(u + jc) = 2/c + (4π²/c²) Σ m cos(2πmu/c)/sinh(mπ²/c), m = 1, 2, ..., and",
        "    E(D) := Δ(0) - Δ(c/2) = -(16π²/c²) A''(0) D² Σ m/sinh(mπ²/c) + O(D³), m = 1, 3, 5, ..., which is not 0 for small D > 0.",
    )
    p.step(SMALL_D, terms.THREE, terms.SMALL_BRANCH, "separatrix-map", "separatrix-limit")
    p.say(
        "2. E is analytic in D near [0, ∞). Λ, ϰ, X₀, c are, since X₀ is a simple root. Let D₁ ≥ 0. At real u the",
        "derivative of F - Y by X is not 0: so f is analytic in u and D near real u and D₁ (implicit functions).",
        "Where x = Re u > r, r large, it is analytic in u and D near D₁ as well, whatever Im u is: tanh u - 1 is",
        "O(e^{-2x}) there, so Y is small, and a = A(Y) a contraction; |f(u) - u - c| ≤ Ce^{-2x} and Re c > c(D₁)/2.",
        "Finitely many steps lead from near a real u to Re u > r, and from there on Re uₙ grows by at least c(D₁)/4 a",
        "step: uₙ - nc converges uniformly, and its limit h₊ is analytic in u and D. So E is analytic near every D₁ ≥",
        "0, and by 1. not 0 everywhere: its zeros have no limit point in [0, ∞), and at every other D Δ is not",
        "constant.",
    )
    p.step(terms.NOT_CONSTANT, SMALL_D, terms.BUT_DISCRETE, "separatrix-map")
    p.say(
        "3. Where Δ is not constant, every neighbourhood of the level l = 1/Λ₂ has intervals of levels with",
        "displacements of both signs (separatrix-limit), and no finite measure that G_h keeps has a density that is",
        "positive almost everywhere (locked-circle). Left out are the D > 0 for which Δ is constant, if there are",
        "any: zeros of E.",
    )
    p.step(terms.BOTH_SIGNS, terms.NOT_CONSTANT, "separatrix-limit", "self-adjoint")
    p.measure(*MEASURED)
    p.conjecture("Δ is not constant for any D > 0: then no D is left out.")
    p.control(replace(second_derivative(-1), text="A'' with -F''"))
    p.control(replace(square_of_a_chord(-1), text="z² with -2 coth(c) z"))


MEASURED = (
    "I = (9, 6, 5), h = 9/2: E(D) over its second order, with the c and A'' of this D, is 0.998726, 0.987325, 0.879285, "
    "0.238356 for D = 1/1000, 1/100, 1/10, 1.",
    "The same ball, D = 1/10: after 300 steps of the map on the level with 2 log(4/k') - 300c = Δ(0), k'² = 1.46e-29, the displacement "
    "of u = 0 is 9e-30, that of c/2 is 1.47790438e-21; (Δ(c/2) - Δ(0))/h₊'(-c/2) is 1.47790437e-21.",
    "The same ball: E changes its sign at D = 2.3953174412988807611; there Δ(c/4) - Δ(0) = 4.06745e-54, so Δ is not constant.",
    "The same ball: of the intervals between multiples of 1/4 up to D = 10 two more have ends at which E has different signs; the "
    "changes are at D = 4.69325146647 and 8.01975228582.",
)

if __name__ == "__main__":
    main(__file__)
