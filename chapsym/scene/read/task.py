"""The task of a run."""

from dataclasses import dataclass

import numpy as np

Columns = dict[str, np.ndarray]
#: An accuracy beyond float64: the result has low halves, as at the precision "double-double".
BEYOND_FLOAT64 = 1e-15


@dataclass(frozen=True)
class Task:
    """outputs: names of `outputs.OUTPUTS`.

    steps: of the map; every: of them between two frames.  time_step: ε in s, or None in the paper's units.
    order: of the composition.  precision: "single", "double" or "double-double".  Or, of the continuous motion, an
    accuracy at these frames, in the norm `of` ("state" or "contact"), within `limit` s of the processor.  Without a
    time_step the frames are at `steps` equal parts of `time` s.
    searched: whether the scene itself requests this accuracy, so that all precisions may be used.
    proved: for the map, whether each frame has bounds of its error.
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
    searched: bool = False
    proved: bool = False

    @property
    def frames(self) -> int:
        """The number of stored states, including the first."""
        return self.steps // self.every + 1

    @property
    def chosen(self) -> bool:
        """Whether there is no ε: frames have only times."""
        return self.accuracy is not None and self.time_step is None

    @property
    def interval(self) -> float:
        """Seconds between two frames of a run that has times."""
        if self.time_step is not None:
            return self.every * self.time_step
        assert self.time is not None
        return self.time / max(self.steps, 1)

    @property
    def timed(self) -> bool:
        """Whether the run has times, and so K = 𝒦/ε is known."""
        return self.chosen or self.time_step is not None

    @property
    def doubled(self) -> bool:
        """Whether the columns have more digits than float64, with low halves."""
        return self.precision == "double-double" or (self.accuracy is not None and self.accuracy < BEYOND_FLOAT64)

    @property
    def scale(self) -> float:
        """The divisor from the momentum of a start to K: ε, or 1 for K itself."""
        return 1.0 if self.time_step is None else self.time_step
