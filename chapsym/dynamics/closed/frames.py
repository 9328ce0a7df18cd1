"""What the models that know every state at once share: the step numbers that are asked for, and their trajectory."""

import numpy as np
from numpy.typing import ArrayLike

from ..ball import Floats
from ..errors import BadInput, Status, StepNotTaken
from ..results import Trajectory, some_frames
from ..trajectories import MOST_STEPS


def step_numbers(index: ArrayLike) -> np.ndarray:
    """Ascending whole numbers from 0 on as int64, (frames,); raises BadInput for anything else."""
    given = np.asarray(index)
    if given.dtype.kind not in "iu" or given.ndim != 1 or not len(given):
        raise BadInput(f"index must be a list of whole numbers, at least one, not {index!r:.60}")
    if int(given[0]) < 0 or int(given.max()) > MOST_STEPS or (given[1:] <= given[:-1]).any():
        raise BadInput("index must ascend from 0 or a later step, to 2^62 at most")
    return given.astype(np.int64)


def finished(run: Trajectory, reach: Floats) -> Trajectory:
    """The run; for one ball that could not take its step StepNotTaken with `reach` and what there is."""
    if run.status.shape or run.status == Status.TAKEN:
        return run
    raise StepNotTaken(Status(int(run.status)), float(reach.flat[0]), 0, some_frames(run, run.index <= 0))
