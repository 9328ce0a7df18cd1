"""One step of order 4, 6 or 8: a symmetric composition of the map.

All momentum integrals stay exact: every stage turns 𝒦 and γ by one rotation (lemma `momentum-integrals-composed`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .ball import Ball, numbers
from .coefficients import substeps
from .errors import Status, StepNotTaken
from .levels.double import chosen
from .loops import composed_loop, loop
from .map import Step, batch, explain, unit_vertical


def compose_step(ball: Ball, momentum: ArrayLike, gamma: ArrayLike, order: int) -> Step:
    """One step of the composition of order 2, 4, 6 or 8; arguments, result and errors as for `step`.

    `rotation` is the product of the rotations of the stages; where a stage is not taken, `reach` is the fraction of
    its momentum that the small-rotation branch attains.
    """
    c = substeps(order)
    shape, (K, g, J, D) = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
    rotation = np.tile([1.0, 0.0, 0.0, 0.0], (len(D), 1))
    status, reach = np.zeros(len(D), dtype=np.int64), np.ones(len(D))
    take, prepare = chosen((composed_loop.composed_step, composed_loop.prepare_composed), len(D) * len(c))
    for i in range(len(D)):
        state, bounds, past = np.zeros(loop.ROWS), np.zeros((2, len(c))), np.zeros((len(c), 8, 3))
        scale = prepare(K[i], g[i], J[i], float(D[i]), c, state, *bounds)
        status[i], reach[i] = take(state, c, *bounds, past, True, rotation[i], np.zeros(2), 0.0)
        K[i], g[i] = scale * state[:3], state[3:6]
        if status[i] != Status.TAKEN:
            status[i] = explain(status[i], K[i], g[i], J[i], D[i])
            if not shape:
                raise StepNotTaken(Status(int(status[i])), float(reach[i]))
            rotation[i], K[i], g[i] = np.nan, np.nan, np.nan
    return Step(
        rotation.reshape(*shape, 4), K.reshape(*shape, 3), g.reshape(*shape, 3),
        status.reshape(shape), reach.reshape(shape),
    )  # fmt: skip
