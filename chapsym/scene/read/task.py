"""What a run is asked for."""

from dataclasses import dataclass

import numpy as np

Columns = dict[str, np.ndarray]
#: An accuracy that float64 does not hold: the result has second halves, as on the rung "quad".
BEYOND_FLOAT64 = 1e-15


@dataclass(frozen=True)
class Task:
    """outputs: names of `outputs.OUTPUTS`.

    steps, every: of the map, the latter between two frames.  time_step: ε in s, or None in the paper's units.
    order: of the composition.  precision: "single", "double" or "quad".
    Or, where the steps are to be chosen: accuracy of the continuous motion after `time` s, at `frames` equal times, in
    the norm `of` ("state" or "contact"), within `limit` s of the processor.
    """

    outputs: tuple[str, ...]
    steps: int
    every: int = 1
    time_step: float | None = None
    order: int = 2
    precision: str = "double"
    accuracy: float | None = None
    time: float | None = None
    of: str = "state"
    limit: float = 600.0

    @property
    def frames(self) -> int:
        """How many states are kept, with the first."""
        return self.steps // self.every + 1

    @property
    def chosen(self) -> bool:
        """Whether the steps are to be chosen for an accuracy."""
        return self.accuracy is not None

    @property
    def timed(self) -> bool:
        """Whether the run has times, and so K = 𝒦/ε is known."""
        return self.chosen or self.time_step is not None

    @property
    def doubled(self) -> bool:
        """Whether what is followed has more digits than float64: second halves are kept, too."""
        return self.precision == "quad" or (self.accuracy is not None and self.accuracy < BEYOND_FLOAT64)

    @property
    def scale(self) -> float:
        """What divides the momentum to give K: ε, or 1 where the momentum is K itself."""
        return 1.0 if self.chosen or self.time_step is None else self.time_step
