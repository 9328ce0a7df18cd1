"""The reduced map G_h on the sphere: vertical momentum 𝒦 = hγ (Section 5); the state is γ alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

import chapsym.dynamics.native as native
from chapsym.numbers import NAMED

from ..ball import Ball, Floats, batch, callback, common_shape, in_shape, numbers, unit_vertical
from ..errors import BadInput, Status, StepNotTaken
from ..levels import dispatch, double
from ..levels.frames import Balls, Frames, after, parts
from ..loops import loop, vertical_loop
from ..loops.records import Steps
from ..map import MOST_STEPS, whole_number
from ..results import Step, finished
from ..shown import Brief
from .elliptic import NEAREST, Curve, increment

#: The number of turns over which the rotation number is averaged, and the least and the largest number of steps.
TURNS, LEAST, MOST = 100, 2**11, 2**18
#: The relative difference of increments that are the same up to rounding.
SAME = 2.0**-50


@dataclass(frozen=True, eq=False, repr=False)
class VerticalTrajectory(Brief):
    """States γ of one ball, or of a batch, with 𝒦 = hγ.

    Attributes
    ----------
    ball : Ball
        The balls.
    height : numpy.ndarray
        h in kg m², shape (...).
    index : numpy.ndarray
        The step number of each frame, (frames,).
    gamma : numpy.ndarray
        γ, (frames, 3) of one ball, (balls..., frames, 3) of a batch.
    taken, status : numpy.ndarray
        As in `Trajectory`.

    Examples
    --------
    >>> import chapsym
    >>> run = chapsym.trajectory_vertical(chapsym.Ball((1, 2, 4), 3), 0.1, (0.6, 0, 0.8), 1000, every=500)
    >>> run.index.tolist(), run.gamma.shape, run.level().round(12).tolist()
    ([0, 500, 1000], (3, 3), [0.146666666667, 0.146666666667, 0.146666666667])
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

    @np.errstate(under="ignore")
    def level(self) -> Floats:
        """l = ⟨γ,Λ⁻¹γ⟩ of each frame in 1/(kg m²), (..., frames): an integral of every branch (Proposition 3)."""
        inertia = (self.ball.inertia + self.ball.D[..., np.newaxis])[..., np.newaxis, :]
        return np.asarray((self.gamma * self.gamma / inertia).sum(axis=-1))


@np.errstate(over="ignore", under="ignore", invalid="ignore")  # an overflow is reported by `status`
def step_vertical(ball: Ball, height: ArrayLike, gamma: ArrayLike) -> Step:
    """One step of the reduced map G_h (5.6 as corrected): γ ↦ Ωᵀγ with 𝒦(q, γ) = hγ, on the small-rotation branch.

    Parameters
    ----------
    ball : Ball
        One ball or a batch.
    height : array_like
        h = ⟨𝒦,γ⟩ = εH in kg m², shape (...).
    gamma : array_like
        Unit verticals, (..., 3).  Both broadcast with the balls.

    Returns
    -------
    Step
        The step, with the momentum hγ.

    Raises
    ------
    BadInput, StepNotTaken
        As `step` does; a batch reports `status`.

    References
    ----------
    Equation (5.6) of Fedorov (2007), as corrected.

    Examples
    --------
    >>> import chapsym
    >>> chapsym.step_vertical(chapsym.Ball((1, 2, 4), 3), 0.1, (0.6, 0, 0.8)).gamma.round(6).tolist()
    [0.599986, -0.004763, 0.799996]
    """
    shape, given = _flat(ball, height, gamma)
    frames = _taken(given, Steps(0, 1, 1), lambda done: None, rotation=True)
    h, q = given[3], frames.attitude[:, 1]
    if not shape and frames.status[0] != Status.TAKEN:
        raise StepNotTaken(Status(int(frames.status[0])), float(frames.reach[0]))
    q *= np.where(q[:, :1] < 0, -1.0, 1.0)
    arrays = q, h[:, np.newaxis] * frames.gamma[:, 1], frames.gamma[:, 1], frames.status, frames.reach
    q, K, g, status, reach = (in_shape(shape, x) for x in arrays)
    return Step(q, K, g, status, reach)


@np.errstate(over="ignore", under="ignore", invalid="ignore")
def trajectory_vertical(
    ball: Ball,
    height: ArrayLike,
    gamma: ArrayLike,
    steps: int,
    *,
    every: int = 1,
    progress: Callable[[int], None] = lambda steps_done: None,
) -> VerticalTrajectory:
    """Takes `steps` steps of the reduced map G_h and keeps every `every`-th γ.

    Parameters
    ----------
    ball : Ball
        One ball or a batch.
    height, gamma : array_like
        As for `step_vertical`; -h runs backwards.
    steps : int
        The number of steps.
    every : int, optional
        The number of steps from one frame to the next.
    progress : callable, optional
        Called with the steps done so far, of all balls together.

    Returns
    -------
    VerticalTrajectory
        In a batch the frames of a ball after its stop are NaN, and the others continue.

    Raises
    ------
    BadInput
        As `trajectory` does.
    StepNotTaken
        For one ball that cannot take a step, with `index` and the `trajectory` before it.

    References
    ----------
    Equation (5.6) of Fedorov (2007), as corrected.

    Examples
    --------
    >>> import chapsym
    >>> chapsym.trajectory_vertical(chapsym.Ball((1, 2, 4), 3), 0.1, (0.6, 0, 0.8), 1000).gamma[-1].round(6).tolist()
    [0.579783, -0.178334, 0.795015]
    """
    steps, every = whole_number(steps, "steps", 0, MOST_STEPS), whole_number(every, "every", 1)
    callback(progress)
    every = min(every, steps + 1)
    shape, given = _flat(ball, height, gamma)
    frames = _taken(given, Steps(0, steps, every), progress)
    h, *ends = (in_shape(shape, x) for x in (given[3], frames.gamma, frames.taken, frames.status))
    return finished(VerticalTrajectory(ball, h, np.arange(steps // every + 1) * every, *ends), frames.reach)


def _flat(ball: Ball, height: ArrayLike, gamma: ArrayLike) -> tuple[tuple[int, ...], list[Floats]]:
    """The common leading shape, and γ (n, 3), J (n, 3), D (n,), h (n,) as fresh flat arrays."""
    h, g = numbers(height, "height"), unit_vertical(gamma)
    lead = common_shape([h.shape, g.shape[:-1]], "height and gamma")
    shape, (flat, J, D) = batch(ball, np.broadcast_to(g, (*lead, 3)))
    return shape, [flat, J, D, np.broadcast_to(h, shape).reshape(-1).copy()]


def _taken(given: list[Floats], steps: Steps, progress: Callable[[int], None], rotation: bool = False) -> Frames:
    """Steps of every ball, by the closed form if it holds; rotation: of one step, as the attitude of frame 1."""
    g, J, D, h = given
    precision, still = NAMED["double"], [1.0, 0.0, 0.0, 0.0] if rotation else None
    balls = Balls(h[:, np.newaxis] * g, g, J, D, np.zeros(len(D)))
    count, every = steps.last, steps.every
    frames = dispatch.begun(precision, balls, count // every + 1, still)
    others: list[int] = []
    for i in range(len(D)):
        here = after(count * (i - len(others)), progress)
        if D[i] != 0.0 or not _closed(given, i, steps, frames, here):
            others.append(i)
    if others:
        some = Balls(*(x[others] for x in vars(balls).values() if x is not None))
        full = dispatch.begun(precision, some, count // every + 1, still)
        double.run(some, count, every, full, 2, 1, after(count * (len(D) - len(others)), progress))
        for name in ("gamma", "attitude", "taken", "status", "reach"):
            getattr(frames, name)[others] = getattr(full, name)
    return frames


def _closed(given: list[Floats], i: int, steps: Steps, frames: Frames, progress: Callable[[int], None]) -> bool:
    """Whether the closed form takes every step of the ball i, whose D is 0, into its frames.

    Lemma `small-branch`: if there is a radius, a root with |q| < q₀ is the root of the small-rotation branch.
    """
    g, J, _, h = (x[i] for x in given)
    ball, q, march = np.empty(loop.ROWS), np.zeros(4), native.loop(vertical_loop.march)
    loop.entered((float(h), 0.0, 0.0), g, J, 0.0, ball)
    k, inertia, state = ball[loop.K], ball[loop.I : loop.D], np.array([*g, 0.0, 0.0, 0.0, 0.0])
    if ball[loop.RADIUS] < 0.0:
        return False
    for part in parts(steps, double.CHUNK):  # the run can be interrupted between two of them
        if not march(state, inertia, k, part, frames.gamma[i], q):
            return False
        progress(part.last)
    frames.taken[i] = steps.last
    if frames.with_body:
        frames.attitude[i, 1] = q / np.sqrt(q @ q)
    return True


def phases(curve: Curve, height: float, gamma: ArrayLike) -> Floats:
    """The arguments u of successive γ of G_h, (steps + 1, 3), unwrapped, (steps + 1,).

    The increments vary with u, by less than a turn: each is taken nearest to the increment of the first step, which is
    that of the branch (`increment`).
    """
    u = curve.argument(gamma)
    period, first = curve.period, float(increment(curve, height, u[0]))
    steps = np.diff(u)
    steps += period * np.round((first - steps) / period)
    return np.concatenate([u[:1], u[0] + np.cumsum(steps)])


def rotation_number(ball: Ball, height: float, gamma: ArrayLike) -> float:
    """The mean number of turns around the curve of γ per step of G_h with 𝒦 = hγ; negative for decreasing u.

    The mean over infinitely many steps is computed as a weighted Birkhoff average (Das and Yorke) over some hundred
    turns, with weights exp(-1/t(1-t)).  Its error falls faster than any power of their number, to that of rounding,
    about 1e-14 + 1e-18/k'² turns as measured: near the separatrix, k' -> 0, roundings lead from curve to curve.  For
    D = 0, for two equal J and for the shortest steps every increment is the same, and one is returned.

    Parameters
    ----------
    ball : Ball
        One ball.
    height : float
        h in kg m².
    gamma : array_like
        γ, (3,).

    Returns
    -------
    float
        Turns per step.

    Raises
    ------
    BadInput
        For a batch, a γ that the map fixes, a curve on the separatrix, and one with k' < 1e-6 if increments differ.
    StepNotTaken
        As `step_vertical` does.

    Examples
    --------
    >>> import chapsym
    >>> round(chapsym.rotation_number(chapsym.Ball((1, 2, 4), 3), 0.5, (0.6, 0, 0.8)), 10)
    -0.0052185687
    """
    if numbers(height, "height").ndim:
        raise BadInput("a rotation number is of one height, not of a batch")
    if (curve := Curve.through(ball, gamma)).complement == 0.0:
        raise BadInput("on the separatrix there is no turn, so no rotation number")
    start = float(curve.argument(gamma))
    step_vertical(ball, height, gamma)  # raises if there is no step
    first = float(increment(curve, height, start)) / curve.period
    others = increment(curve, height, start + curve.period * np.arange(1, 8) / 8) / curve.period
    same = (np.abs(others - first) <= SAME * abs(first)).all()
    if float(ball.D) == 0.0 or len(set(ball.mass_tensor.tolist())) < 3 or same:
        return first
    if curve.complement < NEAREST:
        raise BadInput("the curve is too near the separatrix for float64: roundings lead from curve to curve")
    turn = abs(first)
    steps = LEAST if turn * LEAST >= TURNS else min(int(TURNS / turn), MOST) if turn * MOST > TURNS else MOST
    u = phases(curve, height, trajectory_vertical(ball, height, gamma, steps).gamma)
    t = np.arange(1, steps + 1) / (steps + 1)
    with np.errstate(under="ignore"):
        weights = np.exp(-1.0 / (t * (1.0 - t)))
        return float(weights @ np.diff(u) / weights.sum() / curve.period)
