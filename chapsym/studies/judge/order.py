"""What several steps of one engine say: its order, and the part of its distance that no step takes away."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from chapsym.dynamics.errors import BadInput

from .case import Case
from .departure import angle
from .trajectory import Trajectory


@dataclass(frozen=True)
class Convergence:
    """Of the path, or of the attitude, over steps that are divided by one ratio.

    order: from how the differences between neighbouring steps fall; None where they do not fall.
    of_the_step: how far the finest run is from the limit of the runs.  floor: how far that limit is from the truth: the
    soft contact, the friction, the rounding.  Both are estimates, in m or degrees, and the greatest at the frames.
    """

    order: float | None
    of_the_step: float | None
    floor: float | None


def convergence(case: Case, runs: Sequence[Trajectory], of: str = "path") -> Convergence:
    """From three runs or more, each with its step, of the path or of the attitude.

    Where runs with the steps h, h/r and h/r² differ by d and d' at most, the order is log(d/d')/log r; the last run and
    its difference from the one before, over r^order - 1, give the limit of the runs at each frame.  Raises BadInput
    where steps are missing, equal or of several ratios.
    """
    if missing := [run.file for run in runs if run.step is None]:
        raise BadInput(f"{missing[0]} has no line '# time_step = SECONDS', which several files need")
    runs = sorted(runs, key=lambda run: -float(run.step or 0))
    steps = np.array([run.step for run in runs], dtype=float)
    ratios = steps[:-1] / steps[1:]
    if (ratios <= 1 + 1e-6).any() or np.ptp(ratios) > 1e-6 * ratios[0]:
        raise BadInput(
            f"the steps must be divided by the same number each time, but they are {', '.join(f'{x:g}' for x in steps)}"
        )
    if of == "path":
        points, truth, apart = [run.centre[:, :2] for run in runs], case.path, _distance
    else:
        points, truth, apart = [_turned(case, run) for run in runs], case.attitude, angle
    away = [float(apart(a, b).max()) for a, b in pairwise(points)]
    if not 0 < away[-1] < away[-2]:
        return Convergence(None, None, None)
    power = float(np.log(away[-2] / away[-1]) / np.log(ratios[-1]))
    limit = points[-1] + (points[-1] - points[-2]) / (ratios[-1] ** power - 1)
    return Convergence(power, float(apart(points[-1], limit).max()), float(apart(limit, truth).max()))


def _turned(case: Case, run: Trajectory) -> np.ndarray:
    """The attitudes, of their two signs those nearer to the truth."""
    along = (run.attitude * case.attitude).sum(axis=-1, keepdims=True)
    return np.where(along < 0, -run.attitude, run.attitude)


def _distance(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.asarray(np.linalg.norm(a - b, axis=-1))


def sentence(found: Convergence, unit: str) -> str:
    """What several steps say, estimated."""
    if found.order is None:
        return "the differences between steps do not fall: no order"
    return (
        f"order {found.order:.2f}; the finest run is {found.of_the_step:.3g} {unit} from the limit of the runs, and "
        f"that is {found.floor:.3g} {unit} from the truth (estimated)"
    )
