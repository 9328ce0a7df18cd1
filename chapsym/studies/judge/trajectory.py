"""What an engine wrote: a CSV file with a row for each time, in m, s and rad, z up."""

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from chapsym.dynamics.errors import BadInput

NEEDED = ("time", "x", "y", "z", "qw", "qx", "qy", "qz")
MORE = ("vx", "vy", "vz", "wx", "wy", "wz")
#: Numbers from here on are of no ball.
LARGEST = 1e100
#: Two times are the same, if they differ by less than this part of the last.
SAME_TIME = 1e-9


@dataclass(frozen=True, eq=False)
class Trajectory:
    """The rows of a file at the frames of a case.

    centre in m, (frames, 3).  attitude: unit quaternions, (frames, 4).  velocity of the centre in m/s and omega in
    rad/s, in space, (frames, 3), or None.  step: that of the engine in s, from a line "# time_step = 0.001", or None.
    """

    file: str
    centre: np.ndarray
    attitude: np.ndarray
    velocity: np.ndarray | None
    omega: np.ndarray | None
    step: float | None


def read_trajectory(file: Path, times: np.ndarray) -> Trajectory:
    """The rows at `times`; other rows are left out.  Raises BadInput, one sentence, where there are none for one."""
    try:
        lines = file.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise BadInput(f"{file} cannot be read: {getattr(error, 'strerror', None) or 'it is no text'}") from None
    names, rows = _table(file, [line for line in lines if line.strip() and not line.startswith("#")])
    columns = {name: rows[:, i] for i, name in enumerate(names)}
    at = _places(file, columns["time"], times)
    found = {name: column[at] for name, column in columns.items()}
    attitude = np.stack([found[name] for name in NEEDED[4:]], axis=-1)
    length = np.linalg.norm(attitude, axis=-1, keepdims=True)
    if not (abs(length - 1) < 1e-3).all():
        worst = np.abs(length - 1).argmax()
        raise BadInput(f"{file}: the quaternion at {times[worst]:g} s has the length {length[worst, 0]:.6g}, not 1")
    velocity, omega = (
        np.stack([found[name] for name in part], axis=-1) if set(part) <= found.keys() else None
        for part in (MORE[:3], MORE[3:])
    )  # fmt: skip
    centre = np.stack([found[name] for name in NEEDED[1:4]], axis=-1)
    return Trajectory(str(file), centre, attitude / length, velocity, omega, _step(file, lines))


def _table(file: Path, lines: list[str]) -> tuple[list[str], np.ndarray]:
    names = [name.strip().strip('"') for name in (lines[0].split(",") if lines else [])]
    if missing := [name for name in NEEDED if name not in names]:
        raise BadInput(f"{file} has no column {missing[0]}: its first row must name {','.join((*NEEDED, *MORE))}")
    if twice := [name for name in names if names.count(name) > 1]:
        raise BadInput(f"{file} has the column {twice[0]} twice")
    rows = []
    for i, line in enumerate(lines[1:], 1):
        try:
            numbers = [float(x) for x in line.split(",")]
        except ValueError:
            numbers = []
        if len(numbers) != len(names) or not (np.abs(numbers) < LARGEST).all():
            raise BadInput(f"{file}: row {i} must have {len(names)} numbers, separated by commas, below {LARGEST:g}")
        rows.append(numbers)
    return names, np.array(rows).reshape(-1, len(names))


def _places(file: Path, given: np.ndarray, times: np.ndarray) -> np.ndarray:
    """The row of each time: the engine is not interpolated."""
    if not given.size:
        raise BadInput(f"{file} has no rows")
    near = SAME_TIME * max(times[-1], 1.0)
    at = np.array([np.abs(given - time).argmin() for time in times])
    off = np.abs(given[at] - times) > near
    if off.any():
        raise BadInput(
            f"{file} has no row at {times[off][0]:g} s: it must have one at each time of the case, every "
            f"{times[1] - times[0]:g} s to {times[-1]:g} s"
        )
    several = np.array([(np.abs(given - time) <= near).sum() > 1 for time in times])
    if several.any():
        raise BadInput(f"{file} has two rows at {times[several][0]:g} s")
    return at


def _step(file: Path, lines: list[str]) -> float | None:
    for line in lines:
        if found := re.fullmatch(r"#\s*time_step\s*=\s*(\S+)\s*", line):
            try:
                step = float(found[1])
            except ValueError:
                step = 0.0
            if not 0 < step < np.inf:
                raise BadInput(f"{file}: time_step must be a positive number of seconds, not {found[1]}")
            return step
    return None
