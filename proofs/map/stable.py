"""The forms in which the kernels keep their digits for D ≫ I: lemmas of chapsym, which the paper does not state."""

import sympy as sp

from chapsym.derive import continuous, gibbs, three
from chapsym.derive.gibbs import BY_INERTIA, I1, I2, I3, INERTIA, k, u
from chapsym.derive.gibbs import d as x
from chapsym.derive.gibbs import v as e
from chapsym.derive.limits import omega
from chapsym.derive.quotient import Quotient
from chapsym.derive.three import D, K, gamma, placed, q, q0, unrolled
from chapsym.prove import Comparison, Equation, Fact, Proof, claim, equations, main

#: A 3×3 matrix of symbols.
M = sp.Matrix(3, 3, sp.symbols("m1:4(1:4)"))
NORM = gamma.dot(gamma)
#: The ring of free symbols: no relations; |γ| = 1 is not used.
FREE = Quotient((q0, *q, *omega, *x, *e, *u, *k, *K, *gamma, *M, I1, I2, I3, D), [])
UNTIED = Quotient((*K, *gamma, I1, I2, I3, D), [])
UNIT = Quotient((*K, *gamma, I1, I2, I3, D), [three.UNIT_VERTICAL])


equal = equations(FREE)


def inertial(value: sp.Matrix) -> sp.Matrix:
    """The expression in terms of the moments of inertia."""
    return sp.Matrix(value).xreplace(BY_INERTIA)


@claim(
    "stable-momentum",
    r"B(\gamma)x = Ix + \gamma\times D(x\times\gamma), \quad \langle\gamma, \gamma\times De\rangle = 0",
    uses=("5.2", "gibbs"),
)
def stable_momentum(p: Proof) -> None:
    """𝒦 = B(γ)q + ... by two vector products: the rounding of x × γ does not reach the vertical part, which has no D."""
    B = inertial(three.contact_inertia())
    p.printed(equal("B(γ)x = Ix + γ × D(x × γ)", B * x, INERTIA * x + gamma.cross(D * x.cross(gamma))))
    p.say("Let e be what rounding makes of x × γ: then D e moves the result across γ only,")
    p.printed(equal("⟨γ, Ix + γ × D(x × γ + e)⟩ = ⟨γ, Ix⟩",
                     gamma.dot(INERTIA * x + gamma.cross(D * (x.cross(gamma) + e))), gamma.dot(INERTIA * x)))  # fmt: skip
    p.say(
        "where B(γ) ≥ D.  So it is a change of x by at most √(1 + (b/a)²)|e|, whatever D is, with a = ⟨γ, Iγ⟩ and b the part of",
        "Iγ across γ.  A rounding of an entry of B is one of D, and reaches it all:",
    )
    rounded = B + sp.Matrix(3, 3, lambda i, j: D * e[0] if (i, j) == (0, 0) else 0)
    steps, value = three.momentum_steps()
    p.lemma(
        equal("the steps of `momentum` compute 𝒦(q, γ)", inertial(unrolled(steps, value)), inertial(three.momentum()))
    )
    steps, value = three.residual_steps()
    p.lemma(equal("those of `residual` 𝒦(q, γ) - 𝒦", inertial(unrolled(steps, value)), inertial(three.momentum()) - K))
    steps, value = continuous.momentum_steps()
    p.lemma(equal("those of `contact_momentum` B(γ)ω", inertial(unrolled(steps, value)), B * omega))
    p.control(equal("⟨γ, (B + D e e₁e₁ᵀ)x⟩ = ⟨γ, Ix⟩", gamma.dot(rounded * x), gamma.dot(INERTIA * x)))
    p.control(equal("B(γ)x = Ix + γ × D(γ × x)", B * x, INERTIA * x + gamma.cross(D * gamma.cross(x))))


@claim(
    "stable-determinant",
    r"A = M + D(|\gamma|^2 - \gamma\gamma^T)\ \Rightarrow\ |\gamma|^2\det A = \langle M^T\gamma, \mathrm{adj}(A)\gamma\rangle",
    uses=("gibbs-newton",),
)
def stable_determinant(p: Proof) -> None:
    """The determinants of the step without D³, for ∂G/∂u and for the tangent Jacobian: the vertical direction has no D."""
    rolling = NORM * sp.eye(3) - gamma * gamma.T
    A = M + D * rolling
    adjugate = A.adjugate()
    value = (gamma.T * M * adjugate * gamma)[0]
    p.say("γᵀ(|γ|² - γγᵀ) = 0, so γᵀA = γᵀM; times adj(A)γ:")
    p.printed(equal("γᵀA = γᵀM", gamma.T * A, gamma.T * M), equal("|γ|² det A = ⟨Mᵀγ, adj(A)γ⟩", NORM * A.det(), value))
    p.say("adj(A) has D² at most, and M none.  In the sum over a row of A the terms have D³, which cancels:")
    one = placed((M, sp.eye(3)))
    terms = [A[0, j].subs(one) * adjugate[j, 0].subs(one) for j in range(3)]
    cubes = [rolling[0, j] * rolling.adjugate()[j, 0] for j in range(3)]
    less = [sum(sp.expand(e).coeff(D, i) * D**i for i in range(3)) for e in terms]
    p.lemma(
        equal("for M = 1 the terms of a row are D³ times those without M, and less", terms,
              [D**3 * c + rest for c, rest in zip(cubes, less, strict=True)]),
        Comparison("at γ = (2, 3, 6) those are not 0, but their sum is", [*(sp.Ne(c, 0) for c in cubes), sp.Eq(sum(cubes), 0)],
                   placed((gamma, (2, 3, 6)))),
    )  # fmt: skip
    mixed = (M + rolling).adjugate() - M.adjugate() - rolling.adjugate()
    p.lemma(equal("adj(A)γ has D² at most: adj(M)γ, D times a vector without D, and D² times another", adjugate * gamma,
                  M.adjugate() * gamma + D * mixed * gamma + D**2 * rolling.adjugate() * gamma))  # fmt: skip
    B = sp.Matrix(gibbs.contact_inertia())
    p.lemma(equal("∂G/∂u = (I + polar(u)) + D(|γ|² - γγᵀ)", gibbs.jacobian(), INERTIA + gibbs.polar(u) + D * rolling))
    p.lemma(equal("B(γ) = I + D(|γ|² - γγᵀ)", B, INERTIA + D * rolling))
    steps, (determinant, *rest) = gibbs.newton_heavy_steps()
    last = [(names, values) for names, values in steps if names in (gibbs.Y, gibbs.Z)]
    p.lemma(equal("the kernel divides ⟨Mᵀγ, Cᵀγ⟩ by |γ|²", sp.cancel(unrolled(last, sp.Matrix([determinant]))[0] * NORM),
                   (gamma.T * gibbs.M * gibbs.C.T * gamma)[0],
                   Quotient((*gibbs.M, *gibbs.C, *gamma), [])))  # fmt: skip
    others = gibbs.newton_steps()[1][1:]
    names = sorted(set().union(*(e.free_symbols for e in rest)), key=str)
    p.lemma(Equation("and the rest is that of `gibbs_newton`", rest, others, Quotient(names)))
    T = sp.Matrix(three.tangent_jacobian())
    p.lemma(equal("γᵀT(D) = γᵀT(0) for the tangent Jacobian", inertial(gamma.T * T), inertial(gamma.T * T.subs(D, 0))))
    p.control(equal("|γ|² det A = ⟨Mγ, adj(A)γ⟩", NORM * A.det(), ((M * gamma).T * adjugate * gamma)[0]))
    p.control(equal("T(D)γ = T(0)γ", inertial(T * gamma), inertial(T.subs(D, 0) * gamma)))
    p.control(equal("|γ|² det A = ⟨γ, M adj(M)γ⟩", NORM * A.det(), (gamma.T * M * M.adjugate() * gamma)[0]))


@claim(
    "stable-inverse",
    r"B(\gamma/|\gamma|)^{-1} = \Lambda^{-1} + \tfrac DF\Lambda^{-1}\gamma\gamma^T\Lambda^{-1}, \quad "
    r"F = \langle I\gamma, \Lambda^{-1}\gamma\rangle = |\gamma|^2 - D\langle\gamma, \Lambda^{-1}\gamma\rangle",
    uses=("2.5-inverse", "2.5"),
)
def stable_inverse(p: Proof) -> None:
    """ω and the energy by a sum in which only K can cancel: each entry of B⁻¹ is one product, or a sum of positive ones."""
    p.assume("I > 0, D ≥ 0, γ ≠ 0; for |γ| = 1 it is B(γ)⁻¹, otherwise that of the direction of γ")
    moments = [I1 + D, I2 + D, I3 + D]
    whole, Lam = sp.prod(moments), sp.diag(*moments)
    adjugate = Lam.adjugate()
    f = gamma.dot(INERTIA * adjugate * gamma)  # F det Λ
    inverse = f * adjugate + D * adjugate * gamma * gamma.T * adjugate  # times F (det Λ)²
    p.printed(equal("F det Λ = |γ|² det Λ - D⟨γ, adj(Λ)γ⟩", f, NORM * whole - D * gamma.dot(adjugate * gamma)),
              equal("(|γ|²Λ - Dγγᵀ)(F adj(Λ) det Λ + D adj(Λ)γγᵀadj(Λ)) = |γ|² F (det Λ)²",
                    (NORM * Lam - D * gamma * gamma.T) * inverse, NORM * f * whole * sp.eye(3)))  # fmt: skip
    B = sp.Matrix(gibbs.contact_inertia())
    p.lemma(equal("on |γ| = 1: B(γ) = Λ - Dγγᵀ", B, Lam - D * gamma * gamma.T, UNIT))
    p.lemma(equal("det B = F det Λ there", B.det(), f, UNIT))
    p.say(
        "F is a sum of positive terms; an entry i ≠ j is the product of D γᵢγⱼ and 1/(ΛᵢΛⱼF), one on the diagonal a sum",
        "of two positive terms.  So every entry has its digits, and ω has an error of a few roundings of |B⁻¹||K|: what",
        "a rounding of K does itself.  That is the condition of ω: |B⁻¹||K|/|ω|, up to Λmax/I_min for K across γ.",
    )
    across = [gamma[i] * gamma[j] if i != j else sp.S.One for i in range(3) for j in range(3)]
    p.lemma(equal("F det Λ is a polynomial in γ², I, D without a minus sign", f, without_minus(f)))
    p.lemma(equal("so is each entry of F (det Λ)² B⁻¹, but for the factor γᵢγⱼ", inverse,
                  [factor * without_minus(sp.cancel(entry / factor)) for factor, entry in zip(across, inverse, strict=True)]))  # fmt: skip
    p.lemma(_quotient("ω of the kernel", sp.Matrix(continuous.angular_velocity()), inverse * K, f * whole))
    p.lemma(_quotient("its energy", sp.Matrix([continuous.energy()]), K.T * inverse * K, 2 * f * whole))
    p.control(equal("F det Λ = det Λ - D⟨γ, adj(Λ)γ⟩ off |γ| = 1", f, whole - D * gamma.dot(adjugate * gamma)))
    p.control(Fact("|γ|² det Λ - D⟨γ, adj(Λ)γ⟩, term by term, without a minus sign",
                   _positive(NORM * whole) and _positive(-D * gamma.dot(adjugate * gamma))))  # fmt: skip
    p.control(equal("B⁻¹ with -D/F", (NORM * Lam - D * gamma * gamma.T) * (2 * f * adjugate - inverse),
                    NORM * f * whole * sp.eye(3)))  # fmt: skip


def without_minus(polynomial: sp.Expr) -> sp.Expr:
    """The expanded polynomial; raises ArithmeticError if a term has a minus sign."""
    if not _positive(polynomial):
        raise ArithmeticError(f"a term of {polynomial} has a minus sign")
    return sp.expand(polynomial)


def _positive(polynomial: sp.Expr) -> bool:
    return all(c > 0 for c in sp.Poly(sp.expand(polynomial), *gamma, I1, I2, I3, D).coeffs())


def _quotient(text: str, value: sp.Matrix, above: sp.Matrix, below: sp.Expr) -> Equation:
    """The equation value = above/below."""
    return Equation(text, inertial(value), above / below, UNTIED)


if __name__ == "__main__":
    main(__file__)
