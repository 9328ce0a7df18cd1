"""The figures: the range of the energy against ε; the islands of the resonances on the section."""

import numpy as np
from matplotlib.ticker import NullFormatter

from chapsym.files import Data
from chapsym.show.drawing.style import COLOURS, WIDE, Picture, new

from .section import unpacked

BLUE, RED = COLOURS[:2]
OF = {"generic": BLUE, "resonant": RED}
LABELS = {"generic": "generic starts", "resonant": "in the widest resonances"}


def draw_amplitudes(found: Data) -> Picture:
    """The range of H over each run against ε, with lines ε and ε²; and the change by a loop against the quadrature."""
    figure, (left, right) = new("", 1, 2, height=4.6, width=WIDE)
    for name in ("generic", "resonant"):
        x, y = np.array([(run["epsilon"], run["range"]) for run in found[name]]).T
        left.plot(x, y, "o", color=OF[name], markersize=4.5, alpha=0.7, label=LABELS[name], markeredgewidth=0)
    span = np.array([min(run["epsilon"] for run in found["generic"]), 0.5])
    for power, name in ((2, "generic"), (1, "resonant")):
        runs = [run for run in found[name] if run["epsilon"] <= 0.1]
        scale = max(run["range"] / run["epsilon"] ** power for run in runs)
        left.plot(span, 1.35 * scale * span**power, color=OF[name], linewidth=1, linestyle="--")
        at = float(np.sqrt(span[0] * span[1]))
        text = r"$\propto\varepsilon^2$" if power == 2 else r"$\propto\varepsilon$"
        left.annotate(text, (at, 1.9 * scale * at**power), color=OF[name], ha="right")
    left.set(xscale="log", yscale="log", xlabel=r"step $\varepsilon$", ylabel="range of $H$, relative")
    left.set_title("The energy oscillates")
    left.legend(loc="lower right")
    for i, (r, loops) in enumerate(zip(found["widest"], found["loops"], strict=True)):
        x, y = np.array([(run["epsilon"], run["change"]) for run in loops["runs"]]).T
        exact = max(r["loop"], key=abs)
        J, D, _ = r["ball"]
        label = f"$J=({J[0]:g},{J[1]:g},{J[2]:g})$, $D={D:g}$"
        right.plot(x, np.abs(y / exact - 1), "osD^"[i % 4] + "-", markersize=5, linewidth=1, label=label)
    right.set(xscale="log", yscale="log", xlabel=r"step $\varepsilon=T/n$")
    right.set_ylabel(r"$|\,(H(G^nx)-H(x))\,/\,\varepsilon^2\oint X_3(H)\,dt-1\,|$")
    right.set_title("The change by a closed orbit of the ball")
    right.legend(loc="lower right")
    for axis in (left, right):
        axis.xaxis.set_minor_formatter(NullFormatter())
    return figure


def draw_islands(found: Data) -> Picture:
    """For each ball the section near its widest resonance: H - H*, divided by εH*, against ψ about the island."""
    count = len(found["widest"])
    columns = count if count <= 3 else 2
    rows = -(-count // columns)
    epsilon = found["shown"]
    title = rf"Islands of the energy on the section $K_2=0$, $\varepsilon={epsilon:g}$"
    figure, axes = new("", rows, columns, height=3.9, width=(4.2 if columns == 3 else 5.2) * columns)
    figure.suptitle(title)
    for axis, r in zip(axes, found["widest"], strict=False):
        orbits = [one for one in found["islands"] if one["ball"] == r["ball"]]
        centre = np.angle(np.exp(1j * unpacked(orbits[0]["psi"])).mean()) / np.pi if orbits else 0.0
        for i, one in enumerate(orbits):
            psi = np.mod(unpacked(one["psi"]) / np.pi - centre + 1, 2) - 1
            rise = (unpacked(one["energy"]) / r["energy"] - 1) / epsilon
            colour = RED if i < 5 else BLUE
            axis.plot(psi, rise, ".", color=colour, markersize=2.4, markeredgewidth=0, rasterized=True)
        J, D, _ = r["ball"]
        axis.set_title(f"$J=({J[0]:g},{J[1]:g},{J[2]:g})$, $D={D:g}$, $T={r['period']:.2f}$")
        axis.set(xlabel=r"$(\psi-\psi_*)/\pi$", ylabel=r"$(H-H_*)\,/\,\varepsilon H_*$", xlim=(-1, 1))
    for axis in axes[count:]:
        axis.set_visible(False)
    return figure
