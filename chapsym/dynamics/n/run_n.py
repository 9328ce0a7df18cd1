"""Runs in n dimensions: below the bound of `near_n` from guesses by the last rotations, else by the continuation."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

import chapsym.dynamics.native as native

from ..ball import Floats, common_shape, is_followed, largest_moment, unit_vertical
from ..errors import BadInput, Status
from ..levels.frames import Count, cores, share
from ..loops import loop_n
from ..trajectories import flag, rolling_radius
from . import so_n
from .ball_n import BallN, initial_attitudes, skew_matrices
from .branch_n import small_rotation
from .near_n import limits

#: The Jacobians of the balls that are solved together take about this many numbers: what a cache holds.
BLOCK = 2**15
#: Stages of a ball between two moments at which the run can be interrupted.
CHUNK = 10_000
#: What moves, of which frames may be kept.
MOVING = ("momentum", "gamma", "attitude", "contact")


@dataclass(frozen=True, eq=False)
class Under:
    """Balls under way: what moves and what does not, each array with the balls along its first axis.

    Moments are divided by `scale`, so that the largest is about 1; 𝒦 = scale·k.
    stages, near, enough, past, use: cᵢ of each stage of a step and what it has of its own, (b, s, ...);
    `near_n.limits`, `loop_n.remember`.
    """

    k: Floats
    g: Floats
    J: Floats
    D: Floats
    stages: Floats
    near: Floats
    enough: Floats
    past: Floats
    use: Floats
    scale: Floats
    R: Floats
    spot: Floats
    rho: Floats

    def ball(self, i: int) -> Self:
        """One of the balls, in the same memory."""
        return type(self)(*(x[i] for x in vars(self).values()))

    def copy(self) -> Self:
        """The same in other memory."""
        return type(self)(*(x.copy() for x in vars(self).values()))

    def keep(self, frames: dict[str, Floats], frame: int) -> None:
        """Writes the state of one ball into its frames."""
        now = {"momentum": self.scale * self.k, "gamma": self.g, "attitude": self.R, "contact": self.spot}
        for name, array in frames.items():
            array[frame] = now[name]


def start(
    ball: BallN, momentum: ArrayLike, gamma: ArrayLike, attitude: bool | ArrayLike = False, contact: bool = False
) -> tuple[tuple[int, ...], dict[str, Floats]]:
    """The common leading shape, and the state that `run` takes, arrays to read, checked; raises BadInput."""
    if not isinstance(ball, BallN):
        raise BadInput(f"ball must be a chapsym.BallN, not {type(ball).__name__}")
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
    state: dict[str, Floats], frames: dict[str, Floats], stages: Floats, steps: int, every: int, threads: int = 1
) -> tuple[np.ndarray, np.ndarray, Floats]:
    """Takes `steps` steps of each ball into the frames from 1 on, of which every `every`-th is kept.

    state: momentum (b, n, n), gamma (b, n), mass_tensor (b, n) and D (b,); to be followed, attitude (b, n, n),
    contact (b, n-1) and radius (b,).  frames: of what moves, (b, frames, ...); the first is written here.
    stages: cᵢ of the composition, (s,).  threads: how many cores compiled steps may use.
    Returns (taken, status, reach), (b,).
    """
    for name, array in frames.items():
        array[:, 0] = state[name]
    balls, n = state["gamma"].shape
    taken, status, reach = np.zeros(balls, dtype=np.int64), np.zeros(balls, dtype=np.int64), np.ones(balls)
    near, enough = limits(state["momentum"], state["mass_tensor"], state["D"], stages)
    below = (near > 0).all(axis=-1)
    for at in blocks(np.flatnonzero(below), n):
        under = begun(some_balls(state, at), (near[at], enough[at]), stages)
        march(under, frames, at, steps, every, (taken, status, reach), threads)
    for at in blocks(np.flatnonzero(~below), n):
        continued(some_balls(state, at), frames, stages, steps, every, taken, status, reach, at)
    return taken, status, reach


def march(
    under: Under, frames: dict[str, Floats], at: np.ndarray, steps: int, every: int,
    outcome: tuple[np.ndarray, np.ndarray, Floats], threads: int,
) -> None:  # fmt: skip
    """Steps balls below the bound, and writes the rows `at` of the frames and of (taken, status, reach)."""
    count = Count(lambda done: None)

    def task(i: int) -> None:
        own = {name: array[at[i]] for name, array in frames.items()}
        for kept, found in zip(outcome, advance(under.ball(i), own, steps, every, count), strict=True):
            kept[at[i]] = found

    share(task, range(len(at)), min(threads or cores(), len(at)), count)


def blocks(balls: np.ndarray, n: int) -> Iterator[np.ndarray]:
    """The numbers of the balls of a batch, of those together that are solved together."""
    size = max(1, BLOCK // (n * n * n * (n - 1) // 2))
    return (balls[first : first + size] for first in range(0, len(balls), size))


def some_balls(state: dict[str, Floats], at: np.ndarray) -> dict[str, Floats]:
    """The state of some of the balls."""
    return {name: array[at] for name, array in state.items()}


def continued(
    state: dict[str, Floats], frames: dict[str, Floats], stages: Iterable[Any], steps: int, every: int,
    taken: np.ndarray, status: np.ndarray, reach: Floats, at: np.ndarray,
    rotations: Callable[..., tuple[Floats, np.ndarray, Floats]] = small_rotation,
) -> dict[str, Floats]:  # fmt: skip
    """Steps some balls together, the rows `at` of what else is given, and writes these in place.

    rotations: what finds the rotations of a stage, as `small_rotation` in float64.
    Returns the state of the balls that took all steps.
    """
    for step in range(1, steps + 1):
        for c in stages:
            K, rest = c * state["momentum"], (state[x] for x in ("gamma", "mass_tensor", "D"))
            E, status[at], reach[at] = rotations(K, *rest)
            went = status[at] == Status.TAKEN
            if not went.all():
                at, E, state = at[went], E[went], some_balls(state, went)
                if not at.size:
                    return state
            state = _moved(state, E)
        taken[at] += 1
        if step % every == 0:
            for name in frames:
                frames[name][at, step // every] = state[name]
    return state


def _moved(state: dict[str, Floats], E: Floats) -> dict[str, Floats]:
    """The state after the rotation 1 + E: 𝒦 and γ, and those of attitude and contact that there are."""
    K, g = state["momentum"], state["gamma"]
    after = {**state, "momentum": so_n.carried(K, E), "gamma": so_n.transported(g, E)}
    if "contact" in state:
        stride = (state["attitude"] @ so_n.twist(E, g)[..., np.newaxis])[..., :-1, 0]
        after["contact"] = state["contact"] + state["radius"][:, np.newaxis] / 2 * stride
    if "attitude" in state:
        after["attitude"] = so_n.polar(state["attitude"] + state["attitude"] @ E)
    return after


def begun(state: dict[str, Floats], limits: tuple[Floats, Floats], stages: Floats) -> Under:
    """Balls at their start, from the state that `run_n.run` takes, in memory of their own."""
    K, g, J, D = (state[x] for x in ("momentum", "gamma", "mass_tensor", "D"))
    b, n, s = *g.shape, len(stages)
    exponent = np.frexp(largest_moment(J, D))[1]
    past, use = np.zeros((b, s, loop_n.ORDER, n, n)), np.zeros((b, s, loop_n.ORDER))
    return Under(
        np.ldexp(K, -exponent[:, np.newaxis, np.newaxis]), g.copy(), np.ldexp(J, -exponent[:, np.newaxis]),
        np.ldexp(D, -exponent), np.tile(stages, (b, 1)), *limits, past, use, np.ldexp(1.0, exponent),
        state.get("attitude", np.zeros((b, n, n))).copy(), state.get("contact", np.zeros((b, n - 1))).copy(),
        state.get("radius", np.zeros(b)),
    )  # fmt: skip


def advance(one: Under, frames: dict[str, Floats], steps: int, every: int, count: Count) -> tuple[int, int, float]:
    """Takes steps of one ball into its own frames; returns (taken, status, reach)."""
    momenta, verticals, with_body = frames["momentum"], frames["gamma"], "attitude" in frames
    attitudes = frames["attitude"] if with_body else momenta[:0]
    traces = frames["contact"] if "contact" in frames else np.empty((len(attitudes), len(one.spot)))
    s, done, take = len(one.stages), 0, native.loop(loop_n.march)
    room = np.empty((len(one.g) * (len(one.g) - 1) // 2,) * 2)
    while done < steps * s and not count.stopped:
        now = min(CHUNK, steps * s - done)
        went = take(
            one.k, one.g, one.J, float(one.D), one.stages, one.near, one.enough, one.past, one.use,
            done, now, every, float(one.scale), momenta, verticals,
            with_body, one.R, one.spot, float(one.rho), attitudes, traces, room,
        )  # fmt: skip
        done += went
        if went < now:
            status, reach = _safely(one, done % s, with_body)
            if status != Status.TAKEN:
                return done // s, status, reach
            done += 1
            if done % (s * every) == 0:
                one.keep(frames, done // (s * every))
    return done // s, Status.TAKEN, 1.0


def _safely(one: Under, s: int, with_body: bool) -> tuple[int, float]:
    """A stage of a ball that Newton did not find, by the continuation from the identity; returns (status, reach)."""
    E, status, reach = small_rotation(
        *(np.asarray(x)[np.newaxis] for x in (one.stages[s] * one.k, one.g, one.J, one.D))
    )
    if status[0] == Status.TAKEN:
        n = len(one.g)
        W, c = np.empty((n, n)), np.empty(n)
        loop_n.remember(E[0], one.past[s], one.use[s])
        if with_body:
            loop_n.roll(E[0], one.g, one.R, one.spot, float(one.rho), c, W)
        loop_n.move(E[0], one.k, one.g, W, c)
    return int(status[0]), float(reach[0])
