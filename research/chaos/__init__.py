"""How much of the map is chaotic (6-open): Lyapunov exponents over samples of starts, phase volume, pictures.

ε = |𝒦|/I_min is about the angle of a step, in radians; to ε = 1 lemma `small-branch` can reach.
"""

from itertools import product

from chapsym.files import Data

from ..energy.section import packed
from ..units import Run, Unit, run_units
from .orbits import share

TITLE = "How much of the map is chaotic"
#: The captions of the figures, in their order.
CAPTIONS = {
    "chaos.svg": "The share of chaotic orbits among 128 against ε = |𝒦|/I_min, with 95% intervals: at random starts "
    "none is found for small ε; chaos starts at the unstable rotation. D = 0 is the control.",
    "section.svg": "Poincaré sections of the map, J = (0, 1, 3), D = 1, on K₂ = 0: at ε = 0.9 invariant curves and "
    "islands, at ε = 2 a chaotic layer (red) between them.",
}
DRAWN = {"chaos.svg": "figure:draw_shares", "section.svg": "figure:draw_section"}

HERE = "research.chaos.orbits:"
SEED = 7
#: J and D; D = 0 is the control, D = J1 + J2 + J3 the least of a real ball.
BALLS = (((0, 1, 3), 0.0), ((0, 1, 3), 1.0), ((0, 1, 3), 4.0), ((1, 2, 4), 1.0), ((1, 2, 4), 7.0))
EPSILONS = (0.3, 0.6, 0.9, 1.5, 2.0, 3.0)
#: Orbits of a sample, and steps.
ORBITS, STEPS = 128, 20_000
#: The length of the runs is varied for this ball at this ε.
LENGTHS = (5_000, 20_000, 80_000)
VARIED = ((0, 1, 3), 1.0, 0.9)
#: The figures: a level at a moderate ε, and a chaotic layer of it at a large one.
LEVEL = [[0, 1, 3], 1.0, 0.5]
PICTURES: tuple[Data, ...] = (
    {"ball": LEVEL, "epsilon": 0.9, "lines": [[0.0, -0.2, 0.6], [1.0, -0.1, 0.5]]},
    {"ball": LEVEL, "epsilon": 2.0, "lines": [[1.0, 0.335, 0.35], [0.0, 0.41, 0.435]]},
)


def study(quick: bool = False, run: Run = run_units) -> Data:
    """Counts of chaotic orbits against ε, their exponents, what the phase volume does, and pictures; JSON data."""
    units = _units(quick)
    results = run([unit for _, unit in units])
    found: Data = {"seed": SEED, "samples": [], "lengths": [], "pictures": []}
    for (group, unit), result in zip(units, results, strict=True):
        arguments = {name: value for name, value in unit.arguments.items() if name not in ("seed", "points")}
        if group == "pictures":
            result = {"found": [{**o, "psi": packed(o["psi"]), "theta": packed(o["theta"])} for o in result]}
        found[group].append({**arguments, **result})
    return found


def _units(quick: bool) -> list[tuple[str, Unit]]:
    orbits, steps = (64, 4_000) if quick else (ORBITS, STEPS)
    epsilons = (0.3, 0.9, 2.0) if quick else EPSILONS

    def sample(J: tuple[float, ...], D: float, epsilon: float, near: bool, length: int) -> Unit:
        arguments = {"mass_tensor": list(J), "D": D, "epsilon": epsilon, "near": near, "orbits": orbits}
        return Unit(HERE + "sample", {**arguments, "steps": length, "seed": SEED})

    cases = product(BALLS[:3] if quick else BALLS, (False, True), epsilons)
    size = {"orbits": 30, "steps": 15_000, "points": 60} if quick else {"orbits": 56, "steps": 60_000, "points": 140}
    return [
        *(("samples", sample(J, D, epsilon, near, steps)) for (J, D), near, epsilon in cases),
        *(("lengths", sample(*VARIED, True, length)) for length in LENGTHS[: 2 if quick else 3]),
        *(("pictures", Unit(HERE + "picture", {**shown, **size})) for shown in PICTURES),
    ]


def sentences(found: Data) -> list[str]:
    """The findings, a line each."""
    control = [s for s in found["samples"] if s["D"] == 0]
    wrong, of = sum(s["chaotic"] for s in control), sum(s["counted"] for s in control)
    sentences = [f"D = 0, integrable: {wrong} of {of} orbits called chaotic (at most {share(of, wrong)[2]:.1e}, 95%)"]
    for near, where in ((False, "starts at random"), (True, "starts near the unstable rotation")):
        for J, D in sorted({(tuple(s["mass_tensor"]), s["D"]) for s in found["samples"] if s["D"] > 0}):
            runs = [s for s in found["samples"] if (tuple(s["mass_tensor"]), s["D"], s["near"]) == (J, D, near)]
            shares = ", ".join(f"ε {s['epsilon']:g}: {s['chaotic']}/{s['counted']}" for s in runs)
            sentences.append(f"J = {J}, D = {D:g}, {where}, chaotic of those with a step throughout: {shares}")
    for s in found["lengths"]:
        rate = s["wild"].get("exponent", [0.0])[0]
        sentences.append(f"{s['steps']} steps: {s['chaotic']}/{s['counted']} chaotic, mean exponent {rate:.4f} a step")
    last = found["lengths"][-1]
    regular, wild = last["regular"].get("volume"), last["wild"].get("volume")
    if regular is not None:
        sentences.append(
            f"phase volume, {last['steps']} steps: on regular orbits the average of log |det| is {regular:.1e} at most "
            f"(median {last['regular']['median_volume']:.1e})"
        )
    if wild is not None:
        sentences.append(
            f"phase volume: the average of log |det| on chaotic orbits, over all of them: {wild[0]:.1e} ± {wild[1]:.1e}"
        )
    return sentences
