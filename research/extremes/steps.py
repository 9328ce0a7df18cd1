"""One step, judged by the oracle: the rotation within 4κ ulps, 𝒦 and γ within 4(1 + |q|κ); and where a branch folds."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from chapsym.dynamics import BadInput, BallN, Status, StepNotTaken, fold, step, step_n, step_vertical
from chapsym.dynamics.oracle import Oracle

from .judging import (
    BUDGET,
    FAILED,
    NO_DIGIT,
    Compared,
    Judged,
    Level,
    compared,
    mp,
    number,
    refused,
    unless_refused,
    whole,
)
from .truth import State, Truth, componentwise, fold_at, reachable, scaled, truth, truth_n, unit_gamma

#: Beyond this share of a rounding from the fold, a precision cannot tell the two sides.
BLUR = BUDGET
#: A state whose κ ulps are below this has half its digits and more at any precision: then it can be resolved.
RESOLVED = 1e-6
#: `fold_at` has 40 digits: half of them are left to a difference.
DIFFERENCE = mp.mpf(10) ** -15

#: q, 𝒦 and γ in the numbers of a precision.
Found = tuple[Any, Any, Any]


def taken(level: Level, state: State) -> Found:
    """q, 𝒦 and γ after the step, in the numbers of the precision; raises BadInput and StepNotTaken."""
    found = step(state.ball, state.K, state.g, precision=level.precision)
    return whole(found, "rotation")[1:], whole(found, "momentum"), whole(found, "gamma")


def judge(state: State | Callable[[Level], State], level: Level, quick: bool) -> Judged:
    """The step of one state."""
    state = state(level) if callable(state) else state
    exact = truth(state)
    kappa = exact.condition if exact else None
    try:
        found = taken(level, state)
    except BadInput as refusal:
        return refused(str(refusal), kappa)
    except StepNotTaken as refusal:
        lie = _lie(refusal.status, level, state, exact)
        if lie and exact and exact.condition * level.unit > NO_DIGIT:
            told = f"rounded to it this is another state, as κ = {exact.condition:.2g}, of which it says: {refusal}"
            return refused(told, kappa)
        return Judged(FAILED, condition_number=kappa, reason=lie) if lie else refused(str(refusal), kappa)
    if exact is None and blurred(level, state):  # right for a momentum that is less than a rounding smaller
        exact = truth(mirrored(state))
    return beside(level, found, exact)


def beside(level: Level, found: Found, exact: Truth | None) -> Judged:
    """q, 𝒦 and γ beside the truth; a precision with guard digits promises as if κ were 1."""
    if exact is None:
        return Judged(FAILED, reason="a rotation is given where the branch has folded: there is none")
    kappa = 1.0 if level.guarded else exact.condition
    q, extent = exact.q, float(max(map(abs, exact.q)))
    turned = sum(number(a) * b for a, b in zip(found[0], q, strict=True)) < 0
    if turned and exact.q0 <= BUDGET * kappa * number(level.unit):
        q = [-x for x in q]  # a rotation by π, to rounding: q and -q are the same, and q₀ ≥ 0 does not tell
    moved = BUDGET * (1.0 + extent * kappa)
    return compared(
        level, exact.condition, Compared("the rotation", found[0], q, BUDGET * kappa),
        *state_vectors(found[1:], exact.momentum, exact.gamma, moved),
    )  # fmt: skip


def state_vectors(found: Sequence[Any], momentum: Sequence[Any], gamma: Sequence[Any], ulps: float) -> list[Compared]:
    """𝒦 and γ beside the truth, with one promise."""
    return [Compared("the momentum", found[0], momentum, ulps), Compared("gamma", found[1], gamma, ulps, 1)]


def _lie(status: Status, level: Level, state: State, exact: Truth | None) -> str:
    """What is not true of a refusal, or nothing."""
    out_of_reach = status in (Status.FOLDED, Status.UNREACHABLE) and not blurred(level, state)
    if exact is not None and (out_of_reach or status is Status.NO_INERTIA):
        return f'says "{status.sentence}", but the oracle reaches it'
    if exact is not None and status is Status.NOT_CONVERGED and exact.condition * level.unit < RESOLVED:
        return f'says "{status.sentence}", but κ is only {exact.condition:.3g}'
    if exact is None and status is Status.UNREACHABLE and reachable(state):
        return f'says "{status.sentence}", but other rotations have it'
    return ""


def blurred(level: Level, state: State) -> bool:
    """Whether the precision cannot tell on which side of the fold the momentum is."""
    return state.from_fold is not None and abs(state.from_fold) <= BLUR * float(level.unit)


def mirrored(state: State) -> State:
    """The state as far before its fold as it is beyond it."""
    assert state.from_fold is not None
    return replace(state, K=scaled(state.K, 1.0 + 2.0 * state.from_fold), from_fold=-state.from_fold)


def vertical(state: State, level: Level, quick: bool) -> Judged:
    """One step of `step_vertical`, judged as one of `step`."""
    height = float(np.dot(state.K, state.g))
    exact = truth(replace(state, K=tuple(mp.mpf(height) * x for x in unit_gamma(state.g))))

    def stepped() -> Judged:
        found = step_vertical(state.ball, height, state.g)
        return beside(level, (found.rotation[1:], found.momentum, found.gamma), exact)

    return unless_refused(exact.condition if exact else None, stepped)


def four(state: State, level: Level, quick: bool) -> Judged:
    """One step in four dimensions: Ω - 1, 𝒦 and γ within 4(1 + |Ω - 1|κ) ulps."""
    moved, momentum, gamma, kappa = truth_n(state)
    matrix = np.array(Oracle(state.J, state.D, state.g).skew(state.K).tolist(), dtype=float)
    ulps = BUDGET * (1 + float(max(map(abs, moved))) * kappa)
    rotation = [x + int(i % 5 == 0) for i, x in enumerate(moved)]

    def stepped() -> Judged:
        found = step_n(BallN(state.J, state.D), matrix, state.g)
        after = list(found.momentum.flat), list(found.gamma)
        return compared(
            level, kappa, Compared("the rotation", list(found.rotation.flat), rotation, ulps, 1),
            *state_vectors(after, momentum, gamma, ulps),
        )  # fmt: skip

    return unless_refused(kappa, stepped)


def fold_search(item: tuple[State, float], level: Level, quick: bool) -> Judged:
    """`fold`: the t at which the branch along t𝒦 folds, where so large a multiple of the momentum is given."""
    state, size = item
    found = fold(state.ball, scaled(state.K, size), state.g)
    if not np.isfinite(found.reach):
        return Judged(FAILED, reason="the reach is NaN, and nothing says why")

    def at(x: Sequence[Any]) -> list[Any]:
        return [mp.make_mpf(fold_at(tuple(x[6:9]), x[9], tuple(x[:3]), tuple(x[3:6]))._mpf_)]

    exact, kappa = componentwise(at, (*state.K, *state.g, *state.J, state.D), DIFFERENCE)
    reach = number(found.reach) * mp.mpf(size)
    judged = compared(level, kappa, Compared("the reach", [reach], exact, BUDGET * (1 + kappa)))
    if judged.verdict == FAILED and not found.settled:
        return refused("Newton settles on no simple fold: `settled` is False, and the reach a lower bound")
    return judged
