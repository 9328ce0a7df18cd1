"""The figures: the share of chaotic orbits against ε, and the section K₂ = 0 at a moderate and at a large ε."""

import numpy as np
from matplotlib import colormaps
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from chapsym.files import Data
from chapsym.show.drawing.style import COLOURS, WIDE, Picture, new

from ..energy.section import Level, state, unpacked
from .orbits import share


def draw_shares(found: Data) -> Picture:
    """Two panels, by how the starts were drawn: shares with 95% intervals, one line a ball."""
    figure, axes = new("", 1, 2, height=4.4, width=WIDE, sharey=True)
    balls = sorted({(tuple(s["mass_tensor"]), s["D"]) for s in found["samples"]}, key=lambda b: (b[1] == 0, b))
    for axis, near in zip(axes, (False, True), strict=True):
        for i, (J, D) in enumerate(balls):
            runs = [s for s in found["samples"] if (tuple(s["mass_tensor"]), s["D"], s["near"]) == (J, D, near)]
            runs = [s for s in runs if s["counted"]]
            x = np.array([s["epsilon"] for s in runs]) * (1 + 0.02 * (i - len(balls) / 2))
            p, low, high = np.array([share(s["counted"], s["chaotic"]) for s in runs]).T
            colour = "0.55" if D == 0 else COLOURS[i % 4]
            axis.errorbar(
                x, p, [p - low, high - p], marker="o", markersize=4.5, linewidth=1.2, elinewidth=0.9, capsize=2,
                color=colour, label=f"$J=({J[0]:g},{J[1]:g},{J[2]:g})$, $D={D:g}$", zorder=1 if D == 0 else 2,
            )  # fmt: skip
        axis.set(xscale="log", xlabel=r"$\varepsilon=|\mathcal{K}|/I_{min}$")
        axis.set_yscale("symlog", linthresh=0.01)
        axis.set_yticks([0, 0.01, 0.1, 1], ["0", "0.01", "0.1", "1"])
        axis.set_xticks([0.2, 0.5, 1, 2, 3], ["0.2", "0.5", "1", "2", "3"])
        axis.set_xticks([], minor=True)
        axis.set_ylim(0, 1)
        axis.set_title("starts near the unstable rotation" if near else "starts at random")
    axes[0].set_ylabel("share of chaotic orbits")
    axes[0].legend(loc="upper left")
    return figure


def draw_section(found: Data) -> Picture:
    """The section (ψ, θ) at the moderate ε, (ψ, H) around the layer; regular orbits in blue by their energy, chaotic
    ones by their exponent."""
    figure, axes = new("", 1, len(found["pictures"]), height=5.6, width=WIDE)
    orbits = [orbit for one in found["pictures"] for orbit in one["found"]]
    most = max([orbit["exponent"] for orbit in orbits if orbit["chaotic"]], default=1.0)
    hot = Normalize(0.0, most)
    for axis, one in zip(axes, found["pictures"], strict=True):
        zoom = None if axis is axes[0] else float(np.mean([orbit["energy"] for orbit in one["found"]] or [1.0]))
        energies = [orbit["energy"] for orbit in one["found"]]
        (J, D, cosine), epsilon = one["ball"], one["epsilon"]
        level = Level(tuple(J), D, cosine)
        cold = Normalize(min(energies, default=0.0) - 1e-9, max(energies, default=1.0))
        for orbit in sorted(one["found"], key=lambda orbit: orbit["chaotic"]):
            if orbit["chaotic"]:
                colour = colormaps["autumn_r"](0.25 + 0.75 * hot(orbit["exponent"]))
            else:
                colour = colormaps["YlGnBu"](0.35 + 0.65 * cold(orbit["energy"]))
            psi, theta = unpacked(orbit["psi"]) / 1e5, unpacked(orbit["theta"]) / 1e5
            height = theta if zoom is None else level.energy(*state(level, np.pi * theta, np.pi * psi)) / zoom - 1
            axis.plot(psi, height, ".", markersize=2.2, markeredgewidth=0, color=colour, rasterized=True)
        axis.set_title(f"$J=({J[0]:g},{J[1]:g},{J[2]:g})$, $D={D:g}$, $\\varepsilon={epsilon:g}$")
        axis.set(xlabel=r"$\psi/\pi$", xlim=(-1, 1), xticks=(-1, -0.5, 0, 0.5, 1))
        axis.set_ylabel(r"$\theta/\pi$" if zoom is None else r"$H/\langle H\rangle-1$")
    scale = ScalarMappable(Normalize(0.0, most), colormaps["autumn_r"])
    figure.colorbar(scale, ax=axes, label="Lyapunov exponent a step (chaotic orbits)", shrink=0.8)
    return figure
