"""Steady rotation of the discrete ball, in closed form: lemmas of chapsym, which the paper does not state."""

import sympy as sp

from chapsym.derive import gibbs, steady, three
from chapsym.derive.gibbs import D, gamma, k
from chapsym.derive.quotient import Quotient
from chapsym.derive.steady import moment
from chapsym.derive.three import placed
from chapsym.prove import Equation, Proof, claim, equations, main

#: The axis w, the factor for the Gibbs vector, and p₀, c of the rotation about w with the quaternion (p₀, c w).
w = sp.Matrix(sp.symbols("w1:4"))
J = (three.J1, three.J2, three.J3)
MOMENTS = (J[1] + J[2], J[0] + J[2], J[0] + J[1])
n, p0, c = sp.symbols("stretch p0 c")
#: w × Iw = 0 makes w an eigenvector of I, here with the moment `moment`.
FREE = Quotient((n, p0, c, *w, *k, *gamma, moment, D), [])
SIZE = p0**2 + c**2 * w.dot(w)


def carried(x: sp.Matrix) -> sp.Matrix:
    """B(γ)x for an x with Ix = `moment` x."""
    return moment * x + D * (gamma.dot(gamma) * x - gamma.dot(x) * gamma)


def turned(x: sp.Matrix) -> sp.Matrix:
    """(p₀² + |p|²)Ωᵀx, without denominator, for the quaternion p = (p₀, c w)."""
    change = sp.Matrix(gibbs.turn())
    values = placed(((gibbs.p0, *gibbs.p), (p0, *(c * w))), (gibbs.v, x))
    return (SIZE * (x + change.xreplace(values))).applyfunc(sp.cancel)


equal = equations(FREE)


@claim(
    "steady",
    r"B(\gamma)w = \tfrac12\mathcal K,\ w\times Iw = 0 \Rightarrow u = nw,\ n = 1 + n^2|w|^2,\ "
    r"\Omega^Tw = w,\ B(\Omega^T\gamma)w = \tfrac12\Omega^T\mathcal K",
    uses=("gibbs", "gibbs-rotation"),
)
def steady_rotation(p: Proof) -> None:
    """Where w = B(γ)⁻¹𝒦/2 is along a principal axis, or the moments are equal, every step is the same rotation."""
    p.assume("w × Iw = 0, that is Iw = λw (any w where the moments are equal); q₀ ≠ 0")
    p.say("With u = nw and k = B(γ)w, B(γ)u + u × Iu - (1 + |u|²)k = (n - 1 - n²|w|²)B(γ)w:")
    values = placed((gibbs.u, n * w), (k, carried(w)))
    same = dict.fromkeys((gibbs.I1, gibbs.I2, gibbs.I3), moment)
    residual = sp.Matrix(gibbs.residual()).xreplace(values).xreplace(same)
    p.printed(equal("G(nw) = (n - 1 - n²|w|²)B(γ)w", residual, (n - 1 - n**2 * w.dot(w)) * carried(w)))
    along = {w[1]: 0, w[2]: 0}
    first = sp.Matrix(gibbs.residual()).xreplace(values).subs({gibbs.I1: moment, **along})
    ring = Quotient((*FREE.symbols, gibbs.I2, gibbs.I3), [])
    p.lemma(equal("the same for w along e₁ and any I₂, I₃", first,
                  ((n - 1 - n**2 * w.dot(w)) * carried(w)).subs(along), ring))  # fmt: skip
    p.say("A rotation about w leaves w, and B(γ)w = λw + D(|γ|²w - ⟨γ,w⟩γ) turns as k does: the next w is this one.")
    after = placed((gamma, turned(gamma) / SIZE))
    moved = (SIZE * carried(w).xreplace(after)).applyfunc(sp.cancel)
    p.printed(
        equal("Ωᵀw = w", turned(w), SIZE * w),
        equal("B(Ωᵀγ)w = ΩᵀB(γ)w", (SIZE * moved).applyfunc(sp.cancel), SIZE * turned(carried(w))),
    )
    p.control(equal("G(nw) with n - 1 + n²|w|²", residual, (n - 1 + n**2 * w.dot(w)) * carried(w)))
    p.control(equal("B(Ωᵀγ)w = B(γ)w", moved, SIZE * carried(w)))
    p.control(equal("the same for w along e₁ + e₂ and any I₂, I₃",
                    sp.Matrix(gibbs.residual()).xreplace(values).subs({gibbs.I1: moment, w[2]: 0}),
                    ((n - 1 - n**2 * w.dot(w)) * carried(w)).subs(w[2], 0), ring))  # fmt: skip


@claim(
    "steady-branch",
    r"I_1 = I_2 = I_3:\quad \det\partial_uG(nw) = \tfrac{2-n}n\det B(\gamma),\quad "
    r"n = \tfrac2{1+\sqrt{1-4|w|^2}} < 2 \iff 2|w| = \sin\theta < 1",
    uses=("steady", "stable-determinant"),
)
def steady_branch(p: Proof) -> None:
    """With equal moments the small branch folds at a quarter turn, 2|w| = 1, and nowhere before."""
    p.assume("n = 1 + n²|w|², n ≠ 0")
    same = dict.fromkeys((gibbs.I1, gibbs.I2, gibbs.I3), moment)
    values = placed((gibbs.u, n * w), (k, carried(w))) | same
    determinant = gibbs.jacobian().xreplace(values).det(method="berkowitz")
    B = sp.Matrix(gibbs.contact_inertia()).xreplace(same).det(method="berkowitz")
    ring = Quotient((*w, n, *k, *gamma, moment, D), [n - 1 - n**2 * w.dot(w)])

    def scaled(text: str, factor: sp.Expr) -> Equation:
        return Equation(text, sp.expand(n * determinant), sp.expand(factor * B), ring)

    p.printed(scaled("n det ∂G/∂u = (2 - n) det B(γ)", 2 - n))
    p.say("n is 1 at |w| = 0 and grows with |w| up to 2, where 1 - 4|w|² = 0 and |u|² = n - 1 = 1: θ = 90°.")
    u = n * w
    p.lemma(Equation("sin²θ = 4|u|²/(1 + |u|²)² = 4|w|²", 4 * u.dot(u), 4 * w.dot(w) * (1 + u.dot(u)) ** 2, ring))
    p.lemma(Equation("(2 - n)² = n²(1 - 4|w|²)", (2 - n) ** 2, n**2 * (1 - 4 * w.dot(w)), ring))
    point = {"w1": "2/5", "w2": "0", "w3": "0", "stretch": "5/4", "moment": "6", "D": "3"}
    point |= {"g1": "2/7", "g2": "3/7", "g3": "6/7", "k1": "0", "k2": "0", "k3": "0"}
    values = {sp.Symbol(name): sp.Rational(value) for name, value in point.items()}
    left, right = (x.subs(values) for x in (n * determinant, (2 - n) * B))
    p.witness("sin θ = 4/5", point, Equation("n det ∂G/∂u = (2 - n) det B(γ)", left, right, ring))
    p.control(scaled("n det ∂G/∂u = (2 + n) det B(γ)", 2 + n))


def determinant_along_first(*across: sp.Symbol) -> sp.Expr:
    """det ∂G/∂u at u = nw for w along e₁ and a γ without the components `across`; moments of inertia from J."""
    mass, first = placed(((gibbs.I1, gibbs.I2, gibbs.I3), MOMENTS)), dict.fromkeys((w[1], w[2], *across), 0)
    values = placed((gibbs.u, n * w), (k, carried(w)))
    jacobian = gibbs.jacobian().xreplace(values).xreplace(mass)
    return jacobian.xreplace({moment: MOMENTS[0], **first}).det(method="berkowitz")


@claim(
    "steady-axis",
    r"w, \gamma \parallel e_1:\quad \det\partial_uG(nw) = \tfrac{2-n}n I_1"
    r"\bigl(\Lambda_2\Lambda_3 - (J_1-J_2)(J_3-J_1)|u|^2\bigr),\quad "
    r"I_2I_3 - (J_1-J_2)(J_3-J_1) = 2(J_1^2+J_2J_3)",
    uses=("steady",),
)
def steady_axis(p: Proof) -> None:
    """About a principal axis the small branch folds at a quarter turn, too: no other branch crosses it before."""
    p.assume("n = 1 + n²|w|²; γ = ±e₁ or D = 0: the second is the first with D = 0")
    ring = Quotient((w[0], n, *J, gamma[0], D), [n - 1 - n**2 * w[0] ** 2, gamma[0] ** 2 - 1])
    determinant = determinant_along_first(gamma[1], gamma[2])
    first, second, third = MOMENTS
    crossed = (J[0] - J[1]) * (J[2] - J[0])

    def factored(text: str, sign: int) -> Equation:
        across = (second + D) * (third + D) - sign * crossed * n**2 * w[0] ** 2
        return Equation(text, sp.expand(n * determinant), sp.expand((2 - n) * first * across), ring)

    p.printed(factored("n det ∂G/∂u = (2 - n)I₁(Λ₂Λ₃ - (J₁-J₂)(J₃-J₁)|u|²)", 1))
    p.printed(Equation("I₂I₃ - (J₁-J₂)(J₃-J₁) = 2(J₁² + J₂J₃)", [second * third - crossed], [2 * (J[0]**2 + J[1] * J[2])],
                       Quotient(tuple(J), [])))  # fmt: skip
    p.say("So for |u| < 1 the last factor is positive: Λ₂Λ₃ ≥ I₂I₃, and |u|² times what may be taken off is less.")
    p.control(factored("the same with + (J₁-J₂)(J₃-J₁)|u|²", -1))


@claim(
    "steady-roll",
    r"w \parallel e_1 \perp \gamma:\quad \det\partial_uG(nw) = \tfrac{2-n}n(I_1+D)\bigl(I_2I_3 - (J_1-J_2)(J_3-J_1)|u|^2"
    r" + \tfrac D2(I_2+I_3 + (I_2-I_3)(\gamma_2^2-\gamma_3^2+2u\gamma_2\gamma_3))\bigr)",
    uses=("steady", "steady-axis"),
)
def steady_roll(p: Proof) -> None:
    """Rolling straight about a principal axis the branch folds at a quarter turn, if I₂ and I₃ are not too different."""
    p.assume("n = 1 + n²|w|², |γ| = 1; √2|I₂ - I₃| ≤ I₂ + I₃ for the conclusion")
    u = n * w
    unit = gamma[1] ** 2 + gamma[2] ** 2 - 1
    ring = Quotient((w[0], n, *J, gamma[1], gamma[2], D), [n - 1 - n**2 * w[0] ** 2, unit])
    determinant = determinant_along_first(gamma[0])
    first, second, third = MOMENTS
    turn = gamma[1] ** 2 - gamma[2] ** 2 + 2 * u[0] * gamma[1] * gamma[2]

    def factored(text: str, sign: int) -> Equation:
        across = second * third - (J[0] - J[1]) * (J[2] - J[0]) * u[0] ** 2
        across += D * (second + third + sign * (second - third) * turn) / 2
        return Equation(text, sp.expand(n * determinant), sp.expand((2 - n) * (first + D) * across), ring)

    p.printed(factored("n det ∂G/∂u = (2 - n)(I₁ + D)(I₂I₃ - ... + D/2(I₂ + I₃ + (I₂ - I₃)c))", 1))
    p.say(
        "The first two terms are positive for |u| < 1 as in `steady-axis`; c = γ₂² - γ₃² + 2uγ₂γ₃ has c² ≤ 1 + u² < 2:"
    )
    rest = (u[0] * (gamma[1] ** 2 - gamma[2] ** 2) - 2 * gamma[1] * gamma[2]) ** 2
    p.printed(Equation("1 + u² - c² = (u(γ₂² - γ₃²) - 2γ₂γ₃)²", [1 + u[0] ** 2 - turn**2], [rest],
                       Quotient((w[0], n, gamma[1], gamma[2]), [unit])))  # fmt: skip
    p.control(factored("the same with - (I₂ - I₃)c", -1))
    point = {w[0]: "2/5", n: "5/4", J[0]: 1, J[1]: 2, J[2]: 4, gamma[1]: "3/5", gamma[2]: "4/5", D: 3}
    exact = {symbol: sp.Rational(value) for symbol, value in point.items()}
    whole = factored("at the point", 1)
    values = {str(symbol): str(value) for symbol, value in point.items()}
    left, right = ([x.subs(exact) for x in side] for side in (whole.left, whole.right))
    p.witness("sin θ = 4/5", values, Equation("at the point", left, right, ring))


@claim(
    "isotropic-spin",
    r"I_1 = I_2 = I_3 = I:\quad B(\gamma/|\gamma|)^{-1}k = \tfrac1{I+D}\bigl(k + \tfrac DI\tfrac{\langle k,\gamma\rangle}"
    r"{|\gamma|^2}\gamma\bigr)",
    uses=("2.5-inverse",),
)
def isotropic_spin(p: Proof) -> None:
    """The axis of the steady rotation for three equal moments."""
    p.assume("γ ≠ 0, I > 0")
    found = sp.Matrix(steady.spin())
    square = gamma.dot(gamma)
    direction = square * moment * found + D * (square * found - gamma.dot(found) * gamma)  # |γ|²B(γ/|γ|)w

    def inverse(text: str, value: sp.Matrix) -> Equation:
        return equal(text, value.applyfunc(lambda e: sp.numer(sp.together(e))), sp.zeros(3, 1))

    p.printed(inverse("|γ|²(B(γ/|γ|)w - k) = 0", direction - square * k))
    steps, value = steady.spin_steps()
    p.lemma(equal("the steps of the kernel compute w", three.unrolled(steps, value), found))
    wrong = found.subs(D, -D)
    p.control(inverse("with D of the other sign", square * moment * wrong + D * (square * wrong - gamma.dot(wrong) * gamma)
                      - square * k))  # fmt: skip


@claim("straight", r"\Omega(p)\,s(p, \Omega(p)^T\gamma) = s(p,\gamma)", uses=("4.9", "5.1"))
def straight_line(proof: Proof) -> None:
    """The same rotation step after step moves the contact point by the same vector in space."""
    q, q0 = three.q, three.q0
    proof.assume("|(q₀, q)| = 1")
    proof.say("R_{k+1} s(p, γ_{k+1}) = R_k Ω s(p, Ωᵀγ_k) for the steps Δr = ρ R_k s(p, γ_k) of the contact point.")
    step, rotation = sp.Matrix(three.centre_step()), sp.Matrix(three.rotation())
    ring = Quotient((q0, *q, *gamma), [three.UNIT_QUATERNION])
    later = step.xreplace(placed((gamma, rotation.T * gamma)))
    proof.printed(equal("Ω s(p, Ωᵀγ) = s(p, γ)", (rotation * later).applyfunc(sp.expand), step, ring))
    proof.control(equal("s(p, Ωᵀγ) = s(p, γ)", later.applyfunc(sp.expand), step, ring))


if __name__ == "__main__":
    main(__file__)
