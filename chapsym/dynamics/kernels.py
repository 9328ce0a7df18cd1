"""The kernels on NumPy arrays: broadcasting over leading axes, with checks of the shapes.

    momentum(rotation, gamma, mass_tensor, D)

Every argument of length k in the kernel's table is an array (..., k), and D is an array (...).
"""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from chapsym.generated import TABLE

from .ball import SMALLEST, Ball, Floats, largest_moment, numbers
from .errors import BadInput

#: A generated function of numbers of any precision, or of arrays: it returns one number or several.
Function = Callable[..., Any]
#: A row of the TABLE of a generated package: the function, its groups with their lengths, the shape of the result.
Row = tuple[Any, tuple[tuple[str, int], ...], tuple[int, ...]]
#: Numbers of each argument in one block: the intermediate values of a function stay in the second-level cache.
BLOCK = 8192


def _array(value: ArrayLike, name: str, trailing: int | None) -> np.ndarray:
    """The values of an argument: float64, or unchanged for an array of the numbers of another precision.

    They are read-only: finite float64 numbers are not copied.
    """
    if type(value) is not np.ndarray or (trailing is not None and value.shape[-1:] != (trailing,)):
        return numbers(value, name, trailing)
    if value.dtype == object:
        return value if trailing is not None else numbers(value, name, trailing)
    # A sum is finite only if all are, and takes half the time of looking at each.
    return value if value.dtype == np.float64 and math.isfinite(value.sum()) else numbers(value, name, trailing)


def kernel(name: str) -> Callable[..., Floats]:
    """A kernel of the ball as a function of NumPy arrays, in the order of its groups; it returns an array."""
    return on_arrays(TABLE[name], ("D",))


def on_arrays(row: Row, alone: Sequence[str] | None = None) -> Callable[..., Floats]:
    """A generated kernel of any register as a function of NumPy arrays.

    Parameters
    ----------
    row : tuple
        A row of the TABLE of a generated package: the function, its groups of arguments, and its result's shape.
    alone : sequence of str, optional
        The groups of a single number that have no axis of their own; all such groups by default.

    Returns
    -------
    callable
        It takes an array (..., n) for each group of n numbers, and (...) for a group in `alone`; the leading axes
        broadcast.  The result is (..., *shape).  Long arrays are processed in blocks that stay in the cache; this does
        not change the bits of a result.  Raises BadInput for arrays that do not fit.
    """
    function, groups, shape = row
    name = function.__name__
    single = {group for group, length in groups if length == 1 and (alone is None or group in alone)}

    def front(*arrays: ArrayLike) -> Floats:
        if len(arrays) != len(groups):
            listed = ", ".join(group for group, _ in groups)
            raise BadInput(f"{name} takes {len(groups)} arguments ({listed}), not {len(arrays)}")
        with np.errstate(over="ignore", under="ignore", invalid="ignore"):  # as in the compiled loops
            columns = list[np.ndarray]()
            for value, (group, length) in zip(arrays, groups, strict=True):
                array = _array(value, group, None if group in single else length)
                parts = [array] if group in single else array.T if array.ndim == 2 else np.moveaxis(array, -1, 0)
                columns.extend(parts)
            try:
                different = {column.shape for column in columns}
                leading = different.pop() if len(different) == 1 else np.broadcast_shapes(*different)
            except ValueError:
                shapes = ", ".join(f"{g} {np.shape(a)}" for a, (g, _) in zip(arrays, groups, strict=True))
                raise BadInput(f"the leading axes of the arguments of {name} do not broadcast: {shapes}") from None
            return _in_blocks(function, columns, leading).reshape((*leading, *shape))

    front.__name__ = name
    front.__doc__ = f"{function.__doc__}\n    On arrays: {', '.join(f'{g} (..., {n})' for g, n in groups)}.\n    "
    return front


def _in_blocks(function: Function, columns: list[np.ndarray], leading: tuple[int, ...]) -> np.ndarray:
    """The n results of a function, (*leading, n), computed in blocks of the leading axes."""
    size = math.prod(leading)
    if size <= 2 * BLOCK or any(column.dtype == object for column in columns):
        parts = parts_of(function(*columns))
        return _fill(np.empty((*leading, len(parts)), np.result_type(*parts)), parts)
    flat = [c.reshape(-1) if c.size == 1 else np.broadcast_to(c, leading).reshape(-1) for c in columns]
    result = np.empty(0)
    for start in range(0, size, BLOCK):
        block = slice(start, start + BLOCK)
        parts = parts_of(function(*(c if c.size == 1 else c[block] for c in flat)))
        result = result if start else np.empty((size, len(parts)), np.result_type(*parts))
        _fill(result[block], parts)
    return result


def _fill(result: np.ndarray, parts: Sequence[ArrayLike]) -> np.ndarray:
    for i, part in enumerate(parts):
        result[..., i] = part
    return result


def parts_of(result: Any) -> list[Any]:
    """The results of a generated function as a tuple."""
    return list(result) if isinstance(result, tuple) else [result]


# Quantities of a state, a ball or a rotation; `kernel` wraps the others.
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


@np.errstate(over="ignore", under="ignore", invalid="ignore")  # of numbers that are refused
def momentum_in_range(ball: Ball, omega: Floats, gamma: Floats, epsilon: float) -> Floats:
    """K = Λω - D⟨ω,γ⟩γ; raises BadInput if float64 loses digits of K or 𝒦 = εK."""
    K = contact_momentum(omega, gamma, ball.mass_tensor, ball.D)
    for name, vectors in (("K = Λω - D⟨ω,γ⟩γ", K), ("𝒦 = εK", epsilon * K)):
        size = np.abs(vectors).max(axis=-1)
        if not np.isfinite(size).all():
            raise BadInput(f"{name} is beyond the range of float64, about 1.8e308; take other units of time or mass")
        if ((size < SMALLEST) & omega.any(axis=-1) & (ball.inertia > 0).all(axis=-1)).any():
            raise BadInput(f"{name} is below the range of float64, about 2.2e-308; take other units of time or mass")
    return K


@np.errstate(over="ignore", under="ignore")
def kinetic_energy(K: Floats, gamma: Floats, J: Floats, D: Floats) -> Floats:
    """`energy`, computed with K and moments near 1: squares of momenta may be beyond float64 where it is not."""
    if K.dtype == object:
        return energy(K, gamma, J, D)
    up, down = np.frexp(np.abs(K).max(axis=-1))[1], np.frexp(largest_moment(J, D))[1]
    unit = energy(np.ldexp(K, -up[..., np.newaxis]), gamma, np.ldexp(J, -down[..., np.newaxis]), np.ldexp(D, -down))
    return np.asarray(np.ldexp(unit, 2 * up - down))
