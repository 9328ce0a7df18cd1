"""One step of order 4, 6 or 8: a symmetric composition of the map.

All momentum integrals stay exact: every stage turns 𝒦 and γ by one rotation (lemma `momentum-integrals-composed`).
"""

from __future__ import annotations

from numpy.typing import ArrayLike

from chapsym.numbers import NAMED

from .ball import Ball
from .map import composed
from .results import Step


def compose_step(ball: Ball, momentum: ArrayLike, gamma: ArrayLike, order: int) -> Step:
    """One step of the composition of order 2, 4, 6 or 8; arguments, result and errors as for `step`.

    `rotation` is the product of the rotations of the stages; where a stage is not taken, `reach` is the fraction of
    its momentum that the small-rotation branch attains.
    """
    return composed(ball, momentum, gamma, order, NAMED["double"])
