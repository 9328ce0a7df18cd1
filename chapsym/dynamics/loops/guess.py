"""Weights that put together the rates 2u/h, or the Gibbs vectors u, of earlier steps of the map to guess the next."""

from functools import cache
from math import factorial

import numpy as np

from ..ball import Floats
from .lanes import DERIVATIVES, FIRST_TERMS, LANES, LAST, TERMS

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


def _powers(x: Floats, most: int) -> list[Floats]:
    """x⁰, x, x², ... by products, which every processor rounds alike; NumPy's power does not."""
    return list(np.cumprod([np.ones_like(x), *[x] * most], axis=0))


def _moments(t: Floats, e: Floats) -> Floats:
    of_t, of_e = _powers(t, DEGREE), _powers(e * e, DEGREE // 2)
    return np.array([DECAY ** (i + 2 * j) * of_t[i] * of_e[j] for i, j in POWERS])


def _moderate(matrix: Floats, wanted: Floats) -> Floats:
    """Weights of the columns for the wanted one, as nearly as SMALL times the weights allow, in least squares.

    By Gram and Schmidt, column by column: LAPACK's order depends on the processor, and a run would with it.
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
    """Weights of ω, of its derivatives and of the known rates (middle, length), (terms, 2), for the wanted one.

    A rate is a series in its middle t and, as the map is self-adjoint, the square of its length e.  The weights
    take Σ w tⁱe²ʲ over the known rates to that of the new one as nearly as they can while they stay moderate.
    """
    start = [[factorial(k) * DECAY**k if power == (k, 0) else 0.0 for power in POWERS] for k in range(DERIVATIVES)]
    matrix = np.hstack([np.transpose(start), _moments(*known.T)])
    return _moderate(matrix, _moments(*wanted[:, np.newaxis])[:, 0])


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


#: A block adds this many Gibbs vectors at once.
GROUP = 4
#: Of how many moments the weights up to 0, 1, 2, 3 and 4 are.
COUNTS = (1, 2, 4, 7, 12)


def _stage_moments(c: Floats) -> Floats:
    """The terms in which the rates of the stages c, one after the other, differ up to the fourth order, (stages, 12).

    A stage is exp(cX₁ + c³X₃ + ...), and its rate an even series in c at its middle.  So they are the coefficients of
    words in X₁ and X₃ up to the middle, times powers of c².  That of X₁ is t, that of X₃ is the sum of the c³, and
    that of X₁X₃ has each c³ times the t of its middle; by shuffles the others are products of these.
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
    """The weights of the Gibbs vectors of all stages but the last for that of the last, (stages - 1,)."""
    known = len(c) - 1
    moments = _stage_moments(c)[:, : max((n for n in COUNTS if n <= known), default=0)]
    if not known:
        return np.zeros(0)
    return _moderate(moments[:-1].T, moments[-1]) * c[-1] / c[:-1]


#: The polynomial through the last 8 values, at the next: the oldest first.
NEXT = (-1.0, 8.0, -28.0, 56.0, -70.0, 56.0, -28.0, 8.0)


@cache
def stage_weights(stages: tuple[float, ...]) -> Floats:
    """The weights of the last Gibbs vectors, the oldest first, for that of each stage, (2, places, vectors).

    The vectors lie in places that are used one after the other, and again: as many as whole steps need to fit the
    twelve moments; the weights are filled up with zeros to whole groups.  The first weights are for the first round,
    in which only the places before are filled, the others for all later ones.  Steps of one stage are guessed by a
    polynomial, which begins at 0.
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
