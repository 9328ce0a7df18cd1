"""The savings of each reduction: its time and that of the full model, for every frame and for a few far ones."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np

import chapsym
from chapsym.dynamics import TopMotion
from chapsym.files import Data

from .harness import NotComparable, Say
from .results import Reached, Result, ratio_columns, timed

FULL = "full model"
MOMENTUM, GAMMA = np.array((6.0, -2.0, 3.0)) / 7, np.array((2.0, 3.0, 6.0)) / 7
#: |𝒦|, with moments of about 2.
EPSILON = 0.05
BATCH = 1000
#: How far the ends of the two may be apart: n^(3/2) roundings, which the full model makes.
ROUNDING = 2.0**-50

Run = Callable[..., np.ndarray]
Frames = Callable[..., chapsym.Trajectory]


@dataclass(frozen=True)
class Pair:
    """A reduction and the full model on the same states: both take (steps, every) and return 𝒦 or γ at the end."""

    name: str
    reduced: Run
    full: Run
    balls: int = 1


def _ball(J: tuple[float, float, float], D: float, balls: int = 1) -> chapsym.Ball:
    tensor = np.array(J) if balls == 1 else np.tile(J, (balls, 1)) * np.linspace(1, 2, balls)[:, np.newaxis]
    return chapsym.Ball(tensor, D, radius=0.1)


def _full(ball: chapsym.Ball, K: np.ndarray, steps: int, every: int, **body: bool) -> np.ndarray:
    return chapsym.trajectory(ball, K, GAMMA, steps, every=every, threads=1, **body).momentum[..., -1, :]  # type: ignore[arg-type]


def _at_once(frames: Frames, ball: chapsym.Ball, K: np.ndarray, steps: int, every: int, **body: bool) -> np.ndarray:
    return frames(ball, K, GAMMA, range(0, steps + 1, every), **body).momentum[..., -1, :]


def pairs() -> list[Pair]:
    """Every reduction with the full model that it replaces."""
    K, up = EPSILON * MOMENTUM, EPSILON * GAMMA
    steady, tops = partial(_at_once, chapsym.steady_frames), partial(_at_once, chapsym.top_frames)
    equal, many = _ball((1, 1, 1), 0.7), _ball((1, 1, 1), 0.7, BATCH)
    top, round_top = _ball((0.1, 0.5, 1.6), 0.0), _ball((0.5, 0.5, 1.6), 0.7)
    return [
        Pair("equal J: 𝒦, γ", partial(steady, equal, K), partial(_full, equal, K)),
        Pair("equal J: with the contact point", partial(steady, equal, K, contact=True),
             partial(_full, equal, K, contact=True)),
        Pair(f"equal J: 𝒦, γ, {BATCH} balls", partial(steady, many, K), partial(_full, many, K), BATCH),
        Pair("top: 𝒦 at once", lambda steps, every: TopMotion.free(top, K).momenta(range(0, steps + 1, every))[-1],
             partial(_full, top, K)),
        Pair("top: 𝒦 step by step (G_h)", lambda steps, every: chapsym.trajectory_vertical(
             top, EPSILON, MOMENTUM, steps, every=every).momentum[-1], partial(_full, top, K)),
        Pair("top: 𝒦, γ, attitude at once", partial(tops, top, K, attitude=True),
             partial(_full, top, K, attitude=True)),
        Pair("two equal J, vertical 𝒦: at once", partial(tops, round_top, up), partial(_full, round_top, up)),
    ]  # fmt: skip


def measure(quick: bool, on_round: Say = lambda text: None) -> Result:
    """Times each reduction and the full model, all frames and 1 of 1000; their ends are compared before."""
    rounds = 5 if quick else 15
    rows: list[Data] = []
    for pair in pairs():
        # The two ways to ask: every frame of a short run, few of a long one.
        for steps, every in ((100, 1), (2000, 1)) if pair.balls > 1 else ((1000, 1), (20_000, 1)):
            rows.append(_row(pair, steps, every, rounds, on_round))
        steps = (2_000 if pair.balls > 1 else 100_000) * (1 if quick else 10)
        rows.append(_row(pair, steps, steps // 10, rounds, on_round))
    few = [row for row in rows if row["steps"] > 20 * row["frames"]]
    reach = [Reached(f"{row['name']}, few frames: to the full model", row[f"to {FULL}"], 1.0, False) for row in few]
    return Result("the reductions and the full model, one core", rows, reach=reach)


def _row(pair: Pair, steps: int, every: int, rounds: int, on_round: Say) -> Data:
    ends = [side(steps, every) for side in (pair.reduced, pair.full)]
    apart = float(np.abs(ends[0] - ends[1]).max() / EPSILON)
    if not apart <= ROUNDING * steps**1.5:
        raise NotComparable(f"{pair.name} differs from the full model by {apart:.1e} after {steps} steps")
    sides = {name: (partial(side, steps, every), 1) for name, side in (("reduced", pair.reduced), (FULL, pair.full))}
    reduced, full = timed(sides, rounds, on_round, pair.name).values()
    return {
        "name": pair.name, "steps": steps, "frames": steps // every + 1, "ms": reduced.median * 1e3,
        f"{FULL}, ms": full.median * 1e3, **ratio_columns(reduced, full, FULL), "differs by": apart,
    }  # fmt: skip
