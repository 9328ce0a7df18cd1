"""The derivation in SymPy, step by step: the variational principle, the ball for every n, and three dimensions.

    >>> from chapsym import derive
    >>> derive.momentum()  # 𝒦(q, γ) of (5.2), in the symbols q0, q1, ..., g1, ..., J1, ..., D

Exported are the objects with an equation number in the paper; the other steps are in the modules of the sections.
"""

import sympy as sp

from . import ball, principle
from .continuous import angular_velocity, energy
from .continuous import momentum as angular_momentum
from .gibbs import residual as gibbs_residual
from .principle import discrete_constraint, lagrangian
from .quotient import Quotient
from .three import momentum, rotation
from .vertical import closed_rotation as vertical_rotation
from .words import WordAlgebra, evaluate, matrix_symbols, unfolded

__all__ = [
    "Quotient", "WordAlgebra", "angular_momentum", "angular_velocity", "discrete_constraint", "energy", "evaluate",
    "gibbs_residual", "lagrangian", "matrix_symbols", "momentum", "momentum_balance", "momentum_n", "rotation",
    "vertical_rotation",
]  # fmt: skip


def momentum_n() -> sp.Expr:
    """𝒦(Ω, Γ) of (4.13), as words in Ω, Ωᵀ, J, Γ and the scalar D."""
    return unfolded(ball.momentum())


def momentum_balance(factor: sp.Expr) -> sp.Expr:
    """The skew matrix that vanishes exactly when the principle holds; factor: the c of the Lagrangian (Section 4)."""
    return unfolded(principle.momentum_balance(factor))
