"""How far a run of the map is from the motion of the ball: by a pilot of both, the motion by a composition of order 8.

The integrals of the map, which it keeps whatever the step, do not tell that.
"""

import json
from dataclasses import asdict, dataclass

import numpy as np

from chapsym.dynamics import Ball, Trajectory, kernels, substeps, trajectory
from chapsym.dynamics.ball import Floats

#: Steps of the map of a pilot, all balls together: some hundredths of a second.
MOST = 2**17
#: Of more balls so many are followed.
BALLS = 8
#: The order of the motion.
HIGH = 8


@dataclass(frozen=True)
class Discretisation:
    """The largest distances of a run from the motion of the ball, at all steps up to `time`; estimates.

    time: in s; the run's end, or sooner, if a pilot of the whole run were long.
    gamma: |Δγ|.  omega: |Δω| in rad/s.  attitude: the angle between the two, in degrees.  contact: in m, or None for a
    ball without a radius.  balls: how many were followed, the first and the last among them.
    """

    time: float
    gamma: float
    omega: float
    attitude: float
    contact: float | None
    balls: int

    def sentence(self) -> str:
        """For a reader."""
        far = [f"{self.gamma:.2g} in gamma", f"{self.omega:.2g} rad/s in omega", f"{self.attitude:.2g} degrees"]
        far += [] if self.contact is None else [f"{self.contact:.2g} m on the plane"]
        balls = f", of {self.balls} balls" if self.balls > 1 else ""
        return f"about {', '.join(far)} off the motion of the ball, up to {self.time:.6g} s{balls}"

    def write(self) -> str:
        """As JSON, for a file."""
        return json.dumps(asdict(self))


def read(text: object) -> Discretisation | None:
    """What `write` gave; None for anything else."""
    try:
        found = Discretisation(**json.loads(text))  # type: ignore[arg-type]
        found.sentence()
    except (TypeError, ValueError, RecursionError):
        return None
    return found


def discretisation(
    ball: Ball, momentum: Floats, gamma: Floats, time_step: float, steps: int, order: int = 2
) -> Discretisation | None:
    """The estimate for balls (n,) from 𝒦 = εK (n, 3), γ (n, 3) in `steps` steps of `time_step` seconds.

    None where there are no steps, or a ball stops, with these steps or with those of the motion.
    """
    some = np.unique(np.linspace(0, len(gamma) - 1, BALLS).astype(int))
    finer = 2 if order == HIGH else 1
    work = len(some) * (len(substeps(order)) + finer * len(substeps(HIGH)))
    steps = min(steps, max(MOST // work, 1))
    if not steps:
        return None
    radius = None if ball.radius is None else ball.radius[some]
    few = Ball(ball.mass_tensor[some], ball.D[some], radius)

    def run(order: int, finer: int) -> Trajectory:
        return trajectory(
            few, momentum[some] / finer, gamma[some], finer * steps, order=order, every=finer,
            attitude=True, contact=radius is not None, time_step=time_step / finer,
        )  # fmt: skip

    found, motion = run(order, 1), run(HIGH, finer)
    if found.status.any() or motion.status.any():
        return None
    return _apart(found, motion)


@np.errstate(all="ignore")  # a ball beyond the range of float64 has no finite distance, and none is told
def _apart(found: Trajectory, motion: Trajectory) -> Discretisation | None:
    a, b = found.attitude, motion.attitude
    assert a is not None
    assert b is not None
    chord = np.minimum(_lengths(a - b), _lengths(a + b)).max()
    turned = float(np.degrees(4 * np.arcsin(min(chord / 2, 1.0))))
    gamma, omega = _largest(found.gamma - motion.gamma), _largest(_omega(found) - _omega(motion))
    plane = None if found.contact is None else _largest(found.contact - motion.contact)
    if not np.isfinite([gamma, omega, turned, plane or 0.0]).all():
        return None
    return Discretisation(float(found.time[-1]), gamma, omega, turned, plane, len(found.gamma))


def _lengths(v: Floats) -> Floats:
    return np.asarray(np.linalg.norm(v, axis=-1))


def _largest(v: Floats) -> float:
    return float(_lengths(v).max())


def _omega(run: Trajectory) -> Floats:
    ball = run.ball
    return kernels.angular_velocity(
        run.angular_momentum(), run.gamma, ball.mass_tensor[:, np.newaxis], ball.D[:, np.newaxis]
    )
