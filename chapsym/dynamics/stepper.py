"""One ball for control loops: prepared once, so that a step, or a new momentum, costs about a microsecond."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from copy import deepcopy
from functools import partial
from math import isfinite
from operator import attrgetter
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import chapsym.dynamics.native as native
from chapsym.generated import angular_velocity
from chapsym.numbers import NAMED

from .attitudes import initial_attitude
from .ball import Asked, Ball, Floats, batch, is_followed, is_unit, is_vector, numbers, unit_vertical
from .errors import BadInput, Status, StepNotTaken
from .levels import dispatch, double, double_double, proved
from .levels.dispatch import no_room
from .levels.frames import Balls, parts
from .loops import loop
from .loops.loop import G, K
from .loops.records import Moving, Steps, Track
from .map import MOST_STEPS, flag, rolling_radius, seconds, whole_number
from .results import Bounds, Trajectory, finished

#: The most steps of a call before which the state is not copied: a copy takes as long as some twenty steps.
AT_ONCE = 100


class UnderWay:
    """One ball in progress, in three dimensions or n: the object keeps the state between calls."""

    _ball: Any
    _order: int
    _time_step: float | None = None
    _follows: bool
    _traced: bool
    _taken: int
    #: Buffers for a call that keeps only its end: the second row is the present state.
    _ends: dict[str, Floats]

    #: Fixed at the start.
    ball, order, time_step = (property(attrgetter(name)) for name in ("_ball", "_order", "_time_step"))

    def step(self, steps: int = 1) -> None:
        """Takes `steps` steps; only the end is kept.

        Parameters
        ----------
        steps : int, optional
            The number of steps; by default 1.

        Raises
        ------
        StepNotTaken
            If a step cannot be taken, with its `index` in this call; the state is then the one before it.

        Examples
        --------
        >>> import chapsym
        >>> moving = chapsym.Stepper(chapsym.Ball((1, 2, 4), 3), (0.1, 0.05, 0), (0, 0, 1))
        >>> moving.step()
        >>> moving.gamma.round(9).tolist()
        [-0.006249912, 0.011111155, 0.999918737]
        """
        steps = whole_number(steps, "steps", 0, MOST_STEPS)
        taken, status, reach = self._take(steps, steps or 1, self._ends)
        if status:
            raise StepNotTaken(Status(status), reach, taken)

    def trajectory(self, steps: int, every: int = 1) -> Trajectory:
        """Takes `steps` steps; returns the present state and every `every`-th one after it, with `index` from 0.

        Parameters
        ----------
        steps : int
            The number of steps.
        every : int, optional
            The number of steps from one frame to the next; by default 1.

        Returns
        -------
        Trajectory
            As the result of `trajectory`, from the present state on.

        Raises
        ------
        StepNotTaken
            As `step`, with the `trajectory` before.

        Examples
        --------
        >>> import chapsym
        >>> moving = chapsym.Stepper(chapsym.Ball((1, 2, 4), 3), (0.1, 0.05, 0), (0, 0, 1))
        >>> moving.step(100)
        >>> moving.trajectory(20, every=10).index.tolist(), moving.taken
        ([0, 10, 20], 120)
        """
        steps, every = whole_number(steps, "steps", 0, MOST_STEPS), whole_number(every, "every", 1)
        every = min(every, steps + 1)
        count = steps // every + 1
        try:
            frames = self._frames(count)
        except (MemoryError, ValueError):
            raise no_room(count, 1) from None
        for name, array in frames.items():
            if len(array):
                array[0] = self._ends[name][1]
        taken, status, reach = self._take(steps, every, frames)
        run = Trajectory(
            self.ball, np.arange(0, count * every, every), frames["momentum"], frames["gamma"],
            frames["attitude"] if self._follows else None, frames["contact"] if self._traced else None,
            np.array(taken), np.array(status), self.time_step, self.order,
        )  # fmt: skip
        if status:
            finished(run, np.array(reach))
        return run

    @property
    def momentum(self) -> Floats:
        """A copy of 𝒦 in kg m²; assign another 𝒦 to continue with the same γ, attitude and contact point.

        Returns
        -------
        ndarray
            Shape (3,), or (n, n) in n dimensions.

        Raises
        ------
        BadInput
            If an assigned value is no momentum; the state is then unchanged.

        Examples
        --------
        >>> import chapsym
        >>> moving = chapsym.Stepper(chapsym.Ball((1, 2, 4), 3), (0.1, 0.05, 0), (0, 0, 1))
        >>> moving.step(100)
        >>> moving.momentum = 2 * moving.momentum
        >>> moving.taken
        0
        """
        return self._ends["momentum"][1].copy()

    @momentum.setter
    def momentum(self, momentum: ArrayLike) -> None:
        """Continues with another 𝒦."""
        self._go_on(momentum)

    @property
    def gamma(self) -> Floats:
        """A copy of γ, (3,) or (n,)."""
        return self._ends["gamma"][1].copy()

    @property
    def attitude(self) -> Asked:
        """A copy of the attitude, from the body to space; None if it is not followed.

        Returns
        -------
        ndarray or None
            A unit quaternion, scalar first, shape (4,), or R, (n, n), in n dimensions.

        Examples
        --------
        >>> import chapsym
        >>> moving = chapsym.Stepper(chapsym.Ball((1, 2, 4), 3), (0.1, 0.05, 0), (0.6, 0, 0.8), attitude=True)
        >>> moving.attitude.round(6).tolist()
        [0.948683, 0.0, -0.316228, 0.0]
        """
        return self._ends["attitude"][1].copy() if self._follows else None

    @property
    def contact(self) -> Asked:
        """A copy of the contact point in metres, (2,) or (n-1,); None if it is not traced."""
        return self._ends["contact"][1].copy() if self._traced else None

    @property
    def taken(self) -> int:
        """The number of steps since the start, the last restart, or the last new momentum."""
        return self._taken

    def _go_on(self, momentum: ArrayLike) -> None:
        raise NotImplementedError

    def _frames(self, count: int) -> dict[str, Floats]:
        """Buffers for this many states."""
        raise NotImplementedError

    def _take(self, steps: int, every: int, frames: dict[str, Floats]) -> tuple[int, int, float]:
        """Takes steps into frames, until one is not taken; returns (taken, status, reach)."""
        raise NotImplementedError


class Stepper(UnderWay):
    """One ball for control loops and your own integrators: steps of the map with little cost per call.

    The states have the same bits as `trajectory` from the same start, for any division of the steps into calls, also
    after a restart or a new momentum.

    Objects share no mutable data: each may run in a thread of its own, and compiled steps let other threads run.  Use
    an object in one thread at a time.  `copy.copy` makes another object that continues from the same state.

    Parameters
    ----------
    ball : Ball
        One ball in principal axes.
    momentum, gamma : array_like
        𝒦 in kg m² and the unit vertical upwards, as for `trajectory`, shape (3,), in float64.  All arguments are
        checked here.
    order : int, optional
        As for `trajectory`: 2 (the default), 4, 6 or 8.
    attitude : bool or array_like, optional
        As for `trajectory`: True or a unit quaternion, (4,), to be followed.
    contact : bool, optional
        As for `trajectory`: whether to trace the contact point.
    time_step : float, optional
        As for `trajectory`: ε in seconds, which `omega` needs.

    Raises
    ------
    BadInput
        As `trajectory` does, and for a batch.

    Examples
    --------
    >>> import chapsym
    >>> ball, momentum, gamma = chapsym.Ball((1, 2, 4), 3), (0.1, 0.05, 0), (0, 0, 1)
    >>> moving = chapsym.Stepper(ball, momentum, gamma)
    >>> moving.step(600)
    >>> moving.step(400)
    >>> bool((moving.gamma == chapsym.trajectory(ball, momentum, gamma, 1000).gamma[-1]).all())
    True
    """

    def __init__(
        self, ball: Ball, momentum: ArrayLike, gamma: ArrayLike, *, order: int = 2, attitude: bool | ArrayLike = False,
        contact: bool = False, time_step: float | None = None,
    ) -> None:  # fmt: skip
        shape, _ = batch(ball, numbers(momentum, "momentum", 3), unit_vertical(gamma))
        if shape:
            raise BadInput(f"a Stepper takes one ball, not a batch with the leading axes {shape}")
        epsilon = None if time_step is None else seconds(time_step)
        self._prepare(ball, order, flag(contact, "contact") or is_followed(attitude), contact, epsilon)
        self.restart(momentum, gamma, attitude)

    def _prepare(self, ball: Ball, order: int, follows: bool, traced: bool, time_step: float | None) -> None:
        """Sets the constants of the loop, and its buffers."""
        self._ball, self._order, self._time_step = ball, order, time_step
        self._follows, self._traced = follows, traced
        self._J, self._D = ball.mass_tensor.copy(), float(ball.D)
        self._radius = float(rolling_radius(ball)) if traced else 0.0
        self._stages = double.staged(order, double.DOUBLE)
        self._march = double.DOUBLE.loop(loop.march)
        #: Whether few steps are one call of compiled code, and need no copy of the state before them.
        self._at_once = len(self._stages.c) == 1 and native.is_compiled()
        self._spin, self._spot = np.zeros(4), np.zeros(2)
        self._ends = self._frames(2)
        self._track = self._tracked(self._ends)
        self._momentum, self._gamma = self._ends["momentum"][1], self._ends["gamma"][1]
        self._proof: Proof | None = None

    def restart(self, momentum: ArrayLike, gamma: ArrayLike, attitude: bool | ArrayLike = True) -> None:
        """Restarts from 𝒦, γ and, if followed, an attitude and the contact point (0, 0).

        Parameters
        ----------
        momentum, gamma : array_like
            𝒦 in kg m² and the unit vertical upwards, shape (3,).
        attitude : bool or array_like, optional
            A unit quaternion, (4,), or True, the default, for the least rotation with R γ = e₃.

        Raises
        ------
        BadInput
            As `Stepper` does; the state is then unchanged.

        Examples
        --------
        >>> import chapsym
        >>> moving = chapsym.Stepper(chapsym.Ball((1, 2, 4), 3), (0.1, 0.05, 0), (0, 0, 1))
        >>> moving.step(100)
        >>> moving.restart((0.2, 0, 0), (0, 0, 1))
        >>> moving.momentum.tolist(), moving.taken
        ([0.2, 0.0, 0.0], 0)
        """
        k = momentum if is_vector(momentum) else _one("momentum", numbers(momentum, "momentum", 3))
        g = gamma if is_vector(gamma) and is_unit(*gamma.tolist()) else _one("gamma", unit_vertical(gamma))
        if self._follows:
            self._spin[:] = self._ends["attitude"][1] = initial_attitude(attitude, g)
            self._spot[:] = self._ends["contact"][1] = 0.0
        elif attitude is not True:
            initial_attitude(attitude, g)  # refuses what is none
        self._gamma[:] = g
        self._go_on(k)

    def _go_on(self, momentum: ArrayLike) -> None:
        self._momentum[:] = momentum if is_vector(momentum) else _one("momentum", numbers(momentum, "momentum", 3))
        state, self._scale = double.begun(self._momentum, self._gamma, self._J, self._D, double.DOUBLE, self._stages)
        self._moving = Moving(*state, self._spin, self._spot, self._radius)
        self._taken, self._proof = 0, None
        self._start = [self._momentum.copy(), self._gamma.copy(), self._spin.copy(), self._spot.copy()]

    @property
    def proved(self) -> Bounds:
        """Bounds of the distance of the present state from the exact orbit of the map since the last start.

        The last start is the creation of the object, a restart, or a new momentum; the exact orbit begins at its
        numbers.  A run in double-double carries the proof: it continues from the last query, at about 1 µs per step.

        Returns
        -------
        Bounds
            The bounds of one state; `steps` is the number of steps since the start if all is proved, and else 0.

        Examples
        --------
        >>> import chapsym
        >>> moving = chapsym.Stepper(chapsym.Ball((1, 2, 4), 3), (0.1, 0.05, 0), (0, 0, 1))
        >>> moving.step(100)
        >>> int(moving.proved.steps), bool(moving.proved.gamma < 1e-14)
        (100, True)
        """
        if self._proof is None:
            self._proof = Proof(self)
        try:
            return self._proof.bounds(self)
        except BaseException:  # an interrupt may have left it at other steps than it counts
            self._proof = None
            raise

    @property
    def omega(self) -> Floats:
        """ω in rad/s for K = 𝒦/ε, in body axes, (3,); raises BadInput if there is no time step, or beyond float64."""
        if self.time_step is None:
            raise BadInput("this Stepper has no time step: it was given 𝒦 = εK; give it your ε as time_step=")
        angular_momentum = [k / self.time_step for k in self._momentum.tolist()]
        with suppress(ZeroDivisionError):
            omega = angular_velocity(*(*angular_momentum, *self._gamma.tolist(), *self._J.tolist(), self._D))
            if all(map(isfinite, omega)):
                return np.array(omega)
        raise BadInput("omega is beyond the range of float64; take other units")

    def _frames(self, count: int) -> dict[str, Floats]:
        """Buffers for this many states; empty for an attitude and a contact point that are not followed."""
        body = count if self._follows else 0
        return {
            "momentum": np.empty((count, 3)), "gamma": np.empty((count, 3)),
            "attitude": np.empty((body, 4)), "contact": np.empty((body, 2)),
        }  # fmt: skip

    def _take(self, steps: int, every: int, frames: dict[str, Floats]) -> tuple[int, int, float]:
        done, status, reach, taken = 0, 0, 1.0, self._taken
        try:
            while done < steps and not status:
                count = min(double.CHUNK, steps - done)
                before = None if count <= AT_ONCE and self._at_once else [x.copy() for x in self._arrays()]
                try:
                    went, status, reach = self._march_on(taken, done, count, every, frames)
                    if status:
                        again = partial(self._march_on, taken, done, went, every, frames)
                        status = self._stopped(status, before, again)
                except BaseException:  # an interrupt undoes the steps of this call of the loop
                    if before is not None:
                        self._reset(before)
                        self._taken = taken + done
                    raise
                done += went
                self._taken = taken + done
        finally:
            if done < steps or frames is not self._ends:
                self._show()
        return done, status, reach

    def _march_on(
        self, begun: int, first: int, count: int, every: int, frames: dict[str, Floats]
    ) -> tuple[int, int, float]:
        steps = Steps(first, first + count, every)
        track = self._track if frames is self._ends else self._tracked(frames)
        # Set before the call: Python raises an interrupt right after it, when the steps are taken.
        self._taken = begun + first + count
        return self._march(self._moving, self._stages, steps, begun, self._scale, track)

    def _tracked(self, frames: dict[str, Floats]) -> Track:
        """The frames as the loop takes them."""
        return Track(frames["momentum"], frames["gamma"], frames["attitude"], frames["contact"], self._follows)

    def _stopped(self, status: int, before: list[Floats] | None, again: Callable[[], object]) -> Status:
        """Why a step was not taken; the state is reset to the one before it, which a composition has left."""
        state = self._moving.state
        why = double.explained(status, self._scale * state[K : K + 3], state[G : G + 3], self._J, self._D)
        if before is not None and self.order != 2:
            self._reset(before)
            again()
        return why

    def _reset(self, before: list[Floats]) -> None:
        for array, old in zip(self._arrays(), before, strict=True):
            array[:] = old

    def _arrays(self) -> list[Floats]:
        """The arrays that the loop changes."""
        return [self._moving.state, self._moving.past, self._spin, self._spot]

    def _show(self) -> None:
        """Copies the state of the loop to the present state."""
        state = self._moving.state
        self._momentum[:], self._gamma[:] = self._scale * state[K : K + 3], state[G : G + 3]
        if self._follows:
            self._ends["attitude"][1], self._ends["contact"][1] = self._spin, self._spot

    def __getstate__(self) -> tuple[object, ...]:
        settings = self.ball, self.order, self._follows, self._traced, self.time_step
        return settings, self._scale, self._taken, self._moving, list(self._ends.values()), self._start

    def __setstate__(self, kept: tuple[Any, ...]) -> None:
        settings, self._scale, self._taken, moving, ends, self._start = kept
        self._prepare(*settings)
        self._moving = deepcopy(moving)
        self._spin, self._spot = self._moving.attitude, self._moving.contact
        for mine, other in zip(self._ends.values(), ends, strict=True):
            mine[:] = other


class Proof:
    """The run in double-double from the last start of a Stepper, which carries the bounds."""

    def __init__(self, ball: Stepper) -> None:
        momentum, gamma, attitude, spot = ball._start
        one = momentum[np.newaxis], gamma[np.newaxis], ball._J[np.newaxis], np.array([ball._D])
        self._balls, self._taken = Balls(*one, np.array([ball._radius])), 0
        self._frames = self._rows("double-double", attitude if ball._follows else None)
        self._spread = np.array([[proved.PAIR] * 4, [np.inf] * 4])
        stages = double_double.coefficients(ball.order)
        self._run = double_double.OneBall(self._balls, 0, self._frames, stages, proves=True)
        self._run.moving.contact[::2] = spot  # the high halves

    def _rows(self, precision: str, attitude: Asked) -> Any:
        """Buffers for the start and the present state."""
        return dispatch.begun(NAMED[precision], self._balls, 2, None if attitude is None else attitude[np.newaxis])

    def bounds(self, ball: Stepper) -> Bounds:
        """The bounds of the present state of a Stepper."""
        steps, now = ball._taken - self._taken, min(ball._taken, 1)
        for part in parts(Steps(0, steps, steps), double_double.CHUNK):  # can be interrupted between two of them
            went, _, _ = self._run.take(part, self._spread)
            self._taken += part.last - part.first
            if went < part.last - part.first:
                self._run.lose()
                self._spread[:], self._taken = np.inf, ball._taken
                break
        there = self._rows("double", ball._spin if ball._follows else None)
        there.momentum[0, now], there.gamma[0, now] = ball._momentum, ball._gamma
        if ball._follows:
            there.attitude[0, now], there.contact[0, now] = ball._spin, ball._spot
        index, stages = np.array([0.0, float(ball._taken)]), len(ball._stages.c)
        found = proved.errors(self._balls, index, there, self._frames, self._spread[np.newaxis], stages)
        present: list[Any] = [None if x is None else x[0, now] for x in found]
        whole = all(np.isfinite(x) for x in present if x is not None)
        momentum, gamma, attitude, contact = present
        return Bounds(momentum, gamma, attitude, contact, steps=np.array(ball._taken if whole else 0))


def _one(name: str, vector: Floats) -> Floats:
    if vector.ndim != 1:
        raise BadInput(f"{name} must be one vector, (3,), not of the shape {vector.shape}")
    return vector
