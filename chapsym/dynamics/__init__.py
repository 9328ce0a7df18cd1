"""The map in float64: step, trajectory, compositions of higher order, the way back; in three dimensions and in n."""

from .ball import Ball
from .ball_n import BallN, axial, skew
from .coefficients import substeps
from .composition import ComposedTrajectory, compose_step, composed_trajectory
from .errors import BadInput, Status, StepNotTaken
from .general import StepN, step_n
from .map import Step, step
from .reversal import NotRetraced, retrace_error, reverse
from .trajectories import Trajectory, roll, trajectory
from .trajectories_n import TrajectoryN, invariants_n, reverse_n, trajectory_n

__all__ = [
    "BadInput", "Ball", "BallN", "ComposedTrajectory", "NotRetraced", "Status", "Step", "StepN", "StepNotTaken",
    "Trajectory", "TrajectoryN", "axial", "compose_step", "composed_trajectory", "invariants_n", "retrace_error",
    "reverse", "reverse_n", "roll", "skew", "step", "step_n", "substeps", "trajectory", "trajectory_n",
]  # fmt: skip
