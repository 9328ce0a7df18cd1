"""The errors, each with one sentence for the user, and the reasons why a step was not taken."""

from enum import IntEnum
from typing import Any

import numpy as np

from chapsym.generated import momentum as momentum_kernel

from .loops.branch import moments


class BadInput(ValueError):
    """The input is wrong or has no answer; the message names the argument and what would be right.

    Examples
    --------
    >>> import chapsym
    >>> chapsym.Ball((1, 2, 4), -3)
    Traceback (most recent call last):
    chapsym.dynamics.errors.BadInput: D = m ρ² must not be negative, but it is -3
    """


class LimitReached(BadInput):
    """There is no result at the limit in seconds; the message says what was reached."""


class Status(IntEnum):
    """How a step ended, for each ball of a batch.

    Attributes
    ----------
    TAKEN : int
        The step was taken.
    FOLDED : int
        The small-rotation branch folds before it reaches the momentum.
    NOT_CONVERGED : int
        Rounding hides the rotation: the moments and D are too far apart, or the state is at a fold.
    UNREACHABLE : int
        No rotation of the ball has the momentum at this γ.
    NO_INERTIA : int
        The ball has no inertia about the vertical at this γ: all its mass lies on that axis.

    Examples
    --------
    >>> import chapsym
    >>> momenta = [(1, -0.5, 0.75), (5, -2.5, 3.75), (20, -10, 15)]
    >>> after = chapsym.step(chapsym.Ball((1, 2, 4), 3), momenta, (2 / 7, 3 / 7, 6 / 7))
    >>> [chapsym.Status(status).name for status in after.status]
    ['TAKEN', 'FOLDED', 'UNREACHABLE']
    >>> chapsym.Status.FOLDED.sentence
    'the small-rotation branch folds before it reaches this momentum; take a shorter time step'
    """

    TAKEN = 0
    FOLDED = 1
    NOT_CONVERGED = 2
    UNREACHABLE = 3
    NO_INERTIA = 4

    @property
    def sentence(self) -> str:
        """The text for the user."""
        return _SENTENCES[self]


_SENTENCES = {
    Status.TAKEN: "the step was taken",
    Status.FOLDED: "the small-rotation branch folds before it reaches this momentum; take a shorter time step",
    Status.NOT_CONVERGED: "rounding hides the rotation: the moments and D are too far apart, or the state is at a fold",
    Status.UNREACHABLE: "no rotation of this ball has this momentum at this gamma; take a shorter time step",
    Status.NO_INERTIA: "the ball has no inertia about the vertical at this gamma (all its mass lies on that axis)",
}


class TooWide(ArithmeticError):
    """The balls are too wide to prove a step: more bits are needed."""


class StepNotTaken(ArithmeticError):
    """A step of one ball that cannot be taken.

    Attributes
    ----------
    status : Status
        Why it cannot be taken.
    reach : float
        The fraction of the momentum that the branch attains.
    index : int or None
        The index of the step in a trajectory (0 is the first).
    trajectory : Trajectory or None
        The states before it, if there are any.

    Examples
    --------
    >>> import chapsym
    >>> try:
    ...     chapsym.step(chapsym.Ball((1, 2, 4), 3), (5, -2.5, 3.75), (2 / 7, 3 / 7, 6 / 7))
    ... except chapsym.StepNotTaken as error:
    ...     error.status.name, round(error.reach, 5)
    ('FOLDED', 0.86464)
    """

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self.status, self.reach, self.index, self.trajectory)

    def __init__(self, status: Status, reach: float, index: int | None = None, trajectory: Any = None) -> None:
        self.status, self.reach, self.index, self.trajectory = status, reach, index, trajectory
        where = "" if index is None else f"step {index}: "
        attained = f"{reach:.6g}" if reach < 0.99999 else f"all but {max(1 - reach, 1e-16):.2g}"
        extent = f" (it attains {attained} of it)" if status is Status.FOLDED else ""
        super().__init__(f"{where}{status.sentence}{extent}")


@np.errstate(over="ignore", under="ignore")
def explain(status: int, K: np.ndarray, g: np.ndarray, J: np.ndarray, D: float) -> Status:
    """Why a step was not taken: UNREACHABLE if no rotation at all has this momentum."""
    inertia = np.array(moments(J))
    rounded = status == Status.NO_INERTIA and (g * g * inertia).sum() > 0.0  # its inertia is lost in the rounding of D
    if rounded or status in (Status.FOLDED, Status.NOT_CONVERGED):
        # Scaled to Λmax below 1: then no rotation has a component above 2, and nothing overflows.
        shift = -int(np.frexp(J.sum() + D)[1])
        k = np.clip(np.ldexp(K, shift), -4.0, 4.0)
        if np.abs(k).max() == 4.0:
            return Status.UNREACHABLE
        if rounded:
            return Status.NOT_CONVERGED
        if k.any() and np.isfinite(k).all():  # a momentum below float64 has no direction
            most = largest_momentum(k, g, np.ldexp(J, shift), float(np.ldexp(D, shift)))
            if np.linalg.norm(k) > most * (1 + 1e-12):
                return Status.UNREACHABLE
    return Status(int(status))


def largest_momentum(direction: np.ndarray, g: np.ndarray, J: np.ndarray, D: float) -> float:
    """The maximum over all rotations of the component of 𝒦(q, γ) along `direction`.

    ⟨n, 𝒦(q, γ)⟩ is a quadratic form in the four Euler parameters: its largest eigenvalue.
    """
    n = direction / np.abs(direction).max()
    n /= np.sqrt(n @ n)

    def form(p: np.ndarray) -> float:
        return float(n @ np.array(momentum_kernel(*(*p, *g, *J, D))))

    basis = np.eye(4)
    matrix = np.array([[(form(a + b) - form(a - b)) / 4 for b in basis] for a in basis])
    return float(np.linalg.eigvalsh(matrix)[-1])
