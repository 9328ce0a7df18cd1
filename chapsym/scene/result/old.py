"""Files of one ball as `chapsym run` once wrote them: a .npz without the key "chapsym", a .csv without `# ` lines.

Their vectors count from 0, `momentum_0`, and they do not say where they come from.
"""

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ..read.outputs import OUTPUTS, labels

if TYPE_CHECKING:
    from xarray import Dataset


def joined(columns: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The columns of a table as vectors: `momentum_0`, `momentum_1`, `momentum_2` as `momentum`, (frames, 3)."""
    parts: dict[str, dict[int, np.ndarray]] = {}
    for column, values in columns.items():
        name, number = re.fullmatch(r"(.*?)(?:_(\d))?", column).groups()  # type: ignore[union-attr]
        parts.setdefault(name, {})[int(number or 0)] = values
    return {
        name: some[0] if len(some) == 1 else np.stack([some[i] for i in range(len(some))], axis=-1)
        for name, some in parts.items()
    }


def dataset(columns: Mapping[str, np.ndarray]) -> "Dataset":
    """The result of which these are the arrays; raises KeyError or ValueError if they are of none."""
    import xarray

    step = columns["step"]
    coords: dict[Any, Any] = {"ball": np.array(["1"], dtype=object), "step": ("frame", step, {"units": "1"})}
    if "time_s" in columns:
        coords["time"] = ("frame", columns["time_s"], {"units": "s"})
    variables: dict[Any, Any] = {}
    for key, values in columns.items():
        name = key.replace("contact_m", "contact")
        of = OUTPUTS.get(name.removesuffix("_low"))
        if of is not None:
            (dim,) = of.dims
            coords[dim] = np.array(labels(3)[dim], dtype=object)
            floats = values if values.dtype.kind in "OUS" else values.astype(np.float64)
            variables[name] = (("ball", "frame", dim), floats[np.newaxis], of.attrs(3, chosen=False))
    variables["taken"] = ("ball", step[-1:], {"units": "1", "long_name": "steps taken"})
    variables["status"] = ("ball", np.zeros(1, dtype=np.int64), {"long_name": "why the ball stopped (not known)"})
    return xarray.Dataset(variables, coords, {"title": "A ball, from a file that does not say where it comes from"})
