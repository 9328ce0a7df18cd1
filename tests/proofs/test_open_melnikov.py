"""The energy along the separatrix beside vertical momentum: by quadrature of X₃(H) itself, and the closed form."""

import numpy as np
import pytest
from budget import slow
from vectors import cross


class Ball:
    """The continuous ball with Λ and D; on its separatrix with K = hγ."""

    def __init__(self, whole, contact, height):
        a, b, c = self.whole = np.array(whole, dtype=float)
        self.D, self.h, self.inertia = contact, height, self.whole - contact
        self.kappa = np.sqrt((a - b) * (b - c) / (a * c))
        self.rate = height / (b - contact)
        self.ends = np.sqrt(a * (b - c) / (b * (a - c))), -np.sqrt(c * (a - b) / (b * (a - c)))

    def vertical(self, t):
        """γ on the separatrix."""
        first, last = self.ends
        x = self.kappa * self.rate * t
        return np.array([first / np.cosh(x), np.tanh(x), last / np.cosh(x)])

    def spin(self, t):
        """ω there, cΛ⁻¹γ with c = hΛ₂/I₂."""
        return self.rate * self.whole[1] * self.vertical(t) / self.whole

    def gain(self, K, gamma):
        """X₃(H) = (D/4)⟨γ,ω'⟩⟨γ',ω'⟩, B(γ)ω = K, B(γ)ω' = Iω × ω."""
        contact = np.diag(self.whole) - self.D * np.outer(gamma, gamma)
        omega = np.linalg.solve(contact, K)
        turn = np.linalg.solve(contact, cross(self.inertia * omega, omega))
        return self.D / 4 * gamma @ turn * (cross(gamma, omega) @ turn)

    def slope(self, gamma, e, size=1e-5):
        """d/ds X₃(H) at K = h(γ + se), s = 0."""
        ends = [self.gain(self.h * (gamma + sign * size * e), gamma) for sign in (1, -1)]
        return (ends[0] - ends[1]) / (2 * size)

    def integral(self, e, last, steps=1200):
        """∫ of that from -last to last, e' = e × ω from t = 0, by Runge and Kutta, and by Simpson's rule."""
        weights = np.full(steps + 1, 2.0)
        weights[1::2], weights[[0, -1]] = 4, 1
        return sum(weights @ self.slopes(e, sign * last / steps, steps) * last / steps / 3 for sign in (1, -1))

    def slopes(self, e, dt, steps):
        found = []
        for i in range(steps + 1):
            start, middle, end = (self.spin(dt * (i + part)) for part in (0, 0.5, 1))
            found.append(self.slope(self.vertical(dt * i), e))
            first = cross(e, start)
            second = cross(e + dt / 2 * first, middle)
            third = cross(e + dt / 2 * second, middle)
            e = e + dt / 6 * (first + 2 * second + 2 * third + cross(e + dt * third, end))
        return np.array(found)


@pytest.mark.parametrize(("whole", "contact", "height"), [((6, 5, 3), 1, 1.3), *slow(((9, 5, 2), 1.5, 0.7))])
def test_the_energy_gains_what_the_closed_form_says(whole, contact, height):
    ball = Ball(whole, contact, height)
    gamma, omega = ball.vertical(0), ball.spin(0)
    along = omega - gamma @ omega * gamma
    along /= np.linalg.norm(along)
    last = 14 / (ball.kappa * ball.rate)
    amplitude = np.pi / 12 * contact * ball.rate**4 * (1 + ball.kappa**2) / np.cosh(np.pi / (2 * ball.kappa))
    assert abs(ball.integral(along, last)) < 1e-5 * amplitude
    assert abs(ball.integral(cross(gamma, along), last) + amplitude) < 1e-5 * amplitude
