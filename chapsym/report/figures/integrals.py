"""The momentum integrals over time, as their relative changes."""

from typing import TYPE_CHECKING

import numpy as np

from chapsym.dynamics.ball import Floats

from . import change, reading
from .style import legend, new

if TYPE_CHECKING:
    from matplotlib.figure import Figure
    from xarray import Dataset

NEEDS = ("integrals",)
ABOUT = "momentum integrals over time, relative change"
SYMBOLS = {
    "K.gamma": r"$\langle\mathcal{K},\gamma\rangle$",
    "K.K": r"$\langle\mathcal{K},\mathcal{K}\rangle$",
    "gamma.gamma": r"$\langle\gamma,\gamma\rangle$",
}


def missing(dataset: "Dataset") -> str | None:
    """Why this figure cannot be drawn, in a sentence; None if it can."""
    return None if "integrals" in dataset else 'no integrals: add "integrals" to run.outputs'


def draw(dataset: "Dataset") -> "Figure":
    """The map keeps the momentum integrals, so all that is seen is roundoff."""
    found = reading.values(dataset, "integrals")
    names = [str(name) for name in dataset["integral"].values] if "integral" in dataset.coords else []
    names = names or [str(i + 1) for i in range(found.shape[-1])]
    figure, (axis,) = new(str(dataset.attrs.get("title", "")), height=3.6)
    changes = {
        _symbol(name): change.relative(found[..., i], _size(found[:, 0], names, i))
        for i, name in enumerate(names)
    }
    change.plot(axis, dataset, changes)
    axis.set_title("momentum integrals, and the largest change of each")
    legend(figure, [axis])
    return figure


def _symbol(name: str) -> str:
    """A name of the result as mathematics: "tr K^2" is tr 𝒦²."""
    if name in SYMBOLS:
        return SYMBOLS[name]
    told = name.replace("gamma", r"\gamma").replace("K", r"\mathcal{K}").replace("tr ", r"\mathrm{tr}\,").replace(".", " ")
    return f"${told}$" if "K" in name else name


def _size(start: Floats, names: list[str], i: int) -> Floats:
    """What a change is compared with, (balls,): the integral at the start; |𝒦||γ| for ⟨𝒦,γ⟩, which may vanish."""
    if names[i] == "K.gamma" and {"K.K", "gamma.gamma"} <= set(names):
        return np.sqrt(np.abs(start[:, names.index("K.K")] * start[:, names.index("gamma.gamma")]))
    return np.abs(start[:, i])
