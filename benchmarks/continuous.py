"""The continuous ball K' = K × ω, γ' = γ × ω (2.3): what a user would integrate it with, and a reference.

A peer is a function (y (6,) = (K, γ), end, control) -> y at the end; `control` is its tolerance or number of steps.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from chapsym import Ball, certified_motion, generated
from chapsym.dynamics.levels.start import fraction
from chapsym.dynamics.loops.vectors import cross

from .harness import NotComparable
from .trajectory import MASS_TENSOR, D

Peer = Callable[[np.ndarray, float, float], np.ndarray]
BALL = (*map(float, MASS_TENSOR), D)
#: heyoka.py's batch: two vectors of AVX-512, which took the least time a ball where it was tried.
LANES = 8
#: Digits of the reference.
DIGITS = 25


def rates(K1, K2, K3, g1, g2, g3, J1, J2, J3, D):
    """K × ω and γ × ω, six numbers of any kind, with ω from the generated kernel."""
    w = generated.angular_velocity(K1, K2, K3, g1, g2, g3, J1, J2, J3, D)
    return *cross((K1, K2, K3), w), *cross((g1, g2, g3), w)


def right_side(t: float, y: np.ndarray) -> tuple[float, ...]:
    """The right side in SciPy's form, in plain Python on floats."""
    return rates(*y.tolist(), *BALL)


def dop853(y: np.ndarray, end: float, tolerance: float) -> np.ndarray:
    """SciPy's solve_ivp with DOP853."""
    from scipy.integrate import solve_ivp

    found = solve_ivp(right_side, (0.0, end), y, method="DOP853", rtol=tolerance, atol=tolerance)
    if not found.success:
        raise NotComparable(f"DOP853 fails at the tolerance {tolerance:g}: {found.message}")
    return found.y[:, -1]


def lsoda(y: np.ndarray, end: float, tolerance: float) -> np.ndarray:
    """SciPy's odeint, which is LSODA."""
    from scipy.integrate import odeint

    times, options = np.array([0.0, end]), {"rtol": tolerance, "atol": tolerance, "mxstep": 10**7}
    found, report = odeint(right_side, y, times, tfirst=True, full_output=True, **options)
    if report["message"] != "Integration successful.":
        raise NotComparable(f"LSODA fails at the tolerance {tolerance:g}: {report['message']}")
    return found[-1]


def adaptive(system: list[tuple[Any, Any]], tolerance: float, kind: str, parameters: int = 0) -> Any:
    """heyoka.py's integrator of one ball, in "double" or "long double", or of a "batch" of `LANES`."""
    import heyoka

    if kind == "batch":
        pars = np.ones((parameters, LANES))
        return heyoka.taylor_adaptive_batch(system, np.ones((len(system), LANES)), tol=tolerance, pars=pars)
    number = np.longdouble if kind == "long double" else np.float64
    more = {"fp_type": number} if kind == "long double" else {}
    start, tol = np.ones(len(system), dtype=number), number(tolerance)
    return heyoka.taylor_adaptive(system, start, tol=tol, pars=np.zeros(parameters, dtype=number), **more)


@cache
def _taylor(tolerance: float, kind: str) -> Any:
    """The integrator, compiled once for each tolerance; it folds the constants of the ball."""
    import heyoka

    names = heyoka.make_vars("K1", "K2", "K3", "g1", "g2", "g3")
    sides = rates(*names, *map(heyoka.expression, BALL))
    return adaptive(list(zip(names, sides, strict=True)), tolerance, kind)


def taylor(y: np.ndarray, end: float, tolerance: float, kind: str = "double") -> np.ndarray:
    """heyoka.py for one ball, or for a batch, all from the same state; the state of the first."""
    integrator = _taylor(tolerance, kind)
    if kind == "batch":
        integrator.set_time(0.0)
    else:
        integrator.time = 0.0
    integrator.state.T[...] = y
    integrator.propagate_until(end)
    return integrator.state.T.reshape(-1, len(y))[0].copy()


def reference(y: np.ndarray, end: float) -> np.ndarray:
    """K and γ at the end, to proved digits, in float64."""
    found = certified_motion(Ball(MASS_TENSOR, D), y[:3], y[3:], end, DIGITS)
    return np.array([float(fraction(x)) for x in (*found.angular_momentum[0], *found.gamma[0])])
