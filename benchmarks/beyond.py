"""Steps of any length: below the bound of lemma `small-branch`, and beyond it, where each step's root is proved."""

from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np

import chapsym
from chapsym.dynamics.loops import branch, gibbs, loop
from chapsym.studies.harness import Contender, cores, interleaved

from .batch import SEED
from .results import Reached, Result
from .trajectory import GAMMA, MASS_TENSOR, MOMENTUM, D

#: |𝒦|: the first is below the bound, which is about .48; the least fold of the batch is at about .64.
EPSILONS = (0.4, 0.5, 0.6, 0.8)
BALLS = 2000
#: What a step beyond the bound may cost, to one below it.
MOST = 2.5


def batch(epsilon: float) -> tuple[np.ndarray, np.ndarray]:
    """𝒦 (BALLS, 3) and γ near those of the one ball."""
    g = GAMMA + 0.3 * np.random.default_rng(SEED).normal(size=(BALLS, 3))
    return np.tile(epsilon * MOMENTUM, (BALLS, 1)), g / np.linalg.norm(g, axis=1, keepdims=True)


def rolled(K: np.ndarray, g: np.ndarray, steps: int) -> chapsym.Trajectory:
    """The public trajectory, of which only the end is kept."""
    return chapsym.trajectory(chapsym.Ball(MASS_TENSOR, D), K, g, steps, every=steps, threads=1)


def to_the_fold(epsilon: float) -> float:
    """|𝒦| beside that of the fold, at the first step."""
    far = 10.0 * MOMENTUM, GAMMA, MASS_TENSOR, [D]
    _, reach, *_ = branch.small_rotation(*(x for vector in far for x in vector))
    return epsilon / (10.0 * reach)


def within(epsilon: float) -> bool:
    """Whether lemma `small-branch` holds."""
    state = np.empty(loop.ROWS)
    loop.scaled(epsilon * MOMENTUM, GAMMA, MASS_TENSOR, D, state)
    return bool(state[loop.RADIUS] != gibbs.BEYOND)


def measure(quick: bool, on_round: Callable[[str], None] = lambda text: None) -> Result:
    """Times one ball and a batch at each |𝒦|."""
    alone, together, rounds = (20_000, 40, 3) if quick else (500_000, 300, 21)
    on_round("one ball and a batch, below the bound and beyond")
    contenders = []
    for epsilon in EPSILONS:
        K, g = batch(epsilon)
        contenders += [
            Contender(f"one {epsilon}", partial(rolled, epsilon * MOMENTUM, GAMMA, alone), alone),
            Contender(f"batch {epsilon}", partial(rolled, K, g, together), together * BALLS),
        ]
    with cores(1):
        timings = interleaved(contenders, rounds)
    rows: list[dict[str, Any]] = []
    reach = []
    for epsilon in EPSILONS:
        row: dict[str, Any] = {"|𝒦|": epsilon, "of the fold": to_the_fold(epsilon), "by small-branch": within(epsilon)}
        for name, text in (("one", "one ball"), ("batch", "a ball of a batch")):
            ratio, lower, upper = timings[f"{name} {epsilon}"].ratio_to(timings[f"{name} {EPSILONS[0]}"])
            row |= {f"{text}: ns a step": timings[f"{name} {epsilon}"].median * 1e9, f"{text}: ratio": ratio}
            row[f"{text}: quartiles"] = [lower, upper]
            if epsilon != EPSILONS[0]:
                reach.append(Reached(f"{text}, |𝒦| = {epsilon:g} / {EPSILONS[0]:g}", ratio, MOST, False))
        rows.append(row)
    return Result("steps of any length, one core", rows, {}, reach)
