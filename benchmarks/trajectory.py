"""One trajectory on one core: nanoseconds a step, chapsym and what a user might write."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np

import chapsym
from chapsym.dynamics.ball import numbers
from chapsym.dynamics.levels import frames
from chapsym.dynamics.levels.proved import lengths
from chapsym.files import Data

from . import peers
from .harness import NotComparable, Say
from .results import Reached, Result, beside, timed

#: The ball of the measurements in the project's notes, and a generic state of it: 𝒦/ε and γ.
MASS_TENSOR, D = np.array((0.1, 0.5, 1.6)), 0.7
MOMENTUM, GAMMA = np.array((6.0, -2.0, 3.0)) / 7, np.array((2.0, 3.0, 6.0)) / 7
EPSILONS = (0.05, 0.4)
CHAPSYM, ARRAYS, LISTS = "chapsym", "NumPy, arrays of 3", "Python floats"
#: Steps after which the peers are compared, and by how much they may differ: 64 roundings a step.
COMPARED = 100
AGREEMENT = COMPARED * 64 * 2.0**-53

Ends = tuple[np.ndarray, np.ndarray]
Peer = Callable[[np.ndarray, np.ndarray, np.ndarray, float, int], Ends]


def with_chapsym(K: np.ndarray, g: np.ndarray, J: np.ndarray, D: float, steps: int) -> Ends:
    """The public trajectory, of one ball or of a batch, of which only the end is kept."""
    end = chapsym.trajectory(chapsym.Ball(J, D), K, g, steps, every=max(steps, 1), threads=frames.cores())
    return end.momentum[..., -1, :], end.gamma[..., -1, :]


#: Each with the share of the steps that it takes: slow ones take 1/share.
SIDES: dict[str, tuple[Peer, int]] = {
    CHAPSYM: (with_chapsym, 1),
    LISTS: (peers.with_lists, 1000),
    ARRAYS: (peers.with_tuned_arrays, 10_000),
}


def agreement(sides: Mapping[str, Callable[[], Ends]], momentum: np.ndarray, bound: float) -> dict[str, float]:
    """The largest difference of each side's (K, g) from chapsym's, relative to |𝒦| and 1.

    Raises NotComparable where it is beyond `bound`.
    """
    ends = {name: [np.asarray(x) for x in side()] for name, side in sides.items()}
    size = np.linalg.norm(momentum, axis=-1, keepdims=True)
    home = ends[CHAPSYM]
    apart = {name: float(max(abs((K - home[0]) / size).max(), abs(g - home[1]).max())) for name, (K, g) in ends.items()}
    for name, difference in apart.items():
        if not difference <= bound:
            raise NotComparable(f"{name} differs from chapsym by {difference:.1e}, more than roundings: {bound:.1e}")
    return apart


#: A ball and its start: J, D, 𝒦, γ, in exact numbers or floats.
Start = tuple[Any, Any, Any, Any]


def measure(quick: bool, on_round: Say = lambda text: None, own: Start | None = None) -> Result:
    """Times one trajectory for each ε, or of one's own ball; every side is checked against chapsym before."""
    steps, rounds = (50_000, 5) if quick else (2_000_000, 21)
    rows: list[Data] = []
    reach: list[Reached] = []
    starts = [(MASS_TENSOR, D, epsilon * MOMENTUM, GAMMA) for epsilon in EPSILONS] if own is None else [own]
    for start in starts:
        J, contact, K, g = map(numbers, start, ("mass_tensor", "D", "momentum", "gamma"))
        epsilon, of = float(lengths(K)), (K, g, J, float(contact))
        differ = agreement({name: partial(side, *of, COMPARED) for name, (side, _) in SIDES.items()}, K, AGREEMENT)
        counts = {name: max(20, steps // share) for name, (_, share) in SIDES.items()}
        sides = {name: (partial(SIDES[name][0], *of, count), count) for name, count in counts.items()}
        timings = timed(sides, rounds, on_round, "one trajectory")
        rows += beside(timings, CHAPSYM, "ns a step", {"ε": epsilon}, differ)
        if own is None and not reach:
            ratio, *_ = timings[ARRAYS].ratio_to(timings[CHAPSYM])
            reach.append(Reached("NumPy arrays of 3 / chapsym", ratio, 1000, True))
    return Result("one trajectory, one core", rows, {}, reach)
