"""Runs: a few steps against a chain of the oracle's, alone and in a batch; orders, the way back; and long ones."""

from collections.abc import Callable

import numpy as np

from chapsym import generated
from chapsym.dynamics import Ball, Trajectory, reverse, trajectory
from chapsym.dynamics.coefficients import COMPOSITIONS

from . import states
from .judging import BUDGET, FAILED, Judged, Level, compared, mp, number, state, whole, worst
from .truth import State, Vector, chain, promised, scaled

#: Balls of a batch: enough, with ten steps, for the loop over blocks of balls.
BATCH = 4096
STEPS = 10
TEN = (mp.one,) * STEPS
#: ⟨𝒦,γ⟩, |𝒦|² and |γ|² are restored after this many steps; in between sums are compensated, so that only the
#: roundings of their increments add up: half an ulp of the angle θ of a step each, like √n.  Pairs and the numbers
#: of any precision are summed as they are: half an ulp of the whole each.
RESTORED = 1024


def ends(level: Level, given: State, stages: Vector, run: Trajectory) -> Judged:
    """𝒦 and γ after a run, of one ball or the first of a batch, compared with the end of the oracle's chain."""
    exact = chain(given, stages)
    last = [whole(run, name) for name in ("momentum", "gamma")]
    found = [array.reshape(-1, *array.shape[-2:])[0, -1] for array in last]
    end = [x / stages[-1] for x in exact[-1].momentum], exact[-1].gamma
    return state(level, max(one.condition for one in exact), found, end, promised(given, stages))


def ten_steps(given: State, level: Level, quick: bool, balls: int = 0) -> Judged:
    """Ten steps of `trajectory`, of one ball or of as many that are equal."""
    momentum = np.tile(given.K, (balls, 1)) if balls else given.K
    run = trajectory(given.ball, momentum, given.g, STEPS, every=STEPS, precision=level.precision)
    return ends(level, given, TEN, run)


def composed(item: State | Callable[[int], State], level: Level, quick: bool) -> Judged:
    """A step of order 8, 4 when quick, compared with the oracle's composition with the same decimal coefficients."""
    order = 4 if quick else 8
    given = item(order) if callable(item) else item
    stages = tuple(number(c) for c in COMPOSITIONS[order].exact)
    run = trajectory(given.ball, given.K, given.g, 1, order=order, precision=level.precision)
    return ends(level, given, stages, run)


def near_its_fold(order: int) -> State:
    """The state whose longest stage is at 0.9 of the fold."""
    longest = max(abs(c) for c in COMPOSITIONS[order].exact)
    return states.part(states.J, states.D, states.K, states.G, float(0.9 / longest))


def way_back(given: State, level: Level, quick: bool) -> Judged:
    """Ten steps and `reverse`: the start again, with the momentum reversed."""
    there = trajectory(given.ball, given.K, given.g, STEPS, precision=level.precision)
    back = reverse(there)
    start = [[number(x) for x in v] for v in (-there.momentum[0], there.gamma[0])]
    kappa = max(one.condition for one in chain(given, TEN))
    return state(level, kappa, (back.momentum[-1], back.gamma[-1]), start, 2 * promised(given, TEN))


def long_run(size: float, level: Level, quick: bool) -> Judged:
    """How far ⟨𝒦,γ⟩, |𝒦|² and |γ|² move in a long run with |𝒦| = size: in ulps of the precision."""
    steps = level.long[0 if quick else 1]
    ball, momentum = Ball((0.1, 0.5, 1.6), 0.7), scaled(states.unit((0.3, -0.2, 0.35)), size)
    run = trajectory(ball, momentum, states.G, steps, every=max(1, steps // 100), precision=level.precision)
    if int(run.taken) != steps:
        return Judged(FAILED, reason=f"{run.taken} of {steps} steps were taken")
    # a bound of the angle of a step, as the momentum is small
    angle = float(np.linalg.norm(momentum) / ball.inertia.min()) if level.compensated else 1.0
    drift = BUDGET * (1 + angle * RESTORED**0.5 / 2)
    frames = zip(whole(run, "momentum"), whole(run, "gamma"), strict=True)
    first, *later = [generated.invariants(*(number(x) for v in frame for x in v)) for frame in frames]
    return worst([
        compared(level, None, f"an integral after {done} steps", [now], [start], drift)
        for done, frame in zip(run.index[1:], later, strict=True)
        for start, now in zip(first, frame, strict=True)
    ])  # fmt: skip
