"""A contact by penalty, in SciPy, as the control: python -m benchmarks.rolling.engines.penalty CASE STEP OUTPUT.csv

The floor is a spring with a damper; the friction is a force against the slip, in proportion to it (viscous).  Runge and
Kutta's method of order 4 with a fixed step, in space.
"""

import numpy as np
from scipy.spatial.transform import Rotation

from chapsym.studies.judge import Case

from .common import Rows, command, steps_between, velocity_of

GRAVITY, STIFFNESS, DAMPING, VISCOSITY = 9.81, 1e6, 1e3, 1e3  # m/s², N/m, N s/m, N s/m, each a kg of the ball


def run(case: Case, step: float, best: bool = False) -> Rows:
    """There is one setting only."""

    def rate(state: np.ndarray) -> np.ndarray:
        """Of the centre, the quaternion (scalar first), the velocity and ω."""
        centre, q, v, w = np.split(state, [3, 7, 10])
        turn = Rotation.from_quat(q / np.linalg.norm(q), scalar_first=True).as_matrix()
        inertia = turn @ np.diag(case.inertia) @ turn.T
        depth = case.radius - centre[2]
        press = case.mass * max(0.0, STIFFNESS * depth - DAMPING * v[2]) if depth > 0 else 0.0
        arm = np.array([0.0, 0.0, -case.radius])
        slip = v + np.cross(w, arm)
        force = np.array([0.0, 0.0, press]) - case.mass * VISCOSITY * np.array([slip[0], slip[1], 0.0]) * (press > 0)
        turning = np.linalg.solve(inertia, np.cross(arm, force) - np.cross(w, inertia @ w))
        s, u = q[0], q[1:]
        spun = 0.5 * np.array([-w @ u, *(s * w + np.cross(w, u))])
        return np.concatenate([v, spun, force / case.mass - [0.0, 0.0, GRAVITY], turning])

    sunk = GRAVITY / STIFFNESS
    start = [[*case.path[0], case.radius - sunk], case.attitude[0], velocity_of(case), case.omega[0]]
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
