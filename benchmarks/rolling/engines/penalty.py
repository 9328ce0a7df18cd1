"""A contact by penalty as the control: python -m benchmarks.rolling.engines.penalty CASE STEP OUTPUT.csv

The floor is a spring with a damper; the friction is a force against the slip, in proportion to it (viscous).  Runge and
Kutta's method of order 4 with a fixed step, in space.
"""

import numpy as np

from chapsym import generated
from chapsym.studies.judge import Case, rolling

from .common import Rows, command, steps_between

GRAVITY, STIFFNESS, DAMPING, VISCOSITY = 9.81, 1e6, 1e3, 3e2  # m/s², N/m, N s/m, N s/m, each a kg of the ball


def run(case: Case, step: float, best: bool = False) -> Rows:
    """There is one setting only."""
    mass, radius, (j1, j2, j3) = case.mass, case.radius, case.inertia.tolist()

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

    sunk = GRAVITY / STIFFNESS
    start = [[*case.path[0], case.radius - sunk], case.attitude[0], rolling(case.radius, case.omega[0]), case.omega[0]]
    state, count, h = np.concatenate(start), steps_between(case, step), step
    for time in case.time:
        for _ in range(count if time else 0):
            a = rate(state)
            b = rate(state + h / 2 * a)
            c = rate(state + h / 2 * b)
            state = state + h / 6 * (a + 2 * b + 2 * c + rate(state + h * c))
            state[3:7] /= np.linalg.norm(state[3:7])
        yield [time, *state]


if __name__ == "__main__":
    command(run, __doc__)
