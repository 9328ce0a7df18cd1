"""The result of a run as plain arrays with names, dimensions and attributes: what a file without xarray is made of.

These are the names of xarray.Dataset that a run, its summary and its files use, so that each takes either; loading
xarray takes longer than most runs.
"""

from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from xarray import Dataset


@dataclass(frozen=True)
class Labelled:
    """An array, the names of its dimensions, and its attributes."""

    dims: tuple[str, ...]
    values: np.ndarray
    attrs: Mapping[str, Any] = field(default_factory=dict)

    @property
    def dtype(self) -> np.dtype[Any]:
        """The type of its numbers, or object for texts."""
        return self.values.dtype


class Arrays:
    """variables: by name, of which `coords` are those that label the others.  attrs: of the whole."""

    def __init__(self, variables: Mapping[str, Labelled], coords: Iterable[str], attrs: Mapping[str, Any]) -> None:
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
        """One ball, without the dimension of the balls, or some of them."""
        kept = {name: _of(one, ball) for name, one in self.variables.items()}
        return Arrays(kept, self.coords, self.attrs)

    def assign_attrs(self, attrs: Mapping[str, Any]) -> "Arrays":
        """The same with more attributes."""
        return Arrays(self.variables, self.coords, self.attrs | dict(attrs))

    def dataset(self) -> "Dataset":
        """The same as an xarray.Dataset."""
        import xarray

        whole = {name: (one.dims, one.values, dict(one.attrs)) for name, one in self.variables.items()}
        coords = {name: whole.pop(name) for name in list(whole) if name in self.coords}
        return xarray.Dataset(whole, coords, self.attrs)


def _of(one: Labelled, ball: int | slice) -> Labelled:
    if "ball" not in one.dims:
        return one
    where = one.dims.index("ball")
    values = one.values[(*[slice(None)] * where, ball)]
    dims = one.dims if isinstance(ball, slice) else (*one.dims[:where], *one.dims[where + 1 :])
    return Labelled(dims, np.asarray(values), one.attrs)
