"""Steps of balls below the bound of `near_n`, each from a guess by those before."""

from dataclasses import dataclass
from typing import Self

import numpy as np

import chapsym.dynamics.native as native

from ..ball import Floats
from ..errors import Status
from ..levels.frames import Count, cores, share
from ..loops import loop_n, rotation_n
from .branch_n import small_rotation, top

#: Stages of a ball between two moments at which the run can be interrupted.
CHUNK = 10_000


@dataclass(frozen=True, eq=False)
class Under:
    """Balls under way: what moves and what does not, each array with the balls along its first axis.

    Moments are divided by `scale`, so that the largest is about 1; 𝒦 = scale·k.
    stages, near, enough, past, use: cᵢ of each stage of a step and what it has of its own, (b, s, ...);
    `near_n.limits`, `rotation_n.remember`.
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


def march(
    state: dict[str, Floats], frames: dict[str, Floats], limits: tuple[Floats, Floats], stages: Floats,
    steps: int, every: int, taken: np.ndarray, status: np.ndarray, reach: Floats, at: np.ndarray, threads: int,
) -> None:  # fmt: skip
    """Steps balls with these `near_n.limits`, and writes the rows `at` of frames, counts, statuses and reaches."""
    under, count = begun(state, limits, stages), Count(lambda done: None)

    def task(i: int) -> None:
        row, one = at[i], under.ball(i)
        taken[row], status[row], reach[row] = advance(one, _of(frames, row), steps, every, count)

    share(task, range(len(at)), min(threads or cores(), len(at)), count)


def begun(state: dict[str, Floats], limits: tuple[Floats, Floats], stages: Floats) -> Under:
    """Balls at their start, from the state that `run_n.run` takes, in memory of their own."""
    K, g, J, D = (state[x] for x in ("momentum", "gamma", "mass_tensor", "D"))
    b, n, s = *g.shape, len(stages)
    exponent = np.frexp(top(J, D))[1]
    past, use = np.zeros((b, s, rotation_n.ORDER, n, n)), np.zeros((b, s, rotation_n.ORDER))
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


def _of(frames: dict[str, Floats], row: int) -> dict[str, Floats]:
    return {name: array[row] for name, array in frames.items()}


def _safely(one: Under, s: int, with_body: bool) -> tuple[int, float]:
    """A stage of a ball that Newton did not find, by the continuation from the identity; returns (status, reach)."""
    E, status, reach = small_rotation(
        *(np.asarray(x)[np.newaxis] for x in (one.stages[s] * one.k, one.g, one.J, one.D))
    )
    if status[0] == Status.TAKEN:
        n = len(one.g)
        W, c = np.empty((n, n)), np.empty(n)
        rotation_n.remember(E[0], one.past[s], one.use[s])
        if with_body:
            rotation_n.roll(E[0], one.g, one.R, one.spot, float(one.rho), c, W)
        rotation_n.move(E[0], one.k, one.g, W, c)
    return int(status[0]), float(reach[0])
