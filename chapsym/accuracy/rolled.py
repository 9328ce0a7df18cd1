"""A ball in SI units: its motion, or the map in its place."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from chapsym.dynamics import BadInput, Ball, Trajectory, kernels, trajectory
from chapsym.dynamics.attitudes import attitude_with, initial_attitude
from chapsym.dynamics.ball import SMALLEST, Floats, batch, checked_before, numbers, unit_vertical
from chapsym.dynamics.enclosed_motion import of_motion
from chapsym.dynamics.map import flag, rolling_radius, seconds, whole_number
from chapsym.dynamics.results import finished, in_given_axes, of_balls
from chapsym.generated import contact_momentum
from chapsym.numbers import Precision

from .motion import DEFAULT, FINEST, Problem, moved

#: Where the contact point begins.
HERE = (0.0, 0.0)


def roll(
    ball: Ball,
    omega: ArrayLike,
    time_step: float,
    steps: int,
    *,
    gamma: ArrayLike | None = None,
    axes: Literal["body", "space"] = "body",
    every: int = 1,
    attitude: bool | ArrayLike = False,
    contact: bool = False,
    position: ArrayLike = HERE,
    accuracy: float | None = None,
    order: int | None = None,
    precision: str | Precision | None = None,
    map: bool = False,
    proved: bool = False,
    threads: int = 0,
    progress: Callable[[int], None] = lambda steps_done: None,
) -> Trajectory:
    """Rolls a ball without slipping (2.3), and keeps its state every `every` times `time_step` seconds.

    omega: the angular velocity at the start in rad/s, shape (..., 3), in body axes (those of the inertia tensor), or in
    those of space.
    time_step, steps: when the states are kept, and how long; the steps in between are chosen.
    gamma: the unit vertical, upwards, in body axes, (..., 3); without, that of the attitude, or (0, 0, 1).
    attitude: True (from the least rotation with R γ = e₃) or unit quaternions, body to space, (..., 4), to be followed.
    contact: whether to trace the contact point; it needs `ball.radius`, and implies the attitude.
    position: the contact point at the start in m, (..., 2).
    accuracy: of γ, of K, ω and the contact point relative to |K|, the largest |ω| and the radius, and of the attitude
    in radians, at every frame; 1e-6 without.  `error` of the result is an estimate of what was reached: what the flow
    makes of the errors of all steps together.  It is larger than what was asked for where a start is too near to a
    separatrix.
    order, precision, map: any of them takes the map in steps of `time_step` in the place of the motion, as `trajectory`
    does, with 𝒦 = ε(Λω - D⟨ω,γ⟩γ).  threads, progress: as of `trajectory`.
    proved: whether `Trajectory.proved` shall bound what every frame is off by: from the motion of the ball that starts
    at the numbers of frame 0, by `certified_motion`, which takes a thousand times as long; with `map`, as
    `trajectory` does.  Of one ball in principal axes.

    One ball that cannot be followed raises StepNotTaken; in a batch the others go on, and `status` tells.
    Raises BadInput for what no ball or run can have, and for an accuracy that double precision has not.
    """
    spin, vertical, turned = _start(ball, omega, gamma, attitude, axes)
    place = None if position is HERE else numbers(position, "position", 2)
    by_map = flag(map, "map") or order is not None or precision is not None
    if by_map and accuracy is not None:
        raise BadInput("accuracy is of the motion of the ball; leave out order, precision and map")
    if flag(proved, "proved") and (ball.axes is not None or not ball.is_one or spin.ndim > 1 or vertical.ndim > 1):
        raise BadInput("proved=True takes one ball in principal axes, and all vectors in these")
    run = _rolled(
        ball, spin, vertical, turned, flag(contact, "contact"), "double" if precision is None else precision,
        seconds(time_step), whole_number(steps, "steps", 0), whole_number(every, "every", 1),
        2 if order is None else order, None if by_map else _accuracy(accuracy), whole_number(threads, "threads", 0),
        progress, bool(proved) and by_map,
    )  # fmt: skip
    if proved and not by_map:
        run = replace(run, proved=of_motion(run))
    if contact and place is not None:
        run.contact[...] += place[..., np.newaxis, :]
    return run


#: Momenta between these need no closer look.
ORDINARY = 1e-290, 1e290
#: The reach of a ball that stops.
UNKNOWN = np.full(1, np.nan)
#: A unit quaternion times this turns the other way; and the vertical in space.
_INVERSE, _UP = np.array([1.0, -1.0, -1.0, -1.0]), np.array([0.0, 0.0, 1.0])


def _start(
    ball: Ball, omega: ArrayLike, gamma: ArrayLike | None, attitude: bool | ArrayLike, axes: str
) -> tuple[Floats, Floats, bool | Floats]:
    """ω and γ in body axes, and the attitude that is to be followed."""
    spin = numbers(omega, "omega", 3)
    turned: bool | Floats = (
        bool(attitude) if isinstance(attitude, bool | np.bool_) else numbers(attitude, "attitude", 4)
    )
    if gamma is not None or isinstance(turned, bool):
        vertical = unit_vertical((0.0, 0.0, 1.0) if gamma is None else gamma)
    else:
        length = np.sqrt((turned * turned).sum(axis=-1, keepdims=True))
        if not (length > 0).all():
            raise BadInput("attitude must be unit quaternions (scalar first); divide by the length")
        vertical = kernels.rotate(turned / length * _INVERSE, _UP)
    if not isinstance(ball, Ball):
        raise BadInput(f"ball must be a chapsym.Ball, not {type(ball).__name__}")
    if not (ball.is_one and spin.ndim == vertical.ndim == 1):
        batch(ball.principal, spin, vertical)  # so that a mistake is reported in the names of this function
    if not isinstance(turned, bool):
        turned = initial_attitude(turned, vertical)
    if not isinstance(axes, str) or axes not in ("body", "space"):
        raise BadInput(f'axes must be "body" or "space", not {axes!r}')
    if axes == "space":
        to_space = attitude_with(vertical) if isinstance(turned, bool) else turned
        spin = kernels.rotate(to_space * _INVERSE, spin)
    return spin, vertical, turned


@in_given_axes
def _rolled(
    ball: Ball, omega: Floats, gamma: Floats, attitude: bool | Floats, contact: bool, precision: str | Precision,
    epsilon: float, steps: int, every: int, order: int, accuracy: float | None, threads: int,
    progress: Callable[[int], None], proved: bool,
) -> Trajectory:  # fmt: skip
    """The map, or to an accuracy the motion as a trajectory of order 0, in principal axes."""
    K = _momentum(ball, omega, gamma, epsilon)
    if accuracy is None:
        return trajectory(
            ball, epsilon * K, gamma, steps, order=order, every=every, attitude=attitude, contact=contact,
            time_step=epsilon, precision=precision, proved=proved, threads=threads, progress=progress,
        )  # fmt: skip
    shape, (flat, g, J, D) = batch(ball, K, gamma)
    every, radius = min(every, steps + 1), rolling_radius(ball) if contact else ball.radius
    if radius is not None:
        radius = radius.reshape(1).copy() if not shape else np.broadcast_to(radius, shape).reshape(-1).copy()
    if isinstance(attitude, bool):
        turned = attitude_with(g if shape else g[0]).reshape(-1, 4) if contact or attitude else None
    else:
        turned = np.broadcast_to(attitude, (*shape, 4)).reshape(-1, 4)
    body = checked_before(J, D, radius)
    problem = Problem(body, flat, g, every * epsilon, steps // every, accuracy, turned, contact, threads=threads)
    found = moved(problem, lambda balls: progress(int(balls * steps)))
    taken = found.reached * every
    taken[found.reached == problem.frames] = steps
    found.angular_momentum[...] *= epsilon
    run = of_balls(
        Trajectory, shape, ball, np.arange(0, steps + 1, every), found.angular_momentum, found.gamma, found.attitude,
        found.contact, taken, found.status, time_step=epsilon, order=0, error=found.error.reshape(shape),
    )  # fmt: skip
    return finished(run, UNKNOWN)


def _momentum(ball: Ball, omega: Floats, gamma: Floats, epsilon: float) -> Floats:
    """K = Λω - D⟨ω,γ⟩γ; raises BadInput where float64 loses digits of K or 𝒦 = εK."""
    if ball.is_one and omega.ndim == gamma.ndim == 1:  # in floats, which a single ball is faster in
        numbers_of = (*omega.tolist(), *gamma.tolist(), *ball.mass_tensor.tolist(), float(ball.D))
        several = contact_momentum(*numbers_of)
        K = np.array(several)
        if ORDINARY[0] < epsilon * max(map(abs, several)) < ORDINARY[1]:
            return K
    else:
        with np.errstate(over="ignore", under="ignore"):
            K = kernels.contact_momentum(omega, gamma, ball.mass_tensor, ball.D)
    with np.errstate(over="ignore", under="ignore"):
        momentum = epsilon * K
    if not np.isfinite(momentum).all():
        raise BadInput("𝒦 = εK is beyond the range of float64, about 1.8e308; take a shorter time step or other units")
    if (small := np.abs(momentum).max(axis=-1) < SMALLEST).any() and np.any(
        small & omega.any(axis=-1) & (ball.inertia > 0).all(axis=-1)
    ):
        raise BadInput("𝒦 = εK is below the range of float64, about 2.2e-308; take a longer time step or other units")
    return K


def _accuracy(given: float | None) -> float:
    if given is None or (isinstance(given, float) and given >= FINEST and given < math.inf):
        return DEFAULT if given is None else float(given)
    found = numbers(given, "accuracy")
    if found.ndim or not found >= FINEST:
        raise BadInput(
            f"accuracy must be one number from {FINEST:g} on, not {given!r}; `accurate` has more digits than float64"
        )
    return float(found)
