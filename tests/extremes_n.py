"""Steps in four dimensions at the extremes: the states, and what the oracle, the matrix equation in mpmath, says."""

from functools import cache

from chapsym.dynamics.oracle import Oracle
from research.extremes.judging import mp
from research.extremes.states import DIGITS, D, State, condition, scaled

#: States in four dimensions at which formulas lose digits, with the components of 𝒦 below the diagonal, row by row.
K4, G4, J4 = (0.3, -0.2, 0.5, 0.1, 0.4, -0.25), (0.1, 0.1, 0.7, 0.7), (1.0, 2.0, 0.5, 3.0)
AXIS4, PLANE4 = (0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 0.0, 0.4, 0.0, 0.0)
FOUR = {
    "generic": [State(J4, D, K4, G4)],
    **{f"momentum {size}": [State(J4, D, scaled(K4, float(size)), G4)] for size in ("1e-12", "1e-300", "5e-320")},
    "at rest": [State(J4, D, (0.0,) * 6, G4)],
    **{f"D = {D}": [State(J4, float(D), K4, G4)] for D in ("0", "1e6", "1e12")},
    "J equal": [State((1.0,) * 4, D, K4, G4)],
    "J 1e-15 apart": [State((1.0, 1 + 1e-15, 1 - 1e-15, 1.0), D, K4, G4)],
    "a flat body, one J = 0": [State((1.0, 0.0, 0.5, 3.0), D, K4, G4)],
    "ratios of 1e12": [State((1e-12, 1.0, 1e-6, 3.0), D, K4, G4)],
    "γ along an axis": [State(J4, D, K4, AXIS4)],
    "one plane only": [State(J4, D, PLANE4, G4), State(J4, D, PLANE4, AXIS4)],
    **{
        f"a body of size {size}": [State(scaled(J4, float(size)), 3 * float(size), scaled(K4, float(size)), G4)]
        for size in ("1e-150", "1e150")
    },
}


@cache
def truth_n(state):
    """In n dimensions: Ω - 1, 𝒦 and γ after the step, and κ with |Ω - 1| for |q|; ArithmeticError at a fold."""
    oracle = Oracle(state.J, state.D, state.g, DIGITS)
    step = oracle.step(state.K)
    moved = [mp.convert(x) for x in step.rotation - oracle.mp.eye(oracle.n)]
    kappa = condition(state, oracle, oracle.tangent(step.rotation), max(map(abs, moved)))
    momentum, gamma = ([mp.convert(x) for x in v] for v in (oracle.skew(step.momentum), step.gamma))
    return moved, momentum, gamma, kappa
