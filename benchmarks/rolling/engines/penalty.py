"""A contact by penalty as the control.

The floor is a spring with a damper; the friction is a force against the slip, in proportion to it (viscous).  Runge and
Kutta's method of order 4 with a fixed step, in space.
"""

from pathlib import Path

import numpy as np

from chapsym import generated
from chapsym.scene.read import robots

from .common import Rows, Start

GRAVITY, STIFFNESS, DAMPING, VISCOSITY = 9.81, 1e6, 1e3, 3e2  # m/s², N/m, N s/m, N s/m, each a kg of the ball


def run(body: Path, start: Start, step: float, best: bool = False) -> Rows:
    """The tensor must be diagonal; there is one setting only."""
    ball = robots.table(body)
    tensor = np.array(ball.get("inertia", np.ones((3, 3)))).astype(float)
    if (tensor != np.diag(tensor.diagonal())).any():
        raise SystemExit(f"{body} must have an inertia in its principal axes: this control takes no other")
    mass, radius, (j1, j2, j3) = float(ball["mass"]), float(ball["radius"]), tensor.diagonal()

    def rate(state: np.ndarray) -> np.ndarray:
        """The rates of the centre, the quaternion (scalar first), the velocity and ω, in space."""
        _, _, z, qw, qx, qy, qz, vx, vy, vz, wx, wy, wz = state.tolist()
        depth = radius - z
        press = max(0.0, STIFFNESS * depth - DAMPING * vz) if depth > 0 else 0.0  # of a kg
        held = VISCOSITY if press > 0 else 0.0
        ax, ay = -held * (vx - radius * wy), -held * (vy + radius * wx)
        r = generated.rotation(qw, qx, qy, qz)
        p, q, s = (r[i] * wx + r[3 + i] * wy + r[6 + i] * wz for i in range(3))  # ω in the axes of the body
        tx, ty = mass * radius * ay, -mass * radius * ax
        dp = (r[0] * tx + r[3] * ty + (j2 - j3) * q * s) / j1
        dq = (r[1] * tx + r[4] * ty + (j3 - j1) * s * p) / j2
        ds = (r[2] * tx + r[5] * ty + (j1 - j2) * p * q) / j3
        turning = [r[i] * dp + r[i + 1] * dq + r[i + 2] * ds for i in (0, 3, 6)]
        spun = [-qx * wx - qy * wy - qz * wz, qw * wx + wy * qz - wz * qy, qw * wy + wz * qx - wx * qz,
                qw * wz + wx * qy - wy * qx]  # fmt: skip
        return np.array([vx, vy, vz, *(x / 2 for x in spun), ax, ay, press - GRAVITY, *turning])

    state = np.concatenate([start.centre, start.attitude, start.velocity, start.omega])
    state[2] -= GRAVITY / STIFFNESS  # where the spring holds its weight
    count, h = start.steps_between(step), step
    for time in start.time:
        for _ in range(count if time else 0):
            a = rate(state)
            b = rate(state + h / 2 * a)
            c = rate(state + h / 2 * b)
            state = state + h / 6 * (a + 2 * b + 2 * c + rate(state + h * c))
            state[3:7] /= np.linalg.norm(state[3:7])
        yield [time, *state]
