"""Equations F(x, known) = 0 as maps: the kernels of any register, solved for x in the numbers of every precision.

Newton's iteration finds a root near a guess, which says the branch.  In enclosures the interval Newton test proves it.
"""

from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import Double, Enclosure, Precision, Single, named

from .ball import numbers
from .errors import BadInput
from .kernels import Row

Vector = Sequence[Any]

MOST_ROUNDS = 60
#: Units in the last place of the largest unknown that the last correction may have.
LAST = 4


def implicit_step(residual: Row, jacobian: Row, then: Row | None = None) -> Callable[..., Any]:
    """The map that solves the equations of a generated kernel, for one or for many.

    Parameters
    ----------
    residual : tuple
        A row of the TABLE of a generated package: its first group of arguments are the n unknowns, the others are
        known; it returns what vanishes, n numbers.
    jacobian : tuple
        Another, with the same groups: the derivatives of the first by the unknowns, row by row.
    then : tuple, optional
        Another, whose groups are among these: what follows from the root.

    Returns
    -------
    callable
        ``step(guess, *known, precision="double")``: arrays (..., k) for a group of k numbers, whose leading axes
        broadcast.  It gives the roots (..., n), and what follows from them where `then` is given; in double-double,
        ``Digits(n)`` and ``Enclosure(bits)`` as arrays of such numbers, which it takes, too.  An enclosure contains
        a root, the only one in a box round it, for all known numbers in theirs: this is proved.

    Raises
    ------
    BadInput
        If the kernels do not fit together, or, from a call, if the arrays do not fit, if the iteration from a guess
        does not settle, or if a root is not proved.

    Examples
    --------
    >>> from chapsym import Enclosure, implicit_step
    >>> def square(x, a):
    ...     return x * x - a
    >>> def slope(x, a):
    ...     return 2 * x
    >>> root = implicit_step((square, (("x", 1), ("a", 1)), ()), (slope, (("x", 1), ("a", 1)), ()))
    >>> root([[1.0], [-1.0]], [2.0]).tolist()
    [[1.4142135623730951], [-1.4142135623730951]]
    >>> print(root([1.0], [2], precision=Enclosure(90))[0].str(20))
    [1.4142135623730950488 +/- ...]
    """
    groups = residual[1]
    size = groups[0][1]
    if jacobian[1] != groups:
        raise BadInput(f"{jacobian[0].__name__} must have the groups of {residual[0].__name__}: {_listed(groups)}")
    for row, count in ((residual, size), (jacobian, size * size)):
        if int(np.prod(row[2])) != count:
            raise BadInput(f"{row[0].__name__} must return {count} numbers for {size} unknowns, not the shape {row[2]}")
    if then is not None and not set(then[1]) <= set(groups):
        others = f"those of {residual[0].__name__}: {_listed(groups)}"
        raise BadInput(f"the groups of {then[0].__name__} must be among {others}")
    system = _System(residual[0], jacobian[0], size)

    def step(guess: ArrayLike, *known: ArrayLike, precision: str | Precision = "double") -> Any:
        level = named(precision)
        if len(known) != len(groups) - 1:
            raise BadInput(
                f"{residual[0].__name__} takes {len(groups)} arrays, {_listed(groups)}, not {len(known) + 1}"
            )
        given = [_array(value, *group) for value, group in zip((guess, *known), groups, strict=True)]
        try:
            leading = np.broadcast_shapes(*(array.shape[:-1] for array in given))
        except ValueError:
            shapes = ", ".join(str(array.shape) for array in given)
            raise BadInput(f"the leading axes of the arrays do not broadcast: {shapes}") from None
        flat = [np.broadcast_to(array, (*leading, array.shape[-1])).reshape(-1, array.shape[-1]) for array in given]
        with level.working():
            if isinstance(level, Single | Double):
                flat = [_floats(array, level.dtype) for array in flat]
                flat[0] = system.in_floats(flat[0], flat[1:])
            else:
                first, *others = (_floats(array, np.dtype(float)) for array in flat)
                start = system.in_floats(first, others)
                flat = [start, *(_exact(array, level) for array in flat[1:])]
                flat[0] = np.array([system.at_level(*row, level) for row in zip(*flat, strict=True)], dtype=object)
            root = flat[0].reshape(*leading, size)
            if then is None:
                return root
            by_name = {name: array for (name, _), array in zip(groups, flat, strict=True)}
            found = _values(then[0], [by_name[name] for name, _ in then[1]])
            return root, np.stack(found, axis=-1).reshape(*leading, *then[2])

    return step


class _System(NamedTuple):
    """What vanishes, its derivatives by the unknowns row by row, and how many unknowns there are."""

    function: Callable[..., Any]
    slope: Callable[..., Any]
    size: int

    def in_floats(self, x: np.ndarray, known: Sequence[np.ndarray]) -> np.ndarray:
        """The roots near points x (N, n), each by corrections of its own; raises BadInput where they do not settle."""
        x = x.copy()
        unit, left, before = np.finfo(x.dtype).eps, np.arange(len(x)), np.full(len(x), np.inf)
        for _ in range(MOST_ROUNDS):
            here = [x[left], *(array[left] for array in known)]
            with np.errstate(all="ignore"):
                value = np.stack(_values(self.function, here), axis=-1)
                slope = np.stack(_values(self.slope, here), axis=-1).reshape(-1, self.size, self.size)
                regular = np.isfinite(slope).all(axis=(1, 2)) & np.isfinite(value).all(axis=1)
                regular[regular] &= np.linalg.det(slope[regular]) != 0
                if not regular.all():
                    raise _unsettled(int(left[~regular][0]))
                change = np.linalg.solve(slope, value[..., None])[..., 0]
            x[left] -= change
            length, scale = np.abs(change).max(axis=1), np.abs(x[left]).max(axis=1)
            stalls = (length >= before[left] / 2) & (length <= np.sqrt(unit) * scale)
            before[left] = length
            left = left[~((length <= LAST * unit * scale) | stalls)]
            if not len(left):
                return x
        raise _unsettled(int(left[0]))

    def at_level(self, start: np.ndarray, *rest: Any) -> list[Any]:
        """The root near a float64 root, in the numbers of a precision, the last argument; the others are known."""
        *arrays, level = rest
        known = [value for array in arrays for value in array]
        # A point near a root is found, which is enclosed then.
        point = (lambda v: v.mid()) if isinstance(level, Enclosure) else (lambda v: v)
        middle = [point(value) for value in known]
        x, last = [level.number(Fraction(float(value))) for value in start], False
        few = level.number(Fraction(1, 10 ** (level.digits // 2 + 1)))
        for _ in range(MOST_ROUNDS):
            change = [point(value) for value in self._correction(x, middle)]
            x = [point(a - b) for a, b in zip(x, change, strict=True)]
            if last:
                break
            last = max(map(abs, change)) <= few * max(map(abs, x))
        else:
            raise BadInput("the iteration does not settle: the root is singular, or more digits are needed")
        return self._enclosed(x, known) if isinstance(level, Enclosure) else x

    def _enclosed(self, x: list[Any], known: list[Any]) -> list[Any]:
        """The root near a point, in balls; raises BadInput if it is not proved to be one, and the only one near it."""
        from .levels.newton import isolated  # 40 ms with flint, which who runs on float64 need not wait for

        def slope(box: Sequence[Any]) -> list[Any]:
            return _parts(self.slope(*(a + b for a, b in zip(x, box, strict=True)), *known))

        image = isolated(_parts(self.function(*x, *known)), slope)
        if image is None:
            raise BadInput("a root is not proved here: more bits are needed, or it is singular")
        return [a + b for a, b in zip(x, image, strict=True)]

    def _correction(self, x: list[Any], known: list[Any]) -> list[Any]:
        slope, value = _parts(self.slope(*x, *known)), _parts(self.function(*x, *known))
        return _solved([slope[i * self.size : (i + 1) * self.size] for i in range(self.size)], value)


def _solved(rows: list[Vector], right: Vector) -> list[Any]:
    """The solution of a linear system, by elimination with the largest pivots, in any numbers."""
    table, size = [[*row, value] for row, value in zip(rows, right, strict=True)], len(rows)
    for i in range(size):
        best = max(range(i, size), key=lambda n: abs(float(table[n][i])))
        table[i], table[best] = table[best], table[i]
        if table[i][i] == 0:
            raise BadInput("the derivatives are singular at a point of the iteration: no correction is found there")
        for n in range(i + 1, size):
            factor = table[n][i] / table[i][i]
            table[n] = [a - factor * b for a, b in zip(table[n], table[i], strict=True)]
    found: list[Any] = [None] * size
    for i in reversed(range(size)):
        known = sum((table[i][n] * found[n] for n in range(i + 1, size)), start=0 * table[i][i])
        found[i] = (table[i][size] - known) / table[i][i]
    return found


def _array(value: ArrayLike, name: str, size: int) -> np.ndarray:
    """The numbers of a group, along the last axis: floats, or as they are where they are of another precision."""
    array = np.asarray(value)
    if array.dtype == object and array.shape[-1:] == (size,):
        return array
    return numbers(value, name, size)


def _floats(array: np.ndarray, dtype: np.dtype) -> np.ndarray:
    return array.astype(float).astype(dtype)


def _exact(array: np.ndarray, level: Precision) -> np.ndarray:
    """The same numbers in a precision; those that are in it already stay."""
    made = np.empty(array.shape, dtype=object)
    for where, value in np.ndenumerate(array):
        rational = isinstance(value, int | float | Fraction)
        made[where] = level.number(Fraction(value)) if rational else value
    return made


def _values(function: Callable[..., Any], arrays: Sequence[np.ndarray]) -> list[np.ndarray]:
    """The results of a function at the rows of some arrays."""
    rows = len(arrays[0])
    parts = _parts(function(*(array[:, i] for array in arrays for i in range(array.shape[1]))))
    return [np.broadcast_to(part, rows) for part in parts]


def _parts(result: Any) -> list[Any]:
    return list(result) if isinstance(result, tuple) else [result]


def _listed(groups: Sequence[tuple[str, int]]) -> str:
    return ", ".join(f"{name} ({size})" for name, size in groups)


def _unsettled(index: int) -> BadInput:
    return BadInput(
        f"Newton's iteration does not settle for number {index}: give a guess nearer to a root, if there "
        "is one, at which the derivatives are not singular"
    )
