"""The first guess of a step at a high precision: the rotation by the continuation, in float64 or in mpmath's numbers.

The branch is selected in float64 if possible.  If float64 may fail, by the range of its exponents or because D is large
relative to J, the same continuation, from the text of `branch`, runs on numbers with enough digits.
"""

import math
from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np

from chapsym.rationals import decimals, exact_fraction

from ..errors import Status, StepNotTaken, explain
from ..loops import branch, vectors
from ..loops.twins import twin

Exact = Sequence[Fraction]

#: float64 is not used for a larger ratio of the moments of inertia, or a momentum outside this range.
STIFF, TINY, HUGE = 1e8, 2.0**-900, 2.0**10
#: The least exponent of a moment relative to the largest: smaller numbers of float64 have fewer bits.
LEAST_EXPONENT = -1000
#: The digits of the continuation beyond twice those that the ratio of the moments costs.
DIGITS = 40


def start(K: Exact, g: Exact, J: Exact, D: Fraction) -> tuple[Fraction, ...]:
    """The rotation of the small-rotation branch, to 16 digits or more; raises StepNotTaken as `step` does."""
    moments = (J[1] + J[2], J[0] + J[2], J[0] + J[1])
    scale = Fraction(2) ** -exponent_of(max(moments) + D)
    J, D, K = [x * scale for x in J], D * scale, [x * scale for x in K]
    factor = Fraction(1)
    if (largest := max(map(abs, K))) > HUGE:  # no rotation has such a momentum; it would overflow in floats
        factor = Fraction(2) ** (10 - exponent_of(largest))
        K = [x * factor for x in K]
    least = min((x for x in moments if x > 0), default=Fraction(1)) * scale
    stiff = largest * factor < TINY or least * Fraction(STIFF) < 1
    length = math.hypot(*map(float, g))
    floats = [[float(x) for x in v] for v in (K, (float(x) / length for x in g), J, (D,))]
    if not stiff:
        status, reach, *q = branch.small_rotation(*floats[0], *floats[1], *floats[2], *floats[3])
        if status == Status.TAKEN:
            return tuple(map(Fraction, q))
    status, reach, q = _on_numbers(K, g, J, D, math.ceil(2 * (exponent_of(1 / least) * math.log10(2) + 1)) + DIGITS)
    if status == Status.TAKEN and factor == 1:
        return tuple(q)
    k, g_unit, tensor = (np.array(x) for x in floats[:3])
    why = explain(int(status), k, g_unit, tensor, float(D)) if status else Status.UNREACHABLE
    raise StepNotTaken(why, float(reach * factor))


def magnitude(J: Exact, D: Fraction) -> tuple[int, int]:
    """An exponent with Λmax about 2^exponent, and the bits that the least moment of inertia that is not 0 can cost."""
    shift = exponent_of(max(*J, D))
    unit = Fraction(2) ** shift
    a, b, c, contact = (float(x / unit) for x in (*J, D))
    top = max(b + c, a + c, a + b) + contact
    least = min(x for x in (J[1] + J[2], J[0] + J[2], J[0] + J[1]) if x > 0) / unit
    within = exponent_of(least) > LEAST_EXPONENT
    lost = math.ceil(math.log2(top / float(least))) if within else 3 - exponent_of(least)
    return math.frexp(top)[1] + shift, max(0, lost)


def fraction(x: object) -> Fraction:
    """A number of any precision as an exact fraction; the midpoint of a ball."""
    if hasattr(x, "mid"):
        man, exp = map(int, x.mid().man_exp())
        return Fraction(man << max(exp, 0), 1 << max(-exp, 0))
    return exact_fraction(x)


def least(x: Any, y: Any, z: Any) -> tuple[Any, Any, Any, Any]:
    """A quaternion, of any length, of the least rotation that turns (x, y, z) to the vertical, as `attitude_with`."""
    flat = x * x + y * y
    zero = 0 * flat
    if flat == 0 and z < 0:
        return zero, 1 + zero, zero, zero
    return (1 + z if z > 0 else flat / (1 - z)), y, -x, zero


def exponent_of(x: Fraction) -> int:
    """An exponent e with |x| < 2^e, and |x| ≥ 2^(e-2), of a fraction that is not 0."""
    return x.numerator.bit_length() - x.denominator.bit_length() + 1


def decade(x: Fraction) -> int:
    """The exponent n with 10ⁿ ≤ |x| < 10ⁿ⁺¹ of a fraction that is not 0."""
    return decimals(3).divide(x.numerator, x.denominator).adjusted()


def _on_numbers(K: Exact, g: Exact, J: Exact, D: Fraction, digits: int) -> tuple[int, Fraction, list[Fraction]]:
    """`branch.small_rotation` with this many digits: (status, reach, rotation)."""
    import mpmath

    context = mpmath.MPContext()
    context.dps = digits
    values = [[context.mpf(x.numerator) / x.denominator for x in v] for v in (K, g, J, (D,))]
    length = context.sqrt(sum(x * x for x in values[1]))
    values[1] = [x / length for x in values[1]]
    K, g, J, (D,) = values
    status, reach, q = on(context)(K, g, J, D)
    return status, fraction(reach), list(map(fraction, q))


def on(context: Any) -> Callable[..., tuple]:
    """`branch.continued` in the numbers of an mpmath context, with its own limits."""
    unit = context.ldexp(1, -context.prec)
    shifted = twin(vectors, context.mpf, ldexp=context.ldexp)["shifted"]
    names = twin(
        branch, context.mpf, frexp=context.frexp, ldexp=context.ldexp, sqrt=context.sqrt, shifted=shifted,
        UNIT_ROUNDOFF=unit, SMALLEST=0, LEAST=-math.inf, SINGULAR=unit * 8,
    )  # fmt: skip
    return partial(names["continued"], shortest=8 * unit)  # a shorter step means a fold
