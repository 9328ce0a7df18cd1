"""Steps and trajectories of order 4, 6 and 8: symmetric compositions of the map.

All momentum integrals stay exact: every stage turns 𝒦 and γ by one rotation (lemma `momentum-integrals-composed`).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import composed_loop, loop
from .ball import Ball, Floats, numbers
from .coefficients import substeps
from .engine import CHUNK, SHORT_RUN
from .errors import BadInput, Status, StepNotTaken
from .map import Step, batch, explain, unit_vertical
from .trajectories import Trajectory, _count, _seconds, initial_attitude


@dataclass(frozen=True, eq=False)
class ComposedTrajectory(Trajectory):
    """A trajectory whose steps are compositions of the given order."""

    order: int = 2


def compose_step(ball: Ball, momentum: ArrayLike, gamma: ArrayLike, order: int) -> Step:
    """One step of the composition of order 2, 4, 6 or 8; arguments, result and errors as for `step`.

    `rotation` is the product of the rotations of the stages; where a stage is not taken, `reach` is the fraction of
    its momentum that the small-rotation branch attains.
    """
    c = substeps(order)
    shape, (K, g, J, D) = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
    rotation = np.tile([1.0, 0.0, 0.0, 0.0], (len(D), 1))
    status, reach = np.zeros(len(D), dtype=np.int64), np.ones(len(D))
    take = _kernel("composed_step", len(D) * len(c))
    for i in range(len(D)):
        one, scale = _under_way(c, K[i], g[i], J[i], D[i])
        status[i], reach[i] = take(*one, True, rotation[i], np.zeros(2), 0.0)
        K[i], g[i] = scale * one[0][:3], one[0][3:6]
        if status[i] != Status.TAKEN:
            status[i] = explain(status[i], K[i], g[i], J[i], D[i])
            if not shape:
                raise StepNotTaken(Status(int(status[i])), float(reach[i]))
            rotation[i], K[i], g[i] = np.nan, np.nan, np.nan
    return Step(
        rotation.reshape(*shape, 4), K.reshape(*shape, 3), g.reshape(*shape, 3),
        status.reshape(shape), reach.reshape(shape),
    )  # fmt: skip


def composed_trajectory(
    ball: Ball,
    momentum: ArrayLike,
    gamma: ArrayLike,
    steps: int,
    *,
    order: int,
    every: int = 1,
    attitude: bool | ArrayLike = False,
    contact: bool = False,
    time_step: float | None = None,
    progress: Callable[[int], None] = lambda steps_done: None,
) -> ComposedTrajectory:
    """`trajectory`, each of the steps a composition of the order 2, 4, 6 or 8; the other arguments as there.

    momentum: 𝒦 = ε K with the ε of the whole step; the stage i is a step of the map with cᵢ𝒦, cᵢ from `substeps`.
    K, γ, the attitude and the contact point all converge with that order to those of the continuous ball (2.3).
    """
    c = substeps(order)
    steps, every = _count(steps, "steps", 0), _count(every, "every", 1)
    every = min(every, steps + 1)
    shape, (K, g, J, D) = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
    with_body = contact or not (isinstance(attitude, bool | np.bool_) and not attitude)
    if contact and ball.radius is None:
        raise BadInput("the contact point needs the radius: give the ball its radius")
    radius = np.broadcast_to(ball.radius if contact and ball.radius is not None else 0.0, shape).reshape(-1)
    frames = _frames(len(D), steps // every + 1, with_body)
    momenta, verticals, attitudes, traces = frames
    momenta[:, 0], verticals[:, 0] = K, g
    bodies, spots = np.zeros((len(D), 4)), np.zeros((len(D), 2))
    if with_body:
        bodies[:] = np.broadcast_to(initial_attitude(attitude, g.reshape(*shape, 3)), (*shape, 4)).reshape(-1, 4)
        attitudes[:, 0], traces[:, 0] = bodies, 0.0
    march = _kernel("march_composed", steps * len(D) * len(c))
    taken, status = np.zeros(len(D), dtype=np.int64), np.zeros(len(D), dtype=np.int64)
    reach, done = np.ones(len(D)), 0
    for i in range(len(D)):
        one, scale = _under_way(c, K[i], g[i], J[i], D[i])
        for first in range(0, steps, CHUNK):
            count = min(CHUNK, steps - first)
            went, status[i], reach[i] = march(
                *one, first, count, every, scale, momenta[i], verticals[i],
                with_body, bodies[i], spots[i], radius[i], attitudes[i], traces[i],
            )  # fmt: skip
            taken[i] += went
            done += count
            progress(done)
            if status[i] != Status.TAKEN:
                status[i] = explain(status[i], scale * one[0][:3], one[0][3:6], J[i], D[i])
                break
    momenta, verticals, attitudes, traces = (x.reshape(*shape, *x.shape[1:]) for x in frames)
    result = ComposedTrajectory(
        ball, np.arange(momenta.shape[-2]) * every, momenta, verticals, attitudes if with_body else None,
        traces if contact else None, taken.reshape(shape), status.reshape(shape),
        None if time_step is None else _seconds(time_step), order,
    )  # fmt: skip
    if not shape and status[0] != Status.TAKEN:
        raise StepNotTaken(Status(int(status[0])), float(reach[0]), int(taken[0]), _up_to(result, int(taken[0])))
    return result


def _under_way(c: Floats, K: Floats, g: Floats, J: Floats, D: float) -> tuple[list[Floats], float]:
    """What `composed_step` needs of one ball at its start, and the scale, with 𝒦 = scale·k, of `prepare`.

    Each stage has the certificate of its own momentum, and a filter that knows nothing yet.
    """
    state, one = np.zeros((2, loop.ROWS))
    certificates = np.zeros((2, len(c)))
    for i, x in enumerate(c):
        loop.prepare(x * K, g, J, float(D), one)
        certificates[:, i] = one[loop.RADIUS], one[loop.CONTRACTION]
    scale = loop.prepare(K, g, J, float(D), state)
    return [state, c, *certificates, np.zeros((len(c), 8, 3))], scale


def _frames(balls: int, frames: int, with_body: bool) -> list[Floats]:
    """Room for 𝒦, γ, attitudes and traces; the last two empty when they are not asked for."""
    try:
        counts = 2 * [frames] + 2 * [frames if with_body else 0]
        return [np.full((balls, n, k), np.nan) for n, k in zip(counts, (3, 3, 4, 2), strict=True)]
    except (MemoryError, ValueError):
        raise BadInput(f"{frames} frames of {balls} balls do not fit into memory; keep fewer with every=") from None


def _up_to(whole: ComposedTrajectory, taken: int) -> ComposedTrajectory:
    """The frames of one ball that exist."""
    kept = whole.index <= taken
    fields = ("index", "momentum", "gamma", "attitude", "contact")
    present = {name: getattr(whole, name) for name in fields}
    return replace(whole, **{name: x[kept] for name, x in present.items() if x is not None})


def _kernel(name: str, stages: int) -> Callable[..., Any]:
    """A function of `composed_loop`, compiled unless the run is so short that compiling would take longer."""
    return getattr(composed_loop, name) if stages < SHORT_RUN else _compiled(name)


@cache
def _compiled(name: str) -> Callable[..., Any]:
    import numba
    from numba.extending import register_jitable

    from . import compiled

    compiled._registered()
    for function in (composed_loop.extrapolated, composed_loop.turned_with, composed_loop.composed_step):
        register_jitable(error_model="numpy", forceinline=function is not composed_loop.composed_step)(function)
    with compiled._caching_in(compiled.cache_folder()):
        return numba.njit(cache=True, error_model="numpy", nogil=True)(getattr(composed_loop, name))
