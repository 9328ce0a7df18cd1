"""From what a model follows to what was asked for: derived outputs, in the axes that the user gave."""

import numpy as np

from chapsym.dynamics import kernels

from ..members.members import Members
from ..running.task import Columns, Task
from .outputs import OUTPUTS


@np.errstate(over="ignore", invalid="ignore")  # the square of a momentum may be beyond float64
def asked_for(members: Members, task: Task, columns: Columns) -> Columns:
    """The outputs of a task from the columns of a model in principal axes; what was not asked for is left out."""
    found: Columns = {}
    for name in task.outputs:
        derive = OUTPUTS[name].derive
        found[name] = columns[name] if derive is None else _derived(name, members, task, columns)
        if f"{name}_low" in columns:
            found[f"{name}_low"] = columns[f"{name}_low"]
    return in_given_axes(members, found)


def _derived(name: str, members: Members, task: Task, columns: Columns) -> np.ndarray:
    """A derived output; frames that a ball did not reach are NaN, on which no kernel is run."""
    missing = np.isnan(columns["momentum"]).reshape(*columns["momentum"].shape[:2], -1).any(axis=-1)
    if missing.any():
        vertical = np.zeros(members.gamma.shape[-1])
        vertical[-1] = 1.0
        columns = dict(columns)
        for key, instead in (("momentum", 0.0), ("gamma", vertical)):
            if key in columns:
                where = missing.reshape(*missing.shape, *[1] * (columns[key].ndim - 2))
                columns[key] = np.where(where, instead, columns[key])
    derive = OUTPUTS[name].derive
    assert derive is not None
    values = np.array(derive(members, task, columns), dtype=np.float64)
    values[missing] = np.nan
    return values


def in_given_axes(members: Members, columns: Columns) -> Columns:
    """Vectors and attitudes in the axes that the user gave, from those in principal axes."""
    if members.axes is None:
        return columns
    axes = members.axes[:, np.newaxis]
    back = axes * [1.0, -1.0, -1.0, -1.0]
    turned = dict(columns)
    for name in turned:
        missing = np.isnan(columns[name])  # frames that a ball did not reach, which the kernels refuse
        values = np.where(missing, 0.0, columns[name]) if missing.any() else columns[name]
        if name == "attitude":
            turned[name] = kernels.compose(values, np.broadcast_to(back, values.shape))
        elif name in ("momentum", "gamma", "omega", "momentum_low", "gamma_low"):
            turned[name] = kernels.rotate(np.broadcast_to(axes, (*values.shape[:-1], 4)), values)
        if turned[name] is not columns[name]:
            turned[name][missing] = np.nan
    return turned
