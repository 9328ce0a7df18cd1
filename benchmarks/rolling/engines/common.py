"""The common parts of the adapters: the start as an engine takes it, and the file that it writes."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from chapsym.scene.read import robots
from chapsym.studies.judge import Case, rolling
from chapsym.studies.judge_tables import MORE, NEEDED

DATA = Path(__file__).parents[1] / "data"
#: Time, centre, quaternion (scalar first), velocity and ω in space.
Rows = Iterable[Iterable[float]]


@dataclass(frozen=True, eq=False)
class Start:
    """The centre in m, the attitude (scalar first), the velocity in m/s and ω in rad/s in space; the frames' times."""

    centre: np.ndarray
    attitude: np.ndarray
    velocity: np.ndarray
    omega: np.ndarray
    time: np.ndarray

    def steps_between(self, step: float) -> int:
        """The steps from a frame to the next; raises SystemExit where the step does not divide it."""
        apart = self.time[1]
        count = round(apart / step)
        if abs(count * step - apart) > 1e-9:
            raise SystemExit(f"the step must divide {apart:g} s, the time between two frames")
        return count


def start_of(case: Case) -> Start:
    """The first frame of a case, and its times; raises SystemExit for what no adapter sets up."""
    if not case.radius or case.rotor.any() or case.velocity is not None:
        raise SystemExit(f"{case.name} is no ball that rolls by itself: the adapters are for those alone")
    spin = case.omega[0]
    centre = np.array([*case.path[0], case.radius])
    return Start(centre, case.attitude[0], rolling(case.radius, spin), spin, case.time)


def check_centre(body: Path) -> None:
    """Raises SystemExit where the centre of the sphere is not the origin of the body, whose motion is written."""
    if any(centre := robots.centre(body)):
        at = ", ".join(f"{float(x):g}" for x in centre)
        raise SystemExit(f"the origin of the body must be the centre of its sphere, and that is at ({at}) m")


def text(step: float, rows: Rows) -> str:
    """The file that `chapsym judge` reads."""
    lines = [f"# time_step = {step!r}", ",".join((*NEEDED, *MORE))]
    lines += [",".join(repr(float(x)) for x in row) for row in rows]
    return "\n".join(lines) + "\n"
