"""Resonances of the continuous ball: closed orbits, the drift ∮X₃(H)dt over each, and the pendulum that follows.

By q returns to the section a torus of energy H is turned by β(H - H*) of a full turn, the one of closed orbits, H*, by
none.  A loop of the map changes H by ε²A(φ), A = ∮X₃(H)dt over the closed orbit at the phase φ, and φ by β(H - H*):
with V' = A/β the sum (H - H*)²/2 - ε²V(φ) is kept to this order.  So H - H* swings by as much as ±ε sqrt(2 max V).

A torus at H* + δ goes through all phases in 1/(βδ) loops, by equal steps: so its q-th returns, moved to H*, are starts of
closed orbits at equally spaced phases, up to δ.
"""

from dataclasses import dataclass

import numpy as np

from chapsym.dynamics.ball import Floats

from .continuous import Level
from .section import coordinates, crossings, rising, state

#: The step of the flow: of order 8, it is good to ten digits over a loop.
STEP = 0.04
#: A closed orbit closes to this.
CLOSED = 1e-7
#: The mean of A around a torus is 0, by reversibility; where it is not below this share of max |A|, phases are missing.
BALANCED = 0.1
#: A neighbouring torus goes through all phases in about so many loops.
LOOPS = 48
MOST_TRIES = 12


@dataclass(frozen=True)
class Resonance:
    """The closed orbits of a level with q `returns`, through (θ, ψ) on the section: period T, energy H*.

    loop: A at equally spaced phases, from that of (θ, ψ) on, (about LOOPS,); beta: β.
    start: (θ, ψ) of the closed orbit at the phase with the largest |A|.
    """

    level: Level
    returns: int
    theta: float
    psi: float
    period: float
    energy: float
    loop: Floats
    beta: float
    start: tuple[float, float]

    @property
    def potential(self) -> Floats:
        """V in the middle of each loop, its minimum 0."""
        found = (np.cumsum(self.loop) - self.loop / 2) / len(self.loop) / self.beta
        return np.asarray(found - found.min())

    @property
    def width(self) -> float:
        """The range of H in the island, divided by εH*: twice sqrt(2 max V)."""
        return float(2 * np.sqrt(2 * self.potential.max()) / self.energy)

    @property
    def swing(self) -> float:
        """The range of H from `start`, divided by εH*: up the hill of V at whose side the start is."""
        at = int(np.argmax(np.abs(self.loop)))
        V = np.roll(self.potential, -at)
        ahead = V if V[1] > V[-1] else np.roll(V[::-1], 1)
        below = np.flatnonzero(ahead[1:] < ahead[0])
        hill = ahead[: below[0] + 1] if len(below) else ahead
        return float(2 * np.sqrt(2 * (hill.max() - ahead[0])) / self.energy)

    @property
    def libration(self) -> float:
        """ε² times the steps of a small swing of the pendulum with the strongest harmonic of A."""
        harmonics = 2 * np.abs(np.fft.rfft(self.loop)) / len(self.loop)
        strongest = 1 + int(np.argmax(harmonics[1:]))
        bend = 2 * np.pi * strongest * harmonics[strongest] * abs(self.beta)
        return float(2 * np.pi / np.sqrt(bend) * self.period)


def returns(level: Level, theta: float, psi: float, time: float) -> tuple[Floats, Floats, Floats]:
    """The times, θ and the lifted ψ of the returns to the section within `time`."""
    K, g = level.flow(*state(level, theta, psi), time, int(np.ceil(time / STEP)))
    return _returns(K, g, time / (len(K) - 1))


def _returns(K: Floats, g: Floats, step: float) -> tuple[Floats, Floats, Floats]:
    lifted = np.unwrap(coordinates(K, g)[1])
    at, kc, gc = crossings(K, g)
    theta, psi = coordinates(kc, gc)
    psi = psi + 2 * np.pi * np.round((np.interp(at, np.arange(len(K)), lifted) - psi) / (2 * np.pi))
    return at * step, theta, psi


def closed_orbits(level: Level, psi: float, most: int, time: float, grid: int) -> list[tuple[int, float, float]]:
    """(q, θ, T) of the closed orbits through (θ, ψ), θ on a grid, with at most `most` returns in `time`."""
    theta = np.linspace(-np.pi / 4, 3 * np.pi / 4, grid, endpoint=False)
    theta = theta[rising(level, *state(level, theta, psi))]
    K, g = level.flow(*state(level, theta, psi), time, int(np.ceil(time / STEP)))
    kept = [_returns(k, v, time / (len(k) - 1))[2] - psi for k, v in zip(K, g, strict=True)]
    found: list[tuple[int, float, float]] = []
    for q in range(1, most + 1):
        ends = np.array([p[q - 1] if len(p) >= q else np.nan for p in kept]) / (2 * np.pi)
        for i in range(len(theta) - 1):
            low, high = sorted((ends[i], ends[i + 1]))
            if high - low < 0.5 and np.ceil(low) <= high:
                orbit = _closed(level, psi, q, (theta[i], theta[i + 1]), ends[i : i + 2] - np.ceil(low), time)
                new = orbit is not None and all(abs(orbit[1] - known[1]) > 1e-6 for known in found)
                found += [orbit] if orbit is not None and new else []
    return found


def _closed(
    level: Level, psi: float, q: int, ends: tuple[float, float], gaps: Floats, time: float
) -> tuple[int, float, float] | None:
    """The closed orbit between two θ, by regula falsi (Illinois) with the displacements of ψ at both, in turns."""
    (a, b), (low, high) = ends, (float(gaps[0]), float(gaps[1]))
    turns = None
    for _ in range(40):
        c = (a * high - b * low) / (high - low) if high != low else a
        times, theta, lifted = returns(level, c, psi, time)
        if len(times) < q:
            return None
        gap = (float(lifted[q - 1]) - psi) / (2 * np.pi)
        turns = round(gap) if turns is None else turns
        gap -= turns
        if abs(gap) < 1e-14 or abs(b - a) < 1e-14:
            break
        if gap * high < 0:
            a, low = b, high
        else:
            low /= 2
        b, high = c, gap
    if abs(theta[q - 1] - c) > CLOSED or abs(gap) > CLOSED:
        return None
    return q, float(c), float(times[q - 1])


def profile(level: Level, psi: float, q: int, theta: float, period: float) -> Resonance | None:
    """The resonance with the closed orbit through (θ, ψ); None if its torus has no neighbours beside the section."""
    offset, energy = 1e-3, float(level.energy(*state(level, theta, psi)))
    for _ in range(MOST_TRIES):
        swept = _swept(level, psi, q, theta + offset, (1.5 * LOOPS + 2) * period)
        loops = 3.0 * LOOPS if swept is None else swept[0]
        if swept is not None and 0.8 * LOOPS < loops < 1.25 * LOOPS:
            break
        offset *= float(np.clip(loops / LOOPS, 0.2, 5.0))
        if abs(offset) > 0.1:
            return None
    else:
        return None
    shifted = float(level.energy(*state(level, theta + offset, psi))) - energy
    points = _on_level(level, energy, swept[1][: round(loops)])
    loop = loop_drift(level, points, period)
    if not abs(loop.mean()) < BALANCED * np.abs(loop).max():
        return None
    at = int(np.argmax(np.abs(loop)))
    start = (float(points[at, 0]), float(points[at, 1]))
    return Resonance(level, q, theta, psi, period, energy, loop, 1.0 / (loops * shifted), start)


def loop_drift(level: Level, points: Floats, period: float) -> Floats:
    """∮X₃(H)dt over the closed orbits from the points (θ, ψ), (n, 2): by trapezoids, which are exact here."""
    count = int(np.ceil(period / STEP))
    K, g = level.flow(*state(level, points[:, 0], points[:, 1]), period, count)
    return np.asarray(level.energy_rate(K[:, :-1], g[:, :-1]).sum(axis=-1) * period / count)


def _on_level(level: Level, energy: float, points: Floats) -> Floats:
    """The points (θ, ψ), (n, 2), moved to H = `energy` along the gradient of H on the section."""
    small = 1e-6
    for _ in range(6):
        theta, psi = points.T
        across = level.energy(*state(level, theta + small, psi)) - level.energy(*state(level, theta - small, psi))
        along = level.energy(*state(level, theta, psi + small)) - level.energy(*state(level, theta, psi - small))
        slope = np.stack([across, along], axis=-1) / (2 * small)
        lacking = energy - level.energy(*state(level, theta, psi))
        points = points + slope * (lacking / (slope * slope).sum(axis=-1))[:, np.newaxis]
    return points


def _swept(level: Level, psi: float, q: int, theta: float, time: float) -> tuple[float, Floats] | None:
    """The loops in which a torus goes through all phases, and (θ, ψ) before each; None if `time` is too short for it."""
    _, thetas, lifted = returns(level, theta, psi, time)
    thetas, psis = np.append(theta, thetas[q - 1 :: q]), np.append(psi, lifted[q - 1 :: q])
    loops = _turn_of(np.stack([thetas, np.cos(psis), np.sin(psis)]))
    return None if loops is None else (loops, np.stack([thetas, psis], axis=-1))


def _turn_of(points: Floats) -> float | None:
    """After how many of the points, (3, n), on a closed curve the first one is passed again."""
    away = np.linalg.norm(points - points[:, :1], axis=0)
    far = int(np.argmax(away > away.max() / 2))
    near = np.flatnonzero(away[far:] < away.max() / 5)
    if len(near) == 0:
        return None
    first = far + int(near[0])
    at = first + int(np.argmin(away[first : first + max(3, first // 4)]))
    if at + 1 >= len(away):
        return None
    chord = (points[:, at + 1] - points[:, at - 1]) / 2
    return at + float((points[:, 0] - points[:, at]) @ chord / (chord @ chord))
