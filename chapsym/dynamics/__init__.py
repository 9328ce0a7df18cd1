"""The map, for one ball or many, in three dimensions or n: steps, branches, compositions and reductions."""

from .ball import Ball
from .certified import Certificate, certify
from .closed.elliptic import Curve, increment
from .closed.steady import is_steady, steady_frames
from .closed.top import ExactTop, TopMotion, exact_top, is_top, top_frames
from .closed.vertical import VerticalTrajectory, rotation_number, step_vertical, trajectory_vertical
from .coefficients import substeps
from .enclosed_motion import CertifiedMotion, ExactBall, certified_motion
from .errors import BadInput, Status, StepNotTaken
from .extrapolation import Extrapolated, extrapolate
from .implicit import implicit_step
from .map import compose_step, step, trajectory
from .n.ball_n import BallN, axial, invariants_n, skew
from .n.run_n import StepN, StepperN, TrajectoryN, step_n, trajectory_n
from .results import Bounds, Step, Trajectory
from .reversal import NotRetraced, retrace_error, reverse, reverse_n
from .solutions.continuation import Fold, Followed, fold, follow, margin
from .solutions.multivalued import Branches, branches
from .stepper import Stepper

__all__ = [
    "BadInput", "Ball", "BallN", "Bounds", "Branches", "Certificate", "CertifiedMotion", "Curve", "ExactBall",
    "ExactTop", "Extrapolated", "Fold", "Followed", "NotRetraced", "Status", "Step", "StepN", "StepNotTaken",
    "Stepper", "StepperN", "TopMotion", "Trajectory", "TrajectoryN", "VerticalTrajectory", "axial", "branches",
    "certified_motion", "certify", "compose_step", "exact_top", "extrapolate", "fold", "follow", "implicit_step",
    "increment", "invariants_n", "is_steady", "is_top", "margin", "retrace_error", "reverse", "reverse_n",
    "rotation_number", "skew", "steady_frames", "step", "step_n", "step_vertical", "substeps", "top_frames",
    "trajectory", "trajectory_n", "trajectory_vertical",
]  # fmt: skip
