"""Weights for guesses: linear combinations of the rates 2u/h, or the Gibbs vectors u, of earlier steps of the map."""

from functools import cache
from math import factorial

import numpy as np

from ..ball import Floats
from .lanes import DERIVATIVES, FIRST_TERMS, LANES, LAST, TERMS

#: The assumed ratio of successive Taylor coefficients of a rate, in the time of a long step and its square.
DECAY = 0.5
DEGREE = 9
POWERS = [(i, j) for i in range(DEGREE + 1) for j in range(DEGREE // 2 + 1) if i + 2 * j <= DEGREE]
#: The weight, in the least squares, of the size of the weights against the moments.
SMALL = 1e-6


def middles(columns: int) -> Floats:
    """The (middle, length) of each lane's step in each slot, in units of the long step, (slots, LANES, 2)."""
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


def _powers(x: Floats, most: int) -> list[Floats]:
    """x⁰, x, x², ... by products, which are rounded equally on all processors, unlike NumPy's power."""
    return list(np.cumprod([np.ones_like(x), *[x] * most], axis=0))


def _moments(t: Floats, e: Floats) -> Floats:
    of_t, of_e = _powers(t, DEGREE), _powers(e * e, DEGREE // 2)
    return np.array([DECAY ** (i + 2 * j) * of_t[i] * of_e[j] for i, j in POWERS])


def _moderate(matrix: Floats, wanted: Floats) -> Floats:
    """The weights w that minimise |matrix·w - wanted|² + |SMALL·w|².

    By Gram-Schmidt, column by column: the results of LAPACK, and of a run, would depend on the processor.
    """
    n = matrix.shape[1]
    a = np.column_stack([np.vstack([matrix, SMALL * np.eye(n)]), np.concatenate([wanted, np.zeros(n)])])
    r = np.zeros((n, n + 1))
    for k in range(n):
        r[k, k] = np.sqrt((a[:, k] * a[:, k]).sum())
        unit = a[:, k : k + 1] / r[k, k]
        r[k, k + 1 :] = (unit * a[:, k + 1 :]).sum(axis=0)
        a[:, k + 1 :] -= unit * r[k, k + 1 :]
    weights = np.zeros(n)
    for k in range(n - 1, -1, -1):
        weights[k] = (r[k, n] - (r[k, k + 1 : n] * weights[k + 1 :]).sum()) / r[k, k]
    return weights


def _weights(known: Floats, wanted: Floats) -> Floats:
    """The weights of ω, its derivatives and the known rates (middle, length), (terms, 2), for the wanted rate.

    A rate is a series in its middle t and, as the map is self-adjoint, the square of its length e.  The weights, of
    moderate size, approximate tⁱe²ʲ of the wanted rate by Σ w tⁱe²ʲ over the known rates.
    """
    start = [[factorial(k) * DECAY**k if power == (k, 0) else 0.0 for power in POWERS] for k in range(DERIVATIVES)]
    matrix = np.hstack([np.transpose(start), _moments(*known.T)])
    return _moderate(matrix, _moments(*wanted[:, np.newaxis])[:, 0])


@cache
def guess_weights(columns: int) -> tuple[Floats, Floats]:
    """The weights of the guesses in every slot, (slots, TERMS, LANES), and of each column's first step, (n, terms)."""
    stages = middles(columns)
    following = np.zeros((LAST, TERMS, LANES))
    for slot in range(1, LAST):
        for lane in range(LANES):
            middle, length = stages[slot, lane]
            steps = min(3, round(middle / length - 0.5))  # earlier steps of this column
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


#: The number of Gibbs vectors that a block adds in one pass.
GROUP = 4
#: The numbers of moments up to the orders 0, 1, 2, 3 and 4.
COUNTS = (1, 2, 4, 7, 12)


def _stage_moments(c: Floats) -> Floats:
    """The moments of the rates of successive stages c, up to the fourth order, (stages, 12).

    A stage is exp(cX₁ + c³X₃ + ...), and its rate is an even series in c at its middle.  So the moments are the
    coefficients of words in X₁ and X₃ up to the middle, times powers of c².  The coefficient of X₁ is t, of X₃ the sum
    of c³, of X₁X₃ the sum of c³ times t at its middle; the others are products of these, by shuffles.
    """
    start, cube = np.cumsum(c) - c, c * c * c
    t = start + c / 2
    sums = np.cumsum(cube) - cube / 2
    ordered = np.cumsum(t * cube) - t * cube + (start + c / 4) * cube / 2
    e = c * c
    one = np.ones_like(c)
    t2 = t * t
    return np.stack([one, t, t2, e, t2 * t, t * e, sums, t2 * t2, t2 * e, e * e, t * sums, ordered], axis=1)


def _stage_guess(c: Floats) -> Floats:
    """The weights of the Gibbs vectors of the other stages for that of the last stage, (stages - 1,)."""
    known = len(c) - 1
    moments = _stage_moments(c)[:, : max((n for n in COUNTS if n <= known), default=0)]
    if not known:
        return np.zeros(0)
    return _moderate(moments[:-1].T, moments[-1]) * c[-1] / c[:-1]


#: The weights of the last 8 values, the oldest first, in the extrapolation by a polynomial.
NEXT = (-1.0, 8.0, -28.0, 56.0, -70.0, 56.0, -28.0, 8.0)


@cache
def stage_weights(stages: tuple[float, ...]) -> Floats:
    """The weights of the last Gibbs vectors, the oldest first, for the guess of each stage, (2, places, vectors).

    The vectors are in a ring buffer of places: the least number for whole steps that fits the twelve moments; the
    weights are padded with zeros to whole groups.  The first weights are for the first round, in which only the places
    before are filled; the second are for all later rounds.  Steps of one stage are guessed by a polynomial; its values
    before the first step are 0.
    """
    s = len(stages)
    if s == 1:
        found = np.tile(NEXT, (2, len(NEXT), 1))
    else:
        places = s * -(-COUNTS[-1] // s)
        round_ = np.array(stages * (places // s))
        found = np.zeros((2, places, -(-places // GROUP) * GROUP))
        for i in range(places):
            found[0, i, places - i : places] = _stage_guess(round_[: i + 1])
            found[1, i, :places] = _stage_guess(round_[np.append((i + np.arange(places)) % places, i)])
    found.flags.writeable = False
    return found
