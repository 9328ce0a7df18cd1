"""Whether a trajectory can be compared with a motion: other axes, units and quaternions are tried, and said first.

A judgement of one convention against another would be of the convention.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import pairwise, product
from math import hypot
from pathlib import Path
from typing import Any

import numpy as np

from chapsym.dynamics.errors import BadInput

from .judge import Case, angle, certified
from .judge_tables import MORE, Table, Trajectory, in_space

#: How far, relatively, the first row may be from the start of a case beyond its digits: more than float32 rounds.
NEAR = 1e-5
#: The same of how high the centre is, and of how far the velocity is from ω × ρe₃: a soft contact gives way.
SOFT = 0.02
#: Another convention is meant where it is so many times nearer, and this one beyond so many degrees.
NEARER, FAR = 5.0, 10.0
#: Rows of a file that are judged at most, and radians that are turned until a convention shows.
MOST_ROWS, TURNED = 2000, 0.5

Way = tuple[str, Callable[[np.ndarray], np.ndarray]]


def _same(values: np.ndarray) -> np.ndarray:
    return values


def _scaled(factor: float, values: np.ndarray) -> np.ndarray:
    return values * factor


def _upright(vectors: np.ndarray) -> np.ndarray:
    """Vectors with y up as vectors with z up."""
    return np.stack([vectors[..., 0], -vectors[..., 2], vectors[..., 1]], axis=-1)


def _conjugate(q: np.ndarray) -> np.ndarray:
    return q * np.array([1, -1, -1, -1])


def _upright_turn(q: np.ndarray) -> np.ndarray:
    """A turn to axes with y up as one to axes with z up: after it, 90 degrees about x."""
    w, x, y, z = np.moveaxis(q, -1, 0)
    return np.stack([w - x, x + w, y - z, z + y], axis=-1) / np.sqrt(2)


_LAST = "its quaternion has the scalar last, in the column qz: name the four columns qx,qy,qz,qw"
_MOVED = "its quaternion has the scalar in the column qx: one with the scalar first was taken for one with it last"
_BACK = "its quaternion turns space to body, not body to space: write the conjugate"
QUATERNIONS: tuple[Way, ...] = (
    ("", _same),
    (_LAST, lambda q: np.roll(q, 1, axis=-1)),
    (_BACK, _conjugate),
    (_MOVED, lambda q: np.roll(q, -1, axis=-1)),
    (f"{_LAST}; and it turns space to body", lambda q: _conjugate(np.roll(q, 1, axis=-1))),
    (f"{_MOVED}; and it turns space to body", lambda q: _conjugate(np.roll(q, -1, axis=-1))),
)
AXES: tuple[Way, ...] = (("", _same), ("its y is up, and not z: write (x, -z, y) for (x, y, z)", _upright))
LENGTHS: tuple[Way, ...] = (
    ("", _same),
    ("its lengths are in mm: divide them by 1000", partial(_scaled, 1e-3)),
    ("its lengths are in cm: divide them by 100", partial(_scaled, 1e-2)),
)
DEGREES = "its angular velocity is in degrees per second: write rad/s"
OF_BODY = "its angular velocity is in the axes of the body, as MuJoCo gives it: turn it by the quaternion"


def _omegas(attitude: np.ndarray) -> tuple[Way, ...]:
    """Ways to read ω, of a ball with this attitude."""
    degree = partial(_scaled, np.pi / 180)
    body = partial(in_space, attitude)
    return ("", _same), (OF_BODY, body), (DEGREES, degree), (f"{OF_BODY}; {DEGREES}", lambda w: body(degree(w)))


def _not_comparable(file: str, slips: list[str]) -> BadInput:
    return BadInput(f"{file} cannot be judged as it is written: {'; '.join(slips)}")


# Against a case: the first row is its start.


def check_start(case: Case, run: Trajectory) -> None:
    """Raises BadInput unless the first row is the start of the case, and the next is not nearer in another convention.

    Where another convention makes it that start, the sentence names it.
    """
    whole = [_slips(case, run, axes) for axes in AXES]
    found = min((slips for slips in whole if slips is not None), key=len, default=None)
    if found is None:
        parts = ", ".join(f"{name} {value}" for name, value in _apart(case, run).items())
        told = f"its first row is not the start of {case.name} ({parts})"
        raise BadInput(f"{run.file}: {told}: no verdict on the engine; begin it as the case begins")
    if found:
        raise _not_comparable(run.file, found)
    tried = [angle(case.attitude[:2], way(run.attitude[:2])) for _, way in QUATERNIONS]
    fits = [after if before < np.degrees(_tolerance(case, run, "attitude")) else np.inf for before, after in tried]
    best = int(np.argmin(fits))
    if fits[0] > FAR and fits[best] * NEARER < fits[0]:
        raise _not_comparable(run.file, [QUATERNIONS[best][0]])


def _tolerance(case: Case, run: Trajectory, part: str) -> float:
    sizes: dict[str, Any] = {
        "centre": case.radius,
        "attitude": 1.0,
        "velocity": case.radius * np.linalg.norm(case.omega[0]),
        "omega": np.linalg.norm(case.omega[0]),
    }
    return float(2 * (run.digit or {}).get(part, 0.0) + NEAR * sizes[part])


def _start(case: Case) -> dict[str, np.ndarray]:
    w = case.omega[:1]
    velocity = case.radius * np.stack([w[:, 1], -w[:, 0], 0 * w[:, 0]], axis=-1)
    return {"centre": np.array([[*case.path[0], case.radius]]), "velocity": velocity, "omega": w}


def _slips(case: Case, run: Trajectory, axes: Way) -> list[str] | None:
    """What is otherwise in the first row, with these axes; None where it is not the start for any."""
    told, upright = axes
    start, found = _start(case), [told] if told else []
    turns = [*QUATERNIONS, *((f"{told}, of the quaternion, too", lambda q: _upright_turn(q)) for _ in found)]
    fits = (
        name
        for name, way in turns
        if np.radians(angle(case.attitude[:1], way(run.attitude[:1])))[0] <= _tolerance(case, run, "attitude")
    )
    slips = [next(fits, None)]
    ways: dict[str, tuple[Way, ...]] = {
        "centre": LENGTHS, "velocity": LENGTHS, "omega": _omegas(case.attitude[:1]),
    }  # fmt: skip
    for part, some in ways.items():
        values = getattr(run, part)
        if values is None:
            continue
        given = upright(values[:1])
        apart = {name: np.abs(way(given) - start[part])[0] for name, way in some}
        # A soft contact lets the centre sink at once.
        limit = np.array([1.0, 1.0, 1.0]) * _tolerance(case, run, part)
        limit[2] += SOFT * case.radius * (part == "centre")
        fit = next((name for name, off in apart.items() if (off <= limit).all()), None)
        if fit is None and part == "centre":
            fit = next((_moved(given, case) for off in apart.values() if off[2] <= limit[2]), None)
        slips.append(fit)
    return None if None in slips else list(dict.fromkeys([*found, *filter(None, slips)]))


def _moved(given: np.ndarray, case: Case) -> str:
    x, y = given[0, :2] - case.path[0]
    return f"its path begins ({x:g}, {y:g}) m from that of {case.name}: subtract this"


def _apart(case: Case, run: Trajectory) -> dict[str, str]:
    """How far the parts of the first row are from the start that are beyond what its digits allow."""
    turned = angle(case.attitude[:1], run.attitude[:1])[0]
    found = {"attitude": f"{turned:.3g} degrees"} if np.radians(turned) > _tolerance(case, run, "attitude") else {}
    for part, start in _start(case).items():
        if (values := getattr(run, part)) is not None:
            off = np.linalg.norm(values[0] - start[0])
            unit = {"centre": "m", "velocity": "m/s", "omega": "rad/s"}[part]
            found |= {part: f"{off:.3g} {unit}"} if off > _tolerance(case, run, part) else {}
    return found


# A ball of one's own: the first row is the start, and the ball's own law says in which convention it is written.


def case_of_body(file: Path, table: Table, limit: float = 600.0) -> Case:
    """The certified motion of the ball of a file from the first row of a table, at its own times from there.

    Raises BadInput where the row does not say a rolling start, and where another convention fits the rows better.
    """
    times = table.exact_times()
    if len(times) < 2:
        raise BadInput(f"{table.file} has {len(times)} rows: a motion has two at least")
    if missing := [name for name in MORE[3:] if name not in table.columns]:
        told = f"has no column {missing[0]}: the motion begins with the angular velocity of the first row"
        raise BadInput(f"{table.file} {told}")
    if any(b <= a for a, b in pairwise(times)):
        raise BadInput(f"{table.file}: its times must ascend")
    first = table.from_zero().at(np.array([0.0]))
    ball = _Own(file, first)
    chosen = times[:: -(-len(times) // MOST_ROWS)]
    speed = float(np.linalg.norm(np.asarray(first.omega)))
    probe = next((at for at in chosen[1:] if float(at) * speed >= TURNED), chosen[-1])
    rows = table.from_zero().at(np.array([0.0, float(probe)]))
    if slips := ball.static_slips():
        raise _not_comparable(first.file, slips)
    found: list[tuple[float, str]] = []
    for (turn, way), (frame, _) in product(QUATERNIONS, _omegas(first.attitude)):
        read = replace(rows, attitude=way(rows.attitude))
        omega = dict(_omegas(read.attitude[:1]))[frame](np.asarray(first.omega))
        if ball.rolls(omega):
            case = ball.motion(read.attitude[0], omega[0], [Fraction(0), probe], limit)
            found.append((float(angle(case.attitude, read.attitude)[1]), "; ".join(filter(None, (turn, frame)))))
        if found and not found[0][1] and found[0][0] <= FAR:
            return ball.motion(first.attitude[0], np.asarray(first.omega)[0], chosen, limit)
    if not found:
        raise BadInput(
            f"{first.file}: its ball slides at the start: the velocity of its centre is not omega × (0, 0, radius), by "
            f"more than {100 * SOFT:g} %; begin with a ball that rolls"
        )
    away, told = min(found)
    plain = next((off for off, name in found if not name), np.inf)
    if plain == np.inf or away * NEARER < plain:
        raise _not_comparable(first.file, [told])
    return ball.motion(first.attitude[0], np.asarray(first.omega)[0], chosen, limit)


class _Own:
    """The ball of a file, and a first row."""

    def __init__(self, file: Path, first: Trajectory) -> None:
        from chapsym.scene.read.scene import ball_table

        self.file, self.first = file, first
        self.ball: Mapping[str, Any] = {key: value for key, value in ball_table(file).items() if key != "name"}
        scene = self.scene(first.attitude[0], np.asarray(first.omega)[0])
        from chapsym.scene.members.members import expand

        self.radius = float(np.asarray(expand(scene).ball.radius)[0]) if "radius" in self.ball else 0.0
        if not self.radius:
            raise BadInput(f"{file}: the ball needs its radius, with its mass")

    def scene(self, attitude: np.ndarray, omega: np.ndarray, text: bool = False) -> Any:
        """A scene of it; with its text, which has numbers exactly, or without, so that errors name no line of it."""
        import tomllib

        from chapsym.scene.read.scene import checked, written

        x, y = self.first.centre[0, :2].tolist()
        start = {"attitude": attitude.tolist(), "omega": omega.tolist(), "axes": "space", "position": [x, y]}
        whole = written("ball", dict(self.ball)) + written("start", start) + written("run", {"time": 1, "frames": 1})
        return checked(tomllib.loads(whole), str(self.file), whole if text else None)

    def motion(self, attitude: np.ndarray, omega: np.ndarray, times: list[Fraction], limit: float) -> Case:
        """The certified motion from a start."""
        from chapsym.scene.members.exactly import exact_motion

        scene = self.scene(attitude, omega, text=True)
        return certified(self.file.stem, scene, exact_motion(scene)[0], times, limit)

    def static_slips(self) -> list[str]:
        """What the height of the centre says of axes and units; raises BadInput where it says nothing that is known."""
        for (axes, upright), (unit, way) in product(AXES, LENGTHS):
            if abs(way(upright(self.first.centre))[0, 2] - self.radius) <= SOFT * self.radius + self._digit("centre"):
                return [name for name in (axes, unit) if name]
        z = self.first.centre[0, 2]
        told = f"its centre begins at z = {z:g}, and a ball of radius {self.radius:g} m on the plane z = 0 has it there"
        raise BadInput(f"{self.first.file}: {told}: subtract {z - self.radius:g} from z, or mend the unit")

    def rolls(self, omega: np.ndarray) -> bool:
        """Whether the velocity of the first row, where it has one, is that of rolling."""
        if self.first.velocity is None:
            return True
        v, w = self.first.velocity[0], omega[0]
        off = hypot(v[0] - self.radius * w[1], v[1] + self.radius * w[0])
        size = max(hypot(*v[:2]), self.radius * hypot(*w[:2]))
        return off <= SOFT * size + self._digit("velocity") + self.radius * self._digit("omega")

    def _digit(self, part: str) -> float:
        return (self.first.digit or {}).get(part, 0.0)
