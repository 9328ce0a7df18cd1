"""Continuum limits: what the discrete objects tend to, to which order, with which leading remainder.

The body rotation of one step is Ω = exp(ε ω) with ω skew, so Ωᵀ = exp(-ε ω).  In words (every n)
and in vectors (n = 3) the expansions are exact up to the order that is carried.
"""

from typing import NamedTuple

import sympy as sp

from . import ball, principle, three
from .quotient import Quotient
from .words import WordAlgebra, matrix_symbols

eps = sp.Symbol("epsilon")
w1, w2, w3 = sp.symbols("w1:4")
omega = sp.Matrix([w1, w2, w3])

#: Where the vector forms live: |γ| = 1, everything else free.
RING = Quotient((*omega, *three.gamma, *three.K, three.J1, three.J2, three.J3, three.D), [three.UNIT_VERTICAL])

#: Powers of ε carried; a remainder of a higher order than this is reported as not found.
CARRIED = 3

# The angular velocity in space: Ω̄ = R_{k+1} R_kᵀ = exp(ε ω̄).
omega_space = matrix_symbols("omega_s")[0]


class Remainder(NamedTuple):
    """expr = limit + ε^order · leading + O(ε^(order+1)), with `leading` not zero."""

    limit: sp.Expr
    order: int
    leading: sp.Expr


def exponential(generator: sp.Expr) -> sp.Expr:
    """exp(ε·generator) up to one order more than is carried, for a word or a matrix."""
    return sp.Add(*(eps**k * generator**k / sp.factorial(k) for k in range(CARRIED + 2)))


def expand_words(expr: sp.Expr, algebra: WordAlgebra) -> Remainder:
    """The limit, order and leading term of an expansion in words."""
    coefficients = [algebra.normal(sp.expand(expr).coeff(eps, k)) for k in range(-1, CARRIED + 1)]
    return _remainder(coefficients, lambda c: c == 0)


def expand_vector(expr: sp.Matrix) -> Remainder:
    """The limit, order and leading term of a vector of polynomials in ε (on |γ| = 1)."""
    expanded = expr.applyfunc(sp.expand)
    coefficients = [expanded.applyfunc(lambda e, k=k: RING.normal(e.coeff(eps, k))) for k in range(-1, CARRIED + 1)]
    return _remainder(coefficients, lambda c: c.is_zero_matrix)


def _remainder(coefficients: list, vanishes) -> Remainder:
    """From the coefficients of ε⁻¹, 1, ε, ...; the first must vanish, otherwise there is no limit."""
    if not vanishes(coefficients[0]):
        raise ArithmeticError(f"there is no limit: the expansion begins with ({coefficients[0]})/epsilon")
    for order, leading in enumerate(coefficients[2:], start=1):
        if not vanishes(leading):
            return Remainder(coefficients[1], order, leading)
    raise ArithmeticError(f"no remainder up to order {CARRIED}: the expansion may be exact")


def in_step(expr: sp.Expr) -> sp.Expr:
    """Words in Ω, Ωᵀ with Ω = exp(ε ω)."""
    return expr.xreplace({ball.Omega: exponential(ball.omega), ball.OmegaT: exponential(-ball.omega)})


def centre_momentum() -> Remainder:
    """M/ε for every n."""
    return expand_words(sp.expand(in_step(ball.centre_momentum()) / eps), ball.ALGEBRA)


def momentum() -> Remainder:
    """𝒦/ε for every n: the limit is the continuous momentum about the contact point (2.13)."""
    return expand_words(sp.expand(in_step(ball.momentum()) / eps), ball.ALGEBRA)


def transport(tensor: sp.Symbol) -> Remainder:
    """(Ωᵀ T Ω - T)/ε for every n: the limit is Ṫ of a tensor that is fixed in space (2.12)."""
    moved = exponential(-ball.omega) * tensor * exponential(ball.omega)
    return expand_words(sp.expand((moved - tensor) / eps), ball.ALGEBRA)


def constraint() -> Remainder:
    """(constraint (4.9) - Δr)/ε for every n: the limit is ρ ω̄ γ, the rotational part of (4.2)."""
    rotational = principle.discrete_constraint(principle.R, principle.R1, 0, 0)
    rotation, inverse = exponential(omega_space), exponential(-omega_space)
    words = principle.ALGEBRA.normal(rotational).xreplace(
        {principle.R1: rotation * principle.R, principle.R1T: principle.RT * inverse}
    )
    return expand_words(principle.ALGEBRA.normal(words) / eps, principle.ALGEBRA)


def euler_parameters() -> tuple[sp.Expr, sp.Matrix]:
    """q₀ = cos(ε|ω|/2) and q = sin(ε|ω|/2) ω/|ω|, up to the carried order; exact in ω."""
    square = omega.dot(omega) / 4 * eps**2
    terms = range(CARRIED // 2 + 2)
    cosine = sp.Add(*((-square) ** k / sp.factorial(2 * k) for k in terms))
    sinc = sp.Add(*((-square) ** k / sp.factorial(2 * k + 1) for k in terms))
    return cosine, sinc * eps / 2 * omega


def vector_parameters() -> tuple[Remainder, Remainder]:
    """q/ε and q₀ themselves."""
    scalar, vector = euler_parameters()
    return expand_vector(vector / eps), expand_vector(sp.Matrix([scalar]))


def vector_momentum() -> Remainder:
    """𝒦(q, γ)/ε for n = 3."""
    return expand_vector((_with_step(three.momentum()) / eps).applyfunc(sp.expand))


def vector_transport() -> Remainder:
    """(Ωᵀ x - x)/ε for n = 3 and a vector x (𝒦 or γ); the limit is x × ω."""
    return expand_vector(((_with_step(three.rotation()).T * three.K - three.K) / eps).applyfunc(sp.expand))


def _with_step(matrix: sp.ImmutableMatrix) -> sp.Matrix:
    """With the Euler parameters of the step."""
    scalar, vector = euler_parameters()
    return sp.Matrix(matrix).subs(three.placed(((three.q0, *three.q), (scalar, *vector))), simultaneous=True)
