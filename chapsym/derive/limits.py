"""Continuum limits of the discrete objects: the limit, the order and the leading remainder.

The body rotation of one step is Ω = exp(ε ω) with ω skew, so Ωᵀ = exp(-ε ω) and dΩ/dε = Ωω.  In words (every n)
and in vectors (n = 3) the expansions are exact up to the order CARRIED.
"""

from typing import NamedTuple

import sympy as sp

from . import ball, principle, three
from .derivation import STEPS, coordinates, rate, replaced, written
from .quotient import Quotient
from .words import unfolded

w1, w2, w3 = sp.symbols("w1:4")
omega = sp.Matrix([w1, w2, w3])

#: The ring of the vector forms: |γ| = 1, all other variables free.
RING = Quotient((*omega, *three.gamma, *three.K, three.J1, three.J2, three.J3, three.D), [three.UNIT_VERTICAL])

#: The highest order of a remainder that is computed; beyond it, an error is raised.
CARRIED = 3

# The angular velocity in space: Ω̄ = R_{k+1} R_kᵀ = exp(ε ω̄).
omega_space = principle.omega_space


class Remainder(NamedTuple):
    """expr = limit + ε^order · leading + O(ε^(order+1)), with `leading` not zero."""

    limit: sp.Expr
    order: int
    leading: sp.Expr
    #: The coefficient of ε⁻¹; it vanishes, so that the limit exists.
    constant: sp.Expr


class Turning(NamedTuple):
    """The values at ε = 0 of the letters of a rotation exp(ε ω), and their derivatives in ε."""

    start: dict[sp.Symbol, sp.Expr]
    rates: dict[sp.Symbol, sp.Expr]


#: Ω = exp(ε ω) in the body, and R_{k+1} = exp(ε ω̄) R_k in space.
STEP = Turning(
    ball.ALGEBRA.with_transposes({ball.Omega: sp.S.One}),
    ball.ALGEBRA.with_transposes({ball.Omega: ball.Omega * ball.omega})
    | dict.fromkeys((ball.omega, ball.J, ball.K, ball.Gamma, ball.gamma, ball.gammaT), sp.S.Zero),
)
SPACE_STEP = Turning(
    principle.ALGEBRA.with_transposes({principle.R1: principle.R}),
    principle.ALGEBRA.with_transposes({principle.R1: omega_space * principle.R1})
    | dict.fromkeys((omega_space, principle.R, principle.RT, principle.gamma, principle.gammaT), sp.S.Zero),
)


def coefficients(of: sp.Symbol, turning: Turning) -> list[sp.Symbol]:
    """Letters for the Taylor coefficients of 1, ε, ε², ... of a defined letter."""
    found, name = [], of
    for k in range(CARRIED + 2):
        at = replaced(f"{name}_{k}_at", "at ε = 0", of, turning.start, STEPS[of].algebra)
        found.append(written(f"{name}_{k}", f"the coefficient of ε^{k}", at / sp.factorial(k), STEPS[of].algebra))
        of = rate(f"{name}_{k}_rate", "its derivative by ε", of, turning.rates)
    return found


def expand_words(of: sp.Symbol, turning: Turning) -> Remainder:
    """The limit, order and leading term of (a defined letter)/ε, as letters."""
    return remainder(coefficients(of, turning), lambda c: unfolded(c) == 0)


def remainder(coefficients: list, vanishes) -> Remainder:
    """The remainder from the coefficients of ε⁻¹, 1, ε, ...; the first must vanish, otherwise there is no limit."""
    if not vanishes(coefficients[0]):
        raise ArithmeticError(f"there is no limit: the expansion begins with ({coefficients[0]})/epsilon")
    for order, leading in enumerate(coefficients[2:], start=1):
        if not vanishes(leading):
            return Remainder(coefficients[1], order, leading, coefficients[0])
    raise ArithmeticError(f"no remainder up to order {CARRIED}: the expansion may be exact")


def centre_momentum() -> Remainder:
    """The limit and remainder of M/ε for every n."""
    return expand_words(ball.centre_momentum(), STEP)


def momentum() -> Remainder:
    """𝒦/ε for every n: the limit is the continuous momentum about the contact point (2.13)."""
    return expand_words(ball.momentum(), STEP)


def transport(name: str, tensor: sp.Expr) -> Remainder:
    """(Ωᵀ T Ω - T)/ε for every n: the limit is Ṫ of a tensor that is fixed in space (2.12)."""
    moved = written(f"moved_{name}", f"Ωᵀ {name} Ω - {name}", ball.carried(tensor) - tensor, ball.ALGEBRA)
    return expand_words(moved, STEP)


def constraint() -> Remainder:
    """(constraint (4.9) - Δr)/ε for every n: the limit is ρ ω̄ γ, the rotational part of (4.2)."""
    return expand_words(principle.turning_step(), SPACE_STEP)


def in_vectors(name: str, of: Remainder) -> Remainder:
    """A remainder for n = 3: its skew matrices as vectors of letters for their entries."""
    places = three.BALL | {ball.omega: omega.hat(), ball.K: three.K.hat()}

    def vector(name: str, letter: sp.Expr) -> sp.Matrix:
        text = "n = 3: ω, 𝒦 and γ as vectors, J = diag(J₁, J₂, J₃)"
        used = {x: at for x, at in places.items() if not x.is_commutative or unfolded(letter).has(x)}
        return three.axial_entries(name, coordinates(f"{name}_matrix", text, letter, used, RING))

    return Remainder(vector(f"{name}_limit", of.limit), of.order, vector(f"{name}_leading", of.leading), of.constant)
