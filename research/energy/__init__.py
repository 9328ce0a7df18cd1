"""The energy ε²H of the map (6-open): an oscillation ∝ ε⁴ in general, ∝ ε³ in a resonance, and no drift seen.

Of D = 0 the map keeps H itself, to rounding, and of a vertical momentum, too: the two controls.

H = energy/ε² is 2.5 as corrected of K = 𝒦/ε; all ranges are relative to H.
"""

from typing import Any

import numpy as np

from chapsym.files import Data

from ..units import Run, Unit, run_units
from .section import Level, packed

TITLE = "The energy of the whole map"
#: The captions of the figures, in their order.
CAPTIONS = {
    "energy.svg": "Left: over a long run the energy H of K = 𝒦/ε ranges by a part ∝ ε² of itself at generic starts, "
    "and ∝ ε in the widest resonances. Right: what the map adds to H along a closed orbit of the continuous ball, "
    "(H(Gⁿx) - H(x))/ε², tends to the integral of X₃(H).",
    "islands.svg": "In a resonance the energy swings as a pendulum does, and does not drift: the section K₂ = 0 near "
    "the widest resonance of three balls (orange: starts inside the predicted separatrix).",
}
DRAWN = {"energy.svg": "figure:draw_amplitudes", "islands.svg": "figure:draw_islands"}

HERE = "research.energy.amplitude:"
SEED = 44
#: J and D; real balls have D ≥ J1 + J2 + J3.
BALLS = (((1, 2, 4), 1.0), ((1, 2, 4), 7.0), ((0, 1, 3), 1.0), ((0, 1, 3), 4.0))
COSINES = (0.35, 0.5, 0.617126)
EPSILONS = (0.01, 0.014, 0.02, 0.03, 0.045, 0.07, 0.1, 0.14, 0.2, 0.3, 0.45, 0.6, 0.8)
#: How a range grows with ε is fitted to those of the generic starts up to here.
SMALL = 0.1
GENERIC = 3
SWINGS = 4
LONGER = 16
#: The most steps of a run: where its swings take more, it is left out.
LONGEST = 5 * 10**6
#: The island is drawn at this ε, and the long run in it taken.
SHOWN = 0.05
ISLAND = (0.02, 0.3, 0.55, 0.8, 0.93, 1.03, -1.03, 1.25, -1.25)


def study(quick: bool = False, run: Run = run_units) -> Data:
    """Range and drift of the energy at generic, vertical and resonant starts, and with D = 0; JSON data."""
    balls = [[list(J), D, c] for J, D in BALLS for c in COSINES]
    balls = [[[0, 1, 3], 4.0, 0.5], [[1, 2, 4], 1.0, 0.617126]] if quick else balls
    search = {"most": 1 if quick else 2, "time": 60.0, "grid": 64}
    levels = run([Unit(HERE + "resonances", {"ball": b, **search}) for b in balls])
    every = [r for level in levels for r in level]
    met = dict.fromkeys(str(r["ball"][:2]) for r in every)
    resonant = [max((r for r in every if str(r["ball"][:2]) == ball), key=lambda r: r["width"]) for ball in met]
    units = _units(resonant, quick)
    results = run([unit for _, unit in units])
    names = ("ball", "returns", "period", "energy", "beta", "width", "libration")
    table = [{**{n: r[n] for n in names}, "loop": max(r["loop"], key=abs)} for r in every]
    found: Data = {"seed": SEED, "shown": SHOWN, "resonances": table, "widest": resonant}
    for (group, unit), result in zip(units, results, strict=True):
        lines = {"ball": unit.arguments["ball"], "start": unit.arguments["start"]}
        if group == "islands":
            result = {**result, "psi": packed(result["psi"]), "energy": packed(result["energy"])}
        found.setdefault(group, []).append({**lines, **(result if isinstance(result, dict) else {"runs": result})})
    # The generic start with the largest drift may oscillate slowly: it is followed for longer.
    worst = max(found["generic"], key=lambda run: abs(run["drift"]) / run["range"])
    longer = {name: worst[name] for name in ("ball", "start", "epsilon")} | {"steps": LONGER * worst["steps"]}
    found["longer"] = run([Unit(HERE + "amplitude", longer)])
    found["powers"] = {name: _exponent(found[name]) for name in ("generic", "resonant")}
    return found


def _units(resonant: list[Data], quick: bool) -> list[tuple[str, Unit]]:
    """The runs, each with the group that it belongs to."""
    epsilons = (0.05, 0.1, 0.2, 0.4) if quick else EPSILONS
    steps = 10**4 if quick else 10**6
    units = []

    def run(group: str, ball: list[Any], start: np.ndarray | list[np.ndarray], epsilon: float, count: int) -> None:
        arguments = {"ball": ball, "start": np.asarray(start).tolist(), "epsilon": epsilon, "steps": count}
        units.append((group, Unit(HERE + "amplitude", arguments)))

    for r in resonant:
        J, D, cosine = r["ball"]
        for start in starts(Level(tuple(J), D, cosine).size):
            for epsilon in epsilons:
                run("generic", r["ball"], start, epsilon, steps)
            run("euler", [J, 0.0, cosine], start, epsilons[-1], steps)
        upright = start[1] * np.linalg.norm(start[0])
        run("vertical", r["ball"], [upright, start[1]], epsilons[-1], steps)
        for epsilon in epsilons:
            count = max(steps, int(SWINGS * r["libration"] / epsilon**2))
            if count <= LONGEST:
                run("resonant", r["ball"], r["start"], epsilon, count)
        run("long", r["ball"], r["start"], 0.1, 10**6 if quick else LONGEST)
        counts = [int(r["period"] / e) for e in (0.4, 0.2, 0.1, 0.05)]
        loop = {"ball": r["ball"], "start": r["start"], "period": r["start_period"], "counts": counts}
        units.append(("loops", Unit(HERE + "loop_change", loop)))
        for share in ISLAND:
            shown = {
                "ball": r["ball"], "start": r["centre"], "epsilon": SHOWN, "most": 200 if quick else 320,
                "energy": r["energy"] * (1 + share * SHOWN * r["width"] / 2),
                "steps": min(int((2 if quick else 6) * r["libration"] / SHOWN**2), LONGEST),
            }  # fmt: skip
            units.append(("islands", Unit(HERE + "island", shown)))
    return units


def starts(size: float) -> np.ndarray:
    """GENERIC random states K, γ, (GENERIC, 2, 3), seeded."""
    drawn = np.random.default_rng(SEED).normal(size=(GENERIC, 2, 3))
    drawn /= np.linalg.norm(drawn, axis=-1, keepdims=True)
    return drawn * np.array([size, 1.0])[:, np.newaxis]


def _exponent(runs: list[Data]) -> dict[str, float]:
    """The power of ε that the relative range follows: fitted up to SMALL for each start, and averaged.

    error: the standard error of the average; 0 of a single one.
    """
    series: dict[str, list[tuple[float, float]]] = {}
    for run in runs:
        if run["epsilon"] <= SMALL:
            series.setdefault(str(run["start"]), []).append((run["epsilon"], run["range"]))
    logs = [np.log(np.array(one)) for one in series.values() if len(one) > 1]
    powers = np.array([np.polyfit(one[:, 0], one[:, 1], 1)[0] for one in logs])
    error = powers.std(ddof=1) / np.sqrt(len(powers)) if len(powers) > 1 else 0.0
    return {"power": float(powers.mean()), "error": float(error)}


def sentences(found: Data) -> list[str]:
    """The findings, a line each."""
    powers = found["powers"]
    lines = [
        f"in long runs H ranges by a part ∝ ε^{powers[name]['power']:.3f}"
        + (f" ± {powers[name]['error']:.3f}" if powers[name]["error"] else "")
        + f" of itself {where}"
        for name, where in (("generic", "at generic starts"), ("resonant", "in resonances"))
    ]
    for name, where in (
        ("generic", "generic starts (slow swings count as drift)"),
        ("longer", "the worst of them for longer"),
        ("long", "resonances"),
    ):
        worst = max(found[name], key=lambda run: abs(run["drift"]) / run["range"])
        lines.append(
            f"drift, {where}: at most {abs(worst['drift']) / worst['range']:.1e} of the range in {worst['steps']} steps"
            f" ({worst['drift']:.1e} ± {worst['error']:.1e} of H)"
        )
    for name, where in (("euler", "D = 0"), ("vertical", "vertical momentum")):
        lines.append(f"{where}: H kept to {max(run['range'] for run in found[name]):.1e}")
    for r, loops in zip(found["widest"], found["loops"], strict=True):
        J, D, cosine = r["ball"]
        last = loops["runs"][-1]
        lines.append(
            f"J = {tuple(J)}, D = {D:g}, cos = {cosine:g}: the widest resonance, of closed orbits with "
            f"T = {r['period']:.5f}; H swings by {r['width']:.4f} εH; the map changes H along one by "
            f"{last['change']:.5e} ε², the integral of X₃(H) is {max(r['loop'], key=abs):.4e}"
        )
    return lines
