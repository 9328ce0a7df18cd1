"""The energy along runs of the map: its range, its drift with an error, and its change by a loop of a closed orbit.

Functions of plain data: the units of the study.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from chapsym.dynamics.ball import Floats
from chapsym.files import Data

from .resonance import closed_orbits, on_level, profile
from .section import Level, coordinates, crossings, state

#: Steps that are kept at once.
CHUNK = 1 << 17
#: Parts of a run, whose averages the drift is fitted to.
PARTS = 64


def chunks(level: Level, K: Floats, g: Floats, epsilon: float, steps: int) -> Iterator[tuple[Floats, Floats]]:
    """The states (K, γ) of a run, in chunks that begin with the last state of the one before."""
    done = 0
    while done < steps:
        count = min(CHUNK, steps - done)
        k, v = level.steps(K, g, epsilon, count)
        yield k, v
        K, g, done = k[-1], v[-1] / np.linalg.norm(v[-1]), done + count


def amplitude(ball: list[Any], start: list[list[float]], epsilon: float, steps: int) -> dict[str, float]:
    """The range of H = energy/ε² over a run, and its drift, both relative to H at the start.

    ball: the arguments of `Level`; start: K and γ.
    drift, error: the slope of a line through the averages of PARTS equal parts, with smooth weights, times the length
    of the run, and its standard error from the residuals.
    """
    level = Level(tuple(ball[0]), *ball[1:])
    K, g = np.array(start)
    H = np.concatenate([level.energy(k[1:], v[1:]) for k, v in chunks(level, K, g, epsilon, steps)])
    first = float(level.energy(K, g))
    slope, error = drift(H[: len(H) // PARTS * PARTS] / first - 1.0)
    return {"epsilon": epsilon, "steps": steps, "range": float(np.ptp(H)) / first, "drift": slope, "error": error}


def drift(H: Floats) -> tuple[float, float]:
    """The rise of H over a run by a fitted line, and its standard error; (steps,), a multiple of PARTS."""
    parts = H.reshape(PARTS, -1)
    t = (np.arange(parts.shape[1]) + 1.0) / (parts.shape[1] + 1.0)
    weights = np.exp(-1.0 / (t * (1.0 - t)))
    averages = parts @ (weights / weights.sum())
    x = (np.arange(PARTS) + 0.5) / PARTS - 0.5
    slope = float(x @ averages / (x @ x))
    left = averages - averages.mean() - slope * x
    return slope, float(np.sqrt(left @ left / (PARTS - 2) / (x @ x)))


def resonances(ball: list[Any], most: int, time: float, grid: int) -> list[Data]:
    """The resonances of a level with closed orbits through ψ = 0, as plain data, the widest first."""
    level = Level(tuple(ball[0]), *ball[1:])
    found = [profile(level, 0.0, *orbit) for orbit in closed_orbits(level, 0.0, most, time, grid)]
    return [
        {
            "ball": ball, "returns": r.returns, "theta": r.theta, "period": r.period, "energy": r.energy,
            "loop": [float(f"{a:.4e}") for a in r.loop], "beta": r.beta, "start": r.start.tolist(),
            "centre": r.centre.tolist(),
            "start_period": r.start_period, "width": r.width,
            "swing": r.swing, "libration": r.libration,
        }
        for r in sorted((r for r in found if r is not None), key=lambda r: -r.width)
    ]  # fmt: skip


def loop_change(ball: list[Any], start: list[list[float]], period: float, counts: list[int]) -> list[dict[str, float]]:
    """H(Gⁿx) - H(x), divided by ε² = (T/n)², for each n of `counts` that is not stopped by a fold."""
    level = Level(tuple(ball[0]), *ball[1:])
    K, g = np.array(start)
    found = []
    for n in counts:
        epsilon = period / n
        k, v = level.steps(K, g, epsilon, n)
        change = float(level.energy(k[-1], v[-1]) - level.energy(K, g))
        found.append({"epsilon": epsilon, "change": change / epsilon**2})
    return found


def island(ball: list[Any], start: list[list[float]], energy: float, epsilon: float, steps: int, most: int) -> Data:
    """At most `most` points (ψ, H) on the section of a run from `start`, moved to H = `energy`, and how it swings.

    Where a torus crosses the section in two sheets, one above the other in θ, those of the first crossing are kept.

    period: the steps between two upward passages of the middle of the range of H, averaged; 0 if there are less than
    two.  range: of H on the section.
    """
    level = Level(tuple(ball[0]), *ball[1:])
    K, g = on_level(level, energy, *np.array(start)[:, np.newaxis])[:, 0]
    found = []
    for k, v in chunks(level, K, g, epsilon, steps):
        _, kc, gc = crossings(k, v)
        found.append((*coordinates(kc, gc), level.energy(kc, gc)))
    theta, psi, H = (np.concatenate(parts) for parts in zip(*found, strict=True))
    middle = (H.max() + H.min()) / 2
    up = np.flatnonzero((H[:-1] < middle) & (H[1:] >= middle))
    swing = float((up[-1] - up[0]) / (len(up) - 1) * steps / len(H)) if len(up) > 1 else 0.0
    sheet = level.energy(*state(level, theta + 1e-6, psi)) > level.energy(*state(level, theta - 1e-6, psi))
    same = np.flatnonzero(sheet == sheet[0])
    at = np.random.default_rng(0).choice(same, min(most, len(same)), replace=False)
    return {
        "psi": [round(float(x), 3) for x in psi[at]], "energy": [round(float(x), 7) for x in H[at]], "period": swing,
        "range": float(np.ptp(H)),
    }  # fmt: skip
