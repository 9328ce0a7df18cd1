"""Vertical momentum, 𝒦 = hγ (Section 5): the reduced map G_h on the sphere and its symmetric form."""

from collections.abc import Sequence
from functools import cache

import sympy as sp

from . import three
from .quotient import Quotient
from .three import J1, J2, J3, D, gamma, q, q0

h, sigma = sp.symbols("h sigma")

#: Named intermediate expressions in order, and the outputs in terms of these names.
Steps = list[tuple[Sequence[sp.Symbol], Sequence[sp.Expr]]]
Stepwise = tuple[Steps, Sequence[sp.Expr]]


@cache
def left_side() -> sp.ImmutableMatrix:
    """The left side of (5.4): the momentum for D = 0 and the mass tensor Ĵ = J + D/2."""
    shifted = {J1: J1 + D / 2, J2: J2 + D / 2, J3: J3 + D / 2}
    vector = sp.Matrix(three.momentum()).subs(D, 0).xreplace(shifted)
    return sp.ImmutableMatrix(vector.applyfunc(lambda e: sp.factor(sp.expand(e))))


@cache
def excess() -> sp.Expr:
    """The scalar x with (left side of 5.4) - 𝒦(q, γ) = x γ: then 𝒦 = hγ is equivalent to left side = (h + x)γ."""
    difference = sp.Matrix(left_side()) - sp.Matrix(three.momentum())
    along = three.RING.normal(gamma.dot(difference))
    if not all(three.RING.is_zero(e) for e in difference - along * gamma):
        raise ArithmeticError("the difference is not along gamma")
    return sp.factor(along)


@cache
def next_left_side() -> sp.ImmutableMatrix:
    """Ωᵀ (left side), for |q|² + q₀² = 1: the left side with opposite signs of the terms without q₀."""
    vector = sp.Matrix(three.rotation()).T * sp.Matrix(left_side())
    unit = Quotient((q0, *q, J1, J2, J3, D), [three.UNIT_QUATERNION])
    return sp.ImmutableMatrix(vector.applyfunc(unit.normal))


# For 𝒦 = hγ the state is (q, σ): γ = (left side)/σ, γ~ = Ωᵀγ, h = σ - excess.  |γ| = 1 is a relation between σ and q;
# the identities do not need it.

#: Q[q₀, q, J, D, σ] modulo |q|² + q₀² = 1.
RING = Quotient((sigma, q0, *q, J1, J2, J3, D), [three.UNIT_QUATERNION])


def gamma_now() -> sp.Matrix:
    """γ_k as a function of q, σ."""
    return sp.Matrix(left_side()) / sigma


def gamma_next() -> sp.Matrix:
    """γ_{k+1} = Ωᵀγ_k as a function of q, σ."""
    return sp.Matrix(next_left_side()) / sigma


def height() -> sp.Expr:
    """h as a function of q, σ."""
    return sigma - excess().xreplace(dict(zip(gamma, gamma_now(), strict=True)))


@cache
def total() -> sp.ImmutableMatrix:
    """γ + γ~."""
    return sp.ImmutableMatrix((gamma_now() + gamma_next()).applyfunc(sp.factor))


# The rotation in closed form.  With σ = 2t and ⟨γ, q⟩/q₀ = e/t the equation 𝒦 = hγ is linear in q/q₀.  There remain
# two scalar equations for t and e; the first depends on γ only by ⟨γ, Λ⁻¹γ⟩.

t, e, v, level = sp.symbols("t e v level")
INERTIA = sp.symbols("L1:4")
LAMBDA = sp.diag(*INERTIA)

#: Q[t, e, γ, Λ] modulo |γ|² = 1.
CLOSED = Quotient((t, e, *gamma, *INERTIA), [three.UNIT_VERTICAL])


@cache
def closed_matrix() -> sp.ImmutableMatrix:
    """Λ - e - t γ×: the matrix M of M q = tγ q₀, which is Λq + (q/q₀)×Λq = σ/(2q₀²) q₀γ solved for Λq."""
    return sp.ImmutableMatrix(LAMBDA - e * sp.eye(3) - t * gamma.hat())


@cache
def closed_rotation() -> sp.ImmutableMatrix:
    """(q₀, q) up to a factor: det M and t adj(M)γ, shortened by |γ| = 1."""
    p1, p2, p3 = (x - e for x in INERTIA)
    products, swapped = (p2 * p3, p3 * p1, p1 * p2), (gamma[1] * gamma[2], gamma[2] * gamma[0], gamma[0] * gamma[1])
    gaps = [INERTIA[(i + 1) % 3] - INERTIA[(i + 2) % 3] for i in range(3)]
    vector = [t * ((products[i] + t**2) * gamma[i] + t * gaps[i] * swapped[i]) for i in range(3)]
    scalar = p1 * p2 * p3 + t**2 * sum(p * g**2 for p, g in zip((p1, p2, p3), gamma, strict=True))
    whole = sp.Matrix([scalar, *vector])
    matrix = sp.Matrix(closed_matrix())
    derived = sp.Matrix([matrix.det(), *(t * matrix.adjugate() * gamma)])
    if not all(CLOSED.is_zero(x) for x in whole - derived):
        raise ArithmeticError("the short form is not that of det M and t adj(M) gamma")
    return sp.ImmutableMatrix(whole)


def weighted_square() -> sp.Expr:
    """⟨γ, adj(Λ)γ⟩ = det(Λ)⟨γ, Λ⁻¹γ⟩, the integral l of Proposition 3 without its denominators."""
    return gamma.dot(LAMBDA.adjugate() * gamma)


@cache
def level_residual() -> sp.Expr:
    """(q₀e - t⟨γ,q⟩)/t² of the closed rotation at e = v t²: a polynomial in v, t and `level` = ⟨γ, adj(Λ)γ⟩."""
    scalar, *vector = closed_rotation()
    balance = sp.expand(e * scalar - t * gamma.dot(sp.Matrix(vector)))
    p = [x - v * t**2 for x in INERTIA]
    trace = LAMBDA.trace()
    short = v * sp.prod(p) + (trace * v - 1 - 2 * v**2 * t**2) * t**2 - level
    difference = balance.subs(e, v * t**2) - t**2 * short.subs(level, weighted_square())
    ring = Quotient((t, v, *gamma, *INERTIA), [three.UNIT_VERTICAL])
    if not ring.is_zero(sp.expand(difference)):
        raise ArithmeticError("the balance along gamma is not a function of the level")
    return short


def level_newton() -> list[sp.Expr]:
    """The level residual and its derivative in v."""
    residual = level_residual()
    return [residual, sp.diff(residual, v)]


def level_steps() -> Stepwise:
    """`level_newton` in steps: s = t², m = e = v t², det(Λ - e) = c p₃, a = tr Λ - 2e, b the sum of minors plus 2s."""
    s, m, a, b, c = sp.symbols("s m a b c")
    p = sp.symbols("p1:4")
    steps: Steps = [
        ((s,), (t * t,)),
        ((m,), (v * s,)),
        (p, [x - m for x in INERTIA]),
        ((c, a), (p[0] * p[1], LAMBDA.trace() - 2 * m)),
        ((b,), (c + p[2] * (p[0] + p[1]) + 2 * s,)),
    ]
    whole = c * p[2] + s * a
    return steps, [v * whole - s - level, whole - m * b]
