"""Motions of rolling balls with 30 proved digits, and how far a run of a physics engine is from them.

>>> import chapsym_rolling
>>> "robot" in chapsym_rolling.names()
True
>>> ball = chapsym_rolling.case("robot")
>>> ball.mass, ball.radius, ball.time[-1]
(1.9, 0.105, 10.0)
"""

from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np

from .errors import BadInput
from .judge import Case, departure, read_case, summary
from .judge_tables import Trajectory, read_trajectory

__all__ = ["BadInput", "Case", "case", "judge", "names"]


def names() -> list[str]:
    """The names of the cases."""
    return sorted(file.name.removesuffix(".json") for file in _data().iterdir() if file.name.endswith(".json"))


def case(name: str) -> Case:
    """A ball and its motion, in float64; raises BadInput for a name that is none."""
    if name not in names():
        raise BadInput(f"{name!r} is no case; those are {', '.join(names())}")
    with resources.as_file(_data() / f"{name}.json") as file:
        return read_case(file)


def judge(run: Any, of: str | Case) -> dict[str, Any]:
    """How far a run is from a case at its times, as `chapsym judge --json` says it.

    Parameters
    ----------
    run : path, or dict of arrays
        A CSV file with time, x, y, z, qw, qx, qy, qz and perhaps vx, vy, vz, wx, wy, wz: m, s, rad, z up, in space; or
        centre (frames, 3), attitude (frames, 4), perhaps velocity and omega (frames, 3), at the times of the case.
    of : str or Case

    Returns
    -------
    dict
        path, attitude, height, and with velocities energy, momentum, slip, as far as the case has them: each the
        greatest, that at the end, the unit; for four of them the limit, and the time when it is passed, or None.
    """
    truth = case(of) if isinstance(of, str) else of
    if isinstance(run, dict):
        arrays = {name: np.asarray(part, float) for name, part in run.items()}
        sizes = {"centre": 3, "attitude": 4, "velocity": 3, "omega": 3}
        if missing := [name for name in ("centre", "attitude") if name not in arrays]:
            raise BadInput(f"a run must have {missing[0]}")
        for name, part in arrays.items():
            if part.shape != (len(truth.time), sizes.get(name, 0)) or not np.isfinite(part).all():
                raise BadInput(f"{name} must be {len(truth.time)} rows of {sizes.get(name, 0)} finite numbers")
        length = np.linalg.norm(arrays["attitude"], axis=-1, keepdims=True)
        if not (abs(length - 1) < 1e-3).all():
            raise BadInput("attitude must be unit quaternions, the scalar first")
        moving = arrays.get("velocity"), arrays.get("omega")
        found = Trajectory("run", arrays["centre"], arrays["attitude"] / length, *moving, None)
    else:
        found = read_trajectory(Path(run), truth.time)
    return summary(departure(truth, found), truth.time)


def _data() -> Any:
    return resources.files(__package__) / "data"
