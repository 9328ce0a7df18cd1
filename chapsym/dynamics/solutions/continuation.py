"""Branches followed along a path of momenta, their folds, and how far a state is from one.

Everything is done for all balls of a batch at once (`marching`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..ball import Ball, Floats, batch, numbers, unit_vertical
from ..errors import BadInput, Status
from .marching import Marchers, largest_moment


@dataclass(frozen=True, eq=False)
class Fold:
    """Where a branch turns back, for one ball or a batch with the leading axes (...).

    reach: the parameter t of the path there, shape (...).
    rotation: the Euler parameters there, q0 ≥ 0, shape (..., 4).
    settled: whether Newton found a simple fold, shape (...).  Otherwise the Jacobian is singular near `reach`, which
    is a lower bound, as where branches cross.
    """

    reach: Floats
    rotation: Floats
    settled: np.ndarray


@dataclass(frozen=True, eq=False)
class Followed:
    """A branch along a path of m momenta, for one ball or a batch with the leading axes (...).

    rotation: the Euler parameters at each of the momenta, q0 ≥ 0, shape (..., m, 4), NaN beyond a fold.
    status: TAKEN if the end was reached, FOLDED if not, NOT_CONVERGED where float64 cannot tell, shape (...).
    reach: how far the branch goes: k + s at the fraction s between the momenta k and k + 1, shape (...).
    fold: where it folds, NaN for those that do not.
    """

    rotation: Floats
    status: np.ndarray
    reach: Floats
    fold: Fold


@np.errstate(all="ignore")  # what overflows settles nowhere: `status` tells
def follow(ball: Ball, path: ArrayLike, gamma: ArrayLike, rotation: ArrayLike = (1.0, 0.0, 0.0, 0.0)) -> Followed:
    """Follows the rotation with the first momentum of the path along straight lines from each to the next.

    path: momenta 𝒦 in kg m², shape (..., m, 3), m ≥ 2; gamma: (..., 3); rotation: (..., 4), a solution of (5.2) for
    the first momentum: by default the identity, which has the momentum 0.  All broadcast with the balls.

    Raises BadInput as `step` does, and for a rotation that does not have the first momentum or is singular there.
    """
    points = numbers(path, "path", 3)
    if points.ndim < 2 or points.shape[-2] < 2:
        raise BadInput(f"path must have the shape (..., m, 3) with at least 2 momenta, not {points.shape}")
    shape, (first, g, J, D) = batch(ball, points[..., 0, :], unit_vertical(gamma))
    m = points.shape[-2]
    K = np.broadcast_to(points, (*shape, m, 3)).reshape(-1, m, 3)
    marchers = Marchers.at(rotation, shape, first, g, J, D)
    n = len(D)
    rotations, reach = np.full((n, m, 4), np.nan), np.zeros(n)
    rotations[:, 0] = marchers.q
    status = np.where(marchers.regular(), Status.TAKEN, Status.NOT_CONVERGED)
    fold = Fold(np.full(n, np.nan), np.full((n, 4), np.nan), np.zeros(n, dtype=bool))
    for k in range(m - 1):
        on = np.flatnonzero(status == Status.TAKEN)
        part = marchers.only(on)
        t, status[on] = part.march(K[on, k], K[on, k + 1])
        marchers.q[on], reach[on] = part.q, k + t
        arrived = on[status[on] == Status.TAKEN]
        rotations[arrived, k + 1] = marchers.q[arrived]
        stopped = np.flatnonzero(status[on] == Status.FOLDED)
        if len(stopped):
            ends = on[stopped]
            s, q, settled = part.only(stopped).fold(K[ends, k], K[ends, k + 1], t[stopped])
            fold.reach[ends], fold.rotation[ends], fold.settled[ends] = k + s, q, settled
            reach[ends] = k + s
    return Followed(
        _upright(rotations).reshape(*shape, m, 4), status.reshape(shape), reach.reshape(shape),
        Fold(fold.reach.reshape(shape), _upright(fold.rotation).reshape(*shape, 4), fold.settled.reshape(shape)),
    )  # fmt: skip


def fold(ball: Ball, momentum: ArrayLike, gamma: ArrayLike, rotation: ArrayLike | None = None) -> Fold:
    """The fold of a branch along t𝒦: the largest t to which it can be continued, and the rotation there.

    momentum, gamma: as for `step`.  rotation: a solution of (5.2) for 𝒦, shape (..., 4), to be followed from t = 1
    upwards; by default the small rotation, from t = 0.  There always is a fold, as no rotation has more than 2Λmax.

    Raises BadInput as `follow` does, and for a momentum of 0.
    """
    K = numbers(momentum, "momentum", 3)
    shape, (flat, _, J, D) = batch(ball, K, unit_vertical(gamma))
    size = np.abs(flat).max(axis=1)
    if not (size > 0).all():
        raise BadInput("momentum must not be 0: a branch folds along t times the momentum")
    # |𝒦| ≤ 2Λmax, and no component is larger: at 4Λmax every branch has folded.
    start = np.full(len(D), 0.0 if rotation is None else 1.0)
    with np.errstate(over="ignore"):
        end = np.maximum(4 * largest_moment(J, D), 2 * start * size)
    if not np.isfinite(end).all():
        raise BadInput("the ball or its momentum is too near to the range of float64 for a fold; take other units")
    path = np.stack([start[:, np.newaxis] * flat, end[:, np.newaxis] * (flat / size[:, np.newaxis])], axis=1)
    turn = (1.0, 0.0, 0.0, 0.0) if rotation is None else rotation
    found = follow(ball, path.reshape(*shape, 2, 3), gamma, turn).fold
    with np.errstate(over="ignore"):
        reach = start + found.reach.reshape(-1) * (end / size - start)
    return Fold(reach.reshape(shape), found.rotation, found.settled)


def margin(ball: Ball, momentum: ArrayLike, gamma: ArrayLike, rotation: ArrayLike | None = None) -> Floats:
    """How much larger the momentum may become before the branch of the state folds: t - 1 for the fold at t𝒦.

    The arguments are those of `fold`; shape (...).  Negative if the small rotation folds before it reaches 𝒦, NaN
    where float64 cannot tell.
    """
    return fold(ball, momentum, gamma, rotation).reach - 1


def _upright(q: Floats) -> Floats:
    return np.where(q[..., :1] < 0, -q, q)
