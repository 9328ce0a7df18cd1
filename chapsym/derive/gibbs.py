"""The step in the Gibbs vector u = q/q₀ = tan(θ/2)·axis: (5.2) becomes quadratic, and the rotation rational.

With k = 𝒦/2 and I = J₂ + J₃, ... the equation reads G(u) = B(γ)u + u × Iu - (1 + |u|²)k = 0.
Rotations by π have no Gibbs vector.
"""

from functools import cache

import sympy as sp

from . import three
from .three import J1, J2, J3, q, q0

u1, u2, u3 = sp.symbols("u1:4")
k1, k2, k3 = sp.symbols("k1:4")
d1, d2, d3 = sp.symbols("d1:4")
v1, v2, v3 = sp.symbols("v1:4")
I1, I2, I3 = sp.symbols("I1:4")

u = sp.Matrix([u1, u2, u3])
k = sp.Matrix([k1, k2, k3])
d = sp.Matrix([d1, d2, d3])
v = sp.Matrix([v1, v2, v3])

INERTIA = sp.diag(I1, I2, I3)

#: The mass tensor by the moments of inertia I₁ = J₂ + J₃, ...
BY_INERTIA = {J1: (I2 + I3 - I1) / 2, J2: (I1 + I3 - I2) / 2, J3: (I1 + I2 - I3) / 2}

#: Names of what is computed before the solve: ∂G/∂u, B, the cofactors, G, 1/det, 1 + |u|²; u × v; and the inverse as an input.
A = sp.Matrix(3, 3, sp.symbols("a1:4(1:4)"))
B = sp.Matrix(3, 3, lambda i, j: sp.Symbol(f"b{min(i, j) + 1}{max(i, j) + 1}"))
C = sp.Matrix(3, 3, sp.symbols("c1:4(1:4)"))
R = sp.Matrix(sp.symbols("r1:4"))
ONCE = sp.Matrix(sp.symbols("p1:4"))
SCALE, NORM = sp.symbols("s n")
INVERSE = sp.Matrix(3, 3, sp.symbols("i1:4(1:4)"))


@cache
def residual() -> sp.ImmutableMatrix:
    """G(u) = (𝒦(q, γ) - 𝒦)/(2q₀²) for q = q₀u, q₀² = 1/(1 + |u|²): no root is left."""
    values = {q0: 1, **dict(zip(q, u, strict=True))}
    momentum = sp.Matrix(three.momentum()).subs(values, simultaneous=True)
    whole = momentum - 2 * k * (1 + u.dot(u))
    return sp.ImmutableMatrix((whole / 2).applyfunc(lambda e: sp.expand(e.subs(BY_INERTIA, simultaneous=True))))


@cache
def contact_inertia() -> sp.ImmutableMatrix:
    """B(γ) with the moments of inertia: I₁ + D(γ₂² + γ₃²), ... and -Dγ₁γ₂, ..."""
    return sp.ImmutableMatrix(
        sp.Matrix(three.contact_inertia()).subs(BY_INERTIA, simultaneous=True).applyfunc(three.by_parameters)
    )


def bilinear(x: sp.Matrix) -> sp.Matrix:
    """x × Ix - |x|²k: what is quadratic in G, at x; so what a Newton correction x leaves of G."""
    return x.cross(INERTIA * x) - x.dot(x) * k


def polar(x: sp.Matrix) -> sp.Matrix:
    """The derivative of `bilinear` at x."""
    whole = bilinear(x).jacobian(x)
    return whole.applyfunc(lambda e: sum(s * sp.expand(e).coeff(s) for s in x))


def residual_steps() -> tuple[list[tuple[sp.Matrix, sp.Matrix]], sp.Matrix]:
    """G by 1 + |u|² and the entries of B."""
    steps = [(sp.Matrix([NORM]), sp.Matrix([1 + u.dot(u)])), (B, sp.Matrix(contact_inertia()))]
    return steps, B * u + u.cross(INERTIA * u) - NORM * k


def solve_steps() -> list[tuple[sp.Matrix, sp.Matrix]]:
    """1 + |u|², B, G, ∂G/∂u, its cofactors and 1/det, in this order: each uses those before it."""
    determinant = sum(A[0, j] * C[0, j] for j in range(3))
    steps, value = residual_steps()
    return [
        *steps,
        (R, value),
        (A, B + polar(u)),
        (C, A.cofactor_matrix()),
        (sp.Matrix([SCALE]), sp.Matrix([1 / determinant])),
    ]


@cache
def jacobian() -> sp.ImmutableMatrix:
    """∂G/∂u."""
    return sp.ImmutableMatrix(sp.Matrix(residual()).jacobian(u))


def flat_inverse() -> sp.Matrix:
    """(∂G/∂u)⁻¹ in the inputs alone."""
    return sp.Matrix(jacobian()).adjugate() / sp.Matrix(jacobian()).det(method="berkowitz")


def newton() -> sp.Matrix:
    """The Newton correction -(∂G/∂u)⁻¹ G by the names of `solve_steps`."""
    return -SCALE * (C.T * R)


def inverse() -> sp.Matrix:
    """(∂G/∂u)⁻¹ by the names of `solve_steps`."""
    return SCALE * C.T


def second_correction() -> sp.Matrix:
    """What is to be added to a Newton correction d: -(∂G/∂u)⁻¹(d × Id - |d|²k), with the same inverse."""
    return -INVERSE * bilinear(d)


def second_correction_steps() -> tuple[list[tuple[sp.Matrix, sp.Matrix]], sp.Matrix]:
    """The same by what the Newton correction leaves of G."""
    return [(R, bilinear(d))], -INVERSE * R


def increment() -> sp.Matrix:
    """Ωᵀv - v = 2/(1 + |u|²)·(u × (u × v) - u × v)."""
    once = u.cross(v)
    return (2 / (1 + u.dot(u))) * (u.cross(once) - once)


def increment_steps() -> tuple[list[tuple[sp.Matrix, sp.Matrix]], sp.Matrix]:
    """The same by u × v."""
    steps = [(sp.Matrix([SCALE]), sp.Matrix([2 / (1 + u.dot(u))])), (ONCE, u.cross(v))]
    return steps, SCALE * (u.cross(ONCE) - ONCE)
