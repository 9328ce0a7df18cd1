"""The map and its symmetric compositions: one step, of floats and of exact numbers."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import numpy as np
from numpy.typing import ArrayLike

from chapsym.numbers import NAMED, Digits, Double, DoubleDouble, Pair, Precision, Single

from .axes import in_given_axes
from .ball import Ball, batch, numbers, unit_vertical
from .errors import BadInput
from .exactly import beyond_float64, check_body, in_float64, unit_exactly
from .levels import dispatch
from .levels.frames import Balls
from .levels.start import fraction
from .results import LowStep, Step

#: The digits of a step of exact numbers that pairs cannot hold, before it is rounded to pairs.
BEYOND_DOUBLE_DOUBLE = Digits(40)


@in_given_axes
def step(ball: Ball, momentum: ArrayLike, gamma: ArrayLike, *, precision: str | Precision = "double") -> Step:
    """One step of the map (5.3) on the small-rotation branch: the first step of `trajectory`, to the bit.

    Solves 𝒦(q, γ) = 𝒦 for the rotation Ω (5.2) that is continued from the identity, and carries
    𝒦 and γ to Ωᵀ𝒦 and Ωᵀγ.

    momentum: 𝒦 = ε K of the paper, in kg m², shape (..., 3); gamma: unit verticals upwards, (..., 3).
    Both broadcast with each other and with the balls.  Of a ball with axes they, and what is
    returned, are in these.
    precision: "single", "double", "double-double" (31 digits), `Digits(n)` (mpmath) or `Enclosure(bits)` (Arb).
    Floats that are given are taken as exact at every precision, but γ is divided by its length on all but "double".

    One ball (no leading axis) raises StepNotTaken if it has no step; a batch reports `status` instead.
    Raises BadInput for shapes, NaN, infinities, and a gamma that is not unit.
    """
    return composed(ball, momentum, gamma, 2, dispatch.precision_of(precision))


@in_given_axes
def compose_step(ball: Ball, momentum: ArrayLike, gamma: ArrayLike, order: int) -> Step:
    """One step of the composition of order 2, 4, 6 or 8; arguments, result and errors as for `step`.

    All momentum integrals stay exact: every stage turns 𝒦 and γ by one rotation (lemma `momentum-integrals-composed`).
    `rotation` is the product of the rotations of the stages; where a stage is not taken, `reach` is the fraction of
    its momentum that the small-rotation branch attains.
    """
    return composed(ball, momentum, gamma, order, NAMED["double"])


def composed(ball: Ball, momentum: ArrayLike, gamma: ArrayLike, order: int, precision: Precision) -> Step:
    """One step of the composition of any order."""
    shape, (K, g, J, D) = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
    balls = Balls(K, g, J, D, np.zeros(len(D)), beyond_float64(momentum, shape))
    return dispatch.step(precision, shape, balls, order)


def exact_step(
    mass_tensor: Sequence[Fraction], D: Fraction, momentum: Sequence[Fraction], gamma: Sequence[Fraction],
    precision: Precision,
) -> Step:  # fmt: skip
    """`step` of one ball from exact rational numbers, which are rounded once.

    Single, Double: to floats.  DoubleDouble: numbers that are no floats are taken at 40 digits, and the step is rounded
    to pairs.  Digits and Enclosure: to what those carry, of any size.

    Raises BadInput, also for a gamma that is not unit to the digits of the precision, and StepNotTaken as `step` does.
    """
    unit_exactly(gamma, precision)
    check_body(mass_tensor, D)
    if isinstance(precision, Single | Double | DoubleDouble):
        tensor, vertical, (contact,), floats = (in_float64(x) for x in (mass_tensor, gamma, (D,), momentum))
        if any(x != 0 and y == 0.0 for x, y in zip(momentum, floats, strict=True)):
            raise BadInput(
                "a component of the momentum is below the range of float64; ask for more with --digits or --ball"
            )
        if not isinstance(precision, DoubleDouble) or [*tensor, *vertical, contact] == [*mass_tensor, *gamma, D]:
            return composed(Ball(tensor, contact), np.array(momentum, dtype=object), vertical, 2, precision)
        return _in_pairs(exact_step(mass_tensor, D, momentum, gamma, BEYOND_DOUBLE_DOUBLE), precision)
    K, g, J = (np.array([x], dtype=object) for x in (momentum, gamma, mass_tensor))
    return dispatch.step(precision, (), Balls(K, g, J, np.array([D], dtype=object), np.zeros(1)), 2)


def _in_pairs(step: Step, precision: DoubleDouble) -> Step:
    """A step in mpmath's numbers, rounded to pairs."""
    q, K, g = (
        np.array([Pair.of(fraction(x)).halves() for x in v]).T for v in (step.rotation, step.momentum, step.gamma)
    )
    return Step(q[0], K[0], g[0], step.status, step.reach, precision, LowStep(q[1], K[1], g[1]))
