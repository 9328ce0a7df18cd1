"""Resonances of the continuous ball: closed orbits, the drift ∮X₃(H)dt over each, and the pendulum that follows.

Among tori of closed orbits, of energy H* and period T, those of energy H are turned across by β(H - H*) of a full turn
in T.  A loop of the map changes H by ε²A(φ), A = ∮X₃(H)dt over the closed orbit at the phase φ, and φ by β(H - H*):
with V' = A/β the sum (H - H*)²/2 - ε²V(φ) is kept to this order.  So H - H* swings by as much as ±ε sqrt(2 max V).

A motion at H* + δ goes through all phases in 1/(βδ) periods, by equal steps: so its states at the periods, moved to H*,
are starts of closed orbits at equally spaced phases, up to δ.
"""

from dataclasses import dataclass

import numpy as np

from chapsym.dynamics.ball import Floats

from .section import Level, coordinates, crossings, rising, state

#: The step of the flow: of order 8, it is good to ten digits over a loop.
STEP = 0.04
#: A closed orbit closes to this.
CLOSED = 1e-7
#: The mean of A around a torus is 0, by reversibility; where it is not below this share of max |A|, phases are missing.
BALANCED = 0.1
#: The number of loops in which a neighbouring torus goes through about all phases.
LOOPS = 48
MOST_TRIES = 12


@dataclass(frozen=True)
class Resonance:
    """The closed orbits of a level with q `returns`, through (θ, ψ) on the section: period T, energy H*.

    loop: A at equally spaced phases, from that of (θ, ψ) on, (about LOOPS,); beta: β.
    start, centre: K and γ, (2, 3), on the closed orbits with the largest |A| and with the largest V.
    start_period: the period from `start`.  On a torus the motion is even after a change of time only: so all its orbits
    are closed, with periods that differ a little.
    """

    level: Level
    returns: int
    theta: float
    period: float
    energy: float
    loop: Floats
    beta: float
    start: Floats
    centre: Floats
    start_period: float

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
    """The resonance with the closed orbit through (θ, ψ); None if its neighbours are not found to turn around it."""
    K, g = state(level, theta, psi)
    energy, curve = float(level.energy(K, g)), np.stack(level.flow(K, g, period, int(np.ceil(period / STEP))))
    offset = 1e-3
    for _ in range(MOST_TRIES):
        neighbour = state(level, theta + offset, psi)
        states = _at_periods(level, *neighbour, period)
        loops = _turn_of(_away(states, curve))
        if 0.8 * LOOPS < loops < 1.25 * LOOPS:
            break
        offset *= float(np.clip(loops / LOOPS, 0.2, 5.0))
        if abs(offset) > 0.1:
            return None
    else:
        return None
    shifted = float(level.energy(*neighbour)) - energy
    starts = on_level(level, energy, *states[:, : round(loops)])
    periods = closing(level, starts[0], starts[1], period)
    loop = loop_drift(level, starts[0], starts[1], periods)
    if not abs(loop.mean()) < BALANCED * np.abs(loop).max():
        return None
    beta = 1.0 / (loops * shifted)
    middle = int(np.argmax(np.cumsum(loop) / beta))
    steepest = int(np.argmax(np.abs(loop)))
    start, centre = starts[:, steepest], starts[:, middle]
    return Resonance(level, q, theta, period, energy, loop, beta, start, centre, float(periods[steepest]))


def closing(level: Level, K: Floats, g: Floats, period: float) -> Floats:
    """The periods (n,) of the closed orbits from the states (n, 3), (n, 3), by Newton from one nearby."""
    omega = level.omega(K, g)
    velocity = np.concatenate([np.cross(K, omega), np.cross(g, omega)], axis=-1)
    periods = np.full(len(K), period)
    for _ in range(4):
        k, v = level.flow(K, g, periods, int(np.ceil(period / STEP)))
        gap = np.concatenate([k[:, -1] - K, v[:, -1] - g], axis=-1)
        periods -= (gap * velocity).sum(axis=-1) / (velocity * velocity).sum(axis=-1)
    return periods


def loop_drift(level: Level, K: Floats, g: Floats, periods: Floats) -> Floats:
    """∮X₃(H)dt over the closed orbits from the states (n, 3), (n, 3): by trapezoids, which are exact here."""
    k, v = level.flow(K, g, periods, int(np.ceil(periods.max() / STEP)))
    return np.asarray(level.energy_rate(k[..., :-1, :], v[..., :-1, :]).mean(axis=-1) * periods)


def _at_periods(level: Level, K: Floats, g: Floats, period: float) -> Floats:
    """The states (2, n, 3) of a motion at the multiples of a period, over 1.5 LOOPS of them."""
    count = int(np.ceil(period / STEP))
    loops = int(1.5 * LOOPS)
    k, v = level.flow(K, g, loops * period, loops * count)
    return np.stack([k[::count], v[::count]])


def on_level(level: Level, energy: float, K: Floats, g: Floats) -> Floats:
    """States (2, n, 3) of the level with H = `energy`, turned from K and γ along the gradient of H."""
    small = 1e-6
    for _ in range(6):
        pairs = ((level.energy(*_turn(K, g, x)), level.energy(*_turn(K, g, -x))) for x in small * np.eye(3))
        slope = np.stack([(ahead - behind) / (2 * small) for ahead, behind in pairs], axis=-1)
        lacking = energy - level.energy(K, g)
        K, g = _turn(K, g, slope * (lacking / (slope * slope).sum(axis=-1))[:, np.newaxis])
    return np.stack([K, g])


def _turn(K: Floats, g: Floats, x: Floats) -> tuple[Floats, Floats]:
    """K and γ turned about x by |x|, up to |x|³."""

    def turned(v: Floats) -> Floats:
        once = np.cross(v, x)
        return v + once + np.cross(once, x) / 2

    K_turned, g_turned = turned(K), turned(g)
    size = np.linalg.norm(K, axis=-1, keepdims=True) / np.linalg.norm(K_turned, axis=-1, keepdims=True)
    return K_turned * size, g_turned / np.linalg.norm(g_turned, axis=-1, keepdims=True)


def _away(states: Floats, curve: Floats) -> Floats:
    """The distances of states (2, n, 3) from a curve (2, m, 3), (n,), with K in units of its length."""
    scale = np.array([np.linalg.norm(curve[0, 0]), 1.0])[:, np.newaxis, np.newaxis]
    a, b = states / scale, curve / scale
    gaps = a[:, :, np.newaxis] - b[:, np.newaxis]
    return np.asarray(np.sqrt((gaps * gaps).sum(axis=(0, 3))).min(axis=1))


def _turn_of(away: Floats) -> float:
    """After how many steps a motion about a torus is again as near as it began; more than there are if it never was."""
    far = int(np.argmax(away > away.max() / 2))
    near = np.flatnonzero(away[far:] < away.max() / 5)
    if len(near) == 0:
        return 3.0 * len(away)
    first = far + int(near[0])
    at = first + int(np.argmin(away[first : first + max(3, first // 4)]))
    if not 0 < at < len(away) - 1:
        return 3.0 * len(away)
    # Near the minimum the distance is |linear|: two lines of equal and opposite slope meet there.
    left, here, right = away[at - 1 : at + 2]
    return at + float((left - right) / (2 * (max(left, right) - here)))
