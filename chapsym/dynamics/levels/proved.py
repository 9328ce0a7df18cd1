"""Bounds of how far a run in float64 or double-double is from the exact orbit of the map, proved step by step."""

from math import inf, nan, sqrt

import numpy as np

from ..ball import Asked, Floats
from ..loops import double_double as loop
from ..loops import gibbs, proved
from .frames import Balls, Frames

#: Beyond the roundings of a distance: relative to it, and to what is compared.
WIDER, PAIR = 1.0 + 2.0**-40, 2.0**-98


def begun(state: Floats, stages: Floats, beyond: int) -> tuple[Floats, Floats]:
    """What the march takes: m and radius² of each stage, (s, 2), and the set of one point that moves."""
    box = np.zeros(proved.ROWS)
    box[[0, 4, 8]] = 1.0
    box[[proved.G_OFF, proved.A_OFF]] = PAIR
    if beyond:  # the momentum is taken 2^beyond times as large, which is another ball
        box[proved.BALL] = inf
    return np.array([slope(c * state[:6:2], state[12:18:2], state[loop.D]) for c in stages[:, 0]]), box


def slope(k: Floats, I: Floats, D: float) -> tuple[float, float]:
    """(m, radius²) by lemma `small-branch`: G is monotone with m where |u|² ≤ radius², and has the branch's root there.

    (0, BEYOND) where |𝒦| is beyond its bound.
    """
    radius, _ = gibbs.bound(tuple(map(float, k)), tuple(map(float, I)), float(D))
    if radius == gibbs.BEYOND:
        return 0.0, radius
    steepest = 0.5 * (max(I) - min(I)) + 2.0 * sqrt(float(k @ k))
    return (float(min(I)) - sqrt(radius) * steepest * WIDER) / WIDER, radius


def errors(balls: Balls, index: Floats, run: Frames, pairs: Frames, spread: Floats) -> list[Asked]:
    """Upper bounds, (n, frames), of what a run is off by: in 𝒦, γ, the attitude and the contact point.

    pairs: the run in double-double from the same start, and `spread`: how far the exact orbit may be from that.
    """
    low = pairs.low
    assert low is not None
    one = np.ones((len(balls.D), 1))
    sizes = length(balls.momentum)[:, np.newaxis], one, one, balls.radius[:, np.newaxis]
    found = list[Asked]()
    for i, name in enumerate(("momentum", "gamma", "attitude", "contact")):
        ours, high, rest = (getattr(frames, name) for frames in (run, pairs, low))
        if not ours.shape[1]:
            found.append(None)
            continue
        beyond = run.low if run.low is None else getattr(run.low, name)
        with np.errstate(invalid="ignore", over="ignore", under="ignore"):
            off = length((ours - high) + ((0.0 if beyond is None else beyond) - rest))
            # The contact point is a sum of as many parts as steps, each of a radius at most.
            part = spread[:, :, i] + PAIR * (1.0 + (index * index if name == "contact" else 0.0))
            bound = np.nextafter(WIDER * (off + sizes[i] * part), inf)
        lost = np.isnan(bound)  # the run in pairs stopped before
        found.append(np.where(np.isnan(ours).any(axis=-1), nan, np.where(lost, inf, bound)))
    return found


def length(v: Floats) -> Floats:
    """|v| of vectors, without overflow of their squares."""
    most = np.abs(v).max(axis=-1, keepdims=True)
    scale = np.where(most > 0, most, 1.0)
    size: Floats = np.sqrt(((v / scale) ** 2).sum(axis=-1)) * scale[..., 0]
    return size
