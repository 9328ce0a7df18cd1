"""The map in float64: step, trajectory, and the kernels on arrays."""

from .ball import Ball
from .errors import BadInput, Status, StepNotTaken
from .map import Step, step
from .trajectories import Trajectory, roll, trajectory

__all__ = ["BadInput", "Ball", "Status", "Step", "StepNotTaken", "Trajectory", "roll", "step", "trajectory"]
