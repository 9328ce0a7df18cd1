"""From what a model follows to what was asked for: derived outputs, in the axes that the user gave."""

import numpy as np

from chapsym.dynamics.ball import Floats
from chapsym.dynamics.principal_axes import attitude_from_principal, from_principal

from ..members.members import Members
from ..read.outputs import OUTPUTS, K, columns_for
from ..read.task import Columns, Task


@np.errstate(over="ignore", invalid="ignore")  # the square of a momentum may be beyond float64
def asked_for(members: Members, task: Task, columns: Columns) -> Columns:
    """The outputs of a task from the columns of a model in principal axes; what was not asked for is left out."""
    found: Columns = {}
    for name in task.outputs:
        found[name] = columns[name] if OUTPUTS[name].derive is None else _derived(name, members, task, columns)
        if f"{name}_low" in columns:
            found[f"{name}_low"] = columns[f"{name}_low"]
    return in_given_axes(members, found)


def _derived(name: str, members: Members, task: Task, columns: Columns) -> np.ndarray:
    """A derived output; frames that a ball did not reach are NaN, on which no kernel is run."""
    columns = {key: columns[key] for key in columns_for((name,), top=False) if key in columns}
    some = next(iter(columns.values()))
    missing = np.isnan(some).reshape(*some.shape[:2], -1).any(axis=-1)
    if missing.any():
        for key, values in columns.items():
            where = missing.reshape(*missing.shape, *[1] * (values.ndim - 2))
            columns[key] = np.where(where, _vertical(members) if key == "gamma" else 0.0, values)
    values = np.array(_value(name, members, task, columns), dtype=np.float64)
    values[missing] = np.nan
    return values


def _value(name: str, members: Members, task: Task, columns: Columns) -> Floats:
    """A column, K, or what is derived of these; what enters with D alone may not be there, and be anything."""
    if name == K:
        return columns["momentum"] / task.scale
    one = OUTPUTS[name]
    if one.derive is None:
        return columns[name]
    given = {
        part: np.broadcast_to(_vertical(members), (*columns["momentum"].shape[:2], members.dimension))
        if part in one.with_D and part not in columns
        else _value(part, members, task, columns)
        for part in one.needs
    }
    return one.derive(members.ball.mass_tensor[:, np.newaxis], members.ball.D[:, np.newaxis], given)


def _vertical(members: Members) -> Floats:
    return np.eye(members.dimension)[-1]


def in_given_axes(members: Members, columns: Columns) -> Columns:
    """Vectors and attitudes in the axes that the user gave, from those in principal axes."""
    if members.axes is None:
        return columns
    axes = members.axes[:, np.newaxis]
    back = {("axis",): from_principal, ("quaternion",): attitude_from_principal}
    return {
        name: back[dims](axes, values) if (dims := OUTPUTS[name].dims) in back else values
        for name, values in columns.items()
    }
