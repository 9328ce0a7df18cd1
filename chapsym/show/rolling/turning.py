"""What happens between two frames: the rotation that leads from one attitude to the next, with its whole turns."""

import numpy as np

from chapsym.dynamics import kernels
from chapsym.dynamics.ball import Floats

from ..drawing.invariant import unit

#: Without ω, frames with a larger turn than this between them may hide whole turns.
QUARTER = np.pi / 2


def least(attitude: Floats) -> Floats:
    """Rotation vectors in space, (frames - 1, 3), of at most π, from each attitude (frames, 4) to the next."""
    p = kernels.compose(attitude[1:], attitude[:-1] * [1.0, -1.0, -1.0, -1.0])
    p = np.where(p[:, :1] < 0, -p, p)
    sine = _length(p[:, 1:])
    angle = 2 * np.arctan2(sine, p[:, 0])
    # sin(φ/2) and φ vanish together; the limit of φ/sin(φ/2) is 2.
    scale = np.divide(angle, sine, out=np.full_like(angle, 2.0), where=sine > 1e-12)
    return p[:, 1:] * scale[:, np.newaxis]


def nearest(turns: Floats, expected: Floats) -> tuple[Floats, np.ndarray]:
    """The rotation vectors (n, 3) of the same rotations that are nearest to those expected, and whether they are near.

    A rotation vector may be longer by whole turns about its own axis; near is within a quarter turn.
    """
    angle = _length(turns)
    # Where nothing seems to turn, any axis will do for whole turns: take the one that is expected.
    still = angle < 1e-9
    axis = unit(np.where(still[:, np.newaxis], expected, turns))
    whole = np.round(((expected * axis).sum(axis=1) - angle) / (2 * np.pi))
    found = turns + 2 * np.pi * whole[:, np.newaxis] * axis
    return found, _length(found - expected) <= QUARTER


def between(
    attitude: Floats, seconds: Floats | None, steps: np.ndarray, omega: Floats | None, rolled: Floats | None
) -> tuple[Floats, np.ndarray]:
    """The turns between the frames of one ball, (frames - 1, 3) in space, and which of them are known.

    attitude: (frames, 4).  seconds, steps: from frame to frame, (frames - 1,).  omega: in space, (frames, 3), or None.
    rolled: the way of the contact point from frame to frame in radii, or None.
    One step of the map turns by less than half a turn.  Over several, ω tells the whole turns.  Without it a turn is
    known as long as neither the attitude nor the way, which no ball rolls with less turning, show more than a quarter.
    """
    turns = least(attitude)
    if omega is not None and seconds is not None:
        expected = (omega[1:] + omega[:-1]) / 2 * seconds[:, np.newaxis]
        whole, near = nearest(turns, expected)
        return np.where((steps > 1)[:, np.newaxis], whole, turns), near | (steps <= 1)
    known = _length(turns) <= QUARTER
    if rolled is not None:
        known &= rolled <= QUARTER
    return turns, known | (steps <= 1)


def thinned(attitude: Floats, turns: Floats, known: np.ndarray, kept: np.ndarray) -> tuple[Floats, bool]:
    """The turns between the frames that are kept, (len(kept) - 1, 3), the last among them, and whether all are known.

    The turns on the way, added up, tell the whole turns.
    """
    if len(kept) < 2:
        return np.zeros((0, 3)), True
    expected = np.add.reduceat(turns, kept[:-1], axis=0)
    found, near = nearest(least(attitude[kept]), expected)
    return found, bool(near.all() and known.all())


def _length(vectors: Floats) -> Floats:
    return np.sqrt((vectors**2).sum(axis=1))
