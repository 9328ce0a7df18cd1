"""Where the refinement of a step on a high rung starts: the rotation that the continuation in float64 finds."""

import math
from collections.abc import Sequence

import numpy as np

from .branch import small_rotation
from .errors import Status, StepNotTaken
from .map import explain


def start(K: Sequence[float], g: Sequence[float], J: Sequence[float], D: Sequence[float]) -> tuple[float, ...]:
    """The rotation of the small-rotation branch in float64; γ of any precision is a unit vector only to it.

    Raises StepNotTaken as `step` does.
    """
    length = math.hypot(*g)
    g = [x / length for x in g]
    status, reach, *q = small_rotation(*K, *g, *J, *D)
    if status != Status.TAKEN:
        raise StepNotTaken(explain(status, np.array(K), np.array(g), np.array(J), float(D[0])), float(reach))
    return tuple(map(float, q))
