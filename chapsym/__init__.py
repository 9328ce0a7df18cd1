"""chapsym: a referee that can be run, for Fedorov's discrete Chaplygin ball.

    >>> import chapsym
    >>> ball = chapsym.Ball(mass_tensor=(1, 2, 4), D=3)
    >>> state = chapsym.step(ball, momentum=(1, -0.5, 0.75), gamma=(2/7, 3/7, 6/7))

Names are imported when they are first used: `import chapsym` alone loads neither NumPy nor SymPy.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .dynamics import (
        BadInput,
        Ball,
        BallN,
        Branches,
        Fold,
        Followed,
        Status,
        Step,
        StepN,
        StepNotTaken,
        Trajectory,
        TrajectoryN,
        axial,
        branches,
        fold,
        follow,
        invariants_n,
        margin,
        reverse_n,
        roll,
        skew,
        step,
        step_n,
        trajectory,
        trajectory_n,
    )

__version__ = "0.1.0"

__all__ = [
    "BadInput", "Ball", "BallN", "Branches", "Fold", "Followed", "Status", "Step", "StepN", "StepNotTaken",
    "Trajectory", "TrajectoryN", "axial", "branches", "fold", "follow", "invariants_n", "margin", "reverse_n", "roll",
    "skew", "step", "step_n", "trajectory", "trajectory_n",
]  # fmt: skip


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module 'chapsym' has no attribute {name!r}")
    value = getattr(import_module("chapsym.dynamics"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
