"""The modified equations in floats, by linear algebra and differences: nothing of chapsym."""

import numpy as np
from vectors import cross


class Modified:
    """ω and ω₃ of a ball with these J and D, and the densities of the drift of its energy and of its volume."""

    def __init__(self, tensor, contact):
        tensor = np.array(tensor, float)
        self.inertia, self.contact = tensor.sum() - tensor, float(contact)

    def solved(self, x, g):
        return np.linalg.solve(np.diag(self.inertia + self.contact) - self.contact * np.outer(g, g), x)

    def correction(self, K, g):
        """ω₃."""
        I, w = self.inertia, self.solved(K, g)
        a, turning = self.solved(cross(I * w, w), g), cross(g, w)
        pull = self.contact * (turning * (g @ a) + g * (turning @ a))
        second = self.solved(cross(I * a, w) + cross(I * w, a) + pull, g)
        return w @ w * w / 6 + second / 12 - cross(w, a) / 12 - self.solved(pull, g) / 4

    def densities(self, K, g, step=1e-4):
        w, w3 = self.solved(K, g), self.correction(K, g)
        divergence = 0.0
        for j, e in enumerate(np.eye(3)):
            ends = [self.correction(K + s * step * cross(K, e), g + s * step * cross(g, e))[j] for s in (-1, 1)]
            divergence += (ends[1] - ends[0]) / (2 * step)
        z = g / (self.inertia + self.contact)
        lift = self.contact * z @ cross(g, w3) / (1 - self.contact * g @ z)
        return w3 @ cross(w, self.inertia * w), divergence + lift

    def rates(self, _, y):
        """Of K, γ and of the integrals of the densities."""
        K, g = y[:3], y[3:6]
        w = self.solved(K, g)
        return [*cross(K, w), *cross(g, w), *self.densities(K, g)]
