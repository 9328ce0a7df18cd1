"""Weights that put together the rates 2u/h of earlier steps of the map to guess the next one."""

from functools import cache
from math import factorial

import numpy as np

from ..ball import Floats
from .lanes import DERIVATIVES, FIRST_TERMS, LANES, TERMS
from .long_step import LAST

#: The Taylor coefficients of a rate, in the time of a long step and its square, are taken to fall like this.
DECAY = 0.5
DEGREE = 9
POWERS = [(i, j) for i in range(DEGREE + 1) for j in range(DEGREE // 2 + 1) if i + 2 * j <= DEGREE]
#: What a guess may be amplified: the least squares weigh it against the moments.
SMALL = 1e-6


def middles(columns: int) -> Floats:
    """(middle, length) of each lane's step in each slot, in units of the long step, (slots, LANES, 2)."""
    first = LAST + 1 - columns
    out = np.empty((LAST, LANES, 2))
    for lane in range(LANES):
        n, j = max(LAST - lane, first), 0
        for slot in range(LAST):
            if slot == LAST - lane and first <= lane:
                n, j = lane, 0
            out[slot, lane] = (j + 0.5) / n, 1 / n
            j += 1
    return out


def _moments(t: Floats, e: Floats) -> Floats:
    return np.array([DECAY ** (i + 2 * j) * t**i * e ** (2 * j) for i, j in POWERS])


def _weights(known: Floats, wanted: Floats) -> Floats:
    """Weights of ω, of its derivatives and of the known rates (middle, length), (terms, 2), for the wanted one.

    A rate is a series in its middle t and, as the map is self-adjoint, the square of its length e.  The weights
    take Σ w tⁱe²ʲ over the known rates to that of the new one as nearly as they can while they stay moderate.
    """
    start = [[factorial(k) * DECAY**k if power == (k, 0) else 0.0 for power in POWERS] for k in range(DERIVATIVES)]
    matrix = np.hstack([np.transpose(start), _moments(*known.T)])
    size = matrix.shape[1]
    padded = np.concatenate([_moments(*wanted[:, np.newaxis])[:, 0], np.zeros(size)])
    return np.linalg.lstsq(np.vstack([matrix, SMALL * np.eye(size)]), padded, rcond=None)[0]


@cache
def guess_weights(columns: int) -> tuple[Floats, Floats]:
    """The weights of every slot's guesses, (slots, TERMS, LANES), and those of every column's first, (n, terms)."""
    stages = middles(columns)
    following = np.zeros((LAST, TERMS, LANES))
    for slot in range(1, LAST):
        for lane in range(LANES):
            middle, length = stages[slot, lane]
            steps = min(3, round(middle / length - 0.5))  # of this column, before
            before = np.array([(middle - j * length, length) for j in range(1, steps + 1)]).reshape(-1, 2)
            weights = _weights(before, stages[slot, lane])
            following[slot - 1, : len(weights), lane] = weights
    beginning = np.zeros((LAST + 1, FIRST_TERMS))
    firsts = stages[0]
    second = LAST - LANES
    for n in range(LAST + 1 - columns, LAST + 1):
        known = firsts[:0] if n > second else firsts if n == second else np.vstack([firsts, [0.5 / second, 1 / second]])
        beginning[n, : DERIVATIVES + len(known)] = _weights(known, np.array([0.5 / n, 1 / n]))
    return following, beginning
