"""What the models that know every state at once share: the step numbers that are asked for."""

import numpy as np
from numpy.typing import ArrayLike

from ..errors import BadInput
from ..trajectories import MOST_STEPS


def step_numbers(index: ArrayLike) -> np.ndarray:
    """Ascending whole numbers from 0 on as int64, (frames,); raises BadInput for anything else."""
    given = np.asarray(index)
    if given.dtype.kind not in "iu" or given.ndim != 1 or not len(given):
        raise BadInput(f"index must be a list of whole numbers, at least one, not {index!r:.60}")
    if int(given[0]) < 0 or int(given.max()) > MOST_STEPS or (given[1:] <= given[:-1]).any():
        raise BadInput("index must ascend from 0 or a later step, to 2^62 at most")
    return given.astype(np.int64)
