"""chapsym: machine-checked review of Fedorov's discrete Chaplygin ball, and a simulator of it.

    >>> import chapsym
    >>> ball = chapsym.Ball(mass_tensor=(1, 2, 4), D=3)
    >>> state = chapsym.step(ball, momentum=(1, -0.5, 0.75), gamma=(2/7, 3/7, 6/7))

Names are imported when they are first used: `import chapsym` alone loads neither NumPy nor SymPy.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .accuracy import accurate, roll
    from .dynamics import *
    from .numbers import Digits, Enclosure
    from .scene.result.interpolation import interpolated
    from .show.result import Result, open_result, run_scene

__version__ = "0.1.0"

__all__ = [
    "BadInput", "Ball", "BallN", "Bounds", "Branches", "Certificate", "CertifiedMotion", "Curve", "Digits", "Enclosure",
    "ExactBall", "ExactTop", "Extrapolated", "Fold", "Followed", "NotRetraced", "Result", "Status", "Step", "StepN",
    "StepNotTaken", "Stepper", "StepperN", "TopMotion", "Trajectory", "TrajectoryN", "VerticalTrajectory", "accurate",
    "axial", "branches", "certified_motion", "certify", "compose_step", "exact_top", "extrapolate", "fold", "follow",
    "implicit_step", "increment", "interpolated", "invariants_n", "is_steady", "is_top", "margin", "open_result",
    "retrace_error", "reverse", "reverse_n", "roll", "rotation_number", "run_scene", "skew", "steady_frames", "step",
    "step_n", "step_vertical", "substeps", "top_frames", "trajectory", "trajectory_n", "trajectory_vertical",
]  # fmt: skip

#: Names that are not of `chapsym.dynamics`: where they are.
_ELSEWHERE = dict.fromkeys(("Result", "open_result", "run_scene"), "chapsym.show.result")
_ELSEWHERE |= dict.fromkeys(("accurate", "roll"), "chapsym.accuracy")
_ELSEWHERE |= dict.fromkeys(("Digits", "Enclosure"), "chapsym.numbers")
_ELSEWHERE["interpolated"] = "chapsym.scene.result.interpolation"


if not TYPE_CHECKING:  # a type checker, which reads the imports above, is to refuse any other name

    def __getattr__(name):
        from importlib import import_module

        if name not in __all__:
            raise AttributeError(f"module 'chapsym' has no attribute {name!r}")
        value = getattr(import_module(_ELSEWHERE.get(name, "chapsym.dynamics")), name)
        globals()[name] = value
        return value


def __dir__() -> list[str]:
    return sorted(["__version__", *__all__])
