"""The continuous ball (2.3) beside the map: its flow, and X₃(H), the drift of the energy.

With K = 𝒦/ε a step is the time-ε flow of a field X + ε²X₃ + ..., in every power of ε, with X that of (2.3).  So it
changes H (2.5 as corrected) by ε³X₃(H) + O(ε⁴), and n = T/ε steps over a closed orbit by ε²∮X₃(H)dt + O(ε³).
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from chapsym import generated
from chapsym.dynamics import Ball, trajectory
from chapsym.dynamics.ball import Floats

#: The order of the composition that serves as the flow.
ORDER = 8
#: Terms of a power series in ε that are kept: up to ε³.
TERMS = 4


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
        """X₃(H), (...): the coefficient of ε³ in the change of H by a step with 𝒦 = εK."""
        u = self._gibbs(K, g)
        k, v = _turned(u, K), _turned(u, g)
        inverse = 1.0 / (self.ball.inertia + self.D)
        bottom = -self.D * _product(v, inverse * v, _inner)
        bottom[0] += 1.0
        along = _product(k, inverse * v, _inner)
        H = _product(k, inverse * k, _inner) + self.D * _product(_product(along, along), _inverse(bottom))
        return np.asarray(H[3] / 2)

    def _gibbs(self, K: Floats, g: Floats) -> Floats:
        """The Gibbs vector of the step as a series in ε, (TERMS, ..., 3): Bu + u × Iu = (1 + |u|²)εK/2."""
        inertia = self.ball.inertia
        first = self.omega(K, g) / 2
        second = -self.omega(np.cross(first, inertia * first), g)
        squared = _inner(first, first)[..., np.newaxis]
        bent = np.cross(first, inertia * second) + np.cross(second, inertia * first)
        return np.stack([np.zeros_like(first), first, second, self.omega(squared * K / 2 - bent, g)])


def _parts(v: Floats) -> tuple[Floats, Floats, Floats]:
    return v[..., 0], v[..., 1], v[..., 2]


def _inner(a: Floats, b: Floats) -> Floats:
    return np.asarray((a * b).sum(axis=-1))


def _product(a: Floats, b: Floats, times: Callable[[Floats, Floats], Floats] = np.multiply) -> Floats:
    """The product of two series, with any bilinear `times` of their coefficients."""
    return np.stack([sum(times(a[j], b[n - j]) for j in range(n + 1)) for n in range(TERMS)])


def _inverse(a: Floats) -> Floats:
    """1/a of a series of numbers."""
    found = [1.0 / a[0]]
    for n in range(1, TERMS):
        found.append(-found[0] * sum(a[j] * found[n - j] for j in range(1, n + 1)))
    return np.stack(found)


def _turned(u: Floats, v: Floats) -> Floats:
    """Ωᵀv = v + 2(u × (u × v) - u × v)/(1 + |u|²) as a series."""
    once = np.cross(u, v)
    bottom = _product(u, u, _inner)
    bottom[0] += 1.0
    turned = 2.0 * _product(_inverse(bottom)[..., np.newaxis], _product(u, once, np.cross) - once)
    turned[0] += v
    return turned
