"""What the page shows of a result: attitudes, contact points and vectors of a few balls, at a few thousand frames."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from xarray import Dataset

from chapsym.dynamics import BadInput, Status, kernels
from chapsym.dynamics.ball import Floats

from ..drawing import curves, reading
from . import turning

#: So many balls are told apart by their colours.
MOST_BALLS = 20
#: Frames of all balls together, and the least and the most of one.
FRAMES, LEAST, MOST = 40_000, 2_000, 8_000
#: Radians of turning between frames, beyond which an even turn, and a straight way, would be seen as such.
EVEN = 0.4

VECTORS = ("omega", "momentum", "gamma")
TOO_FAR = (
    "frames are too far apart to show the turning between them: keep more frames (a smaller run.every), "
    'or add "omega" to run.outputs'
)
TOO_MANY = "it turns too often between the frames shown here, so its turning is shown at these frames only"


class ReportError(BadInput):
    """A result of which this picture cannot be made; the message says what to add."""


@dataclass(frozen=True, eq=False)
class Rolling:
    """One ball: its frames up to where it stopped, at the kept clock readings.

    attitude: unit quaternions, (frames, 4).  turn: rotation vectors in space from frame to frame, (frames - 1, 3);
    None if they are not known.  contact: m, (frames, 2).  vectors: by name, body axes, (frames, 3).
    inertia: the principal moments (3,), or None.  axes: the unit quaternion from principal to body axes, or None where
    they are the same.  notes: what the page must say of the ball.
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
    """All that the page shows.  clock: of the kept frames, in `unit` ("s" or "steps").

    between: how many there are from one frame of the result to the next: more than one if they are far apart.
    """

    clock: Floats
    unit: str
    balls: list[Rolling]
    notes: list[str]
    between: int = 1


def motion(dataset: Dataset, balls: Sequence[str | int] | None = None) -> Motion:
    """The motion of the chosen balls, by name or index, or of the first twenty; thinned to a few thousand frames.

    It ends where the last of them stops.
    Raises ReportError if the result has no attitude, no radius or more than three dimensions, with what to add.
    """
    dataset = dataset if "ball" in dataset.dims else dataset.expand_dims("ball")
    _check_drawable(dataset)
    so_far = reading.unfinished(dataset)
    dataset = dataset if so_far is None or balls is not None else reading.begun(dataset)
    chosen, notes = _chosen(dataset, balls)
    if so_far is not None:
        notes.append(f"the run is not finished: {so_far} can be shown")
    part = dataset.isel(ball=chosen)
    radius = _numbers(part, "radius") if "radius" in part else np.full(len(chosen), np.nan)
    names = _names(dataset)
    for i, length in zip(chosen, radius, strict=True):
        if not (np.isfinite(length) and length > 0):
            raise ReportError(f"{names[i]} has no radius, so it cannot be drawn: give ball.radius, in metres")
    whole = part.sizes["frame"]
    part = curves.finer(part, EVEN, _most(len(chosen)) * len(chosen))
    between = (part.sizes["frame"] - 1) // max(whole - 1, 1)
    timed = "time" in part.coords
    counted = part["step"].values if "step" in part.coords else np.arange(part.sizes["frame"])
    clock = np.asarray(part["time"].values if timed else counted, dtype=np.float64)
    attitude = _numbers(part, "attitude")
    rolls = "contact" in part
    contact = _numbers(part, "contact") if rolls else _side_by_side(radius, attitude.shape[1])
    if not rolls:
        notes.append('the result has no contact point, so it turns on the spot: add "contact" to run.outputs')
    vectors = [_numbers(part, name) for name in VECTORS if name in part]
    reached = reading.reached(part)
    ends = [_end(reached[i], attitude[i], contact[i], *(one[i] for one in vectors)) for i in range(len(chosen))]
    if not any(ends):
        raise ReportError("the result has no frame that can be drawn: no attitude is a finite number")
    asked, clock = clock[-1], clock[: max(ends)]
    if clock[-1] < asked:
        who, unit = "the ball" if len(chosen) == 1 else "the last ball", "s" if timed else "steps"
        notes.append(f"it ends at {clock[-1]:.6g} of {asked:.6g} {unit}, where {who} stops")
    kept = _kept(len(clock), len(chosen), [end for end in ends if end])
    if len(kept) < len(clock):
        notes.append(f"{len(kept)} of {len(clock)} frames are shown")
    found = []
    for i, (ball, end) in enumerate(zip(chosen, ends, strict=True)):
        if not end:
            notes.append(f"{names[ball]} has no frame that can be drawn")
            continue
        one = part.isel(ball=i, frame=slice(0, end))
        spot = contact[i, :end] if rolls else None
        rolling = _rolling(
            one, names[ball], attitude[i, :end], contact[i, :end], spot, float(radius[i]), kept[kept < end]
        )
        rolling.notes.extend(_stopped(one, end == part.sizes["frame"] or so_far is not None))
        found.append(rolling)
    return Motion(clock[kept], "s" if timed else "steps", found, notes, between)


def _check_drawable(dataset: Dataset) -> None:
    if "row" in dataset.dims or dataset.sizes.get("axis", 3) != 3 or dataset.sizes.get("plane", 2) != 2:
        raise ReportError("a ball in more than three dimensions cannot be drawn as a rolling ball")
    if "attitude" not in dataset:
        more = "" if "contact" in dataset else ', and "contact" to see it roll'
        raise ReportError(f'the result has no attitude: add "attitude" to run.outputs{more}')


def _chosen(dataset: Dataset, balls: Sequence[str | int] | None) -> tuple[list[int], list[str]]:
    """The indices of the balls to show, and what to say of the others."""
    names = _names(dataset)
    if balls is None:
        left = len(names) - MOST_BALLS
        said = [f"the first {MOST_BALLS} of {len(names)} balls are shown"] if left > 0 else []
        return list(range(min(len(names), MOST_BALLS))), said
    chosen = [_index(names, ball) for ball in balls]
    if not 1 <= len(set(chosen)) == len(chosen) <= MOST_BALLS:
        raise ReportError(f"choose from 1 to {MOST_BALLS} different balls, not {len(chosen)}")
    return chosen, [f"{len(chosen)} of {len(names)} balls are shown"] if len(chosen) < len(names) else []


def _index(names: list[str], ball: str | int) -> int:
    if isinstance(ball, str) and ball in names:
        return names.index(ball)
    if isinstance(ball, int | np.integer) and not isinstance(ball, bool) and 0 <= ball < len(names):
        return int(ball)
    listed = ", ".join(names[:5]) + (", ..." if len(names) > 5 else "")
    raise ReportError(f"the result has no ball {ball!r}; it has {len(names)}: {listed}")


def _names(dataset: Dataset) -> list[str]:
    if "ball" in dataset.coords:
        return [str(name) for name in np.atleast_1d(dataset["ball"].values)]
    return [f"ball {i + 1}" for i in range(dataset.sizes["ball"])]


def _numbers(dataset: Dataset, name: str) -> Floats:
    """A variable as float64 with the ball first and the frame second, of decimal strings too."""
    array = dataset[name]
    first = [dim for dim in ("ball", "frame") if dim in array.dims]
    return np.asarray(array.transpose(*first, ...).values).astype(np.float64)


def _side_by_side(radius: Floats, frames: int) -> Floats:
    """Places for balls that do not roll, (balls, frames, 2)."""
    x = 1.5 * (np.cumsum(2 * radius) - radius - radius[0])
    return np.broadcast_to(np.stack([x, 0 * x], axis=-1)[:, np.newaxis], (len(radius), frames, 2))


def _end(reached: np.ndarray, *arrays: Floats) -> int:
    """How many frames there are before the first that the ball did not reach, or that is not finite."""
    there = np.all([reached, *(np.isfinite(array).all(axis=1) for array in arrays)], axis=0)
    return len(there) if there.all() else int(np.argmin(there))


def _kept(frames: int, balls: int, ends: list[int]) -> np.ndarray:
    """The frames to show: every so many, the last, and those at which a ball stops."""
    stride = -(-frames // _most(balls))
    return np.union1d(np.arange(0, frames, stride), [*(end - 1 for end in ends), frames - 1])


def _most(balls: int) -> int:
    """How many frames each of so many balls may have."""
    return min(max(FRAMES // balls, LEAST), MOST)


def _rolling(
    one: Dataset, name: str, attitude: Floats, contact: Floats, spot: Floats | None, radius: float, kept: np.ndarray
) -> Rolling:
    """One ball at the kept frames."""
    attitude = attitude / np.sqrt((attitude**2).sum(axis=1, keepdims=True))
    vectors = {key: _numbers(one, key) for key in VECTORS if key in one}
    omega = kernels.rotate(attitude, vectors["omega"]) if "omega" in vectors else None
    seconds = np.diff(np.asarray(one["time"].values, dtype=np.float64)) if "time" in one.coords else None
    # A run to an accuracy has no steps: they were chosen for each ball, and are many.
    steps = np.diff(one["step"].values) if "step" in one.coords else np.full(len(attitude) - 1, np.inf)
    rolled = None if spot is None else np.hypot(*np.diff(spot, axis=0).T) / radius
    turns, known = turning.between(attitude, seconds, steps, omega, rolled)
    turn, shown = turning.thinned(attitude, turns, known, kept)
    notes = [] if shown else [TOO_FAR if not known.all() else TOO_MANY]
    return Rolling(
        name, radius, attitude[kept], turn if shown else None, contact[kept],
        {key: vector[kept] for key, vector in vectors.items()}, _inertia(one),
        _numbers(one, "axes") if "axes" in one else None, notes,
    )  # fmt: skip


def _stopped(one: Dataset, whole: bool) -> list[str]:
    """Why the ball stopped, if it did."""
    status = int(one["status"]) if "status" in one else 0
    if status == Status.TAKEN:
        return [] if whole else ["it stops where its numbers end"]
    after = f" after step {int(one['taken'])}" if "taken" in one else ""
    known = status in Status._value2member_map_
    return [f"it stops{after}: {Status(status).sentence if known else f'status {status}'}"]


def _inertia(one: Dataset) -> Floats | None:
    """(J2 + J3, J1 + J3, J1 + J2), the principal moments."""
    if "mass_tensor" not in one:
        return None
    J: Any = _numbers(one, "mass_tensor")
    return J.sum() - J if np.isfinite(J).all() else None
