"""The reduced map G_h, folds searched for, and long steps that are extrapolated: beside the oracle."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np

from chapsym.dynamics import BadInput, StepNotTaken, extrapolate, fold, step_vertical
from chapsym.dynamics.extrapolation import weights

from . import states
from .cells import BUDGET, FAILED, Compared, Judged, compared, worst
from .derived import angular_velocity
from .folds import fold_at
from .levels import Level, mp, number
from .runs import ball_of, chain, promised, starts
from .steps import beside, refused
from .truth import State, componentwise, truth, unit_gamma


def _vertical(J: tuple[float, float, float], D: float, g: tuple[float, float, float], share: float) -> State:
    return states.part(J, D, g, g, share)


#: States whose momentum is h γ; only ⟨𝒦,γ⟩ = h is taken from them.
VERTICAL: dict[str, Callable[[], list[State]]] = {
    "generic": lambda: [_vertical(states.J, states.D, states.G, share) for share in (0.01, 0.5, 0.9)],
    "h 1e-300": lambda: [State(states.J, states.D, states.scaled(states.G, 1e-300), states.G)],
    "h 5e-320": lambda: [State(states.J, states.D, states.scaled(states.AXIS, 5e-320), states.AXIS)],
    "1e-6 before the fold": lambda: [_vertical(states.J, states.D, states.G, 1 - 1e-6)],
    "D = 0": lambda: [_vertical(states.J, 0.0, states.G, 0.5)],
    "D = 1e6": lambda: [_vertical(states.J, 1e6, states.G, 0.5), _vertical(states.J, 1e6, states.AXIS, 0.5)],
    "D = 1e12": lambda: [_vertical(states.J, 1e12, states.G, 0.5), _vertical(states.J, 1e12, states.AXIS, 0.5)],
    "inertia 1e-15 apart": lambda: [_vertical((2.0, 2.0 * (1 + 1e-15), 2.0 * (1 - 1e-15)), 3.0, states.G, 0.5)],
    "a flat body": lambda: [_vertical((0.0, 1.0, 2.0), 3.0, states.G, 0.5)],
    "ratios of 1e12": lambda: [_vertical((1e-12, 1e-6, 1.0), 1.0, states.G, 0.5)],
    "γ along an axis": lambda: [_vertical(states.J, states.D, states.AXIS, 0.5)],
}


def vertical(condition: str, level: Level, quick: bool) -> Judged:
    """One step of `step_vertical`, judged as one of `step`."""

    def one(state: State) -> Judged:
        height = float(np.dot(state.K, state.g))
        exact = truth(State(state.J, state.D, tuple(mp.mpf(height) * x for x in unit_gamma(state.g)), state.g))
        try:
            found = step_vertical(ball_of(state), height, state.g)
        except (BadInput, StepNotTaken) as refusal:
            return refused(str(refusal), exact)
        if exact is None:
            return Judged(FAILED, reason="a rotation is given where the branch has folded: there is none")
        return beside(level, (found.rotation[1:], found.momentum, found.gamma), exact)

    return worst([one(state) for state in VERTICAL[condition]()])


#: Balls and directions whose folds are searched for, and how much larger the momentum is that is given.
FOLDS: dict[str, tuple[State, float]] = {
    "generic": (State(states.J, states.D, states.K, states.G), 1.0),
    "momentum 1e-300": (State(states.J, states.D, states.K, states.G), 1e-300),
    "momentum 1e300": (State(states.J, states.D, states.K, states.G), 1e300),
    "D = 0": (State(states.J, 0.0, states.K, states.G), 1.0),
    "D = 1e3": (State(states.J, 1e3, states.K, states.G), 1.0),
    "D = 1e6": (State(states.J, 1e6, states.K, states.G), 1.0),
    "a flat body": (State((0.0, 1.0, 2.0), states.D, states.K, states.G), 1.0),
    "γ along an axis": (State(states.J, states.D, states.K, states.AXIS), 1.0),
    "momentum and γ along an axis": (State(states.J, states.D, states.AXIS, states.AXIS), 1.0),
}
#: `fold_at` has 40 digits: half of them are left to a difference.
DIFFERENCE = mp.mpf(10) ** -15


def fold_search(condition: str, level: Level, quick: bool) -> Judged:
    """`fold`: the t at which the branch along t𝒦 folds."""
    state, size = FOLDS[condition]
    found = fold(ball_of(state), states.scaled(state.K, size), state.g)
    if not np.isfinite(found.reach):
        return Judged(FAILED, reason="the reach is NaN, and nothing says why")

    def at(x: Sequence[Any]) -> list[Any]:
        return [mp.make_mpf(fold_at(tuple(x[6:9]), x[9], tuple(x[:3]), tuple(x[3:6]))._mpf_)]

    exact, kappa = componentwise(at, (*state.K, *state.g, *state.J, state.D), DIFFERENCE)
    told = compared(
        level, [Compared("the reach", [number(found.reach) * mp.mpf(size)], exact, BUDGET * (1 + kappa))], kappa
    )
    if told.verdict == FAILED and not found.settled:
        return refused("Newton settles on no simple fold: `settled` is False, and the reach a lower bound", None)
    return told


#: Long steps, in units of half the reach of their state: short enough that the sine is its series.
LONG = {"generic": 0.2, "tiny momentum": 1.0, "D = 1e6": 0.2, "a flat body": 0.2, "γ along an axis": 0.2}


@cache
def long_step(start: str, columns: int) -> tuple[State, list[Any], list[Any], float, float]:
    """The state, 𝒦 and γ after one extrapolated step of the oracle's rotations, ulps promised, and κ."""
    state = starts()[start]
    state = replace(state, K=states.scaled(state.K, LONG[start]))
    spin = mp.norm(mp.matrix(angular_velocity([*map(mp.mpf, (*state.K, *state.g, *state.J)), mp.mpf(state.D)])))
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
    back = [x / length * sign for x, sign in zip(total, (1, -1, -1, -1), strict=True)]
    return state, _turned(back, state.K), _turned(back, state.g), ulps, kappa


def _compose(p: Sequence[Any], q: Sequence[Any]) -> list[Any]:
    a, b, c, d = p
    e, f, g, h = q
    return [
        a * e - b * f - c * g - d * h,
        a * f + b * e + c * h - d * g,
        a * g - b * h + c * e + d * f,
        a * h + b * g - c * f + d * e,
    ]


def _turned(q: Sequence[Any], v: Sequence[Any]) -> list[Any]:
    opposite = [q[0], *(-x for x in q[1:])]
    return _compose(_compose(q, [mp.zero, *map(mp.mpf, v)]), opposite)[1:]


def extrapolated(start: str, level: Level, quick: bool) -> Judged:
    """One long step of `extrapolate`."""
    columns = 3 if quick else 6
    state, K, g, ulps, kappa = long_step(start, columns)
    try:
        found = extrapolate(ball_of(state), state.K, state.g, 1.0, 1, columns=columns)
    except (BadInput, StepNotTaken) as refusal:
        return refused(str(refusal), None)
    vectors = [
        Compared("the momentum", found.angular_momentum, K, ulps),
        Compared("gamma", found.gamma, g, ulps, 1),
    ]
    return compared(level, vectors, kappa)
