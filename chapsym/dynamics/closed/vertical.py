"""The reduced map G_h on the sphere: vertical momentum 𝒦 = hγ (Section 5), where the state is γ alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..ball import Ball, Floats, numbers
from ..errors import BadInput, Status, StepNotTaken
from ..levels.double import chosen
from ..loops import gibbs, vertical_loop
from ..map import Step, batch, explain, unit_vertical
from ..trajectories import _count


@dataclass(frozen=True, eq=False)
class VerticalTrajectory:
    """States γ of one ball, shape (frames, 3), or of a batch, (balls..., frames, 3), with 𝒦 = hγ.

    height: h in kg m², shape (...).
    index: the step number of each frame, (frames,).
    taken, status: as in `Trajectory`.
    """

    ball: Ball
    height: Floats
    index: np.ndarray
    gamma: Floats
    taken: np.ndarray
    status: np.ndarray

    @property
    def momentum(self) -> Floats:
        """𝒦 = hγ in kg m², (..., frames, 3)."""
        return self.height[..., np.newaxis, np.newaxis] * self.gamma

    def level(self) -> Floats:
        """l = ⟨γ,Λ⁻¹γ⟩ of each frame in 1/(kg m²), (..., frames): an integral of every branch (Proposition 3)."""
        inertia = (self.ball.inertia + self.ball.D[..., np.newaxis])[..., np.newaxis, :]
        return np.asarray((self.gamma * self.gamma / inertia).sum(axis=-1))


def step_vertical(ball: Ball, height: ArrayLike, gamma: ArrayLike) -> Step:
    """One step of the reduced map G_h (5.6 as corrected): γ ↦ Ωᵀγ with 𝒦(q, γ) = hγ, on the small-rotation branch.

    height: h = ⟨𝒦,γ⟩ = εH in kg m², shape (...); gamma: unit verticals, (..., 3).  Both broadcast with the balls.
    The step has the momentum hγ.  Raises BadInput and StepNotTaken as `step` does; a batch reports `status`.
    """
    shape, flat = _flat(ball, height, gamma)
    g, J, D, h = flat
    q, verticals = np.full((len(D), 4), np.nan), np.zeros((1, 3))
    status, reach = np.zeros(len(D), dtype=np.int64), np.ones(len(D))
    (march,) = chosen((vertical_loop.march,), len(D))
    for i in range(len(D)):
        _, status[i], reach[i] = march(*_scaled(g[i], J[i], D[i], h[i]), 0, 1, 2, verticals, q[i])
    failed = status != Status.TAKEN
    for i in map(int, np.flatnonzero(failed)):
        status[i] = explain(status[i], h[i] * g[i], g[i], J[i], D[i])
    if not shape and failed[0]:
        raise StepNotTaken(Status(int(status[0])), float(reach[0]))
    g[failed] = np.nan
    q /= np.sqrt((q * q).sum(axis=-1, keepdims=True))
    q *= np.where(q[:, :1] < 0, -1.0, 1.0)
    gamma_next = g.reshape(*shape, 3)
    momentum = h.reshape(shape)[..., np.newaxis] * gamma_next
    return Step(q.reshape(*shape, 4), momentum, gamma_next, status.reshape(shape), reach.reshape(shape))


def trajectory_vertical(
    ball: Ball, height: ArrayLike, gamma: ArrayLike, steps: int, *, every: int = 1
) -> VerticalTrajectory:
    """Takes `steps` steps of the reduced map G_h and keeps every `every`-th γ.

    height, gamma: as for `step_vertical`; -h runs backwards.
    One ball that cannot take a step raises StepNotTaken with `index` and the `trajectory` before it; in a batch
    the others go on, and frames after the stop are NaN.  Raises BadInput as `trajectory` does.
    """
    steps, every = _count(steps, "steps", 0), _count(every, "every", 1)
    every = min(every, steps + 1)
    shape, (g, J, D, h) = _flat(ball, height, gamma)
    frames = steps // every + 1
    try:
        verticals = np.full((len(D), frames, 3), np.nan)
    except (MemoryError, ValueError):
        raise BadInput(f"{frames} frames of {len(D)} balls do not fit into memory; keep fewer with every=") from None
    verticals[:, 0] = g
    taken, status, reach = np.zeros(len(D), dtype=np.int64), np.zeros(len(D), dtype=np.int64), np.ones(len(D))
    (march,), q = chosen((vertical_loop.march,), steps * len(D)), np.zeros(4)
    for i in range(len(D)):
        taken[i], status[i], reach[i] = march(*_scaled(g[i], J[i], D[i], h[i]), 0, steps, every, verticals[i], q)
        if status[i] != Status.TAKEN:
            status[i] = explain(status[i], h[i] * g[i], g[i], J[i], D[i])
    result = VerticalTrajectory(
        ball, h.reshape(shape), np.arange(frames) * every, verticals.reshape(*shape, frames, 3),
        taken.reshape(shape), status.reshape(shape),
    )  # fmt: skip
    if not shape and status[0] != Status.TAKEN:
        kept = result.index <= taken[0]
        before = VerticalTrajectory(
            ball, result.height, result.index[kept], result.gamma[kept], result.taken, result.status
        )
        raise StepNotTaken(Status(int(status[0])), float(reach[0]), int(taken[0]), before)
    return result


def _flat(ball: Ball, height: ArrayLike, gamma: ArrayLike) -> tuple[tuple[int, ...], list[Floats]]:
    """The common leading shape, and γ (n, 3), J (n, 3), D (n,), h (n,) as fresh flat arrays."""
    h, g = numbers(height, "height"), unit_vertical(gamma)
    try:
        lead = np.broadcast_shapes(h.shape, g.shape[:-1])
    except ValueError:
        raise BadInput(f"height of shape {h.shape} and gamma of shape {g.shape} do not broadcast") from None
    shape, (flat, J, D) = batch(ball, np.broadcast_to(g, (*lead, 3)))
    return shape, [flat, J, D, np.broadcast_to(h, shape).reshape(-1).copy()]


def _scaled(g: Floats, J: Floats, D: float, h: float) -> tuple[Floats, Floats, Floats, float, float, float, float]:
    """γ, and J, D, h scaled by a power of two so that Λmax is about 1; and `gibbs.certificate`."""
    exponent = int(np.frexp(J.sum() - J.min() + D)[1])
    with np.errstate(over="ignore"):
        tensor, contact, height = np.ldexp(J, -exponent), float(np.ldexp(D, -exponent)), float(np.ldexp(h, -exponent))
    moments = np.array([tensor[1] + tensor[2], tensor[0] + tensor[2], tensor[0] + tensor[1]])
    first, second, third = map(float, moments)
    radius, enough = gibbs.certificate(0.5 * height, 0.0, 0.0, first, second, third, contact)
    if 0.0 < abs(height) < vertical_loop.SMALLEST or moments.min() < vertical_loop.SMALLEST:
        radius = -1.0  # products of three or four such numbers would underflow: every step takes the safe way
    return g, tensor, moments, contact, height, radius, enough
