"""The map: one ball or many, three dimensions or n, its branches, compositions and reductions."""

from .ball import Ball
from .ball_n import BallN, axial, skew
from .certificates import Certificate, certify
from .coefficients import substeps
from .composition import compose_step
from .continuation import Fold, Followed, fold, follow, margin
from .elliptic import Curve, increment
from .errors import BadInput, Status, StepNotTaken
from .exact import ExactTop, exact_top
from .extrapolation import Extrapolated, extrapolate
from .general import StepN, step_n
from .map import Step, step
from .multivalued import Branches, branches
from .reversal import NotRetraced, retrace_error, reverse
from .rotation import rotation_number
from .steady import is_steady, steady_frames
from .top import TopMotion
from .tops import is_top, top_frames
from .trajectories import Trajectory, roll, trajectory
from .trajectories_n import TrajectoryN, invariants_n, reverse_n, trajectory_n
from .vertical import VerticalTrajectory, step_vertical, trajectory_vertical

__all__ = [
    "BadInput", "Ball", "BallN", "Branches", "Certificate", "Curve", "ExactTop", "Extrapolated", "Fold", "Followed",
    "NotRetraced", "Status", "Step", "StepN", "StepNotTaken", "TopMotion", "Trajectory", "TrajectoryN",
    "VerticalTrajectory", "axial", "branches", "certify", "compose_step", "exact_top", "extrapolate", "fold", "follow",
    "increment", "invariants_n", "is_steady", "is_top", "margin", "retrace_error", "reverse", "reverse_n", "roll",
    "rotation_number", "skew", "steady_frames", "step", "step_n", "step_vertical", "substeps", "top_frames",
    "trajectory", "trajectory_n", "trajectory_vertical",
]  # fmt: skip
