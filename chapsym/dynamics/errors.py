"""What can go wrong, each with one sentence for the user."""

from enum import IntEnum
from typing import Any


class BadInput(ValueError):
    """The input has no answer: what was wrong, where, and what would be right."""


class Status(IntEnum):
    """How a step ended, for each ball of a batch."""

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
    Status.NOT_CONVERGED: "float64 cannot resolve the rotation: D is too large beside J, or the state is at a fold",
    Status.UNREACHABLE: "no rotation of this ball has this momentum at this gamma; take a shorter time step",
    Status.NO_INERTIA: "the ball has no inertia about the vertical at this gamma (all its mass lies on that axis)",
}


class TooWide(ArithmeticError):
    """The balls have grown so much that a step cannot be proved: more bits are needed."""


class StepNotTaken(ArithmeticError):
    """A step of one ball that cannot be taken.

    `status` says why, `index` which step of a trajectory it was (0 is the first), `reach` the fraction
    of the momentum that the branch attains, and `trajectory` holds the states before it, if there are any.
    """

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self.status, self.reach, self.index, self.trajectory)

    def __init__(self, status: Status, reach: float, index: int | None = None, trajectory: Any = None) -> None:
        self.status, self.reach, self.index, self.trajectory = status, reach, index, trajectory
        where = "" if index is None else f"step {index}: "
        attained = f"{reach:.6g}" if reach < 0.99999 else f"all but {max(1 - reach, 1e-16):.2g}"
        extent = f" (it attains {attained} of it)" if status is Status.FOLDED else ""
        super().__init__(f"{where}{status.sentence}{extent}")
