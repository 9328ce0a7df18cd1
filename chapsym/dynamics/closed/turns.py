"""Multiples kτ of an angle to full accuracy: double-double fractions of a turn, on NumPy arrays.

A state after k steps follows from k times a constant angle.  In float64 the product would have an error of k roundings;
here an angle τ (in turns) is a pair of floats, and the fraction of kτ is exact to 2⁻¹⁰⁰k.
"""

from collections.abc import Callable

import numpy as np

from chapsym.numbers import pairs

from ..ball import Floats

Pair = tuple[Floats, Floats]

#: 2π as a pair.
FULL_TURN = (6.283185307179586, 2.4492935982947064e-16)
#: Halvings of an angle of 45° or less before the series, and its terms: tan φ is then below 0.0246, and tan²⁰φ 2⁻¹⁰⁶.
HALVINGS = 5
TERMS = 10
#: Up to this many balls are computed one by one.
FEW = 16
#: From this many step numbers on, fewer angles than frames are computed.
MANY = 64
#: Step numbers are split here, so that each part is a float.
SPLIT = 2**32


def each(function: Callable[..., tuple], *arrays: Floats) -> tuple[Floats, ...]:
    """A function of pairs on flat arrays; for a few entries one by one in Python's floats, faster, to the same bits."""
    if not 0 < arrays[0].size <= FEW:
        return function(*arrays)
    rows = [function(*row) for row in zip(*(a.tolist() for a in arrays), strict=True)]
    return tuple(np.array(column) for column in zip(*rows, strict=True))


def root(a: Floats, a_: Floats) -> Pair:
    """√a of pairs a ≥ 0, by `pairs.root`."""
    if isinstance(a, float):
        return pairs.root(a, a_)
    high = np.sqrt(a)
    p, p_ = pairs.two_product(high, high)
    rest = np.divide(a_ + ((a - p) - p_), 2.0 * high, out=np.zeros_like(high), where=high > 0.0)
    return pairs.quick_two_sum(high, rest)


def turns_of_tangent(t: Floats, t_: Floats) -> Pair:
    """arctan(t)/(2π) for pairs 0 ≤ t ≤ 1, within 2⁻⁹⁹ of itself."""
    for _ in range(HALVINGS):  # tan(φ/2) = tan φ/(1 + √(1 + tan²φ))
        square = pairs.multiply(t, t_, t, t_)
        t, t_ = pairs.divide(t, t_, *pairs.add(1.0, 0.0, *root(*pairs.add(1.0, 0.0, *square))))
    square = pairs.multiply(t, t_, t, t_)
    total = pairs.divide(1.0, 0.0, 2.0 * TERMS - 1.0, 0.0)
    for i in reversed(range(TERMS - 1)):
        term = pairs.multiply(*square, *total)
        total = pairs.subtract(*pairs.divide(1.0, 0.0, 2.0 * i + 1.0, 0.0), *term)
    angle = pairs.multiply(t, t_, *total)
    return pairs.divide(angle[0] * 2.0**HALVINGS, angle[1] * 2.0**HALVINGS, *FULL_TURN)


def fraction(turns: Floats, turns_: Floats, index: np.ndarray) -> Floats:
    """kτ less the nearest whole number, for pairs τ of size below 2²⁰ and step numbers k ≤ 2⁶², which broadcast."""
    low = np.mod(index, SPLIT)
    total, rest = np.zeros(()), np.zeros(())
    for part in (index - low, low):
        p, p_ = pairs.two_product(turns, part.astype(np.float64))
        # The whole turns of each half are removed exactly; fractions and their roundings remain.
        p, p_ = p - np.rint(p), p_ - np.rint(p_)
        q = turns_ * part
        total, e = pairs.two_sum(total, p)
        rest = rest + (e + p_ + (q - np.rint(q)))
    total, rest = pairs.two_sum(total, rest)
    total, e = pairs.two_sum(total - np.rint(total), rest)
    return np.asarray(total - np.rint(total) + e)


def cosine_and_sine(fractions: Floats) -> tuple[Floats, Floats]:
    """cos and sin of 2π times a fraction of a turn, each within 1 ulp of 1: the rounded part is at most an eighth."""
    quarters = np.rint(4.0 * fractions)
    angle = (fractions - 0.25 * quarters) * FULL_TURN[0]
    cosine, sine = np.cos(angle), np.sin(angle)
    odd, quarter = quarters % 2 != 0, quarters % 4
    x, y = np.where(odd, sine, cosine), np.where(odd, cosine, sine)
    return np.where((quarter == 1) | (quarter == 2), -x, x), np.where(quarter >= 2, -y, y)


def cosines_and_sines(turns: Floats, turns_: Floats, index: np.ndarray) -> tuple[Floats, Floats]:
    """cos and sin of 2πkτ for pairs τ, (n,), and ascending step numbers k, (frames,): two arrays (n, frames).

    Many equidistant step numbers are split into a coarse and a fine part, so that there are few angles: a product of
    two rotations, within 3 ulps.
    """
    high, low = turns[:, np.newaxis], turns_[:, np.newaxis]
    count, every = len(index), int(index[1] - index[0]) if len(index) > 1 else 1
    if count < MANY or (np.diff(index) != every).any():
        return cosine_and_sine(fraction(high, low, index))
    width = int(np.sqrt(count))
    fine = np.arange(width) * every
    coarse = index[0] + np.arange(0, count, width) * every
    (a, b), (c, d) = (cosine_and_sine(fraction(high, low, part)) for part in (coarse, fine))
    a, b, c, d = a[:, :, np.newaxis], b[:, :, np.newaxis], c[:, np.newaxis], d[:, np.newaxis]
    cosine, sine, rest = a * c, a * d, b * d
    cosine -= rest
    sine += np.multiply(b, c, out=rest)
    return cosine.reshape(len(turns), -1)[:, :count], sine.reshape(len(turns), -1)[:, :count]
