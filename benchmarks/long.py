"""Long runs: how the roundings of the integrals add up.

A sum of n independent roundings grows like √n (Brouwer's law): slope 1/2 in the figure.  A bias grows like n.
"""

import numpy as np

import chapsym

from .harness import Say
from .results import Curve, Reached, Result

EPSILONS = (0.05, 0.4)
SEED = 20075
#: Steps and balls.
FULL, QUICK = (100_000_000, 8), (1_000_000, 8)
#: States that are kept of a run: enough for their roundings to average out.
FRAMES = 100_000
#: The rms error in |𝒦|² and ⟨𝒦,γ⟩ below which chapsym's default is to stay, that of single states included.
WANTED = 3e-16


def rolled(
    K: np.ndarray, g: np.ndarray, J: np.ndarray, D: float, steps: int, every: int
) -> tuple[np.ndarray, np.ndarray]:
    """The states of the public trajectory, (frames, 3) each."""
    run = chapsym.trajectory(chapsym.Ball(J, D), K, g, steps, every=every)
    return run.momentum, run.gamma


def integrals(momenta: np.ndarray, verticals: np.ndarray, J: np.ndarray, D: float) -> dict[str, np.ndarray]:
    """The relative change of each integral in each frame, (frames,), in the long double of the machine.

    ⟨𝒦,γ⟩ and |𝒦|²; at D = 0, where the map is the discrete Euler top, ⟨𝒦, J²𝒦⟩ instead of the energy: with
    |𝒦|² it spans the coefficients of det(λ² - λ𝒦 - J²), which the top keeps.
    """
    K, g, weight = (x.astype(np.longdouble) for x in (momenta, verticals, J))
    square = (K * K).sum(axis=-1)
    values = {"|K|²": square / square[0] - 1}
    if D == 0:
        energy = (weight * weight * K * K).sum(axis=-1)
        return {**values, "energy, D = 0": energy / energy[0] - 1}
    height = (K * g).sum(axis=-1)
    return {**values, "<K,γ>": (height - height[0]) / np.sqrt(square[0])}


def octaves(change: np.ndarray, every: int) -> tuple[np.ndarray, np.ndarray]:
    """The mean of the change over the frames from n to 2n, for n = every, 2 every, ...: (mean step, mean change).

    Means, as a state that is rounded to float64 shows its integrals with a rounding of their own.
    """
    starts = 2 ** np.arange(int(np.log2(len(change) - 1)))
    return (3 * starts - 1) / 2 * every, np.array([np.mean(change[n : 2 * n]) for n in starts], dtype=float)


def slope(n: np.ndarray, rms: np.ndarray) -> float:
    """The slope of log rms over log n in the last two thirds of the octaves."""
    late = slice(len(n) // 3, None)
    return float(np.polyfit(np.log(n[late]), np.log(np.maximum(rms[late], 1e-30)), 1)[0])


def balls(count: int) -> list[tuple[np.ndarray, np.ndarray, np.ndarray, float]]:
    """Seeded balls: (𝒦/ε, γ, J, D), of which the second half has D = 0."""
    draw = np.random.default_rng(SEED)
    found = []
    for i in range(count):
        K, g = (v / np.linalg.norm(v) for v in draw.normal(size=(2, 3)))
        J, D = draw.uniform(0.5, 1.6, size=3), float(draw.uniform(0.2, 1.0))
        found.append((K, g, J, D if i < (count + 1) // 2 else 0.0))
    return found


def measure(quick: bool, on_round: Say = lambda text: None) -> Result:
    """The growth of the drifts over 10⁸ steps of 8 balls (quick: 10⁶), and their slopes."""
    steps, count = QUICK if quick else FULL
    chosen = balls(count)
    every = max(1, steps // FRAMES)
    rows, curves, reach = [], [], []
    for epsilon in EPSILONS:
        changes: dict[str, list[np.ndarray]] = {}
        states: dict[str, list[tuple[float, float]]] = {}
        for i, (K, g, J, D) in enumerate(chosen):
            on_round(f"{steps:.0e} steps, ε = {epsilon:g}: ball {i + 1} of {len(chosen)}")
            for name, change in integrals(*rolled(epsilon * K, g, J, D, steps, every), J, D).items():
                n, means = octaves(change, every)
                changes.setdefault(name, []).append(means)
                states.setdefault(name, []).append((float(np.mean(change * change)), float(abs(change).max())))
        for name, found in changes.items():
            rms = np.sqrt(np.mean(np.square(found), axis=0))
            squares, largest = np.transpose(states[name])
            of_states = float(np.sqrt(squares.mean()))
            rows.append({
                "ε": epsilon, "integral": name, "drift": float(rms[-1]), "slope": slope(n, rms),
                "rms of the states": of_states, "largest": float(largest.max()),
            })  # fmt: skip
            curves.append(Curve(name, f"chapsym, ε = {epsilon:g}", n.tolist(), rms.tolist()))
            if "energy" not in name:
                reach.append(Reached(f"rms of {name} in the states, ε = {epsilon:g}", of_states, WANTED, False))
    title = f"drifts of the integrals over {steps:.0e} steps: rms over the balls of the mean of the last octave"
    return Result(title, rows, {}, reach, curves)
