"""Steps of balls below the bound of `near_n`, each from a guess by those before: compiled, or by columns in NumPy."""

from dataclasses import dataclass

import numpy as np

from ..ball import Floats
from ..errors import Status
from ..levels.double import load, pays
from ..loops import loop_n, rotation_n
from . import columns_n
from .branch_n import small_rotation, top

#: A step without numba takes about so many times that of a ball in three dimensions.
WEIGHT = 10
#: Steps of a ball between two moments at which the run can be interrupted.
CHUNK = 10_000


@dataclass(frozen=True, eq=False)
class Under:
    """Balls under way: what moves and what does not, each array with the balls along its first axis.

    Moments are divided by `scale`, so that the largest is about 1; 𝒦 = scale·k.  past, use: `rotation_n.remember`.
    """

    k: Floats
    g: Floats
    J: Floats
    D: Floats
    near: Floats
    enough: Floats
    past: Floats
    use: Floats
    scale: Floats
    R: Floats
    spot: Floats
    rho: Floats


def march(
    state: dict[str, Floats], frames: dict[str, Floats], limits: tuple[Floats, Floats], steps: int, every: int,
    taken: np.ndarray, status: np.ndarray, reach: Floats, at: np.ndarray,
) -> None:  # fmt: skip
    """Steps balls with these `near_n.limits`, and writes the rows `at` of frames, counts, statuses and reaches."""
    run = _compiled if pays(loop_n.march, steps * len(at) * WEIGHT) else _by_columns
    run(_begun(state, limits), frames, steps, every, taken, status, reach, at)


def _begun(state: dict[str, Floats], limits: tuple[Floats, Floats]) -> Under:
    K, g, J, D = (state[x] for x in ("momentum", "gamma", "mass_tensor", "D"))
    b, n = g.shape
    exponent = np.frexp(top(J, D))[1]
    return Under(
        np.ldexp(K, -exponent[:, np.newaxis, np.newaxis]), g.copy(), np.ldexp(J, -exponent[:, np.newaxis]),
        np.ldexp(D, -exponent), *limits, np.zeros((b, rotation_n.ORDER, n, n)), np.zeros((b, rotation_n.ORDER)),
        np.ldexp(1.0, exponent), state.get("attitude", np.zeros((b, n, n))).copy(),
        state.get("contact", np.zeros((b, n - 1))).copy(), state.get("radius", np.zeros(b)),
    )  # fmt: skip


def _compiled(
    under: Under, frames: dict[str, Floats], steps: int, every: int,
    taken: np.ndarray, status: np.ndarray, reach: Floats, at: np.ndarray,
) -> None:  # fmt: skip
    (take,) = load((loop_n.march,))
    with_body = "attitude" in frames
    for i, row in enumerate(at):
        one = _ball(under, i)
        momenta, verticals = frames["momentum"][row], frames["gamma"][row]
        body_frames = len(momenta) if with_body else 0
        attitudes = frames["attitude"][row] if with_body else momenta[:0]
        traces = frames["contact"][row] if "contact" in frames else np.empty((body_frames, len(one.spot)))
        done = 0
        while done < steps and status[row] == Status.TAKEN:
            now = min(CHUNK, steps - done)
            went = take(
                one.k, one.g, one.J, float(one.D), float(one.near), float(one.enough), one.past, one.use,
                done, now, every, float(one.scale), momenta, verticals,
                with_body, one.R, one.spot, float(one.rho), attitudes, traces,
            )  # fmt: skip
            done += went
            if went < now:
                status[row], reach[row] = _safely(one, with_body)
                done += int(status[row] == Status.TAKEN)
                if status[row] == Status.TAKEN and done % every == 0:
                    _keep(one, frames, row, done // every)
        taken[row] = done


def _by_columns(
    under: Under, frames: dict[str, Floats], steps: int, every: int,
    taken: np.ndarray, status: np.ndarray, reach: Floats, at: np.ndarray,
) -> None:  # fmt: skip
    with_body = "attitude" in frames
    c = Under(*(np.ascontiguousarray(np.moveaxis(x, 0, -1)) for x in vars(under).values()))
    resting = np.zeros(len(at), dtype=bool)
    for step in range(1, steps + 1):
        with np.errstate(all="ignore"):  # what does not settle is thrown away
            E, settled = columns_n.settle(columns_n.guess(c.past, c.use), c.k, c.g, c.J, c.D, c.near, c.enough)
        mended = {i: _copy(_lane(c, i)) for i in np.flatnonzero(~settled & ~resting).tolist()}
        E[..., ~settled] = 0.0
        columns_n.remember(E, c.past, c.use)
        if with_body:
            columns_n.roll(E, c.g, c.R, c.spot, c.rho)
        columns_n.move(E, c.k, c.g)
        for i, one in mended.items():
            status[at[i]], reach[at[i]] = _safely(one, with_body)
            for name in ("k", "g", "past", "use", "R", "spot"):
                getattr(c, name)[..., i] = getattr(one, name)
            resting[i] = status[at[i]] != Status.TAKEN
        taken[at[~resting]] += 1
        if step % every == 0:
            for i in np.flatnonzero(~resting).tolist():
                _keep(_lane(c, i), frames, at[i], step // every)


def _ball(under: Under, i: int) -> Under:
    return Under(*(x[i] for x in vars(under).values()))


def _lane(under: Under, i: int) -> Under:
    return Under(*(x[..., i] for x in vars(under).values()))


def _copy(one: Under) -> Under:
    return Under(*(x.copy() for x in vars(one).values()))


def _safely(one: Under, with_body: bool) -> tuple[int, float]:
    """A step of a ball that Newton did not find, by the continuation from the identity; returns (status, reach)."""
    E, status, reach = small_rotation(*(np.asarray(x)[np.newaxis] for x in (one.k, one.g, one.J, one.D)))
    if status[0] == Status.TAKEN:
        n = len(one.g)
        W, c = np.empty((n, n)), np.empty(n)
        rotation_n.remember(E[0], one.past, one.use)
        if with_body:
            rotation_n.roll(E[0], one.g, one.R, one.spot, float(one.rho), c, W)
        rotation_n.move(E[0], one.k, one.g, W, c)
    return int(status[0]), float(reach[0])


def _keep(one: Under, frames: dict[str, Floats], row: int, frame: int) -> None:
    now = {"momentum": one.scale * one.k, "gamma": one.g, "attitude": one.R, "contact": one.spot}
    for name, array in frames.items():
        array[row, frame] = now[name]
