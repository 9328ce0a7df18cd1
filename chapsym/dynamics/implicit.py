"""Equations F(x, known) = 0 as maps: the kernels of any register, solved for x in the numbers of every precision.

Newton's iteration finds a root near a guess, which selects the branch.  In enclosures the interval Newton test proves
the root.
"""

import math
from collections.abc import Callable, Sequence
from decimal import Decimal
from fractions import Fraction
from numbers import Rational
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import Double, Enclosure, Precision, Single, is_a

from .ball import brief, common_shape, numbers
from .errors import BadInput
from .kernels import Function, Row, parts_of
from .levels.dispatch import precision_of

#: Numbers of one precision.
Vector = Sequence[Any]

MOST_ROUNDS = 100
#: The largest size of the last correction, in roundings of x.
LAST = 4
#: Corrections stagnate at this fraction of the one before or above; after this number of rounds a correction below this
#: power of the unit is noise.
STAYS, ROUNDS, NEARLY = 0.75, 3, 0.6
#: Digits that the last correction in many digits may lack of those that Newton's iteration doubles.
LOST = 4


def implicit_step(residual: Row, jacobian: Row, then: Row | None = None) -> Callable[..., Any]:
    """The map that solves the equations of a generated kernel, for one point or for many.

    Parameters
    ----------
    residual : tuple
        A row of the TABLE of a generated package, for F: its first group of arguments are the n unknowns, the others
        are known; it returns n numbers.
    jacobian : tuple
        A row with the same groups, for the derivatives of F by the unknowns, row by row.
    then : tuple, optional
        A row whose groups are among these, for quantities that follow from the root.

    Returns
    -------
    callable
        ``step(guess, *known, precision="double")``: the arguments are arrays (..., k) for groups of k numbers, whose
        leading axes broadcast.  It returns the roots (..., n), and the results of `then` if it is given; in
        double-double, ``Digits(n)`` and ``Enclosure(bits)`` these are arrays of such numbers, which are accepted as
        arguments, too.  For all known numbers in their enclosures, an enclosure contains a root, the only one in a box
        round it: this is proved, if the second kernel is the derivative of the first, as a kernel made by
        `Carrier.along` is.  Other numbers are as near to a root as rounding allows, which is not near for two roots
        that nearly coincide.

    Raises
    ------
    BadInput
        If the kernels do not fit together, and, in a call, if the arrays do not fit, if the iteration does not
        converge, or if a root is not proved.  An error that a kernel raises itself is not changed.

    Examples
    --------
    >>> from chapsym import Enclosure, implicit_step
    >>> def square(x, a):
    ...     return x * x - a
    >>> def slope(x, a):
    ...     return 2 * x
    >>> root = implicit_step((square, (("x", 1), ("a", 1)), ()), (slope, (("x", 1), ("a", 1)), ()))
    >>> root([[1.0], [-1.0]], [2.0]).round(12).tolist()
    [[1.414213562373], [-1.414213562373]]
    >>> print(root([1.0], [2], precision=Enclosure(90))[0].str(20))
    [1.4142135623730950488 +/- ...]
    """
    for name, row in (("residual", residual), ("jacobian", jacobian), ("then", then)):
        if not (_is_row(row) or (row is None and name == "then")):
            raise BadInput(f"{name} must be a row of a generated TABLE: (function, ((name, size), ...), shape)")
    groups = residual[1]
    size = groups[0][1]
    if jacobian[1] != groups:
        raise BadInput(f"{_name(jacobian[0])} must have the groups of {_name(residual[0])}: {_listed(groups)}")
    for row, count in ((residual, size), (jacobian, size * size)):
        if math.prod(row[2]) != count:
            raise BadInput(f"{_name(row[0])} must return {count} numbers for {size} unknowns, not the shape {row[2]}")
    if then is not None and not set(then[1]) <= set(groups):
        others = f"those of {_name(residual[0])}: {_listed(groups)}"
        raise BadInput(f"the groups of {_name(then[0])} must be among {others}")
    system = Equations(residual[0], jacobian[0], size)

    def step(guess: ArrayLike, *known: ArrayLike, precision: str | Precision = "double") -> Any:
        level = precision_of(precision)
        if len(known) != len(groups) - 1:
            raise BadInput(f"{_name(residual[0])} takes {len(groups)} arrays, {_listed(groups)}, not {len(known) + 1}")
        given = [_array(value, *group) for value, group in zip((guess, *known), groups, strict=True)]
        leading = common_shape([array.shape[:-1] for array in given], "the arrays")
        rows, names = math.prod(leading), [name for name, _ in groups]
        flat = [np.broadcast_to(x, (*leading, x.shape[-1])).reshape(rows, x.shape[-1]) for x in given]
        with level.working():
            if isinstance(level, Single | Double):
                flat = [_floats(array, level.dtype, name) for array, name in zip(flat, names, strict=True)]
                flat[0] = system.in_floats(flat[0], flat[1:])
            else:
                first, *others = (_floats(x, np.dtype(float), name) for x, name in zip(flat, names, strict=True))
                start = system.in_floats(first, others)
                exact = [_exact(array, level, name) for array, name in zip(flat[1:], names[1:], strict=True)]
                flat = [np.empty((rows, size), dtype=object), *exact]
                for i in range(rows):
                    flat[0][i] = system.at_level(start[i], [value for array in exact for value in array[i]], level, i)
            root = flat[0].reshape(*leading, size)
            if then is None:
                return root
            by_name = dict(zip(names, flat, strict=True))
            found = _followed(then[0], [by_name[name] for name, _ in then[1]], math.prod(then[2]))
            return root, found.reshape((*leading, *then[2]))

    return step


class Equations(NamedTuple):
    """F, its derivatives by the unknowns row by row, the number of unknowns, and a least size of x."""

    function: Function
    slope: Function
    size: int
    least: float = 0.0

    @np.errstate(all="ignore")  # an overflow does not converge
    def in_floats(self, x: np.ndarray, known: Sequence[np.ndarray]) -> np.ndarray:
        """The roots near points x (N, n), each with its own corrections; raises BadInput if they do not converge.

        `scale` is the change of a correction by a rounding of x.  A correction is the last one if it is not larger for
        any unknown, or if it no longer shrinks and is not much larger.
        """
        x, left = x.copy(), np.arange(len(x))
        unit = np.finfo(x.dtype).eps
        before, stays = np.full(x.shape, np.inf), np.zeros(x.shape, dtype=int)
        for _ in range(MOST_ROUNDS):
            if not len(left):
                break
            given = [array[left] for array in (x, *known)]
            value = _values(self.function, given, self.size)
            slope = _values(self.slope, given, self.size**2).reshape(-1, self.size, self.size)
            regular = np.isfinite(slope).all(axis=(1, 2)) & np.isfinite(value).all(axis=1)
            regular[regular] &= np.linalg.slogdet(slope[regular])[0] != 0
            if not regular.all():
                raise _unsettled(int(left[~regular][0]))
            inverse = np.linalg.inv(slope)
            change = np.abs(step := (inverse @ value[..., None])[..., 0])
            if not np.isfinite(step).all():
                raise _unsettled(int(left[~np.isfinite(step).all(axis=1)][0]))
            scale = (np.abs(inverse) @ np.abs(slope) @ np.abs(x[left])[..., None])[..., 0]
            x[left] -= step
            stays[left] = np.where(change >= STAYS * before[left], stays[left] + 1, 0)
            before[left] = change
            settled = (change <= LAST * unit * scale) | ((stays[left] >= ROUNDS) & (change <= unit**NEARLY * scale))
            left = left[~settled.all(axis=1)]
        if len(left):
            raise _unsettled(int(left[0]))
        return x

    def at_level(self, start: Vector, known: Vector, level: Precision, index: int = 0) -> Vector:
        """The root near a float64 root, at a precision."""
        # In enclosures a point near a root is found first.
        point = (lambda v: v.mid()) if isinstance(level, Enclosure) else (lambda v: v)
        middle = [point(value) for value in known]
        few = level.number(Fraction(1, 10 ** (level.digits // 2 + 1)))
        last, end = False, few * few * 10**LOST
        try:
            x = [level.number(Fraction(float(value))) for value in start]
            for _ in range(MOST_ROUNDS):
                correction, scale = self._correction(x, middle)
                change = [point(value) for value in correction]
                size = [level.number(Fraction(float(value))) for value in scale]
                x = [point(a - b) for a, b in zip(x, change, strict=True)]
                if last:
                    break
                last = all(abs(c) <= few * s for c, s in zip(change, size, strict=True))
            last = last and all(abs(c) <= end * s for c, s in zip(change, size, strict=True))
        except (ArithmeticError, TypeError, ValueError):  # singular, beyond the numbers, or a complex root of mpmath
            last = False
        if last:
            return self._enclosed(x, known) if isinstance(level, Enclosure) else x
        raise BadInput(f"number {index} does not settle: the root is nearly singular, or more digits are needed")

    def _correction(self, x: Vector, known: Vector) -> tuple[Vector, np.ndarray]:
        """A correction of x, and its change by a relative change of x, at least |x|."""
        zero = 0 * x[0]  # a quotient of whole numbers would be a float
        value, slope = ([zero + e for e in parts_of(of(*x, *known))] for of in (self.function, self.slope))
        rows = [slope[i * self.size : (i + 1) * self.size] for i in range(self.size)]
        table = np.array(rows, float)
        sizes = np.abs(np.array(x, float)) + self.least
        return solved(rows, value), np.abs(np.linalg.inv(table)) @ np.abs(table) @ sizes

    def _enclosed(self, x: Vector, known: Vector) -> Vector:
        """The root near a point, in balls; raises BadInput if it is not proved to be a root, the only one near by."""
        from .levels.proved_root import isolated  # takes 40 ms with flint; float64 does not need it

        def slope(box: Vector) -> Vector:
            return parts_of(self.slope(*(a + b for a, b in zip(x, box, strict=True)), *known))

        if (image := isolated(parts_of(self.function(*x, *known)), slope)) is None:
            raise BadInput("a root is not proved here: more bits are needed, or it is singular")
        return [a + b for a, b in zip(x, image, strict=True)]


def solved(rows: Sequence[Vector], right: Vector) -> Vector:
    """The solution of a linear system, by elimination with the largest pivots; ZeroDivisionError if one is 0."""
    table, size = [[*row, value] for row, value in zip(rows, right, strict=True)], len(rows)
    for i in range(size):
        best = max(range(i, size), key=lambda n: abs(float(table[n][i])))
        table[i], table[best] = table[best], table[i]
        if table[i][i] == 0:
            raise ZeroDivisionError
        for n in range(i + 1, size):
            factor = table[n][i] / table[i][i]
            table[n] = [a - factor * b for a, b in zip(table[n], table[i], strict=True)]
    found: list[Any] = [None] * size
    for i in reversed(range(size)):
        known = sum((table[i][n] * found[n] for n in range(i + 1, size)), start=0 * table[i][i])
        found[i] = (table[i][size] - known) / table[i][i]
    return found


def _followed(function: Function, arrays: Sequence[np.ndarray], count: int) -> np.ndarray:
    """The results (N, count) of a function at the rows of arrays; raises BadInput if it is not defined there."""
    try:
        with np.errstate(all="ignore"):
            found = _values(function, arrays, count)
        # Numbers without `is_finite` raise on a division by 0; Arb's balls do not.
        whole = found.dtype != object and np.isfinite(found).all()
        if whole or (found.dtype == object and all(getattr(x, "is_finite", lambda: True)() for x in found.flat)):
            return found
    except ZeroDivisionError:
        pass
    raise BadInput(f"{_name(function)} is not defined at a root: it divides by 0 there, or is beyond the range")


def _array(value: ArrayLike, name: str, size: int) -> np.ndarray:
    """The numbers of a group, along the last axis: floats, or unchanged if exact or of another precision."""
    try:
        array = np.asarray(value)
    except Exception:  # rows of different length, and whatever an object raises
        return numbers(value, name, size)
    if array.dtype.kind not in "iuO" or array.shape[-1:] != (size,):
        return numbers(value, name, size)
    made = np.empty(array.shape, dtype=object)
    for where, one in np.ndenumerate(array):
        if isinstance(one, bool | complex | np.complexfloating | np.timedelta64 | np.ndarray | str) or one is None:
            raise BadInput(f"{name} must have numbers, not {brief(one)}")
        try:
            made[where] = _exactly(one)
        except (OverflowError, ValueError):
            raise BadInput(f"{name} must be finite, but it has {brief(one)}") from None
        except Exception:  # of an object, whatever it raises
            raise BadInput(f"{name} must have numbers, not {brief(one)}") from None
    return made


def _exactly(one: object) -> object:
    """A rational number as a fraction; a number of another precision unchanged."""
    if isinstance(one, Rational):
        return Fraction(int(one.numerator), int(one.denominator))
    if isinstance(one, float | np.floating):
        return Fraction(float(one))
    return Fraction(one) if isinstance(one, Decimal) else one


def _floats(array: np.ndarray, dtype: np.dtype, name: str) -> np.ndarray:
    try:
        with np.errstate(over="ignore", under="ignore"):
            made: np.ndarray = array.astype(float).astype(dtype)
    except OverflowError:
        raise BadInput(f"{name} is beyond the range of float64, about 1.8e308") from None
    except Exception:  # of objects, whatever they raise
        raise BadInput(f"{name} has something else than real numbers") from None
    if not np.isfinite(made).all():
        raise BadInput(f"{name} is beyond the range of {dtype.name}, about {np.finfo(dtype).max:.2g}")
    return made


def _exact(array: np.ndarray, level: Precision, name: str) -> np.ndarray:
    """The same numbers at a precision; numbers of this precision are unchanged."""
    made, kind = np.empty(array.shape, dtype=object), type(level.number(Fraction(0)))
    for where, value in np.ndenumerate(array):
        if isinstance(value, float | Fraction):
            made[where] = level.number(Fraction(value))
        elif isinstance(value, kind):
            made[where] = value
        else:
            raise BadInput(f"{name} has a {type(value).__name__}, which is no number of {level}")
    return made


def _values(function: Function, arrays: Sequence[np.ndarray], count: int) -> np.ndarray:
    """The results (N, count) of a function at the rows of some arrays; raises BadInput for other results."""
    rows = len(arrays[0])
    parts = parts_of(function(*(array[:, i] for array in arrays for i in range(array.shape[1]))))
    kinds = "fiu" if arrays[0].dtype != object else "fiuO"
    try:
        found = np.stack([np.broadcast_to(part, rows) for part in parts], axis=-1)
    except ValueError:
        found = np.empty((rows, 0))
    if found.shape[1] != count or found.dtype.kind not in kinds:
        raise BadInput(f"{_name(function)} does not return {count} real numbers")
    return found


def _is_row(row: object) -> bool:
    """Whether this is a function, its groups of arguments with their sizes, and the shape of its result."""
    if not (is_a(row, tuple) and len(row) == 3 and callable(row[0])):
        return False
    groups, shape = row[1:]
    if not (is_a(groups, tuple) and groups and is_a(shape, tuple)):
        return False
    if not all(is_a(one, tuple) and len(one) == 2 and is_a(one[0], str) for one in groups):
        return False
    counted = all(type(count) is int and count > 0 for count in (*(size for _, size in groups), *shape))
    return counted and len({name for name, _ in groups}) == len(groups)


def _name(function: Function) -> str:
    return getattr(function, "__name__", brief(function))


def _listed(groups: Sequence[tuple[str, int]]) -> str:
    return ", ".join(f"{name} ({size})" for name, size in groups)


def _unsettled(index: int) -> BadInput:
    return BadInput(
        f"Newton's iteration does not settle for number {index}: give a guess nearer to a root, if there "
        "is one, at which the derivatives are not singular"
    )
