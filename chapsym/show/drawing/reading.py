"""Readings of a result for figures: checked arrays, (balls, frames, ...), the clock, and names for its labels."""

import re
from typing import TYPE_CHECKING, Any

import numpy as np

from chapsym.dynamics import BadInput, Status
from chapsym.dynamics.ball import Floats, brief, is_whole, plain_text
from chapsym.dynamics.labelled import NOT_RUN
from chapsym.scene.result.interpolation import per_ball as per_ball

if TYPE_CHECKING:
    from xarray import Dataset

#: The letters of a name in a figure.
LETTERS = 36
#: Digits and signs as exponents.
RAISED = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")


def with_balls(dataset: "Dataset", ball: str | int | None = None) -> "Dataset":
    """The result with its dimension `ball` (restored if it was dropped), or a single ball of it.

    ball: a name, or an index.  Raises BadInput for an unknown ball, and for a result without frames.
    """
    if not dataset.sizes.get("frame") and "rotation_number" not in dataset:
        raise BadInput('this is no result of chapsym: it has no dimension "frame", or no frames')
    if "ball" not in dataset.dims:
        dataset = dataset.expand_dims("ball")
    return dataset if ball is None else dataset.isel(ball=[index_of(dataset, ball)])


def index_of(dataset: "Dataset", ball: str | int) -> int:
    """The index of a ball, from its name or an index (from the end if negative); raises BadInput if there is none."""
    names = ball_names(dataset)
    if (text := plain_text(ball)) in names:
        return names.index(text)
    if is_whole(ball) and -len(names) <= int(ball) < len(names):
        return int(ball) % len(names)
    listed = ", ".join(names[:5]) + (f", ... ({len(names)} in all)" if len(names) > 5 else "")
    raise BadInput(f"the result has no ball {brief(ball)}; its balls: {listed}")


def begun(dataset: "Dataset") -> "Dataset":
    """The result without the balls that have not started; raises BadInput if none has."""
    there = last_frames(dataset) >= 0
    if not there.any():
        raise BadInput("no ball of this result has run yet: resume the run first")
    return dataset if there.all() else dataset.isel(ball=there)


def unfinished(dataset: "Dataset") -> str | None:
    """The finished part of an interrupted run, such as "40 % of the run"; None for a finished run."""
    if dataset.attrs.get("complete", True) or "frame" not in dataset.dims:
        return None
    there, ended = reached(dataset), stopped(dataset)
    ended = ended | there.all(axis=1)
    share = int(100 * np.where(ended[:, np.newaxis], True, there).mean())
    balls = f", {ended.sum()} of {len(ended)} balls to their ends" if len(ended) > 1 else ""
    return None if ended.all() else f"{share} % of the run{balls}"


def title(dataset: "Dataset") -> str:
    """The title of the scene, or nothing."""
    return str(dataset.attrs.get("title") or "")


def literal(text: str) -> str:
    """Text that a figure shows as written: its dollars enclose no mathematics."""
    return text.replace("$", r"\$")


def labels(dataset: "Dataset") -> list[str]:
    """The names of the balls for a figure, which is as wide as `LETTERS` of the widest letters."""
    return [literal(name if len(name) <= LETTERS else f"{name[: LETTERS - 1]}…") for name in ball_names(dataset)]


def ball_names(dataset: "Dataset") -> list[str]:
    """The names of the balls, or their indices."""
    if "ball" in dataset.coords:
        return [str(name) for name in np.atleast_1d(dataset["ball"].values)]
    return [str(i) for i in range(dataset.sizes.get("ball", 1))]


def steps(dataset: "Dataset") -> np.ndarray:
    """The step number of each frame, (frames,)."""
    if "step" in dataset.coords:
        return np.asarray(dataset["step"].values)
    return np.arange(dataset.sizes["frame"])


def clock(dataset: "Dataset") -> tuple[Floats, str]:
    """The time of each frame in seconds, or its step number, (frames,), and the label of that axis."""
    if "time" in dataset.coords:
        return np.asarray(dataset["time"].values, dtype=np.float64), "time, s"
    return steps(dataset).astype(np.float64), "step"


def span(t: Floats, label: str) -> str:
    """The duration of readings of the clock: "12 s", "40 steps"."""
    return f"{t[-1] - t[0]:.3g} {'s' if label == 'time, s' else 'steps'}"


def of_span(dataset: "Dataset", part: int) -> str:
    """The note on a line through only the first frames; empty if there are no others."""
    t, label = clock(dataset)
    return f"line: the first {span(t[:part], label)} of {span(t, label)}" if part < len(t) else ""


def reached(dataset: "Dataset") -> np.ndarray:
    """Which frames each ball reached, (balls, frames); none for a ball that has not started."""
    shape = dataset.sizes["ball"], dataset.sizes["frame"]
    if "taken" not in dataset:
        return np.ones(shape, dtype=bool)
    taken = np.atleast_1d(dataset["taken"].values)[:, np.newaxis]
    if "step" not in dataset.coords:  # each ball has its own steps: it reached the end, or was not run
        return np.broadcast_to(taken >= 0, shape)
    return np.asarray(steps(dataset) <= taken)


def values(dataset: "Dataset", name: str) -> Floats:
    """A variable as float64, (balls, frames, ...), NaN in the frames that a ball did not reach.

    Decimal strings are rounded to float64.  Raises BadInput if a frame that was reached is not finite.
    """
    array = dataset[name].transpose("ball", "frame", ...).values
    with np.errstate(over="ignore"):
        array = array.astype(np.float64)
    there = reached(dataset)
    bad = there & ~np.isfinite(array).reshape(*there.shape, -1).all(axis=-1)
    if bad.any():
        ball, frame = map(int, np.argwhere(bad)[0])
        clause = f"is not finite at step {int(steps(dataset)[frame])}, which it reached: the result is damaged"
        raise BadInput(f"{name} of the ball {ball_names(dataset)[ball]!r} {clause}")
    if not there.all():
        array[~there] = np.nan
    return array


def size_of(array: np.ndarray) -> float:
    """The largest absolute value of the numbers in an array, without NaN; 0 if there are none."""
    return float(np.nanmax(np.abs(array), initial=0.0))


def stopped(dataset: "Dataset") -> np.ndarray:
    """Which balls stopped early, (balls,)."""
    if "status" not in dataset:
        return np.zeros(dataset.sizes["ball"], dtype=bool)
    return ~np.isin(np.atleast_1d(dataset["status"].values), (int(Status.TAKEN), NOT_RUN))


def last_frames(dataset: "Dataset") -> np.ndarray:
    """The last frame that each ball reached, (balls,); -1 for a ball that has not started."""
    return reached(dataset).sum(axis=1) - 1


def parameters(dataset: "Dataset") -> dict[str, tuple[Floats, str]]:
    """The parameters that a sweep varied: dotted name: values (balls,), unit; only numbers that differ."""
    found = {}
    for name, coord in dataset.coords.items():
        if name != "ball" and coord.dims == ("ball",) and coord.dtype.kind in "iuf" and len(np.unique(coord)) > 1:
            found[str(name)] = np.asarray(coord.values, dtype=np.float64), str(coord.attrs.get("units", ""))
    return found


def first_parameter(dataset: "Dataset") -> tuple[str, Floats, str]:
    """The name, values (balls,) and unit of the first swept parameter; without one, the number of each ball."""
    for name, (data, units) in parameters(dataset).items():
        return name, data, units
    return "ball", np.arange(dataset.sizes["ball"], dtype=np.float64), ""


def labelled(name: str, units: Any) -> str:
    """A name with its unit, as the label of an axis."""
    shown = readable(str(units or ""))
    return f"{name}, {shown}" if shown else name


def readable(units: str) -> str:
    """ "kg m2 s-1" as kg m² s⁻¹; a pure number has no unit."""
    if units.strip() in ("1", "dimensionless"):
        return ""
    return re.sub(r"-?\d+", lambda found: found[0].translate(RAISED), units)
