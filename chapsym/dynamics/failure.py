"""Why a step was not taken."""

import numpy as np

from chapsym.generated import momentum as momentum_kernel

from .ball import Floats, inertia_of
from .errors import Status


def explain(status: int, K: Floats, g: Floats, J: Floats, D: float) -> Status:
    """Why a step was not taken: UNREACHABLE if no rotation at all has this momentum."""
    rounded = status == Status.NO_INERTIA and (g * g * inertia_of(J)).sum() > 0.0  # it has some, but beside D it is not
    if rounded or status in (Status.FOLDED, Status.NOT_CONVERGED):
        # Scaled so that Λmax is below 1: then no rotation has a component above 2, and nothing overflows.
        shift = -int(np.frexp(J.sum() + D)[1])
        with np.errstate(over="ignore"):
            k = np.clip(np.ldexp(K, shift), -4.0, 4.0)
        if np.abs(k).max() == 4.0:
            return Status.UNREACHABLE
        if rounded:
            return Status.NOT_CONVERGED
        if k.any():
            most = largest_momentum(k, g, np.ldexp(J, shift), float(np.ldexp(D, shift)))
            if np.linalg.norm(k) > most * (1 + 1e-12):
                return Status.UNREACHABLE
    return Status(int(status))


def largest_momentum(direction: Floats, g: Floats, J: Floats, D: float) -> float:
    """The largest component of 𝒦(q, γ) along `direction` over all rotations.

    ⟨n, 𝒦(q, γ)⟩ is a quadratic form in the four Euler parameters: its largest eigenvalue.
    """
    n = direction / np.abs(direction).max()
    n /= np.sqrt(n @ n)

    def form(p: Floats) -> float:
        return float(n @ np.array(momentum_kernel(*(*p, *g, *J, D))))

    basis = np.eye(4)
    matrix = np.array([[(form(a + b) - form(a - b)) / 4 for b in basis] for a in basis])
    return float(np.linalg.eigvalsh(matrix)[-1])
