"""The distance of an engine's trajectory from a certified motion (benchmarks/rolling)."""

import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import numpy as np

from chapsym import files
from chapsym.dynamics.errors import BadInput

from .judge_tables import Trajectory, in_space

# The truth: a certified motion, from its file in `benchmarks/rolling`.


@dataclass(frozen=True, eq=False)
class Case:
    """The truth at the frames, in float64.

    mass in kg, radius in m, inertia: the principal moments about the centre in kg m², (3,), or the tensor, (3, 3).
    time in s, (frames,).  path: the point of contact in m, (frames, 2).  attitude: unit quaternions, scalar first, from
    the axes of the body to space, (frames, 4).  omega: rad/s in space, (frames, 3).  mass and radius 0: a body that
    nothing touches, with its centre at the origin.  rotor: the angular momentum of a rotor inside in kg m²/s, in body
    axes, (3,).  velocity: of the centre of a ball that slides, m/s in space, (frames, 3); None: it rolls.  friction:
    Coulomb's coefficient of a ball that slides.  offset: the centre of mass from the centre in m, in the axes of the
    body, (3,); then `inertia` is about the centre of mass.  gravity: in m/s², for a ball that slides or has an offset.
    own: the motion is that of the file, as it has no attitude; then only its height and its slip can be judged.
    """

    name: str
    mass: float
    radius: float
    inertia: np.ndarray
    time: np.ndarray
    path: np.ndarray
    attitude: np.ndarray
    omega: np.ndarray
    rotor: np.ndarray = field(default_factory=lambda: np.zeros(3))
    velocity: np.ndarray | None = None
    friction: float | None = None
    gravity: float | None = None
    offset: np.ndarray = field(default_factory=lambda: np.zeros(3))
    own: bool = False

    @property
    def moving(self) -> np.ndarray:
        """The velocity of the centre, (frames, 3)."""
        return rolling(self.radius, self.omega) if self.velocity is None else self.velocity


def read_case(file: Path) -> Case:
    """Reads a case; raises BadInput, one sentence, for a file without such data."""
    try:
        data = json.loads(files.text_of(file))
        if isinstance(data, dict) and "frames" in data and "ball" not in data:
            raise BadInput(f"{file} does not say of which ball it is: give the scene, --against SCENE.toml")
        ball, frames = dict(data["ball"]), [dict(frame) for frame in data["frames"]]
        touched = "contact" in frames[0]
        if any(frame.keys() != frames[0].keys() for frame in frames):
            raise ValueError("a frame has other parts than the first")
        mass, radius = (float(Fraction(ball[key])) if touched else 0.0 for key in ("mass", "radius"))
        inertia, rotor, offset = (
            np.array([float(Fraction(x)) for x in numbers])
            for numbers in (ball["inertia"], *(ball.get(name, [0] * 3) for name in ("rotor", "centre_of_mass")))
        )
        time = np.array([float(Fraction(frame["time"])) for frame in frames])
        path, attitude, omega, velocity = (
            np.array([[float(middle) for middle, _ in frame.get(part, [(0, 0)] * size)] for frame in frames])
            for part, size in (("contact", 2), ("attitude", 0), ("omega", 0), ("velocity", 3))
        )
        sliding = "velocity" in frames[0]
        needed = {"friction": sliding, "gravity": sliding or offset.any()}
        forces = {name: float(Fraction(data[name])) for name, counts in needed.items() if counts}
        shapes = [part.shape for part in (path, attitude, omega, velocity)]
        if shapes != [(len(time), n) for n in (2, 4, 3, 3)] or {len(inertia), len(rotor), len(offset)} != {3}:
            raise ValueError
        numbers = (path, attitude, omega, velocity, inertia, rotor, offset, time, [mass, radius], [*forces.values()])
        if not np.isfinite(np.concatenate([np.ravel(x) for x in numbers])).all():
            raise ValueError
        if len(time) < 2 or (min(mass, radius) <= 0 if touched else {"mass", "radius"} & ball.keys()):
            raise ValueError
        return Case(
            str(data["case"]), mass, radius, inertia, time, path, attitude, in_space(attitude, omega), rotor,
            velocity if sliding else None, forces.get("friction"), forces.get("gravity"), offset,
        )  # fmt: skip
    except files.CannotRead as error:
        raise BadInput(str(error)) from None
    except BadInput:
        raise
    except (ValueError, KeyError, TypeError, IndexError, ArithmeticError, RecursionError):
        raise BadInput(f"{file} is no case: it must be a file of benchmarks/rolling/data that ends in .json") from None


# The distance of a trajectory from the truth, at each frame.

#: The limits beyond which a trajectory has departed, or a law is broken: m, degrees, per cent, m/s.
LIMITS = {"path": 1e-3, "attitude": 1.0, "energy": 1.0, "momentum": 1.0, "height": 1e-3, "slip": 1e-3}
UNITS = {"path": "m", "attitude": "degrees", "energy": "%", "momentum": "%", "height": "m", "slip": "m/s"}


def limit_of(name: str) -> str:
    """A limit in words: 1 degree."""
    return f"{LIMITS[name]:g} {'degree' if name == 'attitude' else UNITS[name]}"


#: The available parts of a departure, in the order of UNITS, (frames,) each.
Departure = dict[str, np.ndarray]


def summary(found: Departure, time: np.ndarray) -> files.Data:
    """The greatest error of each part, the error at the end, and the time at which the limit is passed: for JSON."""
    results: files.Data = {}
    for name, part in found.items():
        results[name] = {"greatest": float(np.abs(part).max()), "end": float(part[-1]), "unit": UNITS[name]}
        if name in LIMITS:
            passed = np.flatnonzero(np.abs(part) > LIMITS[name])
            results[name] |= {"limit": LIMITS[name], "departs": float(time[passed[0]]) if passed.size else None}
    return results


def departure(case: Case, found: Trajectory) -> Departure:
    """Compares a trajectory with a case, frame by frame.

    path: from the point of contact to that below the centre, m.  attitude: the angle between the two, degrees.  With
    velocities, energy, momentum: the errors of the energy, and of the momentum about the contact point as a vector in
    space, in per cent of their values at the start; none for a ball that begins at rest.
    height: of the centre above the radius, m.  slip, with velocities: the velocity of the contact point of the ball
    less the true one, which is 0 in rolling, m/s.  Without attitudes, only a ball with equal moments has energy and
    momentum.  A body that nothing touches has neither height nor slip; its path is the distance of its centre from the
    fixed position, and its momentum is about the centre.
    """
    free = not case.radius
    place = np.column_stack([case.path, np.full(len(case.path), case.radius)])
    path = np.linalg.norm((found.centre - place)[:, : 3 if free else 2], axis=-1)
    parts = {} if case.own else {"path": path}
    attitude = case.attitude if found.attitude is None and equal(case.inertia) else found.attitude
    if found.attitude is not None:
        parts["attitude"] = angle(case.attitude, found.attitude)
    height = {} if free else {"height": found.centre[:, 2] - case.radius}
    if found.velocity is None or found.omega is None:
        return parts | height
    if attitude is not None and not case.own:
        known = carried(case, case.attitude, case.moving, case.omega)
        own = carried(case, attitude, found.velocity, found.omega)
        energy, momentum = known[0][0], np.linalg.norm(known[1][0])
        if energy and momentum:  # a ball at rest has neither
            parts["energy"] = 100 * (own[0] - known[0]) / energy
            parts["momentum"] = 100 * np.linalg.norm(own[1] - known[1], axis=-1) / momentum
    if free:
        return parts
    slip = found.velocity - rolling(case.radius, found.omega) - case.moving + rolling(case.radius, case.omega)
    return parts | height | {"slip": np.linalg.norm(slip[:, :2], axis=-1)}


def equal(inertia: np.ndarray) -> bool:
    """Whether moments, or a tensor, are those of a ball with the same motion from every attitude."""
    tensor = np.diag(inertia) if inertia.ndim == 1 else inertia
    return bool(np.allclose(tensor, tensor[0, 0] * np.eye(3), rtol=0, atol=1e-12 * tensor[0, 0]))


def angle(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The angle between attitudes in degrees, by the lengths of sum and difference, accurate for small angles, too."""
    apart, together = np.linalg.norm(a - b, axis=-1), np.linalg.norm(a + b, axis=-1)
    near, far = np.minimum(apart, together), np.maximum(apart, together)
    return np.degrees(4 * np.arctan2(near, far))


def rolling(radius: float, omega: np.ndarray) -> np.ndarray:
    """The velocities (..., 3) of the centre of a ball that rolls: ω × ρe₃."""
    return radius * np.stack([omega[..., 1], -omega[..., 0], np.zeros(omega.shape[:-1])], axis=-1)


def carried(case: Case, attitude: np.ndarray, velocity: np.ndarray, omega: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The energy, J, and the momentum about the point of contact, kg m²/s in space, of a state of the body.

    velocity: of the centre.  The energy is the kinetic energy and, with an offset, the potential energy of the centre
    of mass above its lowest position.  A rotor is in the momentum and not in the energy: with K = Bω + a and K' = K × ω
    the motion keeps ½⟨Bω,ω⟩ (lemma `gyrostat-integrals`).
    """
    turning = in_space(attitude * np.array([1, -1, -1, -1]), omega)
    turning = case.inertia * turning if case.inertia.ndim == 1 else np.einsum("ij,fj->fi", case.inertia, turning)
    spin, inside, offset = (in_space(attitude, part) for part in (turning, case.rotor, case.offset))
    velocity = velocity + np.cross(omega, offset)  # of the centre of mass
    height = np.linalg.norm(case.offset) + offset[:, 2]
    energy = (case.mass * (velocity**2).sum(axis=-1) + (omega * spin).sum(axis=-1)) / 2
    energy += case.mass * (case.gravity or 0.0) * height
    momentum = spin + inside + case.mass * case.radius * np.cross([0, 0, 1], velocity)
    return energy, momentum + case.mass * np.cross(offset, velocity)


# The result of several steps of one engine: its order, and the part of its error that no step removes.


@dataclass(frozen=True)
class Convergence:
    """The convergence of the path, or of the attitude, over steps with a common ratio.

    order: from the decrease of the differences between successive steps; None if they do not decrease.
    of_the_step: the distance of the finest run from the limit of the runs.  floor: the distance of this limit from the
    truth, by soft contact, friction and rounding.  Both are estimates, in m or degrees, and the greatest at the frames.
    """

    order: float | None
    of_the_step: float | None
    floor: float | None


def convergence(case: Case, runs: Sequence[Trajectory], of: str = "path") -> Convergence:
    """The convergence of three runs or more, each with its step, of the path or of the attitude.

    If runs with the steps h, h/r and h/r² differ by at most d and d', the order is log(d/d')/log r; the last run and
    its difference from the one before, over r^order - 1, give the limit of the runs at each frame.  Raises BadInput if
    steps are missing, equal or have several ratios.
    """
    if missing := [run.file for run in runs if run.step is None]:
        raise BadInput(f"{missing[0]} has no line '# time_step = SECONDS', which several files need")
    runs = sorted(runs, key=lambda run: -float(run.step or 0))
    steps = np.array([run.step for run in runs], dtype=float)
    ratios = steps[:-1] / steps[1:]
    if (ratios <= 1 + 1e-6).any() or np.ptp(ratios) > 1e-6 * ratios[0]:
        shown = ", ".join(f"{x:g}" for x in steps)
        raise BadInput(f"the steps must be divided by the same number each time, but they are {shown}")
    if of == "path":
        points, truth = [run.centre[:, :2] for run in runs], case.path
    else:
        points, truth = [_turned(case, run.attitude) for run in runs], case.attitude

    def apart(a: np.ndarray, b: np.ndarray) -> float:
        return float((np.linalg.norm(a - b, axis=-1) if of == "path" else angle(a, b)).max())

    away = [apart(a, b) for a, b in pairwise(points)]
    if not 0 < away[-1] < away[-2]:
        return Convergence(None, None, None)
    power = float(np.log(away[-2] / away[-1]) / np.log(ratios[-1]))
    limit = points[-1] + (points[-1] - points[-2]) / (ratios[-1] ** power - 1)
    return Convergence(power, apart(points[-1], limit), apart(limit, truth))


def _turned(case: Case, attitude: np.ndarray | None) -> np.ndarray:
    """The attitudes, with the signs that are nearer to the truth."""
    assert attitude is not None
    return np.where((attitude * case.attitude).sum(axis=-1, keepdims=True) < 0, -attitude, attitude)


def sentence(found: Convergence, unit: str) -> str:
    """The sentence on several steps, with its estimates."""
    if found.order is None:
        return "the differences between steps do not fall: no order"
    return (
        f"order {found.order:.2f}; the finest run is {found.of_the_step:.3g} {unit} from the limit of the runs, and "
        f"that is {found.floor:.3g} {unit} from the truth (estimated)"
    )
