"""The ball in three dimensions (Section 5): rotations by Euler parameters and the vector 𝒦(q, γ)."""

from collections.abc import Iterable
from functools import cache
from typing import Any

import sympy as sp

from . import ball
from .derivation import coordinates, entry
from .quotient import Quotient
from .words import DEFINED

q0, q1, q2, q3 = sp.symbols("q0:4")
g1, g2, g3 = sp.symbols("g1:4")
J1, J2, J3, D = sp.symbols("J1 J2 J3 D")
K1, K2, K3 = sp.symbols("K1:4")

q = sp.Matrix([q1, q2, q3])
gamma = sp.Matrix([g1, g2, g3])
K = sp.Matrix([K1, K2, K3])
J = sp.diag(J1, J2, J3)

MASSES = (J1, J2, J3)

#: The values for n = 3 of the letters of the words.
BALL = {ball.J: J, ball.D: D, ball.gamma: gamma, ball.gammaT: gamma.T, ball.Gamma: gamma * gamma.T}

#: The moments of inertia are positive: then Λ is regular and F > 0, for D ≥ 0 (2.13).
MOMENTS = (J2 + J3 > 0, J1 + J3 > 0, J1 + J2 > 0, D >= 0)

UNIT_QUATERNION = q0**2 + q.dot(q) - 1
UNIT_VERTICAL = gamma.dot(gamma) - 1

#: The conditions that the Euler parameters and the vertical are unit.
UNITS = (sp.Eq(UNIT_QUATERNION, 0), sp.Eq(UNIT_VERTICAL, 0))

#: The ring of 𝒦(q, γ): the Euler parameters and the vertical are unit; J and D are free.
RING = Quotient((q0, q1, q2, q3, g1, g2, g3, J1, J2, J3, D), [UNIT_QUATERNION, UNIT_VERTICAL])


def axial(a: sp.Matrix) -> sp.Matrix:
    """The vector (A₃₂, A₁₃, A₂₁) of a skew matrix, as in Section 5; the inverse of SymPy's `hat`."""
    return sp.Matrix([a[2, 1], a[0, 2], a[1, 0]])


def determinant(m: sp.Matrix) -> sp.Expr:
    """The determinant of a 3 × 3 matrix as the triple product of its rows, without simplification."""
    return m[0, :].dot(m[1, :].cross(m[2, :]))


def quaternion_product(a: sp.Matrix, b: sp.Matrix) -> sp.Matrix:
    """The quaternion product of (scalar, vector) columns."""
    a0, av, b0, bv = a[0], a[1:, :], b[0], b[1:, :]
    vector = a0 * bv + b0 * av + av.cross(bv)
    return sp.Matrix([a0 * b0 - av.dot(bv), *vector])


@cache
def rotation() -> sp.ImmutableMatrix:
    """The matrix Ω of x ↦ q x q̄ in Euler parameters, homogeneous of degree 2."""
    quaternion, conjugate = sp.Matrix([q0, *q]), sp.Matrix([q0, *(-q)])
    columns = [
        quaternion_product(quaternion_product(quaternion, sp.Matrix([0, *e])), conjugate)[1:, :]
        for e in sp.eye(3).columnspace()
    ]
    return sp.ImmutableMatrix(sp.Matrix.hstack(*columns).applyfunc(sp.expand))


@cache
def momentum_matrix() -> sp.ImmutableMatrix:
    """(4.13) for the rotation Ω of the Euler parameters, as a skew 3×3 matrix."""
    return DEFINED[_turned(ball.momentum())]


@cache
def turned_entries(name: str, of: sp.Symbol) -> sp.ImmutableMatrix:
    """Letters for the axial vector of skew words at the rotation of the Euler parameters."""
    return axial_entries(name, _turned(of))


def _turned(of: sp.Symbol) -> sp.Symbol:
    turn = ball.ALGEBRA.with_transposes({ball.Omega: sp.Matrix(rotation())})
    return coordinates(f"{of}_matrix", "n = 3: Ω in Euler parameters, J = diag(J₁, J₂, J₃)", of, BALL | turn, RING)


def axial_entries(name: str, skew: sp.Symbol) -> sp.ImmutableMatrix:
    """Letters for the axial vector (A₃₂, A₁₃, A₂₁) of a named skew matrix."""
    places = ((2, 1), (0, 2), (1, 0))
    return sp.ImmutableMatrix([entry(f"{name}_{i}", "by (A₃₂, A₁₃, A₂₁)", skew, *at) for i, at in enumerate(places, 1)])


@cache
def contact_inertia() -> sp.ImmutableMatrix:
    """B(γ) = ½ ∂²𝒦/∂q₀∂q, which is Λ - Dγγᵀ on |γ| = 1: the inertia about the contact point.

    From (4.13) without |γ| = 1: so the diagonal is a sum of non-negative terms,
    J₂ + J₃ + D(γ₂² + γ₃²), without cancellation for large D.
    """
    mixed = sp.Matrix(axial(momentum_matrix())).jacobian(q).diff(q0) / 2
    return sp.ImmutableMatrix(mixed.applyfunc(by_parameters))


@cache
def momentum() -> sp.ImmutableMatrix:
    """𝒦(q, γ) of (5.2): the axial vector of (4.13), collected as 2 q₀ B(γ) q + 2 q × Jq-terms."""
    rows = sp.Matrix(contact_inertia()) * q
    whole = axial(momentum_matrix())
    rest = (whole - 2 * q0 * rows).applyfunc(lambda e: by_parameters(sp.expand(e)))
    return sp.ImmutableMatrix(2 * (q0 * rows + rest / 2))


def by_parameters(expr: sp.Expr) -> sp.Expr:
    """A polynomial in the form (a combination of the Jᵢ)·monomial + D·(...), factored."""
    inertial, contact = sp.expand(expr.subs(D, 0)), sp.expand(expr).coeff(D, 1)
    return sp.factor(inertial) + D * sp.factor(contact)


def lam() -> sp.Matrix:
    """Λ = diag(J₂ + J₃ + D, ...) = B(γ) + Dγγᵀ on the unit sphere."""
    whole = (sp.Matrix(contact_inertia()) + D * gamma * gamma.T).applyfunc(RING.normal)
    if not whole.is_diagonal():
        raise ArithmeticError("the inertia about the contact point is not a diagonal matrix less D gamma gamma^T")
    return whole


#: Symbols for intermediate results of 𝒦: x × γ, and D(x × γ).
SLIP = sp.Matrix(sp.symbols("c1:4"))
DRAG = sp.Matrix(sp.symbols("f1:4"))

Steps = list[tuple[sp.Matrix, sp.Matrix]]


def placed(*pairs: tuple[Iterable[sp.Symbol], Iterable[Any]]) -> dict[sp.Symbol, Any]:
    """The expressions that replace the entries of each vector of symbols."""
    return {symbol: value for symbols, values in pairs for symbol, value in zip(symbols, values, strict=True)}


def unrolled(steps: Steps, value: sp.Matrix) -> sp.Matrix:
    """The result of steps, expressed by their inputs alone."""
    for names, expressions in reversed(steps):
        value = value.xreplace(placed((names, expressions)))
    return value


def carried_steps(x: sp.Matrix) -> tuple[Steps, sp.Matrix]:
    """B(γ)x = Ix + γ × D(x × γ) in steps.

    A rounding error of x × γ changes the result orthogonally to γ, where B is large: it is equivalent to one of x.
    For D ≫ J, the product by the entries of B has rounding errors ∝ D in ⟨γ, B x⟩ = ⟨γ, Ix⟩.
    """
    central = sp.diag(J2 + J3, J1 + J3, J1 + J2)
    return [(SLIP, x.cross(gamma)), (DRAG, D * SLIP)], central * x + gamma.cross(DRAG)


def momentum_steps() -> tuple[Steps, sp.Matrix]:
    """𝒦(q, γ) in steps, by B(γ)q of `carried_steps`, which is accurate in the vertical component."""
    steps, carried = carried_steps(q)
    gyroscopic = sp.Matrix(momentum()).subs(q0, 0)
    return steps, 2 * (q0 * carried + gyroscopic / 2)


def residual_steps() -> tuple[Steps, sp.Matrix]:
    """𝒦(q, γ) - 𝒦 in the steps of `momentum_steps`."""
    steps, value = momentum_steps()
    return steps, value - K


@cache
def momentum_jacobian() -> sp.ImmutableMatrix:
    """∂𝒦/∂q (3×3) in the chart q₀ = √(1 - |q|²), where ∂q₀/∂q = -qᵀ/q₀."""
    vector = sp.Matrix(momentum())
    return sp.ImmutableMatrix(vector.jacobian(q) - vector.diff(q0) * q.T / q0)


@cache
def tangent_jacobian() -> sp.ImmutableMatrix:
    """The derivative of 𝒦 along q ∘ (0, w), w ∈ R³: rotations of the body; regular for every Ω.

    Row i, column j: the change of 𝒦ᵢ when q becomes q ∘ (1, w eⱼ), per unit of w.
    """
    gradient = sp.Matrix(momentum()).jacobian(sp.Matrix([q0, *q]))
    return sp.ImmutableMatrix(gradient * sp.Matrix.hstack(*body_directions()))


@cache
def tangent_hessian() -> sp.ImmutableMatrix:
    """The second derivative of 𝒦(q ∘ (1, w)) in w, which is constant: 6 rows 11, 22, 33, 23, 13, 12.

    𝒦(q ∘ (1, w)) = 𝒦(q) + T w + ½ Σ Hᵢⱼ wᵢ wⱼ exactly, as 𝒦 is homogeneous of degree 2.
    """
    directions = body_directions()
    second = [sp.hessian(entry, [q0, *q]) for entry in momentum()]
    pairs = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    rows = [[(directions[i].T * h * directions[j])[0] for h in second] for i, j in pairs]
    return sp.ImmutableMatrix(sp.Matrix(rows).applyfunc(by_parameters))


def body_directions() -> list[sp.Matrix]:
    """q ∘ (0, eᵢ): the directions of the three rotations about the body's axes."""
    return [quaternion_product(sp.Matrix([q0, *q]), sp.Matrix([0, *e])) for e in sp.eye(3).columnspace()]


def rotation_offset() -> sp.Matrix:
    """Ω - 1 for unit Euler parameters, with 1 written as q₀² + |q|²: small for a small rotation."""
    whole = sp.Matrix(rotation()) - (q0**2 + q.dot(q)) * sp.eye(3)
    return whole.applyfunc(lambda e: sp.factor(sp.expand(e)))


def rotated(x: sp.Matrix) -> sp.Matrix:
    """Ωx = x + (Ω - 1)x: a vector of the body frame at k+1, in the body frame at k."""
    return x + rotation_offset() * x


def transported(x: sp.Matrix) -> sp.Matrix:
    """Ωᵀx = x + (Ω - 1)ᵀx: a vector fixed in space, one step later (5.3)."""
    return x + rotation_offset().T * x


def centre_step() -> sp.Matrix:
    """Δr/ρ in the body frame at time k, from the discrete constraint (4.9), for γ upwards.

    (4.9) with γ from the centre to the plane is Δr = -(ρ/2)(Ω - Ωᵀ)γ in the body frame; see claim 2.1.
    """
    om = sp.Matrix(rotation())
    upwards = -gamma
    return (-(om - om.T) / 2 * upwards).applyfunc(lambda e: sp.factor(sp.expand(e)))
