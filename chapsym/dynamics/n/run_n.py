"""The map on SO(n) × Sⁿ⁻¹ for every n ≥ 3 (Section 4): steps, trajectories, and a stepper.

The state is a skew matrix 𝒦 and a unit vector γ.  A step finds the rotation Ω with 𝒦(Ω, γ) = 𝒦 (4.13) on the branch
continued from the identity, and maps to Ωᵀ𝒦Ω and Ωᵀγ (4.11, 4.12).  For n = 3 this is `step`, in matrices.

Below the bound of `near_n` a step starts at a guess from the last rotations (`loop_n`), else at the identity.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from copy import deepcopy
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

import chapsym.dynamics.native as native
from chapsym.numbers import Digits, Double, Precision, is_a

from ..ball import Floats, brief, callback, common_shape, in_shape, is_followed, largest_moment, unit_vertical
from ..coefficients import COMPOSITIONS, substeps
from ..errors import BadInput, Status, StepNotTaken
from ..levels.dispatch import no_room, precision_of
from ..levels.frames import Count, cores, share, untaken
from ..loops import loop_n
from ..loops.loop_n import Under
from ..loops.records import Ends, Steps, Track
from ..map import MOST_STEPS, flag, rolling_radius, whole_number
from ..results import Step, Trajectory, finished, of_balls
from ..stepper import UnderWay
from . import so_n
from .ball_n import BallN, initial_attitudes, skew_matrices
from .branch_n import small_rotation
from .near_n import limits

#: The numbers in the Jacobians of the balls that are solved together, which fit into a cache.
BLOCK = 2**15
#: Stages of a ball between two points at which the run can be interrupted, at most; and the cubes of the equations of a
#: stage, n(n - 1)/2, that it solves between them: about a second.
CHUNK, WORK = 10_000, 4 * 10**9
#: The largest dimension: one step takes seconds there, and its time grows as n^6.
MOST = 64
MOVING = ("momentum", "gamma", "attitude", "contact")
UNCOUNTED = Count(lambda done: None)


@np.errstate(under="ignore")
def _stepped(
    precision: str | Precision, state: dict[str, Floats], order: int, steps: Steps, threads: int = 1,
    count: Count = UNCOUNTED,
) -> tuple[dict[str, Floats], Ends]:  # fmt: skip
    """The frames of a run from its start, (b, frames, ...), and their ends; or BadInput."""
    chosen, stages, kept = precision_of(precision), substeps(order), steps.last // steps.every + 1
    if not isinstance(chosen, Double | Digits):
        raise BadInput(f'in n dimensions precision is "double" or chapsym.Digits(N), not {brief(precision)}')
    moving = {name: state[name] for name in MOVING if name in state}
    try:
        frames = {name: np.full((len(x), kept, *x.shape[1:]), np.nan, chosen.dtype) for name, x in moving.items()}
    except (MemoryError, ValueError):
        raise no_room(kept, len(state["gamma"])) from None
    if isinstance(chosen, Double):
        return frames, run(state, frames, stages, steps, threads, count)
    from . import precise_n  # takes 40 ms for mpmath

    return frames, precise_n.run(chosen, state, frames, COMPOSITIONS[order].exact, steps, count, continued)


StepN, TrajectoryN = Step, Trajectory


def step_n(ball: BallN, momentum: ArrayLike, gamma: ArrayLike, *, precision: str | Precision = "double") -> Step:
    """One step of the map (4.11, 4.12, 4.13) on the small-rotation branch, as the first step of `trajectory_n`.

    Parameters
    ----------
    ball : BallN
        One ball or a batch, (...).
    momentum : array_like
        𝒦 = ε K of the paper, skew, in kg m², (..., n, n).
    gamma : array_like
        Unit verticals, (..., n).  Both broadcast with each other and with the balls.
    precision : str or Precision, optional
        "double", or `Digits(N)` for N digits in mpmath's numbers, from the floats that are given.

    Returns
    -------
    Step
        The rotation Ω and 𝒦, (..., n, n), and γ, (..., n).

    Raises
    ------
    StepNotTaken
        If one ball (no leading axis) has no step; a batch reports `status` instead.
    BadInput
        For shapes, NaN, infinities, a momentum that is not skew, a gamma that is not unit, and more than 64 dimensions.

    References
    ----------
    Equations (4.11), (4.12) and (4.13) of Fedorov (2007).

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.BallN(mass_tensor=(1, 2, 4), D=3)  # for n = 3 it is the step of `chapsym.step`
    >>> after = chapsym.step_n(ball, chapsym.skew((1, -0.5, 0.75)), (2 / 7, 3 / 7, 6 / 7))
    >>> chapsym.axial(after.momentum).round(6).tolist()
    [0.908481, -0.604107, 0.788807]
    """
    shape, state = start(ball, momentum, gamma)
    state["attitude"] = np.broadcast_to(np.eye(ball.n), state["momentum"].shape)
    frames, (_, status, reach) = _stepped(precision, state, 2, Steps(0, 1, 1))
    if not shape and status[0] != Status.TAKEN:
        raise StepNotTaken(Status(int(status[0])), float(reach[0]))
    momentum, gamma, rotation = (in_shape(shape, x[:, 1]) for x in frames.values())
    return Step(rotation, momentum, gamma, status.reshape(shape), reach.reshape(shape), precision_of(precision))


def trajectory_n(
    ball: BallN,
    momentum: ArrayLike,
    gamma: ArrayLike,
    steps: int,
    *,
    order: int = 2,
    every: int = 1,
    attitude: bool | ArrayLike = False,
    contact: bool = False,
    threads: int = 0,
    precision: str | Precision = "double",
    progress: Callable[[int], None] = lambda steps_done: None,
) -> Trajectory:
    """Takes `steps` steps of the map on the small-rotation branch and keeps every `every`-th state.

    Below the bound of `near_n`, compiled steps start at a guess from the last steps; above it, each step is continued
    from the identity.

    Parameters
    ----------
    ball : BallN
        One ball or a batch, (...).
    momentum : array_like
        𝒦, skew, in kg m², (..., n, n).
    gamma : array_like
        Unit verticals, (..., n).  Both broadcast with each other and with the balls.
    steps : int
        The number of steps.
    order : int, optional
        2, or 4, 6, 8 for a symmetric composition of the map with stages cᵢ𝒦 (`substeps`), as for `trajectory`.
    every : int, optional
        The number of steps from one frame to the next.
    attitude : bool or array_like, optional
        True (from the least rotation with R γ = eₙ) or rotations, (..., n, n), to be followed.
    contact : bool, optional
        Whether to trace the contact point; it needs `ball.radius`, and implies the attitude.
    threads : int, optional
        The number of cores that a batch may use if its steps are compiled; 0 for all.
    precision : str or Precision, optional
        "double", or `Digits(N)` for N digits in mpmath's numbers, at milliseconds per step.  It starts from the given
        floats, with γ divided by its length, and the attitude replaced by the nearest rotation.
    progress : callable, optional
        Called with the steps done so far, of all balls together.

    Returns
    -------
    Trajectory
        In a batch, the others continue if a ball stops, and `status` and `taken` show which stopped, and where.

    Raises
    ------
    StepNotTaken
        If one ball cannot take a step, with `index` and the `trajectory` before it.
    BadInput
        As `step_n` does, and for counts that are not whole numbers.

    References
    ----------
    Equations (4.11), (4.12) and (4.13) of Fedorov (2007).

    Examples
    --------
    >>> import chapsym, numpy
    >>> K = numpy.zeros((4, 4))
    >>> K[1, 0], K[3, 2] = 0.3, -0.2
    >>> run = chapsym.trajectory_n(chapsym.BallN((1, 2, 0.5, 3), 3), K - K.T, (0.1, 0.1, 0.7, 0.7), 100)
    >>> run.invariants()[[0, -1]].round(12).tolist()  # tr 𝒦², tr 𝒦⁴, γᵀ𝒦²γ, |γ|²
    [[-0.26, 0.0194, -0.041, 1.0], [-0.26, 0.0194, -0.041, 1.0]]
    """
    steps, every = whole_number(steps, "steps", 0, MOST_STEPS), whole_number(every, "every", 1)
    threads = whole_number(threads, "threads", 0)
    callback(progress)
    every = min(every, steps + 1)
    shape, state = start(ball, momentum, gamma, attitude, contact)
    frames, ends = _stepped(precision, state, order, Steps(0, steps, every), threads, Count(progress))
    index, flat = np.arange(0, steps + 1, every), (*(frames.get(name) for name in MOVING), ends.taken, ends.status)
    result = of_balls(shape, ball, index, *flat, order=int(order), precision=precision_of(precision))
    return finished(result, ends.reach)


class StepperN(UnderWay):
    """One ball in n dimensions for control loops, as `Stepper` in three: steps of the map with little cost per call.

    The states have the same bits as `trajectory_n` from the same start, for any division of the steps into calls.

    Objects share no mutable data: each may run in a thread of its own.  `copy.copy` makes another object that continues
    from the same state.

    Parameters
    ----------
    ball : BallN
        One ball.  All arguments are as for `trajectory_n`, and are checked here.
    momentum : array_like
        𝒦, skew, in kg m², (n, n).
    gamma : array_like
        γ, (n,).
    order : int, optional
        2, 4, 6 or 8.
    attitude : bool or array_like, optional
        True or a rotation, (n, n), to be followed.
    contact : bool, optional
        Whether to trace the contact point.

    Raises
    ------
    BadInput
        As `trajectory_n` does, and for a batch.

    Examples
    --------
    >>> import chapsym
    >>> ball = chapsym.BallN(mass_tensor=(1, 2, 4), D=3)
    >>> stepper = chapsym.StepperN(ball, chapsym.skew((0.1, 0.2, 0.3)), (0, 0, 1))
    >>> stepper.step(40); stepper.step(60)
    >>> run = chapsym.trajectory_n(ball, chapsym.skew((0.1, 0.2, 0.3)), (0, 0, 1), 100)
    >>> bool((stepper.momentum == run.momentum[-1]).all())
    True
    """

    def __init__(
        self, ball: BallN, momentum: ArrayLike, gamma: ArrayLike, *, order: int = 2, attitude: bool | ArrayLike = False,
        contact: bool = False,
    ) -> None:  # fmt: skip
        self._ball, self._order, self._stages = ball, order, substeps(order)
        self._traced = flag(contact, "contact")
        self._follows = self._traced or is_followed(attitude)
        self.restart(momentum, gamma, attitude)

    def restart(self, momentum: ArrayLike, gamma: ArrayLike, attitude: bool | ArrayLike = True) -> None:
        """Restarts from 𝒦, γ and, if followed, an attitude and the contact point 0.

        Parameters
        ----------
        momentum : array_like
            𝒦, (n, n).
        gamma : array_like
            γ, (n,).
        attitude : bool or array_like, optional
            A rotation, (n, n), or True for the least rotation with R γ = eₙ.

        Raises
        ------
        BadInput
            As StepperN does; the state is then unchanged.

        Examples
        --------
        >>> import chapsym
        >>> stepper = chapsym.StepperN(chapsym.BallN((1, 2, 4), 3), chapsym.skew((0.1, 0.2, 0.3)), (0, 0, 1))
        >>> stepper.step(10)
        >>> stepper.restart(chapsym.skew((0.3, 0.2, 0.1)), (0, 0, 1))
        >>> stepper.taken, chapsym.axial(stepper.momentum).tolist()
        (0, [0.3, 0.2, 0.1])
        """
        shape, state = start(self.ball, momentum, gamma, attitude if self._follows else False, self._traced)
        if shape:
            raise BadInput(f"a StepperN takes one ball, not a batch with the leading axes {shape}")
        self._begin(state)

    def _go_on(self, momentum: ArrayLike) -> None:
        if (K := skew_matrices(momentum, self.ball.n)).ndim > 2:
            raise BadInput(f"momentum must be one skew matrix, not of the shape {K.shape}")
        now = {name: array[1:].copy() for name, array in self._ends.items()}
        self._begin(self._state | now | {"momentum": K[np.newaxis]})

    def __copy__(self) -> Self:
        return deepcopy(self)

    def _begin(self, state: dict[str, Floats]) -> None:
        bounds = limits(state["momentum"], state["mass_tensor"], state["D"], self._stages)
        self._below, self._taken = bool((bounds[0] > 0).all()), 0
        #: The moving state: above the bound, and below it.
        self._state, (self._one,) = state, begun(state, bounds, self._stages)
        self._ends = {name: np.repeat(state[name], 2, axis=0) for name in MOVING if name in state}

    def _frames(self, count: int) -> dict[str, Floats]:
        return {name: np.empty((count, *array.shape[1:])) for name, array in self._ends.items()}

    def _take(self, steps: int, every: int, frames: dict[str, Floats]) -> tuple[int, int, float]:
        in_parts = self.order > 2 or not self._below
        moving = {name: getattr(self._one, name).copy() for name in ("k", "g", "past", "use", "R", "spot")}
        before = self._state, self._one._replace(**moving)
        try:
            taken, status, reach = self._march(Steps(0, steps, every), frames)
        except BaseException:  # an interrupt undoes the steps of this call
            self._state, self._one = before
            self._show()
            raise
        if status != Status.TAKEN and in_parts:  # some stages of the last step were taken
            self._state, self._one = before
            self._march(Steps(0, taken, every), frames)
        self._taken += taken
        if frames is not self._ends or taken < steps:
            self._show()
        return taken, status, reach

    def _march(self, steps: Steps, frames: dict[str, Floats]) -> tuple[int, int, float]:
        if self._below:
            return advance(self._one, frames, steps, UNCOUNTED)
        ends, batch = untaken(1), {name: array[np.newaxis] for name, array in frames.items()}
        self._state = continued(self._state, batch, self._stages, steps, ends, np.zeros(1, np.int64), UNCOUNTED)
        return int(ends.taken[0]), int(ends.status[0]), float(ends.reach[0])

    def _show(self) -> None:
        """Copies the state of the loop to the present state."""
        if self._below:
            keep(self._one, self._ends, 1)
        else:
            for name, array in self._ends.items():
                array[1] = self._state[name][0]


def start(
    ball: BallN, momentum: ArrayLike, gamma: ArrayLike, attitude: bool | ArrayLike = False, contact: bool = False
) -> tuple[tuple[int, ...], dict[str, Floats]]:
    """The common leading shape, and the state for `run`, checked read-only arrays; raises BadInput."""
    if not is_a(ball, BallN):
        raise BadInput(f"ball must be a chapsym.BallN, not {type(ball).__name__}")
    if ball.n > MOST:
        raise BadInput(f"a step solves n(n - 1)/2 equations: the ball has n = {ball.n}, but n must be at most {MOST}")
    K, g = skew_matrices(momentum, ball.n), unit_vertical(gamma, ball.n)
    radius = () if ball.radius is None else ball.radius.shape
    leading = [ball.mass_tensor.shape[:-1], ball.D.shape, radius, K.shape[:-2], g.shape[:-1]]
    shape = common_shape(leading, "ball (mass_tensor, D, radius), momentum and gamma")
    given = {"momentum": (K, 2), "gamma": (g, 1), "mass_tensor": (ball.mass_tensor, 1), "D": (ball.D, 0)}
    if flag(contact, "contact"):
        given["radius"] = rolling_radius(ball), 0
    count, state = int(np.prod(shape, dtype=np.int64)), {}
    for name, (x, axes) in given.items():
        own = x.shape[x.ndim - axes :]
        state[name] = np.broadcast_to(x, (*shape, *own)).reshape(count, *own)
    if contact or is_followed(attitude):
        state["attitude"] = initial_attitudes(attitude, state["gamma"], shape)
    if contact:
        state["contact"] = np.zeros((count, ball.n - 1))
    return shape, state


def run(
    state: dict[str, Floats], frames: dict[str, Floats], stages: Floats, steps: Steps, threads: int, count: Count
) -> Ends:
    """Takes the steps of each ball into the frames from 1 on.

    state: momentum (b, n, n), gamma (b, n), mass_tensor (b, n) and D (b,); to be followed, attitude (b, n, n), contact
    (b, n-1) and radius (b,).  frames: arrays (b, frames, ...) of the moving quantities; frame 0 is written here.
    stages: cᵢ of the composition, (s,).  threads: the number of cores for compiled steps.  count: of the steps of all
    balls.
    """
    for name, array in frames.items():
        array[:, 0] = state[name]
    balls, n = state["gamma"].shape
    ends = untaken(balls)
    near, enough = limits(state["momentum"], state["mass_tensor"], state["D"], stages)
    below = (near > 0).all(axis=-1)
    for at in blocks(np.flatnonzero(below), n):
        under = begun(some_balls(state, at), (near[at], enough[at]), stages)
        march(under, frames, at, steps, ends, threads, count)
    for at in blocks(np.flatnonzero(~below), n):
        continued(some_balls(state, at), frames, stages, steps, ends, at, count)
    return ends


def march(
    under: list[Under], frames: dict[str, Floats], at: np.ndarray, steps: Steps, ends: Ends, threads: int, count: Count
) -> None:
    """Takes steps of balls below the bound, and writes the rows `at` of the frames and of the ends."""

    def task(i: int) -> None:
        own = {name: array[at[i]] for name, array in frames.items()}
        for kept, found in zip(ends, advance(under[i], own, steps, count), strict=True):
            kept[at[i]] = found

    share(task, range(len(at)), min(threads or cores(), len(at)), count)


def blocks(balls: np.ndarray, n: int) -> Iterator[np.ndarray]:
    """The indices of the balls of a batch, in the blocks that are solved together."""
    size = max(1, BLOCK // (n * n * n * (n - 1) // 2))
    return (balls[first : first + size] for first in range(0, len(balls), size))


def some_balls(state: dict[str, Floats], at: np.ndarray) -> dict[str, Floats]:
    """The states of some of the balls."""
    return {name: array[at] for name, array in state.items()}


@np.errstate(under="ignore")
def continued(
    state: dict[str, Floats], frames: dict[str, Floats], stages: Iterable[Any], steps: Steps, ends: Ends,
    at: np.ndarray, count: Count, rotations: Callable[..., tuple[Floats, np.ndarray, Floats]] = small_rotation,
) -> dict[str, Floats]:  # fmt: skip
    """Takes steps of some balls together, and writes the rows `at` of the frames and of the ends.

    rotations: a function that finds the rotations of a stage, as `small_rotation` in float64.
    Returns the states of the balls that took all steps.
    """
    for step in range(1, steps.last + 1):
        for c in stages:
            K, rest = c * state["momentum"], (state[x] for x in ("gamma", "mass_tensor", "D"))
            E, ends.status[at], ends.reach[at] = rotations(K, *rest)
            if not (went := ends.status[at] == Status.TAKEN).all():
                at, E, state = at[went], E[went], some_balls(state, went)
                if not at.size:
                    return state
            state = _moved(state, E)
        ends.taken[at] += 1
        if step % steps.every == 0:
            for name in frames:
                frames[name][at, step // steps.every] = state[name]
        count.add(len(at))
    return state


def _moved(state: dict[str, Floats], E: Floats) -> dict[str, Floats]:
    """The state after the rotation 1 + E: 𝒦 and γ, and attitude and contact if followed."""
    K, g = state["momentum"], state["gamma"]
    after = {**state, "momentum": so_n.carried(K, E), "gamma": so_n.transported(g, E)}
    if "contact" in state:
        stride = (state["attitude"] @ so_n.twist(E, g)[..., np.newaxis])[..., :-1, 0]
        after["contact"] = state["contact"] + state["radius"][:, np.newaxis] / 2 * stride
    if "attitude" in state:
        after["attitude"] = so_n.polar(state["attitude"] + state["attitude"] @ E)
    return after


@np.errstate(under="ignore")
def begun(state: dict[str, Floats], limits: tuple[Floats, Floats], stages: Floats) -> list[Under]:
    """Balls at their start, from the state for `run`, in memory of their own."""
    K, g, J, D = (state[x] for x in ("momentum", "gamma", "mass_tensor", "D"))
    b, n, s = *g.shape, len(stages)
    exponent = np.frexp(largest_moment(J, D))[1]
    past, use = np.zeros((b, s, loop_n.ORDER, n, n)), np.zeros((b, s, loop_n.ORDER))
    arrays = (
        np.ldexp(K, -exponent[:, np.newaxis, np.newaxis]), g.copy(), np.ldexp(J, -exponent[:, np.newaxis]),
        np.ldexp(D, -exponent), np.tile(stages, (b, 1)), *limits, past, use, np.ldexp(1.0, exponent),
        state.get("attitude", np.zeros((b, n, n))).copy(), state.get("contact", np.zeros((b, n - 1))).copy(),
        state.get("radius", np.zeros(b)),
    )  # fmt: skip
    return [Under(*ball) for ball in zip(*arrays, strict=True)]


def keep(one: Under, frames: dict[str, Floats], frame: int) -> None:
    """Writes the state of a ball into its frames."""
    now = {"momentum": one.scale * one.k, "gamma": one.g, "attitude": one.R, "contact": one.spot}
    for name, array in frames.items():
        array[frame] = now[name]


def advance(one: Under, frames: dict[str, Floats], steps: Steps, count: Count) -> tuple[int, int, float]:
    """Takes steps of one ball into its own frames; returns (taken, status, reach)."""
    momenta, follows = frames["momentum"], "attitude" in frames
    attitudes = frames["attitude"] if follows else momenta[:0]
    traces = frames["contact"] if "contact" in frames else np.empty((len(attitudes), len(one.spot)))
    momenta, attitudes = (x.reshape(len(x), one.k.size) for x in (momenta, attitudes))
    track = Track(momenta, frames["gamma"], attitudes, traces, follows)
    s, done, take = len(one.c), 0, native.loop(loop_n.march)
    equations = len(one.g) * (len(one.g) - 1) // 2
    room, chunk = np.empty((equations, equations)), min(max(WORK // equations**3, 1), CHUNK)
    while done < steps.last * s and not count.stopped:
        last, before = min(done + chunk, steps.last * s), done
        if (done := take(one, Steps(done, last, steps.every), track, room)) < last:
            status, reach = _safely(one, done % s, follows)
            if status != Status.TAKEN:
                return done // s, status, reach
            done += 1
            if done % (s * steps.every) == 0:
                keep(one, frames, done // (s * steps.every))
        count.add(done // s - before // s)
    return done // s, Status.TAKEN, 1.0


def _safely(one: Under, s: int, with_body: bool) -> tuple[int, float]:
    """A stage at which Newton's iteration failed, by the continuation from the identity; returns (status, reach)."""
    E, status, reach = small_rotation(*(np.asarray(x)[np.newaxis] for x in (one.c[s] * one.k, one.g, one.J, one.D)))
    if status[0] == Status.TAKEN:
        n = len(one.g)
        W, c = np.empty((n, n)), np.empty(n)
        loop_n.remember(E[0], one.past[s], one.use[s])
        if with_body:
            loop_n.roll(E[0], one.g, one.R, one.spot, one.rho, c, W)
        loop_n.move(E[0], one.k, one.g, W, c)
    return int(status[0]), float(reach[0])
