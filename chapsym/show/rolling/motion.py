"""The data of the page: attitudes, contact points and vectors of a few balls at a few thousand frames."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from xarray import Dataset

from chapsym.dynamics import BadInput, Status, kernels
from chapsym.dynamics.ball import Floats

from ..drawing import curves, reading
from ..drawing.invariant import unit

MOST_BALLS = 20
#: Frames of all balls together, and the least and the largest number for one ball.
FRAMES, LEAST, MOST = 40_000, 2_000, 8_000
#: The largest rotation in radians between frames; beyond it, uniform rotation and straight lines would be visible.
EVEN = 0.4
#: The largest rotation between frames without ω; beyond it, whole turns may be hidden.
QUARTER = np.pi / 2

VECTORS = ("omega", "momentum", "gamma")
TOO_FAR = (
    "frames are too far apart to show the turning between them: keep more frames (a smaller run.every), "
    'or add "omega" to run.outputs'
)
TOO_MANY = "it turns too often between the frames shown here, so its turning is shown at these frames only"


@dataclass(frozen=True, eq=False)
class Rolling:
    """One ball: its frames until it stopped, at the kept clock readings.

    attitude: unit quaternions, (frames, 4).  turn: rotation vectors in space from frame to frame, (frames - 1, 3); None
    if they are not known.  contact: m, (frames, 2).  vectors: by name, body axes, (frames, 3).
    inertia: the principal moments (3,), or None.  axes: the unit quaternion from principal to body axes, or None if
    they are the same.  notes: the notes of the page on the ball.
    """

    name: str
    radius: float
    attitude: Floats
    turn: Floats | None
    contact: Floats
    vectors: dict[str, Floats]
    inertia: Floats | None
    axes: Floats | None
    notes: list[str] = field(default_factory=list)


@dataclass(frozen=True, eq=False)
class Motion:
    """The contents of the page.  clock: of the kept frames, in `unit` ("s" or "steps").

    between: their number from one frame of the result to the next: more than one if these are far apart.
    """

    clock: Floats
    unit: str
    balls: list[Rolling]
    notes: list[str]
    between: int = 1


def motion(dataset: Dataset, balls: Sequence[str | int] | None = None) -> Motion:
    """The motion of the chosen balls, by name or index, or of the first twenty; thinned to a few thousand frames.

    It ends when the last ball stops.
    Raises BadInput if the result has no attitude, no radius or more than three dimensions, with what to add.
    """
    dataset = dataset if "ball" in dataset.dims else dataset.expand_dims("ball")
    _check_drawable(dataset)
    so_far = reading.unfinished(dataset)
    part, notes = _chosen(dataset if so_far is None or balls is not None else reading.begun(dataset), balls)
    if so_far is not None:
        notes.append(f"the run is not finished: {so_far} can be shown")
    names, radius = reading.ball_names(part), reading.per_ball(part, "radius")
    for i, name in enumerate(names):
        if radius is None or not 0 < radius[i] < np.inf:
            raise BadInput(f"{name} has no radius, so it cannot be drawn: give ball.radius, in metres")
    assert radius is not None
    whole, most = part.sizes["frame"], min(max(FRAMES // len(names), LEAST), MOST)
    part = curves.finer(part, EVEN, most * len(names))
    between = (part.sizes["frame"] - 1) // max(whole - 1, 1)
    there = [name for name in ("attitude", "contact", *VECTORS) if name in part]  # perhaps as decimal strings
    arrays = {name: np.asarray(part[name].transpose("ball", "frame", ...).values).astype(np.float64) for name in there}
    reached = np.all([reading.reached(part), *(np.isfinite(array).all(axis=-1) for array in arrays.values())], axis=0)
    ends = np.where(reached.all(axis=1), part.sizes["frame"], reached.argmin(axis=1))
    if not ends.any():
        raise BadInput("the result has no frame that can be drawn: no attitude is a finite number")
    rolls = "contact" in part
    if not rolls:
        notes.append('the result has no contact point, so it turns on the spot: add "contact" to run.outputs')
        x = 1.5 * (np.cumsum(2 * radius) - radius - radius[0])  # side by side
        arrays["contact"] = np.broadcast_to(np.stack([x, 0 * x], axis=-1)[:, np.newaxis], (*reached.shape, 2))
    clock, label = reading.clock(part)
    asked, clock, unit = clock[-1], clock[: ends.max()], "s" if label == "time, s" else "steps"
    if clock[-1] < asked:
        who = "the ball" if len(names) == 1 else "the last ball"
        notes.append(f"it ends at {clock[-1]:.6g} of {asked:.6g} {unit}, where {who} stops")
    stride = -(-len(clock) // most)
    kept = np.union1d(np.arange(0, len(clock), stride), [*(ends[ends > 0] - 1), len(clock) - 1])
    if len(kept) < len(clock):
        notes.append(f"{len(kept)} of {len(clock)} frames are shown")
    found = []
    for i, end in enumerate(ends):
        if end:
            one = {name: array[i, :end] for name, array in arrays.items()}
            found.append(_rolling(part.isel(ball=[i], frame=slice(0, end)), one, float(radius[i]), kept, rolls))
            found[-1].notes.extend(_stopped(part, i, bool(end == part.sizes["frame"]) or so_far is not None))
        else:
            notes.append(f"{names[i]} has no frame that can be drawn")
    return Motion(clock[kept], unit, found, notes, between)


def _check_drawable(dataset: Dataset) -> None:
    if "row" in dataset.dims or dataset.sizes.get("axis", 3) != 3 or dataset.sizes.get("plane", 2) != 2:
        raise BadInput("a ball in more than three dimensions cannot be drawn as a rolling ball")
    if "attitude" not in dataset:
        more = "" if "contact" in dataset else ', and "contact" to see it roll'
        raise BadInput(f'the result has no attitude: add "attitude" to run.outputs{more}')


def _chosen(dataset: Dataset, balls: Sequence[str | int] | None) -> tuple[Dataset, list[str]]:
    """The result of the displayed balls, and a note on the others."""
    count = dataset.sizes["ball"]
    chosen = list(range(min(count, MOST_BALLS))) if balls is None else [reading.index_of(dataset, one) for one in balls]
    if not 1 <= len(set(chosen)) == len(chosen) <= MOST_BALLS:
        raise BadInput(f"choose from 1 to {MOST_BALLS} different balls, not {len(chosen)}")
    said = f"{'the first ' if balls is None else ''}{len(chosen)} of {count} balls are shown"
    return dataset.isel(ball=chosen), [said] if len(chosen) < count else []


def _rolling(one: Dataset, arrays: dict[str, Floats], radius: float, kept: np.ndarray, rolls: bool) -> Rolling:
    """One ball, of which the arrays are (frames, ...), at the kept frames."""
    attitude, contact = arrays["attitude"], arrays["contact"]
    attitude = attitude / np.sqrt((attitude**2).sum(axis=1, keepdims=True))
    omega = kernels.rotate(attitude, arrays["omega"]) if "omega" in arrays else None
    seconds = np.diff(reading.clock(one)[0]) if "time" in one.coords else None
    # A run to an accuracy has no common steps: each ball has its own, and they are many.
    steps = np.diff(one["step"].values) if "step" in one.coords else np.full(len(attitude) - 1, np.inf)
    rolled = np.hypot(*np.diff(contact, axis=0).T) / radius if rolls else None
    turns, known = turns_between(attitude, seconds, steps, omega, rolled)
    kept = kept[kept < len(attitude)]
    turn, shown = thinned_turns(attitude, turns, known, kept)
    J, axes = reading.per_ball(one, "mass_tensor"), reading.per_ball(one, "axes")
    return Rolling(
        reading.ball_names(one)[0], radius, attitude[kept], turn if shown else None, contact[kept],
        {name: arrays[name][kept] for name in VECTORS if name in arrays},
        J.sum() - J[0] if J is not None and np.isfinite(J).all() else None,  # (J2 + J3, J1 + J3, J1 + J2)
        None if axes is None else axes[0], [] if shown else [TOO_MANY if known.all() else TOO_FAR],
    )  # fmt: skip


def _stopped(dataset: Dataset, ball: int, whole: bool) -> list[str]:
    """Why a ball stopped, if it did; whole: whether it is shown up to the last frame."""
    status = int(dataset["status"][ball]) if "status" in dataset else 0
    if status == Status.TAKEN:
        return [] if whole else ["it stops where its numbers end"]
    after = f" after step {int(dataset['taken'][ball])}" if "taken" in dataset else ""
    known = status in Status._value2member_map_
    return [f"it stops{after}: {Status(status).sentence if known else f'status {status}'}"]


# Between two frames: the rotation from one attitude to the next, with its whole turns.


def least_turns(attitude: Floats) -> Floats:
    """Rotation vectors in space, (frames - 1, 3), of at most π, from each attitude (frames, 4) to the next."""
    p = kernels.compose(attitude[1:], attitude[:-1] * [1.0, -1.0, -1.0, -1.0])
    p = np.where(p[:, :1] < 0, -p, p)
    sine = _length(p[:, 1:])
    angle = 2 * np.arctan2(sine, p[:, 0])
    # sin(φ/2) and φ vanish together; the limit of φ/sin(φ/2) is 2.
    scale = np.divide(angle, sine, out=np.full_like(angle, 2.0), where=sine > 1e-12)
    return p[:, 1:] * scale[:, np.newaxis]


def nearest_turns(turns: Floats, expected: Floats) -> tuple[Floats, np.ndarray]:
    """The rotation vectors (n, 3) of the same rotations that are nearest to the expected ones, and whether they are
    near.

    A rotation vector may be longer by whole turns about its axis; near means within a quarter turn.
    """
    angle = _length(turns)
    # For an identity rotation any axis is possible for whole turns: take the expected one.
    still = angle < 1e-9
    axis = unit(np.where(still[:, np.newaxis], expected, turns))
    whole = np.round(((expected * axis).sum(axis=1) - angle) / (2 * np.pi))
    found = turns + 2 * np.pi * whole[:, np.newaxis] * axis
    return found, _length(found - expected) <= QUARTER


def turns_between(
    attitude: Floats, seconds: Floats | None, steps: np.ndarray, omega: Floats | None, rolled: Floats | None
) -> tuple[Floats, np.ndarray]:
    """The turns between the frames of one ball, (frames - 1, 3) in space, and which of them are known.

    attitude: (frames, 4).  seconds, steps: from frame to frame, (frames - 1,).  omega: in space, (frames, 3), or None.
    rolled: the path of the contact point from frame to frame in radii, or None.  One step of the map turns by less than
    half a turn.  Over several steps, the whole turns follow from ω.  Without ω a turn is known if the attitude and the
    path, a lower bound of the rotation, show at most a quarter turn.
    """
    turns = least_turns(attitude)
    if omega is not None and seconds is not None:
        whole, near = nearest_turns(turns, (omega[1:] + omega[:-1]) / 2 * seconds[:, np.newaxis])
        return np.where((steps > 1)[:, np.newaxis], whole, turns), near | (steps <= 1)
    known = _length(turns) <= QUARTER
    if rolled is not None:
        known &= rolled <= QUARTER
    return turns, known | (steps <= 1)


def thinned_turns(attitude: Floats, turns: Floats, known: np.ndarray, kept: np.ndarray) -> tuple[Floats, bool]:
    """The turns between the frames that are kept, (len(kept) - 1, 3), the last among them, and whether all are known.

    The sum of the turns between gives the whole turns.
    """
    if len(kept) < 2:
        return np.zeros((0, 3)), True
    found, near = nearest_turns(least_turns(attitude[kept]), np.add.reduceat(turns, kept[:-1], axis=0))
    return found, bool(near.all() and known.all())


def _length(vectors: Floats) -> Floats:
    return np.sqrt((vectors**2).sum(axis=1))
