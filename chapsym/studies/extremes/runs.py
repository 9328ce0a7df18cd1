"""Runs: a few steps beside a chain of the oracle's, alone and in a batch; orders, the way back; and long ones.

A run of n steps promises A Σ 4(1 + |q|κ) ulps: each step what a single one does, times A ≥ 1, by how much the run
stretches a small change of its start, measured on the oracle's own chain.
"""

from collections.abc import Callable, Sequence
from functools import cache
from typing import Any

import numpy as np

from chapsym.dynamics import BadInput, Ball, StepNotTaken, Trajectory, reverse, trajectory
from chapsym.dynamics.coefficients import COMPOSITIONS

from . import states
from .cells import BUDGET, FAILED, Compared, Judged, compared, worst
from .levels import Level, mp, number
from .steps import both, last_frame, refused
from .truth import State, Truth, Vector, truth

#: By how much the start is changed to see how a run stretches it, relatively.
CHANGE = mp.mpf(10) ** -40
#: And in this direction, which is none in particular.
DIRECTION = (1.0, -0.7, 0.4)
#: Balls of a batch: enough, with ten steps, for the loop over blocks of balls.
BATCH = 4096
STEPS = 10


@cache
def chain(state: State, stages: tuple[Any, ...]) -> list[Truth]:
    """The oracle's steps with the momenta cᵢ𝒦, one from the other; raises ArithmeticError where there is none."""
    steps: list[Truth] = []
    for c in stages:
        step = truth(State(state.J, state.D, tuple(c * mp.mpf(x) for x in state.K), state.g))
        if step is None:
            raise ArithmeticError("the oracle meets a fold on the way")
        steps.append(step)
        state = State(state.J, state.D, tuple(x / c for x in step.momentum), tuple(step.gamma))
    return steps


@cache
def promised(state: State, stages: tuple[Any, ...]) -> float:
    """A Σ 4(1 + |q|κ)."""
    steps = chain(state, stages)
    size = max(abs(mp.mpf(x)) for x in state.K)
    moved = tuple(mp.mpf(x) + CHANGE * size * part for x, part in zip(state.K, DIRECTION, strict=True))
    end = chain(State(state.J, state.D, moved, state.g), stages)[-1]
    gaps = [abs(a - b) / size for a, b in zip(end.momentum, steps[-1].momentum, strict=True)]
    gaps += [abs(a - b) for a, b in zip(end.gamma, steps[-1].gamma, strict=True)]
    stretch = max(1.0, float(max(gaps) / CHANGE))
    return stretch * sum(BUDGET * (1 + float(max(map(abs, step.q))) * step.condition) for step in steps)


def ends(
    level: Level, state: State, stages: tuple[Any, ...], run: Callable[[], tuple[Sequence[Any], Sequence[Any]]]
) -> Judged:
    """𝒦 and γ after a run beside the end of the oracle's chain."""
    exact = chain(state, stages)
    kappa = max(step.condition for step in exact)
    try:
        momentum, gamma = run()
    except (BadInput, StepNotTaken) as refusal:
        return refused(str(refusal), exact[-1])
    ulps = promised(state, stages)
    last = [x / stages[-1] for x in exact[-1].momentum]
    vectors = [Compared("the momentum", momentum, last, ulps), Compared("gamma", gamma, exact[-1].gamma, ulps, 1)]
    return compared(level, vectors, kappa)


def ball_of(state: State) -> Ball:
    """The ball of a state."""
    return Ball(state.J, state.D)


#: The states whose runs are judged.
def starts() -> dict[str, State]:
    """The states of the runs."""
    return {
        "generic": states.halfway(states.J, states.D),
        "tiny momentum": State(states.J, states.D, states.scaled(states.K, 1e-300), states.G),
        "at 0.8 of the fold": states.part(states.J, states.D, states.K, states.G, 0.8),
        "D = 1e6": states.halfway(states.J, 1e6),
        "D = 0": states.halfway(states.J, 0.0),
        "a flat body": states.halfway((0.0, 1.0, 2.0), states.D),
        "inertia 1e-15 apart": states.halfway((2.0, 2.0 * (1 + 1e-15), 2.0 * (1 - 1e-15)), states.D),
        "momentum vertical": states.halfway(states.J, states.D, states.G),
        "γ along an axis": states.halfway(states.J, states.D, states.K, states.AXIS),
    }


def ten_steps(start: str, level: Level, quick: bool, balls: int = 0) -> Judged:
    """Ten steps of `trajectory`, of one ball or of as many that are equal."""
    state = starts()[start]
    momentum = np.tile(state.K, (balls, 1)) if balls else state.K

    def run() -> tuple[Sequence[Any], Sequence[Any]]:
        return last_frame(trajectory(ball_of(state), momentum, state.g, STEPS, every=STEPS, precision=level.precision))

    return ends(level, state, (mp.one,) * STEPS, run)


def composed(start: str, level: Level, quick: bool) -> Judged:
    """A step of order 8, 4 when quick, beside the oracle's composition with the same decimal coefficients."""
    order = 4 if quick else 8
    state = starts()[start]
    if start == "at 0.8 of the fold":  # of that of the longest stage
        longest = max(abs(c) for c in COMPOSITIONS[order].exact)
        state = states.part(states.J, states.D, states.K, states.G, float(0.9 / longest))
    stages = tuple(number(c) for c in COMPOSITIONS[order].exact)
    return ends(
        level, state, stages,
        lambda: last_frame(trajectory(ball_of(state), state.K, state.g, 1, order=order, precision=level.precision)),
    )  # fmt: skip


def way_back(start: str, level: Level, quick: bool) -> Judged:
    """Ten steps and `reverse`: the start again, with the momentum reversed."""
    state, stages = starts()[start], (mp.one,) * STEPS
    there = trajectory(ball_of(state), state.K, state.g, STEPS, precision=level.precision)
    momentum, gamma = last_frame(reverse(there))
    ulps = 2 * promised(state, stages)
    first = [[number(x) for x in v] for v in (-there.momentum[0], there.gamma[0])]
    vectors = [Compared("the momentum", momentum, first[0], ulps), Compared("gamma", gamma, first[1], ulps, 1)]
    return compared(level, vectors, max(step.condition for step in chain(state, stages)))


#: Steps of the long runs, quick and full.
LENGTHS = {
    "single": (100_000, 100_000_000), "double": (100_000, 100_000_000), "quad": (10_000, 10_000_000),
    "Digits(50)": (100, 10_000), "Ball(200)": (100, 1000),
}  # fmt: skip
#: ⟨𝒦,γ⟩, |𝒦|² and |γ|² are put right every so many steps; in between sums are compensated, so that only the
#: roundings of their increments add up: half an ulp of the angle θ of a step each, like √n.  Pairs and the numbers
#: of any precision are summed as they are: half an ulp of the whole each.
RESTORED = 1024
COMPENSATED = ("single", "double")


def long_run(size: float, level: Level, quick: bool) -> Judged:
    """How far the integrals move in a long run with |𝒦| = size: in ulps of the precision."""
    steps = LENGTHS[level.name][0 if quick else 1]
    ball = Ball((0.1, 0.5, 1.6), 0.7)
    momentum = states.scaled(states.unit((0.3, -0.2, 0.35)), size)
    run = trajectory(ball, momentum, states.G, steps, every=max(1, steps // 100), precision=level.precision)
    if int(run.taken) != steps:
        return Judged(FAILED, reason=f"{run.taken} of {steps} steps were taken")
    rounded = angle(ball, momentum) if level.name in COMPENSATED else 1.0
    drift = BUDGET * (1 + rounded * RESTORED**0.5 / 2)
    first, moved = integrals(run, 0), []
    for frame in range(1, len(run.index)):
        now = integrals(run, frame)
        moved += [compared(level, [Compared(f"an integral after {run.index[frame]} steps", [b], [a], drift)])
                  for a, b in zip(first, now, strict=True)]  # fmt: skip
    return worst(moved)


def angle(ball: Ball, momentum: Vector) -> float:
    """A bound of the angle of a step, for a small momentum: |𝒦| over the least moment of inertia."""
    return float(np.sqrt(np.square(momentum).sum()) / ball.inertia.min())


def integrals(run: Trajectory, frame: int) -> list[Any]:
    """⟨𝒦,γ⟩, |𝒦|² and |γ|² of a frame, exactly."""
    K, g = run.momentum[frame], run.gamma[frame]
    if run.low is not None:
        K, g = both(K, run.low.momentum[frame]), both(g, run.low.gamma[frame])
    K, g = ([number(x) for x in v] for v in (K, g))
    return [sum(a * b for a, b in zip(x, y, strict=True)) for x, y in ((K, g), (K, K), (g, g))]
