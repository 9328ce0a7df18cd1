"""Section 2: the inertia operator of the continuous ball for every n, the invariant measure, and n = 3."""

import itertools
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import sympy as sp

from chapsym.derive import continuous, derivation, motion, three
from chapsym.derive.limits import omega as spin
from chapsym.derive.motion import ALGEBRA, D, Gamma, J, K, alpha, commutator, eta, gamma, gammaT, omega, rate
from chapsym.derive.quotient import Quotient
from chapsym.derive.words import Traces, WordAlgebra, evaluate, matrix_symbols
from chapsym.proofs import second_routes
from chapsym.proofs.paper.s2_every_n import motion_symbols
from chapsym.proofs.second_routes import Array
from chapsym.prove import Comparison, Equation, Identity, Proof, claim, equations, main, rational_point
from chapsym.prove.polynomials import parameters

POSITIVE = "J_i + J_j > 0 for i ≠ j, D ≥ 0"


equation = equations(ALGEBRA)
TRACES = Traces(ALGEBRA)


def applied(x: sp.Expr) -> sp.Expr:
    """𝒜x = Jx + xJ + D(Γx + xΓ), as in (2.13)."""
    return J * x + x * J + D * (Gamma * x + x * Gamma)


def pairing(x: sp.Expr, y: sp.Expr) -> sp.Expr:
    """The matrix whose trace is ⟨x, y⟩ = -½ tr(xy)."""
    return -x * y / 2


@claim(
    "2.13",
    r"\mathbf K = J\omega+\omega J+D(\Gamma\omega+\omega\Gamma),\ \mathbf K \text{ in } so^*(m):\ "
    r"\mathcal A\omega \ne 0,\ \text{the operator } \mathcal A \text{ from } \omega \text{ to } \mathbf K \text{ is nondegenerate}",
    ["2.12"],
)
def inertia_operator(p: Proof) -> None:
    """The momentum about the contact point; its operator is nondegenerate when any two J_i have a positive sum."""
    p.infers(
        "A form that is positive for each ω ≠ 0 has an operator without a kernel; the sum for n = 5 is that for every n."
    )
    p.slips("reading")
    p.say("K is the momentum about the point of contact P: M about the centre C, and mv ∧ (C - P) with C - P = -ργ and")
    p.say("v = -ρωγ; it is in so*(n), not so*(m).")
    p.reads(
        motion_symbols(),
        (r"\mathbf K", motion.contact_momentum(), "M about C and mv∧(C - P), about the point of contact P"),
        (r"\mathcal A\omega", applied(omega), "Jω + ωJ + D(Γω + ωΓ), for any ω"),
    )
    p.printed(equation("K = Jω + ωJ + D(Γω + ωΓ)", applied(omega), motion.contact_momentum()))
    p.say("⟨ω, 𝒜ω⟩ for every n, and entry by entry (n = 5: the sum over i, j is symmetric for every n):")
    size, mass = 5, sp.symbols("J1:6")
    entries = {(i, j): sp.Symbol(f"x{i}{j}") for i, j in itertools.combinations(range(size), 2)}
    matrix = sp.Matrix(size, size, lambda i, j: entries.get((i, j), -entries.get((j, i), 0)))
    ring = Quotient((*entries.values(), *mass))
    squares = sum((mass[i] + mass[j]) * x**2 for (i, j), x in entries.items())
    central = -(matrix * (sp.diag(*mass) * matrix + matrix * sp.diag(*mass))).trace() / 2
    p.lemma(Equation("-½ tr(ω(Jω + ωJ)) = Σ_{i<j} (J_i + J_j) ω_ij²", central, squares, ring))
    slip = omega * gamma
    form = -omega * J * omega + D * slip * ALGEBRA.transpose(slip)
    kernel, values = sp.Matrix([[0, 0, 0], [0, 0, -1], [0, 1, 0]]), {J: sp.diag(1, 0, 0), Gamma: sp.diag(1, 0, 0)}
    place = {**values, D: sp.S.One, omega: kernel}
    p.lemma(
        Comparison("𝒜ω = 0 for ω = e2∧e3 at J = (1,0,0), γ = e1", [sp.Eq(applied(omega), 0), sp.Ne(omega, 0)], place)
    )
    text = "𝒜 has no kernel, whatever the constant diagonal J: 𝒜ω ≠ 0 for this ω"
    p.printed(Comparison(text, [sp.Ne(applied(omega), 0)], place))
    p.under(
        POSITIVE,
        equation(
            "⟨ω,𝒜ω⟩ = -tr(ωJω) + D|ωγ|² = Σ (J_i+J_j)ω_ij² + D|ωγ|² > 0", pairing(omega, applied(omega)), form, TRACES
        ),
    )
    p.say("J ≥ 0 alone is not enough: all mass on a line through the centre does not resist a turn about it.")
    p.control(equation("⟨ω,𝒜ω⟩ = -tr(ωJω) - D|ωγ|²", pairing(omega, applied(omega)), form.subs(D, -D), TRACES))
    wrong = sum(mass[i] * x**2 for (i, _), x in entries.items())
    p.control(Equation("-½ tr(ω(Jω + ωJ)) = Σ_{i<j} J_i ω_ij²", central, wrong, ring))


@claim("2.15-measure", r"\mu = \sqrt{\det\mathcal A} \text{ is the density of an invariant measure } \mu\,d\omega\wedge d\gamma",
       ["2.12", "2.13"])  # fmt: skip
def invariant_measure(p: Proof) -> None:
    """√(det 𝒜) is the density of an invariant measure, for every n."""
    p.infers(
        "Jacobi's formula for the derivative of a determinant, and Liouville's theorem: a density ν with ν̇ + ν div = 0 is invariant."
    )
    p.assume("𝒜 is nondegenerate (2.13)")
    p.say("In the variables (K, γ) the density is ν = (det 𝒜)^(-1/2), as dK = det 𝒜 dω at fixed γ; γ̇ = -ωγ, K̇ = [K,ω].")
    p.say("ν is invariant when div = ½ tr(𝒜⁻¹𝒜̇), by Jacobi's formula for the derivative of a determinant.")
    p.lemma(*traces_of_maps())
    p.say(
        "So tr(S∘T) depends only on the quadratic form ⟨X,TX⟩, X in so(n); S is 1 or 𝒜⁻¹.  The parts of the divergence:"
    )
    X = eta
    p.lemma(equation("𝒜 is symmetric: ⟨X,𝒜K⟩ = ⟨𝒜X,K⟩", pairing(X, applied(K)), pairing(applied(X), K), TRACES))
    p.lemma(equation("∂K̇/∂K at fixed ω: ⟨X,[X,ω]⟩ = 0", pairing(X, commutator(X, omega)), 0, TRACES))
    p.lemma(equation("∂K̇/∂K through ω = 𝒜⁻¹K: ⟨X,[K,X]⟩ = 0", pairing(X, commutator(K, X)), 0, TRACES))
    v, vT = motion.v, motion.vT
    p.say("∂γ̇/∂γ: -tr ω = 0, and the trace of v ↦ -(∂_v ω)γ, where ∂_v ω = -𝒜⁻¹Tv:")
    free = WordAlgebra(ALGEBRA.transposes)  # γ need not stay a unit vector
    operator = derivation.written("A_omega", "𝒜ω", applied(omega), free)
    rates = {J: sp.S.Zero, omega: alpha, Gamma: v * gammaT + gamma * vT}
    varied = derivation.rate("A_omega_varied", "its variation, δω = α and δγ = v", operator, rates)
    turned = gained(v * gammaT + gamma * vT)
    p.lemma(Equation("0 = δK = 𝒜δω + Tv for δγ = v, Tv = D{vγᵀ + γvᵀ, ω}", varied, applied(alpha) + turned, free))
    p.say("-(∂_v ω)γ is -Uᵀ(∂_v ω), where Uᵀ takes X to Xγ and Uv = v∧γ; so the trace is tr(Uᵀ𝒜⁻¹T) = tr(𝒜⁻¹TUᵀ):")
    p.lemma(equation("⟨X, Uv⟩ = vᵀXγ", pairing(X, ALGEBRA.wedge(v, gamma)), vT * X * gamma, TRACES))
    vertical = X * Gamma - Gamma * X
    upright = X * gamma
    columns = upright * gammaT + gamma * ALGEBRA.transpose(upright)
    p.lemma(equation("TUᵀX = T(Xγ) = D{XΓ - ΓX, ω}", gained(columns), gained(vertical)))
    p.say("For ½𝒜̇ the form is ½D⟨X, {Γ̇, X}⟩.")
    divergence = pairing(gained(vertical), X)
    moved = rate(Gamma)

    def half_rate(sign: int = 1) -> sp.Expr:
        return sign * D / 2 * pairing(X, moved * X + X * moved)

    p.printed(equation("div and ½ tr(𝒜⁻¹𝒜̇) have the same form, so ν is invariant", divergence, half_rate(), TRACES))
    p.route(
        "in coordinates, n = 3, 4: div + ½ tr(𝒜⁻¹𝒜̇) is the trace of 𝒜⁻¹(x ↦ [𝒜x,ω] + Sx), so of x ↦ [x,ω] + 𝒜⁻¹Sx",
        *(statement for size in (3, 4) for statement in exact_divergence(size)),
    )
    p.control(equation("the same for (det 𝒜)^(+1/2) dK", divergence, half_rate(-1), TRACES))
    p.control(replace(exact_divergence(4, rates=2)[2], text="n = 4: S is skew with 𝒜̇ in the place of ½𝒜̇"))


def gained(moved: sp.Expr) -> sp.Expr:
    """D{moved, ω}: the change of 𝒜ω if Γ changes by `moved`."""
    return D * (moved * omega + omega * moved)


def traces_of_maps() -> list[Equation]:
    """Traces of linear maps between spaces of any dimensions, as matrices in orthonormal bases."""
    S, T, TT, U, UT = matrix_symbols("S T T^T U U^T")
    square, other = sp.Matrix(2, 2, [1, 2, 0, 3]), sp.Matrix(2, 2, [0, 1, 5, 1])
    example = {S: sp.Matrix(2, 2, [1, 1, 1, 4]), T: square, TT: square.T, U: other, UT: other.T}
    same = equations(Traces(WordAlgebra({S: S, T: TT, TT: T, U: UT, UT: U}, {}, example)))
    return [same("tr(ST) = tr(S(T + Tᵀ)/2) for a symmetric S", S * T, S * (T + TT) / 2),
            same("tr(UᵀST) = tr(STUᵀ)", UT * S * T, S * T * UT)]  # fmt: skip


def exact_divergence(n: int, rates: int = 1) -> list[Identity]:
    """The statement that div + rates·½ tr(𝒜⁻¹𝒜̇) = 0 for the equations in (ω, γ), in coordinates.

    𝒜ω̇ = [K,ω] - 𝒜̇ω, where 𝒜̇ depends on ω by Γ̇ = [Γ,ω]: its derivative is x ↦ [𝒜x,ω] + Sx - rates·½𝒜̇x.
    """
    places = [*itertools.combinations(range(n), 2)]
    names = [f"w{i}" for i in range(len(places))] + [f"{kind}{i}" for kind in "gJ" for i in range(n)]
    *free, D = parameters(" ".join([*names, "D"]))
    turning, vertical = second_routes.skew(free[: -2 * n], n), second_routes.array(free[-2 * n : -n])
    tensor, mass = np.outer(vertical, vertical), np.diag(second_routes.array(free[-n:]))

    def bracket(x: Array, y: Array) -> Array:
        return x @ y - y @ x

    def operator(x: Array, whole: Any) -> Array:
        return whole @ x + x @ whole

    def matrix_of(linear: Callable[[Array], Array]) -> Array:
        units = [second_routes.skew([int(place == other) for other in places], n) for place in places]
        return second_routes.array([[linear(x)[place] for x in units] for place in places])

    inertia = mass + D * tensor
    momentum, rate = operator(turning, inertia), D * bracket(tensor, turning)
    whole = matrix_of(
        lambda x: bracket(momentum, x) - operator(x, rate) - operator(turning, D * bracket(tensor, x))
        + rates * operator(x, rate) / 2
    )  # fmt: skip
    symmetric, skew = matrix_of(lambda x: operator(x, inertia)), matrix_of(lambda x: bracket(x, turning))
    return [
        second_routes.identity(f"n = {n}: 𝒜 is symmetric", symmetric, symmetric.T),
        second_routes.identity(f"n = {n}: x ↦ [x,ω] is skew", skew, -skew.T),
        second_routes.identity(f"n = {n}: S is skew", whole, -whole.T),
    ]


@claim(
    "2.15-so3",
    r"\omega_{ij} = \varepsilon_{ijk}\omega_k,\ \mathbf K_{ij} = \varepsilon_{ijk}K_k:\ "
    r"\text{(2.14), (2.15) and the measure become (2.4) and (2.6)}",
    ["2.12", "2.15", "2.15-measure", "2.3"],
)
def isomorphism(p: Proof) -> None:
    """The identification of so(3) with R³ has the wrong sign, and the energy becomes l/2."""
    p.infers("The integrals and the measure of (2.14) and (2.15) are even in the sign of the identification.")
    p.slips("convention")
    p.assume("n = 3: the J of (2.1) to (2.6) is tr J - J for the J of (2.10), so that Λ = diag(J2+J3+D, ...)")
    ring = Quotient((*three.K, *spin, *three.gamma, three.J1, three.J2, three.J3, three.D), [three.UNIT_VERTICAL])
    vertical = three.gamma * three.gamma.T

    def carried(sign: int) -> list[Equation]:
        """(2.12) under A = sign·(v×), as vector equations for n = 3."""
        turn, tensor = sign * spin.hat(), sign * three.K.hat()
        swept = -(turn * tensor - tensor * turn)
        name = f"ω_ij = {'-' * (sign > 0)}ε_ijk ω_k"
        return [
            Equation(f"{name}: K̇ = -[ω,K] is K̇ = K×ω", swept, sign * three.K.cross(spin).hat(), ring),
            Equation(f"{name}: γ̇ = -ωγ is γ̇ = γ×ω", -turn * three.gamma, three.gamma.cross(spin), ring),
        ]

    momentum = sp.Matrix(continuous.momentum())
    values = {motion.J: three.J, motion.Gamma: vertical, motion.D: three.D, motion.omega: spin.hat()}
    energy = -(spin.hat() * evaluate(motion.contact_momentum(), values)).trace() / 4
    p.say("The matrix A of a vector v with which (2.12) is (2.3) has Ax = v×x:")
    p.lemma(*carried(1))
    p.control(*carried(-1))
    letters = {r"\omega_": (spin, r"\omega_k", "ω"), r"\mathbf K_": (three.K, "K_k", "K")}
    p.reads({"H": (energy, "-¼ tr(ω𝒜ω) (2.15)"), "l": (momentum.dot(spin), "⟨K,ω⟩ (2.4)")})
    for matrix, (vector, index, name) in letters.items():
        whole = -vector.hat()
        p.reads(
            (f"{matrix}{{ij}}", vector.hat(), f"the matrix of the vector {name} with which (2.12) is (2.3)"),
            (rf"\varepsilon_{{ijk}}{index}", whole, f"Σ_k ε_ijk {name}_k: in row 1, column 2 it is {name}_3"),
        )
        p.printed(Equation(f"{name}_ij = ε_ijk {name}_k", vector.hat(), whole, ring))
    p.printed(Equation("H of (2.15) is l of (2.4)", energy, momentum.dot(spin), ring))
    p.corrected(
        r"\omega_{ij} = -\varepsilon_{ijk}\omega_k,\ \mathbf K_{ij} = -\varepsilon_{ijk}K_k,\ H = \tfrac12l",
        Equation("H of (2.15) is ½ l", energy, momentum.dot(spin) / 2, ring),
    )
    tensor = three.K.hat()
    height = three.K.dot(three.gamma)
    p.say("The integrals and the measure are even in the sign of the identification:")
    p.lemma(Equation("tr K² = -2⟨K,K⟩", (tensor**2).trace(), -2 * three.K.dot(three.K), ring))
    p.lemma(Equation("tr K²Γ = ⟨K,γ⟩² - ⟨K,K⟩", (tensor**2 * vertical).trace(), height**2 - three.K.dot(three.K), ring))
    determinant = sp.Matrix(three.contact_inertia()).det()
    density = three.lam().det() * continuous.rolling_factor()
    p.lemma(Equation("det 𝒜 = det Λ · F: the density of (2.6) but for a constant", determinant, density, ring))
    point = dict(zip((*spin, *three.gamma, *three.K), (1, 0, 1, 1, 0, 0, 6, 0, 11), strict=True))
    point |= {three.J1: 1, three.J2: 2, three.J3: 4, three.D: 8}
    unit = Equation("|γ| = 1", three.gamma.dot(three.gamma), 1, ring)
    state = Equation("K = Λω - D⟨ω,γ⟩γ", three.K, momentum, ring)
    p.counterexample(rational_point(point, [unit, state]))
    p.control(
        Equation("tr K²Γ = ⟨K,γ⟩² + ⟨K,K⟩", (tensor**2 * vertical).trace(), height**2 + three.K.dot(three.K), ring)
    )
    p.control(Equation("det 𝒜 = det Λ", determinant, three.lam().det(), ring))


if __name__ == "__main__":
    main(__file__)
