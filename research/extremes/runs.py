"""Runs: a few steps beside a chain of the oracle's, alone and in a batch; orders, the way back; and long ones."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from chapsym.dynamics import Ball, Trajectory, extrapolate, reverse, trajectory
from chapsym.dynamics.coefficients import COMPOSITIONS
from chapsym.dynamics.extrapolation import weights

from . import states
from .formulas import angular_velocity
from .judging import BUDGET, FAILED, Compared, Judged, Level, compared, mp, number, unless_refused, whole, worst
from .steps import state_vectors
from .truth import State, chain, promised, rotation_matrix, scaled

#: Balls of a batch: enough, with ten steps, for the loop over blocks of balls.
BATCH = 4096
STEPS = 10
TEN = (mp.one,) * STEPS
#: ⟨𝒦,γ⟩, |𝒦|² and |γ|² are put right every so many steps; in between sums are compensated, so that only the
#: roundings of their increments add up: half an ulp of the angle θ of a step each, like √n.  Pairs and the numbers
#: of any precision are summed as they are: half an ulp of the whole each.
RESTORED = 1024


def ends(level: Level, state: State, stages: tuple[Any, ...], run: Callable[[], Trajectory]) -> Judged:
    """𝒦 and γ after a run, of one ball or the first of a batch, beside the end of the oracle's chain."""
    exact, ulps = chain(state, stages), promised(state, stages)
    kappa = max(step.condition for step in exact)
    momentum = [x / stages[-1] for x in exact[-1].momentum]

    def judged() -> Judged:
        found = run()
        last = [
            array.reshape(-1, *array.shape[-2:])[0, -1] for array in (whole(found, "momentum"), whole(found, "gamma"))
        ]
        return compared(level, kappa, *state_vectors(last, momentum, exact[-1].gamma, ulps))

    return unless_refused(kappa, judged)


def ten_steps(state: State, level: Level, quick: bool, balls: int = 0) -> Judged:
    """Ten steps of `trajectory`, of one ball or of as many that are equal."""
    momentum = np.tile(state.K, (balls, 1)) if balls else state.K
    options: dict[str, Any] = {"every": STEPS, "precision": level.precision}
    return ends(level, state, TEN, lambda: trajectory(state.ball, momentum, state.g, STEPS, **options))


def composed(item: State | Callable[[int], State], level: Level, quick: bool) -> Judged:
    """A step of order 8, 4 when quick, beside the oracle's composition with the same decimal coefficients."""
    order = 4 if quick else 8
    state = item(order) if callable(item) else item
    stages = tuple(number(c) for c in COMPOSITIONS[order].exact)
    options: dict[str, Any] = {"order": order, "precision": level.precision}
    return ends(level, state, stages, lambda: trajectory(state.ball, state.K, state.g, 1, **options))


def near_its_fold(order: int) -> State:
    """The state whose longest stage is at 0.9 of the fold."""
    longest = max(abs(c) for c in COMPOSITIONS[order].exact)
    return states.part(states.J, states.D, states.K, states.G, float(0.9 / longest))


def way_back(state: State, level: Level, quick: bool) -> Judged:
    """Ten steps and `reverse`: the start again, with the momentum reversed."""
    there = trajectory(state.ball, state.K, state.g, STEPS, precision=level.precision)
    back = reverse(there)
    momentum, gamma = ([number(x) for x in v] for v in (-there.momentum[0], there.gamma[0]))
    kappa = max(step.condition for step in chain(state, TEN))
    last = back.momentum[-1], back.gamma[-1]
    return compared(level, kappa, *state_vectors(last, momentum, gamma, 2 * promised(state, TEN)))


def long_run(size: float, level: Level, quick: bool) -> Judged:
    """How far the integrals move in a long run with |𝒦| = size: in ulps of the precision."""
    steps = level.long[0 if quick else 1]
    ball = Ball((0.1, 0.5, 1.6), 0.7)
    momentum = scaled(states.unit((0.3, -0.2, 0.35)), size)
    run = trajectory(ball, momentum, states.G, steps, every=max(1, steps // 100), precision=level.precision)
    if int(run.taken) != steps:
        return Judged(FAILED, reason=f"{run.taken} of {steps} steps were taken")
    # a bound of the angle of a step, as the momentum is small
    angle = float(np.linalg.norm(momentum) / ball.inertia.min()) if level.compensated else 1.0
    drift = BUDGET * (1 + angle * RESTORED**0.5 / 2)
    first, *later = integrals(run)
    return worst([
        compared(level, None, Compared(f"an integral after {steps_done} steps", [now], [start], drift))
        for steps_done, frame in zip(run.index[1:], later, strict=True)
        for start, now in zip(first, frame, strict=True)
    ])  # fmt: skip


def integrals(run: Trajectory) -> list[list[Any]]:
    """⟨𝒦,γ⟩, |𝒦|² and |γ|² of each frame, exactly."""
    frames = zip(whole(run, "momentum"), whole(run, "gamma"), strict=True)
    exact = [([number(x) for x in K], [number(x) for x in g]) for K, g in frames]
    return [[sum(a * b for a, b in zip(*pair, strict=True)) for pair in ((K, g), (K, K), (g, g))] for K, g in exact]


@cache
def long_step(state: State, columns: int) -> tuple[list[Any], list[Any], float, float]:
    """𝒦 and γ after one extrapolated step of the oracle's rotations, the ulps that are promised, and κ."""
    spin = mp.norm(mp.matrix(angular_velocity([*map(mp.mpf, (*state.K, *state.g, *state.J, state.D))])))
    total, ulps, kappa = [mp.zero] * 4, BUDGET, 1.0
    for n, w in enumerate(weights(columns), 8 - columns):
        stages = (mp.sin(spin / n) / spin,) * n  # fitted to steady rotation
        product = [mp.one, mp.zero, mp.zero, mp.zero]
        for one in chain(state, stages):
            product = _compose(product, [one.q0, *one.q])
            kappa = max(kappa, one.condition)
        total = [a + number(w) * b for a, b in zip(total, product, strict=True)]
        ulps += abs(float(w)) * promised(state, stages)
    length = mp.sqrt(sum(x * x for x in total))
    back = rotation_matrix(mp, [x / length * sign for x, sign in zip(total, (1, -1, -1, -1), strict=True)])
    return list(back * mp.matrix(state.K)), list(back * mp.matrix(state.g)), ulps, kappa


def _compose(p: Sequence[Any], q: Sequence[Any]) -> list[Any]:
    a, b, c, d = p
    e, f, g, h = q
    return [
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    ]


def extrapolated(state: State, level: Level, quick: bool) -> Judged:
    """One long step of `extrapolate`."""
    columns = 3 if quick else 6
    momentum, gamma, ulps, kappa = long_step(state, columns)

    def judged() -> Judged:
        found = extrapolate(state.ball, state.K, state.g, 1.0, 1, columns=columns)
        return compared(level, kappa, *state_vectors((found.angular_momentum, found.gamma), momentum, gamma, ulps))

    return unless_refused(None, judged)


def _long(start: str, size: float) -> list[State]:
    state = states.STARTS[start]
    return [replace(state, K=scaled(state.K, size))]


#: Long steps, at a part of the momentum of their start: short enough that the sine is its series.
LONG = {
    name: _long(name, size)
    for name, size in {
        "generic": 0.2, "tiny momentum": 1.0, "D = 1e6": 0.2, "a flat body": 0.2, "γ along an axis": 0.2,
    }.items()
}  # fmt: skip
