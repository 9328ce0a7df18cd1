"""The task of a run."""

from dataclasses import dataclass

import numpy as np

Columns = dict[str, np.ndarray]
#: An accuracy that float64 does not hold: the result has second halves, as at the precision "double-double".
BEYOND_FLOAT64 = 1e-15


@dataclass(frozen=True)
class Task:
    """outputs: names of `outputs.OUTPUTS`.

    steps, every: of the map, the latter between two frames.  time_step: ε in s, or None in the paper's units.
    order: of the composition.  precision: "single", "double" or "double-double".
    Or, of the continuous motion, an accuracy at these frames, in the norm `of` ("state" or "contact"), within `limit` s
    of the processor.  Without a time_step the frames are at `steps` equal parts of `time` s.
    searched: whether the scene asks for that accuracy itself, so that all precisions may serve.
    proved: of the map, whether each frame shall have bounds of its error.
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
        """The number of states that are kept, with the first."""
        return self.steps // self.every + 1

    @property
    def chosen(self) -> bool:
        """Whether there is no ε: frames have times only."""
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
        """Whether what is followed has more digits than float64: second halves are kept, too."""
        return self.precision == "double-double" or (self.accuracy is not None and self.accuracy < BEYOND_FLOAT64)

    @property
    def scale(self) -> float:
        """The divisor of the momentum of a start that gives K: ε, or 1 where it is K itself."""
        return 1.0 if self.time_step is None else self.time_step
