"""The map in float64: step, trajectory, and the kernels on arrays; in three dimensions and in n."""

from .ball import Ball
from .ball_n import BallN, axial, skew
from .errors import BadInput, Status, StepNotTaken
from .general import StepN, step_n
from .map import Step, step
from .trajectories import Trajectory, roll, trajectory
from .trajectories_n import TrajectoryN, invariants_n, reverse_n, trajectory_n

__all__ = [
    "BadInput", "Ball", "BallN", "Status", "Step", "StepN", "StepNotTaken", "Trajectory", "TrajectoryN", "axial",
    "invariants_n", "reverse_n", "roll", "skew", "step", "step_n", "trajectory", "trajectory_n",
]  # fmt: skip
