"""The continuous ball K' = K × ω, γ' = γ × ω (2.3): what a user would integrate it with, and a reference.

A peer is a function (y (6,) = (K, γ), end, control) -> y at the end; `control` is its tolerance or number of steps.
"""

from collections.abc import Callable
from fractions import Fraction
from functools import cache
from typing import Any

import numpy as np

from chapsym import Ball, certified_motion, generated
from chapsym.dynamics.levels.start import fraction
from chapsym.studies.harness import NotComparable

from .trajectory import MASS_TENSOR, D

Peer = Callable[[np.ndarray, float, float], np.ndarray]
BALL = (*map(float, MASS_TENSOR), D)
#: heyoka.py's batch: two vectors of AVX-512, which took the least time a ball where it was tried.
LANES = 8
#: Digits of the reference.
DIGITS = 25


def rates(K1, K2, K3, g1, g2, g3, J1, J2, J3, D):
    """K × ω and γ × ω, six numbers of any kind, with ω from the generated kernel."""
    w1, w2, w3 = generated.angular_velocity(K1, K2, K3, g1, g2, g3, J1, J2, J3, D)
    return (
        K2 * w3 - K3 * w2, K3 * w1 - K1 * w3, K1 * w2 - K2 * w1,
        g2 * w3 - g3 * w2, g3 * w1 - g1 * w3, g1 * w2 - g2 * w1,
    )  # fmt: skip


@cache
def _compiled_kernel() -> Callable[..., Any]:
    import numba
    from numba.extending import register_jitable

    register_jitable(error_model="numpy")(generated.angular_velocity)
    return numba.njit(error_model="numpy")(rates)


@cache
def compiled_rates() -> Callable[..., Any]:
    """The right side as SciPy wants it, f(t, y), compiled by numba."""
    import numba

    inner = _compiled_kernel()
    J1, J2, J3, contact = BALL

    @numba.njit(error_model="numpy")
    def right_side(t, y):
        return np.array(inner(y[0], y[1], y[2], y[3], y[4], y[5], J1, J2, J3, contact))

    right_side(0.0, np.ones(6))
    return right_side


def dop853(y: np.ndarray, end: float, tolerance: float) -> np.ndarray:
    """SciPy's solve_ivp with DOP853."""
    from scipy.integrate import solve_ivp

    found = solve_ivp(compiled_rates(), (0.0, end), y, method="DOP853", rtol=tolerance, atol=tolerance)
    if not found.success:
        raise NotComparable(f"DOP853 fails at the tolerance {tolerance:g}: {found.message}")
    return found.y[:, -1]


def lsoda(y: np.ndarray, end: float, tolerance: float) -> np.ndarray:
    """SciPy's odeint, which is LSODA."""
    from scipy.integrate import odeint

    times, options = np.array([0.0, end]), {"rtol": tolerance, "atol": tolerance, "mxstep": 10**7}
    found, told = odeint(compiled_rates(), y, times, tfirst=True, full_output=True, **options)
    if told["message"] != "Integration successful.":
        raise NotComparable(f"LSODA fails at the tolerance {tolerance:g}: {told['message']}")
    return found[-1]


@cache
def _rk4_loop() -> Callable[..., Any]:
    import numba

    inner = _compiled_kernel()
    J1, J2, J3, contact = BALL

    @numba.njit(error_model="numpy")
    def march(y, h, steps):
        a, b, c, d, e, f = y[0], y[1], y[2], y[3], y[4], y[5]
        for _ in range(steps):
            k = inner(a, b, c, d, e, f, J1, J2, J3, contact)
            h2 = 0.5 * h
            l = inner(
                a + h2 * k[0], b + h2 * k[1], c + h2 * k[2], d + h2 * k[3], e + h2 * k[4], f + h2 * k[5],
                J1, J2, J3, contact,
            )  # fmt: skip
            m = inner(
                a + h2 * l[0], b + h2 * l[1], c + h2 * l[2], d + h2 * l[3], e + h2 * l[4], f + h2 * l[5],
                J1, J2, J3, contact,
            )  # fmt: skip
            n = inner(
                a + h * m[0], b + h * m[1], c + h * m[2], d + h * m[3], e + h * m[4], f + h * m[5],
                J1, J2, J3, contact,
            )  # fmt: skip
            s = h / 6
            a += s * (k[0] + 2 * (l[0] + m[0]) + n[0])
            b += s * (k[1] + 2 * (l[1] + m[1]) + n[1])
            c += s * (k[2] + 2 * (l[2] + m[2]) + n[2])
            d += s * (k[3] + 2 * (l[3] + m[3]) + n[3])
            e += s * (k[4] + 2 * (l[4] + m[4]) + n[4])
            f += s * (k[5] + 2 * (l[5] + m[5]) + n[5])
        return np.array([a, b, c, d, e, f])

    return march


def rk4(y: np.ndarray, end: float, steps: float) -> np.ndarray:
    """The classical Runge-Kutta method with fixed steps, in numba."""
    return _rk4_loop()(y, end / steps, int(steps))


def _system(number: type) -> list[tuple[Any, Any]]:
    """The equations for heyoka.py; it folds constants in the numbers that it is given."""
    import heyoka

    names = heyoka.make_vars("K1", "K2", "K3", "g1", "g2", "g3")
    ball = [heyoka.expression(number(x)) for x in BALL]
    return list(zip(names, rates(*names, *ball), strict=True))


@cache
def _taylor(tolerance: float, lanes: int) -> Any:
    """heyoka.py's integrator, compiled once for each tolerance."""
    import heyoka

    if lanes:
        return heyoka.taylor_adaptive_batch(_system(float), np.ones((6, lanes)), tol=tolerance)
    return heyoka.taylor_adaptive(_system(float), np.ones(6), tol=tolerance)


def taylor(y: np.ndarray, end: float, tolerance: float) -> np.ndarray:
    """heyoka.py for one ball."""
    integrator = _taylor(tolerance, 0)
    integrator.time = 0.0
    integrator.state[:] = y
    integrator.propagate_until(end)
    return integrator.state.copy()


def taylor_batch(y: np.ndarray, end: float, tolerance: float) -> np.ndarray:
    """heyoka.py for `LANES` balls at once, all from the same state; the state of the first."""
    integrator = _taylor(tolerance, LANES)
    integrator.set_time(0.0)
    integrator.state[:] = y[:, np.newaxis]
    integrator.propagate_until([end] * LANES)
    return integrator.state[:, 0].copy()


def reference(y: np.ndarray, end: float) -> list[Fraction]:
    """K and γ at the end, to proved digits."""
    found = certified_motion(Ball(MASS_TENSOR, D), y[:3], y[3:], end, DIGITS)
    return [fraction(x) for x in (*found.angular_momentum[0], *found.gamma[0])]
