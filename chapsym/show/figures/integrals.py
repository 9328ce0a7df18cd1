"""The momentum integrals over time, as their relative changes."""

import re

import numpy as np
from xarray import Dataset

from chapsym.dynamics.ball import Floats

from ..drawing import reading
from ..drawing.style import Picture, legend, new
from . import change

#: The outputs of one integral each, with the names that they have in "integrals", which holds all of them.
OF_ONE = {"vertical_momentum": "K.gamma", "momentum_squared": "K.K", "gamma_squared": "gamma.gamma"}
SYMBOLS = {
    "K.gamma": r"$\langle\mathcal{K},\gamma\rangle$",
    "K.K": r"$\langle\mathcal{K},\mathcal{K}\rangle$",
    "gamma.gamma": r"$\langle\gamma,\gamma\rangle$",
}


def missing(dataset: Dataset) -> str | None:
    """Why this figure cannot be drawn, in a sentence; None if it can."""
    if "integrals" in dataset or any(name in dataset for name in OF_ONE):
        return None
    wanted = '"vertical_momentum" and "momentum_squared"' if dataset.sizes.get("axis", 3) == 3 else '"integrals"'
    return f"no integrals: add {wanted} to run.outputs"


def stored(dataset: Dataset) -> tuple[Floats, list[str]]:
    """The integrals of a result that has some, (balls, frames, integrals), and their names."""
    if "integrals" not in dataset:
        some = [name for name in OF_ONE if name in dataset]
        return np.stack([reading.values(dataset, name) for name in some], axis=-1), [OF_ONE[name] for name in some]
    found = reading.values(dataset, "integrals")
    names = dataset["integral"].values if "integral" in dataset.coords else range(1, found.shape[-1] + 1)
    return found, [str(name) for name in names]


def draw(dataset: Dataset) -> Picture:
    """The map keeps the momentum integrals, so all that is seen is roundoff."""
    found, names = stored(dataset)
    figure, (axis,) = new(str(dataset.attrs.get("title", "")), height=3.6)
    changes = {
        _symbol(name): change.relative(found[..., i], size)
        for i, (name, size) in enumerate(zip(names, sizes(found[:, 0], names), strict=True))
    }
    change.plot(axis, dataset, changes)
    axis.set_title("momentum integrals, and the largest change of each")
    legend(figure, [axis])
    return figure


def _symbol(name: str) -> str:
    """A name of the result as mathematics: "tr K^2" is tr 𝒦²."""
    if name in SYMBOLS:
        return SYMBOLS[name]
    told = (
        name.replace("gamma", r"\gamma").replace("K", r"\mathcal{K}").replace("tr ", r"\mathrm{tr}\,").replace(".", " ")
    )
    return f"${told}$" if re.fullmatch(r"(tr |gamma\.)?K\^\d+(\.gamma)?", name) else reading.literal(name)


def sizes(start: Floats, names: list[str]) -> list[Floats]:
    """What each change is compared with, (balls,): the integral at the start; |𝒦||γ| for ⟨𝒦,γ⟩, which may vanish.

    start: the integrals at the start, (balls, integrals), with their names.
    """
    found = [np.abs(start[:, i]) for i in range(len(names))]
    if {"K.gamma", "K.K", "gamma.gamma"} <= set(names):
        found[names.index("K.gamma")] = np.sqrt(found[names.index("K.K")] * found[names.index("gamma.gamma")])
    return found
