"""Exact numbers as input: what is checked of them, and what of them floats do not hold."""

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import Precision

from .ball import Ball, Floats
from .errors import BadInput
from .levels.start import exponent_of


def check_body(J: Sequence[Fraction], D: Fraction) -> None:
    """Raises BadInput unless a body has these moments; as `Ball` does, but of any size."""
    largest = max(map(abs, (*J, D)))
    scale = Fraction(1)
    if largest and not 1e-300 < largest < 1e300:
        scale = Fraction(2) ** -exponent_of(largest)
    # What is far smaller than the rest must not become 0: it is the difference between a body and none.
    Ball([_at_least(x * scale) for x in J], _at_least(D * scale))


def check_tensor(rows: Sequence[Sequence[Fraction]], D: Fraction) -> tuple[Any, ...]:
    """A tensor ∫xxᵀdm by rows, or its diagonal if it has nothing else; raises BadInput for that of no body."""
    if any(rows[i][j] != rows[j][i] for i in range(3) for j in range(i)):
        raise BadInput("mass_tensor must be symmetric: give the two entries of each pair alike")
    diagonal = tuple(rows[i][i] for i in range(3))
    check_body(diagonal, D)
    if not any(rows[i][j] for i in range(3) for j in range(i)):
        return diagonal
    (a, d, e), (_, b, f), (_, _, c) = rows
    whole = a * b * c + 2 * d * e * f - a * f * f - b * e * e - c * d * d
    if min(a * b - d * d, a * c - e * e, b * c - f * f, whole) < 0:
        raise BadInput("no body has this mass_tensor: the second moment of the mass is negative along some axis")
    return tuple(map(tuple, rows))


def _at_least(x: Fraction) -> float:
    return float(x) if not x or abs(x) > 1e-300 else math.copysign(1e-300, x)


def in_float64(*vectors: Sequence[Fraction]) -> list[float]:
    """All components as floats; raises BadInput for one that is too large."""
    try:
        return [float(x) for vector in vectors for x in vector]
    except OverflowError:
        raise BadInput("a number of the input is beyond the range of float64, where every step starts") from None


def unit_exactly(gamma: Sequence[Fraction], precision: Precision) -> None:
    """Raises BadInput unless |γ|² = 1 to the digits of the precision."""
    off = abs(sum((x * x for x in gamma), Fraction(-1)))
    shown = f"{float(off):.2g}" if off < 10**300 else "more than 1e300"
    if off > Fraction(1, 10**precision.digits):
        raise BadInput(
            f"gamma must be a unit vector to {precision.digits} digits, but |gamma|^2 is off 1 by {shown}; "
            "give it exactly, as rationals such as 2/7,3/7,6/7"
        )


def beyond_float64(momentum: ArrayLike, shape: tuple[int, ...]) -> Floats | None:
    """What a momentum of Fractions has beyond float64, (n, 3); None if there is nothing."""
    given = np.asarray(momentum)
    if given.dtype != object or not all(isinstance(x, Fraction) for x in given.flat):
        return None
    rest = np.array([float(x - Fraction(float(x))) for x in given.flat]).reshape(given.shape)
    return np.broadcast_to(rest, (*shape, 3)).reshape(-1, 3)
