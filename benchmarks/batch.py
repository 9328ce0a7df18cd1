"""A batch of balls: nanoseconds a ball and step, on one core and on two."""

import time
from collections.abc import Callable
from functools import partial
from unittest.mock import patch

import numpy as np

import chapsym
from chapsym.dynamics.levels import double
from chapsym.studies.harness import Contender, available_cores, cores, interleaved

from . import batch_peers
from .results import Reached, Result, ratio_columns
from .trajectory import CHAPSYM, agreement

EPSILON = 0.05
SEED = 20074
NUMPY, COLUMNS, ROWS, LOOP = (
    "chapsym without numba",
    "NumPy by columns",
    "NumPy (n, 3), linalg.solve",
    "numba over rows, Newton in q",
)
#: The sides that use more than one core.
THREADED = (CHAPSYM, LOOP)
#: Steps after which the peers are compared, and by how much they may differ: 64 roundings a step.
COMPARED = 20
AGREEMENT = COMPARED * 64 * 2.0**-53

State = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]


def states(count: int, epsilon: float = EPSILON) -> State:
    """Seeded balls with |𝒦| = ε: (𝒦 (n, 3), γ (n, 3), J (n, 3), D (n,))."""
    draw = np.random.default_rng(SEED)
    K, g = (v / np.linalg.norm(v, axis=-1, keepdims=True) for v in draw.normal(size=(2, count, 3)))
    return epsilon * K, g, draw.uniform(0.3, 1.6, size=(count, 3)), draw.uniform(0.0, 1.0, size=count)


def with_chapsym(
    K: np.ndarray, g: np.ndarray, J: np.ndarray, D: np.ndarray, steps: int
) -> tuple[np.ndarray, np.ndarray]:
    """The public trajectory of a batch, of which only the end is kept."""
    end = chapsym.trajectory(chapsym.Ball(J, D), K, g, steps, every=max(steps, 1), threads=available_cores())
    return end.momentum[..., -1, :], end.gamma[..., -1, :]


def without_numba(
    K: np.ndarray, g: np.ndarray, J: np.ndarray, D: np.ndarray, steps: int
) -> tuple[np.ndarray, np.ndarray]:
    """The same where numba is missing: the engine then runs a batch in NumPy, by columns, from SHORT_RUN steps on."""
    with patch.object(double, "has_numba", lambda: False):
        return with_chapsym(K, g, J, D, steps)


#: Each with the share of the steps that it takes: slow ones take 1/share.
SIDES = {
    CHAPSYM: (with_chapsym, 1),
    NUMPY: (without_numba, 1),
    COLUMNS: (batch_peers.by_columns, 1),
    LOOP: (batch_peers.over_rows, 1),
    ROWS: (batch_peers.by_rows, 100),
}


def measure(quick: bool, on_round: Callable[[str], None] = lambda text: None) -> Result:
    """Times 10⁴ balls (quick: 2000) on one core and on two; every side is checked against chapsym before."""
    balls, steps, rounds = (2_000, 100, 3) if quick else (10_000, 3000, 7)
    K, g, J, D = states(balls)
    differ = agreement({name: partial(side, K, g, J, D, COMPARED) for name, (side, _) in SIDES.items()}, K, AGREEMENT)
    contenders = {
        (name, count): Contender(
            f"{name}, {count}",
            partial(_on, count, side, K, g, J, D, max(1, steps // share)),
            balls * max(1, steps // share),
            time.process_time if count == 1 else time.perf_counter,
        )
        for name, (side, share) in SIDES.items()
        for count in (1, 2)
        if count <= (available_cores() if name in THREADED else 1)
    }
    timed = interleaved(
        list(contenders.values()), rounds, lambda done: on_round(f"{balls} balls: round {done} of {rounds}")
    )
    timings = {key: timed[contender.name] for key, contender in contenders.items()}
    home = timings[CHAPSYM, 1]
    rows = [
        {
            "name": name,
            "cores": count,
            "ns a ball and step": timing.median * 1e9,
            **ratio_columns(timing, home, CHAPSYM),
        }
        | {"differs by": differ[name]}
        for (name, count), timing in timings.items()
    ]
    reach = [Reached("NumPy by columns / chapsym", timings[COLUMNS, 1].ratio_to(home)[0], 15, True)]
    reach.append(Reached("chapsym without numba, ns a ball and step", timings[NUMPY, 1].median * 1e9, 80, False))
    missing = {}
    if (CHAPSYM, 2) in timings:
        reach.append(Reached("chapsym: one core / two cores", home.ratio_to(timings[CHAPSYM, 2])[0], 1.8, True))
    else:
        missing["two cores"] = "this process may use one core only"
    return Result(f"a batch of {balls} balls", rows, missing, reach)


def _on(count: int, side: Callable[..., object], *arguments: object) -> None:
    with cores(count):
        side(*arguments)
