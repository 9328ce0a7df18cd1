"""sin, cos, sqrt and π in the numbers of every precision: what generated kernels import where they have such letters.

Each is within these roundings u of the type of what it is given, at arguments up to 1e5 (`tests/numbers` measures it):

============================  =============  =====================  ======
numbers                       sqrt           sin, cos               pi
============================  =============  =====================  ======
float, float64                1              2                      1
float32                       1              4                      1
Pair, u = 2⁻¹⁰⁶                4              2                      2
mpmath's, of d digits         1              1                      1
Arb's balls                   they contain it, for every number in the argument
============================  =============  =====================  ======

On arrays NumPy has sines and cosines of its own, whose last bits may differ from those of numbers; the text in C calls
those of its mathematics library.
"""

import math
from fractions import Fraction
from typing import Any

import numpy as np

from .pair import Pair
from .precisions import Digits

#: Digits in which the sine of a pair is computed: more than its 32, and at large arguments mpmath takes more itself.
PAIR_DIGITS = 40


def sin(x: Any, like: Any = None) -> Any:
    """The sine of x; with `like`, of a whole number, in the numbers of that.

    Raises
    ------
    TypeError
        For numbers that have no sine among them, as fractions.

    Examples
    --------
    >>> from chapsym import Digits
    >>> from chapsym.numbers.functions import sin
    >>> sin(0.5), str(sin(1, Digits(20).number(0)))[:12]
    (0.479425538604203, '0.8414709848')
    """
    return _applied("sin", x, like)


def cos(x: Any, like: Any = None) -> Any:
    """The cosine of x, as `sin`."""
    return _applied("cos", x, like)


def sqrt(x: Any, like: Any = None) -> Any:
    """The square root of x, as `sin`; raises ValueError for a number below 0, and is NaN in an array."""
    return _applied("sqrt", x, like)


def pi(like: Any) -> Any:
    """π in the numbers of `like`."""
    if isinstance(like, np.ndarray | np.generic):
        return _each(pi, like) if like.dtype == object else np.result_type(like, np.float32).type(np.pi)
    if isinstance(like, Pair):
        return _pair(+Digits(PAIR_DIGITS).context.pi)
    if hasattr(like, "context"):
        return +like.context.pi
    return type(like).pi() if hasattr(type(like), "pi") else math.pi if _is_float(like, "pi") else None


def _applied(name: str, x: Any, like: Any) -> Any:
    if like is not None:
        x = x + 0 * like
    if isinstance(x, np.ndarray | np.generic):
        return _each(lambda one: _applied(name, one, None), x) if x.dtype == object else getattr(np, name)(x)
    if isinstance(x, Pair):
        return x.sqrt() if name == "sqrt" else _pair(getattr(context := Digits(PAIR_DIGITS).context, name)(
            context.mpf(x.high) + context.mpf(x.low)
        ))  # fmt: skip
    if hasattr(x, "context"):  # mpmath's
        return getattr(x.context, name)(x)
    if hasattr(x, name):  # Arb's
        return getattr(x, name)()
    return getattr(math, name)(x) if _is_float(x, name) else None


def _each(function: Any, array: Any) -> Any:
    """A function of the elements of an array of objects."""
    return np.frompyfunc(function, 1, 1)(array)


def _pair(x: Any) -> Pair:
    """The pair nearest to a number of mpmath."""
    from mpmath.libmp import to_rational  # 15 ms, which who has no pairs need not wait for

    return Pair.of(Fraction(*to_rational(x._mpf_)))


def _is_float(x: Any, name: str) -> bool:
    """Whether it is a float or a whole number; raises TypeError otherwise."""
    if isinstance(x, float | int):
        return True
    raise TypeError(f"{name} of a {type(x).__name__} is none: give floats, arrays, or numbers of a precision")
