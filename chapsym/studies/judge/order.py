"""What several steps of one engine say: its order, and the part of its distance that no step takes away."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from chapsym.dynamics.errors import BadInput

from .departure import angle
from .trajectory import Trajectory


@dataclass(frozen=True)
class Convergence:
    """Of the path, or of the attitude, over steps that are divided by one ratio.

    order: from how the differences between neighbouring steps fall; None where they do not fall.
    of_the_step: what is left of the finest run because of its step.  floor: the rest of its distance from the truth:
    the soft contact, the friction, the rounding.  Both are estimates, in m or degrees.
    """

    order: float | None
    of_the_step: float | None
    floor: float | None


def convergence(runs: Sequence[Trajectory], distances: Sequence[np.ndarray], of: str = "path") -> Convergence:
    """From three runs or more, each with its step, and their distances from the truth at the frames.

    Where runs with the steps h, h/r and h/r² differ by d and d' at most, the order is log(d/d')/log r, and the limit
    of the runs is about d'/(r^order - 1) from the last.  Raises BadInput where steps are missing, equal or of several
    ratios.
    """
    if missing := [run.file for run in runs if run.step is None]:
        raise BadInput(f"{missing[0]} has no line '# time_step = SECONDS', which several files need")
    order = sorted(range(len(runs)), key=lambda i: -float(runs[i].step or 0))
    steps = np.array([runs[i].step for i in order], dtype=float)
    ratios = steps[:-1] / steps[1:]
    if (ratios <= 1 + 1e-6).any() or np.ptp(ratios) > 1e-6 * ratios[0]:
        raise BadInput(f"the steps must be divided by the same number each time, but they are {_listed(steps)}")
    measure = _path if of == "path" else _attitude
    apart = [measure(runs[a], runs[b]) for a, b in pairwise(order)]
    last = float(distances[order[-1]].max())
    if not 0 < apart[-1] < apart[-2]:
        return Convergence(None, None, None)
    power = float(np.log(apart[-2] / apart[-1]) / np.log(ratios[-1]))
    left = apart[-1] / (ratios[-1] ** power - 1)
    return Convergence(power, float(left), max(0.0, last - left))


def sentence(found: Convergence, unit: str) -> str:
    """What several steps say, estimated."""
    if found.order is None:
        return "the differences between steps do not fall: no order"
    return (
        f"order {found.order:.2f}; of the finest run's distance {found.of_the_step:.3g} {unit} are of its step, "
        f"{found.floor:.3g} {unit} are not (estimated)"
    )


def _listed(steps: np.ndarray) -> str:
    return ", ".join(f"{x:g}" for x in steps)


def _path(a: Trajectory, b: Trajectory) -> float:
    return float(np.linalg.norm(a.centre[:, :2] - b.centre[:, :2], axis=-1).max())


def _attitude(a: Trajectory, b: Trajectory) -> float:
    return float(angle(a.attitude, b.attitude).max())
