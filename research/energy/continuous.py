"""The continuous ball (2.3), for comparison with the map: its flow, and X₃(H), the drift of the energy.

With K = 𝒦/ε a step is the time-ε flow of a field X + ε²X₃ + ..., in every power of ε, with X that of (2.3).  So it
changes H (2.5 as corrected) by ε³X₃(H) + O(ε⁴), and n = T/ε steps over a closed orbit by ε²∮X₃(H)dt + O(ε³).
"""

from dataclasses import dataclass

import numpy as np

from chapsym import generated
from chapsym.dynamics import Ball, trajectory
from chapsym.dynamics.ball import Floats

#: The order of the composition that serves as the flow.
ORDER = 8


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
