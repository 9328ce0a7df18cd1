"""When the whole map preserves a measure with a continuous positive density: for D > 0, if and only if the moments are equal."""

from collections.abc import Sequence
from dataclasses import replace

import sympy as sp

from chapsym.derive import three
from chapsym.derive.gibbs import I1, I2, I3, D, u
from chapsym.derive.quotient import Quotient
from chapsym.derive.steady import moment
from chapsym.derive.three import UNIT_VERTICAL, gamma, placed
from chapsym.proofs.open import orbits, terms
from chapsym.proofs.open.orbits import START, SWING, around, half_momentum, slope, steady_level, t, turn
from chapsym.prove import Comparison, Equation, Proof, Theorem, claim, main, no, there_is

MOMENTS = (I1, I2, I3)
UNIT = Quotient((*u, t, *gamma, *MOMENTS, moment, D), [UNIT_VERTICAL])
#: Cyclic permutations (a, b, c) of the body axes (1, 2, 3), each a rotation.
CYCLES = ((1, 2, 0), (2, 0, 1), (0, 1, 2))
#: Two equal moments; and an example about e₃ with I₁ ≠ I₂, θ = 45°, in Q(√2).
EXAMPLE = orbits.EXAMPLE | {I1: sp.Integer(4), I2: sp.Integer(3)}


def along(axis: int, length: sp.Expr) -> sp.Matrix:
    """A vector along a principal axis."""
    return length * sp.eye(3)[:, axis]


def determinant(u_: sp.Matrix, gamma_: sp.Matrix, ball: dict[sp.Symbol, sp.Expr]) -> sp.Expr:
    """det ∂G/∂u at the step whose Gibbs vector is given."""
    return three.determinant(slope(u_, gamma_).xreplace(ball))


def with_equal_moments(text: str, u_: sp.Matrix, gamma_: sp.Matrix, ball: Sequence[sp.Symbol]) -> Equation:
    """(1 + |u|²) det ∂G/∂u = (1 - |u|²)I(I + D)² for the moments `ball`."""
    square = u.dot(u)
    left = (1 + square) * determinant(u_, gamma_, placed((MOMENTS, ball)))
    return Equation(text, left, (1 - square) * moment * (moment + D) ** 2, UNIT)


def about(cycle: Sequence[int], swing: sp.Expr = SWING) -> Equation:
    """The determinant of steady-circles about the last axis of `cycle`; the argument mutates its second part."""
    a, b, c = cycle
    names = placed((MOMENTS, [MOMENTS[i] for i in cycle]), (gamma, [gamma[i] for i in cycle]))
    level = steady_level(t) + swing * around(gamma[0], gamma[1], t)
    right = (1 - t**2) * level.xreplace(names)
    text = f"e_{c + 1}: (1 + t²) det 𝒜 = (1 - t²)(P + ½D(D + I_{c + 1})(I_{a + 1} - I_{b + 1}) Re((1 - it)(γ_{a + 1} + iγ_{b + 1})²))"
    return Equation(text, (1 + t**2) * determinant(along(c, t), gamma, {}), right, UNIT)


def small(axis: int, contact: sp.Expr = D) -> Equation:
    """|𝒦| at a steady rotation; the argument mutates D."""
    vector = (1 + t**2) * half_momentum(along(axis, t), gamma)
    moment_ = MOMENTS[axis]
    right = t**2 * ((moment_ + contact) ** 2 - contact * (contact + 2 * moment_) * gamma[axis] ** 2)
    text = f"e_{axis + 1}: (1 + t²)²|k|² = t²((I_{axis + 1} + D)² - D(D + 2I_{axis + 1})γ_{axis + 1}²)"
    return Equation(text, vector.dot(vector), right, UNIT)


@claim(
    "measure-iff",
    r"D > 0,\ r > 0 \text{ small}:\quad \Phi \text{ on } |\mathcal K| < r \text{ preserves a measure with a continuous "
    r"positive density} \iff I_1 = I_2 = I_3",
    uses=("small-branch", "self-adjoint", "steady", "step-determinant", "steady-circles"),
)
def measure_iff(p: Proof) -> None:
    """For D > 0 the whole map preserves a continuous positive density near 𝒦 = 0 if and only if the three moments are equal."""
    p.assume("I_i > 0, D > 0", *(x > 0 for x in (*MOMENTS, D)))
    p.assume("the small branch on P_r: |𝒦| < r, |γ| = 1, for any r > 0 up to the bound of small-branch")
    p.state(Theorem((), (terms.ALL_EQUAL, terms.SMALL_BRANCH), (there_is(terms.WHOLE),)), "measure-iff: if")
    p.assume("densities against d³𝒦 dσ(γ), σ the area of the sphere; the measure may be infinite")
    p.say(
        "Φ is an analytic diffeomorphism of P_r: it keeps |𝒦|, its root is regular (small-branch), and it has an inverse",
        "(self-adjoint).  So ϱ d³𝒦 dσ, ϱ continuous and positive, is invariant if and only if ϱ(Φx) det DΦ(x) = ϱ(x)",
        "for all x of P_r.  By step-determinant det DΦ is det 𝒜~/det 𝒜 where 𝒦 ∦ γ, which is dense in P_r.",
        "If. For three equal moments I, u any Gibbs vector and k that of its step:",
    )
    p.printed(with_equal_moments("I_i = I: (1 + |u|²) det 𝒜 = (1 - |u|²)I(I + D)²", u, gamma, [moment] * 3))
    back = turn(u) * gamma
    p.lemma(Equation("|Ωᵀγ| = 1", back.dot(back), 1, UNIT))
    p.say(
        "It does not depend on γ, nor on the sign of u: so det 𝒜~, which is that at (-u, Ωᵀγ), is det 𝒜, and det DΦ = 1",
        "where 𝒦 ∦ γ, by continuity on P_r.  ϱ = 1 is invariant: d³𝒦 dσ(γ) itself, and on each level M of |𝒦|, ⟨𝒦, γ⟩ its",
        "volume that is invariant under rotations.",
    )
    p.step(
        there_is(terms.WHOLE), terms.ALL_EQUAL, terms.SMALL_BRANCH, "small-branch", "self-adjoint", "step-determinant"
    )
    p.state(Theorem((), (terms.ROLLS, terms.TWO_DIFFER, terms.SMALL_BRANCH), (no(terms.WHOLE),)))
    p.say(
        "Only if. Let two moments be different, and a, b their axes, so that a, b, c is a cyclic order of 1, 2, 3. Where",
        "u = te_c each step turns the ball by θ = 2 arctan t about e_c (steady), and, with P of steady-circles renamed,",
    )
    for cycle in CYCLES:
        p.printed(about(cycle))
    p.say(
        "which is steady-circles with a, b, c in the place of 1, 2, 3. Of its hypotheses the ball has D > 0 and I_a ≠ I_b;",
        "I_c is any, so two moments may be equal. Let γ be not along e_c, θ = π/m (p = 1), m ≥ 3. The circle of these",
        "states is in P_r for all large m, as t = tan(π/2m) tends to 0:",
    )
    p.lemma(*(small(axis) for axis in range(3)))
    p.say(
        "that is |𝒦| = 2|k| ≤ 2t(I_c + D). By steady-circles Φ^{2m} = 1 on the circle, and det DΦ^{2m} there is other than 1",
        "but at the points with cos mψ = 0. At each other point x, ϱ(Φ^{2m}x) det DΦ^{2m}(x) = ϱ(x) with Φ^{2m}x = x is",
        "false for ϱ(x) > 0. So there is no such ϱ on any P_r, on any open set with one of these circles in it, nor on the",
        "level M of one.",
    )
    by = "small-branch", "self-adjoint", "step-determinant", "steady", "steady-circles"
    p.step(no(terms.WHOLE), terms.ROLLS, terms.TWO_DIFFER, terms.SMALL_BRANCH, *by)
    p.say(
        "For D = 0 the volume is invariant for all moments (step-determinant): for D ≥ 0 the condition is D = 0 or I₁ = I₂ = I₃.",
        "Not excluded: densities that vanish, or are not continuous, on every one of these circles.",
    )
    _example(p)
    p.control(with_equal_moments("the same for two equal moments and another", u, gamma, [moment, moment, I3]))
    p.control(replace(about(CYCLES[0], sp.S.Zero), text="the determinant about e_1 without the part with I_2 - I_3"))
    p.control(replace(small(0, -D), text="|𝒦| about e_1 with -D"))


def _example(p: Proof) -> None:
    p.say("Example with two equal moments, in Q(√2): J = (1, 2, 2), D = 1, about e₃, θ = 45°, γ = (3, 4, 5)√2/10.")
    product = orbits.normal(sp.Matrix([orbits.by_formula(EXAMPLE)]))[0]
    momentum = 2 * half_momentum(along(2, EXAMPLE[t]), START).subs(EXAMPLE)
    size, least, largest, slope_ = sp.symbols("k i1 i3 rho")
    facts = (
        orbits.at_root("|𝒦|² = 25/4", [momentum.dot(momentum)], [sp.Rational(25, 4)]),
        Comparison("5/2 is below the bound of small-branch: ϱ < 3/4 as 5/6 < 24/25 = sin(2 arctan ¾), and ¾(½(4 - 3) + 5/2) < 3",
                   [size / least < 2 * slope_ / (1 + slope_**2), slope_ * ((largest - least) / 2 + size) <= least],
                   {size: "5/2", least: 3, largest: 4, slope_: "3/4"}),
        orbits.at_root("the determinant of 4 steps, by the closed form", [orbits.by_formula(EXAMPLE)], [product]),
        orbits.not_one("it", product),
    )  # fmt: skip
    p.lemma(*facts)
    named = EXAMPLE | placed((gamma, START)) | {orbits.ROOT: sp.sqrt(2)}
    p.witness("J = (1, 2, 2), D = 1, θ = 45°", {str(name): str(value) for name, value in named.items()}, *facts)
    p.show("\\det D\\Phi^4", product)
    p.control(orbits.at_root("it is 1", [product], [1]))


if __name__ == "__main__":
    main(__file__)
