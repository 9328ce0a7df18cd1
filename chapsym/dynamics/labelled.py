"""Labelled arrays, and their table for files and pandas: names, units, columns.

The classes have the attributes of xarray.Dataset, so that runs, summaries and files accept both: loading xarray takes
longer than most runs.
"""

import json
from collections.abc import Hashable, Iterable, Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import product
from typing import TYPE_CHECKING, Any, TypedDict

import numpy as np

from chapsym.extras import need

from .ball import flag
from .errors import Status
from .outputs import BOUND, LOW, OUTPUTS, labels, whose

if TYPE_CHECKING:
    from pandas import DataFrame
    from xarray import Dataset

    from .ball import Ball
    from .n.ball_n import BallN

#: The attributes of a variable or of the whole: texts and numbers, and lists of them.
Attributes = Mapping[str, Any]
#: `taken` and `status` of balls that have not started.
NOT_RUN = -1
FRAMES = ("momentum", "gamma", "attitude", "contact")
#: The attributes of the times of frames.
TIME = {"units": "s", "long_name": "time"}
#: The column with the data that are in no row, as JSON.
NOTES = "chapsym"
#: Rows of one batch, which bound its memory.
ROWS = 2**17


@dataclass(frozen=True)
class Labelled:
    """An array, the names of its dimensions, and its attributes."""

    dims: tuple[str, ...]
    values: np.ndarray
    attrs: Attributes = field(default_factory=dict)

    @property
    def dtype(self) -> np.dtype:
        """The type of its numbers, or object for strings."""
        return self.values.dtype


class Arrays:
    """variables: by name; `coords` are those that label the others.  attrs: of the whole."""

    def __init__(self, variables: Mapping[str, Labelled], coords: Iterable[str], attrs: Attributes) -> None:
        self.variables, self.coords, self.attrs = dict(variables), tuple(coords), dict(attrs)
        pairs = (zip(one.dims, one.values.shape, strict=True) for one in self.variables.values())
        self.sizes = {dim: length for some in pairs for dim, length in some}

    @property
    def dims(self) -> tuple[str, ...]:
        """The names of all dimensions, in the order in which the variables have them."""
        return tuple(self.sizes)

    def __getitem__(self, name: str) -> Labelled:
        return self.variables[name]

    def __contains__(self, name: Hashable) -> bool:
        return name in self.variables

    def __iter__(self) -> Iterator[str]:
        return (name for name in self.variables if name not in self.coords)

    def isel(self, ball: int | slice) -> "Arrays":
        """One ball, without the dimension of the balls, or several balls."""
        kept = {name: _of(one, ball) for name, one in self.variables.items()}
        return Arrays(kept, self.coords, self.attrs)

    def assign_attrs(self, attrs: Attributes) -> "Arrays":
        """The same with more attributes."""
        return Arrays(self.variables, self.coords, self.attrs | dict(attrs))

    def dataset(self) -> "Dataset":
        """The same as an xarray.Dataset, indexed by time."""
        need("scenes", "xarray")
        import xarray

        whole = {name: (one.dims, one.values, dict(one.attrs)) for name, one in self.variables.items()}
        coords = {name: whole.pop(name) for name in list(whole) if name in self.coords}
        return with_clock(xarray.Dataset(whole, coords, self.attrs))


def _of(one: Labelled, ball: int | slice) -> Labelled:
    if "ball" not in one.dims:
        return one
    where = one.dims.index("ball")
    values = one.values[(*[slice(None)] * where, ball)]
    dims = one.dims if isinstance(ball, slice) else (*one.dims[:where], *one.dims[where + 1 :])
    return Labelled(dims, np.asarray(values), one.attrs)


def with_clock(data: "Dataset") -> "Dataset":
    """A result whose frames are indexed by their `time`, or by their `step` if there are no times.

    `data.sel(time=5.0, method="nearest")` is the frame nearest to 5 s, `data.sel(time=slice(1, 2))` are the frames
    between.
    """
    name = next((name for name in ("time", "step") if name in data.coords and data[name].dims == ("frame",)), None)
    return data if name is None or name in data.xindexes else data.set_xindex(name)


def about(long_name: str, units: str = "1") -> dict[str, str]:
    """The attributes of a variable."""
    return {"units": units, "long_name": long_name}


def texts(names: Iterable[str], dim: str) -> Labelled:
    """The labels along a dimension."""
    return Labelled((dim,), np.array(list(names), dtype=object))


OUTCOME: dict[str, Attributes] = {
    "taken": about("steps taken"),
    "status": {
        "long_name": "why the ball stopped",
        "flag_values": [NOT_RUN, *map(int, Status)],
        "flag_meanings": " ".join(["not_run", *(status.name.lower() for status in Status)]),
    },
}


def bodies(ball: "Ball | BallN", axes: np.ndarray | None, shape: tuple[int, ...]) -> dict[str, Labelled]:
    """The parameters of balls, and the rotations from their principal axes to the axes of the user.

    shape: the leading axes of the batch, to which they broadcast; here the balls are along one axis.
    """
    tensor = about("principal mass tensor J, principal axes", "kg m2")
    given = {
        "mass_tensor": (ball.mass_tensor, "axis", tensor),
        "D": (ball.D, None, about("D = m ρ²", "kg m2")),
        "radius": (ball.radius, None, about("radius ρ", "m")),
        "axes": (axes, "quaternion", about("principal axes to body axes, unit quaternion")),
    }
    found = {}
    for name, (values, inner, attrs) in given.items():
        if values is not None:
            last = np.shape(values)[-1:] if inner else ()
            flat = np.broadcast_to(values, (*shape, *last)).reshape(-1, *last)
            found[name] = Labelled(("ball", inner) if inner else ("ball",), flat, attrs)
    return found


def moments(step: np.ndarray, time_step: float | None) -> dict[str, Labelled]:
    """`step` and, if known, `time` of each frame."""
    found = {"step": Labelled(("frame",), step, about("step of the map"))}
    return found if time_step is None else found | {"time": Labelled(("frame",), step * time_step, TIME)}


def coordinates(names: Iterable[str], variables: Mapping[str, Labelled], n: int) -> dict[str, Labelled]:
    """The names of the balls, and the labels of the components of the variables."""
    used = {dim for one in variables.values() for dim in one.dims}
    return {"ball": texts(names, "ball")} | {dim: texts(of, dim) for dim, of in labels(n).items() if dim in used}


def of_run(run: Any) -> Arrays:
    """A `Trajectory` as the result of a scene with the same outputs; if it has times, also with ω and the energy."""
    n, shape, count = run.gamma.shape[-1], run.status.shape, run.status.size
    motion = run.order == 0 and run.time_step is not None
    columns = {name: getattr(run, name) for name in FRAMES}
    for end, more in ((LOW, run.low), (BOUND, run.proved)):
        columns |= {f"{name}{end}": getattr(more, name, None) for name in FRAMES}
    if run.time_step is not None:
        K = run.angular_momentum()
        columns |= run.derived() | {"angular_momentum": K}
        if motion:
            columns |= {"momentum": K, f"momentum{BOUND}": _of_quotient(columns[f"momentum{BOUND}"], K, run.time_step)}
    variables: dict[str, Labelled] = {}
    for name in (f"{one}{end}" for one in OUTPUTS for end in ("", LOW, BOUND)):
        if (values := columns.get(name)) is not None:
            one = OUTPUTS[whose(name)]
            inner = values.reshape(count, len(run.index), *values.shape[len(shape) + 1 :])
            inner = inner.astype(np.float64) if inner.dtype == np.float32 else inner
            # In three dimensions, too, those of a `BallN` are matrices.
            dims = () if name.endswith(BOUND) else one.dims_in(n if inner.ndim == 2 + len(one.dims) else 0)
            variables[name] = Labelled(("ball", "frame", *dims), inner, one.attrs(n, motion, name))
    variables |= {name: Labelled(("ball",), getattr(run, name).reshape(count), of) for name, of in OUTCOME.items()}
    if run.error is not None:
        found = about("estimate of the error, by comparison")
        variables["error"] = Labelled(("ball",), np.reshape(run.error, count), found)
    variables |= bodies(run.ball, getattr(run.ball, "axes", None), shape)
    names = [f"ball {i + 1}" for i in range(count)] if shape else ["ball"]
    coords = coordinates(names, variables, n) | moments(run.index, run.time_step)
    about_it = {"title": f"{'Chaplygin' if motion else 'Discrete Chaplygin'} ball: {count} ball{'s' * (count != 1)}"}
    return Arrays(variables | coords, coords, about_it | {"model": "motion of the ball" if motion else "the map"})


def _of_quotient(bound: np.ndarray | None, K: np.ndarray, epsilon: float) -> np.ndarray | None:
    """A bound for the rounded K = 𝒦/ε, from the bound for 𝒦."""
    if bound is None:
        return None
    return np.nextafter(bound / epsilon, np.inf) + 2.0**-52 * np.abs(K).sum(axis=-1)


# The table: a row for each ball and frame.


class Column(TypedDict):
    """A variable: its dimensions, its columns, whether it labels others, its type of Arrow, and its attributes."""

    dims: list[str]
    columns: list[str]
    coordinate: bool
    type: str
    attrs: dict[str, Any]


class Structure(TypedDict):
    """The data that the rows lack: how many balls and frames, the labels of components, and the variables."""

    balls: int
    frames: int
    labels: dict[str, list[str]]
    variables: dict[str, Column]


def plain(attrs: Mapping[str, Any] | dict[Any, Any]) -> dict[str, Any]:
    """Attributes as plain JSON values."""
    arrays = (np.ndarray, np.generic)
    return {str(key): value.tolist() if isinstance(value, arrays) else value for key, value in attrs.items()}


def structure(data: "Dataset | Arrays") -> Structure:
    """The plain data that are in no row: labels of components; the columns and attributes of each variable."""
    dims = [str(dim) for dim in data.dims if dim not in ("ball", "frame") and dim in data]
    labels = {dim: data[dim].values.tolist() for dim in dims}
    variables: dict[str, Column] = {
        str(name): {
            "dims": list(map(str, one.dims)),
            "columns": [f"{name}{suffix}" for suffix in _suffixes(map(str, one.dims), labels)],
            "coordinate": name in data.coords,
            "type": {"f": "double", "i": "int64"}.get(one.dtype.kind, "string"),
            "attrs": plain(one.attrs),
        }
        for name, one in data.variables.items()
        if name not in labels
    }
    return {
        "balls": data.sizes["ball"], "frames": data.sizes["frame"], "labels": labels, "variables": _ordered(variables),
    }  # fmt: skip


def batches(data: "Dataset | Arrays", variables: Mapping[str, Column]) -> Iterator[dict[str, np.ndarray]]:
    """The columns, each (rows,), batch by batch of balls; a value per ball is in each row of the ball."""
    frames = data.sizes["frame"]
    several = max(1, ROWS // frames)
    for first in range(0, max(1, data.sizes["ball"]), several):
        part = data.isel(ball=slice(first, first + several))
        balls = part.sizes["ball"]
        columns: dict[str, np.ndarray] = {}
        for name, one in variables.items():
            values = part[name].values
            if "frame" not in one["dims"]:
                values = np.broadcast_to(values[:, np.newaxis], (balls, frames, *values.shape[1:]))
            elif "ball" not in one["dims"]:
                values = np.broadcast_to(values, (balls, frames))
            flat = values.reshape(balls * frames, len(one["columns"]))
            columns |= {column: flat[:, i] for i, column in enumerate(one["columns"])}
        yield columns


def is_ours(head: str) -> bool:
    """Whether chapsym, in this or an older version, wrote a table of text with this first line."""
    names = set(head.rstrip().replace('"', "").split(","))
    if NOTES in names or {"step", "momentum_0"} <= names:
        return True
    key, _, value = head.removeprefix("# ").partition(": ")
    with suppress(ValueError, RecursionError):
        return head.startswith("# ") and key.isidentifier() and json.loads(value) is not None
    return False


def in_rows(one: Column) -> bool:
    """Whether a variable of `structure` is in each row: it has a value per frame, or is a coordinate."""
    return "frame" in one["dims"] or one["coordinate"]


def frame(data: "Dataset | Arrays", balls: bool = False) -> "DataFrame":
    """The table in pandas: a row for each ball and frame, or for each ball with its values per ball.

    The columns are those of files; `attrs["units"]` has their units.
    """
    need("scenes", "pandas")
    import pandas

    balls = flag(balls, "balls")
    variables = structure(data)["variables"].items()
    kept = {name: one for name, one in variables if ("frame" not in one["dims"] if balls else in_rows(one))}
    parts, step = [*batches(data, kept)], data.sizes["frame"] if balls else 1
    found = pandas.DataFrame({name: np.concatenate([part[name] for part in parts])[::step] for name in parts[0]})
    units = {column: one["attrs"].get("units") for one in kept.values() for column in one["columns"]}
    found.attrs["units"] = {column: unit for column, unit in units.items() if unit is not None}
    return found


def _suffixes(dims: Iterable[str], labels: Mapping[str, list[str]]) -> list[str]:
    """The suffixes of the columns: _1, _2, ... for a vector; _1_1, _1_2, ... for a matrix; none for a number."""
    inner = [labels[dim] for dim in dims if dim in labels]
    return ["".join(f"_{label}" for label in chosen) for chosen in product(*inner)]


def _ordered(variables: dict[str, Column]) -> dict[str, Column]:
    """Ball, step and time first, then the other coordinates, then the rest; values per frame before values per ball."""

    def rank(name: str) -> tuple[int, bool]:
        leading = {"ball": 0, "step": 1, "time": 2}
        return leading.get(name, 3 if variables[name]["coordinate"] else 4), "frame" not in variables[name]["dims"]

    return {name: variables[name] for name in sorted(variables, key=rank)}
