"""Bounds of the distance of a run in float64 or double-double from the exact orbit of the map, proved step by step."""

from math import inf, nan

import numpy as np

import chapsym.dynamics.native as native

from ..ball import Asked, Floats
from ..loops import double_double as loop
from ..loops import proved
from ..loops.proved import PAIR, WIDER
from .frames import Balls, Count, Frames, cores, share

#: A bound of the error of a rounded subnormal number, in each part of a sum.
FLOOR = 2.0**-1070
#: The number of balls for which a thread bounds a step in one call.
MANY = 12_500


def begun(state: Floats, stages: Floats, beyond: int) -> tuple[Floats, Floats]:
    """The arguments of the march: m and radius² of each stage, (s, 2), and the moving set, at first one point."""
    box = np.zeros(proved.ROWS)
    box[[0, 4, 8]] = 1.0
    box[[proved.G_OFF, proved.A_OFF]] = PAIR
    if beyond:  # the momentum is scaled by 2^beyond, which is another ball
        box[proved.BALL] = inf
    I, D = tuple(state[loop.I : loop.J : 2].tolist()), float(state[loop.D])
    stage_momenta = (tuple((c * state[loop.K : loop.G : 2]).tolist()) for c in stages[:, 0])
    return np.array([proved.slope_of(k, I, D) for k in stage_momenta]), box


def errors(balls: Balls, index: Floats, run: Frames, pairs: Frames, spread: Floats, stages: int = 1) -> list[Asked]:
    """Upper bounds, (n, frames), of the errors of a run: in 𝒦, γ, the attitude and the contact point.

    pairs: the run in double-double from the same start; spread: bounds of its distance from the exact orbit.
    """
    low = pairs.low
    assert low is not None
    one = np.ones((len(balls.D), 1))
    sizes = lengths(balls.momentum)[:, np.newaxis], one, one, balls.radius[:, np.newaxis]
    found = list[Asked]()
    for i, name in enumerate(("momentum", "gamma", "attitude", "contact")):
        ours, high, rest = (getattr(frames, name) for frames in (run, pairs, low))
        if not ours.shape[1]:
            found.append(None)
            continue
        beyond = run.low if run.low is None else getattr(run.low, name)
        with np.errstate(invalid="ignore", over="ignore", under="ignore"):
            off = lengths((ours - high) + ((0.0 if beyond is None else beyond) - rest))
            # The contact point is a sum of one part per rotation, each at most a radius.
            parts = index * stages if name == "contact" else 0.0 * index
            part = spread[:, :, i] + PAIR * (1.0 + parts * parts)
            bound = np.nextafter(WIDER * (off + sizes[i] * part), inf) + FLOOR * (1.0 + parts)
        lost = np.isnan(bound)  # the run in pairs stopped before
        found.append(np.where(np.isnan(ours).any(axis=-1), nan, np.where(lost, inf, bound)))
    return found


def of_step(balls: Balls, q: Floats, K: Floats, g: Floats) -> Floats:
    """Upper bounds of the errors of a step of each ball in 𝒦, γ and the rotation, (n, 3); inf if none is proved.

    balls: before the step; q, K, g: the rotations, 𝒦 and γ after it, in float64.
    """
    found, bound_steps = np.empty((len(q), 3)), native.loop(proved.bound_steps)
    arrays = balls.momentum, balls.gamma, balls.mass_tensor, balls.D, q, K, g, found

    def some(start: int) -> None:
        bound_steps(*(x[start : start + MANY] for x in arrays))

    starts = range(0, len(q), MANY)
    share(some, starts, min(cores(), len(starts)), Count(lambda done: None))
    return found


@np.errstate(under="ignore")
def lengths(v: np.ndarray) -> Floats:
    """The lengths, (...), of vectors (..., n) of floats or Fractions, whose squares may be beyond float64."""
    v = np.asarray(v, dtype=np.float64)
    most = np.abs(v).max(axis=-1, keepdims=True)
    scale = np.where(most > 0, most, 1.0)
    return np.asarray(np.sqrt(((v / scale) ** 2).sum(axis=-1)) * scale[..., 0])
