"""Figures of what happens on one circle: the displacement of G^q, and the rotation number."""

from fractions import Fraction
from typing import Any

import numpy as np

from chapsym.files import Data
from chapsym.show.drawing.style import COLOURS, WIDE, Picture, new

from .words import decimal, log10, named, scaled

BLUE, RED = COLOURS[:2]
GREY = "0.45"
#: Points of a drawn displacement.
DRAWN = 600


def displacement(found: Data) -> Picture:
    """The displacement at a resonance: of the ball, of D = 0 at all digits, of a perturbed top; and the spectra."""
    ball, top, kicked = found["displacement"][:3]
    figure, axes = new("", 2, 2, height=3.7, width=WIDE)
    q, digits = ball["steps"], ball["digits"]
    for axis, case, colour in ((axes[0], ball, BLUE), (axes[2], kicked, RED)):
        power = power_of(case)
        x, y = continued(case, power)
        axis.plot(x, y, color=colour)
        n = len(case["values"])
        axis.plot(np.arange(n) / n, scaled(case["values"], power), "o", color=colour, markersize=3.2)
        axis.set(ylabel=f"displacement, $10^{{{power}}}$ half turns")
    axes[0].set(title=f"Ball, {named(ball)}: it locks")
    axes[2].set(title=f"Top, D = 0, φ kicked by {decimal(kicked['kick'])} sin 2φ: it locks")
    n = len(top["values"])
    axes[1].plot(np.arange(n) / n, scaled(top["values"], -digits), "o", color=GREY, markersize=3.2)
    axes[1].set(
        title=f"Top, {named(top, 'J', 'D', 'h')}: zero to {digits} digits",
        ylim=(-30, 30),
        ylabel=f"displacement, $10^{{-{digits}}}$ half turns",
    )
    for axis in axes[:3]:
        axis.axhline(0, color="0.6", linewidth=0.8, zorder=1)
        axis.set(xlabel="start u / 2K", xlim=(0, 1))
    for case, colour, marker, label in (
        (kicked, RED, "s", "kicked top"), (ball, BLUE, "o", "ball"), (top, GREY, ".", "top, D = 0: rounding"),
    ):  # fmt: skip
        sizes = [log10(x) for x in case["cosines"]]
        axes[3].plot(range(len(sizes)), sizes, marker=marker, markersize=3.6, linewidth=0.9, color=colour, label=label)
    axes[3].set(
        xlabel="harmonic j of cos(jπu/K)", ylabel="$\\log_{10}$ |coefficient|", ylim=(-digits - 5, -8),
        title="Fourier coefficients of the three",
    )  # fmt: skip
    axes[3].set_xticks(range(0, len(ball["cosines"]), q))
    axes[3].legend(loc="upper right", ncols=3, handlelength=1.2, columnspacing=1)
    figure.suptitle(f"$(G^{{{q}}}u-u)/2K-1$ where {q} steps are one half turn, with {digits} digits")
    return figure


def continued(case: Data, power: int) -> tuple[np.ndarray, np.ndarray]:
    """The trigonometric polynomial through the values, in units of 10^power."""
    x = np.linspace(0, 1, DRAWN + 1)
    cosines, sines = (np.array(scaled(case[name], power)) for name in ("cosines", "sines"))
    angle = 2 * np.pi * np.outer(x, np.arange(len(cosines)))
    return x, np.cos(angle) @ cosines + np.sin(angle) @ sines


def power_of(case: Data) -> int:
    """The power of ten of the largest displacement."""
    return int(np.floor(max(log10(x) for x in case["values"])))


def numbers(found: Data) -> Picture:
    """How fast the weighted averages converge, and the rotation number over levels and heights."""
    figure, axes = new("", 2, 2, height=4.0, width=WIDE)
    for case, colour, marker in zip(found["convergence"], COLOURS, "os^", strict=False):
        axes[0].plot(
            case["steps"], [-log10(x) for x in case["errors"]], marker=marker, color=colour, markersize=4.5,
            label=f"D = {case['D']}" + (", against the exact one" if case["exact"] else ""),
        )  # fmt: skip
    axes[0].set(
        xscale="log", xlabel="steps", ylabel="correct digits of the rotation number",
        title=f"Weighted Birkhoff averages\n{named(found['convergence'][0], 'J', 'h')}",
    )  # fmt: skip
    axes[0].axhline(16, color="0.6", linestyle=":", linewidth=1.2)
    axes[0].text(axes[0].get_xlim()[1], 16.5, "float64", ha="right", va="bottom", color="0.4", fontsize=9.5)
    axes[0].legend(loc="upper left")
    contacts = list(dict.fromkeys(row["D"] for row in found["overview"]))
    top = max(float(cell) for row in found["overview"] for cell in row["row"] if cell)
    levels = np.arange(0, top + 0.02, 0.02)
    drawn: Any = None
    for axis, D in zip(axes[1:], contacts, strict=True):
        rows = [row for row in found["overview"] if row["D"] == D]
        heights = [float(Fraction(row["height"])) for row in rows]
        n = len(rows[0]["row"])
        rho = np.array([[float(cell) if cell else np.nan for cell in row["row"]] for row in rows])
        drawn = axis.contourf((np.arange(n) + 0.5) / n, heights, rho, levels=levels, cmap="viridis")
        fine = [1 / q for q in (12, 10, 8, 7, 6, 5, 4)]
        lines = axis.contour((np.arange(n) + 0.5) / n, heights, rho, levels=fine, colors="white", linewidths=0.9)
        axis.clabel(lines, fmt={x: f"1/{round(1 / x)}" for x in fine}, fontsize=9)
        axis.set(xlabel="level, from the separatrix (0) to the axis (1)", ylabel="height h")
        axis.set_title(f"Half turns a step, {named(rows[0], 'J', 'D')}\n(white: the branch has ended)")
        axis.grid(visible=False)
    figure.colorbar(drawn, ax=axes[1:], shrink=0.6, label="ρ, half turns a step")
    return figure
