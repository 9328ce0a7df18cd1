"""The map in float64: step, trajectory, and the kernels on arrays; in three dimensions and in n."""

from .ball import Ball
from .ball_n import BallN, axial, skew
from .elliptic import Curve, increment
from .errors import BadInput, Status, StepNotTaken
from .exact import ExactTop, exact_top
from .general import StepN, step_n
from .map import Step, step
from .trajectories import Trajectory, roll, trajectory
from .trajectories_n import TrajectoryN, invariants_n, reverse_n, trajectory_n
from .vertical import VerticalTrajectory, step_vertical, trajectory_vertical

__all__ = [
    "BadInput", "Ball", "BallN", "Curve", "ExactTop", "Status", "Step", "StepN", "StepNotTaken", "Trajectory",
    "TrajectoryN", "VerticalTrajectory", "axial", "exact_top", "increment", "invariants_n", "reverse_n", "roll", "skew",
    "step", "step_n", "step_vertical", "trajectory", "trajectory_n", "trajectory_vertical",
]  # fmt: skip
