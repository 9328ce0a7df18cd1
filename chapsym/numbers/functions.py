"""sin, cos, sqrt and π in the numbers of every precision, for generated kernels with these functions.

The errors, in roundings u of the type of the argument, for arguments up to 1e5 (measured by `tests/numbers`):

============================  =============  =====================  ======
numbers                       sqrt           sin, cos               pi
============================  =============  =====================  ======
float, float64                1              2                      1
float32                       1              4                      1
Pair, u = 2⁻¹⁰⁶                4              2                      2
mpmath's, of d digits         1              1                      1
Arb's balls                   they contain it, for every number in the argument
============================  =============  =====================  ======

A generated text passes all arguments of its kernel to a function, so that an integer among enclosures becomes one.  The
bound for the square root of a pair holds from 1e-285 on.

On arrays NumPy's sines and cosines may differ in the last bits from those of numbers; the text in C calls its
mathematics library.
"""

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np

from .pair import Pair
from .precisions import Digits

#: The digits for the sine of a pair: more than its 32; for large arguments mpmath adds more.
PAIR_DIGITS = 40


def sin(x: Any, *like: Any) -> Any:
    """The sine of x, in the widest of the types of x and `like`: float64, Pair, mpmath's numbers, Arb's balls.

    Raises
    ------
    TypeError
        For numbers without a sine, such as fractions.

    Examples
    --------
    >>> from chapsym import Digits
    >>> from chapsym.numbers.functions import sin
    >>> sin(0.5), str(sin(1, Digits(20).number(0)))[:12]
    (0.479425538604203, '0.8414709848')
    """
    return _applied("sin", _widened(x, like))


def cos(x: Any, *like: Any) -> Any:
    """The cosine of x, as `sin`."""
    return _applied("cos", _widened(x, like))


def sqrt(x: Any, *like: Any) -> Any:
    """The square root of x, as `sin`; below 0 as for the type: ValueError, NaN, or a complex number of mpmath."""
    return _applied("sqrt", _widened(x, like))


def pi(*like: Any) -> Any:
    """π in the widest of the types of `like`."""
    one = _widened(1, like)
    if isinstance(one, np.ndarray | np.generic):
        return _each(pi, one) if one.dtype == object else one.dtype.type(np.pi)
    if isinstance(one, Pair):
        return _pair(+Digits(PAIR_DIGITS).context.pi)
    if hasattr(one, "context"):
        return +one.context.pi
    return type(one).pi() if hasattr(type(one), "pi") else math.pi


def _widened(x: Any, like: Sequence[Any]) -> Any:
    """x in the widest of the types: for arrays their common type, with integers as float64."""
    arrays = [y for y in (x, *like) if isinstance(y, np.ndarray | np.generic)]
    if arrays and not any(y.dtype == object for y in arrays):
        others = [y for y in like if not isinstance(y, np.ndarray | np.generic)]
        if all(isinstance(y, float | int) for y in others):
            floats = [np.dtype(float) if y.dtype.kind in "biu" else y.dtype for y in arrays]
            return np.asarray(x, np.result_type(*floats))[()]
    widest = max((x, *like), key=_width)
    if _width(widest) <= _width(x):
        return x
    if isinstance(x, np.ndarray) or isinstance(widest, np.ndarray):
        return np.frompyfunc(lambda one, other: _widened(one, [other]), 2, 1)(x, widest)
    if isinstance(widest, Pair):
        return Pair(x) if not isinstance(x, int) else Pair.of(x)
    return widest.context.mpf(x) if hasattr(widest, "context") else type(widest)(x)


def _width(x: Any) -> int:
    if isinstance(x, np.ndarray):
        return 4 if x.dtype == object else 0
    if isinstance(x, int | float | np.generic):
        return 0
    if isinstance(x, Pair) or hasattr(x, "context") or hasattr(x, "rad"):
        return 1 if isinstance(x, Pair) else 2 if hasattr(x, "context") else 3
    raise TypeError(f"a {type(x).__name__} has no sines and roots among its kind: give floats or a precision's")


def _applied(name: str, x: Any) -> Any:
    if isinstance(x, np.ndarray | np.generic):
        return _each(lambda one: _applied(name, one), x) if x.dtype == object else getattr(np, name)(x)
    if isinstance(x, Pair):
        if name == "sqrt" or not math.isfinite(x.high):
            return x.sqrt() if name == "sqrt" else Pair(math.nan)
        context = Digits(PAIR_DIGITS).context
        return _pair(getattr(context, name)(context.mpf(x.high) + context.mpf(x.low)))
    if hasattr(x, "context"):  # mpmath's
        return getattr(x.context, name)(x)
    if hasattr(x, name):  # Arb's
        return getattr(x, name)()
    return getattr(math, name)(x)


def _each(function: Any, array: Any) -> Any:
    """A function of the elements of an array of objects."""
    return np.frompyfunc(function, 1, 1)(array)


def _pair(x: Any) -> Pair:
    """The pair nearest to a number of mpmath."""
    from mpmath.libmp import to_rational  # takes 15 ms; only pairs need it

    return Pair.of(Fraction(*to_rational(x._mpf_)))
