"""An independent oracle: the matrix equation (4.13), solved for Ω in mpmath, in three dimensions or n.

It shares no formula with the generated kernels: no Euler parameters, no vectors, no derived expressions.  It uses
(4.13) as printed in the paper, in matrices, and (4.12) for the step.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

from mpmath import MPContext, matrix, mpf


class OracleFailed(ArithmeticError):
    """The oracle met a fold before it reached the momentum."""


@dataclass(frozen=True)
class OracleStep:
    """Ω of a step, 𝒦 and γ after it (mpmath matrices; vectors are lists); q0 and q only in three dimensions."""

    rotation: matrix
    momentum: list[mpf]
    gamma: list[mpf]
    q0: mpf | None
    q: list[mpf]


class Oracle:
    """Solves (4.13) for Ω at `digits` digits by continuation from Ω = 1 along t𝒦, 0 ≤ t ≤ 1."""

    def __init__(
        self, mass_tensor: Sequence[mpf | float], D: mpf | float, gamma: Sequence[mpf | float], digits: int = 40
    ) -> None:
        self.digits = digits
        self._given = [*mass_tensor], D, [*gamma]
        self.n = len(self._given[0])
        #: The places of the components of a skew matrix: those of a vector, or in n dimensions those below the
        #: diagonal.
        below = [(i, j) for i in range(self.n) for j in range(i)]
        self.places = [(2, 1), (0, 2), (1, 0)] if self.n == 3 else below
        self._set_precision(digits + 10)

    def _set_precision(self, dps: int) -> None:
        self.mp = mp = _context(dps)
        tensor, D, gamma = self._given
        self.gamma = mp.matrix([mp.mpf(x) for x in gamma])
        self.D = mp.mpf(D)
        self.Gamma = self.gamma * self.gamma.T
        self.shifted = mp.diag([mp.mpf(x) for x in tensor]) + self.D / 2 * self.Gamma

    def momentum(self, X: matrix) -> matrix:
        """(4.13), first form; linear in X."""
        return self.skew(self._of(X.tolist()))

    def _of(self, X: list[list[mpf]]) -> list[mpf]:
        """The components of 𝒦 of the rows of X: of XS - (XS)ᵀ + D/2 (ΓX - (ΓX)ᵀ), S = J + D/2 Γ."""
        dot, (S, G, columns) = self.mp.fdot, (self.shifted.tolist(), self.Gamma.tolist(), list(zip(*X, strict=True)))
        found = []
        for i, j in self.places:  # S and Γ are symmetric
            rest = dot(G[i], columns[j]) - dot(G[j], columns[i])
            found.append(dot(X[i], S[j]) - dot(X[j], S[i]) + self.D / 2 * rest)
        return found

    def skew(self, v: Sequence[mpf]) -> matrix:
        """The skew matrix with the components v."""
        found = self.mp.matrix(self.n, self.n)
        for (i, j), x in zip(self.places, v, strict=True):
            found[i, j], found[j, i] = x, -x
        return found

    def components(self, a: matrix) -> list[mpf]:
        """The components of a skew matrix."""
        return [a[place] for place in self.places]

    def tangent(self, rotation: matrix) -> matrix:
        """The derivative of 𝒦 by ξ at Ω·exp(ξ), (m, m)."""
        rows, moved = rotation.tolist(), []
        for i, j in self.places:  # Ω times the skew matrix with 1 at (i, j)
            turned = [[self.mp.zero] * self.n for _ in rows]
            for to, row in zip(turned, rows, strict=True):
                to[j], to[i] = row[i], -row[j]
            moved.append(self._of(turned))
        return self.mp.matrix(moved).T

    def step(self, momentum: Sequence[mpf | float]) -> OracleStep:
        """The step from 𝒦; raises OracleFailed at a fold.

        Ω = 1 + O(𝒦): for a small 𝒦 the entries of Ω need more digits.
        """
        size = max(abs(self.mp.mpf(x)) for x in momentum) / self.mp.norm(self.shifted)
        small = max(0, -int(self.mp.log10(size))) if size else 0
        self._set_precision(self.digits + 10 + small)
        mp = self.mp
        target = self.skew([mp.mpf(x) for x in momentum])
        rotation = self._continued(target) if size else mp.eye(self.n)
        after = rotation.T * target * rotation
        vertical = rotation.T * self.gamma
        q0, q = None, []
        if self.n == 3:
            q0 = mp.sqrt(1 + rotation[0, 0] + rotation[1, 1] + rotation[2, 2]) / 2
            q = [x / (4 * q0) for x in self.components(rotation - rotation.T)]
        return OracleStep(rotation, self.components(after), list(vertical), q0, q)

    def _continued(self, target: matrix) -> matrix:
        mp = self.mp
        rotation, t, dt = mp.eye(self.n), mp.mpf(0), mp.mpf(1)
        while t < 1:
            trial = min(mp.mpf(1), t + dt)
            # On the way a root need only be a guess for the next; the last root gets all digits.
            enough = mp.mpf(10) ** (-self.digits // 2 - 8) if trial == 1 else mp.mpf("1e-12")
            if (moved := self._newton(rotation, trial * target, enough)) is None:
                dt /= 2
                if not dt >= mp.mpf(10) ** (-self.digits // 2):
                    raise OracleFailed(f"the branch folds at {mp.nstr(t, 12)} of the momentum")
            else:
                rotation, t, dt = moved, trial, dt * 2
        return rotation

    def _newton(self, rotation: matrix, target: matrix, enough: mpf) -> matrix | None:
        """Newton's iteration in so(n), Ω becoming Ω·Cayley(ξ), down to a correction `enough`.

        None unless the first correction is at most 0.2 (radians) and each is below 3/4 of the one before, since a
        longer step might leave the branch.
        """
        mp = self.mp
        one, largest = mp.eye(self.n), mp.mpf("0.2")
        for _ in range(40):
            gap = self.components(target - self.momentum(rotation))
            try:
                xi = mp.lu_solve(self.tangent(rotation), mp.matrix(gap))
            except ZeroDivisionError:
                return None
            if (size := mp.norm(xi)) > largest:
                return None
            half = self.skew(list(xi / 2))
            rotation = rotation * (mp.inverse(one - half) * (one + half))
            if size <= enough * mp.norm(rotation - one):
                return rotation
            largest = 3 * size / 4
        return None


@cache
def _context(dps: int) -> MPContext:
    """A context for each precision, without global state."""
    context = MPContext()
    context.dps = dps
    return context
