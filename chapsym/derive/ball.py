"""The ball on E(n) in the body frame, for every n (Section 4): from the momentum balance to 𝒦.

The momentum is derived, not entered: it is the part that depends on R_{k+1} of the balance in the body frame, with the
forces eliminated.
"""

from functools import cache

import sympy as sp

from . import principle as space
from .derivation import replaced, terms, written
from .words import WordAlgebra, matrix_symbols

# One step: the body rotation Ω = Ω_{k-1} or Ω_k, the vertical γ = γ_{k-1} or γ_k, and Γ = γγᵀ.
Omega, OmegaT, J, Gamma, gamma, gammaT = matrix_symbols("Omega Omega^T J Gamma gamma gamma^T")
omega = matrix_symbols("omega")[0]
K = matrix_symbols("K")[0]
D = space.D

ALGEBRA = WordAlgebra(
    {Omega: OmegaT, J: J, Gamma: Gamma, gamma: gammaT, K: -K, omega: -omega},
    {(Omega, OmegaT): 1, (OmegaT, Omega): 1, (gamma, gammaT): Gamma},
)


def centre_momentum() -> sp.Symbol:
    """M_k = Ω_k J - J Ω_kᵀ: the spatial momentum, transformed to the body frame at time k."""
    momentum = space.spatial_momentum(space.R, space.R1)
    spatial = written("m_k", "R_{k+1} J R_kᵀ - R_k J R_{k+1}ᵀ", momentum, space.ALGEBRA)
    carried = written("m_k_body", "R_kᵀ m_k R_k", space.RT * spatial * space.R, space.ALGEBRA)
    return in_step_symbols("M_k", carried, at_start=True)


def body_balance() -> sp.Symbol:
    """R_kᵀ (momentum balance) R_k with the forces eliminated by (4.9) and m = D/ρ²; it vanishes."""
    balance = space.momentum_balance(space.kinetic_factor())
    closed = space.on_constraint("closed", "on the discrete constraint", balance, {space.m: D / space.rho**2})
    return written("body_balance", "seen in the body: R_kᵀ S R_k", space.RT * closed * space.R, space.ALGEBRA)


@cache
def split_balance() -> tuple[sp.Symbol, sp.Symbol]:
    """The parts of the body balance from step k and from step k-1: (𝒦_k, -Ωᵀ𝒦_{k-1}Ω)."""
    return split(body_balance(), "part", "", BOTH)


def split(balance: sp.Symbol, name: str, suffix: str, algebra: WordAlgebra) -> tuple[sp.Symbol, sp.Symbol]:
    """The parts of a body balance from step k and step k-1, each as words in the Ω and the initial γ of its step."""
    later = (space.R1, space.R1T)
    now = terms(f"{name}_now", "its terms with R_{k+1}", balance, later)
    before = terms(f"{name}_before", "its terms without R_{k+1}", balance, later, having=False)
    own = in_step_symbols(f"momentum{suffix}", now, True, algebra)
    return own, in_step_symbols(f"before{suffix}", before, False, algebra)


def momentum_in_space(now: bool) -> sp.Symbol:
    """𝒦_k or 𝒦_{k-1}: `momentum()` expressed by attitudes."""
    text = f"by Ω = R_{{{'k' if now else 'k-1'}}}ᵀR_{{{'k+1' if now else 'k'}}} and γ = Rᵀγ⃗"
    return replaced(f"momentum_{'k' if now else 'before'}", text, momentum(), in_attitudes(now), BOTH)


def in_attitudes(now: bool) -> dict[sp.Symbol, sp.Expr]:
    """Ω = R_kᵀR_{k+1} or R_{k-1}ᵀR_k, and γ = Rᵀγ⃗ at the start of the step."""
    back, end = (space.RT, space.R1) if now else (space.R0T, space.R)
    vertical = back * space.gamma
    return BOTH.with_transposes({Omega: back * end, gamma: vertical, Gamma: vertical * BOTH.transpose(vertical)})


def momentum() -> sp.Symbol:
    """𝒦(Ω, Γ) of (4.13), as words in Ω, Ωᵀ, J, Γ and the scalar D."""
    return split_balance()[0]


def carried(expr: sp.Expr) -> sp.Expr:
    """Ωᵀ expr Ω: a tensor that is fixed in space, in the body frame one step later."""
    return OmegaT * expr * Omega


#: The algebra in which attitudes are replaced by Ω, and the reverse.
BOTH = WordAlgebra({**ALGEBRA.transposes, **space.ALGEBRA.transposes}, {**ALGEBRA.rules, **space.ALGEBRA.rules})


def in_step_symbols(name: str, of: sp.Symbol, at_start: bool, algebra: WordAlgebra = BOTH) -> sp.Symbol:
    """Words in R_{k-1}, R_k, R_{k+1} and the spatial γ, rewritten in the symbols of one step.

    `at_start`: the step begins at k, so R_{k+1} = R_k Ω.  Otherwise it ends there: R_k = R_{k-1} Ω.
    """
    if at_start:
        text, start, end = "by R_{k+1} = R_k Ω and γ⃗ = R_k γ", space.R, space.R1
    else:
        text, start, end = "by R_k = R_{k-1} Ω and γ⃗ = R_{k-1} γ", space.R0, space.R
    places = BOTH.with_transposes({end: start * Omega, space.gamma: start * gamma})
    return replaced(name, text, of, places, algebra)
