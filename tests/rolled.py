"""A plan run in memory, segment by segment, without the machinery of sweeps."""

import numpy as np

from chapsym.scene.running import sweep


def rolled(plan, cut=None):
    """All outputs of all balls, each segment from the state that the one before left."""
    whole = slice(0, len(plan.members))
    state, parts = sweep.begin(plan, whole), []
    for segment in cut or plan.segments:
        columns, state = sweep.advance(plan, whole, state, segment)
        parts.append(columns)
    columns = {
        name: parts[0][name] if parts[0][name].ndim == 1 else np.concatenate([part[name] for part in parts], axis=1)
        for name in parts[0]
    }
    return columns, state
