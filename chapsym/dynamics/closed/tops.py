"""Frames of Moser-Veselov tops at once, for arrays of balls: 𝒦, γ and the attitude at any step numbers."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from .. import kernels
from ..attitudes import initial_attitude
from ..ball import Ball, Floats, batch, numbers, unit_vertical
from ..errors import BadInput, Status, StepNotTaken
from ..results import Trajectory, finished
from ..trajectories import step_numbers
from .precession import Precession
from .top import TopMotion, moves

#: How far 𝒦 may be from hγ, of its largest component: what the rounding of hγ leaves.
VERTICAL = 2.0**-52


def is_top(ball: Ball, momentum: ArrayLike, gamma: ArrayLike) -> np.ndarray:
    """Which states `top_frames` has, (...): those of the free top, and vertical 𝒦 on a ball with two equal J.

    That is D = 0, or 𝒦 = hγ to its last rounding and two of the J equal; and 𝒦 moves in the body (else `is_steady`).
    Two J that differ by an ulp are different.  A 𝒦 that is off hγ by its rounding is taken as vertical: the motion that
    was meant differs by a rounding of the start, which is what a run of the map makes of every start.
    momentum, gamma: 𝒦 (kg m²) and γ, (..., 3); they broadcast with the balls.  Raises BadInput as `step` does.
    """
    shape, (K, g, J, D) = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
    return _is_top(K, g, J, D).reshape(shape)


def _is_top(K: Floats, g: Floats, J: Floats, D: Floats) -> np.ndarray:
    size = np.abs(K).max(axis=-1)
    with np.errstate(all="ignore"):
        scaled = K / size[:, np.newaxis]
        height = (scaled * g).sum(axis=-1)
        upright = np.abs(scaled - height[:, np.newaxis] * g).max(axis=-1) <= VERTICAL
    pairs = sum((J[:, i] == J[:, (i + 1) % 3]).astype(int) for i in range(3))
    moving = moves(J, D, scaled)
    return moving & ((D == 0.0) | (upright & (pairs == 1)))


def top_frames(
    ball: Ball, momentum: ArrayLike, gamma: ArrayLike, index: ArrayLike, *, attitude: bool | ArrayLike = False,
    time_step: float | None = None,
) -> Trajectory:  # fmt: skip
    """The states of `trajectory` at the step numbers `index`, each at once, where `is_top`.

    𝒦 by Jacobi's functions of u₀ + k δ (5.7, 5.15-euler), γ and the attitude by the precession about 𝒦 (lemmas
    `top-precession`, `top-commutes`), k δ and k Ψ in double-double.  The cost does not depend on the step numbers, and
    neither does the error, for k below 10¹⁴: some ulps, and near the separatrix as many more as the period is longer;
    of γ and the attitude up to 1/k' ulps there, as b is no longer than k' while the top is near its unstable axis.
    γ counts as divided by its length, as at the higher precisions.  The sign of an attitude's quaternion is that of the
    scalar of the rotation since frame 0, taken as positive.

    index: ascending whole numbers from 0 on, (frames,).  The other arguments, what is raised (StepNotTaken for one ball
    beyond the fold, a `status` in a batch) and the result are those of `trajectory`, without the contact point.
    Raises BadInput for a ball that is no such top, on a separatrix, or too near to one, too.
    """
    numbered = step_numbers(index)
    shape, (K, g, J, D) = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
    if not _is_top(K, g, J, D).all():
        raise BadInput(
            "this is no top whose frames are known at once: D must be 0, or two J equal and momentum along gamma, "
            "and it must not be steady (`is_steady`); run `trajectory`"
        )
    follow = not (isinstance(attitude, bool | np.bool_) and not attitude)
    balls, frames = len(D), len(numbered)
    momenta, verticals = np.full((2, balls, frames, 3), np.nan)
    turned = np.full((balls, frames, 4), np.nan)
    status, reach = np.zeros(balls, dtype=np.int64), np.ones(balls)
    momenta[:, numbered == 0], verticals[:, numbered == 0] = K[:, np.newaxis], g[:, np.newaxis]
    turned[:, numbered == 0] = [1.0, 0.0, 0.0, 0.0]
    later = numbered > 0
    for i in range(balls):
        try:
            motion = motion_of(Ball(J[i], D[i]), K[i], g[i])
        except StepNotTaken as stopped:
            status[i], reach[i] = stopped.status, stopped.reach
            continue
        momenta[i, later] = motion.momenta(numbered)[later]
        if follow or D[i] == 0.0:
            turned[i, later] = Precession.of(motion).rotations(numbered)[later]
        directions = kernels.transport(turned[i], g[i]) if D[i] == 0.0 else motion.directions(numbered)
        verticals[i, later] = directions[later]
    attitudes = None
    if follow:
        first = np.broadcast_to(initial_attitude(attitude, g.reshape(*shape, 3)), (*shape, 4)).reshape(-1, 1, 4)
        taken = np.isfinite(turned).all(axis=-1)
        attitudes = np.full_like(turned, np.nan)
        attitudes[taken] = kernels.compose(np.broadcast_to(first, turned.shape)[taken], turned[taken])
        attitudes = attitudes.reshape(*shape, frames, 4)
    return finished(
        Trajectory(
            ball, numbered, momenta.reshape(*shape, frames, 3), verticals.reshape(*shape, frames, 3), attitudes, None,
            np.where(status == Status.TAKEN, numbered[-1], 0).reshape(shape), status.reshape(shape), time_step,
        ), reach,
    )  # fmt: skip


def motion_of(ball: Ball, K: Floats, g: Floats) -> TopMotion:
    """The motion of one ball that `is_top`; raises as `TopMotion` does."""
    if float(ball.D) == 0.0:
        return TopMotion.free(ball, K)
    return TopMotion.vertical(ball, float(K @ g) / float(np.sqrt(g @ g)), g)
