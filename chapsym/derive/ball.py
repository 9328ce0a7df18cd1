"""The ball on E(n) in the body frame, for every n (Section 4): from the momentum balance to 𝒦.

The momentum is not typed in: it is the part of the balance, carried to the body frame with the
forces eliminated, that depends on R_{k+1}.
"""

from functools import cache

import sympy as sp

from . import principle as space
from .words import WordAlgebra, matrix_symbols

# One step: the body rotation Ω = Ω_{k-1} or Ω_k, the vertical γ = γ_{k-1} or γ_k, and Γ = γγᵀ.
Omega, OmegaT, J, Gamma, gamma, gammaT = matrix_symbols("Omega Omega^T J Gamma gamma gamma^T")
omega = matrix_symbols("omega")[0]
K = matrix_symbols("K")[0]
D = space.D

ALGEBRA = WordAlgebra(
    {Omega: OmegaT, OmegaT: Omega, J: J, Gamma: Gamma, gamma: gammaT, gammaT: gamma, K: -K},
    {(Omega, OmegaT): 1, (OmegaT, Omega): 1, (gamma, gammaT): Gamma},
)


def centre_momentum() -> sp.Expr:
    """M_k = Ω_k J - J Ω_kᵀ: the spatial momentum carried to the body frame at the time k."""
    carried = space.RT * space.spatial_momentum(space.R, space.R1) * space.R
    return _in_step_symbols(carried, at_start=True)


@cache
def body_balance() -> sp.Expr:
    """R_kᵀ (momentum balance) R_k with the forces eliminated by (4.9) and m = D/ρ²; it vanishes."""
    balance = space.on_constraint(space.momentum_balance(space.kinetic_factor()))
    carried = space.ALGEBRA.normal(space.RT * balance * space.R)
    return sp.expand(carried.subs(space.m, D / space.rho**2))


@cache
def split_balance() -> tuple[sp.Expr, sp.Expr]:
    """The parts of the body balance that belong to the step k and to the step k-1.

    Each is returned as words in its own Ω and in the γ of its own start: (𝒦_k, -Ωᵀ𝒦_{k-1}Ω).
    """
    now, before = sp.S.Zero, sp.S.Zero
    for term in sp.Add.make_args(body_balance()):
        if term.has(space.R1, space.R1T):
            now += term
        else:
            before += term
    return _in_step_symbols(now, at_start=True), _in_step_symbols(before, at_start=False)


def momentum() -> sp.Expr:
    """𝒦(Ω, Γ) of (4.13), as words in Ω, Ωᵀ, J, Γ and the scalar D."""
    return split_balance()[0]


def carried(expr: sp.Expr) -> sp.Expr:
    """Ωᵀ expr Ω: what a tensor that is fixed in space looks like in the body, one step later."""
    return ALGEBRA.normal(OmegaT * expr * Omega)


def _in_step_symbols(expr: sp.Expr, at_start: bool) -> sp.Expr:
    """Rewrites words in R_{k-1}, R_k, R_{k+1} and the spatial γ with the symbols of one step.

    `at_start`: the step begins at k, so R_{k+1} = R_k Ω.  Otherwise it ends there: R_k = R_{k-1} Ω.
    """
    if at_start:
        places = {space.R1: space.R * Omega, space.R1T: OmegaT * space.RT}
        places |= {space.gamma: space.R * gamma, space.gammaT: gammaT * space.RT}
    else:
        places = {space.R: space.R0 * Omega, space.RT: OmegaT * space.R0T}
        places |= {space.gamma: space.R0 * gamma, space.gammaT: gammaT * space.R0T}
    replaced = space.ALGEBRA.normal(expr).xreplace({**places, space.J: J})
    both = WordAlgebra(
        {**ALGEBRA.transposes, **space.ALGEBRA.transposes},
        {**ALGEBRA.rules, **space.ALGEBRA.rules},
    )
    return both.normal(replaced)
