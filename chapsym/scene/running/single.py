"""The .npz and .csv of one ball (`files.save`), read as a result; they do not say where they come from."""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from ..plan.outputs import OUTPUTS

if TYPE_CHECKING:
    from xarray import Dataset

_COMPONENTS: dict[str, tuple[str, list[str]]] = {
    "momentum": ("axis", ["1", "2", "3"]),
    "gamma": ("axis", ["1", "2", "3"]),
    "attitude": ("quaternion", list("wxyz")),
    "contact": ("plane", ["x", "y"]),
}


def read_npz(path: Path) -> "Dataset":
    """The result in a .npz; raises KeyError or ValueError if it holds none."""
    with np.load(path, allow_pickle=False) as data:
        return _dataset({name: data[name] for name in data.files})


def read_csv(path: Path) -> "Dataset":
    """The result in a .csv without `# ` lines."""
    from pyarrow import csv

    table = csv.read_csv(path)
    parts: dict[str, list[np.ndarray]] = {}
    for column in table.column_names:
        parts.setdefault(re.sub(r"_\d$", "", column), []).append(table[column].to_numpy())
    return _dataset({name: np.stack(some, axis=-1) if len(some) > 1 else some[0] for name, some in parts.items()})


def _dataset(columns: Mapping[str, np.ndarray]) -> "Dataset":
    import xarray

    step = columns["step"]
    coords: dict[Any, Any] = {"ball": np.array(["1"], dtype=object), "step": ("frame", step, {"units": "1"})}
    if "time_s" in columns:
        coords["time"] = ("frame", columns["time_s"], {"units": "s"})
    variables: dict[Any, Any] = {}
    for key, values in columns.items():
        name = key.replace("contact_m", "contact")
        of = name.removesuffix("_low")
        if of in _COMPONENTS:
            dim, labels = _COMPONENTS[of]
            coords[dim] = np.array(labels, dtype=object)
            about = {"units": OUTPUTS[of].units, "long_name": OUTPUTS[of].long_name}
            floats = values if values.dtype.kind in "OUS" else values.astype(np.float64)
            variables[name] = (("ball", "frame", dim), floats[np.newaxis], about)
    variables["taken"] = ("ball", step[-1:], {"units": "1", "long_name": "steps taken"})
    variables["status"] = ("ball", np.zeros(1, dtype=np.int64), {"long_name": "why the ball stopped (not known)"})
    return xarray.Dataset(variables, coords, {"title": "A ball, from a file that does not say where it comes from"})
