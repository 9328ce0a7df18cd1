"""Whether a trajectory can be compared with a motion: tests for other axes, units and quaternions.

A comparison in different conventions would measure the convention.
"""

import tomllib
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from functools import partial
from itertools import pairwise, product
from pathlib import Path
from typing import Any

import numpy as np

from chapsym.dynamics.ball import Floats
from chapsym.dynamics.errors import BadInput

from .judge import Case, angle, equal, rolling
from .judge_tables import MORE, NEEDED, Table, Trajectory, in_space

#: The largest relative deviation of the first row from the start, beyond its digits: above the rounding of float32; and
#: for a soft contact: that of the height of the centre, and of the velocity of a ball that starts by itself.
NEAR, SOFT = 1e-5, 0.02
#: Another convention is reported if its error is smaller by the first factor and less than the second number, and that
#: of this one more than the third, in degrees; the search ends at one within the last number.
NEARER, FAR, SEEN, FITS = 5.0, 10.0, 1.0, 0.1
#: The later of two readings is better if its error is less than this fraction of the earlier error, up to rounding.
SAME = 0.999
#: Velocities are in body axes if, read in space axes, their error is more than this fraction of the greatest.
OFF = 0.01
#: Times are in another unit if they are this many times too long for the path; and the largest variation of the ratio.
UNIT, STEADY = 300.0, 1.5
#: The largest number of rows of a file, and the rotation in radians after which a convention shows.
MOST_ROWS, TURNED = 2000, 0.5

#: Called with sentences while a motion is certified.
Progress = Callable[[str], None]
SILENT: Progress = lambda sentence: None  # noqa: E731

Way = tuple[str, Callable[[np.ndarray], np.ndarray]]
PLAIN: Way = ("", np.asarray)


def _moved(*places: int, signs: Sequence[int]) -> Callable[[np.ndarray], np.ndarray]:
    """Components from these places, each times its sign: vectors or quaternions, converted from another convention."""
    return lambda array: array[..., places] * np.array(signs, dtype=float)


#: Vectors with y up, with z down, and in Unity's left-handed axes (right, up, forward), as those with z up of ROS.
_upright = _moved(0, 2, 1, signs=(1, -1, 1))
_upside = _moved(0, 1, 2, signs=(1, -1, -1))
_right_handed = _moved(2, 0, 1, signs=(1, -1, 1))
#: A rotation to axes with z down as one to axes with z up: followed by 180 degrees about x.
_upside_turn = _moved(1, 0, 3, 2, signs=(-1, 1, -1, 1))
#: A rotation in Unity's axes, also for the body, as one in those of ROS: its axis is a pseudovector, like ω.
_right_handed_turn = _moved(0, 3, 1, 2, signs=(1, -1, 1, -1))


def _upright_turn(q: np.ndarray) -> np.ndarray:
    """A rotation to axes with y up as one to axes with z up: followed by 90 degrees about x."""
    return (q + _upside_turn(q)) / np.sqrt(2)


_LAST = "its quaternion has the scalar last, in the column qz: name the four columns qx,qy,qz,qw"
_MOVED = "its quaternion has the scalar in the column qx: one with the scalar first was taken for one with it last"
_BACK = "its quaternion turns space to body, not body to space: write the conjugate"
_Y_UP = "its y is up, and not z: write (x, -z, y) for (x, y, z)"
_UNITY = (
    "its axes are Unity's, of the body, too: write (z, -x, y) for (x, y, z), (-z, x, -y) for the angular velocity and "
    "(qw, -qz, qx, -qy) for the quaternion"
)
_DEGREES = "its angular velocity is in degrees per second: write rad/s"
_Z_DOWN = "its z is down: write (x, -y, -z) for (x, y, z)"
_OF_BODY = "its angular velocity is in the axes of the body, as MuJoCo gives it: turn it by the quaternion"
_TWIST = "its velocities are in the axes of the body, as in ROS's Odometry: turn both by the quaternion"
_rolled = partial(np.roll, axis=-1)
ORDERS: tuple[Way, ...] = (PLAIN, (_LAST, partial(_rolled, shift=1)), (_MOVED, partial(_rolled, shift=-1)))
SENSES: tuple[Way, ...] = (PLAIN, (_BACK, partial(np.multiply, [1, -1, -1, -1])))
UNITS: tuple[Way, ...] = (
    PLAIN,
    ("its lengths are in mm: divide them by 1000", partial(np.multiply, 1e-3)),
    ("its lengths are in cm: divide them by 100", partial(np.multiply, 1e-2)),
)
_TOO = ", of the quaternion, too"
#: The conventions of the upward axis: of vectors, and of the rotation.
AXES: tuple[tuple[Way, Way], ...] = (
    (PLAIN, PLAIN),
    *((way, turn) for way, too in (((_Y_UP, _upright), _upright_turn), ((_Z_DOWN, _upside), _upside_turn))
      for turn in (PLAIN, (_TOO, too))),
    ((_UNITY, _right_handed), ("", _right_handed_turn)),
)  # fmt: skip
TURNING: tuple[Way, ...] = (PLAIN, (_DEGREES, np.radians))


def _readings(run: Trajectory) -> Iterator[tuple[list[str], Trajectory]]:
    """A trajectory unchanged and in all other conventions, with their differences, the fewest first, one by one."""
    none = run.attitude is None
    found = []
    turned = ((PLAIN,), (PLAIN,)) if none else (ORDERS, SENSES)
    for ways in product(AXES, *turned, UNITS, (False, True), TURNING, ("",) if none else ("", _OF_BODY, _TWIST)):
        (frame, upturn), order, sense, unit, speed, rate, body = ways
        differences = [frame[0] + upturn[0], order[0], sense[0], unit[0], rate[0], body]
        if not speed or unit is not PLAIN:
            found.append(([name for name in differences if name], ways))
    for names, ((frame, upturn), order, sense, unit, speed, rate, body) in sorted(found, key=lambda one: len(one[0])):
        attitude = None if run.attitude is None else upturn[1](sense[1](order[1](run.attitude)))
        velocity, omega = run.velocity, run.omega
        if velocity is not None:
            velocity = unit[1](velocity) if speed else velocity
            velocity = in_space(attitude, velocity) if attitude is not None and body is _TWIST else frame[1](velocity)
        if omega is not None:
            omega = rate[1](in_space(attitude, omega) if attitude is not None and body else frame[1](omega))
            omega = -omega if frame[0] == _UNITY and not body else omega
        centre = frame[1](unit[1](run.centre))
        yield names, replace(run, centre=centre, attitude=attitude, velocity=velocity, omega=omega)


#: The values of a start, by the names of the parts of a trajectory.
Start = dict[str, np.ndarray]


def _rolling(place: np.ndarray, radius: float, attitude: np.ndarray, omega: np.ndarray) -> Start:
    """The start of a ball that rolls on the plane, from its point of contact."""
    centre = np.array([*place, radius])
    return {"centre": centre, "attitude": attitude, "velocity": rolling(radius, omega), "omega": omega}


def _apart(run: Trajectory, start: Start, soft: float) -> list[str]:
    """The parts of the first row that differ from a start, and the differences."""
    found = []
    for part, unit in (("centre", "m"), ("attitude", "degrees"), ("velocity", "m/s"), ("omega", "rad/s")):
        if (values := getattr(run, part)) is None:
            continue
        size = (start["centre"][2] if part == "centre" else np.linalg.norm(start[part])) or 1.0  # a number 0 has none
        limit = 2 * (run.digit or {}).get(part, 0.0) + NEAR * size + soft * size * (part == "velocity")
        if part == "attitude":
            off = float(angle(start[part], values[0]))
            limit = np.degrees(limit)
        else:
            away = np.abs(values[0] - start[part]) - np.array([0.0, 0.0, SOFT * size if part == "centre" else 0.0])
            off = float(np.linalg.norm(np.maximum(away, 0.0)))
        if off > limit:
            found.append(f"{part} {off:.3g} {unit}")
    return found


def _check(
    run: Trajectory, of: str, start: Callable[[Trajectory], Start], second: Callable[[Trajectory], Floats], soft: float
) -> None:
    """Raises BadInput unless the first row is a start; names the convention in which it is, or in which row two fits.

    start, second: what the first row and the attitude of the second should be, of a reading of both.
    """
    plain, best, slips = np.inf, np.inf, list[str]()
    for names, read in _readings(run):
        if _apart(read, start(read), soft):
            continue
        off = 0.0 if read.attitude is None else float(angle(second(read), read.attitude[1]))
        if not names:
            plain = off
            if off <= SEEN:
                return
        if off < SAME * best:
            best, slips = off, names
        if best <= FITS:
            break
    if slips and best <= FAR and best * NEARER < plain:
        raise BadInput(f"{run.file} cannot be judged as it is written: {'; '.join(slips)}")
    if plain == np.inf:
        away = _apart(run, start(run), soft)
        if all(part.startswith("centre") for part in away):
            x, y, z = run.centre[0] - start(run)["centre"]
            flies = ", or begin where a ball in the air has come down" if z > 0 else ""
            away = [f"its centre is ({x:g}, {y:g}, {z:g}) m from there: subtract this{flies}"]
        clause = f"its first row is not the start of {of} ({', '.join(away)})"
        raise BadInput(f"{run.file}: {clause}: no verdict on the engine")


def check_start(case: Case, run: Trajectory, soft: float = 0.0) -> None:
    """Raises BadInput unless the first row is the start of the case; names the convention in which it would be.

    soft: the largest relative deviation of the velocity.
    """
    start = _rolling(case.path[0], case.radius, case.attitude[0], case.omega[0]) | {"velocity": case.moving[0]}
    _check(run, case.name, lambda read: start, lambda read: case.attitude[1], soft)


def check_axes(case: Case, run: Trajectory) -> None:
    """Raises BadInput where velocities are those of the case if they are turned by the attitude of their own row.

    The first row does not show it, if its attitude is no turn.
    """
    if run.attitude is None:
        return
    near = angle(case.attitude, run.attitude) <= FAR
    for part, truth, said in (("velocity", case.moving, _TWIST), ("omega", case.omega, _OF_BODY)):
        values, size = getattr(run, part), np.abs(truth).max()
        if values is None or not size or not near.any():
            continue
        reads = values, in_space(run.attitude, values)
        plain, of_body = (float(np.linalg.norm((x - truth)[near], axis=-1).max() / size) for x in reads)
        if plain > OFF and of_body * NEARER < plain:
            raise BadInput(f"{run.file} cannot be judged as it is written: {said}")


def _check_units(table: Table, file: Path, radius: float) -> None:
    """Raises BadInput if the times, or the radius, are consistently larger than the path between rows, and ω, imply."""
    centre, omega = (np.asarray(table.vectors(names)) for names in (NEEDED[1:4], MORE[3:]))
    speed = np.linalg.norm(rolling(radius, omega), axis=-1)[:-1]
    way = np.linalg.norm(np.diff(centre, axis=0), axis=-1)
    moved = way > 0
    if not moved.any():
        return
    low, middle, high = np.quantile((speed * np.diff(table.columns["time"]))[moved] / way[moved], [0.25, 0.5, 0.75])
    if middle > UNIT and high < STEADY * low:
        height = float(centre[0, 2])
        if radius / STEADY < middle * height < radius * STEADY:
            clause = f"the ball has the radius {radius:g} m, and its centre is {height:g} m high in {table.file}"
            raise BadInput(f"{file}: {clause}: write m, kg and kg m²")
        times = float(f"{middle:.3g}")
        clause = f"its times are {times:.0f} times what the way between its rows and its angular velocity say"
        raise BadInput(f"{table.file}: {clause}: write seconds and rad/s")


def case_of_body(file: Path, table: Table, progress: Progress = SILENT, limit: float = 600.0) -> Case:
    """The certified motion of the ball of a file from the first row of a table, at its own times from there.

    A ball with different moments needs an attitude; without it the motion is that of the file.  Raises BadInput if the
    row is not the start of a rolling ball, and if another convention fits better.
    """
    from chapsym.scene.members.exactly import exact_motion
    from chapsym.scene.members.members import ball_of, one_ball
    from chapsym.scene.read.scene import checked, written

    times = table.exact_times()
    if len(times) < 2:
        raise BadInput(f"{table.file}: a motion has two rows or more")
    if (row := next((i for i, (a, b) in enumerate(pairwise(times), 2) if b <= a), None)) is not None:
        early, late = (table.times[i - 1] for i in (row, row - 1))
        raise BadInput(f"{table.file}: row {row} is at {early} s, after one at {late} s: the times must ascend")
    first = table.from_zero().at(np.array([0.0]))
    if first.omega is None:
        clause = "has no column wx, wy or wz: the motion begins with the angular velocity of the first row"
        raise BadInput(f"{table.file} {clause}")
    ball, members = ball_of(file)

    def attitude(read: Trajectory) -> np.ndarray:
        """The first; any, where there is none: the ball then has equal moments, or its motion is not asked for."""
        return np.array([1.0, 0.0, 0.0, 0.0]) if read.attitude is None else read.attitude[0]

    def motion(read: Trajectory, times: list[Fraction]) -> Case:
        spin, place = np.asarray(read.omega)[0].tolist(), read.centre[0, :2].tolist()
        start = {"attitude": attitude(read).tolist(), "omega": spin, "axes": "space", "position": place}
        text = written("ball", ball) + written("start", start) + written("run", {"time": 1, "frames": 1})
        scene = checked(tomllib.loads(text), str(file), text)  # with its text, which has exact numbers
        return certified(file.stem, scene, exact_motion(scene)[0], times, progress, limit)

    if (radius := members.ball.radius) is None:
        raise BadInput(f"{file}: the ball needs its radius, with its mass")
    _check_units(table.from_zero(), file, float(radius[0]))
    chosen = times[:: -(-len(times) // MOST_ROWS)]
    speed = float(np.linalg.norm(first.omega))
    probe = next((at for at in chosen[1:] if float(at) * speed >= TURNED), chosen[-1])
    _check(
        table.from_zero().at(np.array([0.0, float(probe)])), "a ball that rolls",
        lambda read: _rolling(read.centre[0, :2], float(radius[0]), attitude(read), np.asarray(read.omega)[0]),
        lambda read: motion(read, [Fraction(0), probe]).attitude[1], SOFT,
    )  # fmt: skip
    inertia = one_ball(members, 0).inertia
    if first.attitude is None and not equal(inertia):
        time = np.array([float(at) for at in chosen])
        run = table.from_zero().at(time)
        any_turn = np.broadcast_to(attitude(run), (len(time), 4))
        omega = np.asarray(run.omega)
        mass = float(members.ball.D[0] / radius[0] ** 2)
        return Case(file.stem, mass, float(radius[0]), inertia, time, run.centre[:, :2], any_turn, omega, own=True)
    return motion(first, chosen)


#: The proved digits of a case that is made for a judgement.
DIGITS = 12


def case_of_scene(file: Path, progress: Progress = SILENT, limit: float = 600.0) -> Case:
    """The certified motion of the one ball of a scene, at its frames."""
    from chapsym.scene import load
    from chapsym.scene.members.exactly import exact_motion

    scene = load(file)
    start, times = exact_motion(scene)
    return certified(file.stem, scene, start, times, progress, limit)


def certified(name: str, scene: Any, start: Any, times: Sequence[Fraction], progress: Progress, limit: float) -> Case:
    """The certified motion from an exact start of a scene, at these times; raises BadInput if they are not reached."""
    from flint import arb

    from chapsym.dynamics.enclosed_motion import follow
    from chapsym.dynamics.flow.start import ball
    from chapsym.dynamics.principal_axes import from_principal
    from chapsym.scene.members.exactly import without_rotors
    from chapsym.scene.members.members import expand, one_ball

    if start.radius is None and start.D:
        raise BadInput(f"{name}: the contact point needs the radius: give the ball its mass and radius")
    members = expand(without_rotors(scene))
    moments = one_ball(members, 0).inertia
    if members.axes is not None:
        turn = from_principal(members.axes, np.eye(3)).T
        moments = turn * moments @ turn.T
    found = follow(start, times, DIGITS, limit=limit, progress=progress)
    if found.stopped:
        raise BadInput(f"{name}: the motion is certified to {float(found.times[-1]):g} s only: {found.stopped}")
    still = [[arb(0)] * 2] * len(times)  # for a body that nothing touches
    parts = [still if found.contact is None else found.contact, found.attitude, found.omega]
    path, attitude, omega = (np.array([[float(x.mid()) for x in row] for row in part]) for part in parts)
    attitude /= np.linalg.norm(attitude, axis=-1, keepdims=True)
    time = np.array([float(at) for at in times])
    mass, radius = (float(start.D / start.radius**2), float(start.radius)) if start.radius else (0.0, 0.0)
    rotor = np.array([float(ball(x).mid()) for x in start.rotor])
    return Case(name, mass, radius, moments, time, path, attitude, in_space(attitude, omega), rotor)
