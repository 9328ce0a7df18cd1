"""Samples of orbits, chaotic or regular by the derivative of the map, and pictures of the section: units of the study.

A deviation grows at most like n on a torus, and like e^{λn} in chaos: an orbit counts as chaotic if in n steps it has
grown by more than n^LIMIT.  D = 0, which is integrable, measures how often that is wrong.
"""

from typing import Any

import numpy as np

from chapsym.dynamics import Ball, native
from chapsym.dynamics.ball import Floats
from chapsym.dynamics.loops.gibbs import HEAVY
from chapsym.dynamics.loops.tangent import follow_all
from chapsym.files import Data

from ..energy.amplitude import chunks
from ..energy.section import Level, coordinates, rising, state

LIMIT = 2.5
#: A start near the unstable rotation is this many powers of ten away from axis 2, at most.
NEAREST = 4.0
#: Points with |K₂| below this share of |K| are moved to the section along the motion: off by its square.
SLAB = 0.01
#: The columns of `follow_all`, in its order.
COLUMNS = (
    "taken", "growth1", "growth2", "growth3", "volume_first", "volume_second", "energy_first", "energy_second",
    "energy_low", "energy_high",
)  # fmt: skip


def starts(orbits: int, near: bool, seed: int) -> tuple[Floats, Floats]:
    """Unit vectors along K and γ, (orbits, 3) each: at random on both spheres, or K near axis 2, at random scales."""
    rng = np.random.default_rng(seed)
    K, g = rng.normal(size=(2, orbits, 3))
    if near:
        K[:, 1] = 1.0
        K[:, ::2] *= 10.0 ** -rng.uniform(0.0, NEAREST, size=(orbits, 1))
    return K / np.linalg.norm(K, axis=1, keepdims=True), g / np.linalg.norm(g, axis=1, keepdims=True)


def follow_orbits(ball: Ball, momenta: np.ndarray, gammas: np.ndarray, steps: int) -> dict[str, np.ndarray]:
    """The `COLUMNS` of each orbit of a ball, from the starts (n, 3) and (n, 3); NaN where an orbit met a fold.

    Raises ValueError for a heavy ball: its Gibbs vector needs another kernel.
    """
    if (HEAVY * ball.inertia.min() < ball.D).any():
        raise ValueError("the derivative of the step is computed for balls with D ≤ 32 I_min only")
    rows = np.empty((len(momenta), len(COLUMNS)))
    follow = native.loop(follow_all)
    follow(np.ascontiguousarray(momenta), np.ascontiguousarray(gammas), ball.mass_tensor, float(ball.D), steps, rows)
    rows[rows[:, 0] < 2 * (steps // 2), 1:] = np.nan
    return dict(zip(COLUMNS, rows.T, strict=True))


def sample(mass_tensor: list[float], D: float, epsilon: float, near: bool, orbits: int, steps: int, seed: int) -> Data:
    """The number of chaotic orbits of `orbits` with |𝒦| = ε I_min, and their rate; the change of the phase volume.

    folded: orbits that met a fold, which are not counted.  growth: quantiles of log(growth)/log(steps) of the regular
    ones, at most LIMIT.  exponent: the mean and the largest Lyapunov exponent of the chaotic ones, a step.
    volume: the largest |average of log|det T|| of the regular ones, by smooth weights, over the second half; for the
    chaotic ones the mean over all and its standard error.  change: the median relative change of the
    average energy from one half of the run to the other.
    """
    ball = Ball(np.array(mass_tensor, dtype=float), np.array(float(D)))
    K, g = starts(orbits, near, seed)
    found = follow_orbits(ball, epsilon * ball.inertia.min() * K, g, steps)
    kept = {name: column[np.isfinite(found["growth1"])] for name, column in found.items()}
    growth = kept["growth1"] / np.log(steps)
    chaotic = growth > LIMIT
    report: Data = {
        "counted": len(growth), "folded": orbits - len(growth), "chaotic": int(chaotic.sum()),
        "regular": {}, "wild": {},
    }  # fmt: skip
    change = np.abs(kept["energy_second"] / kept["energy_first"] - 1.0)
    if (~chaotic).any():
        report["regular"] = {
            "growth": [float(x) for x in np.quantile(growth[~chaotic], (0.5, 0.99, 1.0))],
            "volume": float(np.abs(kept["volume_second"][~chaotic]).max()),
            "median_volume": float(np.median(np.abs(kept["volume_second"][~chaotic]))),
            "change": float(np.median(change[~chaotic])),
        }
    if chaotic.any():
        exponents = kept["growth1"][chaotic] / steps
        volume = (kept["volume_first"][chaotic] + kept["volume_second"][chaotic]) / 2
        report["wild"] = {
            "growth": float(growth[chaotic].min()),
            "exponent": [float(exponents.mean()), float(exponents.max())],
            "volume": [float(np.mean(volume)), float(np.std(volume) / np.sqrt(len(volume)))],
            "change": float(np.median(change[chaotic])),
        }
    return report


def picture(
    ball: list[Any], epsilon: float, lines: list[list[float]], orbits: int, steps: int, points: int
) -> list[Data]:
    """For starts on lines (ψ, first θ, last θ), in π: the exponent and at most `points` points (ψ, θ), in 10⁻⁵π.

    Chaotic orbits have four times as many.  A start that meets a fold, or does not cross upwards, is left out.
    """
    level = Level(tuple(ball[0]), *ball[1:])
    count = orbits // len(lines)
    theta_starts = np.pi * np.concatenate([np.linspace(line[1], line[2], count) for line in lines])
    K, g = state(level, theta_starts, np.pi * np.repeat([line[0] for line in lines], count))
    up = rising(level, K, g)
    K, g = K[up], g[up]
    found = follow_orbits(level.ball, epsilon * K, g, steps)
    sentences = []
    for k, v, growth in zip(K, g, found["growth1"], strict=True):
        if not np.isfinite(growth):
            continue
        chaotic = bool(growth > LIMIT * np.log(steps))
        where = np.concatenate([slab(level, *part) for part in chunks(level, k, v, epsilon, steps)], axis=1)
        at = np.random.default_rng(0).permutation(where.shape[1])[: points * (4 if chaotic else 1)]
        sentences.append(
            {
                "exponent": float(f"{growth / steps:.3e}"), "chaotic": chaotic, "energy": float(level.energy(k, v)),
                "theta": np.round(1e5 * where[0, at] / np.pi).astype(int).tolist(),
                "psi": np.round(1e5 * where[1, at] / np.pi).astype(int).tolist(),
            }
        )  # fmt: skip
    return sentences


def slab(level: Level, K: Floats, g: Floats) -> Floats:
    """(θ, ψ), (2, n), of the states (steps, 3) of an orbit that are within SLAB of the section, moved to it."""
    inner = np.flatnonzero(np.abs(K[1:-1, 1]) < SLAB * level.size) + 1
    k, v = K[inner], g[inner]
    up = rising(level, k, v)
    k, v = k[up], v[up]
    # Along the field of the ball: of the map's it differs by ε².
    omega = level.omega(k, v)
    rate_k, rate_v = np.cross(k, omega), np.cross(v, omega)
    time = (-k[:, 1] / rate_k[:, 1])[:, np.newaxis]
    return np.stack(coordinates(k + time * rate_k, v + time * rate_v))


def share(counted: int, chaotic: int) -> tuple[float, float, float]:
    """The share of chaotic orbits with the ends of its 95% interval (Wilson)."""
    if not counted:
        return float("nan"), 0.0, 1.0
    z, p = 1.96, chaotic / counted
    middle = (p + z * z / (2 * counted)) / (1 + z * z / counted)
    half = z * ((p * (1 - p) + z * z / (4 * counted)) / counted) ** 0.5 / (1 + z * z / counted)
    return p, max(0.0, middle - half), min(1.0, middle + half)
