"""The distance of a run of the map from the motion of the ball, by pilot runs with these steps and with half steps.

The integrals of the map do not show it, as every step keeps them.  Half steps divide the error of order p by 2^p, so
the distance to the motion is 2^p/(2^p - 1) times the distance to the finer run (Richardson).
"""

import json
import math
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from chapsym.dynamics import Ball, Status, Trajectory, kernels, substeps, trajectory
from chapsym.dynamics.ball import Floats, in_principal_axes

#: The number of stages of the map in the finer pilot run, of all balls together.
MOST = 2**16
#: The largest number of balls in a pilot run: enough to fill the lanes.
BALLS = 8


@dataclass(frozen=True)
class Discretisation:
    """Estimates of the largest distances of a run from the motion of the ball, at all steps up to `time`.

    time, end: of the pilot and of the run, in s.  gamma: |Δγ|.  omega: |Δω| in rad/s, None beyond float64.
    attitude: the angle between the two in degrees; contact: in m; None if the run does not follow them.
    balls: the number of balls in the pilot, without those that stop.
    """

    time: float
    end: float
    gamma: float
    omega: float | None
    attitude: float | None
    contact: float | None
    balls: int

    def sentence(self) -> str:
        """The estimate as a sentence."""
        units = {"gamma": "in gamma", "omega": "rad/s in omega", "attitude": "degrees", "contact": "m on the plane"}
        far = [f"{x:.2g} {unit}" for name, unit in units.items() if (x := getattr(self, name)) is not None]
        whole = f" of {self.end:.6g} s" if self.time < self.end else " s"
        balls = f", the largest of {self.balls} balls" if self.balls > 1 else ""
        return f"about {', '.join(far)} off the motion of the ball, up to {self.time:.6g}{whole}{balls}"

    def write(self) -> str:
        """The estimate as JSON, for a file."""
        return json.dumps(asdict(self))


def read(text: object) -> Discretisation | None:
    """The estimate from the text of `write`; None for anything else."""
    try:
        found = Discretisation(**json.loads(text))  # type: ignore[arg-type]
        numbers = [float(x) for x in vars(found).values() if x is not None]
    except (TypeError, ValueError, OverflowError, RecursionError):
        return None
    return found if all(math.isfinite(x) and x >= 0 for x in numbers) else None


def discretisation(
    ball: Ball, momentum: Floats, gamma: Floats, time_step: float, steps: int, order: int = 2,
    precision: str = "double", attitude: bool = True, contact: bool = True,
) -> Discretisation | None:  # fmt: skip
    """The estimate for balls (n,) from 𝒦 = εK (n, 3), γ (n, 3) in `steps` steps of `time_step` seconds.

    order, precision, attitude, contact: of the run.
    None if there are no steps, or no ball reaches the end of the pilot.
    """
    some = np.unique(np.linspace(0, len(gamma) - 1, BALLS).astype(int))
    pilot = min(steps, max(MOST // (2 * len(some) * len(substeps(order))), 1))
    if not steps:
        return None
    in_principal_axes(ball)
    few = Ball(ball.mass_tensor[some], ball.D[some], None if ball.radius is None else ball.radius[some])

    def run(finer: int, precision: str) -> Trajectory:
        return trajectory(
            few, momentum[some] / finer, gamma[some], finer * pilot, order=order, every=finer, attitude=attitude,
            contact=contact, time_step=time_step / finer, precision=precision,
        )  # fmt: skip

    # Two runs in float32 would share the rounding of the ball and of the start.
    coarse, fine = run(1, precision), run(2, "double" if precision == "single" else precision)
    if not (there := (coarse.status == Status.TAKEN) & (fine.status == Status.TAKEN)).any():
        return None
    far = _apart(coarse, fine, there, 2.0**order / (2.0**order - 1))
    numbers = [x for x in far.values() if x is not None]
    if not np.isfinite(numbers).all():
        return None
    return Discretisation(pilot * time_step, steps * time_step, **far, balls=int(there.sum()))


@np.errstate(all="ignore")  # a ball beyond the range of float64 has no finite distance, and none is reported
def _apart(coarse: Trajectory, fine: Trajectory, there: np.ndarray, factor: float) -> dict[str, Any]:
    """The distances of two runs, times a factor."""

    def distance(name: str, sign: float = 1.0) -> Floats | None:
        if getattr(coarse, name) is None:
            return None
        parts = (coarse, fine) if coarse.low is None else (coarse, fine, coarse.low, fine.low)
        a, b, *low = (np.asarray(getattr(part, name), dtype=float)[there] for part in parts)
        return np.asarray(np.linalg.norm(a - sign * b + (low[0] - sign * low[1] if low else 0.0), axis=-1))

    def omega(run: Trajectory) -> Floats:
        K, gamma = (np.asarray(x, dtype=float)[there] for x in (run.angular_momentum(), run.gamma))
        J, D = (x[there, np.newaxis] for x in (run.ball.mass_tensor, run.ball.D))
        return kernels.angular_velocity(K, gamma, J, D)

    same, other = distance("attitude"), distance("attitude", -1.0)
    turned = None if same is None or other is None else np.degrees(4 * np.arcsin(np.minimum(same, other) / 2))
    spun = None if coarse.low is not None else np.linalg.norm(omega(coarse) - omega(fine), axis=-1)
    far = {"gamma": distance("gamma"), "omega": spun, "attitude": turned, "contact": distance("contact")}
    return {name: None if x is None else factor * float(x.max()) for name, x in far.items()}
