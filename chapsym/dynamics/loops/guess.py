"""Weights that put together the rates 2u/h of earlier steps of the map to guess the next one."""

from functools import cache

import numpy as np

from ..ball import Floats
from .lanes import FIRST_TERMS, LANES, MOST_COLUMNS, SLOTS, TERMS
from .long_step import FIRST

#: The Taylor coefficients of a rate, in the time of a long step and its square, are taken to fall like this.
DECAY = 0.5
DEGREE = 9
POWERS = [(i, j) for i in range(DEGREE + 1) for j in range(DEGREE // 2 + 1) if i + 2 * j <= DEGREE]
#: What a guess may be amplified: the least squares weigh it against the moments.
SMALL = 1e-6


def middles(columns: int) -> Floats:
    """(middle, length) of each lane's step in each slot, in units of the long step, (slots, LANES, 2)."""
    most = FIRST + columns - 1
    out = np.empty((most, LANES, 2))
    for lane in range(LANES):
        n, j = max(most - lane, FIRST), 0
        for slot in range(most):
            if slot == most - lane and FIRST <= lane < most - LANES + 1:
                n, j = lane, 0
            out[slot, lane] = (j + 0.5) / n, 1 / n
            j += 1
    return out


def _moments(t: Floats, e: Floats) -> Floats:
    return np.array([DECAY ** (i + 2 * j) * t**i * e ** (2 * j) for i, j in POWERS])


def _weights(known: Floats, wanted: Floats) -> Floats:
    """Weights of ω, of its derivative and of the known rates (middle, length), (terms, 2), for the wanted one.

    A rate is a series in its middle t and, as the map is self-adjoint, the square of its length e.  The weights
    take Σ w tⁱe²ʲ over the known rates to that of the new one as nearly as they can while they stay moderate.
    """
    start = _moments(np.zeros(1), np.zeros(1))
    slope = np.array([[DECAY if power == (1, 0) else 0.0] for power in POWERS])
    matrix = np.hstack([start, slope, _moments(*known.T)])
    size = matrix.shape[1]
    padded = np.concatenate([_moments(*wanted[:, np.newaxis])[:, 0], np.zeros(size)])
    return np.linalg.lstsq(np.vstack([matrix, SMALL * np.eye(size)]), padded, rcond=None)[0]


@cache
def guess_weights(columns: int) -> tuple[Floats, Floats]:
    """The weights of every slot's guesses, (slots, TERMS, LANES), and those of every column's first, (n, terms)."""
    stages = middles(columns)
    most = len(stages)
    following = np.zeros((SLOTS, TERMS, LANES))
    for slot in range(1, most):
        for lane in range(LANES):
            middle, length = stages[slot, lane]
            steps = min(3, round(middle / length - 0.5))  # of this column, before
            before = np.array([(middle - j * length, length) for j in range(1, steps + 1)]).reshape(-1, 2)
            weights = _weights(before, stages[slot, lane])
            following[slot - 1, 3:, lane], following[slot - 1, :steps, lane] = weights[:2], weights[2:]
    beginning = np.zeros((FIRST + MOST_COLUMNS, FIRST_TERMS))
    firsts = stages[0]
    second = most - LANES
    for n in range(FIRST, most + 1):
        known = firsts[:0] if n > second else firsts if n == second else np.vstack([firsts, [0.5 / second, 1 / second]])
        beginning[n, : 2 + len(known)] = _weights(known, np.array([0.5 / n, 1 / n]))
    return following, beginning
