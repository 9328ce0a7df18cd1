"""A level |K|, ⟨K,γ⟩ of the ball: the map and the continuous motion (2.3) on it, X₃(H), and the section K₂ = 0.

With K = 𝒦/ε a step is the time-ε flow of a field X + ε²X₃ + ..., in every power of ε, with X that of (2.3).  So it
changes H (2.5 as corrected) by ε³X₃(H) + O(ε⁴), and n = T/ε steps over a closed orbit by ε²∮X₃(H)dt + O(ε³).

All motions cross the section, upwards, but those about axis 2.  Its points are (θ, ψ): K = |K|(-sin θ, 0, cos θ), and
ψ is the angle of γ about K, 0 where γ, too, lies in the plane of the axes 1 and 3.  On ψ = 0 and ψ = π are the states
that a reversor leaves fixed, (K, γ) ↦ -(SK, Sγ) with the half turn S about axis 2; S itself maps θ to θ + π.
"""

from dataclasses import dataclass

import numpy as np

from chapsym import generated
from chapsym.dynamics import Ball, trajectory
from chapsym.dynamics.ball import Floats

#: The order of the composition that serves as the flow.
ORDER = 8
#: Points through which a crossing is interpolated.
POINTS = 8
NEWTONS = 6


@dataclass(frozen=True)
class Level:
    """The states of a ball with |K| = I_min and ⟨K,γ⟩ = cosine·|K|: a unit of time is about a radian of turn."""

    mass_tensor: tuple[float, float, float]
    D: float
    cosine: float

    @property
    def ball(self) -> Ball:
        """The ball of the level."""
        return Ball(np.array(self.mass_tensor, dtype=float), np.array(float(self.D)))

    @property
    def size(self) -> float:
        """|K|."""
        return float(self.ball.inertia.min())

    def energy(self, K: Floats, g: Floats) -> Floats:
        """H, (...), of K and γ, (..., 3)."""
        return np.asarray(generated.energy(*_parts(K), *_parts(g), *self.mass_tensor, self.D))

    def omega(self, K: Floats, g: Floats) -> Floats:
        """The angular velocity with the momentum K, (..., 3): B⁻¹K."""
        return np.stack(generated.angular_velocity(*_parts(K), *_parts(g), *self.mass_tensor, self.D), axis=-1)

    def steps(self, K: Floats, g: Floats, epsilon: float, count: int) -> tuple[Floats, Floats]:
        """The states K = 𝒦/ε and γ, (..., count + 1, 3), of the map; NaN after a fold."""
        run = trajectory(self.ball, epsilon * K, g, count, threads=1)
        return run.momentum / epsilon, run.gamma

    def flow(self, K: Floats, g: Floats, time: Floats | float, count: int) -> tuple[Floats, Floats]:
        """The states (..., count + 1, 3) of the continuous motion, at equal times from 0 to `time`, () or (...)."""
        step = np.asarray(time)[..., np.newaxis] / count
        run = trajectory(self.ball, step * K, g, count, order=ORDER, threads=1)
        return run.momentum / step[..., np.newaxis], run.gamma

    def energy_rate(self, K: Floats, g: Floats) -> Floats:
        """X₃(H), (...): the coefficient of ε³ in the change of H by a step with 𝒦 = εK (lemma `modified-energy`)."""
        omega = _parts(self.omega(K, g))
        torque = generated.torque(*omega, *self.mass_tensor)
        rate = generated.angular_velocity(*(*torque, *_parts(g), *self.mass_tensor, self.D))
        return np.asarray(generated.energy_rate(*(*omega, *rate, *_parts(g), self.D))) / 4


def _parts(v: Floats) -> tuple[Floats, Floats, Floats]:
    return v[..., 0], v[..., 1], v[..., 2]


def packed(numbers: list[float]) -> str:
    """Numbers in one line of text, for JSON that is written with a line for each entry of a list."""
    return " ".join(repr(x) for x in numbers)


def unpacked(text: str) -> Floats:
    """The numbers of `packed`."""
    return np.array(text.split(), dtype=float)


def state(level: Level, theta: Floats | float, psi: Floats | float) -> tuple[Floats, Floats]:
    """K and γ, (..., 3) each, at the points (θ, ψ) of the section."""
    theta, psi = np.broadcast_arrays(np.asarray(theta, dtype=float), np.asarray(psi, dtype=float))
    zero = np.zeros_like(theta)
    k = np.stack([-np.sin(theta), zero, np.cos(theta)], axis=-1)
    f = np.stack([np.cos(theta), zero, np.sin(theta)], axis=-1)  # along e₂ × K
    sine = np.sqrt(1.0 - level.cosine**2)
    across = np.cos(psi)[..., np.newaxis] * f + np.sin(psi)[..., np.newaxis] * np.array([0.0, 1.0, 0.0])
    g = level.cosine * k + sine * across
    return level.size * k, g / np.linalg.norm(g, axis=-1, keepdims=True)


def coordinates(K: Floats, g: Floats) -> tuple[Floats, Floats]:
    """(θ, ψ) of states, (...): θ in [-π/4, 3π/4), up to S; off the section, ψ of γ about K from e₂ × K on."""
    theta = np.arctan2(-K[..., 0], K[..., 2])
    k = K / np.linalg.norm(K, axis=-1, keepdims=True)
    f = np.stack([k[..., 2], np.zeros_like(theta), -k[..., 0]], axis=-1)
    psi = np.arctan2((g * np.cross(k, f)).sum(axis=-1), (g * f).sum(axis=-1))
    return np.mod(theta + np.pi / 4, np.pi) - np.pi / 4, psi


def rising(level: Level, K: Floats, g: Floats) -> np.ndarray:
    """Whether the continuous motion crosses K₂ = 0 upwards there, (...)."""
    return np.asarray(np.cross(K, level.omega(K, g))[..., 1] > 0)


def crossings(K: Floats, g: Floats) -> tuple[Floats, Floats, Floats]:
    """Where a motion of equal steps, (steps, 3) each, crosses the section upwards: (times in steps, K, γ).

    Each is interpolated by the polynomial through 8 states: of the flow, or of the map, which is a flow up to what is
    smaller than every power of ε.
    """
    before = POINTS // 2 - 1
    at = np.flatnonzero((K[:-1, 1] < 0) & (K[1:, 1] >= 0))
    at = at[(at >= before) & (at < len(K) - POINTS + before + 1)]
    nodes = np.arange(POINTS) - before
    around = at[:, np.newaxis] + nodes
    y = np.concatenate([K[around], g[around]], axis=-1)  # (crossings, POINTS, 6)
    x = y[:, before, 1] / (y[:, before, 1] - y[:, before + 1, 1])
    for _ in range(NEWTONS):
        value, slope = _interpolated(y[..., 1:2], x, nodes)
        x = x - value[:, 0] / slope[:, 0]
    states, _ = _interpolated(y, x, nodes)
    return at + x, states[:, :3], states[:, 3:]


def _interpolated(y: Floats, x: Floats, nodes: np.ndarray) -> tuple[Floats, Floats]:
    """The values and slopes at x, (n,), of the polynomials through y, (n, POINTS, ...)."""
    value, slope = np.zeros_like(y[:, 0]), np.zeros_like(y[:, 0])
    for j, node in enumerate(nodes):
        others = np.delete(nodes, j)
        gaps = x[:, np.newaxis] - others
        scale = np.prod(node - others)
        weight = np.prod(gaps, axis=1) / scale
        rate = sum(np.prod(np.delete(gaps, i, axis=1), axis=1) for i in range(len(others))) / scale
        value += weight[:, np.newaxis] * y[:, j]
        slope += np.asarray(rate)[:, np.newaxis] * y[:, j]
    return value, slope
