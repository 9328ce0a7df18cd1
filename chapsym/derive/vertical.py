"""Vertical momentum, 𝒦 = hγ (Section 5): the reduced map G_h on the sphere and its symmetric form."""

from functools import cache

import sympy as sp

from . import three
from .quotient import Quotient
from .three import J1, J2, J3, D, gamma, q, q0

h, sigma = sp.symbols("h sigma")


@cache
def left_side() -> sp.ImmutableMatrix:
    """The left side of (5.4): the momentum of a ball with Ĵ = J + D/2 that does not roll."""
    shifted = {J1: J1 + D / 2, J2: J2 + D / 2, J3: J3 + D / 2}
    vector = sp.Matrix(three.momentum()).subs(D, 0).subs(shifted, simultaneous=True)
    return sp.ImmutableMatrix(vector.applyfunc(lambda e: sp.factor(sp.expand(e))))


@cache
def excess() -> sp.Expr:
    """The scalar x with (left side of 5.4) - 𝒦(q, γ) = x γ: then 𝒦 = hγ reads left = (h + x)γ."""
    difference = sp.Matrix(left_side()) - sp.Matrix(three.momentum())
    along = three.RING.normal(gamma.dot(difference))
    if not all(three.RING.is_zero(e) for e in difference - along * gamma):
        raise ArithmeticError("the difference is not along gamma")
    return sp.factor(along)


@cache
def next_left_side() -> sp.ImmutableMatrix:
    """Ωᵀ (left side), with |q|² + q₀² = 1: the left side with q in the place of -q, but for q₀q."""
    vector = sp.Matrix(three.rotation()).T * sp.Matrix(left_side())
    unit = Quotient((q0, *q, J1, J2, J3, D), [three.UNIT_QUATERNION])
    return sp.ImmutableMatrix(vector.applyfunc(unit.normal))


# On 𝒦 = hγ the state is (q, σ): γ = left/σ, γ~ = Ωᵀγ, h = σ - (excess).  That |γ| = 1 ties σ to q
# is part of a state, but none of the identities needs it.

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
    return sigma - excess().subs(dict(zip(gamma, gamma_now(), strict=True)), simultaneous=True)


def lam() -> sp.Matrix:
    """Λ."""
    return three.lam()


def total() -> sp.Matrix:
    """γ + γ~."""
    return (gamma_now() + gamma_next()).applyfunc(sp.factor)
