"""A sweep as a grid: its balls along a dimension for each range, the draws along one more."""

from typing import TYPE_CHECKING, Any

import numpy as np

from ..members.members import Body, bodies
from ..read.errors import SceneError
from ..read.ranges import Range
from ..read.scene import from_source
from .dataset import with_clock

if TYPE_CHECKING:
    from xarray import Dataset

#: The dimension of the draws.
SAMPLE = "sample"


def grid(data: "Dataset") -> "Dataset":
    """The result of a whole sweep with dimensions of its own in the place of `ball`.

    Each range that spans a dimension, linspace or grid, is one, named by its key and with its values, such as
    "start.omega.1", in the order of the scene; `sample` is that of the draws, after them.  Of several [[ball]] with the
    same ranges `ball` stays, as the first, with their names.  The coordinate `name` is what each ball was called.
    Raises SceneError for a result that is not the whole of a scene's sweep, or whose balls have other ranges each.
    """
    import xarray

    tables = _tables(data)
    spans = _spans(tables[0])
    lengths = {"ball": len(tables)} if len(tables) > 1 else {}
    lengths |= {key: one.count for key, one in spans.items()}
    if any(one.drawn for body in tables for one in body.sweep().ranges.values()):
        lengths[SAMPLE] = tables[0].sweep().shape[-1]
    whole: dict[Any, Any] = {key: _spread(one, lengths) for key, one in data.variables.items()}
    whole["name"] = whole.pop("ball")
    if len(tables) > 1:
        whole["ball"] = ("ball", np.array([body.name for body in tables], dtype=object))
    whole |= {key: (key, one.grid(), data[key].attrs) for key, one in spans.items()}
    coords = {key: whole.pop(key) for key in list(whole) if key in data.coords or key == "name"}
    return with_clock(xarray.Dataset(whole, coords, data.attrs))


def _spread(one: Any, lengths: dict[str, int]) -> Any:
    """A variable with these dimensions in the place of `ball`, if it has that; the others are left as they are."""
    if "ball" not in one.dims:
        return one
    one = one.transpose("ball", ...)
    return (*lengths, *one.dims[1:]), one.data.reshape((*lengths.values(), *one.shape[1:])), one.attrs


def _tables(data: "Dataset") -> list[Body]:
    """The tables of balls of the scene of a result; raises SceneError where they do not make one grid."""
    if not data.attrs.get("scene"):
        raise SceneError("the result does not say of which scene it is, so that its ranges are not known")
    tables = bodies(from_source(data.attrs["scene"]))
    if data["ball"].values.tolist() != [name for body in tables for name in body.names]:
        raise SceneError("this is a part of the sweep: make a grid of the whole result, then choose of that")
    if any((_spans(body), body.sweep().shape) != (_spans(tables[0]), tables[0].sweep().shape) for body in tables):
        raise SceneError("the balls of the scene have different ranges, which make no grid")
    return tables


def _spans(body: Body) -> dict[str, Range]:
    """The ranges that span a dimension, by key."""
    return {key: one for key, one in body.sweep().ranges.items() if not one.drawn}
