"""A batch of balls: nanoseconds a ball and step, on one core and on two."""

import time
from collections.abc import Callable
from functools import partial

import numpy as np

from chapsym.dynamics.levels import frames

from . import peers
from .harness import Contender, Say, cores, interleaved
from .results import Reached, Result, beside
from .trajectory import CHAPSYM, agreement, with_chapsym

EPSILON = 0.05
SEED = 20074
COLUMNS, TWO = "NumPy by columns", f"{CHAPSYM}, 2 cores"
#: Steps after which the peers are compared, and by how much they may differ: 64 roundings a step.
COMPARED = 20
AGREEMENT = COMPARED * 64 * 2.0**-53

State = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]


def states(count: int, epsilon: float = EPSILON) -> State:
    """Seeded balls with |𝒦| = ε: (𝒦 (n, 3), γ (n, 3), J (n, 3), D (n,))."""
    draw = np.random.default_rng(SEED)
    K, g = (v / np.linalg.norm(v, axis=-1, keepdims=True) for v in draw.normal(size=(2, count, 3)))
    return epsilon * K, g, draw.uniform(0.3, 1.6, size=(count, 3)), draw.uniform(0.0, 1.0, size=count)


#: Each takes (K, g, J, D, steps) and returns the last (K, g).
SIDES = {CHAPSYM: with_chapsym, COLUMNS: peers.by_columns}


def measure(quick: bool, on_round: Say = lambda text: None) -> Result:
    """Times 10⁴ balls (quick: 2000) on one core and on two; every side is checked against chapsym before."""
    balls, steps, rounds = (2_000, 100, 3) if quick else (10_000, 3000, 7)
    state = states(balls)
    differ = agreement({name: partial(side, *state, COMPARED) for name, side in SIDES.items()}, state[0], AGREEMENT)
    kinds = {f"{name}, 1 core": (name, 1, time.process_time) for name in SIDES}
    if frames.cores() > 1:
        kinds[TWO] = CHAPSYM, 2, time.perf_counter
    contenders = [
        Contender(title, partial(_on, count, SIDES[name], *state, steps), balls * steps, clock)
        for title, (name, count, clock) in kinds.items()
    ]
    timings = interleaved(contenders, rounds, lambda done: on_round(f"{balls} balls: round {done} of {rounds}"))
    home = timings[f"{CHAPSYM}, 1 core"]
    apart = {title: differ[name] for title, (name, *_) in kinds.items()}
    rows = beside(timings, home.name, "ns a ball and step", {}, apart, CHAPSYM)
    reach = [Reached(f"{COLUMNS} / chapsym", timings[f"{COLUMNS}, 1 core"].ratio_to(home)[0], 15, True)]
    if TWO not in timings:
        return Result(f"a batch of {balls} balls", rows, {"two cores": "this process may use one core only"}, reach)
    reach.append(Reached("chapsym: one core / two cores", home.ratio_to(timings[TWO])[0], 1.8, True))
    return Result(f"a batch of {balls} balls", rows, {}, reach)


def _on(count: int, side: Callable[..., object], *arguments: object) -> None:
    with cores(count):
        side(*arguments)
