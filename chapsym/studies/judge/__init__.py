"""How far an engine's trajectory is from a motion that is certified (benchmarks/rolling)."""

from .case import Case, read_case
from .departure import Departure, departure
from .order import Convergence, convergence, sentence
from .trajectory import Trajectory, read_trajectory

__all__ = [
    "Case", "Convergence", "Departure", "Trajectory", "convergence", "departure", "read_case", "read_trajectory",
    "sentence",
]  # fmt: skip
