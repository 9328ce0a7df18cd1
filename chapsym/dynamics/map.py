"""The map and its symmetric compositions: one step, of floats and of exact numbers, and what is checked of these."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import NAMED, Digits, Double, DoubleDouble, Pair, Precision, Single

from .ball import Ball
from .errors import BadInput
from .levels import dispatch
from .levels.frames import Balls, given
from .levels.start import exponent_of, fraction
from .results import Step, in_given_axes
from .trajectories import flag

#: The digits of a step of exact numbers that pairs cannot hold, before it is rounded to pairs.
BEYOND_DOUBLE_DOUBLE = Digits(40)


@in_given_axes
def step(
    ball: Ball, momentum: ArrayLike, gamma: ArrayLike, *, precision: str | Precision = "double", proved: bool = False
) -> Step:
    """One step of the map (5.3) on the small-rotation branch: the first step of `trajectory`, to the bit.

    Solves 𝒦(q, γ) = 𝒦 for the rotation Ω (5.2) that is continued from the identity, and carries
    𝒦 and γ to Ωᵀ𝒦 and Ωᵀγ.

    momentum: 𝒦 = ε K of the paper, in kg m², shape (..., 3); gamma: unit verticals upwards, (..., 3).
    Both broadcast with each other and with the balls.  Of a ball with axes they, and what is
    returned, are in these.
    precision: "single", "double", "double-double" (31 digits), `Digits(n)` (mpmath) or `Enclosure(bits)` (Arb).
    Floats that are given are taken as exact at every precision, and on `Digits` and `Enclosure` so are Fractions,
    Decimals and numbers of mpmath and SymPy, of the ball, too; but γ is divided by its length on all but "double".
    proved: whether `Step.proved` shall bound what the rotation, 𝒦 and γ are off by from the exact step: a proof by the
    residual at the rotation, whatever found it, with lemma `small-branch` and beyond its bound `straight-path`.  It is
    of "double" and principal axes, and inf where the lemmas do not reach, as near a fold.

    One ball (no leading axis) raises StepNotTaken if it has no step; a batch reports `status` instead.
    Raises BadInput for shapes, NaN, infinities, and a gamma that is not unit.
    """
    level = dispatch.precision_of(precision)
    _only_in_double(flag(proved, "proved"), level)
    return composed(ball, momentum, gamma, 2, level, bool(proved))


def _only_in_double(proved: bool, precision: Precision) -> None:
    if proved and not isinstance(precision, Double):
        raise BadInput(
            'a step is proved in "double"; in "double-double" take trajectory(..., 1, proved=True), '
            "and an Enclosure is proved as it is"
        )


@in_given_axes
def compose_step(ball: Ball, momentum: ArrayLike, gamma: ArrayLike, order: int) -> Step:
    """One step of the composition of order 2, 4, 6 or 8; arguments, result and errors as for `step`.

    All momentum integrals stay exact: every stage turns 𝒦 and γ by one rotation (lemma `momentum-integrals-composed`).
    `rotation` is the product of the rotations of the stages; where a stage is not taken, `reach` is the fraction of
    its momentum that the small-rotation branch attains.
    """
    return composed(ball, momentum, gamma, order, NAMED["double"])


def composed(
    ball: Ball, momentum: ArrayLike, gamma: ArrayLike, order: int, precision: Precision, proved: bool = False
) -> Step:
    """One step of the composition of any order; `proved` is for the map itself in float64."""
    shape, _, balls = given(ball, momentum, gamma, precision)
    return dispatch.step(precision, shape, balls, order, proved)


def exact_step(
    mass_tensor: Sequence[Fraction], D: Fraction, momentum: Sequence[Fraction], gamma: Sequence[Fraction],
    precision: Precision, proved: bool = False,
) -> Step:  # fmt: skip
    """`step` of one ball from exact rational numbers, which are rounded once; what is proved is of the rounded ones.

    Single, Double: to floats.  DoubleDouble: numbers that are no floats are taken at 40 digits, and the step is rounded
    to pairs.  Digits and Enclosure: to what those carry, of any size.

    Raises BadInput, also for a gamma that is not unit to the digits of the precision, and StepNotTaken as `step` does.
    """
    _only_in_double(proved, precision)
    unit_exactly(gamma, precision)
    check_body(mass_tensor, D)
    if isinstance(precision, Single | Double | DoubleDouble):
        tensor, vertical, (contact,), floats = (in_float64(x) for x in (mass_tensor, gamma, (D,), momentum))
        if any(x != 0 and y == 0.0 for x, y in zip(momentum, floats, strict=True)):
            raise BadInput(
                "a component of the momentum is below the range of float64; ask for more with --digits or --ball"
            )
        if not isinstance(precision, DoubleDouble) or [*tensor, *vertical, contact] == [*mass_tensor, *gamma, D]:
            K = np.array(momentum, dtype=object)
            return composed(Ball(tensor, contact), K, vertical, 2, precision, proved)
        return _in_pairs(exact_step(mass_tensor, D, momentum, gamma, BEYOND_DOUBLE_DOUBLE), precision)
    K, g, J = (np.array([x], dtype=object) for x in (momentum, gamma, mass_tensor))
    return dispatch.step(precision, (), Balls(K, g, J, np.array([D], dtype=object), np.zeros(1)), 2)


def _in_pairs(step: Step, precision: DoubleDouble) -> Step:
    """A step in mpmath's numbers, rounded to pairs."""
    q, K, g = (
        np.array([Pair.of(fraction(x)).halves() for x in v]).T for v in (step.rotation, step.momentum, step.gamma)
    )
    high, low = (Step(q[i], K[i], g[i], step.status, step.reach, precision) for i in range(2))
    return replace(high, low=low)


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
