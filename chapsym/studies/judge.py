"""How far an engine's trajectory is from a motion that is certified (benchmarks/rolling)."""

import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np

from chapsym.dynamics.errors import BadInput

# The truth: a certified motion, from the file that `benchmarks/rolling` holds of it.


@dataclass(frozen=True, eq=False)
class Case:
    """The truth at the frames, in float64.

    mass in kg, radius in m, inertia: the principal moments about the centre in kg m², (3,).
    time in s, (frames,).  path: the point of contact in m, (frames, 2).  attitude: unit quaternions, scalar first, from
    the axes of the body to space, (frames, 4).  omega: rad/s in space, (frames, 3).
    """

    name: str
    mass: float
    radius: float
    inertia: np.ndarray
    time: np.ndarray
    path: np.ndarray
    attitude: np.ndarray
    omega: np.ndarray


def read_case(file: Path) -> Case:
    """Raises BadInput, one sentence, for a file that is none."""
    try:
        data = json.loads(file.read_text(encoding="utf-8"))
        ball, frames = data["ball"], data["frames"]
        mass, radius, *inertia = (float(Fraction(x)) for x in (ball["mass"], ball["radius"], *ball["inertia"]))
        time = np.array([float(Fraction(frame["time"])) for frame in frames])
        path, attitude, omega = (
            np.array([[float(middle) for middle, _ in frame[part]] for frame in frames])
            for part in ("contact", "attitude", "omega")
        )
        shapes = [path.shape, attitude.shape, omega.shape]
        numbers = (mass, radius, *inertia, *time, *path.flat, *attitude.flat, *omega.flat)
        if shapes != [(len(time), n) for n in (2, 4, 3)] or len(inertia) != 3 or not np.isfinite(numbers).all():
            raise ValueError
        if len(time) < 2 or min(mass, radius) <= 0:
            raise ValueError
        return Case(str(data["case"]), mass, radius, np.array(inertia), time, path, attitude, in_space(attitude, omega))
    except OSError as error:
        raise BadInput(f"{file} cannot be read: {error.strerror or error}") from None
    except (ValueError, KeyError, TypeError, IndexError, ArithmeticError, RecursionError):
        raise BadInput(f"{file} is no case: it must be a file of benchmarks/rolling/data that ends in .json") from None


def in_space(attitude: np.ndarray, vector: np.ndarray) -> np.ndarray:
    """Vectors of the body, (..., 3), turned by unit quaternions, (..., 4)."""
    from chapsym import generated

    rows = np.stack(np.broadcast_arrays(*generated.rotation(*np.moveaxis(attitude, -1, 0))), axis=-1)
    return np.einsum("...ij,...j->...i", rows.reshape(*attitude.shape[:-1], 3, 3), vector)


# What an engine wrote: a CSV file with a row for each time, in m, s and rad, z up.

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


# How far one trajectory is from the truth, at each frame.

#: When a trajectory is said to have departed: m, degrees, per cent.
LIMITS = {"path": 1e-3, "attitude": 1.0, "energy": 1.0, "momentum": 1.0}
UNITS = {"path": "m", "attitude": "degrees", "energy": "%", "momentum": "%", "height": "m", "slip": "m/s"}


def limit_of(name: str) -> str:
    """A limit in words: 1 degree."""
    return f"{LIMITS[name]:g} {'degree' if name == 'attitude' else UNITS[name]}"


@dataclass(frozen=True, eq=False)
class Departure:
    """At the frames, (frames,) each, or None where the file has no velocities.

    path: from the point of contact to that below the centre, m.  attitude: the angle between the two, degrees.
    energy, momentum: of the energy, and of the momentum about the contact point as a vector fixed in space, from those
    at the start, per cent.  height: of the centre above the radius, m.  slip: the speed of the ball's point at the
    floor, m/s.
    """

    path: np.ndarray
    attitude: np.ndarray
    height: np.ndarray
    energy: np.ndarray | None
    momentum: np.ndarray | None
    slip: np.ndarray | None

    def parts(self) -> dict[str, np.ndarray]:
        """Those that there are, by name."""
        return {name: part for name in UNITS if (part := getattr(self, name)) is not None}

    def summary(self, time: np.ndarray) -> dict[str, Any]:
        """The greatest, that at the end, and when the limits are passed: for JSON."""
        found: dict[str, Any] = {}
        for name, part in self.parts().items():
            found[name] = {"greatest": float(np.abs(part).max()), "end": float(part[-1]), "unit": UNITS[name]}
            if name in LIMITS:
                passed = np.flatnonzero(np.abs(part) > LIMITS[name])
                found[name] |= {"limit": LIMITS[name], "departs": float(time[passed[0]]) if passed.size else None}
        return found


def departure(case: Case, found: Trajectory) -> Departure:
    """Compares a trajectory with a case, frame by frame."""
    path = np.linalg.norm(found.centre[:, :2] - case.path, axis=-1)
    energy = momentum = slip = None
    if found.velocity is not None and found.omega is not None:
        known = _carried(case, case.attitude, _rolling(case), case.omega)
        own = _carried(case, found.attitude, found.velocity, found.omega)
        energy = 100 * (own[0] / known[0][0] - 1)
        momentum = 100 * np.linalg.norm(own[1] - known[1][0], axis=-1) / np.linalg.norm(known[1][0])
        slip = np.linalg.norm(found.velocity[:, :2] - _rolling(case, found.omega)[:, :2], axis=-1)
    return Departure(
        path, angle(case.attitude, found.attitude), found.centre[:, 2] - case.radius, energy, momentum, slip
    )


def angle(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Between attitudes, in degrees: from the lengths of the sum and the difference, right for small angles, too."""
    apart, together = np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1)
    near, far = np.minimum(apart, together), np.maximum(apart, together)
    return np.degrees(4 * np.arctan2(near, far))


def _rolling(case: Case, omega: np.ndarray | None = None) -> np.ndarray:
    """The velocity of the centre of a ball that rolls: ω × ρe₃."""
    w = case.omega if omega is None else omega
    return case.radius * np.stack([w[:, 1], -w[:, 0], np.zeros(len(w))], axis=-1)


def _carried(
    case: Case, attitude: np.ndarray, velocity: np.ndarray, omega: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The kinetic energy, J, and the momentum about the point of contact, kg m²/s in space."""
    back = attitude * np.array([1, -1, -1, -1])
    turning = case.inertia * in_space(back, omega)
    spin = in_space(attitude, turning)
    energy = (case.mass * (velocity**2).sum(axis=-1) + (omega * spin).sum(axis=-1)) / 2
    return energy, spin + case.mass * case.radius * np.cross([0, 0, 1], velocity)


# What several steps of one engine say: its order, and the part of its distance that no step takes away.


@dataclass(frozen=True)
class Convergence:
    """Of the path, or of the attitude, over steps that are divided by one ratio.

    order: from how the differences between neighbouring steps fall; None where they do not fall.
    of_the_step: how far the finest run is from the limit of the runs.  floor: how far that limit is from the truth: the
    soft contact, the friction, the rounding.  Both are estimates, in m or degrees, and the greatest at the frames.
    """

    order: float | None
    of_the_step: float | None
    floor: float | None


def convergence(case: Case, runs: Sequence[Trajectory], of: str = "path") -> Convergence:
    """From three runs or more, each with its step, of the path or of the attitude.

    Where runs with the steps h, h/r and h/r² differ by d and d' at most, the order is log(d/d')/log r; the last run and
    its difference from the one before, over r^order - 1, give the limit of the runs at each frame.  Raises BadInput
    where steps are missing, equal or of several ratios.
    """
    if missing := [run.file for run in runs if run.step is None]:
        raise BadInput(f"{missing[0]} has no line '# time_step = SECONDS', which several files need")
    runs = sorted(runs, key=lambda run: -float(run.step or 0))
    steps = np.array([run.step for run in runs], dtype=float)
    ratios = steps[:-1] / steps[1:]
    if (ratios <= 1 + 1e-6).any() or np.ptp(ratios) > 1e-6 * ratios[0]:
        raise BadInput(
            f"the steps must be divided by the same number each time, but they are {', '.join(f'{x:g}' for x in steps)}"
        )
    if of == "path":
        points, truth, apart = [run.centre[:, :2] for run in runs], case.path, _distance
    else:
        points, truth, apart = [_turned(case, run) for run in runs], case.attitude, angle
    away = [float(apart(a, b).max()) for a, b in pairwise(points)]
    if not 0 < away[-1] < away[-2]:
        return Convergence(None, None, None)
    power = float(np.log(away[-2] / away[-1]) / np.log(ratios[-1]))
    limit = points[-1] + (points[-1] - points[-2]) / (ratios[-1] ** power - 1)
    return Convergence(power, float(apart(points[-1], limit).max()), float(apart(limit, truth).max()))


def _turned(case: Case, run: Trajectory) -> np.ndarray:
    """The attitudes, of their two signs those nearer to the truth."""
    along = (run.attitude * case.attitude).sum(axis=-1, keepdims=True)
    return np.where(along < 0, -run.attitude, run.attitude)


def _distance(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.asarray(np.linalg.norm(a - b, axis=-1))


def sentence(found: Convergence, unit: str) -> str:
    """What several steps say, estimated."""
    if found.order is None:
        return "the differences between steps do not fall: no order"
    return (
        f"order {found.order:.2f}; the finest run is {found.of_the_step:.3g} {unit} from the limit of the runs, and "
        f"that is {found.floor:.3g} {unit} from the truth (estimated)"
    )
