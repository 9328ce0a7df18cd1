"""A Dataset as one table, a row for each ball and frame, or as plain arrays, and back: for CSV, Parquet and NumPy."""

from collections.abc import Iterator, Mapping
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from xarray import Dataset

    from .arrays import Arrays

#: Rows of one batch, whose memory is bounded.
ROWS = 2**17


def structure(data: "Dataset | Arrays") -> dict[str, Any]:
    """What the rows do not tell, as plain data: labels of components; the columns and attributes of each variable."""
    dims = [str(dim) for dim in data.dims if dim not in ("ball", "frame") and dim in data]
    labels = {dim: data[dim].values.tolist() for dim in dims}
    variables = {
        str(name): {
            "dims": list(one.dims),
            "columns": [f"{name}{suffix}" for suffix in _suffixes(one.dims, labels)],
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


def batches(data: "Dataset | Arrays", told: Mapping[str, Any]) -> Iterator[dict[str, np.ndarray]]:
    """The columns of some balls after the others, each (rows,); what a ball has once stands in each of its rows."""
    frames = data.sizes["frame"]
    several = max(1, ROWS // frames)
    for first in range(0, data.sizes["ball"], several):
        part = data.isel(ball=slice(first, first + several))
        balls = part.sizes["ball"]
        columns: dict[str, np.ndarray] = {}
        for name, one in told["variables"].items():
            values = part[name].values
            if "frame" not in one["dims"]:
                values = np.broadcast_to(values[:, np.newaxis], (balls, frames, *values.shape[1:]))
            elif "ball" not in one["dims"]:
                values = np.broadcast_to(values, (balls, frames))
            flat = values.reshape(balls * frames, -1)
            columns |= {column: flat[:, i] for i, column in enumerate(one["columns"])}
        yield columns


def assembled(columns: Mapping[str, np.ndarray], told: Mapping[str, Any], attrs: Mapping[str, Any]) -> "Dataset":
    """The Dataset of a table; raises KeyError, ValueError or TypeError if the table is not whole."""
    arrays = {}
    for name, one in told["variables"].items():
        inner = [len(told["labels"][dim]) for dim in one["dims"] if dim in told["labels"]]
        values = np.stack([columns[column] for column in one["columns"]], axis=-1)
        values = values.reshape(told["balls"], told["frames"], *inner)
        arrays[name] = values[:, 0] if "frame" not in one["dims"] else values if "ball" in one["dims"] else values[0]
    return dataset(arrays, told, attrs)


def arrays_of(data: "Dataset | Arrays", told: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """The arrays of all variables; of one ball without the axis of the balls."""
    whole = data.isel(ball=0) if told["balls"] == 1 else data
    found = {name: whole[name].values for name in told["variables"]}
    return {name: np.array(a.tolist(), dtype=str) if a.dtype.kind in "OT" else a for name, a in found.items()}


def from_arrays(arrays: Mapping[str, np.ndarray], told: Mapping[str, Any], attrs: Mapping[str, Any]) -> "Dataset":
    """The Dataset of `arrays_of`; raises KeyError, ValueError or TypeError if one is missing."""
    found = {}
    for name, one in told["variables"].items():
        values = arrays[name].astype(object) if arrays[name].dtype.kind == "U" else arrays[name]
        found[name] = np.expand_dims(values, 0) if told["balls"] == 1 and "ball" in one["dims"] else values
    return dataset(found, told, attrs)


def dataset(arrays: Mapping[str, np.ndarray], told: Mapping[str, Any], attrs: Mapping[str, Any]) -> "Dataset":
    """The Dataset of these arrays and what `structure` tells."""
    import xarray

    coords: dict[Any, Any] = {dim: np.array(names, dtype=object) for dim, names in told["labels"].items()}
    variables: dict[Any, Any] = {}
    for name, one in told["variables"].items():
        (coords if one["coordinate"] else variables)[name] = (one["dims"], arrays[name], one["attrs"])
    return xarray.Dataset(variables, coords, dict(attrs))


def plain(attrs: Mapping[Any, Any]) -> dict[str, Any]:
    """Attributes as JSON has them."""
    arrays = (np.ndarray, np.generic)
    return {str(key): value.tolist() if isinstance(value, arrays) else value for key, value in attrs.items()}


def _suffixes(dims: tuple[Any, ...], labels: Mapping[str, list[str]]) -> list[str]:
    """The ends of the columns' names: _1, _2, ... of a vector; _1_1, _1_2, ... of a matrix; of a number none."""
    inner = [labels[dim] for dim in dims if dim in labels]
    return ["".join(f"_{label}" for label in chosen) for chosen in product(*inner)]


def _ordered(variables: dict[str, Any]) -> dict[str, Any]:
    """Ball and frame first, then what has a value in every frame, then what a ball has once."""

    def rank(name: str) -> tuple[int, bool]:
        leading = {"ball": 0, "step": 1, "time": 2}
        return leading.get(name, 3 if variables[name]["coordinate"] else 4), "frame" not in variables[name]["dims"]

    return {name: variables[name] for name in sorted(variables, key=rank)}
