"""The figures: the displacement of G^q and the rotation number on a circle; the plateaus, their law, their digits."""

from fractions import Fraction
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import NullFormatter, ScalarFormatter

from chapsym.files import Data
from chapsym.show.drawing.style import COLOURS, WIDE, Picture, new

from .words import decimal, log10, named, scaled

BLUE, RED, GREEN = COLOURS[:3]
GREY = "0.45"
#: Points of a drawn displacement.
DRAWN = 600
#: float64's roundings, relative to 1.
FLOAT64 = -15.95
#: The law is drawn for D to this.
SMALL = 0.25


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
    axes[1].set(title=f"Top, {named(top, 'J', 'D', 'h')}: zero to {digits} digits", ylim=(-30, 30))
    axes[1].set_ylabel(f"displacement, $10^{{-{digits}}}$ half turns")
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


def staircase(found: Data) -> Picture:
    """ρ(l) of the ball and of the perturbed top; below, the widths of their plateaus on one logarithmic scale."""
    figure, axes = new("", 2, 2, height=3.7, width=WIDE, sharex="col")
    ball, top = found["staircase"]["ball"], found["staircase"]["top"]
    widths = [(x["half_turns"], x["steps"], float(x["level"]), log10(x["width"])) for x in found["farey"]]
    for axis, case, colour in ((axes[0], ball, BLUE), (axes[1], top, RED)):
        axis.plot(case["levels"], case["rotation_numbers"], color=colour)
        axis.tick_params(labelbottom=True)
        axis.set(ylim=(0, None), xlabel="level l", ylabel="ρ, half turns a step")
    axes[0].set(title=f"Ball, {named(ball)}")
    axes[1].set(title=f"Kicked top, {named(top)}, τ = {decimal(top['kick'])}")
    _inset(axes[0], found)
    _steps(axes[1], top)
    wide = [(p, p["edges"][1] - p["edges"][0]) for p in top["plateaus"]]
    seen = [(p["half_turns"], p["steps"], sum(p["edges"]) / 2, np.log10(w)) for p, w in wide if w > 1e-14]
    _stems(axes[2], widths, BLUE, 10)
    _stems(axes[3], seen, RED, 5)
    floor = 10.0 * np.ceil(-min(w for *_, w in widths) / 10 + 0.2)
    for axis in axes[2:]:
        axis.axhline(FLOAT64, color="0.35", linestyle=":", linewidth=1.3)
        axis.set(ylim=(-floor, 1), xlabel="level l", ylabel="$\\log_{10}$ width of the locked interval in l")
    axes[2].text(
        0.99, FLOAT64 + 0.8, "float64 is blind below", transform=axes[2].get_yaxis_transform(), ha="right", color="0.3",
        fontsize=9.5,
    )  # fmt: skip
    return figure


def _steps(axis: Axes, top: Data) -> None:
    """The plateaus of the top, drawn thick, and the names of the widest."""
    named_ones = sorted(top["plateaus"], key=lambda p: p["edges"][0] - p["edges"][1])[:6]
    for p in top["plateaus"]:
        rho = p["half_turns"] / p["steps"]
        axis.plot(p["edges"], [rho, rho], color="black", linewidth=2.4, solid_capstyle="butt")
    for p in named_ones:
        turns, steps, at = p["half_turns"], p["steps"], sum(p["edges"]) / 2
        name, rho = f"{turns}/{steps}", turns / steps
        axis.annotate(name, (at, rho), (-6, 3), textcoords="offset points", ha="right", fontsize=9.5)


def _inset(axis: Axes, found: Data) -> None:
    """The plateau at 1/8, magnified until it is seen: G⁸ is next to the identity there, the time of a flow."""
    case = next(x for x in found["displacement"] if x["steps"] == 8)
    slope = next(float(x["slope"]) for x in found["farey"] if (x["half_turns"], x["steps"]) == (1, 8))
    power = power_of(case)
    _, d = continued(case, power)
    d = d[:-1]
    size = 3 * (d.max() - d.min())
    shifts = np.linspace(-size, size, 801)
    # The rotation number of u ↦ u + d(u) for a small d > 0 is the harmonic mean of d.
    means = [0.0 if (d + s).min() * (d + s).max() <= 0 else 1 / np.mean(1 / (d + s)) for s in shifts]
    inset = axis.inset_axes((0.56, 0.14, 0.42, 0.37))
    inset.plot(shifts / slope, np.array(means) / 8, color=BLUE)
    inset.set_xlabel(f"$l-l_0$, $10^{{{power}}}$", fontsize=9, labelpad=1)
    inset.set_ylabel(f"$\\rho-1/8$, $10^{{{power}}}$", fontsize=9, labelpad=1)
    inset.tick_params(labelsize=8)
    inset.text(0.04, 0.86, "locked at 1/8", transform=inset.transAxes, fontsize=9)
    middle = float(case["level"])
    axis.plot([middle], [1 / 8], "o", color="black", markersize=4.5)
    axis.annotate("1/8", (middle, 1 / 8), (-6, 4), textcoords="offset points", ha="right", fontsize=9.5)


def _stems(axis: Axes, seen: list[tuple[int, int, float, float]], colour: str, largest: int) -> None:
    """Widths over levels; those with a small q, at most `largest`, are named."""
    for p, q, level, width in seen:
        axis.plot([level, level], [-200, width], color=colour, linewidth=1.1, alpha=0.35)
        axis.plot([level], [width], "o", color=colour, markersize=4)
        if q <= largest or (p > 1 and q <= 2 * largest - 3):
            axis.annotate(f"{p}/{q}", (level, width), (0, 5), textcoords="offset points", ha="center", fontsize=8.5)


def widths(found: Data) -> Picture:
    """Widths against q near one rotation number, with the law; against D; and what is measured, with the law."""
    figure, axes = new("", 2, 2, height=3.7, width=WIDE)
    _against_q(axes[0], found["fifth"])
    _against_D(axes[1], axes[3], found["small_D"])
    _one_half_turn(axes[2], found["turns"])
    return figure


def _against_q(axis: Axes, found: list[Data]) -> None:
    contacts = list(dict.fromkeys(x["D"] for x in found))
    for D, colour, marker in zip(contacts, COLOURS, "osD^v", strict=False):
        rows = sorted((x for x in found if x["D"] == D), key=lambda x: x["steps"])
        q = [x["steps"] for x in rows]
        axis.plot(q, [log10(x["width"]) for x in rows], marker, color=colour, markersize=4.5, label=f"D = {D}")
        if contacts[0] == D:
            axis.plot(q, [log10(x["law"]) for x in rows], color=colour, linewidth=1, label=f"law, D = {D}")
    axis.axhline(FLOAT64, color="0.35", linestyle=":", linewidth=1.2)
    axis.set(xlabel="q", ylabel="$\\log_{10}$ width in l", title=f"p/q next to 1/5, {named(found[0], 'J', 'h')}")
    axis.legend(loc="lower left")


def _against_D(axis: Axes, rest: Axes, found: list[Data]) -> None:
    for q, colour, marker in zip(sorted({x["steps"] for x in found}), COLOURS, "osD^", strict=False):
        rows = sorted((x for x in found if x["steps"] == q), key=lambda x: Fraction(x["D"]))
        D = [float(Fraction(x["D"])) for x in rows]
        axis.plot(D, [log10(x["width"]) for x in rows], marker, color=colour, markersize=4.5, label=f"p/q = 1/{q}")
        small = [x for x in rows if Fraction(x["D"]) <= SMALL]
        axis.plot(D[: len(small)], [log10(x["law"]) for x in small], color=colour, linewidth=1)
        rest.plot(D, [1 - x["ratio"] for x in rows], marker + "-", color=colour, markersize=4, linewidth=0.8)
        if q == min(x["steps"] for x in found):
            ends = np.array([D[0], 0.25])
            rest.plot(ends, (1 - rows[0]["ratio"]) * ends / D[0], "--", color=GREY, linewidth=1, label="∝ D")
    axis.set(
        xscale="log", xlabel="D", ylabel="$\\log_{10}$ width in l",
        title=f"Widths against D, {named(found[0], 'J', 'h')}; lines: the law",
    )  # fmt: skip
    axis.legend(loc="upper left")
    rest.set(xscale="log", yscale="log", xlabel="D", ylabel="1 - measured / law", title="What the law leaves for D → 0")
    rest.legend(loc="lower right")


def _one_half_turn(axis: Axes, found: list[Data]) -> None:
    cases = list(dict.fromkeys(named(x) for x in found))
    for case, colour, marker in zip(cases, COLOURS, "osD^", strict=False):
        rows = [x for x in found if named(x) == case]
        axis.plot(
            [x["steps"] for x in rows], [log10(x["width"]) for x in rows], marker + "-", color=colour, markersize=4,
            linewidth=0.8, label=case,
        )  # fmt: skip
    axis.axhline(FLOAT64, color="0.35", linestyle=":", linewidth=1.2)
    over = axis.get_yaxis_transform()
    axis.text(0.99, FLOAT64 + 0.6, "float64", transform=over, ha="right", color="0.3", fontsize=9.5)
    axis.set(xlabel="q", ylabel="$\\log_{10}$ width in l", title="One half turn in q steps, h fixed")
    axis.set_ylim(bottom=axis.get_ylim()[0] - 22)
    axis.legend(loc="lower right", fontsize=8.5)


def digits(found: Data) -> Picture:
    """The digits at which each plateau is first seen, and the time of a step against the number of digits."""
    figure, axes = new("", 1, 2, height=4.2, width=WIDE)
    names = "turns", "fifth", "small_D", "farey"
    seen = [(-log10(x["displacement"][0]), x["needed"]) for name in names for x in found[name]]
    far = max(x for x, _ in seen) * 1.04
    axes[0].fill_between([0, far], 0, 15.95, color=GREEN, alpha=0.10, linewidth=0)
    axes[0].text(far * 0.98, 8, "float64 can see", ha="right", va="center", color=GREEN)
    axes[0].plot([0, far], [0, far], color=GREY, linewidth=0.9)
    axes[0].plot(*zip(*seen, strict=True), "o", color=BLUE, markersize=4)
    axes[0].set(
        xlabel="$-\\log_{10}$ |displacement of $G^q$|, in half turns", ylabel="working digits needed", xlim=(0, far),
        ylim=(0, far), title=f"Digits at which {len(seen)} locked intervals are seen",
    )  # fmt: skip
    rows = found["times"]
    axes[1].plot([x["digits"] for x in rows], [x["seconds"] * 1e6 for x in rows], "o-", color=RED, markersize=5)
    axes[1].set(xscale="log", yscale="log", xlabel="working digits", ylabel="µs a step")
    axes[1].set_title("What a step costs in Arb")
    axes[1].set_xticks([x["digits"] for x in rows if x["digits"] in (15, 30, 60, 120, 240, 400, 1000)])
    axes[1].xaxis.set_major_formatter(ScalarFormatter())
    axes[1].xaxis.set_minor_formatter(NullFormatter())
    axes[1].set_ylim(bottom=10)
    return figure
