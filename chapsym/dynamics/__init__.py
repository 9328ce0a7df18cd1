"""The map in float64: step, trajectory, all branches and their folds, and the kernels; in three dimensions and in n."""

from .ball import Ball
from .ball_n import BallN, axial, skew
from .continuation import Fold, Followed, fold, follow, margin
from .errors import BadInput, Status, StepNotTaken
from .general import StepN, step_n
from .map import Step, step
from .multivalued import Branches, branches
from .trajectories import Trajectory, roll, trajectory
from .trajectories_n import TrajectoryN, invariants_n, reverse_n, trajectory_n

__all__ = [
    "BadInput", "Ball", "BallN", "Branches", "Fold", "Followed", "Status", "Step", "StepN", "StepNotTaken",
    "Trajectory", "TrajectoryN", "axial", "branches", "fold", "follow", "invariants_n", "margin", "reverse_n", "roll",
    "skew", "step", "step_n", "trajectory", "trajectory_n",
]  # fmt: skip
