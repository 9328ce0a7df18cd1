"""A gyrostat: the ball with a balanced rotor inside, for every n, from the same two principles.

The rotor adds ½ tr(AᵀRᵀṘ) to the Lagrangian, A skew and constant in the body, and ½ tr(AᵀR_kᵀR_{k+1}) to the discrete
Lagrangian.  For n = 3 these are ⟨a,ω⟩ and ⟨a,x⟩, x the vector of ½(Ω - Ωᵀ), the simplest function that is linear in Ω
and odd.  The other terms are in `motion` and `principle`.
"""

from functools import cache

import sympy as sp

from . import ball, continuous, limits, motion, three
from . import principle as space
from .derivation import coordinates, dual, rate, replaced, written
from .motion import eta, omega
from .quotient import Quotient
from .words import WordAlgebra, matrix_symbols

# The rotor's angular momentum (skew), its momentum per step, and the rate of η in the continuous principle.
A, step_A, xi = matrix_symbols("A A_step xi")
SKEW = {A: -A, step_A: -step_A, xi: -xi}

ALGEBRA = WordAlgebra({**motion.ALGEBRA.transposes, **SKEW}, motion.ALGEBRA.rules)
SPACE = WordAlgebra({**space.ALGEBRA.transposes, **SKEW}, space.ALGEBRA.rules)
FREE = WordAlgebra(SPACE.transposes)
STEP = WordAlgebra({**ball.ALGEBRA.transposes, **SKEW}, ball.ALGEBRA.rules)
BOTH = WordAlgebra({**ball.BOTH.transposes, **SKEW}, ball.BOTH.rules)

#: d/dt of the letters: the rotor is constant in the body.
RATES: dict[sp.Symbol, sp.Expr] = {**motion.RATES, A: sp.S.Zero, eta: xi}

#: The rotor's angular momentum in the axes of the body, for n = 3.
a1, a2, a3 = sp.symbols("a1:4")
rotor = sp.Matrix([a1, a2, a3])
RING = Quotient((*three.RING.symbols, *rotor), three.RING.relations)


def added_torque() -> sp.Symbol:
    """The term that the rotor adds to the principle of `motion.dalembert`.

    It is δ(½ tr(Aᵀω)) for δR = Rη, δω = η̇ + [ω,η], minus d/dt ½ tr(Aᵀη), whose integral is a boundary term.
    """
    term = written("rotor_term", "tr of it is ½ tr(Aᵀω), ⟨a,ω⟩ for n = 3", -A * omega / 2, ALGEBRA)
    variation = {A: sp.S.Zero, omega: xi + motion.commutator(omega, eta)}
    varied = rate("rotor_varied", "δR = Rη: δω = ξ + [ω,η], ξ = η̇", term, variation)
    ends = written("rotor_ends", "tr of it is ½ tr(Aᵀη)", -A * eta / 2, ALGEBRA)
    ended = rate("rotor_ended", "d/dt", ends, {A: sp.S.Zero, eta: xi})
    work = written("rotor_work", "tr of it is the work, up to a derivative", varied - ended, ALGEBRA)
    return dual("rotor_torque", "½ tr(η it) is that work", work, eta)


def eliminated() -> sp.Symbol:
    """The principle of the ball with the rotor; velocity and reaction are eliminated.  It vanishes on motions."""
    whole = motion.eliminated() + added_torque()
    return written("gyrostat_principle", "the ball's principle, and the rotor's part", whole, ALGEBRA)


def contact_momentum() -> sp.Symbol:
    """K about the contact point: K of the ball plus A′ with -½ tr(η A′) = ∂L/∂Ṙ · Rη for the rotor's term of L."""
    slope = written("rotor_impulse", "tr of it is ½ tr(Aᵀη), the rotor's ∂L/∂Ṙ · Rη", -A * eta / 2, ALGEBRA)
    impulse = -dual("rotor_impulse_dual", "½ tr(η it)", slope, eta)
    own = written("rotor_momentum", "∂L/∂Ṙ · Rη = -½ tr(η it)", impulse, ALGEBRA)
    return written("K_gyrostat", "that of the ball, and the rotor's", motion.contact_momentum() + own, ALGEBRA)


def discrete_term(a: sp.Expr, b: sp.Expr) -> sp.Expr:
    """The matrix whose trace is the rotor's term ½ tr(AᵀR_kᵀR_{k+1})."""
    return -step_A * SPACE.transpose(a) * b / 2


def rotor_balance() -> sp.Symbol:
    """The term that the rotor adds to `principle.momentum_balance`: the dual of its variation for dR = ξR."""
    path = discrete_term(space.R0, space.R) + discrete_term(space.R, space.R1)
    action = written("rotor_action", "tr of it is the rotor's part of 𝕃(k-1,k) + 𝕃(k,k+1)", path, FREE)
    still = dict.fromkeys((step_A, space.R0, space.R1), sp.S.Zero)
    increments = SPACE.with_transposes({**still, space.R: space.dR})
    varied = rate("rotor_variation", "for increments dR of R_k", action, increments)
    turn = SPACE.with_transposes({space.dR: space.xi * space.R})
    work = replaced("rotor_turned", "for dR = ξR", varied, turn, SPACE)
    return dual("rotor_balance", "it vanishes when the rotor's part does for every skew ξ", work, space.xi)


@cache
def split_balance() -> tuple[sp.Symbol, sp.Symbol]:
    """(𝒦_k, -Ωᵀ𝒦_{k-1}Ω) of the gyrostat, as `ball.split_balance` for the ball."""
    seen = space.RT * rotor_balance() * space.R
    whole = ball.body_balance() + seen
    balance = written("gyrostat_balance", "the ball's balance, and the rotor's, in the body", whole, SPACE)
    return ball.split(balance, "gyrostat", "_gyrostat", BOTH)


def momentum() -> sp.Symbol:
    """𝒦(Ω, Γ) of the gyrostat, as words in Ω, Ωᵀ, J, Γ, the rotor's A per step, and D."""
    return split_balance()[0]


#: Ω = exp(ε ω), and the rotor's momentum per step is εA.
TURNING = limits.Turning({**limits.STEP.start, step_A: sp.S.Zero}, {**limits.STEP.rates, step_A: A, A: sp.S.Zero})


def limit() -> limits.Remainder:
    """𝒦/ε of the gyrostat for every n."""
    return limits.expand_words(momentum(), TURNING)


@cache
def vector_momentum() -> sp.ImmutableMatrix:
    """𝒦(q, γ) for n = 3, a letter for each entry, with the rotor's angular momentum per step."""
    turn = sp.Matrix(three.rotation())
    places = three.BALL | {ball.Omega: turn, ball.OmegaT: turn.T, step_A: rotor.hat()}
    matrix = coordinates("gyrostat_matrix", "n = 3: Ω in Euler parameters, A = a×", momentum(), places, RING)
    return three.axial_entries("K_gyrostat", matrix)


def added_momentum() -> sp.Matrix:
    """The term that the rotor adds to 𝒦(q, γ): q₀²a + q₀ q × a - ⟨a,q⟩q."""
    return three.q0**2 * rotor + three.q0 * three.q.cross(rotor) - rotor.dot(three.q) * three.q


def relative(momentum: sp.Matrix = three.K) -> dict[sp.Symbol, sp.Expr]:
    """The substitution K ↦ K - a for the formulas of `continuous`, as B(γ)ω = K - a."""
    return three.placed((three.K, momentum - rotor))


def energy() -> sp.Expr:
    """½⟨K - a, ω⟩, the kinetic energy without that of the rotor, as a function of K, γ."""
    return continuous.energy().xreplace(relative())
