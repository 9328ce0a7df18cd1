"""An independent oracle: the matrix equation (4.13), solved for Ω in mpmath.

It shares no formula with the generated kernels: no Euler parameters, no vectors, no derived
expressions; only (4.13) as the paper prints it, in 3×3 matrices, and (4.12) for the step.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import mpmath


class OracleFailed(ArithmeticError):
    """The oracle met a fold before it reached the momentum."""


@dataclass(frozen=True)
class OracleStep:
    """Ω of one step, and 𝒦 and γ after it (mpmath matrices; vectors are lists)."""

    rotation: Any
    momentum: list[Any]
    gamma: list[Any]
    q0: Any
    q: list[Any]


class Oracle:
    """Solves (4.13) for Ω at `digits` digits by continuation from Ω = 1 along t𝒦, 0 ≤ t ≤ 1."""

    def __init__(self, mass_tensor: Sequence[Any], D: Any, gamma: Sequence[Any], digits: int = 40) -> None:
        self.mp = mpmath.MPContext()
        self.mp.dps = digits + 10
        mp = self.mp
        self.gamma = mp.matrix([mp.mpf(x) for x in gamma])
        self.D = mp.mpf(D)
        self.Gamma = self.gamma * self.gamma.T
        self.shifted = mp.diag([mp.mpf(x) for x in mass_tensor]) + self.D / 2 * self.Gamma

    def momentum(self, X: Any) -> Any:
        """(4.13), first form; linear in X."""
        rest = self.Gamma * X - X.T * self.Gamma
        return X * self.shifted - self.shifted * X.T + self.D / 2 * rest

    def skew(self, v: Sequence[Any]) -> Any:
        """The matrix whose (32, 13, 21) entries are v."""
        return self.mp.matrix([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])

    def step(self, momentum: Sequence[Any]) -> OracleStep:
        """The step from 𝒦; raises OracleFailed at a fold."""
        mp = self.mp
        target = self.skew([mp.mpf(x) for x in momentum])
        rotation = self._continued(target)
        after = rotation.T * target * rotation
        vertical = rotation.T * self.gamma
        q0 = mp.sqrt(1 + rotation[0, 0] + rotation[1, 1] + rotation[2, 2]) / 2
        q = [x / (4 * q0) for x in _axial(rotation - rotation.T)]
        return OracleStep(rotation, _axial(after), list(vertical), q0, q)

    def _continued(self, target: Any) -> Any:
        mp = self.mp
        rotation, t, dt = mp.eye(3), mp.mpf(0), mp.mpf(1)
        while t < 1:
            trial = min(mp.mpf(1), t + dt)
            moved = self._newton(rotation, trial * target, largest=mp.mpf("0.2"))
            if moved is None:
                dt /= 2
                if dt < mp.mpf(10) ** (-mp.dps // 2):
                    raise OracleFailed(f"the branch folds at {mp.nstr(t, 12)} of the momentum")
            else:
                rotation, t, dt = moved, trial, dt * mp.mpf("1.5")
        return rotation

    def _newton(self, rotation: Any, target: Any, largest: Any) -> Any:
        """Newton in so(3), Ω becoming Ω·Cayley(ξ); None unless the corrections fall from `largest` down."""
        mp = self.mp
        basis = [self.skew([1, 0, 0]), self.skew([0, 1, 0]), self.skew([0, 0, 1])]
        for _ in range(40):
            columns = [_axial(self.momentum(rotation * e)) for e in basis]
            matrix = mp.matrix([[columns[j][i] for j in range(3)] for i in range(3)])
            gap = _axial(target - self.momentum(rotation))
            try:
                xi = mp.lu_solve(matrix, mp.matrix(gap))
            except ZeroDivisionError:
                return None
            size = mp.norm(xi)
            if size > largest:
                return None
            half = self.skew(list(xi / 2))
            rotation = rotation * (mp.inverse(mp.eye(3) - half) * (mp.eye(3) + half))
            if size <= mp.mpf(10) ** (-mp.dps // 2 - 3) * mp.norm(rotation - mp.eye(3)):
                return rotation
            largest = max(size, mp.mpf(10) ** (-mp.dps // 2))
        return None


def _axial(a: Any) -> list[Any]:
    return [a[2, 1], a[0, 2], a[1, 0]]
