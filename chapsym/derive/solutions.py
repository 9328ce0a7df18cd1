"""The number of rotations with a given momentum: (5.2) as homogeneous equations for q.

With the factor |q|² + q₀² of 𝒦 the three equations are quadrics in P³, where (q₀, q) and (-q₀, -q) are one point: one
rotation Ω.  A common point with q₀² + |q|² = 0 is no rotation, and is never real.
"""

from collections.abc import Sequence
from functools import cache

import sympy as sp

from . import ball, three
from .three import J1, J2, J3, D, K, g1, g2, g3, q, q0

POINT = (q0, *q)
NORM = q0**2 + q.dot(q)


def equations() -> list[sp.Expr]:
    """𝒦(q, γ) - 𝒦 (q₀² + |q|²), with the letters of the derivation of 𝒦(q, γ)."""
    return list(sp.Matrix(three.turned_entries("K", ball.momentum())) - K * NORM)


@cache
def quadrics() -> sp.ImmutableMatrix:
    """Half of the equations, expanded: homogeneous of degree 2 in (q₀, q)."""
    return sp.ImmutableMatrix(((sp.Matrix(three.momentum()) - K * NORM) / 2).applyfunc(sp.expand))


def after(
    mass_tensor: Sequence[int | str], contact: int | str, gamma: Sequence[int | str], turn: Sequence[int]
) -> tuple[list[sp.Rational], list[sp.Rational]]:
    """(Ωᵀ𝒦(q, γ), Ωᵀγ), the state after a step from a rational state; Ω is given by (q₀, q) of any length."""
    values = dict(zip(POINT, turn, strict=True))
    values |= dict(zip((J1, J2, J3, D, g1, g2, g3), map(sp.Rational, (*mass_tensor, contact, *gamma)), strict=True))
    length = sp.Integer(sum(c**2 for c in turn))
    rotation = sp.Matrix(three.rotation()).subs(values) / length
    momentum = sp.Matrix(three.momentum()).xreplace(values) / length
    return list(rotation.T * momentum), list(rotation.T * three.gamma.subs(values))
