"""How fast the map and its compositions converge to the continuous ball: errors at one time, and their slopes.

The reference is (2.3), K' = K × ω and γ' = γ × ω with K = Λω - D⟨ω,γ⟩γ, solved by its Taylor series in mpmath
at 40 digits: it shares nothing with the map.

Two kinds of points say nothing of the order and are dropped by rule.  With few steps the error is not yet its first
term: points above `COARSE` are dropped.  With many steps it is rounding, a random walk that the flow shears: points
below `PLATEAU`·2⁻⁵³·√(number of stages)·(1 + angle turned) are dropped, and none after the first of them counts.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import mpmath
import numpy as np
from numpy.typing import ArrayLike

from chapsym.dynamics import Ball, kernels, substeps, trajectory
from chapsym.dynamics.ball import Floats

#: Errors above this are not yet in the regime of their first term.
COARSE = 1e-3
#: Ten times what rounding alone was measured to give (tests/dynamics/test_reversal.py): it spoils at most a tenth.
PLATEAU = 10.0
#: The Taylor series is cut after this many terms for each digit.
TERMS_PER_DIGIT = 1.2


@dataclass(frozen=True)
class Convergence:
    """Errors of one order against the number of steps.

    error: the largest component of the errors of K/|K| and γ at the end, (runs,).
    used: whether the point is above the plateau and below the coarse regime, (runs,).
    """

    order: int
    steps: np.ndarray
    error: Floats
    used: np.ndarray

    @property
    def slope(self) -> float:
        """The order that was measured: minus the slope of log(error) against log(steps), by least squares."""
        return float(-np.polyfit(np.log(self.steps[self.used]), np.log(self.error[self.used]), 1)[0])


def convergence(
    ball: Ball, momentum: ArrayLike, gamma: ArrayLike, time: float, order: int, steps: Sequence[int]
) -> Convergence:
    """Errors at `time` (s) of the composition with each number of steps, from K (kg m²/s) and γ."""
    K, g = np.asarray(momentum, dtype=float), np.asarray(gamma, dtype=float)
    size, counts = np.abs(K).max(), np.array(steps)
    exact = continuous_ball(ball, K, g, time)
    errors = []
    for n in counts:
        run = trajectory(ball, K * (time / n), g, int(n), order=order, every=int(n))
        found = [*(run.momentum[-1] * (n / time)), *run.gamma[-1]]
        scale = [size] * 3 + [1.0] * 3
        errors.append(max(abs(float(x - y)) / s for x, y, s in zip(exact, found, scale, strict=True)))
    omega = kernels.angular_velocity(K, g, ball.mass_tensor, ball.D)
    rounding = 2.0**-53 * np.sqrt(counts * len(substeps(order))) * (1 + time * np.sqrt(omega @ omega))
    above = np.logical_and.accumulate(np.array(errors) > PLATEAU * rounding)
    return Convergence(order, counts, np.array(errors), above & (np.array(errors) < COARSE))


def continuous_ball(ball: Ball, momentum: ArrayLike, gamma: ArrayLike, time: float, digits: int = 40) -> list[Any]:
    """K and γ of (2.3) at `time`, six mpmath numbers, from the float64 numbers given, taken as exact."""
    mp = _context(digits + 10)
    J, D = [mp.mpf(float(x)) for x in ball.mass_tensor], mp.mpf(float(ball.D))
    inverse = [1 / (sum(J) - x + D) for x in J]
    state = [mp.mpf(float(x)) for x in (*np.asarray(momentum), *np.asarray(gamma))]
    terms, left = int(TERMS_PER_DIGIT * digits), mp.mpf(float(time))
    while left > 0:
        series = taylor(state, inverse, D, terms)
        # The last two terms: one of them may vanish by a symmetry.
        tail = max(abs(component[k]) ** (mp.one / k) for component in series for k in (terms - 1, terms))
        step = min(left, mp.mpf(10) ** (-mp.mpf(digits + 3) / terms) / tail) if tail else left
        state = [mp.polyval(component[::-1], step) for component in series]
        left -= step
    return state


def taylor(state: Sequence[Any], inverse: Sequence[Any], D: Any, terms: int) -> list[list[Any]]:
    """The Taylor series of K and γ (six lists of terms + 1 coefficients) that solves (2.3); `inverse` is Λ⁻¹."""
    K, g = [[x] for x in state[:3]], [[x] for x in state[3:]]
    F: list[Any] = []  # 1 - D⟨γ,Λ⁻¹γ⟩
    lift: list[Any] = []  # ⟨γ,ω⟩ = ⟨γ,Λ⁻¹K⟩/F
    omega: list[list[Any]] = [[], [], []]
    for n in range(terms):
        F.append((n == 0) - D * sum(inverse[i] * cauchy(g[i], g[i], n) for i in range(3)))
        known = sum(F[j] * lift[n - j] for j in range(1, n + 1))
        lift.append((sum(inverse[i] * cauchy(g[i], K[i], n) for i in range(3)) - known) / F[0])
        for i in range(3):
            omega[i].append(inverse[i] * (K[i][n] + D * cauchy(lift, g[i], n)))
        for vector in (K, g):
            rates = [cauchy(vector[i - 2], omega[i - 1], n) - cauchy(vector[i - 1], omega[i - 2], n) for i in range(3)]
            for component, rate in zip(vector, rates, strict=True):
                component.append(rate / (n + 1))
    return [*K, *g]


def cauchy(a: Sequence[Any], b: Sequence[Any], n: int) -> Any:
    """The coefficient n of the product of two power series."""
    return sum(a[j] * b[n - j] for j in range(n + 1))


@cache
def _context(dps: int) -> Any:
    """A context of its own for each precision: no global state."""
    context = mpmath.MPContext()
    context.dps = dps
    return context
