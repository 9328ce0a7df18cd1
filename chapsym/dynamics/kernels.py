"""The kernels on NumPy arrays: broadcasting over leading axes, with checks of the shapes.

    momentum(rotation, gamma, mass_tensor, D)

Every argument of length k in the kernel's table is an array (..., k), and D is an array (...).
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from chapsym.generated import TABLE

from .ball import Floats, numbers
from .errors import BadInput


def _array(value: ArrayLike, name: str, trailing: int | None) -> np.ndarray:
    """The values of an argument: float64, or as they are where an array holds the numbers of another precision."""
    if isinstance(value, np.ndarray) and value.dtype == object and trailing and value.shape[-1:] == (trailing,):
        return value
    return numbers(value, name, trailing)


def kernel(name: str) -> Callable[..., Floats]:
    """The NumPy front of a kernel: arrays in the order of its groups, an array of its shape out."""
    function: Any  # of as many numbers as its groups have
    function, groups, shape = TABLE[name]

    def front(*arrays: ArrayLike) -> Floats:
        if len(arrays) != len(groups):
            listed = ", ".join(group for group, _ in groups)
            raise BadInput(f"{name} takes {len(groups)} arguments ({listed}), not {len(arrays)}")
        columns = []
        for value, (group, length) in zip(arrays, groups, strict=True):
            array = _array(value, group, None if group == "D" else length)
            columns += [array] if group == "D" else [array[..., i] for i in range(length)]
        try:
            leading = np.broadcast_shapes(*(c.shape for c in columns))
        except ValueError:
            shapes = ", ".join(f"{g} {np.shape(a)}" for a, (g, _) in zip(arrays, groups, strict=True))
            raise BadInput(f"the leading axes of the arguments of {name} do not broadcast: {shapes}") from None
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):  # as in the compiled loops
            result = function(*columns)
        if not shape:
            return np.broadcast_to(result, leading).copy()
        parts = [np.broadcast_to(part, leading) for part in result]
        return np.stack(parts, axis=-1).reshape(*leading, *shape)

    front.__name__ = name
    front.__doc__ = f"{function.__doc__}\n    On arrays: {', '.join(f'{g} (..., {n})' for g, n in groups)}.\n    "
    return front


# What a state, a ball or a rotation has; `kernel` makes the front of any other.
momentum = kernel("momentum")
tangent_jacobian = kernel("tangent_jacobian")
tangent_hessian = kernel("tangent_hessian")
residual = kernel("residual")
rotation = kernel("rotation")
rotate = kernel("rotate")
transport = kernel("transport")
compose = kernel("compose")
centre_step = kernel("centre_step")
invariants = kernel("invariants")
energy = kernel("energy")
contact_momentum = kernel("contact_momentum")
angular_velocity = kernel("angular_velocity")
turn = kernel("turn")
