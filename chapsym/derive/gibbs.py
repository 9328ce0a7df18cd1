"""The step in the Gibbs vector u = q/q₀ = tan(θ/2)·axis: (5.2) becomes quadratic, and the rotation rational.

With k = 𝒦/2 and I = J₂ + J₃, ... the equation reads G(u) = B(γ)u + u × Iu - (1 + |u|²)k = 0.
Rotations by π have no Gibbs vector.
"""

from functools import cache

import sympy as sp

from . import three
from .three import J1, J2, J3, D, gamma, q, q0

u1, u2, u3 = sp.symbols("u1:4")
k1, k2, k3 = sp.symbols("k1:4")
d1, d2, d3 = sp.symbols("d1:4")
e = sp.Matrix(sp.symbols("e1:4"))
v1, v2, v3 = sp.symbols("v1:4")
I1, I2, I3 = sp.symbols("I1:4")

u = sp.Matrix([u1, u2, u3])
k = sp.Matrix([k1, k2, k3])
d = sp.Matrix([d1, d2, d3])
v = sp.Matrix([v1, v2, v3])

INERTIA = sp.diag(I1, I2, I3)

#: The mass tensor by the moments of inertia I₁ = J₂ + J₃, ...
BY_INERTIA = {J1: (I2 + I3 - I1) / 2, J2: (I1 + I3 - I2) / 2, J3: (I1 + I2 - I3) / 2}

#: Symbols for intermediate results: ∂G/∂u, Dγ, Dγγᵀ, the part of ∂G/∂u without D, the cofactors, a right side, Mᵀγ,
#: Cᵀγ, p × v or u × γ, Iu, the factor 2/|p|² or 1 + |u|².
A = sp.Matrix(3, 3, sp.symbols("a1:4(1:4)"))
W = sp.Matrix(sp.symbols("w1:4"))
E = sp.Matrix(3, 3, lambda i, j: sp.Symbol(f"e{min(i, j) + 1}{max(i, j) + 1}"))
M = sp.Matrix(3, 3, sp.symbols("m1:4(1:4)"))
C = sp.Matrix(3, 3, sp.symbols("c1:4(1:4)"))
R = sp.Matrix(sp.symbols("r1:4"))
Y = sp.Matrix(sp.symbols("y1:4"))
Z = sp.Matrix(sp.symbols("z1:4"))
ONCE = sp.Matrix(sp.symbols("x1:4"))
SPIN = sp.Matrix(sp.symbols("y1:4"))
SCALE = sp.Symbol("s")

#: A quaternion of any length: (det A, N) for the rotation with the Gibbs vector N/det A.
p0, p1, p2, p3 = sp.symbols("p0:4")
p = sp.Matrix([p1, p2, p3])

Steps = list[tuple[sp.Matrix, sp.Matrix]]


@cache
def residual() -> sp.ImmutableMatrix:
    """G(u) = (𝒦(q, γ) - 𝒦)/(2q₀²) for q = q₀u, q₀² = 1/(1 + |u|²): a polynomial without square roots."""
    values = {q0: 1, **dict(zip(q, u, strict=True))}
    momentum = sp.Matrix(three.momentum()).xreplace(values)
    whole = momentum - 2 * k * (1 + u.dot(u))
    return sp.ImmutableMatrix((whole / 2).applyfunc(lambda e: sp.expand(e.xreplace(BY_INERTIA))))


def residual_steps() -> tuple[Steps, sp.Matrix]:
    """G(u) in steps by u × γ: B(γ)u = Iu + Dγ × (u × γ)."""
    steps = [(ONCE, u.cross(gamma)), (SPIN, INERTIA * u), (sp.Matrix([SCALE]), sp.Matrix([1 + u.dot(u)]))]
    return steps, SPIN + D * gamma.cross(ONCE) + u.cross(SPIN) - SCALE * k


@cache
def contact_inertia() -> sp.ImmutableMatrix:
    """B(γ) in terms of the moments of inertia: I₁ + D(γ₂² + γ₃²), ... and -Dγ₁γ₂, ..."""
    return sp.ImmutableMatrix(sp.Matrix(three.contact_inertia()).xreplace(BY_INERTIA).applyfunc(three.by_parameters))


def bilinear(x: sp.Matrix) -> sp.Matrix:
    """x × Ix - |x|²k: the quadratic part of G at x, which is G after a Newton correction x."""
    return x.cross(INERTIA * x) - x.dot(x) * k


def polar(x: sp.Matrix) -> sp.Matrix:
    """The derivative of `bilinear` at x.

    Expanded, so that I₃ - I₂, ... are not rounded to constants: their fixed errors would let the energy drift.
    """
    return bilinear(x).jacobian(x).applyfunc(sp.expand)


def jacobian() -> sp.Matrix:
    """∂G/∂u = B + ∂(u × Iu - |u|²k)/∂u."""
    return sp.Matrix(contact_inertia()) + polar(u)


def symmetric_part() -> sp.Matrix:
    """½(∂G/∂u + its transpose), whose least eigenvalue is a lower bound for the singular values of ∂G/∂u."""
    a = jacobian()
    return ((a + a.T) / 2).applyfunc(sp.expand)


def symmetric() -> list[sp.Expr]:
    """The trace, the sum of the principal minors of size 2 and the determinant of `symmetric_part`."""
    s = symmetric_part()
    minors = [s.extract(pair, pair).det() for pair in ((0, 1), (0, 2), (1, 2))]
    return [s.trace(), sum(minors), s.det(method="berkowitz")]


def symmetric_steps() -> tuple[Steps, list[sp.Expr]]:
    """`symmetric` in steps, by the six entries of `symmetric_part`."""
    s = symmetric_part()
    upper = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)]
    minors = [E.extract(pair, pair).det() for pair in ((0, 1), (0, 2), (1, 2))]
    determinant = E[0, 0] * minors[2] + E[0, 1] * (E[0, 2] * E[1, 2] - E[0, 1] * E[2, 2])
    determinant += E[0, 2] * (E[0, 1] * E[1, 2] - E[0, 2] * E[1, 1])
    return [(sp.Matrix([E[i] for i in upper]), sp.Matrix([s[i] for i in upper]))], [E.trace(), sum(minors), determinant]


def newton_target() -> sp.Matrix:
    """(∂G/∂u)u - G(u) = u × Iu + (1 - |u|²)k, the Jacobian times the next Newton iterate."""
    return u.cross(INERTIA * u) + (1 - u.dot(u)) * k


def newton() -> list[sp.Expr]:
    """The next Newton iterate as a quaternion (det, N), u = N/det, and the cofactors of ∂G/∂u row by row."""
    cofactors = jacobian().cofactor_matrix()
    determinant = jacobian().det(method="berkowitz")
    return [determinant, *(cofactors.T * newton_target()), *cofactors]


def newton_steps() -> tuple[Steps, list[sp.Expr]]:
    """`newton` in steps, by Dγγᵀ and the rest of ∂G/∂u: terms that depend on γ are added last."""
    rolling = sp.eye(3) * E.trace() - E
    rolling = rolling.applyfunc(sp.expand)  # E₂₂ + E₃₃, ..., -E₁₂, ...: a sum of non-negative terms on the diagonal
    steps = [
        (W, D * gamma),
        (E, W * gamma.T),
        (R, newton_target()),
        (M, INERTIA + polar(u)),
        (A, M + rolling),
        (C, A.cofactor_matrix()),
    ]
    determinant = sum(A[0, j] * C[0, j] for j in range(3))
    return steps, [determinant, *(C.T * R), *C]


def newton_heavy_steps() -> tuple[Steps, list[sp.Expr]]:
    """`newton_steps` for D ≫ I: A = M + D(|γ|² - γγᵀ) has γᵀA = γᵀM, so |γ|² det A = ⟨Mᵀγ, adj(A)γ⟩ has no D³.

    In the expansion of det A ∝ D² by a row, terms of order D³ cancel, and only their rounding errors remain.
    """
    steps, (_, *rest) = newton_steps()
    more: Steps = [(Y, M.T * gamma), (Z, C.T * gamma)]
    return [*steps, *more], [Y.dot(Z) / gamma.dot(gamma), *rest]


def second() -> sp.Matrix:
    """Cᵀ(d × Id - |d|²k): the term that the second correction, after a Newton correction d, subtracts from N."""
    return C.T * bilinear(d)


def second_steps() -> tuple[Steps, sp.Matrix]:
    """`second` in steps, by G after the Newton correction."""
    return [(R, bilinear(d))], C.T * R


def mixed() -> sp.Matrix:
    """Cᵀ · `polar`(d) · e: the term subtracted from N for a correction e after d, with the cofactors before d."""
    return C.T * (polar(d) * e)


def mixed_steps() -> tuple[Steps, sp.Matrix]:
    """`mixed` in steps, by the factor of Cᵀ."""
    return [(R, d.cross(INERTIA * e) + e.cross(INERTIA * d) - 2 * d.dot(e) * k)], C.T * R


def turn() -> sp.Matrix:
    """Ωᵀv - v = 2/(p₀² + |p|²)·(p × (p × v) - p₀ p × v), for a quaternion (p₀, p) of any length."""
    once = p.cross(v)
    return (2 / (p0**2 + p.dot(p))) * (p.cross(once) - p0 * once)


def turn_steps() -> tuple[Steps, sp.Matrix]:
    """`turn` in steps, by p × v."""
    steps = [(sp.Matrix([SCALE]), sp.Matrix([2 / (p0**2 + p.dot(p))])), (ONCE, p.cross(v))]
    return steps, SCALE * (p.cross(ONCE) - p0 * ONCE)
