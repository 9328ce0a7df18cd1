"""The angular velocity over time."""

import numpy as np
from xarray import Dataset

from chapsym.dynamics.ball import Floats

from ..drawing import components, reading
from ..drawing.style import Picture

ABSENT = 'no ω: add "omega" to run.outputs (and give run.time_step)'


def draw(dataset: Dataset) -> Picture:
    """The components of ω; in n dimensions those of the skew matrix above the diagonal."""
    array, names = reading.values(dataset, "omega"), [r"$\omega_1$", r"$\omega_2$", r"$\omega_3$"]
    if array.ndim == 4:
        array, names = upper(array, r"\omega")
    return components.draw(
        dataset, array, names, r"$\omega$", reading.readable(dataset["omega"].attrs.get("units", ""))
    )


def upper(array: Floats, symbol: str) -> tuple[Floats, list[str]]:
    """The entries above the diagonal of skew matrices (..., n, n), and their names."""
    rows, columns = np.triu_indices(array.shape[-1], 1)
    return array[..., rows, columns], [f"${symbol}_{{{i + 1}{j + 1}}}$" for i, j in zip(rows, columns, strict=True)]
